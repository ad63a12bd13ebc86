// The functions that each kind of study provides, such as a sweep or a map.
//
// Each kind is one object in a folder of its own, lib/kinds/NAME, and one line of kinds/list.hpp. A component above
// that layer adds its kinds by add_kind().
#pragma once

#include <any>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "gear/warnings.hpp"
#include "input/plan_checks.hpp"
#include "input/study_input.hpp"
#include "studies/sweep.hpp"

namespace epicyclic::input {

/// A parameter that the options vary: access to its name and its range, and its place in the study.
struct PlanAxis {
  std::string* name;
  double* from;
  double* to;
  int points;         ///< values that are checked before the study begins
  std::string place;  ///< such as "/study"
};

/// A number of the options with its place in the input.
struct PlacedNumber {
  double* value;
  std::string place;
};

/// The points that the complete folder of a kind keeps.
enum class PointsKept {
  none,
  journal,  ///< all points, to the last bit
  tables,   ///< one point, in points.csv and poincare.csv
};

/// What `plot` draws from a complete folder: points or curves over a parameter, cells over a plane, or histories.
enum class PlotForm { none, points, curves, cells, histories };

struct PlotSource {
  PlotForm form = PlotForm::none;
  std::vector<std::string> tables{};  ///< read for it
  std::string quantity{};             ///< drawn if none is given
};

/// Members that are null or empty do not apply to the kind. Each has a table.
struct StudyKind {
  std::string_view name;        ///< the value of "kind"
  std::string_view commands{};  ///< that compute it, in words; empty: the command of that name
  std::string_view missing{};   ///< why this program cannot compute it; the members below are then not used

  const Table<Study>& (*table)() = nullptr;
  std::any defaults{};  ///< its options, of a type that can be copied

  /// How each point is recorded.
  studies::RecordingOptions& (*recording)(std::any& options) = nullptr;
  /// The sweep that the options hold.
  studies::SweepOptions& (*own_sweep)(std::any& options) = nullptr;
  /// The sweep that the points are, if the options hold none.
  studies::SweepOptions (*sweep)(const Study& study) = nullptr;
  /// Points and chains; null: the study is not computed point by point.
  studies::SweepPlan (*plan)(const Study& study) = nullptr;
  /// The model at each point; null: by the value of the sweep's parameter.
  studies::ModelAtPoint (*model_at_point)(const LoadedInput& input) = nullptr;

  /// Parameters that are varied; null: that of `own_sweep`.
  std::vector<PlanAxis> (*axes)(std::any& options) = nullptr;
  /// Further values of the first axis' parameter.
  std::vector<PlacedNumber> (*values)(std::any& options) = nullptr;
  /// Sets the options that "auto" selects.
  void (*complete)(std::any& options) = nullptr;
  /// Replaces the pointer of a speed by its name in parameters that are no axes [given_speeds.hpp].
  void (*name_speeds)(Study& study) = nullptr;
  /// The method of integration, if it is not that of "integrator".
  const std::string& (*method)(const std::any& options) = nullptr;
  /// Does it compute stages whose shafts have errors, whose common period has many mesh periods?
  bool with_shaft_errors = false;
  /// Does "operation" give the speed of the study, if no axis is the speed?
  bool at_given_speed = true;

  /// Do these options integrate? Null: they do. Others need a stage for modes alone.
  bool (*moves)(const std::any& options) = nullptr;

  /// Rules of the options that span keys.
  void (*check)(const Study& study, const IsBad& is_bad, ReadContext& context) = nullptr;
  /// Values that its options put into the input, if there are no other errors.
  /// @param refuse  receives an error at a pointer of the input
  void (*check_values)(const LoadedInput& input,
                       const std::function<void(const std::string& pointer, std::string message)>& refuse) = nullptr;
  /// Warnings of valid but unusual options, besides those of the stage.
  void (*warn)(std::vector<gear::Warning>& out, const LoadedInput& input) = nullptr;
  /// The work that it takes, in words, if it has no plan. Requests its models.
  /// @throws InputError for contradictions
  std::string (*cost)(const LoadedInput& input) = nullptr;

  PointsKept points_kept = PointsKept::none;
  PlotSource plot{};
};

/// The kinds of this library, in the order of the input's schema; kinds/list.cpp defines it.
[[nodiscard]] std::vector<const StudyKind*> own_kinds();

/// Adds a kind, before the first input is read. It has to live as long as the program.
void add_kind(const StudyKind& kind);

/// The library's kinds, then those that were added.
[[nodiscard]] const std::vector<const StudyKind*>& study_kinds();

/// @returns null if there is none of that name
[[nodiscard]] const StudyKind* find_kind(std::string_view name);

/// Parameters that a plan varies.
[[nodiscard]] std::vector<PlanAxis> axes_of(Plan& plan);

/// Points and chains of the sweep that a study is.
[[nodiscard]] studies::SweepPlan plan_of_sweep(const Study& study);

}  // namespace epicyclic::input
