// Where the segments of a carried sweep start: a pass along the whole range, each grid point for a few mesh periods
// only and at up to a hundred times the tolerance, that follows the same branches as the sweep in one chain does, so
// that hysteresis is kept.
//
// A segment starts from the pass's state after the point before its first. The pass is a pure function of the input: it
// is the same whoever asks and whenever, and is computed again by each process that needs it, as far as it needs it.
//
// Limits: near a boundary between two basins, and where the sweep in one chain is still settling after its transient, a
// shorter look may leave the branch earlier or later, and what follows to the next change of the motion differs.
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

  /// The state that a chain starts from whose first point is this one; empty, for the default start, at the first point
  /// of a direction, without segments and after a motion that did not reach its end. May be called from several
  /// threads.
  /// Whoever asks first carries the pass of a direction on; who asks meanwhile waits.
  /// @param go_on      returns false to give up: the result is then empty
  /// @param make_flow  what the pass is carried by
  /// @param wait       returns once its argument returns true
  [[nodiscard]] std::vector<double> start_of(std::size_t first, const std::function<bool()>& go_on,
                                             const integrate::FlowMaker& make_flow,
                                             const std::function<void(const std::function<bool()>& over)>& wait);

 private:
  struct DirectionPass {
    bool in_progress = false;  ///< by someone, just now
    std::size_t next = 0;      ///< point that the pass has come to, counted within the direction
    std::vector<double> state;
    std::map<std::size_t, std::vector<double>> starts;
  };

  /// One point of a way; its state is the caller's meanwhile.
  /// @returns false if given up
  bool advance(DirectionPass& pass, std::size_t point, const std::function<bool()>& go_on,
               const integrate::FlowMaker& make_flow);

  /// Goes to the next point, and keeps the state if a segment starts there.
  void keep(DirectionPass& pass, std::size_t first_of_direction);

  const SweepPlan& plan_;
  const integrate::IntegratorOptions& integrator_;
  const ModelAtPoint& model_at_;
  std::mutex mutex_;
  std::map<std::size_t, DirectionPass> passes_;  ///< by direction; its members belong to who carries it
};

}  // namespace epicyclic::studies
