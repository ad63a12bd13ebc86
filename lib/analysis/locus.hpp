// Loci: curves of special points of periodic orbits in two parameters, with the points of codimension two on them.
//
// The orbits F(z) = 0 over two parameters, z = (y_0 ... y_p-1, lambda, mu), are a surface. On it a special point is a
// curve g(z) = 0,
//
//   fold, doubling      g of (B - c I) x + g u = 0, <v, x> = 1, c = +1, -1; x, u, v of the block B [A-blocks]: 0 with
//   and branch point    det(B - c I), and smooth where other multipliers meet the critical one
//   Neimark-Sacker      log |product of the pair| / 2, of the one multiplier in a block that stands for two
//   grazing             the least or greatest value of a switching surface along the orbit
//
//   F(z) = 0 ,   g(z) = 0 ,   <t, z - z*> = 0                                                           [A-locus]
//
// with lengths over the states and both parameters [A-length]. In the plane normal to t the orbits are a curve, on
// which the root of g is found by secants. The direction t' is that on the surface in which g does not change. The
// locus is a smooth curve in this space. This holds at cusps too, where its image in the plane of the parameters
// reverses. u and v are the singular vectors of the least singular value at the last point. Sources: W. Govaerts,
// Numerical Methods for Bifurcations of Dynamical Equilibria (2000), ch. 3 and 4 (bordered matrices); R. Seydel,
// Practical Bifurcation and Stability Analysis, 3rd ed., ch. 5; Keller (1977).
//
// Points of codimension two [A-codim2] are roots of a function of the arc length that changes its sign there:
//
//   cusp              of folds: <w, p> = 0, p the parameters' part of t, w the direction of its line, followed
//   1:1, 1:2          a second multiplier of the block at c; of Neimark-Sacker points the pair meets at c
//   1:3, 1:4          of Neimark-Sacker points: the angle of the pair is 2 pi / 3, pi / 2
//   fold-doubling ... another multiplier at +1 or -1, or another pair on the unit circle, by counts [A-special]
//
// Source: Yu. A. Kuznetsov, Elements of Applied Bifurcation Theory, 3rd ed., ch. 9.
//
// Bounds: the locus is computed again, in its normal plane there, by other tolerances and subdivisions. Points of
// codimension two are found again along it; [A-bound] of the parameter that moves more, in their scales.
//
// Smoothness: a locus is as smooth as the monodromy, one derivative less than the flow: at grazings of a continuous
// field, loci of folds and of period doublings have corners or end. Limits: a locus of Neimark-Sacker points
// ends where its pair becomes real, at 1:1 and 1:2. Branch points that keep the symmetry are no curve in two
// parameters. Two points of codimension two of one kind between neighbours, there and back, are not seen. Two points
// that coincide and that the counts cannot separate are reported as unresolved.
#pragma once

#include <complex>
#include <cstddef>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "analysis/continuation.hpp"
#include "analysis/orbit_family.hpp"
#include "analysis/orbit_system.hpp"
#include "analysis/special_points.hpp"
#include "integrate/make_flow.hpp"

namespace epicyclic::analysis {

/// Flows of systems that differ by two parameters. If fields have the derivative by the first one, so do the flows.
using PlaneOfFlows = std::function<std::unique_ptr<integrate::Flow>(double first, double second)>;

struct OrbitSurface {
  PlaneOfFlows flows;
  OrbitFamily family{};         ///< all but its flows: period, shooting intervals, scales, symmetry, Newton's method
  double second_scale = 1;      ///< of the second parameter; that of the first is family.value_scale
  double gradient_step = 1e-4;  ///< along the surface, a length, of the differences of g

  /// Those over the first parameter.
  [[nodiscard]] OrbitFamily at(double second) const;

  /// Scales of both parameters.
  [[nodiscard]] Eigen::VectorXd scales() const;

  /// @throws InputError as OrbitFamily::validate(), and for a scale or step that is not positive
  void validate() const;
};

enum class CodimTwo {
  cusp,
  resonance_1_1,
  resonance_1_2,
  resonance_1_3,
  resonance_1_4,
  fold_period_doubling,
  fold_neimark_sacker,
  period_doubling_neimark_sacker,
  double_crossing,  ///< two of other kinds at once: two pairs, or one that breaks the symmetry with another
  unresolved,       ///< several at once
};

/// "cusp", "resonance_1_1" ... "resonance_1_4", "fold_flip", "fold_neimark_sacker", "flip_neimark_sacker",
/// "double_crossing", "unresolved".
[[nodiscard]] std::string to_string(CodimTwo kind);

/// What a locus is a locus of.
struct LocusSubject {
  SpecialKind kind = SpecialKind::fold;
  int symmetry_index = 0;   ///< of the block
  std::size_t surface = 0;  ///< that is grazed
  bool least = false;       ///< where its value is least, else where it is greatest
};

/// A point of a locus.
struct LocusPoint {
  OrbitPlace at;                                                  ///< values: both parameters
  OrbitPlace direction;                                           ///< t, of length 1
  OrbitPlace across;                                              ///< of length 1: on the surface, normal to t
  double slope = 0;                                               ///< of g in that direction
  MatrixProduct monodromy;                                        ///< M
  std::complex<double> multiplier;                                ///< on the unit circle
  std::complex<double> partner;                                   ///< of the pair, if it is one
  Eigen::VectorXd left, right;                                    ///< u, v; empty if there are none
  double residual = 0;                                            ///< max |F| before the last step
  double first_bound = std::numeric_limits<double>::infinity();   ///< [A-bound] of each parameter; not finite where
  double second_bound = std::numeric_limits<double>::infinity();  ///< there was nothing to compare with

