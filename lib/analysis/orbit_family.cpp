#include "analysis/orbit_family.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "analysis/orbit_system.hpp"
#include "analysis/shooting.hpp"
#include "core/dense.hpp"
#include "core/errors.hpp"
#include "core/require.hpp"
#include "core/text.hpp"
#include "integrate/flow.hpp"

namespace epicyclic::analysis {

namespace {

Eigen::VectorXd scales_of(const OrbitFamily& family) { return Eigen::VectorXd::Constant(1, family.value_scale); }

/// F with its derivatives at a point, by the family's own parameter derivative or by differences.
OrbitShot evaluate(const OrbitFamily& family, const OrbitPlace& z) {
  OrbitShot f;
  f.by_value.push_back(shot_with_parameter(family, {z.states, z.values(0)}, f.shot));
  return f;
}

OrbitPlace place_of(const CurvePoint& z) { return {z.states, Eigen::VectorXd::Constant(1, z.value)}; }
CurvePoint point_of(const OrbitPlace& z) { return {z.states, z.values(0)}; }

/// Newton's method, and the direction of what it finds.
/// @param row    whose component the last equation keeps; null: the parameter itself
/// @param along  the direction goes along with it
Correction iterate(const OrbitFamily& family, const CurvePoint& guess, const CurvePoint* row, const CurvePoint& along) {
  OrbitSystem system(family, scales_of(family), guess.states.rows(),
                     [&](const OrbitPlace& z) { return evaluate(family, z); });
  const OrbitPlace normal = row != nullptr ? place_of(*row) : OrbitPlace{};
  NewtonOutcome newton = system.newton(place_of(guess), {{row != nullptr ? &normal : nullptr}});
  Correction result;
  result.evaluations = newton.evaluations;
  result.distance = newton.distance;
  result.orbit.residual = newton.residual;
  result.message = std::move(newton.message);
  if (!newton.found) return result;
  const OrbitPlace direction = place_of(along);
  const OrbitPlace t = system.tangent(newton.last, {{&direction}}, 0);
  const double norm = system.length(t);
  if (!finite(t) || !(norm > 0.0)) {
    result.message = "the branch has no direction of its own here";
    return result;
  }
  result.orbit.direction = (1.0 / norm) * point_of(t);
  result.orbit.monodromy = newton.last.shot.monodromy();
  result.orbit.at = point_of(newton.at);
  result.found = true;
  return result;
}

}  // namespace

void check_neutral(const OrbitFamily& family, double value, std::span<const double> state) {
  const Eigen::MatrixXd& c = family.neutral;
  if (c.size() == 0) return;
  const auto n = static_cast<Eigen::Index>(state.size());
  if (c.rows() != n)
    throw InputError("neutral directions of " + std::to_string(c.rows()) + " components for states of " +
                     std::to_string(n));
  Eigen::MatrixXd q = c;
  const Eigen::VectorXd r = orthonormalise(q);
  constexpr double dependent = 1e-10;
  if (c.cols() > n || !(r.cwiseAbs().minCoeff() > dependent * c.colwise().norm().maxCoeff()))
    throw InputError("neutral directions depend on each other");
  // Rounding of differences of sums of a few terms, for shifts at least as long as the state's scale.
  constexpr double rounding = 1e-9;
  const Eigen::MatrixXd& s = family.symmetry.map;
  if (s.size() != 0)
    for (const Eigen::MatrixXd& image : {product(s, c), transposed_product(s, c)})
      if (without_shift(family, image).norm() > rounding * c.norm())
        throw InputError("the symmetry does not keep the neutral directions");
  const auto flow = family.flows(value);
  const VectorField& field = flow->field();
  const Eigen::VectorXd y = Eigen::Map<const Eigen::VectorXd>(state.data(), n);
  Eigen::VectorXd here(n), there(n);
  for (Eigen::Index k = 0; k < c.cols(); ++k) {
    constexpr int phases = 8;
    double most = 0.0, changed = 0.0;
    for (int i = 0; i < phases; ++i) {
      const double at = field.period * (i + 0.5) / phases;
      const std::size_t segment = integrate::segment_after(field, at);
      field.right_hand_side(segment, at, y.data(), here.data());
      for (const double shift : {0.7, -3.1, 11.0}) {
        const Eigen::VectorXd shifted =
            y + (shift * family.state_scale / c.col(k).lpNorm<Eigen::Infinity>()) * c.col(k);
        field.right_hand_side(segment, at, shifted.data(), there.data());
        most = std::max(most, here.lpNorm<Eigen::Infinity>());
        changed = std::max(changed, (there - here).lpNorm<Eigen::Infinity>());
      }
    }
    if (!(changed <= rounding * std::max(most, family.state_scale)))
      throw InputError("direction " + std::to_string(k + 1) +
                       " is not neutral: a shift along it changes the field by " + short_text(changed));
  }
}

std::vector<std::complex<double>> multipliers_of(const OrbitFamily& family, const MatrixProduct& monodromy) {
  CyclicSymmetry none;
  none.neutral = family.neutral;
  const auto blocks = invariant_blocks(static_cast<std::size_t>(monodromy.rows()), none);
  return blocks.empty() ? std::vector<std::complex<double>>{} : multipliers_of(blocks.front(), monodromy);
}

Eigen::MatrixXd without_shift(const OrbitFamily& family, const Eigen::MatrixXd& states) {
  if (family.neutral.size() == 0) return states;
  Eigen::MatrixXd q = family.neutral;
  orthonormalise(q);
  return states - product(q, transposed_product(q, states));
}

void OrbitFamily::validate() const {
  require(period >= 1, "period", period, ">= 1");
  require(shooting_intervals >= 1, "shooting_intervals", shooting_intervals, ">= 1");
  require(iterations >= 1, "iterations", iterations, ">= 1");
  require(value_scale > 0.0, "value_scale", value_scale, "> 0");
  require(state_scale > 0.0, "state_scale", state_scale, "> 0");
  require(residual > 0.0, "residual", residual, "> 0");
  require(difference > 0.0, "difference", difference, "> 0");
}

CurvePoint operator+(const CurvePoint& a, const CurvePoint& b) { return {a.states + b.states, a.value + b.value}; }
CurvePoint operator-(const CurvePoint& a, const CurvePoint& b) { return {a.states - b.states, a.value - b.value}; }
CurvePoint operator*(double factor, const CurvePoint& a) { return {factor * a.states, factor * a.value}; }

double inner_product(const OrbitFamily& family, const CurvePoint& a, const CurvePoint& b) {
  return inner_product(family.state_scale, scales_of(family), place_of(a), place_of(b));
}

double length(const OrbitFamily& family, const CurvePoint& a) { return std::sqrt(inner_product(family, a, a)); }

Correction correct(const OrbitFamily& family, const CurvePoint& guess, const CurvePoint& normal) {
  return iterate(family, guess, &normal, normal);
}

Correction correct_at(const OrbitFamily& family, double value, const Eigen::MatrixXd& guess, const CurvePoint* along) {
  const CurvePoint rising{Eigen::MatrixXd::Zero(guess.rows(), guess.cols()), family.value_scale};
  return iterate(family, {guess, value}, nullptr, along != nullptr ? *along : rising);
}

Correction between(const OrbitFamily& family, const BranchOrbit& a, const BranchOrbit& b, double part) {
  const CurvePoint guess =
      cubic_between(a.at, a.direction, b.at, b.direction, inner_product(family, b.at - a.at, a.direction),
                    inner_product(family, b.direction, a.direction), part);
  return correct(family, guess, a.direction);
}

std::optional<CurvePoint> split_into_intervals(const OrbitFamily& family, const Eigen::VectorXd& y, double value) {
  CurvePoint z{Eigen::MatrixXd(y.size(), family.shooting_intervals), value};
  z.states.col(0) = y;
  if (!integrate_to_intervals(*family.flows(value), family.period, z.states).reached()) return std::nullopt;
  z.states = without_shift(family, z.states);
  return z;
}

Correction first_orbit(const OrbitFamily& family, double value, std::span<const double> state) {
  family.validate();
  check_neutral(family, value, state);
  Eigen::MatrixXd y(static_cast<Eigen::Index>(state.size()), family.shooting_intervals);
  std::copy(state.begin(), state.end(), y.data());
  const integrate::Evolution e = integrate_to_intervals(*family.flows(value), family.period, y);
  if (!e.reached()) {
    Correction result;
    result.message = e.message;
    return result;
  }
  return correct_at(family, value, y);
}

}  // namespace epicyclic::analysis
