// What `epicyclic gear` writes: modes.csv.
#pragma once

#include <filesystem>
#include <string>

#include "gear/stage.hpp"

namespace epicyclic::io {

/// One row per distinct frequency and type, multiplicity counted: mode,frequency_Hz,frequency_ratio,type,multiplicity.
/// @returns the text of the file
/// @throws OutputError
std::string write_modes_csv(const std::filesystem::path& file, const gear::Stage& stage);

}  // namespace epicyclic::io
