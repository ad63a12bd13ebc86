// The parts that the results of a study of points are written in: small enough to be shared out evenly.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "input/study_input.hpp"
#include "reports/sweep_output.hpp"
#include "store/manifest.hpp"

namespace epicyclic::app {

/// What the results are written with, once all points are there.
struct ComputedPoints {
  const std::filesystem::path& folder;
  const input::LoadedInput& input;
  const model::DynamicModel& first_model;
  const std::string& resolved;
  const studies::PointSource points;
};

/// What was written.
struct WrittenPoints {
  std::vector<reports::DrawnFigure> figures{};
  nlohmann::json summary = nlohmann::json::object();  ///< joins that of --json
  std::vector<std::string> lines{};                   ///< for stdout
  std::vector<std::string> notes{};                   ///< for stderr
  store::Manifest files{};                            ///< that another process put into the folder
  std::size_t unexplained = 0;                        ///< comparisons; the exit code reports them
};

/// Writes files of its own, on any rank and beside the other parts.
struct ResultsPart {
  std::function<WrittenPoints(const ComputedPoints&)> write;
  std::optional<std::size_t> after{};  ///< an earlier part, whose files this one needs
};

/// Parts, handed out in order to free threads, each once. A part is passed over while the part before it is computed.
class PartQueue {
 public:
  /// @param parts  must live longer
  explicit PartQueue(const std::vector<ResultsPart>& parts) : parts_(parts), states_(parts.size(), State::waiting) {}

  /// Waits while all that is left has to wait. Nothing: all are begun, or no more is wanted.
  [[nodiscard]] std::optional<std::size_t> take();

  /// The next part that may begin now. Nothing: all that is left has to wait, all are begun, or no more is wanted.
  [[nodiscard]] std::optional<std::size_t> take_now();

  void ended(std::size_t part);

  /// No more is handed out.
  void close();

 private:
  enum class State { waiting, begun, ended };

  [[nodiscard]] bool exhausted() const;
  std::optional<std::size_t> take_locked();

  const std::vector<ResultsPart>& parts_;
  std::vector<State> states_;
  bool closed_ = false;
  std::mutex mutex_;
  std::condition_variable changed_;
};

/// Takes parts on several threads until there are none.
/// @param written  of all parts; those taken here are stored
/// @throws Stopped if the host of the command stops it [host.hpp]
/// @throws the first exception of a part, after the parts in progress have ended; the queue is then closed
void write_parts(const std::vector<ResultsPart>& parts, const ComputedPoints& computed, int threads, PartQueue& queue,
                 std::vector<WrittenPoints>& written);

}  // namespace epicyclic::app
