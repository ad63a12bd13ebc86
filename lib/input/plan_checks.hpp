// Rules that combine several keys of a study. Rules of one kind of study alone are in its folder of lib/kinds.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "input/study_input.hpp"

namespace epicyclic::input {

/// Is the value at a pointer another one than in the text? Such a value has been reported.
using IsBad = std::function<bool(const std::string& pointer)>;

/// The rules of all studies of points, and those of the kind.
void check_plan(const Study& study, const IsBad& is_bad, ReadContext& context);

/// Of a sweep that the options hold.
void check_sweep(const Study& study, const IsBad& is_bad, ReadContext& context);

/// Of a range of values.
/// @param place   of the object with from, to and points
/// @param is_bad  is the value at a pointer another one than in the text?
/// @param hint    added if from is above to
void check_range(const studies::Axis& axis, const std::string& place, const IsBad& is_bad, const std::string& hint,
                 ReadContext& context);

/// Names of the state's components.
[[nodiscard]] std::vector<std::string> state_names(const gear::Stage& stage);

/// The error in a state of this stage, if one is given.
[[nodiscard]] std::string why_no_state(const std::vector<double>& state, const gear::Stage& stage);

/// Why a number of the input cannot be the parameter of a study; nothing if it can.
[[nodiscard]] std::string why_no_parameter(const std::string& pointer);

/// A parameter with a name, and its values. Pointers are checked with the values in place.
/// @param other_speeds  the values may be speeds in rpm or Hz
void check_named_parameter(const studies::Axis& axis, const std::string& place, const IsBad& is_bad,
                           ReadContext& context, bool other_speeds = true);

/// Two varied parameters have to set different numbers.
void check_different(const std::string& first_name, const std::string& second_name, const std::string& place,
                     ReadContext& context);

}  // namespace epicyclic::input
