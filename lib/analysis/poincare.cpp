#include "analysis/poincare.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/largest_difference.hpp"
#include "core/require.hpp"
#include "core/root_finding.hpp"

namespace epicyclic::analysis {

std::vector<double> uniform_phases(double period, int count) {
  std::vector<double> s;
  for (int j = 1; j < count; ++j) s.push_back(period * j / count);
  s.push_back(period);
  return s;
}

RecordingPhases::RecordingPhases(const VectorField& field, int count, int refinement) {
  const double period = period_of(field);
  std::vector<std::pair<double, SampleKind>> all;
  const std::vector<double> uniform = uniform_phases(period, count);
  for (std::size_t j = 0; j < uniform.size(); ++j) {
    const double before = j == 0 ? 0.0 : uniform[j - 1];
    for (int k = 1; k < refinement; ++k)
      all.emplace_back(before + (uniform[j] - before) * k / refinement,
                       k % 2 == 1 ? SampleKind::odd : SampleKind::even);
    all.emplace_back(uniform[j], SampleKind::uniform);
  }
  for (const double b : field.breakpoints) {
    // The beginning of the period is no sample; the next number above it stands for it, and T for its other side.
    all.emplace_back(b > 0.0 ? b : std::numeric_limits<double>::min(), SampleKind::jump);
    if (b > 0.0) all.emplace_back(std::nextafter(b, 0.0), SampleKind::jump);
  }
  std::ranges::stable_sort(all, {}, [](const auto& sample) { return sample.first; });
  for (const auto& [phase, what] : all) {
    if (!s.empty() && s.back() == phase) continue;  // the uniform one, which comes first
    s.push_back(phase);
    kind.push_back(what);
  }
}

void StrobeOptions::validate() const {
  require(transient_periods >= 0, "transient_periods", transient_periods, ">= 0");
  require(recorded_periods >= 0, "recorded_periods", recorded_periods, ">= 0");
  require(phases >= 1, "phases", phases, ">= 1");
}

StrobeProgress::StrobeProgress(std::size_t dimension, const StrobeOptions& options, std::vector<double> samples,
                               const integrate::Observer& observer)
    : options_(options), last_(options.transient_periods + options.recorded_periods), samples_(std::move(samples)) {
  options.validate();
  see_ = [this, observer](std::size_t j, double s, std::span<const double> y) {
    const auto recorded = static_cast<std::size_t>(advanced_ - options_.transient_periods);
    observer(recorded * samples_.size() + j, s, y);
  };
  strobe_.section.dimension = dimension;
  strobe_.section.states.reserve(static_cast<std::size_t>(options.recorded_periods) * dimension);
}

std::span<const double> StrobeProgress::samples() const {
  if (advanced_ < options_.transient_periods) return {};
  return samples_;
}

void StrobeProgress::take(const integrate::Evolution& evolution, std::span<const double> state) {
  strobe_.evolution = evolution;
  if (!evolution.reached()) return;
  if (advanced_ >= options_.transient_periods)
    strobe_.section.states.insert(strobe_.section.states.end(), state.begin(), state.end());
  ++advanced_;
}

void advance_strobe(integrate::Flow& flow, std::span<double> state, StrobeProgress& strobe,
                    const std::function<bool()>& go_on) {
  while (!strobe.over() && go_on()) {
    const integrate::Evolution e = flow.evolve(state, 0.0, flow.field().period, strobe.samples(), strobe.observer());
    strobe.take(e, state);
  }
}

Strobe strobe(integrate::Flow& flow, std::span<double> state, const StrobeOptions& options,
              const integrate::Observer& observer, const std::function<bool()>& go_on) {
  StrobeProgress progress(flow.field().dimension, options, uniform_phases(period_of(flow.field()), options.phases),
                          observer);
  advance_strobe(flow, state, progress, go_on);
  return std::move(progress.result());
}

SurfaceSection surface_section(integrate::Flow& flow, std::span<double> state,
                               const std::function<double(double s, std::span<const double> y)>& surface,
                               SectionCrossing direction, int periods, int phases, const std::function<bool()>& go_on) {
  const double period = period_of(flow.field());
  SurfaceSection result;
  result.section.dimension = state.size();
  const std::vector<double> samples = uniform_phases(period, phases);
  struct Sample {
    double s = 0;
    std::vector<double> y;
    double side = 0;  ///< h, with the sign for which the crossings rise
  };
  const double sign = direction == SectionCrossing::rising ? 1.0 : -1.0;
  const auto sample = [&](double s, std::span<const double> y) {
    return Sample{s, {y.begin(), y.end()}, sign * surface(s, y)};
  };
  for (int k = 0; k < periods; ++k) {
    if (!go_on()) return result;
    std::vector<Sample> seen = {sample(0.0, state)};
    result.evolution = flow.evolve(state, 0.0, period, samples, [&](std::size_t, double s, std::span<const double> y) {
      seen.push_back(sample(s, y));
    });
    if (!result.evolution.reached()) return result;
    const double next_step = flow.next_step();
    for (std::size_t j = 0; j + 1 < seen.size(); ++j) {
      if (!(seen[j].side < 0.0 && seen[j + 1].side >= 0.0)) continue;
      std::vector<double> y;
      const auto along = [&](double s) {
        y = seen[j].y;
        flow.forget();
        if (s > seen[j].s) (void)flow.evolve(y, seen[j].s, s);
        return sign * surface(s, y);
      };
      // The dense output and the flow may differ by the tolerance on which side the end is.
      const double s = along(seen[j + 1].s) > 0.0 ? find_root(along, seen[j].s, seen[j + 1].s) : seen[j + 1].s;
      (void)along(s);
      result.section.states.insert(result.section.states.end(), y.begin(), y.end());
      result.phase.push_back(s);
    }
    flow.set_next_step(next_step);
  }
  return result;
}

double recurrence_error(const PoincareSection& section, std::size_t n, std::size_t first) {
  double error = 0.0;
  for (std::size_t k = first; k + n < section.size(); ++k)
    error = std::max(error, largest_difference(section.point(k), section.point(k + n)));
  return error;
}

Recurrence recurrence(const PoincareSection& section, int longest, double tolerance) {
  constexpr double separation = 10.0;
  const std::size_t most = std::min(static_cast<std::size_t>(longest), section.size() / 2);
  Recurrence best;
  best.error = std::numeric_limits<double>::infinity();
  if (!std::ranges::all_of(section.states, [](double y) { return std::isfinite(y); })) return best;
  for (std::size_t n = 1; n <= most; ++n) {
    const double error = recurrence_error(section, n, 0);
    const bool recurs = error <= tolerance && error <= best.error / separation;
    if (error < best.error) {
      best.error = error;
      best.best_period = static_cast<int>(n);
    }
    if (recurs) {
      best.period = static_cast<int>(n);
      break;
    }
  }
  if (best.best_period > 0)
    best.late_error = recurrence_error(section, static_cast<std::size_t>(best.best_period),
                                       (section.size() - static_cast<std::size_t>(best.best_period)) / 2);
  return best;
}

double farthest_from(const PoincareSection& a, const PoincareSection& b) {
  double farthest = 0.0;
  for (std::size_t k = 0; k < b.size(); ++k) {
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < a.size(); ++i) nearest = std::min(nearest, largest_difference(a.point(i), b.point(k)));
    farthest = std::max(farthest, nearest);
  }
  return farthest;
}

