#include "analysis/branch_switching.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

#include "analysis/shooting.hpp"
#include "core/dense.hpp"
#include "core/require.hpp"

namespace epicyclic::analysis {

namespace {

/// Real directions of y_0 in which orbits may leave.
std::vector<Eigen::VectorXd> directions(const OrbitFamily& family, const SpecialPoint& point, int angles) {
  const MatrixProduct& m = point.orbit.monodromy;
  const auto blocks = invariant_blocks(static_cast<std::size_t>(m.rows()), family.kept());
  const InvariantBlock* block = nullptr;
  for (const InvariantBlock& b : blocks)
    if (b.symmetry_index == point.symmetry_index) block = &b;
  if (block == nullptr) return {};
  const double at = point.kind == SpecialKind::period_doubling ? -1.0 : 1.0;
  std::vector<Eigen::VectorXd> all;
  if (point.nullity == 2 && block->real) {
    const MatrixProduct b = real_block_of(*block, m);
    const Eigen::MatrixXd two = singular_values(b.cyclic(at)).v.rightCols(2).topRows(b.rows());
    const Eigen::MatrixXd plane = product(block->basis.real(), two);
    for (int k = 0; k < angles; ++k) {
      const double angle = std::numbers::pi * k / angles;
      all.push_back((plane * Eigen::Vector2d(std::cos(angle), std::sin(angle))).normalized());
    }
    return all;
  }
  const Eigen::VectorXcd v = block->basis * right_null_vector(block_of(*block, m).cyclic(at)).head(block->basis.cols());
  // For a real block, v is real up to a factor of modulus 1.
  Eigen::Index largest = 0;
  v.cwiseAbs().maxCoeff(&largest);
  const std::complex<double> phase_factor = std::conj(v(largest)) / std::abs(v(largest));
  if (block->real) return {(phase_factor * v).real()};
  for (int k = 0; k < angles; ++k)
    all.emplace_back((std::polar(1.0, std::numbers::pi * k / angles) * phase_factor * v).real());
  return all;
}

/// The derivative of the states at all shooting intervals with respect to y_0, along v; v is small.
std::optional<CurvePoint> direction_at_intervals(const OrbitFamily& family, const CurvePoint& z,
                                                 const Eigen::VectorXd& v) {
  constexpr double little = 1e-5;
  const auto ahead = split_into_intervals(family, z.states.col(0) + little * v, z.value);
  const auto behind = split_into_intervals(family, z.states.col(0) - little * v, z.value);
  if (!ahead || !behind) return std::nullopt;
  return (0.5 / little) * (*ahead - *behind);
}

/// The unit direction from z that an orbit displaced by v takes, without its part along the branch of the point.
std::optional<CurvePoint> direction_across(const OrbitFamily& other, const SpecialPoint& point, const CurvePoint& z,
                                           const Eigen::VectorXd& v) {
  std::optional<CurvePoint> away = direction_at_intervals(other, z, v);
  if (!away) return std::nullopt;
  if (point.kind != SpecialKind::period_doubling) {
    const BranchOrbit& orbit = point.orbit;
    const std::optional<CurvePoint> along =
        split_into_intervals(other, orbit.at.states.col(0) + 1e-5 * orbit.direction.states.col(0),
                             point.value + 1e-5 * orbit.direction.value);
    if (!along) return std::nullopt;
    const CurvePoint t = 1e5 * (*along - z);
    *away = *away - (inner_product(other, *away, t) / inner_product(other, t, t)) * t;
  }
  return (1.0 / length(other, *away)) * *away;
}

/// An orbit of the branch that leaves `base` along the normal.
Correction orbit_beside(const OrbitFamily& other, const CurvePoint& base, const CurvePoint& normal,
                        const SwitchOptions& options, bool in_plane) {
  const auto at = [&](double distance) { return correct(other, base + distance * normal, normal); };
  Correction c = at(options.distance);
  // A step could pass a fold that is nearer than that: at the fold the parameter reverses.
  double distance = options.distance;
  constexpr int nearer_ones = 4;
  for (int k = 0; k < nearer_ones && c.found; ++k) {
    distance *= 0.25;
    Correction nearer = at(distance);
    if (!nearer.found || nearer.orbit.direction.value * c.orbit.direction.value > 0.0) break;
    c = std::move(nearer);
  }
  // A branch that leaves in another direction of the plane is seen from several of those tried. Each is taken at the
  // same distance along its own direction, so that it is known again.
  constexpr int times = 3;
  for (int k = 0; k < times && in_plane && c.found; ++k) {
    const CurvePoint own = c.orbit.at - base;
    const CurvePoint direction = (1.0 / length(other, own)) * own;
    c = correct(other, base + options.distance * direction, direction);
  }
  return c;
}

}  // namespace

void SwitchOptions::validate() const {
  require(distance > 0.0, "distance", distance, "> 0");
  require(angles >= 1, "angles", angles, ">= 1");
  require(same > 0.0, "same", same, "> 0");
}

Eigen::MatrixXd period_states(const OrbitFamily& family, const CurvePoint& at) {
  Eigen::MatrixXd y(at.states.rows(), family.period);
  // One shooting interval per period: the intervals begin where the periods do.
  y.col(0) = at.states.col(0);
  if (!integrate_to_intervals(*family.flows(at.value), family.period, y).reached())
    return Eigen::MatrixXd(at.states.rows(), 0);
  return without_shift(family, y);
}

double distance_to_simpler(const OrbitFamily& family, const CurvePoint& at) {
  double least = std::numeric_limits<double>::infinity();
  const bool breaks = family.symmetry.map.size() != 0 && !family.keeps_symmetry;
  if (family.period == 1 && !breaks) return least;
  const Eigen::MatrixXd states = period_states(family, at);
  const Eigen::Index n = states.cols();
  for (Eigen::Index shorter = 1; shorter < n; ++shorter)
    if (n % shorter == 0)
      least = std::min(least, (states.leftCols(n - shorter) - states.rightCols(n - shorter)).lpNorm<Eigen::Infinity>());
  if (breaks && n > 0)
    least = std::min(least, (product(family.symmetry.map, states) - states).lpNorm<Eigen::Infinity>());
  return least;
}

double image_distance(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b, const CyclicSymmetry& symmetry) {
  double least = std::numeric_limits<double>::infinity();
  if (a.cols() != b.cols() || a.cols() == 0) return least;
  const Eigen::Index n = a.cols();
  Eigen::MatrixXd rotated = b;
  for (int rotation = 0; rotation < symmetry.order; ++rotation) {
    for (Eigen::Index shift = 0; shift < n; ++shift) {
      double most = 0.0;
      for (Eigen::Index k = 0; k < n; ++k)
        most = std::max(most, (a.col(k) - rotated.col((k + shift) % n)).lpNorm<Eigen::Infinity>());
      least = std::min(least, most);
    }
    if (symmetry.map.size() != 0) rotated = product(symmetry.map, rotated);
  }
  return least;
}

bool are_images(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b, const CyclicSymmetry& symmetry, double difference) {
  return image_distance(a, b, symmetry) <= difference;
}

int least_period(const Eigen::MatrixXd& states, double difference) {
  const Eigen::Index n = states.cols();
  for (Eigen::Index least = 1; least < n; ++least)
    if (n % least == 0 &&
        (states.leftCols(n - least) - states.rightCols(n - least)).lpNorm<Eigen::Infinity>() <= difference)
      return static_cast<int>(least);
  return static_cast<int>(n);
}

std::vector<BranchSwitch> branch_switches(const OrbitFamily& family, const SpecialPoint& point,
                                          const SwitchOptions& options) {
  options.validate();
  const bool period_doubling = point.kind == SpecialKind::period_doubling;
  if (!period_doubling && point.kind != SpecialKind::branch_point) return {};
  OrbitFamily other = family;
  if (period_doubling) other.period *= 2;
  if (period_doubling) other.shooting_intervals *= 2;
  if (point.symmetry_index != 0) other.keeps_symmetry = false;
  std::vector<BranchSwitch> found;
  std::vector<Eigen::MatrixXd> seen;
  for (const Eigen::VectorXd& v : directions(family, point, options.angles)) {
    const std::optional<CurvePoint> base = split_into_intervals(other, point.orbit.at.states.col(0), point.value);
    if (!base) return found;
    const std::optional<CurvePoint> unit = direction_across(other, point, *base, v);
    if (!unit) continue;
    for (const double sign : {1.0, -1.0}) {
      const CurvePoint normal = sign * *unit;
      Correction c = orbit_beside(other, *base, normal, options, point.nullity > 1);
      if (!c.found) continue;
      const Eigen::MatrixXd states = period_states(other, c.orbit.at);
      const double difference = options.same * options.distance * family.state_scale;
      bool known = states.cols() == 0;
      for (const Eigen::MatrixXd& s : seen) known = known || are_images(s, states, family.symmetry, difference);
      // Newton's method may lead back to the branch that it came from.
      if (period_doubling) {
        const Eigen::Index n = family.period;
        known = known || (states.leftCols(n) - states.rightCols(n)).lpNorm<Eigen::Infinity>() <= difference;
      }
      if (known) continue;
      seen.push_back(states);
      MatrixProduct monodromy = point.orbit.monodromy;
      if (period_doubling)
        for (const Eigen::MatrixXd& again : point.orbit.monodromy.factors) monodromy.factors.push_back(again);
      found.push_back({other, {*base, normal, std::move(monodromy), 0.0}, std::move(c.orbit)});
    }
  }
  return found;
}

}  // namespace epicyclic::analysis
