// What the tables of several kinds of study have in common: keys, bounds, and access to the options of a plan.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "input/field_table.hpp"
#include "input/study_input.hpp"

namespace epicyclic::input {

inline constexpr double tolerance_min = 1e-30;
inline constexpr double value_most = 1e300;  ///< of a parameter, which has bounds of its own
inline const Bounds any_value = between(-value_most, value_most);
inline const Bounds component_value = between(-1e6, 1e6);  ///< of a state; beyond it a solution has diverged
inline const Bounds integrator_tolerance = between(1e-15, 0.1);
inline const Bounds smoothing_width = between(0, 10);

inline constexpr const char* parameter_words =
    "Name of the parameter, or a JSON pointer to a number of the input. sun_speed_rpm, carrier_speed_rpm and "
    "mesh_frequency_Hz vary the mesh frequency ratio, with values in rpm or Hz.";

/// A member of a part of the plan.
/// @param part  [](auto& plan) -> auto&
template <class Part, class Options, class V>
table_detail::Access<Study, V> in_plan(Part part, V Options::*member) {
  return {[=](Study& s) -> V& { return part(s.plan).*member; },
          [=](const Study& s) -> const V* { return &(part(s.plan).*member); }};
}

/// The same of a member of a member, such as an axis.
template <class Part, class Options, class U, class V>
table_detail::Access<Study, V> in_plan(Part part, U Options::*outer, V U::*member) {
  return {[=](Study& s) -> V& { return part(s.plan).*outer.*member; },
          [=](const Study& s) -> const V* { return &(part(s.plan).*outer.*member); }};
}

/// The part that is all options of a kind.
template <class Options>
inline constexpr auto whole_plan = [](auto& plan) -> auto& {
  return plan.template as<Options>();
};

/// "kind", which says which kind of study it is.
void add_kind_key(Table<Study>& t, std::string_view name);

/// How each point is recorded.
void add_recording(Table<Study>& t);

/// The keys of studies that classify the regimes of their points.
void add_classification(Table<Study>& t);

/// The state that points start from which continue no other one.
void add_initial_state(Table<Study>& t);

/// The sweep that the options hold: points along one parameter.
void add_grid(Table<Study>& t);

/// Range and number of values of an axis of a plane.
void add_axis_range(Table<studies::Axis>& t);

/// By their names in the input.
[[nodiscard]] const std::vector<std::pair<std::string, studies::Direction>>& direction_choices();
[[nodiscard]] const std::vector<std::pair<std::string, studies::Start>>& start_choices();
/// Methods of integration.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> method_choices();

/// Directions and start, for sweeps and maps.
template <class Part, class Options>
void add_course(Table<Study>& t, Part part, std::vector<studies::Direction> Options::*directions,
                studies::Start Options::*start) {
  t.choices("directions", in_plan(part, directions), direction_choices(),
            "Directions; each is a chain of its own from the default start.");
  t.choice("start", in_plan(part, start), start_choices(),
           "Initial state of a point: the last state of the previous point in its chain, or the default start.");
}

}  // namespace epicyclic::input
