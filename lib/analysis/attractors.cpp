#include "analysis/attractors.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include <gsl/gsl_cdf.h>

#include "core/errors.hpp"
#include "core/require.hpp"

namespace epicyclic::analysis {

namespace {

constexpr double far = std::numeric_limits<double>::infinity();

/// Errors are bounds of first order; orbits that are not one are further apart by far.
constexpr double safety = 10.0;

double largest(const std::vector<double>& values) {
  double most = 0.0;
  for (const double x : values) most = std::max(most, std::abs(x));
  return most;
}

/// The distance of [A-same] over what it may be.
double orbit_ratio(const AttractorRecord& a, const AttractorRecord& b) {
  const std::size_t n = a.period();
  if (n == 0 || b.period() != n || a.dimension != b.dimension) return far;
  const std::size_t d = a.dimension;
  double least = far;
  for (std::size_t r = 0; r < n; ++r) {
    double most = 0.0;
    for (std::size_t k = 0; k < n && most < least; ++k)
      for (std::size_t j = 0; j < d; ++j)
        most = std::max(most, std::abs(b.orbit[(k + r) % n * d + j] - a.orbit[k * d + j]));
    least = std::min(least, most);
  }
  const double allowed = safety * (a.orbit_error + b.orbit_error);
  return least > 0.0 ? least / allowed : 0.0;
}

/// Student's t, two-sided.
double student(double level, int frequencies) { return gsl_cdf_tdist_Pinv(1.0 - 0.5 * level, 2.0 * frequencies); }

/// The largest difference of two records over what it would have to be to count.
double statistics_ratio(const AttractorRecord& a, const AttractorRecord& b, const AttractorOptions& o) {
  if (a.means.size() != b.means.size()) return far;
  const double comparisons = 2.0 * static_cast<double>(a.means.size()) + 1.0;
  const double level = o.level / comparisons;
  const int frequencies = std::min(a.frequencies, b.frequencies);
  if (frequencies == 0) return 0.0;  // too short to prove anything
  double ratio = 0.0;
  const auto compare = [&](const Estimate& x, const Estimate& y, int their_frequencies, double least) {
    // Factor between half widths of default_confidence and those of the level.
    const double factor = student(level, their_frequencies) / student(1.0 - default_confidence, their_frequencies);
    const double counts = std::max(factor * std::hypot(x.half_width, y.half_width), least);
    const double difference = std::abs(x.value - y.value);
    if (difference > 0.0) ratio = std::max(ratio, difference / counts);
  };
  for (std::size_t j = 0; j < a.means.size(); ++j) {
    const double least = std::max(o.tolerance, o.least * std::max(a.deviations[j].value, b.deviations[j].value));
    compare(a.means[j], b.means[j], frequencies, least);
    compare(a.deviations[j], b.deviations[j], frequencies, least);
  }
  if (std::isfinite(a.exponent.value) && std::isfinite(b.exponent.value))
    compare(a.exponent, b.exponent, default_frequencies,
            o.least * std::max(std::abs(a.exponent.value), std::abs(b.exponent.value)));
  return ratio;
}

/// Records of one attractor, and what they say together.
class Group {
 public:
  Group(const AttractorRecord& record, std::size_t index) : record_(record), members_{index} {}

  [[nodiscard]] const AttractorRecord& record() const { return record_; }
  [[nodiscard]] const std::vector<std::size_t>& members() const { return members_; }

  /// At most 1: on the same attractor.
  [[nodiscard]] double ratio(const AttractorRecord& other, const AttractorOptions& options) const {
    if (other.regime != record_.regime) return far;
    return other.regime == Regime::periodic ? orbit_ratio(record_, other) : statistics_ratio(record_, other, options);
  }

  void join(const AttractorRecord& other, const std::vector<std::size_t>& members) {
    const auto mine = static_cast<double>(members_.size());
    const auto theirs = static_cast<double>(members.size());
    members_.insert(members_.end(), members.begin(), members.end());
    if (record_.regime == Regime::periodic) {
      if (other.orbit_error < record_.orbit_error) record_ = other;
      return;
    }
    const double share = theirs / (mine + theirs);
    const auto pool = [share](Estimate& a, const Estimate& b) {
      a.value += share * (b.value - a.value);
      a.half_width = std::hypot((1.0 - share) * a.half_width, share * b.half_width);
    };
    for (std::size_t j = 0; j < record_.means.size(); ++j) {
      pool(record_.means[j], other.means[j]);
      pool(record_.deviations[j], other.deviations[j]);
    }
    if (!std::isfinite(record_.exponent.value)) {
      record_.exponent = other.exponent;
    } else if (std::isfinite(other.exponent.value)) {
      pool(record_.exponent, other.exponent);
    }
    record_.frequencies = std::min(record_.frequencies, other.frequencies);
  }

