// Instruction sets that kernels are compiled for besides the baseline, by name: "baseline", "avx2", "avx512".
//
// The widest one that the machine runs is taken. EPICYCLIC_SIMD in the environment sets a limit, to compare them:
// results are the same bits on each. The C library chooses among its own by itself: its sine has other last bits on
// processors without fused multiply-add.
#pragma once

#include <string_view>

namespace epicyclic {

/// Does this machine run what was compiled for it, within the limit?
/// @param name "baseline" (always), "avx2", "avx512" (its F and DQ parts); any other name: no
[[nodiscard]] bool machine_runs(std::string_view name);

/// @throws InputError when the limit is none of the names
void check_instruction_set_limit();

}  // namespace epicyclic
