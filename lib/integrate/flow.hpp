// Flow: what analysis knows of a dynamical system. It carries a state along the independent variable s.
//
//   dy/ds = g(s, y; p) ,        phi(s_0 -> s_1): y(s_0) -> y(s_1)
//   dv/ds = (dg/dy) v ,         a tangent vector: (d phi / dy) v
//   dw/ds = (dg/dy) w + dg/dp , the derivative of the state with respect to a parameter p
//
// For a gear train s is the mesh phase and g has the period 2 pi. Any system with a VectorField can be made a Flow, so
// analysis is tested on systems with known answers through the same code.
//
// Smoothness: g may jump in s at the breakpoints (which every Flow steps onto exactly) and have kinks across the
// switching surfaces (which a Flow may ignore). Tangents pass a kink of a continuous g without a jump; where g itself
// jumps across a surface (contact-slope damping with an exact gap) they would need a jump that no Flow makes.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/push_forward.hpp"

namespace epicyclic::integrate {

/// Surfaces in state space where the vector field is not smooth: each is crossed when its value changes sign.
struct SwitchingSurfaces {
  std::size_t count = 0;
  /// Values at a state, and d/ds of them along the motion through it, `count` numbers each.
  std::function<void(double s, const double* y, double* values, double* rates)> evaluate;
};

/// What a field was made of; lanes look for the kind that they know by dynamic_cast.
struct Origin {
  Origin() = default;
  Origin(const Origin&) = default;
  Origin& operator=(const Origin&) = default;
  virtual ~Origin() = default;
};

/// The right-hand side of a system.
struct VectorField {
  std::size_t dimension = 0;
  double period = 0;                ///< of g in s; 0 if g does not depend on s
  std::vector<double> breakpoints;  ///< where g may jump in s, in [0, period), rising

  /// dy/ds at s, one-sided: segment k is that after breakpoint k (the last one wraps); 0 if there are no breakpoints.
  std::function<void(std::size_t segment, double s, const double* y, double* dyds)> right_hand_side;

  /// dy/ds, and (dg/dy) v_j for each of the given tangent vectors; integrate/make_field.hpp makes it. Needed by
  /// implicit methods (their Jacobian is this at the unit vectors) and by evolve_tangents(); empty where neither is
  /// used.
  std::function<void(std::size_t segment, double s, const double* y, const Columns<const double>& v, double* dyds,
                     const Columns<double>& dvds)>
      tangents;

  /// dg/dp at fixed y; empty if no parameter is varied.
  std::function<void(std::size_t segment, double s, const double* y, double* dgdp)> parameter_derivative;

  /// For lanes that know the kind (integrate/lanes/lane_ensemble.hpp); may be null.
  std::shared_ptr<const Origin> origin;

  SwitchingSurfaces surfaces;

  /// g itself jumps across a surface: tangent vectors would have to jump there, which no Flow does.
  bool jumps_at_surfaces = false;
};

/// How an evolution ended. None of these is an exception.
enum class Outcome {
  reached,     ///< the state is that at the end
  diverged,    ///< a component left the escape bound: the state is the last accepted one
  step_limit,  ///< more steps than allowed: the state is the last accepted one
  failed,      ///< no step is accepted (a right-hand side that is not finite, a tolerance below rounding): likewise
};

struct Evolution {
  Outcome outcome = Outcome::reached;
  double s = 0;         ///< where the state is
  std::string message;  ///< empty if reached

  [[nodiscard]] bool reached() const { return outcome == Outcome::reached; }
};

/// Sees the solution at requested values of s, in order. The state is valid during the call.
using Observer = std::function<void(std::size_t index, double s, std::span<const double> y)>;

/// What a Flow has done since construction.
struct Work {
  long right_hand_sides = 0;          ///< evaluations of g, those with tangents not counted
  long tangent_right_hand_sides = 0;  ///< evaluations of g with all tangent vectors
  long jacobians = 0;                 ///< evaluations of dg/dy for implicit methods
  long steps = 0;                     ///< attempted
};

/// Which equation the tangent vectors obey.
enum class LastTangent {
  homogeneous,  ///< dv/ds = (dg/dy) v for all
  parameter,    ///< the last one is the derivative with respect to the parameter: dg/dp is added to it
};

class Flow {
 public:
  Flow() = default;
  Flow(const Flow&) = delete;
  Flow& operator=(const Flow&) = delete;
  virtual ~Flow() = default;

  [[nodiscard]] virtual const VectorField& field() const = 0;

  /// Carries the state from s = from to s = to > from.
  ///
  /// @param state    dimension() numbers, replaced
  /// @param samples  rising values of s in (from, to] at which `observer` sees the dense output; their number does not
  ///                 change the state at the end
  /// @throws SolverError when the library fails for another reason than the problem; whatever the right-hand side
  /// throws
  virtual Evolution evolve(std::span<double> state, double from, double to, std::span<const double> samples,
                           const Observer& observer) = 0;

  Evolution evolve(std::span<double> state, double from, double to) { return evolve(state, from, to, {}, {}); }

  /// Carries the state and m tangent vectors through the same steps.
  ///
  /// @param tangents  m vectors of dimension() numbers one behind the other, replaced; if not reached, those at the
  ///                  state's place
  /// @throws InputError when the field has no tangents or jumps at surfaces, or when a parameter derivative is asked of
  /// a field without one
  virtual Evolution evolve_tangents(std::span<double> state, std::span<double> tangents, double from, double to,
                                    LastTangent last) = 0;

  Evolution evolve_tangents(std::span<double> state, std::span<double> tangents, double from, double to) {
    return evolve_tangents(state, tangents, from, to, LastTangent::homogeneous);
  }

  [[nodiscard]] virtual Work work() const = 0;

  /// Calls of the right-hand side since construction, alone or with tangents.
  [[nodiscard]] long right_hand_side_calls() const {
    const Work w = work();
    return w.right_hand_sides + w.tangent_right_hand_sides;
  }

  /// Length of the step that the next evolution begins with; 0 leaves it to the method. With the state it is all that a
  /// Flow remembers: another Flow that is given both goes on with the same bits (explicit Runge-Kutta, whose restart
  /// loses nothing).
  [[nodiscard]] virtual double next_step() const = 0;
  virtual void set_next_step(double step) = 0;

  /// Forgets the step size of earlier evolutions, so that the next one depends on its arguments alone.
  void forget() { set_next_step(0.0); }
};

/// Index of the segment that begins at, or contains, s (s reduced to the period).
[[nodiscard]] std::size_t segment_after(const VectorField& field, double s);

/// Breakpoints strictly inside (from, to), in order, all periods.
[[nodiscard]] std::vector<double> breakpoints_between(const VectorField& field, double from, double to);

/// What every evolve_tangents() asks of its arguments.
/// @throws InputError as documented there
void check_tangents(const VectorField& field, std::span<const double> tangents, LastTangent last);

/// dg/dy, column by column.
///
/// @param jacobian  dimension() x dimension() numbers
/// @throws InputError when the field has no tangents
void jacobian(const VectorField& field, std::size_t segment, double s, const double* y, std::span<double> jacobian);

}  // namespace epicyclic::integrate
