// How long a study takes on this machine, measured on a part of it.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <functional>
#include <future>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "commands.hpp"
#include "input/study_input.hpp"
#include "stop.hpp"
#include "studies/cost_estimate.hpp"
#include "studies/sweep.hpp"

namespace epicyclic::app {

/// Time limit of the measurement, however long the points take. Work that does not check the clock, within a mesh
/// period of minutes, is abandoned at this limit.
constexpr std::chrono::milliseconds measured_for{4000};
constexpr std::chrono::milliseconds given_up_after{4700};

/// Threads that have anything to do.
[[nodiscard]] inline double busy(std::size_t units, int threads) {
  return static_cast<double>(std::min(units, static_cast<std::size_t>(threads)));
}

/// The time that measuring has. Work is done in a thread of its own, and left behind if it does not end.
class TimeLimit {
 public:
  TimeLimit() : clock_([this] { wait(); }) {}
  TimeLimit(const TimeLimit&) = delete;
  TimeLimit& operator=(const TimeLimit&) = delete;
  ~TimeLimit() {
    {
      const std::scoped_lock lock(mutex_);
      unneeded_ = true;
    }
    changed_.notify_all();
    clock_.join();
  }

  /// Work that checks this flag returns soon once it is true.
  [[nodiscard]] const std::atomic<bool>& over() const { return over_; }

  /// @returns nothing if it was left behind: then the program has to end by leave()
  template <class Work>
  [[nodiscard]] auto in_time(Work work) -> std::optional<decltype(work())> {
    std::packaged_task<decltype(work())()> task(std::move(work));
    auto result = task.get_future();
    std::thread worker(std::move(task));
    if (result.wait_until(begun_ + given_up_after) != std::future_status::ready) {
      worker.detach();
      left_behind_ = true;
      return std::nullopt;
    }
    worker.join();
    return result.get();
  }

  /// Ends the program at once if work was left behind, which still uses what main() would destroy.
  void leave() const {
    if (left_behind_) leave_at_once(done);
  }

 private:
  void wait() {
    std::unique_lock lock(mutex_);
    changed_.wait_until(lock, begun_ + measured_for, [this] { return unneeded_; });
    over_ = true;
  }

  std::chrono::steady_clock::time_point begun_ = std::chrono::steady_clock::now();
  std::atomic<bool> over_{false};
  bool left_behind_ = false;
  bool unneeded_ = false;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::thread clock_;
};

[[nodiscard]] inline double seconds_of(std::chrono::duration<double> time) { return time.count(); }

/// How long a study takes, by what was measured of it.
struct Expected {
  double seconds = 0;
  double at_least = 0;      ///< if time was over before all that was to be measured was done; else 0
  std::string measured{};   ///< in words
  bool one_thread = false;  ///< one thread computes it, whatever number of threads is set
  std::string besides{};    ///< what takes time and is not measured, in words
};

/// Of points whose miniature was measured.
/// @param seconds  of all points, if those of the miniature were all done
[[nodiscard]] Expected expected_of(double seconds, const studies::Measured& m);

/// Measures a study of a kind.
using TimeOfStudy = Expected (*)(const input::LoadedInput& input, const studies::SweepPlan& plan, int threads,
                                 const TimeLimit& limit);

/// Seconds of what is done with the points afterwards; nothing if time is over.
/// @param miniature, points  of the study, all computed
using TimeAfterPoints = std::function<std::optional<double>(const studies::SweepPlan& miniature,
                                                            const std::vector<studies::PointResult>& points)>;

/// Of a study of points.
[[nodiscard]] Expected time_of_points(const input::LoadedInput& input, const studies::SweepPlan& plan, int threads,
                                      const TimeLimit& limit);

/// The same with what is done with the points afterwards.
/// @param after    may be empty
/// @param without  names what it measures
[[nodiscard]] Expected time_with_checks(const input::LoadedInput& input, const studies::SweepPlan& plan, int threads,
                                        const TimeLimit& limit, const TimeAfterPoints& after, const char* without);

}  // namespace epicyclic::app
