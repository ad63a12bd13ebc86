// The regime of the attractor that a periodically forced flow reaches, with its evidence.
//
// The state is integrated over windows. A window records a stroboscopic section. The response is
//
// - periodic: recurrence [A-rec] names candidates n; Newton's method finds an orbit y* of period n [A-orbit] with a
//   residual far below the recurrence error, of no shorter period to within its error [A-orbit-error]; all its
//   multipliers are inside the unit circle by more than `neutral` and by more than their error. The error is the
//   difference from the multipliers at another tolerance, or by shooting in n + 1 intervals. The trajectory also
//   approaches the orbit. It is followed from its last point y_0 until it is no farther from the orbit than there, or
//   for 16 returns. Each return is one that the monodromy M predicts,
//
//     | (y_(k+1)n - y*) - M (y_kn - y*) | <= | y_kn - y* | / 10,                                       [A-approach]
//
//   and no predicted return is beyond twice the largest distance seen. This is the proof: only time separates the
//   trajectory from the orbit. One return is not sufficient. If M is far from normal, a difference can grow tenfold
//   before it shrinks, and reach another contact.
// - chaotic: the largest exponent, of the last three quarters of all windows, is positive by its interval [A-lyap], the
//   0-1 test agrees, and chaos lasts for `lasting` periods, which are integrated without tangents. It has to
//   last for the whole budget if Newton's method finds an attracting orbit from a close return of a window without
//   growth: a trajectory may reach an orbit through such a return. If the test abstains, vectors have to grow by e^8 in
//   the last half of all windows. If the test says regular and the trajectory nearly recurs after n periods, the test
//   is repeated without the sequence of bands. If it still says regular, growth and test contradict each other, and the
//   response is not chaotic. Longer windows follow, at tighter tolerances if growth is weak; without a result the
//   response is undecided. Vectors also grow beside a repelling set. So the state is pushed a little in their
//   direction, once, which does not move it off an attractor. Growth below e^8 in 128 periods also has to last at the
//   tolerance of orbits: errors of a looser tolerance alone can keep a trajectory off an orbit that attracts from near
//   by.
// - quasiperiodic: over the last half of all windows, which are long, tangent vectors neither grow nor shrink by more
//   than e^2, as beside a torus. The exponent's interval excludes growth by more than e^8 over all periods that it
//   counts. The exponent is not negative by three half intervals, and the 0-1 test says regular. A near return after n
//   periods leads to no orbit. The trajectory is farther from each orbit of n periods than ten times the orbit's error
//   [A-orbit-error]. Newton's method does not approach an orbit without reaching it. A torus also needs evidence of its
//   own, from the last window [A-torus]:
//
//     no n up to an eighth of the window has a return error r_n [A-rec] that falls to 3/4 from each quarter to the
//     next; after the n of the least error each point has moved by at least a hundredth of the largest displacement; in
//     two dimensions the map of one period does not shrink areas at all points of a grid over the section, since an
//     invariant curve would have to keep the area that it holds. In one dimension there is none.
//
// If none of these holds, the transient or the window was too short: the next window is twice as long. When the budget
// is spent, the response is undecided, and the evidence says what was seen. So the transient ends when the trajectory
// has reached its attractor, not after a fixed number of periods.
//
// Windows may use a looser tolerance than the orbits, but only while vectors grow: then the trajectory forgets its
// state anyhow. A loose window without growth does not count. The trajectory continues from the beginning of that
// window at the tolerance of the orbits, so that it stays in its basin. If 1024 periods without growth give no regime,
// the tolerance becomes a hundredth of the last one, repeatedly.
//
// Limits: a chaotic transient that outlives `lasting` is called chaotic unless that search finds its end, one that
// outlives the budget always. A periodic orbit that loses its stability at this very parameter is undecided. The caller
// may choose a period for a system without forcing; its limit cycles then are quasiperiodic.
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
  int window = 64;          ///< periods of the first window
  int budget = 8192;        ///< periods of all windows together
  int lasting = 4096;       ///< periods that chaos has to last, at most the budget, if nothing speaks for another end
  int longest_period = 16;  ///< largest n that is tried
  double near = 0.1;        ///< a recurrence error above this part of the section's extent makes no candidate [-]
  double residual = 1e-9;   ///< of the orbit, that counts as found, in parts of the largest component seen [-];
                            ///< a few tolerances of the flow, whose map kinks make rough
  double neutral = 1e-6;    ///< a multiplier's modulus this near to 1 attracts nothing: errors could put it outside
  std::size_t observable = 0;  ///< component of the state for the 0-1 test

  /// The system by a flow that controls the error of tangents, for orbits and their multipliers: behind a kink
  /// they are off by far more than the tolerance without. Null: the flow itself.
  integrate::Flow* exact = nullptr;
  /// The same system by a flow at ten times the tolerance of `exact`, for the errors of multipliers: what another
  /// sequence of steps changes is less than what the tolerance does. Null: from another subdivision, which knows of the
  /// steps alone.
  integrate::Flow* coarser = nullptr;
  /// The same system at the tolerance of `exact` for windows without growth, which a looser flow could lead to another
  /// attractor. Null: the flow itself.
  integrate::Flow* tight = nullptr;
  /// All three at a hundredth of the last tolerance, if the last ones gave no regime; nothing if there are no tighter
  /// ones. May be empty.
  std::function<std::optional<FlowsOfTolerance>()> tighter{};

  /// @throws InputError for windows that are too short for any regime, a budget shorter than the first window, or a
  /// number of periods or a bound out of range
  void validate() const;
};

/// What the decision rests on.
struct Evidence {
  int periods = 0;                ///< of the forcing, in all windows
  Recurrence recurrence;          ///< of the last 128 periods of the last window
  double residual = 0;            ///< of the orbit, if there is one
  double orbit_error = 0;         ///< how far its points may be from the orbit [A-orbit-error]
  double largest_multiplier = 0;  ///< modulus
  double multiplier_error = 0;
  Estimate exponent;                 ///< largest, per unit of s: measured, or log of the multiplier over the period
  double late_growth = 0;            ///< log growth of a tangent vector over the last half of the last window
  std::optional<double> zero_one{};  ///< K of the last window, if it was computed
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
/// @param seen   a section of this trajectory that ends in `state`: first tested for a periodic response, not counted
///               in the budget; may be null
/// @throws DomainError when the flow's field has no period; InputError for options out of range, or an observable that
/// is no component of the state
[[nodiscard]] Classification classify(integrate::Flow& flow, std::span<double> state, const RegimeOptions& options,
                                      const std::function<bool()>& go_on, const PoincareSection* seen = nullptr);

}  // namespace epicyclic::analysis
