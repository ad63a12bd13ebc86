// Rows: N values side by side that go through the same formula, such as one per planet, as a scalar type for kernels.
//
// A formula written once on rows is one instruction for several planets where the scalar is double: its rows are padded
// to whole registers of the translation unit's instruction set. A row of dual numbers is a row of their values and one
// for each direction of derivatives. For any other scalar a row is a plain loop.
//
// Limits: the padding takes part in the arithmetic and is never read; it may hold anything, also NaN. Results are the
// same on every instruction set, because each value has its own lane and sum() adds in the order of the values.
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <type_traits>
#include <utility>

#include "core/dual.hpp"
#include "core/scalar.hpp"

namespace epicyclic {

namespace detail {

/// N rounded up to whole registers, the same for registers of 2 doubles and of 4.
constexpr std::size_t row_padding(std::size_t n) { return n <= 2 ? 2 : (n + 3) / 4 * 4; }

/// What a row is worked on by: registers of doubles, else single values.
template <class T, std::size_t Padded>
struct RowChunk {
  static constexpr std::size_t values = 1;
  using Type = T;
  using Mask = decltype(std::declval<T>() < std::declval<T>());
};

template <std::size_t Padded>
struct RowChunk<double, Padded> {
#ifdef __AVX__
  static constexpr std::size_t values = Padded < 4 ? Padded : 4;
#else
  static constexpr std::size_t values = 2;
#endif
  using Type [[gnu::vector_size(8 * values), gnu::may_alias]] = double;
  using Mask [[gnu::vector_size(8 * values), gnu::may_alias]] = long long;
};

}  // namespace detail

/// One value that is the same in every place of a row.
template <class S, class RowType, class T>
concept Single = !std::is_same_v<S, RowType> && std::convertible_to<S, T>;

/// N values of the scalar T. Converts from one value by repeating it.
template <class T, std::size_t N>
class Row {
  static constexpr bool registers = std::is_same_v<T, double>;

 public:
  static constexpr std::size_t padded = registers ? detail::row_padding(N) : N;

 private:
  using Chunk = detail::RowChunk<T, padded>;
  using C = typename Chunk::Type;
  using M = typename Chunk::Mask;
  static constexpr std::size_t chunks = padded / Chunk::values;

 public:
  /// What comparisons give: one answer a value.
  struct Mask {
    M chunk[chunks];  // a register type loses its attributes as a template argument of std::array
  };

  Row() = default;   // not set to anything: kernels write each row once
  Row(const T& x) {  // NOLINT(google-explicit-constructor): a constant is the same in every place
    if constexpr (registers) {
      for (std::size_t c = 0; c < chunks; ++c) at(c) = x - C{};
    } else {
      value_.fill(x);
    }
  }
  Row(double x)  // NOLINT(google-explicit-constructor)
      requires(!registers)
      : Row(T(x)) {}

  /// The row of f(0), ..., f(N - 1).
  template <class F>
  [[nodiscard]] static Row of(const F& f) {
    return of(f, std::make_index_sequence<N>());
  }

  void set(std::size_t i, const T& x) { value_[i] = x; }
  [[nodiscard]] T& operator[](std::size_t i) { return value_[i]; }
  [[nodiscard]] const T& operator[](std::size_t i) const { return value_[i]; }
  [[nodiscard]] static constexpr std::size_t size() { return N; }
  [[nodiscard]] T* begin() { return value_.data(); }
  [[nodiscard]] T* end() { return value_.data() + N; }
  [[nodiscard]] const T* begin() const { return value_.data(); }
  [[nodiscard]] const T* end() const { return value_.data() + N; }
  void fill(const T& x) { *this = Row(x); }

