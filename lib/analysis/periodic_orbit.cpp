#include "analysis/periodic_orbit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "analysis/shooting.hpp"
#include "core/dense.hpp"
#include "core/errors.hpp"
#include "core/largest_difference.hpp"
#include "core/require.hpp"
#include "core/text.hpp"

namespace epicyclic::analysis {

namespace {

Eigen::VectorXd as_vector(std::span<const double> y) {
  return Eigen::Map<const Eigen::VectorXd>(y.data(), static_cast<Eigen::Index>(y.size()));
}

/// (I - M)^-1 r, of least norm where I - M is singular.
Eigen::VectorXd solve(const Eigen::MatrixXd& m, const Eigen::VectorXd& r) {
  return least_norm_solution(Eigen::MatrixXd::Identity(m.rows(), m.cols()) - m, r);
}

/// d_i of [A-shoot], one column each.
Eigen::MatrixXd newton_step(const Shot& at) {
  const Eigen::Index n = at.residual.rows();
  const Eigen::Index count = at.residual.cols();
  if (count == 1) return solve(at.interval_maps[0], at.residual.col(0));
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(n * count, n * count);
  for (Eigen::Index i = 0; i < count; ++i) {
    a.block(i * n, i * n, n, n) = at.interval_maps[static_cast<std::size_t>(i)];
    a.block(i * n, (i + 1) % count * n, n, n) -= Eigen::MatrixXd::Identity(n, n);
  }
  return least_norm_solution(a, -at.residual.reshaped()).reshaped(n, count);
}

/// State and monodromy of the orbit from an iteration.
void take_state(const Eigen::MatrixXd& y, const Shot& at, PeriodicOrbit& orbit) {
  std::copy_n(y.data(), orbit.state.size(), orbit.state.begin());
  orbit.monodromy = at.monodromy().product();
  orbit.interval_maps = at.interval_maps;
}

}  // namespace

void OrbitOptions::validate() const {
  require(iterations >= 1, "iterations", iterations, ">= 1");
  require(residual >= 0.0, "residual", residual, ">= 0");
  require(known >= 0.0, "known", known, ">= 0");
  require(shooting_intervals >= 1, "shooting_intervals", shooting_intervals, ">= 1");
}

namespace {

/// The residual at y of a shot that keeps its tangents.
/// @returns whether it is reached or falls tenfold
bool keeps_tangents(integrate::Flow& flow, const Eigen::MatrixXd& y, int n, double reached, Shot& at) {
  const double before = at.residual.lpNorm<Eigen::Infinity>();
  Shot states = shoot_states(flow, y, n);
  at.residual = std::move(states.residual);
  at.evolution = std::move(states.evolution);
  constexpr double gain = 0.1;
  const double now = at.residual.lpNorm<Eigen::Infinity>();
  return at.evolution.reached() && !(now > reached && now > gain * before);
}

}  // namespace

PeriodicOrbit find_periodic_orbit(integrate::Flow& flow, std::span<const double> start, int n,
                                  const OrbitOptions& options) {
  if (n < 1) throw DomainError("an orbit of period " + std::to_string(n) + " is requested, must be >= 1");
  options.validate();
  PeriodicOrbit orbit;
  orbit.state.assign(start.begin(), start.end());
  Eigen::MatrixXd y(static_cast<Eigen::Index>(start.size()), options.shooting_intervals);
  y.col(0) = as_vector(start);
  double best = std::numeric_limits<double>::infinity();
  // The error of the best iteration alone, on request, and once: its singular values cost more than the step.
  double reported = best;
  const auto report_error = [&] {
    if (reported == best) return;
    reported = best;
    orbit.error = orbit_error(orbit.monodromy, std::max(best, options.residual));
  };
  const auto is_known = [&] {
    report_error();
    return std::isfinite(best) && orbit.error <= options.known * as_vector(orbit.state).lpNorm<Eigen::Infinity>();
  };
  const auto not_reached = [&](const integrate::Evolution& e) {
    report_error();
    orbit.outcome = OrbitOutcome::not_reached;
    orbit.message = e.message;
    return orbit;
  };
  if (options.shooting_intervals > 1)
    if (const integrate::Evolution e = integrate_to_intervals(flow, n, y); !e.reached()) return not_reached(e);
  Shot at;
  bool kept = false;
  for (int k = 0; k < options.iterations; ++k) {
    // With the tangents as they are, or if that is no longer worth it, with those of this very state.
    kept = kept && keeps_tangents(flow, y, n, options.residual, at);
    if (!kept) at = shoot(flow, y, n);
    if (!at.evolution.reached()) return not_reached(at.evolution);
    const double residual = at.residual.lpNorm<Eigen::Infinity>();
    orbit.residuals.push_back(residual);
    const bool falls = residual < 0.5 * best;
    if (residual < best) {
      best = residual;
      take_state(y, at, orbit);
    }
    if (residual <= options.residual) {
      report_error();
      orbit.outcome = OrbitOutcome::converged;
      return orbit;
    }
    // At the integrator's own noise nothing falls any more.
    if (k > 1 && !falls && is_known()) {
      orbit.outcome = OrbitOutcome::stalled;
      orbit.message = "the residual stays at " + short_text(best);
      return orbit;
    }
    // Beside a chaotic trajectory there may be no orbit: stop after four iterations without progress.
    constexpr int patience = 4;
    constexpr double gain = 0.1;
    if (k + 1 >= patience && best > gain * orbit.residuals.front()) break;
    if (k + 1 == options.iterations) break;
    y += newton_step(at);
    kept = options.keep_tangents && options.shooting_intervals == 1;
  }
  orbit.outcome = is_known() ? OrbitOutcome::stalled : OrbitOutcome::not_converged;
  orbit.message = "the residual is " + short_text(best) + ", the error " + short_text(orbit.error) + " after " +
                  std::to_string(orbit.residuals.size()) + " iterations";
  return orbit;
}

std::vector<double> nearest_on_orbit(integrate::Flow& flow, std::span<const double> on, int n,
                                     std::span<const double> state) {
  std::vector<double> y(on.begin(), on.end());
  std::vector<double> nearest = y;
  flow.forget();
  for (int k = 1; k < n; ++k) {
    if (!flow.evolve(y, 0.0, flow.field().period).reached()) break;
    if (largest_difference(y, state) < largest_difference(nearest, state)) nearest = y;
  }
  flow.forget();
  return nearest;
}

double orbit_error(const Eigen::MatrixXd& monodromy, double residual) {
  constexpr double neutral = 1e-8;
  const Eigen::MatrixXd a = monodromy - Eigen::MatrixXd::Identity(monodromy.rows(), monodromy.cols());
  const SingularValues svd = singular_values(a);
  Eigen::VectorXd inverted = svd.s;
  for (double& s : inverted) s = s > neutral ? 1.0 / s : 0.0;
  const Eigen::MatrixXd scaled = svd.v * inverted.asDiagonal();
  const Eigen::MatrixXd inverse = product(scaled, svd.u.transpose());
  return inverse.cwiseAbs().rowwise().sum().maxCoeff() * residual;
}

bool FloquetMultipliers::stable() const {
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!(std::abs(values[i]) + errors[i] < 1.0)) return false;
  return true;
}

