// Flow: what analysis knows of a dynamical system. It carries a state along the independent variable s.
//
//   dy/ds = g(s, y) ,  phi(s_0 -> s_1): y(s_0) -> y(s_1)
//
// For a gear train s is the mesh phase and g has the period 2 pi. Any system with a VectorField can be made a Flow, so
// analysis is tested on systems with known answers through the same code.
//
// Smoothness: g may jump in s at the breakpoints (which every Flow steps onto exactly) and have kinks across the
// switching surfaces (which a Flow may ignore).
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace epicyclic::integrate {

/// A surface in state space where the vector field is not smooth: it is crossed when `value` changes sign.
struct SwitchingSurface {
  std::string name;
  std::function<double(double s, std::span<const double> y)> value;
};

/// The right-hand side of a system.
struct VectorField {
  std::size_t dimension = 0;
  double period = 0;                ///< of g in s; 0 if g does not depend on s
  std::vector<double> breakpoints;  ///< where g may jump in s, in [0, period), rising

  /// dy/ds at s, one-sided: segment k is that after breakpoint k (the last one wraps); 0 if there are no breakpoints.
  std::function<void(std::size_t segment, double s, const double* y, double* dyds)> right_hand_side;

  std::vector<SwitchingSurface> surfaces;
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

  /// Calls of the right-hand side since construction.
  [[nodiscard]] virtual long right_hand_side_calls() const = 0;

  /// Forgets the step size of earlier evolutions, so that the next one depends on its arguments alone.
  virtual void forget() = 0;
};

/// Index of the segment that begins at, or contains, s (s reduced to the period).
[[nodiscard]] std::size_t segment_after(const VectorField& field, double s);

/// Breakpoints strictly inside (from, to), in order, all periods.
[[nodiscard]] std::vector<double> breakpoints_between(const VectorField& field, double from, double to);

}  // namespace epicyclic::integrate