  // A new row, not a copy that is worked on: it would be read back before it is written.
#define EPICYCLIC_ROW_OPERATOR(op)                                         \
  Row& operator op##=(const Row& b) {                                      \
    for (std::size_t c = 0; c < chunks; ++c) at(c) op## = b.at(c);         \
    return *this;                                                          \
  }                                                                        \
  template <Single<Row, T> S>                                              \
  Row& operator op##=(const S& single) {                                   \
    const T& b = single;                                                   \
    for (std::size_t c = 0; c < chunks; ++c) at(c) op## = b;               \
    return *this;                                                          \
  }                                                                        \
  friend Row operator op(const Row& a, const Row& b) {                     \
    Row r;                                                                 \
    for (std::size_t c = 0; c < chunks; ++c) r.at(c) = a.at(c) op b.at(c); \
    return r;                                                              \
  }                                                                        \
  template <Single<Row, T> S>                                              \
  friend Row operator op(const Row& a, const S& single) {                  \
    const T& b = single;                                                   \
    Row r;                                                                 \
    for (std::size_t c = 0; c < chunks; ++c) r.at(c) = a.at(c) op b;       \
    return r;                                                              \
  }                                                                        \
  template <Single<Row, T> S>                                              \
  friend Row operator op(const S& single, const Row& b) {                  \
    const T& a = single;                                                   \
    Row r;                                                                 \
    for (std::size_t c = 0; c < chunks; ++c) r.at(c) = a op b.at(c);       \
    return r;                                                              \
  }
  EPICYCLIC_ROW_OPERATOR(+)
  EPICYCLIC_ROW_OPERATOR(-)
  EPICYCLIC_ROW_OPERATOR(*)
  EPICYCLIC_ROW_OPERATOR(/)
#undef EPICYCLIC_ROW_OPERATOR

  friend Row operator-(const Row& a) {
    Row r;
    for (std::size_t c = 0; c < chunks; ++c) r.at(c) = -a.at(c);
    return r;
  }
  friend Mask operator<(const Row& a, const Row& b) {
    Mask r;
    for (std::size_t c = 0; c < chunks; ++c) r.chunk[c] = a.at(c) < b.at(c);
    return r;
  }
  friend Mask operator>(const Row& a, const Row& b) { return b < a; }

  friend Row select(const Mask& mask, const Row& a, const Row& b) {
    Row r;
    for (std::size_t c = 0; c < chunks; ++c) {
      if constexpr (registers) {
        r.at(c) = mask.chunk[c] ? a.at(c) : b.at(c);
      } else {
        using epicyclic::select;
        r.at(c) = select(mask.chunk[c], a.at(c), b.at(c));
      }
    }
    return r;
  }

  friend Row sqrt(const Row& a) {
    using epicyclic::sqrt;
    return of([&](std::size_t i) { return sqrt(a[i]); });
  }

  friend const Row& value_of(const Row& a) requires(registers) { return a; }
  friend const Row& chained(const Row& /*a*/, const Row& f, const Row& /*slope*/) requires(registers) { return f; }

  /// a_0 + a_1 + ... in this order.
  friend T sum(const Row& a) { return Row::sum(a, std::make_index_sequence<N>()); }

  /// f(i, value i) for each i.
  template <class F>
  void each(const F& f) const {
    each(f, std::make_index_sequence<N>());
  }

 private:
  /// Value I, out of its register.
  template <std::size_t I>
  [[nodiscard]] T get() const {
    if constexpr (registers) {
      const C chunk = at(I / Chunk::values);
      return chunk[I % Chunk::values];
    } else {
      return value_[I];
    }
  }

  template <class F, std::size_t... I>
  void each(const F& f, std::index_sequence<I...> /*places*/) const {
    (f(I, get<I>()), ...);
  }
  template <class F, std::size_t... I>
  [[nodiscard]] static Row of(const F& f, std::index_sequence<I...> /*places*/) {
    Row r;
    ((r.template put<I>(f)), ...);
    if constexpr (registers) {  // whole registers of padding
      for (std::size_t c = (N + Chunk::values - 1) / Chunk::values; c < chunks; ++c) r.at(c) = C{};
    }
    return r;
  }
  /// A register is made of its values at once, not value by value in memory.
  template <std::size_t I, class F>
  void put(const F& f) {
    if constexpr (!registers) {
      value_[I] = f(I);
    } else if constexpr (Chunk::values == 2 && I % 2 == 0) {
      at(I / 2) = C{f(I), or_nothing<I + 1>(f)};
    } else if constexpr (Chunk::values == 4 && I % 4 == 0) {
      at(I / 4) = C{f(I), or_nothing<I + 1>(f), or_nothing<I + 2>(f), or_nothing<I + 3>(f)};
    }
  }
  template <std::size_t I, class F>
  [[nodiscard]] static double or_nothing(const F& f) {
    if constexpr (I < N) {
      return f(I);
    } else {
      return 0.0;
    }
  }
  template <std::size_t... I>
  [[nodiscard]] static T sum(const Row& a, std::index_sequence<I...> /*places*/) {
    return (... + a.template get<I>());
  }

  [[nodiscard]] C& at(std::size_t c) { return reinterpret_cast<C*>(value_.data())[c]; }
  [[nodiscard]] const C& at(std::size_t c) const { return reinterpret_cast<const C*>(value_.data())[c]; }

  alignas(registers ? sizeof(T) * (padded < 4 ? padded : 4) : alignof(T)) std::array<T, padded> value_;
};

