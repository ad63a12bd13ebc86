#include "analysis/orbit_family.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "analysis/shooting.hpp"
#include "core/dense.hpp"
#include "core/errors.hpp"
#include "core/require.hpp"
#include "core/text.hpp"

namespace epicyclic::analysis {

namespace {

/// F with its derivatives at a point, by the family's own parameter derivative or by differences.
Shot evaluate(const OrbitFamily& family, const CurvePoint& z) {
  const auto flow = family.flows(z.value);
  if (flow->field().parameter_derivative)
    return shoot(*flow, z.states, family.period, integrate::LastTangent::parameter);
  Shot shot = shoot(*flow, z.states, family.period);
  if (!shot.evolution.reached()) return shot;
  const double h = family.difference * family.value_scale;
  const Shot above = shoot_states(*family.flows(z.value + h), z.states, family.period);
  const Shot below = shoot_states(*family.flows(z.value - h), z.states, family.period);
  if (above.evolution.reached() && below.evolution.reached()) {
    shot.parameter = (above.residual - below.residual) / (2.0 * h);
  } else if (above.evolution.reached()) {
    shot.parameter = (above.residual - shot.residual) / h;
  } else {
    shot.parameter = (shot.residual - below.residual) / h;
    shot.evolution = below.evolution;
  }
  return shot;
}

/// F_z with a last row, in the coordinates c of kept_states() and the parameter.
class System {
 public:
  System(const OrbitFamily& family, Eigen::Index dimension)
      : family_(family), kept_(kept_states(family, dimension)), pieces_(family.pieces) {}

  /// @param row  direction of which the last equation tells the component [A-length]; nothing: the parameter itself
  void set(const Shot& shot, const CurvePoint* row) {
    const Eigen::Index m = kept_.cols();
    const Eigen::Index last = m * pieces_;
    matrix_.setZero(last + 1, last + 1);
    for (Eigen::Index i = 0; i < pieces_; ++i) {
      matrix_.block(i * m, i * m, m, m) = kept_.transpose() * shot.pieces[static_cast<std::size_t>(i)] * kept_;
      matrix_.block(i * m, (i + 1) % pieces_ * m, m, m) -= Eigen::MatrixXd::Identity(m, m);
      // The parameter in units of its scale, as its row.
      matrix_.block(i * m, last, m, 1) = kept_.transpose() * shot.parameter.col(i) * family_.value_scale;
      if (row != nullptr) matrix_.block(last, i * m, 1, m) = weight() * row->states.col(i).transpose() * kept_;
    }
    matrix_(last, last) = row != nullptr ? row->value / family_.value_scale : 1.0;
  }

  /// z with F_z z = r, and the last row's right-hand side.
  /// @param r  a column per piece
  [[nodiscard]] CurvePoint solve(const Eigen::MatrixXd& r, double last) const {
    const Eigen::Index m = kept_.cols();
    Eigen::VectorXd b(m * pieces_ + 1);
    for (Eigen::Index i = 0; i < pieces_; ++i) b.segment(i * m, m) = kept_.transpose() * r.col(i);
    b(m * pieces_) = last;
    const Eigen::VectorXd c = solution(matrix_, b);
    CurvePoint z{Eigen::MatrixXd(kept_.rows(), pieces_), c(m * pieces_) * family_.value_scale};
    for (Eigen::Index i = 0; i < pieces_; ++i) z.states.col(i) = kept_ * c.segment(i * m, m);
    return z;
  }

  /// The nearest of the kept states.
  [[nodiscard]] Eigen::MatrixXd keep(const Eigen::MatrixXd& states) const {
    return kept_ * (kept_.transpose() * states);
  }

 private:
  [[nodiscard]] double weight() const {
    return 1.0 / (static_cast<double>(pieces_ * kept_.rows()) * family_.state_scale * family_.state_scale);
  }

