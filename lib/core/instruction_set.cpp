#include "core/instruction_set.hpp"

namespace epicyclic {

bool machine_runs(std::string_view name) {
#ifdef __x86_64__
  if (name == "avx2") return __builtin_cpu_supports("avx2") != 0;
  if (name == "avx512") return __builtin_cpu_supports("avx512f") != 0 && __builtin_cpu_supports("avx512dq") != 0;
#endif
  return name == "baseline";
}

}  // namespace epicyclic
