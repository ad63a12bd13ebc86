// Rules of what is computed that span its keys, by kind of study.
#pragma once

#include <functional>
#include <string>

#include "input/study_input.hpp"

namespace epicyclic::input {

/// Whether the value at a pointer is not the one in the text, which has been reported.
using IsBad = std::function<bool(const std::string& pointer)>;

void check_plan(const Study& study, const IsBad& is_bad, ReadContext& context);

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
