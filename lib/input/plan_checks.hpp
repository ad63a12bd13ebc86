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

}  // namespace epicyclic::input
