// SIMD lanes: W values side by side, one trajectory each, as a plain scalar type for kernels.
//
// Limits: the instruction set is that of the translation unit (std::experimental::simd of GCC 12); comparison gives a
// mask with one bit a lane, and select() picks per lane, so that lanes may be on different sides of a kink.
#pragma once

#include <cstddef>

#include <experimental/simd>

#include "core/scalar.hpp"

namespace epicyclic {

/// W doubles. Converts from double by broadcast.
template <std::size_t W>
struct Lanes {
  using Pack = std::experimental::fixed_size_simd<double, static_cast<int>(W)>;
  using Mask = typename Pack::mask_type;

  Pack pack = 0.0;

  Lanes() = default;
  Lanes(double x) : pack(x) {}  // NOLINT(google-explicit-constructor): a constant is the same in every lane
  explicit Lanes(const Pack& p) : pack(p) {}

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

  friend Lanes operator+(Lanes a, const Lanes& b) { return a += b; }
  friend Lanes operator-(Lanes a, const Lanes& b) { return a -= b; }
  friend Lanes operator*(Lanes a, const Lanes& b) { return a *= b; }
  friend Lanes operator/(Lanes a, const Lanes& b) { return a /= b; }
  friend Lanes operator-(const Lanes& a) { return Lanes(-a.pack); }

  friend Mask operator<(const Lanes& a, const Lanes& b) { return a.pack < b.pack; }
  friend Mask operator>(const Lanes& a, const Lanes& b) { return a.pack > b.pack; }
};

template <std::size_t W>
[[nodiscard]] Lanes<W> select(const typename std::type_identity_t<Lanes<W>>::Mask& mask, const Lanes<W>& a,
                              const Lanes<W>& b) {
  Lanes<W> r = b;
  where(mask, r.pack) = a.pack;
  return r;
}

template <std::size_t W>
[[nodiscard]] Lanes<W> sqrt(const Lanes<W>& x) {
  return Lanes<W>(std::experimental::sqrt(x.pack));
}

template <std::size_t W>
[[nodiscard]] Lanes<W> power_3_2(const Lanes<W>& x) {
  return x * sqrt(x);
}

template <std::size_t W>
[[nodiscard]] SineCosine<Lanes<W>> sine_cosine(const Lanes<W>& x) {
  return {Lanes<W>(std::experimental::sin(x.pack)), Lanes<W>(std::experimental::cos(x.pack))};
}

}  // namespace epicyclic
