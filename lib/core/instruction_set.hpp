// Instruction sets that kernels are compiled for besides the baseline, by name.
#pragma once

#include <string_view>

namespace epicyclic {

/// Does this machine run what was compiled for it?
/// @param name "baseline" (always), "avx2", "avx512" (its F and DQ parts); any other name: no
[[nodiscard]] bool machine_runs(std::string_view name);

}  // namespace epicyclic
