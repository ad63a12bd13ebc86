// What kind of motion a periodically forced flow settles to, told by evidence.
//
// The state is carried on in looks. A look records a stroboscopic section and asks whether the motion is
//
// - periodic: recurrence [A-rec] names candidates n; Newton's method finds an orbit y* of period n [A-orbit] with a
//   residual far below the recurrence error, of no shorter period to within its error [A-orbit-error]; all its
//   multipliers are inside the unit circle by more than `neutral` and by more than their error, which is the difference
//   from those of another tolerance, or of shooting in n + 1 pieces; and the motion is already drawn to it: followed
//   from its last point y_0 until it is no farther from the orbit than it was there, or for 16 returns, each of them
//   is one that the monodromy M has it make,
//
//     | (y_(k+1)n - y*) - M (y_kn - y*) | <= | y_kn - y* | / 10,                                       [A-settled]
//
//   and M leads it at no return beyond twice the largest distance that was seen, which is the proof: nothing but time
//   is then between the motion and the orbit. One return does not do: where M is far from normal a difference grows
//   tenfold before it shrinks, into a contact that it began too near to the orbit to know of.
// - chaotic: the largest exponent, of the last three quarters of all looks, is positive by its interval [A-lyap], the
//   0-1 test agrees, and it lasts for `lasting` periods, through which the motion is carried without tangents;
//   for the whole budget if Newton's method finds an orbit that attracts from one of the close returns of a look
//   without growth, which is how a motion comes to an orbit in the end. Where the test abstains vectors have to grow by
//   e^8 in the last half of all looks. Where it says regular, it is asked again without the turn through the bands, if
//   the motion all but recurs after n periods; where it still does the two contradict each other, and the motion is not
//   chaotic: it is looked at for longer, at tighter tolerances if growth is weak, and is undecided in the end. Vectors
//   grow beside what repels, too: the motion is therefore pushed a little in their direction, once: an attractor does
//   not mind. Growth below e^8 in 128 periods has to last at the tolerance of orbits, too: errors of a looser one alone
//   keep a motion off an orbit that attracts from near by.
// - quasiperiodic: over the last half of all looks, long ones, tangent vectors neither grow nor shrink by more than
//   e^2, as beside a torus, the exponent's interval excludes growth by more than e^8 over all periods that it counts,
//   it is not negative by three half intervals, the 0-1 test says regular, and what
//   the motion all but comes back to after n periods is no orbit, nor is the motion where an orbit of n periods may be
//   by ten times its error [A-orbit-error], nor does Newton's method near one that it does not reach. Beside that a
//   torus needs evidence of its own, from the last look [A-torus]:
//
//     no n up to an eighth of the look has a return error r_n [A-rec] that falls to 3/4 from each quarter to the next;
//     after the n of the least error the motion has moved everywhere by a hundredth of the farthest at least; in two
//     dimensions the map of one period does not shrink areas at all points of a grid over the section, since an
//     invariant curve would have to keep the area that it holds. In one dimension there is none.
//
// If none of these holds the transient was too short or the look was: the next look is twice as long. When the budget
// is spent the motion is undecided, and the evidence says what was seen. So a transient ends when the motion has
// settled, not after a number of periods that somebody thought of.
//
// Looks may be at a looser tolerance than the orbits', but only while vectors grow, where the place of a motion is
// forgotten anyhow. A loose look without growth does not count: the motion goes on from where that look began, at the
// tolerance of the orbits, so that it stays in the basin that it began in. What is not told after 1024 periods without
// growth is looked at with a tolerance that is tighter by a hundredth, and again.
//
// Limits: a chaotic transient that outlives `lasting` is called chaotic unless that search finds its end, one that
// outlives the budget always; a periodic orbit that loses its stability at
// this very parameter is undecided; a system without forcing may be given a period of its own choice, and its limit
// cycles then are quasiperiodic.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "analysis/periodic_orbit.hpp"
#include "analysis/poincare.hpp"
#include "analysis/statistics.hpp"
#include "integrate/flow.hpp"

