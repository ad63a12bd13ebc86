#include "analysis/periodic_orbit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Dense>

#include "core/text.hpp"

namespace epicyclic::analysis {

namespace {

Eigen::VectorXd as_vector(std::span<const double> y) {
  return Eigen::Map<const Eigen::VectorXd>(y.data(), static_cast<Eigen::Index>(y.size()));
}

/// (I - M)^-1 r, of least norm where I - M is singular.
Eigen::VectorXd solve(const Eigen::MatrixXd& m, const Eigen::VectorXd& r) {
  const Eigen::MatrixXd a = Eigen::MatrixXd::Identity(m.rows(), m.cols()) - m;
  return a.completeOrthogonalDecomposition().solve(r);
}

}  // namespace

PeriodicOrbit find_periodic_orbit(integrate::Flow& flow, std::span<const double> start, int n,
                                  const OrbitOptions& options) {
  const std::size_t dimension = flow.field().dimension;
  const double period = flow.field().period;
  const auto size = static_cast<Eigen::Index>(dimension);
  PeriodicOrbit orbit;
  orbit.state.assign(start.begin(), start.end());
  std::vector<double> y(start.begin(), start.end());
  double best = std::numeric_limits<double>::infinity();
  for (int k = 0; k < options.iterations; ++k) {
    std::vector<double> end = y;
    std::vector<double> v(dimension * dimension, 0.0);
    for (std::size_t j = 0; j < dimension; ++j) v[j * dimension + j] = 1.0;
    flow.forget();
    for (int i = 0; i < n; ++i) {
      const integrate::Evolution e = flow.evolve_tangents(end, v, 0.0, period);
      if (!e.reached()) {
        orbit.outcome = OrbitOutcome::not_reached;
        orbit.message = e.message;
        return orbit;
      }
    }
    const Eigen::MatrixXd m = Eigen::Map<const Eigen::MatrixXd>(v.data(), size, size);
    const Eigen::VectorXd f = as_vector(end) - as_vector(y);
    const double residual = f.lpNorm<Eigen::Infinity>();
    orbit.residuals.push_back(residual);
    const bool falls = residual < 0.5 * best;
    if (residual < best) {
      best = residual;
      orbit.state = y;
      orbit.monodromy = m;
    }
    if (residual <= options.residual) {
      orbit.outcome = OrbitOutcome::converged;
      return orbit;
    }
    // At the integrator's own noise nothing falls any more.
    if (k > 1 && !falls && best <= std::sqrt(options.residual)) {
      orbit.outcome = OrbitOutcome::stalled;
      orbit.message = "the residual stays at " + short_text(best);
      return orbit;
    }
    // Beside a chaotic motion there is no orbit to be found: four iterations that gain nothing are enough.
    constexpr int patience = 4;
    constexpr double gain = 0.1;
    if (k + 1 >= patience && best > gain * orbit.residuals.front()) break;
    const Eigen::VectorXd step = solve(m, f);
    for (std::size_t i = 0; i < dimension; ++i) y[i] += step(static_cast<Eigen::Index>(i));
  }
  orbit.outcome = best <= std::sqrt(options.residual) ? OrbitOutcome::stalled : OrbitOutcome::not_converged;
  orbit.message =
      "the residual is " + short_text(best) + " after " + std::to_string(options.iterations) + " iterations";
  return orbit;
}

double largest_multiplier(const PeriodicOrbit& orbit) { return orbit.monodromy.eigenvalues().cwiseAbs().maxCoeff(); }

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
