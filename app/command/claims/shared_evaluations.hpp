// Evaluations of candidates on several ranks. Rank 0 leads: it searches or surveys, in as many threads as all ranks
// have together, keeps the journal, and talks to the user. Each evaluation is computed by whoever is free, here or on
// another rank, and is a function of the candidate alone, so that it does not matter by whom.
#pragma once

#include <atomic>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "claims/candidates.hpp"
#include "commands.hpp"
#include "input/study_input.hpp"

namespace epicyclic::app {

/// What the leader does besides: evaluations by all ranks. Alone it is the evaluator itself.
class SharedEvaluations {
 public:
  explicit SharedEvaluations(const Arguments& arguments) : arguments_(arguments) {}

  /// Waits until all have said who they are; nothing to wait for alone.
  /// @throws Failure when a rank cannot take part
  void gather(const std::string& identity);

  /// Set when a signal has come, to this rank or to another. Evaluations here, and the threads that wait for them, then
  /// end.
  [[nodiscard]] const std::atomic<bool>& stop() const;

  /// @param here  evaluates on this rank; checks stop()
  /// @param work  receives an evaluator, and threads that may call it at the same time
  /// @throws the first exception of the work, or Failure of another rank
  void run(const claims::Evaluator& here,
           const std::function<void(const claims::Evaluator& evaluate, int threads)>& work);

 private:
  const Arguments& arguments_;
  std::vector<int> threads_;  ///< of each rank
  std::atomic<bool> stop_{false};
};

/// How a rank evaluates candidates of an input: `stop` ends it.
using MakeEvaluator = std::function<claims::Evaluator(const input::LoadedInput& input, const std::atomic<bool>& stop)>;

/// A command whose evaluations are shared.
/// @param lead  the command, on the first rank
/// @returns exit code of all
int share_evaluations(const Arguments& arguments, std::string_view command, const MakeEvaluator& evaluator,
                      const std::function<int(SharedEvaluations& shared)>& lead);

}  // namespace epicyclic::app