 private:
  AttractorRecord record_;
  std::vector<std::size_t> members_;
};

/// The group that a record is nearest to, and how near.
std::pair<std::size_t, double> nearest(const std::vector<Group>& groups, const AttractorRecord& record,
                                       const AttractorOptions& options) {
  std::pair<std::size_t, double> found{groups.size(), far};
  for (std::size_t g = 0; g < groups.size(); ++g)
    if (const double ratio = groups[g].ratio(record, options); ratio < found.second) found = {g, ratio};
  return found;
}

/// Groups that only seemed to differ while they had few members.
void merge(std::vector<Group>& groups, const AttractorOptions& options) {
  for (std::size_t a = 0; a < groups.size(); ++a)
    for (std::size_t b = a + 1; b < groups.size();) {
      if (groups[a].ratio(groups[b].record(), options) > 1.0) {
        ++b;
        continue;
      }
      groups[a].join(groups[b].record(), groups[b].members());
      groups.erase(groups.begin() + static_cast<std::ptrdiff_t>(b));
      b = a + 1;
    }
}

AttractorRecord image(const AttractorRecord& record, const Symmetry& symmetry) {
  AttractorRecord mapped = record;
  mapped.orbit.clear();
  for (std::size_t k = 0; k < record.period(); ++k) {
    const auto y = symmetry({record.orbit.data() + k * record.dimension, record.dimension});
    mapped.orbit.insert(mapped.orbit.end(), y.begin(), y.end());
  }
  return mapped;
}

}  // namespace

void AttractorOptions::validate() const {
  require(level > 0.0 && level < 1.0, "level", level, "in (0, 1)");
  require(least >= 0.0, "least", least, ">= 0");
  require(tolerance > 0.0, "tolerance", tolerance, "> 0");
}

AttractorRecord record_of_orbit(integrate::Flow& flow, const PeriodicOrbit& orbit, int n, double map_error) {
  AttractorRecord r;
  r.dimension = orbit.state.size();
  std::vector<double> y = orbit.state;
  flow.forget();
  for (int k = 0; k < n; ++k) {
    r.orbit.insert(r.orbit.end(), y.begin(), y.end());
    if (k + 1 < n && !flow.evolve(y, 0.0, flow.field().period).reached()) return {};
  }
  r.regime = Regime::periodic;
  r.orbit_error = std::max(orbit.error, orbit_error(orbit.monodromy, map_error * largest(r.orbit)));
  return r;
}

AttractorRecord record_of_section(const PoincareSection& section, Regime regime, const Recurrence& recurrence,
                                  const Estimate& exponent, double map_error) {
  AttractorRecord r;
  r.regime = regime;
  r.dimension = section.dimension;
  const std::size_t points = section.size();
  if (points == 0 || regime == Regime::undecided) {
    r.regime = Regime::undecided;
    return r;
  }
  if (regime == Regime::periodic) {
    const auto n = static_cast<std::size_t>(recurrence.period);
    if (n == 0 || n > points) throw DomainError("a periodic section of " + std::to_string(n) + " points");
    r.orbit.assign(section.states.end() - static_cast<std::ptrdiff_t>(n * section.dimension), section.states.end());
    const double periods = static_cast<double>(points) / static_cast<double>(n);
    const double late = recurrence.late_error;
    const double decay = recurrence.error > 0.0 ? std::pow(late / recurrence.error, 2.0 / periods) : 0.0;
    // A record whose error does not decay may change once more by as much as it did over the record.
    r.orbit_error = late / std::max(1.0 - decay, 1.0 / periods) + map_error * largest(r.orbit);
    return r;
  }
  r.exponent = exponent;
  // More frequencies hardly narrow Student's t. Each one costs a sum over the record.
  constexpr int most_frequencies = 32;
  r.frequencies = std::clamp(static_cast<int>(points / 16), default_frequencies, most_frequencies);
  r.frequencies = std::min(r.frequencies, static_cast<int>((points - 1) / 2));
  if (r.frequencies == 0) return r;
  std::vector<double> series(points);
  for (std::size_t j = 0; j < section.dimension; ++j) {
    for (std::size_t k = 0; k < points; ++k) series[k] = section.point(k)[j];
    r.means.push_back(series_mean(series, r.frequencies));
    r.deviations.push_back(series_deviation(series, r.frequencies));
  }
  return r;
}

Attractors label_attractors(std::span<const AttractorRecord> records, const AttractorOptions& options,
                            std::span<const Symmetry> symmetries) {
  options.validate();
  std::vector<Group> groups;
  for (std::size_t k = 0; k < records.size(); ++k) {
    if (records[k].regime == Regime::undecided) continue;
    if (const auto [g, ratio] = nearest(groups, records[k], options); ratio <= 1.0) {
      groups[g].join(records[k], {k});
    } else {
      groups.emplace_back(records[k], k);
    }
  }
  merge(groups, options);

  // Compare each record once more with all groups: the first records had few groups to choose from.
  std::vector<std::vector<std::size_t>> members(groups.size());
  for (const Group& group : groups)
    for (const std::size_t k : group.members()) {
      const auto [g, ratio] = nearest(groups, records[k], options);
      members[ratio <= 1.0 ? g : static_cast<std::size_t>(&group - groups.data())].push_back(k);
    }
  Attractors result;
  result.number.assign(records.size(), 0);
  for (std::size_t g = 0; g < groups.size(); ++g) {
    if (members[g].empty()) continue;
    std::sort(members[g].begin(), members[g].end());
    result.all.push_back({groups[g].record(), std::move(members[g]), 0, 0});
  }
  std::sort(result.all.begin(), result.all.end(),
            [](const Attractor& a, const Attractor& b) { return a.members.front() < b.members.front(); });
  for (std::size_t a = 0; a < result.all.size(); ++a) {
    Attractor& attractor = result.all[a];
    for (const std::size_t k : attractor.members) result.number[k] = a + 1;
    for (std::size_t b = 0; b < a && attractor.image_of == 0; ++b)
      for (std::size_t s = 0; s < symmetries.size() && attractor.image_of == 0; ++s)
        if (result.all[b].record.regime == Regime::periodic && attractor.record.regime == Regime::periodic &&
            orbit_ratio(image(result.all[b].record, symmetries[s]), attractor.record) <= 1.0) {
          attractor.image_of = b + 1;
          attractor.image_by = s;
        }
  }
  return result;
}

}  // namespace epicyclic::analysis
