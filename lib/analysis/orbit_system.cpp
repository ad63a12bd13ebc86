#include "analysis/orbit_system.hpp"

#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "core/dense.hpp"
#include "core/errors.hpp"
#include "core/text.hpp"

namespace epicyclic::analysis {

Eigen::MatrixXd kept_states(const OrbitFamily& family, Eigen::Index dimension) {
  if (family.kept().map.size() == 0 && family.neutral.size() == 0)
    return Eigen::MatrixXd::Identity(dimension, dimension);
  return invariant_blocks(static_cast<std::size_t>(dimension), family.kept()).front().basis.real();
}

OrbitPlace operator+(const OrbitPlace& a, const OrbitPlace& b) { return {a.states + b.states, a.values + b.values}; }
OrbitPlace operator-(const OrbitPlace& a, const OrbitPlace& b) { return {a.states - b.states, a.values - b.values}; }
OrbitPlace operator*(double factor, const OrbitPlace& a) { return {factor * a.states, factor * a.values}; }

bool finite(const OrbitPlace& z) { return z.states.allFinite() && z.values.allFinite(); }

double inner_product(double state_scale, const Eigen::VectorXd& scales, const OrbitPlace& a, const OrbitPlace& b) {
  if (a.states.rows() != b.states.rows() || a.states.cols() != b.states.cols())
    throw DomainError("orbits of different subdivisions have no inner product");
  double product =
      a.states.cwiseProduct(b.states).sum() / (static_cast<double>(a.states.size()) * state_scale * state_scale);
  for (Eigen::Index k = 0; k < scales.size(); ++k) product += a.values(k) * b.values(k) / (scales(k) * scales(k));
  return product;
}

Eigen::MatrixXd shot_with_parameter(const OrbitFamily& family, const CurvePoint& z, Shot& shot) {
  const auto flow = family.flows(z.value);
  if (flow->field().parameter_derivative) {
    shot = shoot(*flow, z.states, family.period, integrate::LastTangent::parameter);
    return shot.parameter;
  }
  shot = shoot(*flow, z.states, family.period);
  if (!shot.evolution.reached()) return {};
  return parameter_difference(family.flows, z.states, z.value, family.difference * family.value_scale, family.period,
                              shot);
}

Eigen::MatrixXd parameter_difference(const integrate::FlowFamily& flows, const Eigen::MatrixXd& states, double value,
                                     double step, int period, Shot& shot) {
  const Shot above = shoot_states(*flows(value + step), states, period);
  const Shot below = shoot_states(*flows(value - step), states, period);
  if (above.evolution.reached() && below.evolution.reached()) return (above.residual - below.residual) / (2.0 * step);
  if (above.evolution.reached()) return (above.residual - shot.residual) / step;
  shot.evolution = below.evolution;
  return (shot.residual - below.residual) / step;
}

OrbitSystem::OrbitSystem(const OrbitFamily& family, Eigen::VectorXd scales, Eigen::Index dimension, Evaluate evaluate)
    : family_(family),
      scales_(std::move(scales)),
      evaluate_(std::move(evaluate)),
      kept_(kept_states(family, dimension)),
      shooting_intervals_(family.shooting_intervals) {}

double OrbitSystem::weight() const {
  return 1.0 / (static_cast<double>(shooting_intervals_ * kept_.rows()) * family_.state_scale * family_.state_scale);
}

double OrbitSystem::inner(const OrbitPlace& a, const OrbitPlace& b) const {
  return inner_product(family_.state_scale, scales_, a, b);
}

double OrbitSystem::length(const OrbitPlace& a) const { return std::sqrt(inner(a, a)); }

void OrbitSystem::set(const OrbitShot& shot, const std::vector<ClosingRow>& rows) {
  const Eigen::Index m = kept_.cols();
  const Eigen::Index first = m * shooting_intervals_;
  const Eigen::Index values = scales_.size();
  matrix_.setZero(first + static_cast<Eigen::Index>(rows.size()), first + values);
  for (Eigen::Index i = 0; i < shooting_intervals_; ++i) {
    matrix_.block(i * m, i * m, m, m) =
        product(transposed_product(kept_, shot.shot.interval_maps[static_cast<std::size_t>(i)]), kept_);
    matrix_.block(i * m, (i + 1) % shooting_intervals_ * m, m, m) -= Eigen::MatrixXd::Identity(m, m);
    // Parameters in units of their scales, as their rows.
    for (Eigen::Index k = 0; k < values; ++k)
      matrix_.block(i * m, first + k, m, 1) =
          kept_.transpose() * shot.by_value[static_cast<std::size_t>(k)].col(i) * scales_(k);
  }
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const Eigen::Index at = first + static_cast<Eigen::Index>(r);
    const OrbitPlace* along = rows[r].along;
    if (along == nullptr) {
      matrix_(at, first + rows[r].value) = 1.0;
      continue;
    }
    for (Eigen::Index i = 0; i < shooting_intervals_; ++i)
      matrix_.block(at, i * m, 1, m) = weight() * along->states.col(i).transpose() * kept_;
    for (Eigen::Index k = 0; k < values; ++k) matrix_(at, first + k) = along->values(k) / scales_(k);
  }
}

