// Studies made from another one: with values of its parameters as numbers of the input, or one of its points as a study
// of its own.
#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "input/study_input.hpp"
#include "model/dynamic_model.hpp"
#include "studies/sweep_plan.hpp"

namespace epicyclic::input {

/// Values of parameters, named or JSON pointers, as numbers of the input as it is written. A name may correspond to
/// several numbers, in another unit.
/// @param study  of the input, with or without changes; is changed further
[[nodiscard]] std::vector<Assignment> written_values(Study& study, std::span<const PointerValue> values);

/// Sets those of the values that have names.
/// @throws InputError if there is no parameter of such a name
void set_named(model::OperatingPoint& point, std::span<const PointerValue> values);

/// The operating point at values of parameters, by names or pointers.
/// @throws InputError if the study is not valid there, or if there is no such parameter
[[nodiscard]] model::OperatingPoint point_at(const LoadedInput& input, std::span<const PointerValue> values);

/// Omega at these values if the input gives the speed in rpm or Hz. That speed stays constant while the values change
/// the time scale. Nothing if the input gives Omega, or if one of the values is Omega.
[[nodiscard]] std::optional<double> ratio_at_given_speed(const LoadedInput& input,
                                                         std::span<const PointerValue> values);

/// The values, and after them, by its pointer, that Omega.
[[nodiscard]] std::vector<PointerValue> at_given_speed(const LoadedInput& input, std::vector<PointerValue> values);

/// One point of a finished study as a study of its own. The varied parameters are set to the point's values, and points
/// are recorded as before. The scales are those of the stage with these values, so that the same speed may have another
/// Omega. A cross-check and a tolerance study are of that one point.
/// @param kind  "run", "crosscheck" or "tolerance"
/// @param stage_changes  the stage is changed afterwards: a speed that is given in rpm or Hz is set as such, and stays
/// @returns what is to be set in the resolved input
/// @returns what is to be set in the resolved input
[[nodiscard]] std::vector<Assignment> point_as_study(const LoadedInput& input, const studies::GridPoint& point,
                                                     std::string_view kind, bool stage_changes = false);

/// omega_sn of the given stage, the unit of a study's Omega and rates [rad/s].
[[nodiscard]] double time_scale(const LoadedInput& input);

/// Are the equations of motion at a study's first point those of a model, at the same speed?
/// @param other, model  a finished study, and its model at a point
[[nodiscard]] bool moves_like(const LoadedInput& input, const LoadedInput& other, const model::DynamicModel& model);

}  // namespace epicyclic::input