/// N dual numbers: their values side by side, and their derivatives along each direction.
template <std::size_t M, class S, std::size_t N>
class Row<Dual<M, S>, N> {
  using T = Dual<M, S>;
  using V = Row<S, N>;

  /// What has no derivatives.
  template <class B>
  static constexpr bool constant = std::is_same_v<B, V> || std::is_same_v<B, S> || std::is_arithmetic_v<B>;
  /// What has some.
  template <class B>
  static constexpr bool variable = std::is_same_v<B, Row> || std::is_same_v<B, T>;

 public:
  using Mask = typename V::Mask;

  V value;
  std::array<V, M> derivative;

  Row() = default;
  Row(const T& x) : value(x.value) {  // NOLINT(google-explicit-constructor): as for any scalar
    directions<M>([&](std::size_t j) { derivative[j] = V(x.derivative[j]); });
  }
  Row(const V& x) : value(x) {  // NOLINT(google-explicit-constructor): constants
    directions<M>([&](std::size_t j) { derivative[j] = V(0.0); });
  }
  Row(const S& x) : Row(V(x)) {}                      // NOLINT(google-explicit-constructor)
  Row(double x) requires(!std::is_same_v<S, double>)  // NOLINT(google-explicit-constructor)
      : Row(V(x)) {}

  template <class F>
  [[nodiscard]] static Row of(const F& f) {
    Row r;
    r.value = V::of([&](std::size_t i) { return f(i).value; });
    directions<M>([&](std::size_t j) { r.derivative[j] = V::of([&](std::size_t i) { return f(i).derivative[j]; }); });
    return r;
  }

  /// A copy that cannot be written to by mistake; set() writes.
  [[nodiscard]] const T operator[](std::size_t i) const {  // NOLINT(readability-const-return-type)
    T x(value[i]);
    directions<M>([&](std::size_t j) { x.derivative[j] = derivative[j][i]; });
    return x;
  }
  void set(std::size_t i, const T& x) {
    value[i] = x.value;
    directions<M>([&](std::size_t j) { derivative[j][i] = x.derivative[j]; });
  }
  [[nodiscard]] static constexpr std::size_t size() { return N; }
  void fill(const T& x) { *this = Row(x); }

  template <class B>
  Row& operator+=(const B& b) requires(constant<B> || variable<B>) {
    if constexpr (constant<B>) {
      value += b;
    } else {
      value += b.value;
      directions<M>([&](std::size_t j) { derivative[j] += b.derivative[j]; });
    }
    return *this;
  }
  template <class B>
  Row& operator-=(const B& b) requires(constant<B> || variable<B>) {
    if constexpr (constant<B>) {
      value -= b;
    } else {
      value -= b.value;
      directions<M>([&](std::size_t j) { derivative[j] -= b.derivative[j]; });
    }
    return *this;
  }
  template <class B>
  Row& operator*=(const B& b) requires(constant<B> || variable<B>) {
    if constexpr (constant<B>) {
      directions<M>([&](std::size_t j) { derivative[j] *= b; });
      value *= b;
    } else {
      directions<M>([&](std::size_t j) { derivative[j] = derivative[j] * b.value + value * b.derivative[j]; });
      value *= b.value;
    }
    return *this;
  }
  template <class B>
  Row& operator/=(const B& b) requires(constant<B> || variable<B>) {
    if constexpr (constant<B>) {
      const auto inverse = 1.0 / b;
      directions<M>([&](std::size_t j) { derivative[j] *= inverse; });
      value /= b;
    } else {
      const auto inverse = 1.0 / b.value;
      value /= b.value;
      directions<M>([&](std::size_t j) { derivative[j] = (derivative[j] - value * b.derivative[j]) * inverse; });
    }
    return *this;
  }

