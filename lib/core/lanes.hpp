// SIMD lanes: W values side by side, one trajectory each, as a plain scalar type for kernels.
//
// Sine and cosine: Cody and Waite's reduction by multiples of pi / 2 in three parts, then the polynomials of Cephes
// (S. Moshier, sin.c, cos.c) on [-pi/4, pi/4]; within 2 units in the last place for |x| up to 1e4.
//
// Limits: the instruction set is that of the translation unit; values never depend on it nor on W, because each lane
// has its own operations and nothing is contracted (-ffp-contract=off). Comparison gives a mask with all bits of a lane
// set or none, and select() picks per lane, so that lanes may be on different sides of a kink.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>

#include "core/cubics.hpp"
#include "core/row.hpp"
#include "core/scalar.hpp"

// Packs wider than the registers of a translation unit are passed in memory, and the compiler warns that others with
// wider registers would not. They do not meet: each set's kernels take pointers to doubles. For whoever includes this.
#pragma GCC diagnostic ignored "-Wpsabi"

namespace epicyclic {

namespace detail {

/// The compiler sees an attribute that depends on a template parameter only through a member of another class.
template <std::size_t W>
struct LanePack {
  using Values [[gnu::vector_size(8 * W), gnu::may_alias]] = double;
  using Bits [[gnu::vector_size(8 * W), gnu::may_alias]] = long long;
  using Words [[gnu::vector_size(8 * W), gnu::may_alias]] = unsigned long long;
};

}  // namespace detail

/// The bit patterns of W doubles, or W whole numbers. Aligned as those.
template <std::size_t W>
struct alignas(8 * W) LaneWords {
  using Pack = typename detail::LanePack<W>::Words;

  Pack pack;

  [[nodiscard]] std::uint64_t operator[](std::size_t lane) const { return pack[lane]; }
  void set(std::size_t lane, std::uint64_t x) { pack[lane] = x; }

  friend LaneWords operator+(const LaneWords& a, const LaneWords& b) { return of(a.pack + b.pack); }
  friend LaneWords operator-(const LaneWords& a, const LaneWords& b) { return of(a.pack - b.pack); }
  friend LaneWords operator<<(const LaneWords& a, const LaneWords& by) { return of(a.pack << by.pack); }
  friend LaneWords operator>>(const LaneWords& a, const LaneWords& by) { return of(a.pack >> by.pack); }

  static LaneWords of(const Pack& p) {
    LaneWords r;
    r.pack = p;
    return r;
  }
};

/// W doubles, W = 2, 4, 8, ... Converts from double by repeating it.
///
/// Aligned to its size in every translation unit: without it, vector types wider than the registers have the alignment
/// of the registers, and kernels of another instruction set would meet memory that theirs cannot load.
template <std::size_t W>
struct alignas(8 * W) Lanes {
  using Pack = typename detail::LanePack<W>::Values;
  using Bits = typename detail::LanePack<W>::Bits;

  /// What comparisons give.
  struct Mask {
    Bits bits;
    [[nodiscard]] bool operator[](std::size_t lane) const { return bits[lane] != 0; }
    friend Mask operator&&(const Mask& a, const Mask& b) { return {a.bits & b.bits}; }
    friend Mask operator||(const Mask& a, const Mask& b) { return {a.bits | b.bits}; }
    friend Mask operator!(const Mask& a) { return {~a.bits}; }
  };

  Pack pack;

  Lanes() = default;                     // not set to anything: kernels write each value once
  Lanes(double x) : pack(x - Pack{}) {}  // NOLINT(google-explicit-constructor): a constant is the same in every lane

  [[nodiscard]] double operator[](std::size_t lane) const { return pack[lane]; }
  void set(std::size_t lane, double x) { pack[lane] = x; }

  Lanes& operator+=(const Lanes& b) {
    pack += b.pack;
    return *this;
  }
  Lanes& operator-=(const Lanes& b) {
    pack -= b.pack;
    return *this;
  }
  Lanes& operator*=(const Lanes& b) {
    pack *= b.pack;
    return *this;
  }
  Lanes& operator/=(const Lanes& b) {
    pack /= b.pack;
    return *this;
  }