namespace {

/// M as it was found, one factor per shooting interval.
MatrixProduct factors_of(const PeriodicOrbit& orbit) {
  if (!orbit.interval_maps.empty()) return {orbit.interval_maps};
  return orbit.monodromy.size() == 0 ? MatrixProduct{} : MatrixProduct{{orbit.monodromy}};
}

void check_reached(const PeriodicOrbit& orbit) {
  if (orbit.monodromy.size() == 0) throw DomainError("an orbit that was not reached has no multipliers");
}

}  // namespace

FloquetMultipliers floquet_multipliers(const PeriodicOrbit& orbit, const PeriodicOrbit& second) {
  check_reached(orbit);
  const MatrixProduct factors = factors_of(orbit);
  FloquetMultipliers result;
  result.values = eigenvalues(factors);
  const std::vector<double> rounding_errors = eigenvalue_errors(factors);
  std::vector<std::complex<double>> others = eigenvalues(factors_of(second));
  for (std::size_t k = 0; k < result.values.size(); ++k) {
    const std::complex<double> value = result.values[k];
    // Each of the second estimate answers for one of the first.
    const auto nearest = std::min_element(others.begin(), others.end(), [&](const auto& a, const auto& b) {
      return std::abs(a - value) < std::abs(b - value);
    });
    result.errors.push_back(nearest == others.end() ? std::numeric_limits<double>::infinity()
                                                    : std::max(std::abs(*nearest - value), rounding_errors[k]));
    if (nearest != others.end()) others.erase(nearest);
  }
  // Equal ones are split by the rounding of the eigenvalue solver at the least.
  constexpr double rounding = 1e-10;
  constexpr double clearly = 10.0;
  for (std::size_t i = 0; i < result.values.size(); ++i) {
    int together = 0;
    for (std::size_t j = 0; j < result.values.size(); ++j)
      together +=
          std::abs(result.values[i] - result.values[j]) <= clearly * (result.errors[i] + result.errors[j]) + rounding
              ? 1
              : 0;
    result.multiplicity.push_back(together);
    if (std::abs(1.0 - std::abs(result.values[i])) < std::abs(result.margin())) result.critical = i;
  }
  return result;
}

double largest_multiplier(const PeriodicOrbit& orbit) {
  check_reached(orbit);
  return std::abs(eigenvalues(factors_of(orbit)).front());
}

std::vector<double> displaced_orbit(integrate::Flow& flow, const PeriodicOrbit& known, int n, int iterations) {
  std::vector<double> y = known.state;
  for (int k = 0; k < iterations; ++k) {
    std::vector<double> end = y;
    flow.forget();
    for (int i = 0; i < n; ++i)
      if (!flow.evolve(end, 0.0, flow.field().period).reached()) return {};
    const Eigen::VectorXd step = solve(known.monodromy, as_vector(end) - as_vector(y));
    for (std::size_t i = 0; i < y.size(); ++i) y[i] += step(static_cast<Eigen::Index>(i));
  }
  return y;
}

}  // namespace epicyclic::analysis
