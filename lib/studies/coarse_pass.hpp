// Initial states of the segments of a continued sweep. A pass along the whole range takes a few mesh periods at each
// grid point, at up to a hundred times the tolerance. It follows the same branches as the sweep in one chain, so that
// hysteresis is kept.
//
// A segment starts from the pass's state after the point before its first. The pass is a pure function of the input: it
// does not depend on the thread or the time of the request. Each process that needs it computes it again, as far as it
// needs it.
//
// Limits: a shorter transient may leave a branch earlier or later near a boundary between two basins, and where the
// sweep in one chain has not converged after its transient. The points up to the next change of the attractor then
// differ.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <mutex>
#include <vector>

#include "integrate/make_flow.hpp"
#include "studies/sweep.hpp"

namespace epicyclic::studies {

class CoarsePass {
 public:
  /// All of them have to live longer.
  CoarsePass(const SweepPlan& plan, const integrate::IntegratorOptions& integrator, const ModelAtPoint& model_at)
      : plan_(plan), integrator_(integrator), model_at_(model_at) {}

  /// The state from which a chain starts whose first point is this one. It is empty, for the default start, at the
  /// first point of a direction, without segments and after a trajectory that did not reach its end. Several threads
  /// may call it.
  /// The first caller advances the pass of a direction; other callers wait meanwhile.
  /// @param go_on      returns false to give up: the result is then empty
  /// @param make_flow  makes the flow that advances the pass
  /// @param wait       returns once its argument returns true
  [[nodiscard]] std::vector<double> start_of(std::size_t first, const std::function<bool()>& go_on,
                                             const integrate::FlowMaker& make_flow,
                                             const std::function<void(const std::function<bool()>& over)>& wait);

 private:
  struct DirectionPass {
    bool in_progress = false;  ///< a thread advances it now
    std::size_t next = 0;      ///< point that the pass has come to, counted within the direction
    std::vector<double> state;
    std::map<std::size_t, std::vector<double>> starts;
  };

  /// Advances the pass by one point. Until it returns, the state belongs to the caller.
  /// @returns false if given up
  bool advance(DirectionPass& pass, std::size_t point, const std::function<bool()>& go_on,
               const integrate::FlowMaker& make_flow);

  /// Goes to the next point, and keeps the state if a segment starts there.
  void keep(DirectionPass& pass, std::size_t first_of_direction);

  const SweepPlan& plan_;
  const integrate::IntegratorOptions& integrator_;
  const ModelAtPoint& model_at_;
  std::mutex mutex_;
  std::map<std::size_t, DirectionPass> passes_;  ///< by direction; its members belong to the thread that advances it
};

}  // namespace epicyclic::studies
