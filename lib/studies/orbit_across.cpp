#include "studies/orbit_across.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>
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
constexpr double farthest = 0.3;    ///< of two orbits [b_c, b_c per tau]: beyond, they need not be one

constexpr double least_step = 1.0 / 64.0;  ///< of the distance of the two values
constexpr int orbits_max = 24;             ///< that are sought between the values
constexpr double near = 0.2;               ///< of a rising multiplier from + 1
constexpr double very_near = 0.05;         ///< of one that was none such before

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

/// A multiplier where the orbit was found.
struct Found {
  double part = 0;
  std::complex<double> multiplier;
};

/// Does the multiplier near + 1, with 1 - mu about the square root of the distance from the place at which the orbit is
/// lost?
/// @param lost  the first part of the distance at which no orbit was found
bool nears_fold(const Found& before, const Found& last, double lost) {
  if (kind_of(last.multiplier) != 1) return false;
  const double distance = 1.0 - last.multiplier.real();
  if (kind_of(before.multiplier) != 1) return distance < very_near;
  const double distance_before = 1.0 - before.multiplier.real();
  if (!(distance < near && distance < distance_before)) return false;
  const double fall = (distance_before * distance_before - distance * distance) / (last.part - before.part);
  return last.part + distance * distance / fall <= lost + (lost - last.part);
}

}  // namespace

std::optional<OrbitAcross> orbit_across(const FieldFamily& field_at, std::span<const double> orbit, int n,
                                        const integrate::IntegratorOptions& integrator) {
  integrate::IntegratorOptions options = integrator;
  options.tangent_error_control = true;
  options.relative_tolerance = std::max(options.relative_tolerance, relative_tolerance);
  options.absolute_tolerance = std::max(options.absolute_tolerance, absolute_tolerance);
  const analysis::OrbitOptions newton{.iterations = 6, .residual = residual};
  const auto orbit_at = [&](double part, std::span<const double> start) {
    const auto flow = make_flow_of_one_trajectory(field_at(part), options);
    return analysis::find_periodic_orbit(*flow, start, n, newton);
  };
  analysis::PeriodicOrbit last = orbit_at(0.0, orbit);
  if (!last.found()) return std::nullopt;
  OrbitAcross across;
  across.here = across.there = multipliers_of(last.monodromy).front();
  Found before{0.0, across.here};
  double lost = std::numeric_limits<double>::infinity();
  double step = 1.0;
  for (int k = 0; k < orbits_max && step >= least_step; ++k) {
    const double part = std::min(across.part + step, 1.0);
    analysis::PeriodicOrbit next = orbit_at(part, last.state);
    const bool is_near = next.found() && largest_difference(last.state, next.state) <= farthest;
    if (!is_near) {
      if (!next.found()) lost = part;
      step *= 0.5;
      continue;
    }
    last = std::move(next);
    before = {across.part, across.there};
    const auto multipliers = multipliers_of(last.monodromy);
    across.there = multipliers.front();
    across.part = part;
    across.one_kind = true;
    for (const auto& multiplier : multipliers)
      if (std::abs(multiplier) > 1.0 + neutral) {
        ++across.unstable;
        across.one_kind = across.one_kind && kind_of(multiplier) == kind_of(multipliers.front());
      }
    across.found = part == 1.0 || across.unstable > 0;
    if (across.found) return across;
    if (part + step >= lost) step *= 0.5;
  }
  across.fold = std::isfinite(lost) && nears_fold(before, {across.part, across.there}, lost);
  return across;
}

}  // namespace epicyclic::studies
