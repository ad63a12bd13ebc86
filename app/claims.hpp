// What the commands on studies of claims do alike before they compute.
#pragma once

#include "commands.hpp"
#include "input/study_input.hpp"
#include "ranks/shared_evaluations.hpp"
#include "studies/candidates.hpp"

namespace epicyclic::app {

/// Asks for models at both ends of each sweep of claims, so that what does not fit shows before anything is written.
/// @throws InputError
void require_models(const studies::ClaimsOptions& options, const studies::SweepModels& models);

/// Asks for models at both ends of each parameter's range and with each option of each choice, all others in the middle
/// of theirs, and warns of what changes nothing: nothing could determine it, and what a table says of it would be
/// chance.
/// @throws InputError that names the parameter
void examine_candidates(const studies::ClaimsOptions& options, const studies::CandidateModels& models);

/// The study of claims whose parameters a command searches or draws, checked, its warnings told.
/// @throws InputError where it has none, and for what does not fit
[[nodiscard]] input::LoadedInput load_open_claims(const Arguments& arguments);

/// Candidates of a study by glances of one kind, or by whole sweeps, as ranks share them.
[[nodiscard]] MakeEvaluator evaluator_by(studies::Glance (*glance)(const studies::ClaimsOptions&));

}  // namespace epicyclic::app
