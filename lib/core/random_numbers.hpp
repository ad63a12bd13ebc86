// Random numbers by their place in a sequence, the same ones on every platform: any of them without those before it.
//
//   z_n = mix(seed + n g) ,  g = 2^64 / golden ratio, odd [C-rand]
//
// Source: G. L. Steele, D. Lea, C. H. Flood, Fast splittable pseudorandom number generators, OOPSLA 2014 (SplitMix64).
#pragma once

#include <cstdint>

namespace epicyclic {

/// z_n of [C-rand]; SplitMix64 begins with n = 1.
[[nodiscard]] constexpr std::uint64_t random_bits(std::uint64_t seed, std::uint64_t n) {
  std::uint64_t z = seed + n * 0x9e3779b97f4a7c15U;
  z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9U;
  z = (z ^ (z >> 27U)) * 0x94d049bb133111ebU;
  return z ^ (z >> 31U);
}

/// Uniform in [0, 1), a multiple of 2^-53.
[[nodiscard]] constexpr double random_uniform(std::uint64_t seed, std::uint64_t n) {
  constexpr double ulp = 0x1p-53;
  return static_cast<double>(random_bits(seed, n) >> 11U) * ulp;
}

}  // namespace epicyclic
