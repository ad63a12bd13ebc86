// A branch of periodic orbits, followed by its arc length.
//
// From an orbit z with direction t the next one lies in the plane <t, z* - z> = h, normal to t [A-plane]. It is near
// the guess of second order z + h t + h^2 / 2 dt/dh, with dt/dh from the directions of the last two orbits. The step h
// keeps three limits: the angle between the directions of neighbours, the displacement of each multiplier near the unit
// circle, and the distance of the guess from the orbit found. A step is rejected and halved if one of these limits is
// exceeded or no orbit is found. So the continuation does not jump to a neighbouring branch, and multipliers identify
// the special points between two orbits [special_points.hpp].
//
// Limits: an isolated branch is followed from its start only. Where an orbit grazes a kink, the tangent angle changes
// like the root of the distance beyond it. Steps shorten there by themselves, to no less than the least step.
// Multipliers are continuous there; their slopes jump.
#pragma once

#include <complex>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "analysis/orbit_family.hpp"

namespace epicyclic::analysis {

struct ContinuationOptions {
  double from = 0, to = 0;       ///< range of the parameter, from < to
  std::vector<double> values{};  ///< at which orbits are wanted, exactly
  double first_step = 0.01;      ///< [A-length]
  double min_step = 1e-7;
  double max_step = 0.1;
  double max_tangent_angle = 0.1;    ///< angle between the directions of neighbours that steps aim at [rad]
  double multiplier_change = 0.2;    ///< most of a multiplier whose modulus is within 1/2 ... 2
  double predictor_tolerance = 0.1;  ///< most distance of what is found from the guess, in steps
  std::size_t orbits = 10000;        ///< most on the branch

  /// @throws InputError for an empty range, or steps and bounds out of range
  void validate() const;
};

enum class BranchEnd {
  none,      ///< it goes on
  range,     ///< an end of the range, which the last orbit is at
  closed,    ///< the branch has come back to its first orbit, which stands last again
  many,      ///< the requested number of orbits
  min_step,  ///< no orbit within the least step
};

/// All that a continuation goes on from.
struct ContinuationState {
  BranchOrbit now;
  CurvePoint tangent_derivative;  ///< dt/dh
  double step = 0;
  std::size_t orbits = 1;
  bool left_start = false;  ///< far enough to come back
  BranchEnd end = BranchEnd::none;
  std::string message{};  ///< why no orbit was found, at min_step
  int evaluations = 0;    ///< of the shooting equations with their derivatives
};

/// The branch from one orbit, in one direction.
class Continuation {
 public:
  /// @param start  an orbit of the family, whose direction is the direction of the continuation
  /// @throws InputError for options out of range, or a start outside the range
  Continuation(OrbitFamily family, const ContinuationOptions& options, BranchOrbit start);

  /// Follows the branch to the next orbit.
  /// @returns whether there is one
  bool advance();

  [[nodiscard]] const BranchOrbit& current() const { return state_.now; }
  [[nodiscard]] const BranchOrbit& previous() const { return before_; }  ///< the one advance() came from
  [[nodiscard]] BranchEnd end() const { return state_.end; }
  [[nodiscard]] const OrbitFamily& family() const { return family_; }

  /// One that is given the state of another with the same family, options and start goes on with the same bits.
  [[nodiscard]] const ContinuationState& state() const { return state_; }
  void restore(ContinuationState state) { state_ = std::move(state); }

 private:
  [[nodiscard]] CurvePoint guess(double step) const;
  [[nodiscard]] bool accept(const Correction& c, double step);
  [[nodiscard]] std::optional<double> wanted_before(double value) const;
  bool step_onto(double value, double step);
  void take(const BranchOrbit& next);
  [[nodiscard]] bool back_at_the_start(const BranchOrbit& next, double step) const;

  OrbitFamily family_;
  ContinuationOptions options_;
  std::vector<InvariantBlock> blocks_;
  BranchOrbit start_, before_;
  ContinuationState state_;
  double grow_ = 1;  ///< what the last orbit allows of the next step
};

/// How a step compares with what steps aim at.
struct StepVerdict {
  bool good = false;
  double grow = 1;       ///< what it allows of the next step
  std::string reason{};  ///< what is worst
};

/// @param angle     between the directions at both ends [rad]
/// @param distance  of what was found from the guess
/// @param moved     most that a multiplier has
[[nodiscard]] StepVerdict judge_step(const ContinuationOptions& options, double step, double angle, double distance,
                                     double moved);

/// The most that a multiplier of modulus 1/2 ... 2 moves from one to the other, each matched with its nearest.
[[nodiscard]] double multiplier_change(const std::vector<std::complex<double>>& a,
                                       const std::vector<std::complex<double>>& b);

/// That of all blocks.
[[nodiscard]] double multiplier_change(const std::vector<InvariantBlock>& blocks, const MatrixProduct& a,
                                       const MatrixProduct& b);

}  // namespace epicyclic::analysis
