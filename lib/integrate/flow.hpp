// Flow: what analysis knows of a dynamical system. It integrates a state over the independent variable s.
//
//   dy/ds = g(s, y; p) ,        phi(s_0 -> s_1): y(s_0) -> y(s_1)
//   dv/ds = (dg/dy) v ,         a tangent vector: (d phi / dy) v
//   dw/ds = (dg/dy) w + dg/dp , the derivative of the state with respect to a parameter p
//
// For a gear train s is the mesh phase and g has the period 2 pi. Any system with a VectorField can be made a Flow, so
// analysis is tested on systems with known answers through the same code.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "core/vector_field.hpp"
#include "integrate/options.hpp"

namespace epicyclic::integrate {

/// How an evolution ended. None of these is an exception.
enum class Outcome {
  reached,     ///< the state is that at the end
  diverged,    ///< a component left the escape bound: the state is the last accepted one
  step_limit,  ///< more steps than allowed: the state is the last accepted one
  failed,      ///< no step is accepted (right-hand side not finite, tolerance below rounding): the last accepted state
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

/// @throws InputError unless both are numbers, and rise
void check_interval(double from, double to);

class Flow {
 public:
  Flow() = default;
  Flow(const Flow&) = delete;
  Flow& operator=(const Flow&) = delete;
  virtual ~Flow() = default;

  [[nodiscard]] virtual const VectorField& field() const = 0;

  /// Integrates the state from s = from to s = to > from.
  ///
  /// @param state    dimension() numbers, replaced
  /// @param samples  rising values of s in (from, to] at which `observer` sees the dense output; their number does not
  ///                 change the state at the end
  /// @throws InputError for an interval that does not rise; SolverError when the library fails for another reason than
  /// the problem; whatever the right-hand side throws
  virtual Evolution evolve(std::span<double> state, double from, double to, std::span<const double> samples,
                           const Observer& observer) = 0;

  Evolution evolve(std::span<double> state, double from, double to) { return evolve(state, from, to, {}, {}); }

  /// Integrates the state and m tangent vectors with the same steps.
  ///
  /// @param tangents  m vectors of dimension() numbers one behind the other, replaced; if not reached, those at the
  ///                  state's place
  /// @throws InputError when the field has no tangents or jumps at surfaces, or if a parameter derivative is requested
  /// of a field without one
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

/// The longest step in a segment by [I-sample]; infinite without a bound.
/// @param gap  widest distance of two neighbouring nodes of the method [steps]
[[nodiscard]] double longest_step(const VectorField& field, const IntegratorOptions& options, std::size_t segment,
                                  double gap);

/// Widest distance of two neighbouring nodes of a Runge-Kutta method, the ends of the step among them [steps].
[[nodiscard]] double widest_gap(std::span<const double> nodes);

/// Checks of every evolve_tangents() on its arguments.
void check_tangents(const VectorField& field, std::span<const double> tangents, LastTangent last);

/// dg/dy, column by column.
///
/// @param jacobian  dimension() x dimension() numbers
/// @throws InputError when the field has no tangents
void jacobian(const VectorField& field, std::size_t segment, double s, const double* y, std::span<double> jacobian);

}  // namespace epicyclic::integrate