  [[nodiscard]] double first() const { return at.values(0); }
  [[nodiscard]] double second() const { return at.values(1); }
};

/// A point of codimension two on a locus.
struct Codim2Point {
  CodimTwo kind = CodimTwo::unresolved;
  LocusPoint point;
  int symmetry_index = 0;             ///< of the other multiplier's block
  std::complex<double> multiplier{};  ///< the other one; of a resonance 1:k the locus' own
  std::string note{};                 ///< what was not as usual
};

/// The same orbits by another tolerance or subdivision.
struct LocusRefinement {
  PlaneOfFlows flows;
  int shooting_intervals = 1;  ///< for each of the family's
};

struct LocusOptions {
  ContinuationOptions along{};            ///< range of the first parameter, steps, most points; `values` play no part
  double second_from = 0, second_to = 0;  ///< range of the second parameter, from before to
  std::vector<LocusRefinement> others{};  ///< the finest last; none: no bounds
  double safety = 3;                      ///< of [A-bound]

  /// @throws InputError as ContinuationOptions::validate(), for an empty range of the second parameter, or a safety
  /// factor below 1
  void validate() const;
};

enum class LocusEnd {
  none,       ///< it goes on
  range,      ///< an edge of the rectangle, which the last point is at
  closed,     ///< the locus has come back to its first point, which stands last again
  many,       ///< the requested number of points
  min_step,   ///< no point within the least step
  resonance,  ///< the pair has become real at 1:1 or 1:2, which the last point is at
};

/// Result of the search for a point of a locus.
struct LocusCorrection {
  bool found = false;
  LocusPoint point;       ///< if found
  int evaluations = 0;    ///< of F with its derivatives
  double distance = 0;    ///< from the guess, as a length
  std::string message{};  ///< why not found
};

/// The special point of a branch as a point of its locus. The second parameter rises in its direction; if the second is
/// constant, the first rises. Its bounds are not known yet.
[[nodiscard]] LocusCorrection locus_start(const OrbitSurface& surface, const SpecialPoint& point, double second);

/// The function that is zero on the locus of a special point.
[[nodiscard]] LocusSubject subject_of(const SpecialPoint& point);

/// The locus in the opposite direction.
[[nodiscard]] LocusPoint reversed(LocusPoint point);

/// All that a trace goes on from.
struct LocusState {
  LocusPoint now;
  OrbitPlace tangent_derivative;  ///< dt/dh
  double step = 0;
  std::size_t points = 1;
  bool left_start = false;  ///< far enough to come back
  LocusEnd end = LocusEnd::none;
  std::vector<Codim2Point> marks{};  ///< between the point before and this one, in order
  std::string message{};             ///< why no point was found, at min_step
  int evaluations = 0;               ///< of F with its derivatives, those of bounds and marks not counted
};

class Locus;

/// A locus from one point, in one direction.
class LocusTrace {
 public:
  /// @param start  a point of the locus, whose direction is the direction of the continuation
  /// @throws InputError for options out of range, or a start outside the rectangle
  LocusTrace(OrbitSurface surface, const LocusSubject& subject, LocusOptions options, LocusPoint start);

  /// Follows the locus to the next point. Finds its bounds and the points of codimension two between both points.
  /// @returns whether there is one
  bool advance();

  [[nodiscard]] const LocusPoint& current() const { return state_.now; }
  [[nodiscard]] const LocusPoint& previous() const { return before_; }  ///< the one advance() came from
  [[nodiscard]] const std::vector<Codim2Point>& marks() const { return state_.marks; }
  [[nodiscard]] LocusEnd end() const { return state_.end; }

  /// One that is given the state of another with the same surface, subject, options and start goes on with the same
  /// bits.
  [[nodiscard]] const LocusState& state() const { return state_; }
  void restore(LocusState state) { state_ = std::move(state); }

 private:
  /// An edge of the rectangle.
  struct Edge {
    Eigen::Index parameter = 0;
    double value = 0;
  };
  [[nodiscard]] OrbitPlace guess(double step) const;
  [[nodiscard]] bool accept(const Locus& locus, const LocusCorrection& c, double step);
  [[nodiscard]] std::optional<Edge> edge_before(const OrbitPlace& there) const;
  [[nodiscard]] bool leaves_here() const;
  [[nodiscard]] bool back_at_the_start(Locus& locus, const LocusPoint& next, double step) const;
  bool step_onto(Locus& locus, const Edge& edge, double step);
  void take(Locus& locus, LocusPoint next);

  OrbitSurface surface_;
  LocusSubject subject_;
  LocusOptions options_;
  std::vector<InvariantBlock> blocks_;
  LocusPoint start_, before_;
  LocusState state_;
  double grow_ = 1;  ///< what the last point allows of the next step
};

}  // namespace epicyclic::analysis
