#include "integrate/flow.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "core/errors.hpp"

namespace epicyclic::integrate {

void check_interval(double from, double to) {
  if (!(from <= to) || !std::isfinite(from) || !std::isfinite(to))
    throw InputError("an integration from " + std::to_string(from) + " to " + std::to_string(to) +
                     " does not go forward in time");
}

namespace {

// A value of s this near to a breakpoint, in periods, is the breakpoint: far above rounding, far below any step.
constexpr double same_phase = 1e-12;

double tolerance(const VectorField& field) { return same_phase * field.period; }

}  // namespace

std::size_t segment_after(const VectorField& field, double s) {
  if (field.breakpoints.empty()) return 0;
  double phase = s - std::floor(s / field.period) * field.period + tolerance(field);
  if (phase >= field.period) phase -= field.period;
  const auto next = std::upper_bound(field.breakpoints.begin(), field.breakpoints.end(), phase);
  const auto index = static_cast<std::size_t>(next - field.breakpoints.begin());
  return index == 0 ? field.breakpoints.size() - 1 : index - 1;
}

std::vector<double> breakpoints_between(const VectorField& field, double from, double to) {
  std::vector<double> between;
  if (field.breakpoints.empty()) return between;
  const double near = tolerance(field);
  for (double cycle = std::floor(from / field.period); cycle * field.period < to; cycle += 1.0)
    for (const double b : field.breakpoints) {
      const double s = cycle * field.period + b;
      if (s > from + near && s < to - near) between.push_back(s);
    }
  return between;
}

double longest_step(const VectorField& field, const IntegratorOptions& options, std::size_t segment, double gap) {
  double longest = std::numeric_limits<double>::infinity();
  if (options.max_step_periods > 0.0) longest = options.max_step_periods * (field.period > 0.0 ? field.period : 1.0);
  if (!field.sampling_interval.empty()) longest = std::min(longest, field.sampling_interval.at(segment) / gap);
  return longest;
}

double widest_gap(std::span<const double> nodes) {
  std::vector<double> sorted{0.0, 1.0};
  sorted.insert(sorted.end(), nodes.begin(), nodes.end());
  std::sort(sorted.begin(), sorted.end());
  double widest = 0.0;
  for (std::size_t k = 1; k < sorted.size(); ++k) widest = std::max(widest, sorted[k] - sorted[k - 1]);
  return widest;
}

void check_tangents(const VectorField& field, std::span<const double> tangents, LastTangent last) {
  if (!field.tangents) throw InputError("the field has no tangents for tangent vectors");
  if (field.jumps_at_surfaces)
    throw InputError("a field that jumps where the state crosses a surface has no tangent vectors");
  if (last == LastTangent::parameter && !field.parameter_derivative)
    throw InputError("the field has no derivative with respect to a parameter");
  if (tangents.empty() || tangents.size() % field.dimension != 0)
    throw InputError("tangents of " + std::to_string(tangents.size()) + " numbers for a field of dimension " +
                     std::to_string(field.dimension));
}

void jacobian(const VectorField& field, std::size_t segment, double s, const double* y, std::span<double> jacobian) {
  const std::size_t n = field.dimension;
  if (!field.tangents) throw InputError("the field has no tangents for a Jacobian");
  std::vector<double> memory(n * n + n, 0.0);
  for (std::size_t j = 0; j < n; ++j) memory[j * n + j] = 1.0;
  field.tangents(segment, s, y, {memory.data(), n, n}, memory.data() + n * n, {jacobian.data(), n, n});
}

}  // namespace epicyclic::integrate
