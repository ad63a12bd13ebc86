// A sweep on several ranks. Rank 0 leads: it holds the folder, knows what is done, hands out chains as ranks become
// free, and talks to the user. The others follow: each computes the chains that it is given, with threads and lanes of
// its own, and keeps its points in a journal of its own in the folder. The parts of the results, too, are written by
// whoever is free.
//
// Chains are fixed by the input and a point is a function of its value and start, so that it does not matter who
// computes what. Nothing is lost with a rank but the points it had not finished.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "commands.hpp"
#include "input/study_input.hpp"
#include "parts.hpp"
#include "studies/sweep.hpp"

namespace epicyclic::app {

/// What the leader does besides computing.
class SweepLeader {
 public:
  explicit SweepLeader(Ranks& ranks) : ranks_(ranks) {}

  /// Waits until all have said who they are.
  /// @throws Failure when a rank cannot take part: it cannot read the input, has another one, or is another program
  void gather(const Arguments& arguments, const std::string& identity);

  /// run_sweep on all ranks, until all have ended and closed their journals.
  /// @param points_elsewhere  called now and then with how many points a rank has finished since, and how many failed
  /// @throws the first exception here or Failure of another rank, after all have ended
  void run(const studies::SweepPlan& plan, const studies::RecordingOptions& recording,
           const integrate::IntegratorOptions& integrator, const studies::ModelAtPoint& model_at, studies::SweepRun run,
           const std::function<void(std::size_t finished, std::size_t failed)>& points_elsewhere);

  /// Once all points are in the journals, which nobody appends to any more.
  /// @param computed  what the parts are written with here
  /// @returns what each part has written
  /// @throws the first exception here or Failure of another rank, after all have ended
  std::vector<WrittenPoints> write(const std::vector<ResultsPart>& parts, const ComputedPoints& computed, int threads);

  /// Lets the others go.
  void dismiss(int exit_code);

 private:
  Ranks& ranks_;
  int threads_of_all_ = 0;
  bool silent_ = false;  ///< a rank did not answer the message to stop
};

/// All ranks but the first. Prints nothing: the first rank reports errors.
/// @returns the exit code of all
int follow(const Arguments& arguments, std::string_view command, const std::vector<ResultsPart>& parts);

}  // namespace epicyclic::app
