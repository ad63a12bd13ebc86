#include "analysis/lyapunov.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <string>
#include <utility>

#include <Eigen/Core>

#include "core/dense.hpp"
#include "core/errors.hpp"
#include "core/random_numbers.hpp"
#include "core/require.hpp"

namespace epicyclic::analysis {

namespace {

/// Limit for the vectors of a spectrum within a part of an interval: log of the largest growth over the smallest.
const double most_apart = std::log(1e6);
constexpr int most_parts = 65536;

}  // namespace

void LyapunovOptions::validate() const {
  require(aligning_periods >= 0, "aligning_periods", aligning_periods, ">= 0");
  require(periods >= 1, "periods", periods, ">= 1");
}

void SpectrumOptions::validate() const {
  require(aligning_intervals >= 0, "aligning_intervals", aligning_intervals, ">= 0");
  require(intervals >= 1, "intervals", intervals, ">= 1");
  require(interval >= 0.0, "interval", interval, ">= 0");
}

LargestExponent largest_exponent(integrate::Flow& flow, std::span<double> state, const LyapunovOptions& options,
                                 const integrate::Observer& observer, const std::function<bool()>& go_on) {
  options.validate();
  LargestExponent result;
  result.per_s = {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::quiet_NaN()};
  const double period = period_of(flow.field());
  // A direction that no symmetry of a system singles out.
  std::vector<double> v(state.size());
  for (std::size_t i = 0; i < v.size(); ++i) v[i] = std::sin(1.0 + static_cast<double>(i) * 1.7);
  for (int k = -options.aligning_periods; k < options.periods; ++k) {
    if (!go_on()) return result;
    if (options.project) options.project(v);
    double before = 0.0;
    for (const double x : v) before += x * x;
    for (double& x : v) x /= std::sqrt(before);
    result.evolution = flow.evolve_tangents(state, v, 0.0, period);
    if (!result.evolution.reached()) return result;
    if (k < 0) continue;
    double square = 0.0;
    for (const double x : v) square += x * x;
    result.growth.push_back(0.5 * std::log(square));
    if (observer) observer(static_cast<std::size_t>(k), period, state);
  }
  double square = 0.0;
  for (const double x : v) square += x * x;
  for (double& x : v) x /= std::sqrt(square);
  result.direction = std::move(v);
  if (result.growth.empty()) return result;
  result.per_s = series_mean(result.growth) / period;
  return result;
}

double late_growth(std::span<const double> growth) {
  const std::span<const double> half = growth.subspan(growth.size() / 2);
  return std::accumulate(half.begin(), half.end(), 0.0);
}

std::vector<double> LyapunovSpectrum::history(std::size_t i) const {
  std::vector<double> mean;
  double grown = 0.0;
  for (std::size_t k = i; k < growth.size(); k += exponents) {
    grown += growth[k];
    mean.push_back(grown / (static_cast<double>(mean.size() + 1) * interval));
  }
  return mean;
}

namespace {

/// The exponents and their sum from the growth in each interval.
void estimate_exponents(LyapunovSpectrum& s) {
  std::vector<double> sums(s.growth.size() / s.exponents, 0.0);
  std::vector<double> series(sums.size());
  const auto per_s = [&](const std::vector<double>& g) { return g.empty() ? Estimate{} : series_mean(g) / s.interval; };
  for (std::size_t i = 0; i < s.exponents; ++i) {
    for (std::size_t k = 0; k < series.size(); ++k) {
      series[k] = s.growth[k * s.exponents + i];
      sums[k] += series[k];
    }
    s.per_s.push_back(per_s(series));
  }
  s.sum = per_s(sums);
}

}  // namespace

LyapunovSpectrum lyapunov_spectrum(integrate::Flow& flow, std::span<double> state, const SpectrumOptions& options,
                                   const std::function<bool()>& go_on) {
  options.validate();
  const std::size_t n = state.size();
  LyapunovSpectrum result;
  const std::size_t m = result.exponents = options.exponents == 0 ? n : options.exponents;
  const double interval = result.interval = options.interval == 0.0 ? flow.field().period : options.interval;
  if (m > n)
    throw DomainError(std::to_string(m) + " exponents of " + std::to_string(n) +
                      " dimensions are requested; at most one per dimension exists");
  if (!(interval > 0.0)) throw DomainError("exponents of a field without a period need an interval");
  const auto rows = static_cast<Eigen::Index>(n);
  const auto columns = static_cast<Eigen::Index>(m);
  // Vectors along the axes could lie in an invariant subspace of the trajectory (planets in step, say) and would leave
  // it by rounding alone. The exponents would then be in another order than by size.
  Eigen::MatrixXd v(rows, columns);
  std::uint64_t number = 0;
  for (double& x : v.reshaped()) x = random_uniform(1, ++number) - 0.5;
  (void)orthonormalise(v);
  double s = 0.0;
  int parts = 1;  // of an interval; as the last one needed them
  for (int k = -options.aligning_intervals; k < options.intervals; ++k) {
    if (!go_on()) return result;
    // s stays small where it is a phase, and goes on where it is not.
    if (flow.field().period > 0.0) s = std::fmod(s, flow.field().period);
    if (k >= 0 && options.begins) options.begins(s, state);
    Eigen::VectorXd growth = Eigen::VectorXd::Zero(columns);
    double widest = 0.0;
    for (int part = 0; part < parts;) {
      const std::vector<double> state_before(state.begin(), state.end());
      const Eigen::MatrixXd v_before = v;
      const double step_before = flow.next_step();
      const double from = s + interval * part / parts;
      const double to = part + 1 == parts ? s + interval : s + interval * (part + 1) / parts;
      result.evolution = flow.evolve_tangents(state, {v.data(), n * m}, from, to);
      if (!result.evolution.reached()) return result;
      const Eigen::VectorXd logs = orthonormalise(v).cwiseAbs().array().log();
      const double apart = logs.maxCoeff() - logs.minCoeff();
      if (!(apart <= most_apart) && parts < most_parts) {
        std::copy(state_before.begin(), state_before.end(), state.begin());
        v = v_before;
        flow.set_next_step(step_before);
        parts *= 2;
        part *= 2;
        continue;
      }
      growth += logs;
      widest = std::max(widest, apart);
      ++part;
    }
    s += interval;
    if (parts > 1 && widest < 0.4 * most_apart) parts /= 2;
    if (k < 0) continue;
    for (const double g : growth) result.growth.push_back(g);
  }
  estimate_exponents(result);
  return result;
}

double kaplan_yorke_dimension(std::span<const double> exponents) {
  double sum = 0.0;
  for (std::size_t j = 0; j < exponents.size(); ++j) {
    if (sum + exponents[j] < 0.0) return static_cast<double>(j) + sum / std::abs(exponents[j]);
    sum += exponents[j];
  }
  return static_cast<double>(exponents.size());
}

VectorField with_divergence(const VectorField& field) {
  if (!field.tangents) throw InputError("the divergence needs a field with tangents");
  const std::size_t n = field.dimension;
  VectorField extended = field;
  extended.origin = nullptr;  // of no kind any more
  extended.dimension = n + 1;
  extended.tangents = {};
  extended.parameter_derivative = {};
  extended.surfaces = {};
  extended.right_hand_side = [field, n, matrix = std::vector<double>(n * n)](std::size_t segment, double s,
                                                                             const double* y, double* dyds) mutable {
    field.right_hand_side(segment, s, y, dyds);
    integrate::jacobian(field, segment, s, y, matrix);
    double trace = 0.0;
    for (std::size_t i = 0; i < n; ++i) trace += matrix[i * n + i];
    dyds[n] = trace;
  };
  return extended;
}

}  // namespace epicyclic::analysis
