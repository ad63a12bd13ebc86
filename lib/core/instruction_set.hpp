// Instruction sets that kernels are compiled for besides the baseline, by name: "baseline", "avx2", "avx512".
//
// The widest one that the machine runs is taken. EPICYCLIC_SIMD in the environment sets a limit, to compare them:
// results are the same bits on each. The C library chooses among its own by itself: its sine has other last bits on
// processors without fused multiply-add.
#pragma once

#include <cstddef>
#include <string_view>

namespace epicyclic {

/// Kernels of lanes for AVX2 and AVX-512 are compiled this many times, the same text into different memory: on some
/// machines two cores that run one and the same memory slow each other down (tests/bench/scaling measures it). Threads
/// and ranks side by side use one copy each, cyclically. Results are the same bits.
inline constexpr std::size_t kernel_copies = 2;

/// Does this machine run what was compiled for it, within the limit?
/// @param name "baseline" (always), "avx2", "avx512" (its F and DQ parts); any other name: no
[[nodiscard]] bool machine_runs(std::string_view name);

/// @throws InputError when the limit is none of the names
void check_instruction_set_limit();

}  // namespace epicyclic