  template <class B>
  friend Row operator+(const Row& a, const B& b) requires(constant<B> || variable<B>) {
    Row r = a;
    r += b;
    return r;
  }
  template <class B>
  friend Row operator-(const Row& a, const B& b) requires(constant<B> || variable<B>) {
    Row r = a;
    r -= b;
    return r;
  }
  template <class B>
  friend Row operator*(const Row& a, const B& b) requires(constant<B> || variable<B>) {
    Row r = a;
    r *= b;
    return r;
  }
  template <class B>
  friend Row operator/(const Row& a, const B& b) requires(constant<B> || variable<B>) {
    Row r = a;
    r /= b;
    return r;
  }
  template <class A>
  friend Row operator+(const A& a, const Row& b) requires(constant<A> || std::is_same_v<A, T>) {
    return b + a;
  }
  template <class A>
  friend Row operator-(const A& a, const Row& b) requires(constant<A> || std::is_same_v<A, T>) {
    return -b + a;
  }
  template <class A>
  friend Row operator*(const A& a, const Row& b) requires(constant<A> || std::is_same_v<A, T>) {
    return b * a;
  }
  template <class A>
  friend Row operator/(const A& a, const Row& b) requires(constant<A> || std::is_same_v<A, T>) {
    return Row(a) /= b;
  }

  friend Row operator-(const Row& a) {
    Row r;
    r.value = -a.value;
    directions<M>([&](std::size_t j) { r.derivative[j] = -a.derivative[j]; });
    return r;
  }
  friend Mask operator<(const Row& a, const Row& b) { return a.value < b.value; }
  friend Mask operator>(const Row& a, const Row& b) { return b < a; }

  friend Row select(const Mask& mask, const Row& a, const Row& b) {
    Row r;
    r.value = select(mask, a.value, b.value);
    directions<M>([&](std::size_t j) { r.derivative[j] = select(mask, a.derivative[j], b.derivative[j]); });
    return r;
  }

  friend Row sqrt(const Row& a) {
    Row r;
    r.value = sqrt(a.value);
    const V slope = 0.5 / r.value;
    directions<M>([&](std::size_t j) { r.derivative[j] = slope * a.derivative[j]; });
    return r;
  }

  /// The chain rule, f(a) with the slope f'(a).
  friend Row chained(const Row& a, const V& f, const V& slope) {
    Row r;
    r.value = f;
    directions<M>([&](std::size_t j) { r.derivative[j] = slope * a.derivative[j]; });
    return r;
  }
  friend const V& value_of(const Row& a) { return a.value; }

  friend T sum(const Row& a) {
    T r(sum(a.value));
    directions<M>([&](std::size_t j) { r.derivative[j] = sum(a.derivative[j]); });
    return r;
  }

  template <class F>
  void each(const F& f) const {
    value.each([&](std::size_t i, const S& x) {
      T dual(x);
      directions<M>([&](std::size_t j) { dual.derivative[j] = derivative[j][i]; });
      f(i, dual);
    });
  }
};

// A single dual number with a row of constants.
#define EPICYCLIC_ROW_OF_CONSTANTS(op)                                      \
  template <std::size_t M, class S, std::size_t N>                          \
  Row<Dual<M, S>, N> operator op(const Dual<M, S>& a, const Row<S, N>& b) { \
    return Row<Dual<M, S>, N>(a) op b;                                      \
  }                                                                         \
  template <std::size_t M, class S, std::size_t N>                          \
  Row<Dual<M, S>, N> operator op(const Row<S, N>& a, const Dual<M, S>& b) { \
    return Row<Dual<M, S>, N>(a) op b;                                      \
  }
EPICYCLIC_ROW_OF_CONSTANTS(+)
EPICYCLIC_ROW_OF_CONSTANTS(-)
EPICYCLIC_ROW_OF_CONSTANTS(*)
EPICYCLIC_ROW_OF_CONSTANTS(/)
#undef EPICYCLIC_ROW_OF_CONSTANTS

}  // namespace epicyclic
