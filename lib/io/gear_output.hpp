// What `epicyclic gear` writes: modes.csv.
#pragma once

#include <filesystem>
#include <vector>

#include "gear/stage.hpp"

namespace epicyclic::io {

/// One row per distinct frequency and type, multiplicity counted: mode,frequency_Hz,frequency_ratio,type,multiplicity.
/// @throws OutputError
void write_modes_csv(const std::filesystem::path& file, const gear::Stage& stage);

}  // namespace epicyclic::io
