// Where a branch of periodic orbits changes: folds, period doublings, Neimark-Sacker and branch points, with
// error bounds.
//
// Between two orbits of a branch each invariant block [A-blocks] of the monodromy is tested by itself:
//
//   a fold          the parameter's part of the direction changes sign: two orbits meet and vanish
//   a branch point  det(B - I) does and the direction does not: another branch crosses; or the opposite, seen
//                   from a branch that is born at a pitchfork
//   a doubling      det(B + I) changes sign: orbits of twice the period leave
//   Neimark-Sacker  a pair crosses the unit circle: a torus leaves; in a block that stands for two, one multiplier does
//   grazing         the least or greatest value of a switching surface along the orbit changes sign
//                                                                                                         [A-special]
// Signs of determinants are parities of the multipliers beyond +1 and -1, so no event is missed or confused with
// another among many. If the counts do not identify one event alone, before and behind or at the event itself, the part
// is halved. The place is the root of a function of the arc length that is smooth there: the direction's part, lambda -
// 1, lambda + 1, log |lambda|.
//
// The place is found again by other tolerances and subdivisions. With v the finest of the values v_k, f the function
// whose root it is and e what rounding leaves of f there [A-schur],
//
//   bound = safety max |v_k - v| + e |dv / df| + rounding of v                                            [A-bound]
//
// Two multipliers of equal parts cross +1 or -1 together if no symmetry was declared. M -+ I then has a null space of
// two: a branch point or a period doubling of nullity 2, and no Neimark-Sacker point. A pair whose moduli are 1 to
// within their errors at both neighbours crosses nothing: those of a conservative system stay on the circle.
//
// A Neimark-Sacker point whose multiplier is a k-th root of 1, k = 1 ... 4, has no torus of the usual kind. With a the
// finest of the angles a_k of the multiplier, it is reported as a strong resonance if the angle could be that one:
//
//   | |a| - 2 pi / k | <= safety max |a_k - a| + rounding ,   |a| in [0, pi], 2 pi taken as 0         [A-resonance]
//
// Source: Yu. A. Kuznetsov, Elements of Applied Bifurcation Theory, 3rd ed., ch. 9. Without other tolerances to compare
// with, none is reported.
//
// Limits: one multiplier's crossing between neighbours, there and back, is not seen; the continuation keeps multipliers
// from moving that far. That one leaves while another comes in is seen. Events that no halving separates are reported
// as unresolved.
#pragma once

#include <complex>
#include <cstddef>
#include <string>
#include <vector>

#include "analysis/orbit_family.hpp"

namespace epicyclic::analysis {

enum class SpecialKind { fold, branch_point, period_doubling, neimark_sacker, grazing, unresolved };

/// `fold`, `branch_point`, `flip`, `neimark_sacker`, `grazing`, `unresolved`.
[[nodiscard]] std::string to_string(SpecialKind kind);

struct SpecialPoint {
  SpecialKind kind = SpecialKind::unresolved;
  double value = 0;                 ///< of the parameter
  double error_bound = 0;           ///< of the value [A-bound]; not finite where there was nothing to compare with
  BranchOrbit orbit;                ///< of the branch's own family, there
  int symmetry_index = 0;           ///< j of the block: 0 keeps the symmetry, others break it
  std::complex<double> multiplier;  ///< that reaches the unit circle
  bool outwards = false;            ///< it leaves the unit circle along the branch
  std::size_t surface = 0;          ///< that is grazed
  bool least = false;               ///< where its value is least, else where it is greatest
  bool rising = false;              ///< that value rises along the branch
  int nullity = 1;                  ///< multipliers that cross +1 or -1 together, with as many eigenvectors
  int resonance = 0;                ///< k of 1 ... 4: a strong resonance 1:k [A-resonance]; 0: none, or not known
  std::string note{};               ///< what was not as usual
};

/// The same orbits by another tolerance or subdivision.
struct Refinement {
  integrate::FlowFamily flows;
  int shooting_intervals = 1;  ///< for each of the family's
};

struct SpecialOptions {
  std::vector<Refinement> others{};  ///< the finest last; none: no bounds
  bool branch_counts =
      true;  ///< is the value by the branch's own family one of the v_k? If not, by three others or more
  double safety = 3;

  /// @throws InputError for a safety factor below 1, or too few others
  void validate() const;
};

/// Those between two neighbours on a branch, in its order.
[[nodiscard]] std::vector<SpecialPoint> special_points_between(const OrbitFamily& family, const BranchOrbit& a,
                                                               const BranchOrbit& b, const SpecialOptions& options);

}  // namespace epicyclic::analysis
