// A sweep compared with branches: does each change of its attractor occur where the branches have a reason for it?
//
// Each periodic point of the sweep is located on the branches. It is on a branch of its period if Newton's method gives
// an orbit of that branch at the same value, as near as the point's own state is [A-same]. A branch reverses in the
// parameter at a fold, so that it may have several orbits at one value. The part between two folds is a stretch, and
// stretches count as different branches do. A change is two neighbours along a direction whose period or regime differ,
// or that share no stretch. Its causes are:
//
//   bifurcation  a special point within the grid where the stretch of one side gains or loses its stability, and the
//                other side is born there: twice the period at a period doubling (flip), a torus at a Neimark-Sacker
//                point, an orbit without the symmetry at a branch point
//   jump         such a point, and an attractor on the other side that is not born there: on another stretch, a named
//                branch, or on none. Or an end of the stretch, where its branch is born of an orbit that none follows
//   cascade      an end of period doublings whose last one is known, and all points between it and the change have
//                periods of the cascade
//   crisis       an attractor that is not periodic ends, and the sweep falls onto a branch that is stable on both sides
//                                                                                                     [S-explained]
//
// Any other change is unexplained, for example if the orbit before it is on a stretch that is stable from one value to
// the other. Within the grid means between the two values or up to one step of the grid behind them. A sweep comes from
// there, and with continued initial states it follows an orbit that has just lost its stability for a while. Special
// points between the values come first. The attractor after the change does not explain the end of one that is on no
// branch. A change counts if one of its sides is periodic. Changes among chaos, torus and undecided depend on the
// length of the records and are listed apart.
//
// Limits: a crisis is recognized by the regimes at both values, not by manifolds that touch. A torus, or a doubled
// orbit that no branch follows, counts as born where it begins. The exception is another direction of the sweep that
// has it at the value before, beside the orbit.
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "studies/branches.hpp"
#include "studies/point_source.hpp"
#include "studies/sweep_options.hpp"

namespace epicyclic::studies {

enum class Cause { bifurcation, jump, cascade, crisis, undecided, unexplained };

/// "bifurcation", "jump", "cascade", "crisis", "undecided", "unexplained".
[[nodiscard]] std::string to_string(Cause cause);

/// An orbit of a branch: between two of its rows.
struct PlaceOnBranch {
  std::size_t branch = 0;
  std::size_t after = 0;  ///< of its orbits the one before
};

/// Where a point of the sweep is.
struct SweepPlace {
  std::size_t point = 0;
  double value = 0;
  std::string regime;  ///< "period 2", "chaotic"
  bool periodic = false;
  int period = 0;                       ///< if periodic
  std::optional<std::size_t> branch{};  ///< that it is on; of several the one of the point before, or the nearest
  std::vector<PlaceOnBranch> on{};      ///< all that go through it: parts of one branch, from several seeds
  bool stable = false;                  ///< the orbit there
  double distance = 0;                  ///< from it [b_c, b_c per tau]; of a periodic point on none not finite
};

struct SweepChange {
  SweepPlace before, behind;  ///< along the direction
  Direction direction = Direction::up;
  bool counted = true;  ///< one side is periodic
  Cause cause = Cause::unexplained;
  std::optional<std::size_t> special{};  ///< row of TracedBranches::special
  double beside = 0;                     ///< how far that is outside the two values, in steps of the grid
  std::string words;
};

struct BranchProof {
  std::vector<SweepChange> changes;
  std::vector<SweepPlace> off;  ///< periodic points on no branch
  std::size_t periodic = 0;     ///< points
  double largest_distance = 0;  ///< of those on branches

  [[nodiscard]] std::size_t counted() const;
  [[nodiscard]] std::size_t unexplained() const;
};

struct ProofOptions {
  double same = 1e-3;  ///< a point is on a branch that is no further away [b_c, b_c per tau]
  double near = 0.3;   ///< Newton's method is not used beyond it

  /// @throws InputError for distances that are not positive
  void validate() const;
};

/// @param sweep    along the parameter of the branches
/// @param points   of it, with their sections
/// @param dimension  of the state
/// @param finished called with the number of points that have been located
[[nodiscard]] BranchProof prove(const TracedBranches& traced, const SweepOptions& sweep, const PointSource& points,
                                std::size_t dimension, const ProofOptions& options,
                                const std::function<void(std::size_t)>& finished);

}  // namespace epicyclic::studies
