// The typed study and how it is loaded from JSON.
//
// A study names its stage file, or contains the stage itself. It may override any of it by a JSON merge patch (RFC
// 7386) in "stage_patch"; `--set /pointer=value` overrides a value once more. The tables of field_table.hpp check
// everything, then the rules that gear states for a stage. All errors are thrown at once.
//
//   study file -> stage file -> stage_patch -> --set -> tables -> rules of gear -> Study, resolved JSON
//
// The resolved JSON has the stage inline, with all defaults, and in each object an "origin" map with the sources of its
// values. It is a valid input itself and resolves to itself.
#pragma once

#include <any>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "gear/stage.hpp"
#include "input/assignments.hpp"
#include "input/field_table.hpp"
#include "input/json_source.hpp"
#include "input/speed_aliases.hpp"
#include "integrate/options.hpp"
#include "model/options.hpp"
#include "studies/speed_unit.hpp"
#include "studies/sweep_options.hpp"

namespace epicyclic::input {

struct StudyKind;

/// The computation: a kind of study with its options [study_kind.hpp]. A stage alone has no kind: nothing is computed.
class Plan {
 public:
  Plan() = default;
  /// With the kind's defaults.
  explicit Plan(const StudyKind& kind);
  Plan(const StudyKind& kind, std::any options) : kind_(&kind), options_(std::move(options)) {}

  [[nodiscard]] const StudyKind* kind() const { return kind_; }  ///< null of a stage alone
  [[nodiscard]] std::string_view name() const;                   ///< of its kind; "stage" of a stage alone
  [[nodiscard]] std::any& options() { return options_; }
  [[nodiscard]] const std::any& options() const { return options_; }

  /// The options of a kind, by their type; null of another kind.
  template <class Options>
  [[nodiscard]] const Options* get_if() const {
    return std::any_cast<Options>(&options_);
  }
  /// @throws std::bad_any_cast of another kind
  template <class Options>
  [[nodiscard]] const Options& as() const {
    return std::any_cast<const Options&>(options_);
  }
  template <class Options>
  [[nodiscard]] Options& as() {
    return std::any_cast<Options&>(options_);
  }

  /// How each point is recorded.
  /// @throws std::logic_error of a kind without points
  [[nodiscard]] studies::RecordingOptions& recording();
  [[nodiscard]] const studies::RecordingOptions& recording() const { return const_cast<Plan*>(this)->recording(); }

  /// The sweep that the options hold: of a sweep, a cross-check and a tolerance study.
  /// @throws std::logic_error of other kinds
  [[nodiscard]] studies::SweepOptions& sweep();
  [[nodiscard]] const studies::SweepOptions& sweep() const { return const_cast<Plan*>(this)->sweep(); }

 private:
  const StudyKind* kind_ = nullptr;
  std::any options_;
};

struct Study {
  std::string name;
  gear::Stage stage;
  double mesh_frequency_ratio = 1;  ///< Omega = omega_m / omega_sn where no sweep varies it [-]
  GivenSpeed given_speed{};         ///< in place of it, until the input is loaded
  /// What the study gives the speeds along an axis in; none: the mesh frequency ratio. They are kept as ratios.
  std::optional<studies::SpeedUnit> axis_speed{};
  model::ModelOptions model;
  integrate::IntegratorOptions integrator;
  Plan plan;
  std::vector<double> initial_state;  ///< in place of the default start [b_c, b_c per tau]; empty: that one

  [[nodiscard]] std::string_view kind() const { return plan.name(); }
  /// Does the study compute a response?
  [[nodiscard]] bool has_dynamics() const { return plan.kind() != nullptr; }
  /// Does it integrate equations of motion, or need natural frequencies at most?
  [[nodiscard]] bool integrates() const;
  /// Is it computed point by point?
  [[nodiscard]] bool has_points() const;

  /// How its points are recorded.
  /// @throws std::logic_error unless it has points
  [[nodiscard]] const studies::RecordingOptions& recording() const { return plan.recording(); }

