#include "core/interpolation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/errors.hpp"
#include "core/fitted_rows.hpp"
#include "core/interval_grid.hpp"

namespace epicyclic::interpolation_test {
namespace {

constexpr double rounding = 1e-14;

/// Between the rows of f on [0, 1] with n intervals.
template <class F>
double error_of(Interpolation how, std::size_t n, F f) {
  std::vector<double> x;
  std::vector<double> y;
  for (std::size_t k = 0; k <= n; ++k) {
    x.push_back(static_cast<double>(k) / static_cast<double>(n));
    y.push_back(f(x.back()));
  }
  const auto cubics = cubics_through(how, x, y);
  double worst = 0.0;
  for (std::size_t k = 0; k < n; ++k)
    for (const double share : {0.1, 0.3, 0.5, 0.7, 0.9}) {
      const double t = share / static_cast<double>(n);
      worst = std::max(worst, std::abs(at(cubics[k], t) - f(x[k] + t)));
    }
  return worst;
}

/// Of the worst error of some f(x, c).
double order(Interpolation how, double (*f)(double x, double c)) {
  const auto worst = [&](std::size_t n) {
    double most = 0.0;
    for (double c = 0.3; c < 0.5; c += 0.01) most = std::max(most, error_of(how, n, [&](double x) { return f(x, c); }));
    return most;
  };
  return std::log2(worst(32) / worst(256)) / 3.0;
}

TEST(Interpolation, HasItsOrder) {
  const auto hill = [](double x, double c) { return std::sin(3.0 * x + c); };  // its top is at 0.36 to 0.42
  const auto slope = [](double x, double c) { return std::exp(3.0 * c * x); };
  constexpr double near = 0.2;
  EXPECT_NEAR(order(Interpolation::linear, slope), 2.0, near);
  // Slopes at extrema are 0 at rows beside them.
  EXPECT_NEAR(order(Interpolation::monotone, hill), 2.0, near);
  // Away from them of second order, those at the ends included: secants there would leave the second order.
  EXPECT_NEAR(order(Interpolation::monotone, slope), 3.0, near);
  EXPECT_NEAR(order(Interpolation::smooth, hill), 4.0, near);
  EXPECT_NEAR(order(Interpolation::smooth, slope), 4.0, near);
}

TEST(Interpolation, SmoothReproducesCubicsOnUnevenRows) {
  const auto f = [](double x) { return 2.0 - x + 3.0 * x * x - 4.0 * x * x * x; };
  const std::vector<double> x = {-1.0, -0.7, 0.1, 0.2, 0.9, 2.0, 2.1};
  for (const std::size_t rows : {std::size_t{4}, std::size_t{5}, x.size()}) {
    const std::vector<double> some(x.begin(), x.begin() + static_cast<std::ptrdiff_t>(rows));
    std::vector<double> y;
    for (const double at : some) y.push_back(f(at));
    const auto cubics = cubics_through(Interpolation::smooth, some, y);
    for (std::size_t k = 0; k + 1 < rows; ++k) {
      const double middle = 0.5 * (some[k] + some[k + 1]);
      EXPECT_NEAR(at(cubics[k], middle - some[k]), f(middle), 100.0 * rounding);
    }
  }
}

TEST(Interpolation, SlopesAtTheEndsAreSteffensOwn) {
  // p = s_0 (1 + h_0 / (h_0 + h_1)) - s_1 h_0 / (h_0 + h_1), 0 or 2 s_0 where it would not be monotone.
  const auto first_slope = [](double s_0, double s_1) {
    const std::vector<double> x = {0.0, 2.0, 3.0};
    const std::vector<double> y = {1.0, 1.0 + 2.0 * s_0, 1.0 + 2.0 * s_0 + s_1};
    const double slope = cubics_through(Interpolation::monotone, x, y)[0][1];
    // The other end is its mirror image.
    const std::vector<double> back = {-3.0, -2.0, 0.0};
    const std::vector<double> down = {y[2], y[1], y[0]};
    const CubicCoefficients c = cubics_through(Interpolation::monotone, back, down)[1];
    EXPECT_NEAR(c[1] + 2.0 * (2.0 * c[2] + 3.0 * 2.0 * c[3]), -slope, 10.0 * rounding);
    return slope;
  };
  EXPECT_NEAR(first_slope(1.0, 1.5), 1.0 * (1.0 + 2.0 / 3.0) - 1.5 * 2.0 / 3.0, rounding);
  EXPECT_EQ(first_slope(1.0, 4.0), 0.0);
  EXPECT_EQ(first_slope(1.0, -1.0), 2.0);
}

TEST(Interpolation, MonotoneNeverGoesBeyondItsRows) {
  const std::vector<double> x = {0.0, 0.1, 0.5, 0.6, 1.4, 1.5};
  const std::vector<double> y = {0.0, 5.0, 5.1, -2.0, -2.0, 7.0};
  const auto cubics = cubics_through(Interpolation::monotone, x, y);
  for (std::size_t k = 0; k + 1 < x.size(); ++k)
    for (double share = 0.0; share <= 1.0; share += 0.01) {
      const double value = at(cubics[k], share * (x[k + 1] - x[k]));
      EXPECT_GE(value, std::min(y[k], y[k + 1]) - rounding * 100.0);
      EXPECT_LE(value, std::max(y[k], y[k + 1]) + rounding * 100.0);
    }
}

TEST(Interpolation, RowsThatDoNotRiseAreAnInputError) {
  const std::vector<double> x = {0.0, 0.5, 0.5};
  for (const auto how : {Interpolation::linear, Interpolation::monotone, Interpolation::smooth})
    EXPECT_THROW((void)cubics_through(how, x, x), InputError);
}

TEST(EverySecond, KeepsBothSidesOfJumpsAndBreakpoints) {
  const std::vector<double> x = {0.0, 0.0, 0.1, 0.2, 0.3, 0.4, 0.4, 0.6, 0.8, 0.9};
  EXPECT_EQ(every_second(x, std::vector<double>{0.0, 0.4}), (std::vector<std::size_t>{0, 1, 3, 5, 6, 8}));
  const std::vector<double> kink = {0.0, 0.2, 0.3, 0.7};
  EXPECT_EQ(every_second(kink, std::vector<double>{0.2}), (std::vector<std::size_t>{0, 1, 3}));
}

std::vector<IntervalGrid> grids() {
  std::vector<IntervalGrid> all;
  for (const std::size_t n : {1U, 2U, 3U, 7U, 16U, 100U, 1000U}) all.push_back(IntervalGrid::even(n));
  for (const bool at_end : {false, true})
    for (const int octaves : {1, 5, 30})
      for (const std::size_t n : {1U, 8U, 64U}) all.push_back(IntervalGrid::graded(n, octaves, at_end));
  return all;
}

TEST(IntervalGrid, IsFoundWithoutASearch) {
  for (const IntervalGrid& g : grids()) {
    const double last = g.node(g.count);
    EXPECT_NEAR(last, g.offset + g.scale, rounding * last);
    for (std::size_t k = 0; k < g.count; ++k) {
      const double from = g.node(k);
      const double to = g.node(k + 1);
      ASSERT_LT(from, to);
      EXPECT_EQ(g.number(from), k);
      EXPECT_EQ(g.number(0.5 * (from + to)), k);
      EXPECT_EQ(g.number(std::nextafter(to, from)), k);
    }
    // Beyond it the outermost ones, also far, and where there is no number.
    EXPECT_EQ(g.number(g.offset - 1.0), 0U);
    EXPECT_EQ(g.number(-1e300), 0U);
    EXPECT_EQ(g.number(last), g.count - 1);
    EXPECT_EQ(g.number(1e300), g.count - 1);
    EXPECT_EQ(g.number(std::nan("")), 0U);
  }
}

TEST(IntervalGrid, WaysRunFromTheStartOfThePieceToItsEnd) {
  for (const IntervalGrid& g : grids()) {
    EXPECT_EQ(g.fraction(0), g.from_end ? 1.0 : 0.0);
    EXPECT_EQ(g.fraction(g.count), g.from_end ? 0.0 : 1.0);
    for (std::size_t k = 0; k < g.count; ++k) {
      EXPECT_NE(g.fraction(k), g.fraction(k + 1));
      EXPECT_EQ(g.fraction(k) < g.fraction(k + 1), !g.from_end);
    }
    if (g.per_octave > 0) continue;
    for (std::size_t k = 0; k <= g.count; ++k)
      EXPECT_NEAR(g.fraction(k), static_cast<double>(k) / static_cast<double>(g.count), rounding);
  }
}

TEST(IntervalGrid, HalvedHasEverySecondNode) {
  for (const IntervalGrid& g : grids()) {
    if (!g.can_be_halved()) continue;
    const IntervalGrid half = g.halved();
    ASSERT_EQ(2 * half.count, g.count);
    for (std::size_t k = 0; k <= half.count; ++k) EXPECT_NEAR(half.fraction(k), g.fraction(2 * k), rounding);
  }
}

/// Greatest error of fitted rows, by many places in each interval.
template <class F>
double measured(const FittedRows<1>& r, F f) {
  std::vector<double> v;
  std::vector<double> y;
  for (std::size_t k = 0; k <= r.grid.count; ++k) {
    v.push_back(r.grid.node(k));
    y.push_back(r.rows[k][0]);
  }
  const auto cubics = cubics_through(Interpolation::smooth, v, y);
  double worst = 0.0;
  for (std::size_t k = 0; k < r.grid.count; ++k)
    for (double share = 0.05; share < 1.0; share += 0.1) {
      const double t = share * (v[k + 1] - v[k]);
      const double u = (v[k] + t - r.grid.offset) / r.grid.scale;
      worst = std::max(worst, std::abs(at(cubics[k], t) - f(r.grid.from_end ? 1.0 - u : u)[0]));
    }
  return worst;
}

TEST(FittedRows, MeetTheirToleranceAndTellNoLessThanTheirError) {
  const auto smooth = [](double x) { return std::array{std::exp(-2.0 * x) * std::cos(5.0 * x)}; };
  const auto from_start = [](double x) { return std::array{0.01 * std::pow(x, 1.036) * std::exp(-x)}; };
  const auto from_end = [](double x) { return std::array{-0.01 * std::pow(1.0 - x, 1.036) * std::cos(x)}; };
  for (const double tolerance : {1e-5, 1e-7, 1e-9, 1e-11}) {
    const auto check = [&](const auto& f, SingularEnd end) {
      const FittedRows<1> r = fit_rows<1>(f, tolerance, end);
      EXPECT_LE(r.error, tolerance);
      EXPECT_LE(measured(r, f), r.error + rounding);
      EXPECT_EQ(r.rows.size(), r.grid.count + 1);
    };
    check(smooth, SingularEnd::none);
    check(from_start, SingularEnd::start);
    check(from_end, SingularEnd::end);
  }
}

TEST(FittedRows, RefinedOnesAreThoseOfTheWholeGridAndAskNoPlaceTwice) {
  for (const SingularEnd end : {SingularEnd::none, SingularEnd::start, SingularEnd::end}) {
    std::map<double, int> asked;
    const auto f = [&](double x) {
      ++asked[x];
      const double from = end == SingularEnd::end ? 1.0 - x : x;
      return std::array{std::pow(from, 1.036) + std::sin(9.0 * x)};
    };
    const auto smooth = [&](double x) {
      ++asked[x];
      return std::array{std::sin(9.0 * x)};
    };
    const FittedRows<1> r = end == SingularEnd::none ? fit_rows<1>(smooth, 1e-9) : fit_rows<1>(f, 1e-9, end);
    std::size_t calls = 0;
    for (const auto& [x, times] : asked) calls += static_cast<std::size_t>(times);
    // Other octaves are another grid.
    if (end == SingularEnd::none) {
      EXPECT_EQ(calls, r.rows.size());
    }
    EXPECT_LT(calls, 2 * r.rows.size());
    EXPECT_EQ((end == SingularEnd::none ? rows_on<1>(r.grid, smooth) : rows_on<1>(r.grid, f)).rows, r.rows);
  }
}

TEST(FittedRows, OfAFunctionThatHasKinksTellWhatTheyReach) {
  const auto kinked = [](double x) { return std::array{std::abs(x - 0.313)}; };
  constexpr double asked = 1e-9;
  const FittedRows<1> r = fit_rows<1>(kinked, asked);
  EXPECT_GT(r.error, asked);
  EXPECT_EQ(r.grid.count, 2048U);
}

}  // namespace
}  // namespace epicyclic::interpolation_test
