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
  require(least_step > 0.0, "least_step", least_step, "> 0");
  require(first_step >= least_step, "first_step", first_step, ">= least_step");
  require(largest_step >= first_step, "largest_step", largest_step, ">= first_step");
  require(turn > 0.0, "turn", turn, "> 0");
  require(multiplier_change > 0.0, "multiplier_change", multiplier_change, "> 0");
  require(guess_distance > 0.0, "guess_distance", guess_distance, "> 0");
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

Continuation::Continuation(OrbitFamily family, const ContinuationOptions& options, BranchOrbit start)
    : family_(std::move(family)), options_(options), start_(std::move(start)), step_(options.first_step) {
  family_.validate();
  options_.validate();
  if (!(start_.at.value >= options_.from && start_.at.value <= options_.to))
    throw InputError("the branch starts at " + short_text(start_.at.value) + ", outside its range");
  blocks_ = invariant_blocks(static_cast<std::size_t>(start_.at.states.rows()), family_.symmetry);
  before_ = now_ = start_;
  bend_ = 0.0 * start_.at;
}

CurvePoint Continuation::guess(double step) const {
  return now_.at + step * now_.direction + (0.5 * step * step) * bend_;
}

bool Continuation::accept(const Correction& c, double step) {
  if (!c.found) {
    message_ = c.message;
    return false;
  }
  // What steps aim at may be exceeded by as much again.
  const double turned = angle(family_, now_, c.orbit) / (2.0 * options_.turn);
  const double missed = c.distance / (options_.guess_distance * step);
  double moved = 0.0;
  for (const InvariantBlock& block : blocks_)
    moved = std::max(
        moved, multiplier_change(multipliers_of(block, now_.monodromy), multipliers_of(block, c.orbit.monodromy)));
  moved /= options_.multiplier_change;
  const double worst = std::max({turned, missed, moved});
  message_ = turned > 1.0 ? "the branch turns" : missed > 1.0 ? "the guess is far off" : "a multiplier jumps";
  // Half of each is where the next step goes to; a guess of second order misses by the third power.
  grow_ =
      std::min({0.5 / std::max(turned, 1e-3), std::cbrt(0.3 / std::max(missed, 1e-3)), 0.7 / std::max(moved, 1e-3)});
  return worst <= 1.0;
}

bool Continuation::back_at_the_start(const BranchOrbit& next, double step) const {
  if (!left_start_) return false;
  // Between now and next, going the same way.
  const CurvePoint to_start = start_.at - now_.at;
  const double ahead = inner_product(family_, to_start, now_.direction);
  if (ahead < 0.0 || ahead > step || inner_product(family_, next.direction, start_.direction) < 0.0) return false;
  if (length(family_, to_start) > 2.0 * step) return false;
  const Correction c = correct(family_, guess(ahead), now_.direction);
  // Of one branch to the corrector's own accuracy, in parts of a step.
  constexpr double same = 1e-3;
  return c.found && length(family_, c.orbit.at - start_.at) < same * step;
}

bool Continuation::to_the_end_of_the_range(double step) {
  const CurvePoint ahead = guess(step);
  const double end = ahead.value > options_.to ? options_.to : options_.from;
  const double part = (end - now_.at.value) / (ahead.value - now_.at.value);
  const Correction c = correct_at(family_, end, guess(part * step).states, &now_.direction);
  evaluations_ += c.evaluations;
  if (!accept(c, step)) return false;
  before_ = std::exchange(now_, c.orbit);
  end_ = BranchEnd::range;
  return true;
}

bool Continuation::advance() {
  if (end_ != BranchEnd::none) return false;
  if (orbits_ >= options_.orbits) {
    end_ = BranchEnd::many;
    return false;
  }
  for (;;) {
    const CurvePoint ahead = guess(step_);
    const bool leaves = ahead.value > options_.to || ahead.value < options_.from;
    if (leaves) {
      // At the very end there is nothing ahead.
      const double end = ahead.value > options_.to ? options_.to : options_.from;
      if (now_.at.value == end) {
        end_ = BranchEnd::range;
        return false;
      }
      if (to_the_end_of_the_range(step_)) {
        ++orbits_;
        return true;
      }
    } else {
      const Correction c = correct(family_, ahead, now_.direction);
      evaluations_ += c.evaluations;
      if (accept(c, step_) && c.orbit.at.value <= options_.to && c.orbit.at.value >= options_.from) {
        if (back_at_the_start(c.orbit, step_)) {
          before_ = std::exchange(now_, start_);
          end_ = BranchEnd::closed;
          return true;
        }
        const double taken = inner_product(family_, c.orbit.at - now_.at, now_.direction);
        bend_ = (1.0 / taken) * (c.orbit.direction - now_.direction);
        before_ = std::exchange(now_, c.orbit);
        ++orbits_;
        if (length(family_, now_.at - start_.at) > 2.0 * step_) left_start_ = true;
        step_ = std::clamp(step_ * std::clamp(grow_, 0.3, 2.0), options_.least_step, options_.largest_step);
        return true;
      }
    }
    if (step_ <= options_.least_step) {
      end_ = BranchEnd::least_step;
      return false;
    }
    step_ = std::max(0.5 * step_, options_.least_step);
  }
}

}  // namespace epicyclic::analysis
