#include "core/instruction_set.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <string>

#include "core/errors.hpp"

namespace epicyclic {

namespace {

constexpr std::array<std::string_view, 3> sets = {"baseline", "avx2", "avx512"};  // each is wider than those before it

auto place_of(std::string_view name) { return std::find(sets.begin(), sets.end(), name); }

std::string_view limit() {
  const char* name = std::getenv("EPICYCLIC_SIMD");
  return name == nullptr ? sets.back() : std::string_view(name);
}

}  // namespace

bool machine_runs(std::string_view name) {
  if (name == "baseline") return true;
  if (place_of(name) > place_of(limit())) return false;
#ifdef __x86_64__
  if (name == "avx2") return __builtin_cpu_supports("avx2") != 0;
  if (name == "avx512") return __builtin_cpu_supports("avx512f") != 0 && __builtin_cpu_supports("avx512dq") != 0;
#endif
  return false;
}

void check_instruction_set_limit() {
  if (place_of(limit()) == sets.end())
    throw InputError("EPICYCLIC_SIMD is " + std::string(limit()) + "; it may be baseline, avx2 or avx512");
}

}  // namespace epicyclic
