// Opening a study's folder and what every subcommand leaves in it.
#pragma once

#include <optional>
#include <string>

#include "commands.hpp"
#include "io/output_folder.hpp"
#include "io/provenance.hpp"
#include "io/study_input.hpp"

namespace epicyclic::app {

/// Versions and machine, for run.json.
[[nodiscard]] io::Provenance provenance(int threads);

/// Says on stderr why a folder cannot be used.
/// @returns the exit code, or nothing if the study may be computed in it
[[nodiscard]] std::optional<int> refuse_or_finish(const io::OutputFolder& folder);

/// input.json, the stage file beside it, input.resolved.json.
/// @returns text of the resolved input
/// @throws OutputError
std::string write_inputs(const io::OutputFolder& folder, const io::LoadedInput& input);

}  // namespace epicyclic::app
