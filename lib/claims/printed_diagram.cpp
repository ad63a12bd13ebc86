#include "claims/printed_diagram.hpp"

#include <algorithm>
#include <functional>
#include <limits>

#include "claims/options.hpp"

namespace epicyclic::claims {

namespace {

/// x of [P-spread].
double beyond(double ratio, double width) {
  const double more = std::max(0.0, ratio - 1.0);
  return more / (more + width);
}

}  // namespace

double axis_length(double low, double high, double recurrence_tolerance) {
  constexpr double least = 10.0;
  return std::max(high - low, least * recurrence_tolerance);
}

DotColumn::DotColumn(std::span<const double> sorted, double axis, const PrintedDots& ink)
    : extent_((sorted.back() - sorted.front()) / axis) {
  // Indices of points by the gaps below them, the largest first.
  std::vector<std::size_t> splits;
  for (std::size_t k = 1; k < sorted.size(); ++k) splits.push_back(k);
  const auto gap = [&](std::size_t k) { return sorted[k] - sorted[k - 1]; };
  const auto most = static_cast<std::size_t>(ink.period_max);
  const auto kept = splits.begin() + static_cast<std::ptrdiff_t>(std::min(most, splits.size()));
  std::ranges::partial_sort(splits, kept, std::greater{}, gap);
  gaps_.push_back(std::numeric_limits<double>::infinity());
  for (std::size_t n = 1; n <= most; ++n) {
    std::vector<std::size_t> ends(splits.begin(),
                                  splits.begin() + static_cast<std::ptrdiff_t>(std::min(n - 1, splits.size())));
    ends.push_back(sorted.size());
    std::ranges::sort(ends);
    double tallest = 0.0;
    std::size_t first = 0;
    for (const std::size_t end : ends) {
      tallest = std::max(tallest, sorted[end - 1] - sorted[first]);
      first = end;
    }
    heights_.push_back(tallest / (ink.height * axis));
    gaps_.push_back(n <= splits.size() ? gap(splits[n - 1]) / (ink.dot * axis) : 0.0);
  }
}

double DotColumn::lacks_of_period(int n) const {
  constexpr double half_height = 6.0;
  constexpr double half_gap = 15.0;
  const auto k = static_cast<std::size_t>(n);
  return std::max({beyond(heights_[k - 1], half_height), 1.0 - gaps_[k - 1], beyond(gaps_[k], half_gap)});
}

int DotColumn::period() const {
  for (std::size_t n = 1; n <= heights_.size(); ++n)
    if (heights_[n - 1] <= 1.0 && gaps_[n - 1] > 1.0 && gaps_[n] <= 1.0) return static_cast<int>(n);
  return 0;
}

double DotColumn::lacks_of_a_cloud() const {
  constexpr double wide = 0.2;
  const int n = period();
  if (n == 0) return 0.0;
  return 0.5 * (1.0 - heights_[static_cast<std::size_t>(n - 1)]) + 0.5 * std::max(0.0, 1.0 - extent_ / wide);
}

std::optional<double> DotColumn::lacks(std::string_view word) const {
  const auto least_from = [&](int first) {
    double least = 1.0;
    for (int n = first; n <= static_cast<int>(heights_.size()); ++n) least = std::min(least, lacks_of_period(n));
    return least;
  };
  if (word == "not period 1") return std::max(0.0, 1.0 - std::max(heights_.front(), gaps_[1]));
  if (word == "chaotic" || word == "aperiodic" || word == "quasiperiodic" || word == "not periodic")
    return lacks_of_a_cloud();
  if (word == "periodic" || word == "not chaotic") return least_from(1);
  if (word == "multi-period") return least_from(2);
  if (word.starts_with("not ")) return std::nullopt;
  const int n = period_of_word(word);
  if (n < 1 || n > static_cast<int>(heights_.size())) return std::nullopt;
  return lacks_of_period(n);
}

}  // namespace epicyclic::claims
