#include "model/row_spacing.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace epicyclic::model {

namespace {

/// Widest interval of a run over its narrowest.
constexpr double most_uneven = 2.0;
/// Each row of a shorter run is stepped onto: there the slope changes much from row to row.
constexpr std::size_t many_rows = 8;

double wrapped(double phase) { return phase - std::floor(phase); }

}  // namespace

RowSpacing::RowSpacing(std::span<const double> phases, double rows_per_feature) {
  std::vector<double> rows(phases.begin(), phases.end());
  rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
  const std::size_t n = rows.size();
  if (n == 0) return;
  const auto width = [&](std::size_t k) { return k + 1 < n ? rows[k + 1] - rows[k] : rows[0] + 1.0 - rows[k]; };

  // Around the period from a change of width, so that the first row ends no run by being the first.
  std::size_t first = 0;
  for (std::size_t k = 0; k < n; ++k) {
    const auto [narrow, wide] = std::minmax({width((k + n - 1) % n), width(k)});
    if (wide > most_uneven * narrow) {
      first = k;
      break;
    }
  }
  struct Run {
    double narrowest, widest;
    std::vector<double> rows;
  };
  std::vector<Run> runs;
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t k = (first + i) % n;
    const double h = width(k);
    if (runs.empty() || std::max(runs.back().widest, h) > most_uneven * std::min(runs.back().narrowest, h))
      runs.push_back({h, h, {}});
    Run& run = runs.back();
    run.narrowest = std::min(run.narrowest, h);
    run.widest = std::max(run.widest, h);
    run.rows.push_back(wrapped(rows[k]));
  }
  std::vector<std::pair<double, double>> starts;
  for (const Run& run : runs)
    for (std::size_t k = 0; k < (run.rows.size() < many_rows ? run.rows.size() : 1); ++k)
      starts.emplace_back(run.rows[k], rows_per_feature * run.narrowest);
  std::sort(starts.begin(), starts.end());
  for (const auto& [start, spacing] : starts) {
    if (starts.size() > 1) starts_.push_back(start);
    spacings_.push_back(spacing);
  }
}

double RowSpacing::at(double phase) const {
  if (spacings_.empty()) return std::numeric_limits<double>::infinity();
  const auto next = std::upper_bound(starts_.begin(), starts_.end(), wrapped(phase));
  // Before the first start the last run goes on.
  return next == starts_.begin() ? spacings_.back() : spacings_[static_cast<std::size_t>(next - starts_.begin()) - 1];
}

double rows_per_feature(double error) {
  constexpr double unresolved = 1e-3;  // e_0: what the step control has to find by itself
  constexpr double least_error = 1e-16;
  return std::max(1.0, std::pow(unresolved / std::max(error, least_error), 0.25));
}

}  // namespace epicyclic::model
