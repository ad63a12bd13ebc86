// A sweep held against branches: is each change of its motion where the branches say that one is?
//
// Each periodic point of the sweep is looked for on the branches: on one of its period, the orbit at its very value, by
// Newton's method, as near as its own state is [A-same]. A branch turns back in the parameter at a fold, so that it may
// have several orbits at one value: between turns it is a stretch, and those are told apart as branches are. A change
// is two neighbours along a direction whose period or regime differ, or that share no stretch. It is explained by
//
//   bifurcation  a special point within the grid where the stretch of one side gains or loses its stability, the other
//                side being what is born there: twice the period at a flip, a torus at a Neimark-Sacker point, an orbit
//                without the symmetry at a branch point
//   jump         such a point, and a motion on the other side that is not born there: on another stretch, a named
//                branch, or on none. Or an end of the stretch, where its branch is born of an orbit that none follows
//   cascade      an end of period doublings whose last flip is known, all points between it and the change having
//                periods of the cascade
//   crisis       a motion that is not periodic ends, and what it falls onto is a branch that is stable on both sides
//                                                                                                     [S-explained]
// or it is unexplained, as where the motion before is on a stretch that is stable all the way. Within the grid means
// between the two values or up to one step of the grid behind them, whence the motion has come: one that is carried
// along follows an orbit that has just lost its stability for a while. What lies between the values goes first. Why a
// motion that is on no branch is left, what comes next does not tell. A change counts when one of its sides is
// periodic; those among chaos, torus and undecided rest on finite looks and are listed apart.
//
// Limits: a crisis is told from what is there, not from manifolds that touch. That a torus, or a doubled motion that no
// branch follows, is born where it begins is believed unless another direction of the sweep has it at the value before,
// beside the orbit.
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
  std::vector<PlaceOnBranch> on{};      ///< all that go through it: pieces of one, from several seeds
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
  double near = 0.3;   ///< beyond it Newton's method is not asked

  /// @throws InputError for distances that are not positive
  void validate() const;
};

/// @param sweep    along the parameter of the branches
/// @param points   of it, with their sections
/// @param dimension  of the state
/// @param finished told how many points have been looked for
[[nodiscard]] BranchProof prove(const TracedBranches& traced, const SweepOptions& sweep, const PointSource& points,
                                std::size_t dimension, const ProofOptions& options,
                                const std::function<void(std::size_t)>& finished);

}  // namespace epicyclic::studies
