// Lanes of width 1 that count what the lane kernel does: every operation on a pack, the table reads included.
//
// To be included before anything makes Lanes<1>; nothing else has lanes of this width.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <vector>

#include "core/lanes.hpp"
#include "model/dispatch.hpp"
#include "model/dynamic_model.hpp"
#include "model/folded_constants.hpp"
#include "model/kernels/lane_phase_coefficients.hpp"
#include "model/lane_parameters.hpp"
#include "model/right_hand_side.hpp"

namespace epicyclic::model {

/// Changes of sign are none: the kernel flips a bit, or takes away in place of adding.
struct Operations {
  long additions = 0;        ///< and subtractions
  long multiplications = 0;  ///< and changes of sign, which are not counted
  long divisions = 0;
  long comparisons = 0;
  long selections = 0;

  [[nodiscard]] long arithmetic() const { return additions + multiplications + divisions; }
};

namespace counted {

inline Operations operations;

/// Signs and masks.
struct Bits {
  long long value;

  [[nodiscard]] long long operator[](std::size_t /*lane*/) const { return value; }
  explicit operator bool() const {  // of the condition of a selection
    ++operations.selections;
    return value != 0;
  }
  friend Bits operator&(Bits a, Bits b) { return {a.value & b.value}; }
  friend Bits operator&(Bits a, long long b) { return {a.value & b}; }
  friend Bits operator|(Bits a, Bits b) { return {a.value | b.value}; }
  friend Bits operator~(Bits a) { return {~a.value}; }
  friend Bits operator+(Bits a, long long b) { return {a.value + b}; }
  friend Bits operator!=(Bits a, long long b) { return {a.value != b ? -1 : 0}; }
};

/// Bit patterns, which are no arithmetic of the model.
struct Words {
  unsigned long long value;

  [[nodiscard]] unsigned long long operator[](std::size_t /*lane*/) const { return value; }
  [[nodiscard]] unsigned long long& operator[](std::size_t /*lane*/) { return value; }
  friend Words operator+(Words a, Words b) { return {a.value + b.value}; }
  friend Words operator-(Words a, Words b) { return {a.value - b.value}; }
  friend Words operator<<(Words a, Words b) { return {a.value << b.value}; }
  friend Words operator>>(Words a, Words b) { return {a.value >> b.value}; }
};

struct Pack {
  double value = 0;

  [[nodiscard]] double operator[](std::size_t /*lane*/) const { return value; }
  [[nodiscard]] double& operator[](std::size_t /*lane*/) { return value; }

  Pack& operator+=(Pack b) { return *this = *this + b; }
  Pack& operator-=(Pack b) { return *this = *this - b; }
  Pack& operator*=(Pack b) { return *this = *this * b; }
  Pack& operator/=(Pack b) { return *this = *this / b; }
  friend Pack operator+(Pack a, Pack b) { return {(++operations.additions, a.value + b.value)}; }
  friend Pack operator-(Pack a, Pack b) { return {(++operations.additions, a.value - b.value)}; }
  friend Pack operator*(Pack a, Pack b) { return {(++operations.multiplications, a.value * b.value)}; }
  friend Pack operator/(Pack a, Pack b) { return {(++operations.divisions, a.value / b.value)}; }
  friend Pack operator-(Pack a) { return {-a.value}; }
  friend Bits operator<(Pack a, Pack b) { return {(++operations.comparisons, a.value < b.value ? -1 : 0)}; }
  friend Bits operator>(Pack a, Pack b) { return b < a; }
  friend Bits operator<=(Pack a, Pack b) { return {(++operations.comparisons, a.value <= b.value ? -1 : 0)}; }

  friend Pack operator+(Pack a, double b) { return a + Pack{b}; }
  friend Pack operator-(Pack a, double b) { return a - Pack{b}; }
  friend Pack operator*(Pack a, double b) { return a * Pack{b}; }
  friend Pack operator*(double a, Pack b) { return Pack{a} * b; }
  friend Bits operator<(Pack a, double b) { return a < Pack{b}; }
  /// A constant is repeated by taking nothing from it: no operation.
  friend Pack operator-(double a, Pack b) { return b.value == 0.0 ? Pack{a} : Pack{a} - b; }
};

}  // namespace counted
}  // namespace epicyclic::model

namespace epicyclic {

template <>
struct detail::LanePack<1> {
  using Values = model::counted::Pack;
  using Bits = model::counted::Bits;
  using Words = model::counted::Words;
};

/// What a table gives. Its cubics are worked on as rows of doubles: each takes 3 additions and 3 multiplications.
template <std::size_t W, std::size_t K>
[[nodiscard]] std::array<Lanes<W>, K> transposed(const std::array<Row<double, K>, W>& rows) requires(W == 1) {
  std::array<Lanes<W>, K> columns;
  for (std::size_t j = 0; j < K; ++j) columns[j].set(0, rows[0][j]);
  model::counted::operations.additions += 3 * static_cast<long>(K);
  model::counted::operations.multiplications += 3 * static_cast<long>(K);
  return columns;
}

}  // namespace epicyclic

namespace epicyclic::model {

/// Of one evaluation in one lane. `dyds` is what it gives.
inline Operations operations_of_lane(const DynamicModel& model, std::size_t segment, double s, const double* y,
                                     double* dyds) {
  Operations counts;
  with_planets(model.planets, [&]<std::size_t N>() {
    LaneParameters<N, 1> p(constants_of<N>(model, model.layout));
    p.set_segment(0, segment);
    std::vector<Lanes<1>> in(y, y + model.dimension);
    std::vector<Lanes<1>> out(model.dimension);
    const Lanes<1> at(s);
    counted::operations = {};
    PhaseCoefficients<Lanes<1>, N> now;
    make_phase_coefficients(p, 1, &at, &now);
    right_hand_side(model.layout, p.constants(), now, in.data(), out.data());
    counts = counted::operations;
    for (std::size_t i = 0; i < model.dimension; ++i) dyds[i] = out[i][0];
  });
  return counts;
}

}  // namespace epicyclic::model
