// The right-hand side of a system of first-order equations, alone or many side by side.
//
//   dy/ds = g(s, y; p)
//
// Smoothness: g may jump in s at the breakpoints and have kinks across the switching surfaces. Tangents pass a kink of
// a continuous g without a jump; where g itself jumps across a surface (contact-slope damping with an exact gap) they
// would need a jump that no Flow makes.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <vector>

#include "core/errors.hpp"
#include "core/push_forward.hpp"

namespace epicyclic {

/// Surfaces in state space where the vector field is not smooth: each is crossed when its value changes sign.
struct SwitchingSurfaces {
  std::size_t count = 0;
  /// Values at a state, and d/ds of them along the trajectory through it, `count` numbers each.
  std::function<void(double s, const double* y, double* values, double* rates)> evaluate;
};

/// The source of a field; lanes find the type that they know by dynamic_cast.
struct Origin {
  Origin() = default;
  Origin(const Origin&) = delete;
  Origin& operator=(const Origin&) = delete;
  virtual ~Origin() = default;
};

/// dy/ds, and (dg/dy) v_j for each of the given tangent vectors.
using TangentFunction = std::function<void(std::size_t segment, double s, const double* y,
                                           const Columns<const double>& v, double* dyds, const Columns<double>& dvds)>;

/// dg/dp at fixed y.
using ParameterFunction = std::function<void(std::size_t segment, double s, const double* y, double* dgdp)>;

struct VectorField {
  std::size_t dimension = 0;
  double period = 0;                ///< of g in s; 0 if g does not depend on s
  std::vector<double> breakpoints;  ///< where g may jump in s, in [0, period), rising; steps end there

  /// Greatest distance in s between two evaluations of g within a step, one for each segment: g has features that are
  /// at least twice as wide. Infinite, or empty: no such bound.
  std::vector<double> sampling_interval;

  /// dy/ds at s, one-sided: segment k is that after breakpoint k (the last one wraps); 0 if there are no breakpoints.
  std::function<void(std::size_t segment, double s, const double* y, double* dyds)> right_hand_side;

  /// integrate/make_field.hpp makes it. Needed by implicit methods (their Jacobian is this at the unit vectors) and by
  /// Flow::evolve_tangents(); empty where neither is used.
  TangentFunction tangents;

  /// Empty if no parameter is varied.
  ParameterFunction parameter_derivative;

  std::shared_ptr<const Origin> origin;  ///< for lanes that know the kind; may be null

  SwitchingSurfaces surfaces;

  /// g itself jumps across a surface: tangent vectors would have to jump there, which no Flow does.
  bool jumps_at_surfaces = false;
};

/// The period of a field that has one.
/// @throws DomainError if g does not depend on s, so that there is no section
[[nodiscard]] inline double period_of(const VectorField& field) {
  if (!(field.period > 0.0)) throw DomainError("a period of the field is needed, and it has none");
  return field.period;
}

/// Systems that differ by a parameter: the one at its value.
using FieldFamily = std::function<VectorField(double value)>;

/// Right-hand sides of W systems side by side, one SIMD lane each. Component i of lane w lies at [i W + w], memory is
/// aligned to 64 bytes.
struct LaneField {
  std::size_t width = 0;  ///< W
  std::size_t dimension = 0;
  /// Puts a system into a lane, its segment the first.
  /// @throws InputError when the systems cannot run side by side
  std::function<void(std::size_t lane, const VectorField& field)> load;
  /// Which side of its own breakpoints the lane's system is on.
  std::function<void(std::size_t lane, std::size_t segment)> set_segment;
  /// The places of a step's slopes, W numbers each, in the lanes' present segments: what a field has of s alone it may
  /// make for all of them at once.
  std::function<void(std::size_t count, const double* s)> set_places;
  /// dy/ds of all lanes at one of those places.
  std::function<void(std::size_t place, const double* y, double* dyds)> right_hand_side;
  std::size_t surfaces = 0;  ///< that steps land on
  /// SwitchingSurfaces::evaluate of all lanes at one of those places.
  std::function<void(std::size_t place, const double* y, double* values, double* rates)> surface_values;
};

}  // namespace epicyclic
