#include "core/row.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <random>

#include <gtest/gtest.h>

#include "core/dual.hpp"
#include "core/lanes.hpp"

namespace epicyclic::row_test {
namespace {

/// A formula with every operation that a row has; T is a scalar, or a row of it.
template <class T>
T formula(const T& a, const T& b) {
  using epicyclic::select;
  using epicyclic::sqrt;
  T r = (a + b) * a - b / (a * a + 1.0);
  r += -a;
  r *= b;
  r -= sqrt(a * a + b * b);
  r /= 2.0 + b * b;
  return select(a < b, r, T(a)) + select(a > b, T(b), r);
}

template <std::size_t N>
void expect_values_of_their_own() {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> number(-3.0, 3.0);
  Row<double, N> a{};
  Row<double, N> b{};
  for (double& x : a) x = number(random);
  for (double& x : b) x = number(random);
  b[0] = a[0];  // neither less nor greater
  const Row<double, N> r = formula(a, b);
  double total = r[0];
  for (std::size_t i = 1; i < N; ++i) total += r[i];
  for (std::size_t i = 0; i < N; ++i) EXPECT_EQ(r[i], formula(a[i], b[i])) << N << " " << i;
  EXPECT_EQ(sum(r), total) << N;
  std::array<double, N> seen{};
  r.each([&](std::size_t i, double x) { seen[i] = x; });
  for (std::size_t i = 0; i < N; ++i) EXPECT_EQ(seen[i], r[i]);
}

TEST(Row, EachValueIsThatOfItsScalar) {
  expect_values_of_their_own<1>();
  expect_values_of_their_own<2>();
  expect_values_of_their_own<3>();
  expect_values_of_their_own<4>();
  expect_values_of_their_own<5>();
  expect_values_of_their_own<6>();
}

TEST(Row, PaddingIsNeverRead) {
  Row<double, 3> a(1.0);
  const Row<double, 3> zero_padded = Row<double, 3>::of([](std::size_t i) { return static_cast<double>(i + 1); });
  const Row<double, 3> quotient = a / (zero_padded - zero_padded * 0.0);  // 1 / 0 in the padding
  EXPECT_EQ(sum(quotient), 1.0 / 1.0 + 1.0 / 2.0 + 1.0 / 3.0);
  EXPECT_EQ(quotient.end() - quotient.begin(), 3);
}

TEST(Row, OfDualsHasTheDerivativesOfEach) {
  using D = Dual<2>;
  const auto a = Row<D, 3>::of([](std::size_t i) { return D::variable(0.3 + static_cast<double>(i), 0); });
  const auto b = Row<D, 3>::of([](std::size_t i) { return D::variable(1.7 - static_cast<double>(i), 1); });
  const Row<D, 3> r = formula(a, b);
  for (std::size_t i = 0; i < 3; ++i) {
    const D one = formula(a[i], b[i]);
    EXPECT_EQ(r[i].value, one.value);
    EXPECT_EQ(r[i].derivative, one.derivative);
  }
}

TEST(Row, OfLanesPicksInEachLane) {
  using L = Lanes<4>;
  Row<L, 3> a{};
  Row<L, 3> b{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t lane = 0; lane < 4; ++lane) {
      a[i].set(lane, std::sin(static_cast<double>(i + 3 * lane)));
      b[i].set(lane, std::cos(static_cast<double>(2 * i + lane)));
    }
  const Row<L, 3> r = formula(a, b);
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t lane = 0; lane < 4; ++lane) EXPECT_EQ(r[i][lane], formula(a[i][lane], b[i][lane]));
}

}  // namespace
}  // namespace epicyclic::row_test
