#include "analysis/continuation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/errors.hpp"
#include "core/require.hpp"
#include "core/text.hpp"

namespace epicyclic::analysis {

namespace {

double angle(const OrbitFamily& family, const BranchOrbit& a, const BranchOrbit& b) {
  return std::acos(std::clamp(inner_product(family, a.direction, b.direction), -1.0, 1.0));
}

}  // namespace

void ContinuationOptions::validate() const {
  require(from < to, "to", to, "> from");
  require(min_step > 0.0, "min_step", min_step, "> 0");
  require(first_step >= min_step, "first_step", first_step, ">= min_step");
  require(max_step >= first_step, "max_step", max_step, ">= first_step");
  require(max_tangent_angle > 0.0, "turn", max_tangent_angle, "> 0");
  require(multiplier_change > 0.0, "multiplier_change", multiplier_change, "> 0");
  require(predictor_tolerance > 0.0, "guess_distance", predictor_tolerance, "> 0");
  require(orbits >= 1, "orbits", static_cast<double>(orbits), ">= 1");
}

double multiplier_change(const std::vector<std::complex<double>>& a, const std::vector<std::complex<double>>& b) {
  double most = 0.0;
  std::vector<std::complex<double>> left = b;
  for (const auto& x : a) {
    if (left.empty()) break;
    const auto nearest = std::min_element(
        left.begin(), left.end(), [&](const auto& p, const auto& q) { return std::abs(p - x) < std::abs(q - x); });
    constexpr double near = 2.0;
    const auto is_near = [](double modulus) { return modulus > 1.0 / near && modulus < near; };
    if (is_near(std::abs(x)) || is_near(std::abs(*nearest))) most = std::max(most, std::abs(*nearest - x));
    left.erase(nearest);
  }
  return most;
}

double multiplier_change(const std::vector<InvariantBlock>& blocks, const MatrixProduct& a, const MatrixProduct& b) {
  double moved = 0.0;
  for (const InvariantBlock& block : blocks)
    moved = std::max(moved, multiplier_change(multipliers_of(block, a), multipliers_of(block, b)));
  return moved;
}

StepVerdict judge_step(const ContinuationOptions& options, double step, double angle, double distance, double moved) {
  // A step may exceed the angle of the options by a factor of two.
  const double rotated = angle / (2.0 * options.max_tangent_angle);
  const double missed = distance / (options.predictor_tolerance * step);
  const double jumped = moved / options.multiplier_change;
  StepVerdict verdict;
  verdict.good = std::max({rotated, missed, jumped}) <= 1.0;
  verdict.reason = rotated > 1.0  ? "the tangent of the branch rotates too far"
                   : missed > 1.0 ? "the predictor is too far from the orbit"
                                  : "a multiplier jumps";
  // Half of each is where the next step goes to; a guess of second order misses by the third power.
  verdict.grow =
      std::min({0.5 / std::max(rotated, 1e-3), std::cbrt(0.3 / std::max(missed, 1e-3)), 0.7 / std::max(jumped, 1e-3)});
  return verdict;
}

Continuation::Continuation(OrbitFamily family, const ContinuationOptions& options, BranchOrbit start)
    : family_(std::move(family)), options_(options), start_(std::move(start)) {
  family_.validate();
  options_.validate();
  if (!(start_.at.value >= options_.from && start_.at.value <= options_.to))
    throw InputError("the branch starts at " + short_text(start_.at.value) + ", outside its range");
  blocks_ = invariant_blocks(static_cast<std::size_t>(start_.at.states.rows()), family_.kept());
  before_ = state_.now = start_;
  state_.tangent_derivative = 0.0 * start_.at;
  state_.step = options_.first_step;
}

CurvePoint Continuation::guess(double step) const {
  return state_.now.at + step * state_.now.direction + (0.5 * step * step) * state_.tangent_derivative;
}

bool Continuation::accept(const Correction& c, double step) {
  if (!c.found) {
    state_.message = c.message;
    return false;
  }
  StepVerdict verdict = judge_step(options_, step, angle(family_, state_.now, c.orbit), c.distance,
                                   multiplier_change(blocks_, state_.now.monodromy, c.orbit.monodromy));
  state_.message = std::move(verdict.reason);
  grow_ = verdict.grow;
  return verdict.good;
}

bool Continuation::back_at_the_start(const BranchOrbit& next, double step) const {
  if (!state_.left_start) return false;
  // Between this orbit and the next, with the same direction.
  const CurvePoint to_start = start_.at - state_.now.at;
  const double ahead = inner_product(family_, to_start, state_.now.direction);
  if (ahead < 0.0 || ahead > step || inner_product(family_, next.direction, start_.direction) < 0.0) return false;
  if (length(family_, to_start) > 2.0 * step) return false;
  const Correction c = correct(family_, guess(ahead), state_.now.direction);
  // Equal points of one branch: to the corrector's own accuracy, in parts of a step.
  constexpr double same = 1e-3;
  return c.found && length(family_, c.orbit.at - start_.at) < same * step;
}

/// The first requested value between the current value and another one. The ends of the range are among the requested
/// values.
std::optional<double> Continuation::wanted_before(double value) const {
  std::optional<double> first;
  const auto request = [&](double wanted) {
    const bool between = value > state_.now.at.value ? wanted > state_.now.at.value && wanted <= value
                                                     : wanted < state_.now.at.value && wanted >= value;
    if (between && (!first || std::abs(wanted - state_.now.at.value) < std::abs(*first - state_.now.at.value)))
      first = wanted;
  };
  request(options_.from);
  request(options_.to);
  for (const double v : options_.values) request(v);
  return first;
}

bool Continuation::step_onto(double value, double step) {
  const double ahead = guess(step).value;
  const double part = std::clamp((value - state_.now.at.value) / (ahead - state_.now.at.value), 0.0, 1.0);
  const Correction c = correct_at(family_, value, guess(part * step).states, &state_.now.direction);
  state_.evaluations += c.evaluations;
  if (!accept(c, step)) return false;
  take(c.orbit);
  if (value == options_.from || value == options_.to) state_.end = BranchEnd::range;
  return true;
}

void Continuation::take(const BranchOrbit& next) {
  const double taken = inner_product(family_, next.at - state_.now.at, state_.now.direction);
  state_.tangent_derivative = (1.0 / taken) * (next.direction - state_.now.direction);
  before_ = std::exchange(state_.now, next);
  ++state_.orbits;
  if (length(family_, state_.now.at - start_.at) > 2.0 * state_.step) state_.left_start = true;
}

bool Continuation::advance() {
  if (state_.end != BranchEnd::none) return false;
  if (state_.orbits >= options_.orbits) {
    state_.end = BranchEnd::many;
    return false;
  }
  // The branch ends at an end of the range.
  const double outwards = state_.now.direction.value;
  if ((state_.now.at.value == options_.to && outwards > 0.0) ||
      (state_.now.at.value == options_.from && outwards < 0.0)) {
    state_.end = BranchEnd::range;
    return false;
  }
  for (;;) {
    const CurvePoint ahead = guess(state_.step);
    if (const auto wanted = wanted_before(ahead.value)) {
      if (step_onto(*wanted, state_.step)) return true;
    } else {
      const Correction c = correct(family_, ahead, state_.now.direction);
      state_.evaluations += c.evaluations;
      // The step may have passed a value that the guess did not reach: a shorter step decides.
      if (accept(c, state_.step) && !wanted_before(c.orbit.at.value)) {
        if (back_at_the_start(c.orbit, state_.step)) {
          before_ = std::exchange(state_.now, start_);
          state_.end = BranchEnd::closed;
          return true;
        }
        take(c.orbit);
        state_.step = std::clamp(state_.step * std::clamp(grow_, 0.3, 2.0), options_.min_step, options_.max_step);
        return true;
      }
    }
    if (state_.step <= options_.min_step) {
      state_.end = BranchEnd::min_step;
      return false;
    }
    state_.step = std::max(0.5 * state_.step, options_.min_step);
  }
}

}  // namespace epicyclic::analysis
