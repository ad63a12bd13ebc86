// The folder of a study that is complete, opened to read: a donor of seeds, or a sweep to be proved.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "commands.hpp"
#include "input/study_input.hpp"
#include "store/point_store.hpp"
#include "studies/expected_points.hpp"
#include "studies/sweep_plan.hpp"

namespace epicyclic::app {

/// Its points come from its journal, which holds them to the last bit. Of a run, which keeps none, from its tables.
class FinishedStudy {
 public:
  /// Changes nothing in it.
  /// @throws InputError when there is no complete study whose points are kept, or one of other numerics; DamagedData
  /// when its files are not what they were
  explicit FinishedStudy(const std::filesystem::path& folder);

  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
  [[nodiscard]] const input::LoadedInput& input() const { return input_; }
  [[nodiscard]] const std::string& identity() const { return identity_; }
  [[nodiscard]] const studies::SweepPlan& plan() const { return *plan_; }
  [[nodiscard]] studies::PointSource points() const;

  /// The equations at one of its points.
  [[nodiscard]] model::DynamicModel model_at(std::size_t point) const;

 private:
  FinishedStudy(const std::filesystem::path& folder, const nlohmann::json& run);
  void read_run();

  std::filesystem::path folder_;
  input::LoadedInput input_;
  std::string identity_;
  std::unique_ptr<studies::SweepPlan> plan_;
  std::unique_ptr<store::PointStore> store_;  ///< null of a run
  std::vector<studies::PointResult> run_;     ///< its one point
};

/// The folder of a study that is complete, of whatever numerics, whose tables are to be read.
struct FinishedTables {
  std::filesystem::path folder;
  input::LoadedInput input;
};

/// Changes nothing in it.
/// @param tables  of the study, that have to be as they were left
/// @throws InputError when there is no complete study in it, DamagedData when its files are not what they were
[[nodiscard]] FinishedTables finished_tables(
    const std::filesystem::path& folder, const std::function<std::vector<std::string>(const input::Study&)>& tables);

/// The folder of branches that are complete, opened to read.
struct FinishedBranches {
  input::LoadedInput input;
  std::vector<studies::LocatedPoint> points;  ///< each once, in the order of special.csv
};

/// Changes nothing in it.
/// @throws InputError when there are no complete branches in it, DamagedData when its files are not what they were
[[nodiscard]] FinishedBranches finished_branches(const std::filesystem::path& folder);

/// The argument of --from: a folder, and one of its points or none.
struct Donor {
  std::filesystem::path folder;
  std::string text;                               ///< as given
  std::optional<std::size_t> point{};             ///< by its index,
  std::optional<studies::Direction> direction{};  ///< or by a direction and a value along it
  double value = 0;
  std::string unit{};  ///< "rpm" or "Hz" of a speed of the sun or of the mesh; empty: as the sweep has it

  [[nodiscard]] bool all() const { return !point && !direction; }
};

/// "FOLDER", "FOLDER:INDEX", "FOLDER:up=VALUE" or "FOLDER:down=VALUE"; VALUE may be of a sweep over the speed in rpm of
/// the sun or in Hz of the mesh: "FOLDER:up=3000rpm".
/// @throws InputError for an INDEX or a VALUE that is no such number
[[nodiscard]] Donor parse_donor(const std::string& text);

/// The index of its point.
/// @throws InputError where the study has no such point; of a value, none within half a step
[[nodiscard]] std::size_t point_of(const Donor& donor, const FinishedStudy& from);

/// What is known of a start by --from.
struct StartFacts {
  std::vector<std::string> lines;  ///< where it starts, and other attractors there
  bool is_chaotic = false;         ///< a chaotic response of the same equations of motion
};

/// The study of `run`, `crosscheck` or `tolerance`. With --from, it starts from the point that --from names. With
/// INPUT, it is that of INPUT, with the point's state as its initial state. Without INPUT, it is the point itself.
/// Prints on stderr where the study starts, and which other attractors are known there.
/// @param facts  receives what was printed and what is known of the start, if it is not null
/// @throws InputError without INPUT and --from, with several, if there is no such point, and if it has no state
[[nodiscard]] input::LoadedInput with_start(const Arguments& arguments, std::string_view kind,
                                            StartFacts* facts = nullptr);

/// Puts the donors' states into the study as its seeds.
/// @param sets  of the command line
/// @returns the input with them, and what has to be said of them on stderr
/// @throws InputError for a donor that has no such point, or one that moves by other equations in another state
[[nodiscard]] input::LoadedInput with_seeds(const std::filesystem::path& study,
                                            const std::vector<input::Assignment>& sets,
                                            const std::vector<std::string>& donors, std::vector<std::string>& notes);

}  // namespace epicyclic::app
