// Whether conditions of claims could hold, and could fail: what neither can be judged by is refused.
#pragma once

#include <string>

#include "studies/claims_options.hpp"
#include "studies/problem_list.hpp"

namespace epicyclic::studies {

/// Whether the study has a sweep of that name.
void check_sweep_name(ProblemList& problems, const std::string& place, const std::string& name, const Names& sweeps);

/// Of a condition alone: the keys that its kind reads, and their values.
/// @param place  of the condition below the study
void check_condition(ProblemList& problems, const std::string& place, const Condition& condition, const Names& sweeps);

/// What a condition wants of its sweeps' grids, by each way of looking, and of the looks.
void check_grids(ProblemList& problems, const std::string& place, const Condition& condition,
                 const ClaimsOptions& options);

}  // namespace epicyclic::studies