namespace epicyclic::analysis {

enum class Regime { periodic, quasiperiodic, chaotic, undecided };
[[nodiscard]] std::string to_string(Regime regime);

/// Flows of one system at one tolerance.
struct FlowsOfTolerance {
  integrate::Flow* windows = nullptr;  ///< tangents without error control
  integrate::Flow* exact = nullptr;    ///< with it
  integrate::Flow* coarser = nullptr;  ///< the same at ten times the tolerance
};

struct RegimeOptions {
  int window = 64;          ///< periods of the first look
  int budget = 8192;        ///< periods of all looks together
  int lasting = 4096;       ///< periods that chaos has to last, at most the budget, if nothing speaks for another end
  int longest_period = 16;  ///< largest n that is tried
  double near = 0.1;        ///< a recurrence error above this part of the section's extent makes no candidate [-]
  double residual = 1e-9;   ///< of the orbit, that counts as found, in parts of the largest component seen [-];
                            ///< a few tolerances of the flow, whose map kinks make rough
  double neutral = 1e-6;    ///< a multiplier's modulus this near to 1 attracts nothing: errors could put it outside
  std::size_t observable = 0;  ///< component of the state that the 0-1 test looks at

  /// The system by a flow that controls the error of tangents, for orbits and their multipliers: behind a kink
  /// they are off by far more than the tolerance without. Null: the flow itself.
  integrate::Flow* exact = nullptr;
  /// The same system by a flow at ten times the tolerance of `exact`, for the errors of multipliers: what another
  /// sequence of steps changes is less than what the tolerance does. Null: from another subdivision, which knows of the
  /// steps alone.
  integrate::Flow* coarser = nullptr;
  /// The same system at the tolerance of `exact` for looks at what does not grow, which a looser flow could lead to
  /// another attractor than its own. Null: the flow itself.
  integrate::Flow* tight = nullptr;
  /// All three at a hundredth of the last tolerance, for what the last ones did not tell; nothing if there are none
  /// that tell more. May be empty.
  std::function<std::optional<FlowsOfTolerance>()> tighter{};

  /// @throws InputError for looks shorter than anything is told from, a budget shorter than the first of them, or a
  /// number of periods or a bound out of range
  void validate() const;
};

/// What the decision rests on.
struct Evidence {
  int periods = 0;                ///< of the forcing, looked at altogether
  Recurrence recurrence;          ///< of the last 128 periods of the last look
  double residual = 0;            ///< of the orbit, if there is one
  double orbit_error = 0;         ///< how far its points may be from the orbit [A-orbit-error]
  double largest_multiplier = 0;  ///< modulus
  double multiplier_error = 0;
  Estimate exponent;                 ///< largest, per unit of s: measured, or log of the multiplier over the period
  double late_growth = 0;            ///< log growth of a tangent vector over the last half of the last look
  std::optional<double> zero_one{};  ///< K of the last look, if it was asked
  std::string note;                  ///< in words
};

struct Classification {
  Regime regime = Regime::undecided;
  int period = 0;                      ///< n, if periodic
  std::optional<PeriodicOrbit> orbit;  ///< if periodic
  Evidence evidence;
  integrate::Evolution evolution;  ///< if it was not reached there is no regime
};

/// @param state  replaced by the last state
/// @param seen   a section of this very motion that ends in `state`: asked first whether it is periodic, not counted in
///               the budget; may be null
/// @throws DomainError when the flow's field has no period; InputError for options out of range, or an observable that
/// is no component of the state
[[nodiscard]] Classification classify(integrate::Flow& flow, std::span<double> state, const RegimeOptions& options,
                                      const std::function<bool()>& go_on, const PoincareSection* seen = nullptr);

}  // namespace epicyclic::analysis
