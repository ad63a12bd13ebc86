// Keys that tables of several kinds of study have in common.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "input/field_table.hpp"
#include "input/study_input.hpp"

namespace epicyclic::input {

/// Which kind of study it is.
void add_kind_key(Table<Study>& t, std::string_view name);

/// How long each point is looked at.
void add_look(Table<Study>& t);

/// The keys of studies that tell their points' regimes.
void add_classification(Table<Study>& t);

/// By their names in the input.
[[nodiscard]] const std::vector<std::pair<std::string, studies::Direction>>& direction_choices();
[[nodiscard]] const std::vector<std::pair<std::string, studies::Start>>& start_choices();

}  // namespace epicyclic::input