  friend Lanes operator+(const Lanes& a, const Lanes& b) { return of(a.pack + b.pack); }
  friend Lanes operator-(const Lanes& a, const Lanes& b) { return of(a.pack - b.pack); }
  friend Lanes operator*(const Lanes& a, const Lanes& b) { return of(a.pack * b.pack); }
  friend Lanes operator/(const Lanes& a, const Lanes& b) { return of(a.pack / b.pack); }
  friend Lanes operator-(const Lanes& a) { return of(-a.pack); }

  friend Mask operator<(const Lanes& a, const Lanes& b) { return {a.pack < b.pack}; }
  friend Mask operator>(const Lanes& a, const Lanes& b) { return {a.pack > b.pack}; }
  friend Mask operator<=(const Lanes& a, const Lanes& b) { return {a.pack <= b.pack}; }

  friend Lanes select(const Mask& mask, const Lanes& a, const Lanes& b) { return of(mask.bits ? a.pack : b.pack); }

  friend Lanes sqrt(const Lanes& a) {
    Lanes r;
    for (std::size_t lane = 0; lane < W; ++lane) r.pack[lane] = std::sqrt(a.pack[lane]);
    return r;
  }

  friend Lanes abs(const Lanes& a) { return of(a.pack < 0.0 ? -a.pack : a.pack); }
  friend Lanes max(const Lanes& a, const Lanes& b) { return of(a.pack > b.pack ? a.pack : b.pack); }
  friend Lanes min(const Lanes& a, const Lanes& b) { return of(a.pack < b.pack ? a.pack : b.pack); }

  /// The whole number nearest to each, |x| < 2^51.
  friend Lanes nearest_whole(const Lanes& a) {
    constexpr double no_fraction = 0x1.8p52;
    return of((a.pack + no_fraction) - no_fraction);
  }
  [[nodiscard]] LaneWords<W> bits() const {
    return LaneWords<W>::of(std::bit_cast<typename detail::LanePack<W>::Words>(pack));
  }
  [[nodiscard]] static Lanes of_bits(const LaneWords<W>& words) { return of(std::bit_cast<Pack>(words.pack)); }

  friend Lanes power_3_2(const Lanes& a) { return a * sqrt(a); }

  friend SineCosine<Lanes> sine_cosine(const Lanes& x) {
    constexpr double two_by_pi = 0.63661977236758134308;
    constexpr double no_fraction = 0x1.8p52;
    // pi / 2 in parts of 28 bits, so that multiples up to 2^25 are exact.
    constexpr double part_1 = 2.0 * 7.85398125648498535156e-1;
    constexpr double part_2 = 2.0 * 3.77489470793079817668e-8;
    constexpr double part_3 = 2.0 * 2.69515142907905952645e-15;
    const Pack shifted = x.pack * two_by_pi + no_fraction;
    const Pack quarters = shifted - no_fraction;
    const Bits quarter = std::bit_cast<Bits>(shifted);  // its last bits count the quarter periods
    const Pack r = ((x.pack - quarters * part_1) - quarters * part_2) - quarters * part_3;
    const Pack z = r * r;
    const Pack sine =
        r + r * z *
                (((((1.58962301576546568060e-10 * z - 2.50507477628578072866e-8) * z + 2.75573136213857245213e-6) * z -
                   1.98412698295895385996e-4) *
                      z +
                  8.33333333332211858878e-3) *
                     z -
                 1.66666666666666307295e-1);
    const Pack cosine =
        (1.0 - 0.5 * z) +
        z * z *
            (((((-1.13585365213876817300e-11 * z + 2.08757008419747316778e-9) * z - 2.75573141792967388112e-7) * z +
               2.48015872888517045348e-5) *
                  z -
              1.38888888888730564116e-3) *
                 z +
             4.16666666666665929218e-2);
    const Bits odd = (quarter & 1) != 0;
    const Bits sine_negative = (quarter & 2) != 0;
    const Bits cosine_negative = ((quarter + 1) & 2) != 0;
    const Pack s = odd ? cosine : sine;
    const Pack c = odd ? sine : cosine;
    return {of(sine_negative ? -s : s), of(cosine_negative ? -c : c)};
  }

