// Rules of what is computed that span its keys. Those of one kind of study alone are in its folder of lib/kinds.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "input/study_input.hpp"

namespace epicyclic::input {

/// Whether the value at a pointer is not the one in the text, which has been reported.
using IsBad = std::function<bool(const std::string& pointer)>;

/// Those that all studies of points have, and those of the kind.
void check_plan(const Study& study, const IsBad& is_bad, ReadContext& context);

/// Of a sweep that the options hold.
void check_sweep(const Study& study, const IsBad& is_bad, ReadContext& context);

/// Of a range of values.
/// @param place   of the object with from, to and points
/// @param is_bad  tells whether the value at a pointer is not the one in the text
/// @param hint    added where from is above to
void check_range(const studies::Axis& axis, const std::string& place, const IsBad& is_bad, const std::string& hint,
                 ReadContext& context);

/// Names of the state's components.
[[nodiscard]] std::vector<std::string> state_names(const gear::Stage& stage);

/// What is wrong with a state of this stage, if one is given.
[[nodiscard]] std::string why_no_state(const std::vector<double>& state, const gear::Stage& stage);

/// Why a number of the input is no parameter of the motion; nothing where it may be one.
[[nodiscard]] std::string why_no_parameter(const std::string& pointer);

/// A parameter with a name, and its values. Pointers are checked with the values in place.
/// @param other_speeds  the values may be speeds in rpm or Hz
void check_named_parameter(const studies::Axis& axis, const std::string& place, const IsBad& is_bad,
                           ReadContext& context, bool other_speeds = true);

/// Two parameters that are varied at once set different numbers.
void check_different(const std::string& first_name, const std::string& second_name, const std::string& place,
                     ReadContext& context);

}  // namespace epicyclic::input