OrbitPlace OrbitSystem::place_of(const Eigen::VectorXd& c) const {
  const Eigen::Index m = kept_.cols();
  OrbitPlace z{Eigen::MatrixXd(kept_.rows(), shooting_intervals_), c.tail(scales_.size()).cwiseProduct(scales_)};
  for (Eigen::Index i = 0; i < shooting_intervals_; ++i) z.states.col(i) = kept_ * c.segment(i * m, m);
  return z;
}

OrbitPlace OrbitSystem::solve(const Eigen::MatrixXd& r, const Eigen::VectorXd& last) const {
  const Eigen::Index m = kept_.cols();
  Eigen::VectorXd b(m * shooting_intervals_ + last.size());
  for (Eigen::Index i = 0; i < shooting_intervals_; ++i) b.segment(i * m, m) = kept_.transpose() * r.col(i);
  b.tail(last.size()) = last;
  return place_of(solution(matrix_, b));
}

OrbitPlace OrbitSystem::tangent(const OrbitShot& shot, const std::vector<ClosingRow>& rows, Eigen::Index row) {
  set(shot, rows);
  return solve(Eigen::MatrixXd::Zero(kept_.rows(), shooting_intervals_), Eigen::VectorXd::Unit(scales_.size(), row));
}

std::vector<OrbitPlace> OrbitSystem::tangents(const OrbitShot& shot) {
  set(shot, {});
  // In coordinates whose plain product is that of lengths.
  const Eigen::Index states = kept_.cols() * shooting_intervals_;
  matrix_.leftCols(states) /= std::sqrt(weight());
  Eigen::MatrixXd all = null_space(matrix_).rightCols(scales_.size());
  all.topRows(states) /= std::sqrt(weight());
  std::vector<OrbitPlace> places;
  for (Eigen::Index k = 0; k < all.cols(); ++k) places.push_back(place_of(all.col(k)));
  return places;
}

NewtonOutcome OrbitSystem::newton(OrbitPlace z, const std::vector<ClosingRow>& rows) {
  NewtonOutcome result;
  z.states = product(kept_, transposed_product(kept_, z.states));  // the nearest of the kept states
  const OrbitPlace guess = z;
  const Eigen::VectorXd unchanged = Eigen::VectorXd::Zero(scales_.size());
  double before = std::numeric_limits<double>::infinity();
  double stepped = std::numeric_limits<double>::infinity();
  for (int k = 0; k < family_.iterations; ++k) {
    OrbitShot shot = evaluate_(z);
    ++result.evaluations;
    if (!shot.shot.evolution.reached()) {
      result.message = shot.shot.evolution.message;
      return result;
    }
    const double residual = without_shift(family_, shot.shot.residual).lpNorm<Eigen::Infinity>();
    if (!std::isfinite(residual)) break;
    result.residual = residual;
    result.distance = length(z - guess);
    // At the integrator's own noise nothing falls any more, and what is left to go is small.
    constexpr double gain = 0.5;
    const bool falls = residual <= gain * before;
    set(shot, rows);
    const OrbitPlace step = solve(-shot.shot.residual, unchanged);
    if (residual <= family_.residual || (!falls && stepped <= family_.known)) {
      // The derivatives are there: the last step costs no evaluation, and leaves the square of what it takes away.
      if (finite(step)) z = z + step;
      result.at = std::move(z);
      result.last = std::move(shot);
      result.found = true;
      return result;
    }
    // Two iterations that gain nothing: the guess is too far.
    if (k > 1 && !falls) break;
    if (k > 0) before = residual;
    if (!finite(step)) break;
    stepped = length(step);
    z = z + step;
  }
  result.message =
      "the residual is " + short_text(result.residual) + " after " + std::to_string(result.evaluations) + " iterations";
  return result;
}

}  // namespace epicyclic::analysis
