// Columns of numbers from a CSV file that an input names. The first line names the columns; lines end in LF or CR LF.
#pragma once

#include <string>
#include <vector>

#include "input/json_source.hpp"

namespace epicyclic::input {

/// @returns one list for each name, all of one length
/// @throws InputError with what is wrong in the file
[[nodiscard]] std::vector<std::vector<double>> csv_columns(const TextFile& file, const std::vector<std::string>& names);

}  // namespace epicyclic::input