  /// The sweep that its points are; a run is one of one point.
  /// @throws std::logic_error of other kinds
  [[nodiscard]] studies::SweepOptions sweep() const;
};

/// A parameter that a study varies, and its place in the study: "/study", of a map "/study/first" and "/study/second".
struct VariedParameter {
  studies::Axis axis;
  std::string place;
};

/// In this order; none of a run, of basins and of a stage alone.
[[nodiscard]] std::vector<VariedParameter> varied_parameters(const Study& study);

/// A file exactly as stored.
struct RawFile {
  std::string name;  ///< without folders
  std::string bytes;
};

/// A number in place of another one.
struct PointerValue {
  std::string pointer;
  double value = 0;
};

class LoadedInput {
 public:
  /// An input as loaded. Parameters by JSON pointers are read from `resolved` again, without changes that were made
  /// here: load_input() sets values.
  Study study;
  nlohmann::json resolved;            ///< a valid input that resolves to itself
  RawFile study_file;                 ///< the file that was named: a study, or a stage alone
  std::optional<RawFile> stage_file;  ///< if the study names one
  GivenSpeed given_speed;             ///< of the operating point, where it is given otherwise than as Omega
  nlohmann::json computed;            ///< what catalogue data give at this load, at the places of `resolved`; or null
  std::vector<std::string> notes;     ///< values that were ignored, and why

  /// The study with the number at this pointer of the resolved input replaced, checked as strictly as a file.
  /// @throws InputProblems if the pointer is not one of a number, or the study is not valid with that value
  [[nodiscard]] Study with_value(std::string_view pointer, double value) const;
  /// The study with the numbers at several pointers of the resolved input replaced, checked together as strictly as a
  /// file.
  /// @throws InputProblems when a pointer is not one of a number, or the study is not valid with these values
  [[nodiscard]] Study with_values(std::span<const PointerValue> values) const;

  /// The resolved input of that study.
  /// @throws as with_values()
  [[nodiscard]] nlohmann::json resolved_with(std::span<const PointerValue> values) const;

  /// Pointers of all numbers that with_value() takes.
  [[nodiscard]] std::vector<std::string> number_pointers() const;

  /// The input with further assignments after its own. It uses its files as they were loaded. A file that an assignment
  /// names first is read once, too.
  /// @throws as load_input()
  [[nodiscard]] LoadedInput with_further(std::span<const Assignment> sets) const;

  /// The value of the resolved input at a JSON pointer; null if there is none, or if it is no pointer.
  [[nodiscard]] const nlohmann::json* value_at(std::string_view pointer) const;

 private:
  friend LoadedInput load_input(const std::filesystem::path&, std::span<const Assignment>);
  friend LoadedInput load_input_text(std::string, const std::filesystem::path&, std::span<const Assignment>);
  struct Sources;
  class Loader;
  /// A resolved input: this one's, or one with other values.
  struct Base {
    const nlohmann::json& resolved;
    const Study* study = nullptr;  ///< as read from it without a finding; null if there were any
  };
  [[nodiscard]] std::vector<Problem> check_with(const Base& base, std::span<const PointerValue> values, Study& changed,
                                                nlohmann::json* completed = nullptr) const;
  std::shared_ptr<const Sources> sources_;
};

/// Reads a study file, or a stage file (one with "lumped" or "catalogue" at its top level).
/// @throws InputProblems with all that is wrong, OutputError when the machine cannot read a file
[[nodiscard]] LoadedInput load_input(const std::filesystem::path& path, std::span<const Assignment> sets = {});

/// The same of a text that need not be in a file.
/// @param path  that the text would have: messages show it, and the stage file is found from it
[[nodiscard]] LoadedInput load_input_text(std::string text, const std::filesystem::path& path,
                                          std::span<const Assignment> sets = {});

/// The tables; keys of the study, and of the stage alone.
[[nodiscard]] const Table<Study>& study_table();
[[nodiscard]] const Table<gear::Stage>& stage_table();
[[nodiscard]] const Table<gear::StiffnessCurve>& stiffness_curve_table();

/// The JSON Schema (draft 2020-12) of study and stage, from the tables.
[[nodiscard]] std::string schema_text();

}  // namespace epicyclic::input
