// Curves over the mesh phase from CSV files.
//
//   "stiffness_curve": {"file": "stiffness.csv"}  ->  "stiffness_curve": {"phase": [...], "stiffness_N_per_m": [...]}
//
// The rows take the place of the name, so that a resolved input has them and needs no file. A phase that stands twice
// is a jump, and becomes a breakpoint where no breakpoints are given. If the mean stiffness of the mesh is not given,
// it is that of the curve [model/friction_track.hpp].
//
// Limits: those of the tables on rows; files as long as JSON texts. Lines end in LF or CR LF.
#pragma once

#include <functional>
#include <string>

#include <nlohmann/json.hpp>

#include "input/json_source.hpp"

namespace epicyclic::input {

/// @param stage    a stage, origins spread to maps
/// @param root     pointer of the stage
/// @param text_of  the file of that name, which stands at a pointer
/// @param refuse   takes errors with their pointers
void read_curve_files(
    nlohmann::json& stage, const std::string& root,
    const std::function<const TextFile&(const std::string& pointer, const std::string& name)>& text_of,
    const std::function<void(const std::string& pointer, std::string message)>& refuse);

}  // namespace epicyclic::input