  const OrbitFamily& family_;
  Eigen::MatrixXd kept_;
  Eigen::Index pieces_;
  Eigen::MatrixXd matrix_;
};

bool finite(const CurvePoint& z) { return z.states.allFinite() && std::isfinite(z.value); }

/// Newton's method, and the direction of what it finds.
/// @param row    as of System::set(): the last equation keeps its component
/// @param along  the direction goes along with it
Correction iterate(const OrbitFamily& family, CurvePoint z, const CurvePoint* row, const CurvePoint& along) {
  Correction result;
  System system(family, z.states.rows());
  z.states = system.keep(z.states);
  const CurvePoint guess = z;
  double before = std::numeric_limits<double>::infinity();
  double stepped = std::numeric_limits<double>::infinity();
  for (int k = 0; k < family.iterations; ++k) {
    const Shot shot = evaluate(family, z);
    ++result.evaluations;
    if (!shot.evolution.reached()) {
      result.message = shot.evolution.message;
      return result;
    }
    const double residual = shot.residual.lpNorm<Eigen::Infinity>();
    if (!std::isfinite(residual)) break;
    result.orbit.residual = residual;
    result.distance = length(family, z - guess);
    // At the integrator's own noise nothing falls any more, and what is left to go is small.
    constexpr double gain = 0.5;
    const bool falls = residual <= gain * before;
    if (residual <= family.residual || (!falls && stepped <= family.known)) {
      // The derivatives are there: the last step costs no evaluation, and leaves the square of what it takes away.
      system.set(shot, row);
      const CurvePoint last = system.solve(-shot.residual, 0.0);
      if (finite(last)) z = z + last;
      system.set(shot, &along);
      const CurvePoint t = system.solve(Eigen::MatrixXd::Zero(z.states.rows(), z.states.cols()), 1.0);
      const double norm = length(family, t);
      if (!finite(t) || !(norm > 0.0)) {
        result.message = "the branch has no direction of its own here";
        return result;
      }
      result.orbit.direction = (1.0 / norm) * t;
      result.orbit.monodromy = shot.monodromy();
      result.orbit.at = std::move(z);
      result.found = true;
      return result;
    }
    // Two iterations that gain nothing: the guess is too far.
    if (k > 1 && !falls) break;
    if (k > 0) before = residual;
    system.set(shot, row);
    const CurvePoint step = system.solve(-shot.residual, 0.0);
    if (!finite(step)) break;
    stepped = length(family, step);
    z = z + step;
  }
  result.message = "the residual is " + short_text(result.orbit.residual) + " after " +
                   std::to_string(result.evaluations) + " iterations";
  return result;
}

}  // namespace

void OrbitFamily::validate() const {
  require(period >= 1, "period", period, ">= 1");
  require(pieces >= 1, "pieces", pieces, ">= 1");
  require(iterations >= 1, "iterations", iterations, ">= 1");
  require(value_scale > 0.0, "value_scale", value_scale, "> 0");
  require(state_scale > 0.0, "state_scale", state_scale, "> 0");
  require(residual > 0.0, "residual", residual, "> 0");
  require(difference > 0.0, "difference", difference, "> 0");
}

Eigen::MatrixXd kept_states(const OrbitFamily& family, Eigen::Index dimension) {
  if (family.kept().map.size() == 0) return Eigen::MatrixXd::Identity(dimension, dimension);
  return invariant_blocks(static_cast<std::size_t>(dimension), family.kept()).front().basis.real();
}

CurvePoint operator+(const CurvePoint& a, const CurvePoint& b) { return {a.states + b.states, a.value + b.value}; }
CurvePoint operator-(const CurvePoint& a, const CurvePoint& b) { return {a.states - b.states, a.value - b.value}; }
CurvePoint operator*(double factor, const CurvePoint& a) { return {factor * a.states, factor * a.value}; }

double inner_product(const OrbitFamily& family, const CurvePoint& a, const CurvePoint& b) {
  if (a.states.rows() != b.states.rows() || a.states.cols() != b.states.cols())
    throw DomainError("orbits of different subdivisions have no inner product");
  const double states = a.states.cwiseProduct(b.states).sum();
  return states / (static_cast<double>(a.states.size()) * family.state_scale * family.state_scale) +
         a.value * b.value / (family.value_scale * family.value_scale);
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
  // The cubic through both with their directions; its parameter is the length along a's.
  const CurvePoint chord = b.at - a.at;
  const double h = inner_product(family, chord, a.direction);
  const double along_b = inner_product(family, b.direction, a.direction);
  const CurvePoint slope_b = (h / along_b) * b.direction;
  const CurvePoint slope_a = h * a.direction;
  const double x = part;
  const CurvePoint guess =
      a.at + (x * x * (3.0 - 2.0 * x)) * chord + (x * (1.0 - x) * (1.0 - x)) * slope_a + (x * x * (x - 1.0)) * slope_b;
  return correct(family, guess, a.direction);
}

std::optional<CurvePoint> cut_into_pieces(const OrbitFamily& family, const Eigen::VectorXd& y, double value) {
  CurvePoint z{Eigen::MatrixXd(y.size(), family.pieces), value};
  z.states.col(0) = y;
  if (!carry_to_pieces(*family.flows(value), family.period, z.states).reached()) return std::nullopt;
  return z;
}

Correction first_orbit(const OrbitFamily& family, double value, std::span<const double> state) {
  family.validate();
  Eigen::MatrixXd y(static_cast<Eigen::Index>(state.size()), family.pieces);
  std::copy(state.begin(), state.end(), y.data());
  const integrate::Evolution e = carry_to_pieces(*family.flows(value), family.period, y);
  if (!e.reached()) {
    Correction result;
    result.message = e.message;
    return result;
  }
  return correct_at(family, value, y);
}

}  // namespace epicyclic::analysis
