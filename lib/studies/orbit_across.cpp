#include "studies/orbit_across.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <vector>

#include <Eigen/Eigenvalues>

#include "analysis/periodic_orbit.hpp"
#include "core/largest_difference.hpp"
#include "studies/classification.hpp"

namespace epicyclic::studies {

namespace {

/// Enough for four digits of a multiplier.
constexpr double relative_tolerance = 1e-7;
constexpr double absolute_tolerance = 1e-9;  // [b_c, b_c per tau]
constexpr double residual = 1e-7;            // [b_c, b_c per tau]

constexpr double neutral = 1e-6;    ///< a modulus this near to 1 is on neither side
constexpr double real_part = 1e-6;  ///< an imaginary part below this part of the modulus is none
constexpr double farthest = 0.3;    ///< of the two orbits [b_c, b_c per tau]: beyond, they need not be one

/// The one of largest modulus first; of a pair the one above the real axis.
std::vector<std::complex<double>> multipliers_of(const Eigen::MatrixXd& monodromy) {
  const Eigen::VectorXcd values = monodromy.eigenvalues();
  std::vector<std::complex<double>> all(values.begin(), values.end());
  std::ranges::sort(all, std::ranges::greater(), [](const auto& one) { return std::abs(one); });
  if (all.front().imag() < 0.0) all.front() = std::conj(all.front());
  return all;
}

/// 0: a complex pair; -1, 1: real of this sign.
int kind_of(const std::complex<double>& multiplier) {
  if (std::abs(multiplier.imag()) > real_part * std::abs(multiplier)) return 0;
  return multiplier.real() < 0.0 ? -1 : 1;
}

}  // namespace

std::optional<OrbitAcross> orbit_across(const VectorField& here, const VectorField& there,
                                        std::span<const double> orbit, int n,
                                        const integrate::IntegratorOptions& integrator) {
  integrate::IntegratorOptions options = integrator;
  options.tangent_error_control = true;
  options.relative_tolerance = std::max(options.relative_tolerance, relative_tolerance);
  options.absolute_tolerance = std::max(options.absolute_tolerance, absolute_tolerance);
  const analysis::OrbitOptions newton{.iterations = 6, .residual = residual};
  const auto first_flow = make_flow_of_one_trajectory(here, options);
  const analysis::PeriodicOrbit first = analysis::find_periodic_orbit(*first_flow, orbit, n, newton);
  if (!first.found()) return std::nullopt;
  OrbitAcross across;
  across.here = multipliers_of(first.monodromy).front();
  const auto second_flow = make_flow_of_one_trajectory(there, options);
  const analysis::PeriodicOrbit second = analysis::find_periodic_orbit(*second_flow, first.state, n, newton);
  if (!second.found() || largest_difference(first.state, second.state) > farthest) return across;
  const auto multipliers = multipliers_of(second.monodromy);
  across.found = true;
  across.there = multipliers.front();
  across.one_kind = true;
  for (const auto& multiplier : multipliers)
    if (std::abs(multiplier) > 1.0 + neutral) {
      ++across.unstable;
      across.one_kind = across.one_kind && kind_of(multiplier) == kind_of(multipliers.front());
    }
  return across;
}

}  // namespace epicyclic::studies
