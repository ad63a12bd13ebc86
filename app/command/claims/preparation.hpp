// What the commands on studies of claims do alike before they compute.
#pragma once

#include "claims/candidates.hpp"
#include "commands.hpp"
#include "input/study_input.hpp"
#include "shared_evaluations.hpp"

namespace epicyclic::app {

/// Requests models at both ends of each sweep of claims, so that contradictions show before anything is written.
/// @throws InputError
void require_models(const claims::ClaimsOptions& options, const claims::SweepModels& models);

/// The same of the given stage, and the natural frequencies of the stages of claims.
/// @throws InputError
void require_models(const input::LoadedInput& input);

/// The study of claims whose parameters a command searches or draws. It is checked, and its warnings are printed.
/// @throws InputError if the study has no such parameters, and for contradictions
[[nodiscard]] input::LoadedInput load_open_claims(const Arguments& arguments);

/// Candidates of a study by glances of one kind, or by whole sweeps, as ranks share them.
[[nodiscard]] MakeEvaluator evaluator_by(claims::Glance (*glance)(const claims::ClaimsOptions&));

}  // namespace epicyclic::app
