// Intervals of a smooth part of a curve that are found without a search, from the bits of floating-point numbers.
//
//   v = offset + scale u ,  u in [0, 1] the fraction from the start of the part, or from its end if `from_end`
//   even, n intervals:                   offset = 2^j >= n ,  scale = n        : all are 1 long in v
//   graded, m octaves of 2^p intervals:  offset = 2^-m ,      scale = 1 - 2^-m : those of each octave are twice as long
//                                        as those of the octave before, and the first 2^(1-m-p) of the last ones
//
// In both cases the numbers of one interval share their exponent and the first bits of their fraction. The number of
// the interval follows from a difference of bit patterns and a shift, on lanes as on one number. A graded grid resolves
// a singular point at its fine end. An even grid would need intervals as short everywhere. Limits: finite v; beyond the
// part the result is the outermost interval.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

namespace epicyclic {

struct IntervalGrid {
  std::size_t count = 1;       ///< intervals
  std::size_t per_octave = 0;  ///< of a graded one; 0: even
  double offset = 1, scale = 1;
  int shift = fraction_bits;
  bool from_end = false;

  static constexpr int fraction_bits = 52;

  [[nodiscard]] static IntervalGrid even(std::size_t intervals) {
    const auto power = std::bit_ceil(intervals);
    IntervalGrid g;
    g.count = intervals;
    g.offset = static_cast<double>(power);
    g.scale = static_cast<double>(intervals);
    g.shift = fraction_bits - std::countr_zero(power);
    return g;
  }

  /// @param intervals_per_octave  a power of 2
  [[nodiscard]] static IntervalGrid graded(std::size_t intervals_per_octave, int octaves, bool fine_at_end) {
    IntervalGrid g;
    g.count = intervals_per_octave * static_cast<std::size_t>(octaves);
    g.per_octave = intervals_per_octave;
    g.offset = 1.0 / static_cast<double>(std::uint64_t{1} << octaves);
    g.scale = 1.0 - g.offset;
    g.shift = fraction_bits - std::countr_zero(intervals_per_octave);
    g.from_end = fine_at_end;
    return g;
  }

  /// Can every second node be left out?
  [[nodiscard]] bool can_be_halved() const { return (per_octave == 0 ? count : per_octave) % 2 == 0; }

  /// Without every second node.
  [[nodiscard]] IntervalGrid halved() const {
    if (per_octave == 0) return even(count / 2);
    return graded(per_octave / 2, static_cast<int>(count / per_octave), from_end);
  }

  [[nodiscard]] std::uint64_t first_bits() const { return std::bit_cast<std::uint64_t>(offset); }
  /// v where interval k begins; the last node is that of k = count.
  [[nodiscard]] double node(std::size_t k) const {
    return std::bit_cast<double>(first_bits() + (static_cast<std::uint64_t>(k) << shift));
  }
  [[nodiscard]] double last() const { return node(count - 1); }

  /// Which interval; no number is in the first.
  [[nodiscard]] std::size_t number(double v) const {
    const double above = v > offset ? v : offset;
    const double within = above < last() ? above : last();
    return static_cast<std::size_t>((std::bit_cast<std::uint64_t>(within) - first_bits()) >> shift);
  }

  /// Fraction of the part from its start to node k: 0 to 1, falling with k if `from_end`.
  [[nodiscard]] double fraction(std::size_t k) const {
    const double u = k == count ? 1.0 : (node(k) - offset) / scale;
    return from_end ? 1.0 - u : u;
  }

  friend bool operator==(const IntervalGrid&, const IntervalGrid&) = default;
};

}  // namespace epicyclic
