// The typed study and how it is loaded from JSON.
//
// A study names its stage file, or holds the stage itself, and may override any of it by a JSON merge patch (RFC 7386)
// in "stage_patch"; `--set /pointer=value` overrides a value once more. Everything is checked by the tables of
// field_table.hpp, then by the rules that gear states for a stage; all that is wrong is thrown at once.
//
//   study file -> stage file -> stage_patch -> --set -> tables -> rules of gear -> Study, resolved JSON
//
// The resolved JSON has the stage inline, each default filled in, and in each object an "origin" map that says where
// its values come from. It is a valid input itself and resolves to itself.
#pragma once

#include <any>
#include <array>
#include <concepts>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include <nlohmann/json.hpp>

#include "gear/stage.hpp"
#include "input/assignments.hpp"
#include "input/field_table.hpp"
#include "input/json_source.hpp"
#include "input/speed_aliases.hpp"
#include "integrate/options.hpp"
#include "model/options.hpp"
#include "studies/branches_options.hpp"
#include "studies/crosscheck_options.hpp"
#include "studies/plane_options.hpp"
#include "studies/run_options.hpp"
#include "studies/speed_unit.hpp"
#include "studies/sweep_options.hpp"
#include "studies/tolerance_options.hpp"

namespace epicyclic::input {

/// Nothing is to be computed: a stage file alone.
struct StageAlone {};

struct RunPlan {
  studies::LookOptions look;
  studies::RunOptions run;
};

struct CrosscheckPlan {
  studies::SweepOptions sweep;
  studies::CrosscheckOptions crosscheck;
};

struct TolerancePlan {
  studies::SweepOptions sweep;
  studies::ToleranceOptions tolerance;
};

struct AddedKind;

/// The plan of a kind that a component above this one adds [added_kind.hpp].
struct AddedPlan {
  const AddedKind* kind = nullptr;
  std::any options;  ///< of the type that the kind says

  [[nodiscard]] std::string_view name() const;
  [[nodiscard]] studies::LookOptions& points_look();
  [[nodiscard]] const studies::LookOptions& points_look() const;
};

/// What is computed, by kind of study.
using Plan = std::variant<StageAlone, studies::SweepOptions, studies::MapOptions, studies::BasinsOptions, RunPlan,
                          CrosscheckPlan, TolerancePlan, studies::BranchesOptions, AddedPlan>;

/// How the points of a plan are looked at; of any kind that has points.
/// @throws std::bad_variant_access of a stage alone and of branches
template <class P>
requires std::same_as<std::remove_const_t<P>, Plan>
[[nodiscard]] auto& look_in(P& plan) {
  using Look = std::conditional_t<std::is_const_v<P>, const studies::LookOptions, studies::LookOptions>;
  return std::visit(
      [](auto& of) -> Look& {
        if constexpr (requires { of.look; })
          return of.look;
        else if constexpr (requires { of.sweep; })
          return of.sweep.look;
        else if constexpr (requires { of.points_look(); })
          return of.points_look();
        else
          throw std::bad_variant_access();
      },
      plan);
}

/// The sweep of a plan: of a sweep, of a cross-check and of a tolerance study.
/// @throws std::bad_variant_access of other kinds
template <class P>
requires std::same_as<std::remove_const_t<P>, Plan>
[[nodiscard]] auto& sweep_in(P& plan) {
  if (auto* crosscheck = std::get_if<CrosscheckPlan>(&plan)) return crosscheck->sweep;
  if (auto* tolerance = std::get_if<TolerancePlan>(&plan)) return tolerance->sweep;
  return std::get<studies::SweepOptions>(plan);
}

/// Names of the kinds, in the order of Plan; those that are added have names of their own.
inline constexpr std::array<std::string_view, std::variant_size_v<Plan> - 1> plan_kinds = {
    "stage", "sweep", "map", "basins", "run", "crosscheck", "tolerance", "continue"};

[[nodiscard]] inline std::string_view kind_of(const Plan& plan) {
  const auto* added = std::get_if<AddedPlan>(&plan);
  return added != nullptr ? added->name() : plan_kinds[plan.index()];
}

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

  [[nodiscard]] std::string_view kind() const { return kind_of(plan); }
  /// Is anything to be computed?
  [[nodiscard]] bool has_motion() const { return !std::holds_alternative<StageAlone>(plan); }
  /// Are its motions looked at point by point?
  [[nodiscard]] bool has_points() const {
    return has_motion() && !std::holds_alternative<studies::BranchesOptions>(plan) &&
           !std::holds_alternative<AddedPlan>(plan);
  }

  /// How its points are looked at.
  /// @throws std::bad_variant_access unless it has points
  [[nodiscard]] const studies::LookOptions& look() const { return look_in(plan); }

  /// The sweep that its points are; a run is one of one point.
  /// @throws std::bad_variant_access of a map, of basins, of branches and of a stage alone
  [[nodiscard]] studies::SweepOptions sweep() const;
};

/// A parameter that a study varies, and where the study says so: "/study", of a map "/study/first" and "/study/second".
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
  /// As loaded. What is varied by a JSON pointer is read from `resolved` anew, without what has been changed here:
  /// values are set by load_input().
  Study study;
  nlohmann::json resolved;            ///< a valid input that resolves to itself
  RawFile study_file;                 ///< the file that was named: a study, or a stage alone
  std::optional<RawFile> stage_file;  ///< if the study names one
  GivenSpeed given_speed;             ///< of the operating point, where it is given otherwise than as Omega
  nlohmann::json computed;            ///< what catalogue data give at this load, at the places of `resolved`; or null
  std::vector<std::string> notes;     ///< values that were ignored, and why

  /// The study with the number at this pointer of the resolved input replaced, checked as strictly as a file.
  /// @throws InputProblems when the pointer is not one of a number, or the study is not valid with that value
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

  /// The input with further assignments behind its own. Its files are those that it was loaded from, as they were then;
  /// one that an assignment names first is read once, too.
  /// @throws as load_input()
  [[nodiscard]] LoadedInput with_further(std::span<const Assignment> sets) const;

  /// What the resolved input has at a JSON pointer; null where it has nothing, or that is no pointer.
  [[nodiscard]] const nlohmann::json* value_at(std::string_view pointer) const;

 private:
  friend LoadedInput load_input(const std::filesystem::path&, std::span<const Assignment>);
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

/// The tables; keys of the study, and of the stage alone.
[[nodiscard]] const Table<Study>& study_table();
[[nodiscard]] const Table<gear::Stage>& stage_table();

/// The JSON Schema (draft 2020-12) of study and stage, from the tables.
[[nodiscard]] std::string schema_text();

}  // namespace epicyclic::input
