// The lane ensemble: many trajectories at once, one SIMD lane each, every one with its own phase, step and acceptance.
//
//   y' = y + h sum_j b_j k_j ,  e = h sum_j (b_j - b^_j) k_j     Dormand and Prince 5(4), or Cash and Karp 5(4)
//   accepted when  | e | <= 1  in the weighted root mean square of integrate/options.hpp, weights of the step's start
//   h <- h min(20, max(0.1, 0.96 (1.5 |e|)^(-1/5))), kept where it would grow by less than half         [I-lane]
//
// the norm, the safety and bias factors and the limits of ARKODE's I controller. A lane is never in step with the
// others: its bits are those of a run alone, whatever the other lanes integrate and however wide the registers are.
//
// That formula is one for smooth fields. Across a kink the error falls with the square of the step's length, not with
// its fifth power. So a kink costs several refusals and the short steps after them. If a refused step has crossed a
// switching surface, the next attempt ends on it instead:
//
//   h <- h t ,  t the first root of the cubic through g and dg/ds at both ends of the step                [I-land]
//
// The kink then lies at the start of the step after that, but for an error that is squared. Nothing depends on the
// root: the step is judged as any other, and its slopes are those of the field as it is.
//
// Slopes of tangent vectors jump at a kink. In a step that crosses a kink, or ends on it, some of them belong to the
// wrong side. The error is of first order, up to b_1 h (J+ - J-) v, whatever the tolerance. If steps end on kinks, it
// has one sign at all of them, so that a torus seems to attract or to repel. With tangent vectors, only short steps
// cross a surface. Steps end before it, and behind the short step the step's length is the previous one:
//
//   h <- h (t - m),  then  2 m h ,  m = 1e-2, or 1e-3 where errors of vectors count                       [I-hop]
//
// The kink is then in the midst of the short step, where its error is below 2 m b_1 h (J+ - J-) v.
//
// An evolution is begun in a lane, and run() goes on until the first one has ended. The caller reads it, and begins the
// next one, of the same system or of another. Breakpoints are stepped onto; samples come from the cubic Hermite
// polynomial through both ends of a step, as ARKODE's do. Sources of the pairs: J. R. Dormand, P. J. Prince, J. Comput.
// Appl. Math. 6 (1980) 19; J. R. Cash, A. H. Karp, ACM Trans. Math. Softw. 16 (1990) 201.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/vector_field.hpp"
#include "integrate/flow.hpp"
#include "integrate/lanes/step_loops.hpp"
#include "integrate/options.hpp"

namespace epicyclic::integrate {

/// Any systems of one dimension, each lane by its own right-hand side: nothing is gained but the lanes' bookkeeping.
/// @param surfaces  that each system has and steps land on, or 0: those of the systems are ignored
[[nodiscard]] LaneField one_by_one(std::size_t width, std::size_t dimension, std::size_t surfaces = 0);

class LaneEnsemble {
 public:
  /// @param field  of kernels.width lanes
  /// @throws InputError for options out of range or that lanes do not have (another method, located contacts), or a
  /// field of another width
  LaneEnsemble(LaneField field, const IntegratorOptions& options, const StepLoops& kernels = step_loops());
  ~LaneEnsemble();
  LaneEnsemble(const LaneEnsemble&) = delete;
  LaneEnsemble& operator=(const LaneEnsemble&) = delete;

  [[nodiscard]] std::size_t width() const;

  /// The systems are a state of n components and tangent vectors of as many: the state's error is controlled, and that
  /// of the first `vectors` of them, each in parts of its largest component; of the last one, if it is the derivative
  /// with respect to a parameter, in parts of 1 until it is longer. The step's error is then that of the worst.
  void control(std::size_t n, std::size_t vectors, bool last_is_parameter);

  /// All lanes are to take the same steps, those of the worst: for the same state in each, with tangent vectors of its
  /// own. They have to be begun together.
  void keep_together();

  /// Those of a lane's next evolutions; those of the options until they are set.
  void set_tolerances(std::size_t lane, double relative, double absolute);

  /// Puts a system into an idle lane. `system` is kept until the next one.
  void load(std::size_t lane, const VectorField& system);

  /// As Flow::evolve(), but it has only begun; samples and observer are kept until it has ended.
  void begin(std::size_t lane, std::span<const double> state, double from, double to,
             std::span<const double> samples = {}, const Observer& observer = {});

  [[nodiscard]] bool busy(std::size_t lane) const;

  /// Goes on until an evolution has ended.
  /// @returns its lane, or width() if all lanes are idle
  std::size_t run();

  /// Of the lane's last evolution, once it has ended.
  [[nodiscard]] const Evolution& evolution(std::size_t lane) const;
  void copy_state(std::size_t lane, std::span<double> state) const;

  /// As of a Flow, for each lane.
  [[nodiscard]] double next_step(std::size_t lane) const;
  void set_next_step(std::size_t lane, double step);

  /// Right-hand sides that a lane's evolutions took since it was loaded, and steps attempted.
  [[nodiscard]] Work work(std::size_t lane) const;

  /// Evaluations of the kernel, of all lanes at once, and the lanes in progress, summed over them.
  [[nodiscard]] std::size_t evaluations() const;
  [[nodiscard]] std::size_t evaluations_in_progress() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace epicyclic::integrate
