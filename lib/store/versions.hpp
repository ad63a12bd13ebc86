// Versions of the libraries in use and the instruction set of the kernels, for run.json and --version.
#pragma once

#include <map>
#include <string>

namespace epicyclic::store {

/// name -> version of each library that results depend on
[[nodiscard]] std::map<std::string, std::string> dependency_versions();

/// Instruction set of the kernels in use: "baseline" (x86-64 with SSE2), "avx2" or "avx512".
[[nodiscard]] std::string simd_level();

}  // namespace epicyclic::store