double cycle_distance(std::span<const double> a, std::span<const double> b, std::size_t columns, std::size_t dimension,
                      std::size_t n) {
  if (n == 0 || std::min(a.size(), b.size()) < n * columns) return std::numeric_limits<double>::quiet_NaN();
  const auto point = [columns, dimension, n](std::span<const double> rows, std::size_t k) {
    return rows.last(n * columns).subspan(k * columns, dimension);
  };
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t shift = 0; shift < n; ++shift) {
    double most = 0.0;
    for (std::size_t k = 0; k < n; ++k)
      most = std::max(most, largest_difference(point(a, k), point(b, (k + shift) % n)));
    least = std::min(least, most);
  }
  return least;
}

double extent(const PoincareSection& section) {
  double widest = 0.0;
  for (std::size_t j = 0; j < section.dimension; ++j) {
    double least = std::numeric_limits<double>::infinity();
    double most = -least;
    for (std::size_t k = 0; k < section.size(); ++k) {
      least = std::min(least, section.point(k)[j]);
      most = std::max(most, section.point(k)[j]);
    }
    widest = std::max(widest, most - least);
  }
  return widest;
}

bool still_converging(const Recurrence& r, double tolerance) {
  constexpr double small = 100.0;  // an error beyond this many tolerances is not the tail of a transient
  constexpr double falling = 0.8;  // chaotic and quasiperiodic trajectories have the same error early and late
  return r.period == 0 && r.error <= small * tolerance && r.late_error <= falling * r.error;
}

}  // namespace epicyclic::analysis