 private:
  static Lanes of(const Pack& p) {
    Lanes r;
    r.pack = p;
    return r;
  }
};

template <std::size_t W>
inline constexpr bool is_lanes<Lanes<W>> = true;

namespace detail {

/// An index that is a constant: of all compilers, only GCC shuffles by one that is not.
template <std::size_t I>
inline constexpr std::integral_constant<std::size_t, I> place{};

/// Four registers as the rows of a matrix, or side by side of several, one for each four of their places: the first K
/// columns.
template <std::size_t K, class Pack, std::size_t... I>
[[nodiscard]] std::array<Lanes<sizeof...(I)>, K> columns_of(const Pack& a, const Pack& b, const Pack& c, const Pack& d,
                                                            std::index_sequence<I...> /*places*/) {
  constexpr std::size_t W = sizeof...(I);
  const Pack ab_even = __builtin_shufflevector(a, b, (I % 2 == 0 ? I : W + I - 1)...);
  const Pack ab_odd = __builtin_shufflevector(a, b, (I % 2 == 0 ? I + 1 : W + I)...);
  const Pack cd_even = __builtin_shufflevector(c, d, (I % 2 == 0 ? I : W + I - 1)...);
  const Pack cd_odd = __builtin_shufflevector(c, d, (I % 2 == 0 ? I + 1 : W + I)...);
  const std::array<Pack, 4> all{__builtin_shufflevector(ab_even, cd_even, (I % 4 < 2 ? I : W + I - 2)...),
                                __builtin_shufflevector(ab_odd, cd_odd, (I % 4 < 2 ? I : W + I - 2)...),
                                __builtin_shufflevector(ab_even, cd_even, (I % 4 < 2 ? I + 2 : W + I)...),
                                __builtin_shufflevector(ab_odd, cd_odd, (I % 4 < 2 ? I + 2 : W + I)...)};
  std::array<Lanes<W>, K> columns;
  for (std::size_t k = 0; k < K; ++k) columns[k].pack = all[k];
  return columns;
}

}  // namespace detail

/// K values of each lane, one row each, as K packs.
template <std::size_t W, std::size_t K>
[[nodiscard]] std::array<Lanes<W>, K> transposed(const std::array<Row<double, K>, W>& rows) {
  if constexpr (W == 4 && Row<double, K>::padded == 4) {
    using Four = typename detail::LanePack<4>::Values;
    return detail::columns_of<K>(std::bit_cast<Four>(rows[0]), std::bit_cast<Four>(rows[1]),
                                 std::bit_cast<Four>(rows[2]), std::bit_cast<Four>(rows[3]),
                                 std::make_index_sequence<4>());
  } else {
    std::array<Lanes<W>, K> columns;
    for (std::size_t j = 0; j < K; ++j)
      for (std::size_t lane = 0; lane < W; ++lane) columns[j].pack[lane] = rows[lane][j];
    return columns;
  }
}

/// K cubics of each lane, of its own coefficients at its own place.
template <std::size_t W, std::size_t K>
[[nodiscard]] std::array<Lanes<W>, K> cubics_at(const std::array<const Cubics<K>*, W>& c, const Lanes<W>& t) {
  if constexpr (W == 8 && Row<double, K>::padded == 4) {
    // Lanes i and i + 4 share a register: half the operations, and the transposition is that of four rows.
    using Four = typename detail::LanePack<4>::Values;
    const auto both = [&]<std::size_t i>(std::integral_constant<std::size_t, i>) {
      const auto power = [&](std::size_t k) {
        return __builtin_shufflevector(std::bit_cast<Four>((*c[i])[k]), std::bit_cast<Four>((*c[i + 4])[k]), 0, 1, 2, 3,
                                       4, 5, 6, 7);
      };
      const auto x = __builtin_shufflevector(t.pack, t.pack, i, i, i, i, i + 4, i + 4, i + 4, i + 4);
      return power(0) + x * (power(1) + x * (power(2) + x * power(3)));
    };
    using detail::place;
    return detail::columns_of<K>(both(place<0>), both(place<1>), both(place<2>), both(place<3>),
                                 std::make_index_sequence<8>());
  } else {
    std::array<Row<double, K>, W> rows;
    for (std::size_t lane = 0; lane < W; ++lane) rows[lane] = cubics_at(*c[lane], t[lane]);
    return transposed<W, K>(rows);
  }
}

}  // namespace epicyclic
