// Lanes that many trajectories share, each integrated by a function that is written as if it were alone.
//
// run() starts fibers [core/fiber.hpp]. A fiber uses flows of the pool like any flows. An evolution waits for a lane,
// and other fibers go on meanwhile. With more fibers than lanes the lanes are always taken. A trajectory's bits are
// those of a lane alone [lane_ensemble.hpp], so nothing depends on the other evolutions.
//
// One tangent vector is integrated beside its state in a lane. Many of them, as for a monodromy, are lanes of one
// another: the state is the same in each, the steps are those of the worst, and they are through at once.
//
// Limits: a pool, its flows and its fibers belong to one thread. The derivative with respect to a parameter is
// ARKODE's.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>

#include "core/vector_field.hpp"
#include "integrate/flow.hpp"
#include "integrate/lanes/step_loops.hpp"
#include "integrate/options.hpp"

namespace epicyclic::integrate {

class LanePool {
 public:
  /// Lanes for states with so many tangent vectors behind each; of width 0 if there are none, of tangents or at all.
  using Lanes = std::function<LaneField(std::size_t vectors)>;

  /// @param options  their method and limits are those of all flows, which have tolerances of their own
  /// @throws InputError as LaneEnsemble does
  LanePool(Lanes lanes, const IntegratorOptions& options, const StepLoops& kernels = step_loops());
  ~LanePool();
  LanePool(const LanePool&) = delete;
  LanePool& operator=(const LanePool&) = delete;

  [[nodiscard]] std::size_t width() const;

  /// A flow whose evolutions take a lane each. A field that cannot run beside the others is integrated alone.
  /// @throws InputError for options out of range
  [[nodiscard]] std::unique_ptr<Flow> make_flow(VectorField field, const IntegratorOptions& options);

  /// Calls `work` in so many fibers at once, until all have returned.
  /// @throws the first exception of one of them; the others are then unwound
  void run(std::size_t fibers, const std::function<void()>& work);

  /// In a fiber: others go on until `over` returns true. It may wait for another thread.
  void wait(const std::function<bool()>& over);

  /// Evaluations of the right-hand side for which the shared lanes had room, and the number of them that were used.
  [[nodiscard]] std::size_t room() const;
  [[nodiscard]] std::size_t taken() const;

 private:
  class Impl;
  class PooledFlow;
  std::unique_ptr<Impl> impl_;
};

}  // namespace epicyclic::integrate
