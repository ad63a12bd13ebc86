// Whether each free parameter and each choice of a study of claims could decide something.
#pragma once

#include "studies/parameter_space.hpp"
#include "studies/problem_list.hpp"

namespace epicyclic::studies {

/// What is wrong with parameters and choices, at places below the study.
void check_space(ProblemList& problems, const ParameterSpace& space);

}  // namespace epicyclic::studies
