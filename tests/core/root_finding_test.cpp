#include "core/root_finding.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <stdexcept>

#include <gtest/gtest.h>

#include "core/errors.hpp"

namespace epicyclic::root_finding_test {
namespace {

// The bracket is closed to four units in the last place, and f is rounded too.
constexpr double rounding = 8.0 * std::numeric_limits<double>::epsilon();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

TEST(FindRoot, FindsKnownRootsToRounding) {
  EXPECT_NEAR(find_root([](double x) { return x * x - 2.0; }, 0.0, 2.0), std::numbers::sqrt2, rounding * 2.0);
  EXPECT_NEAR(find_root([](double x) { return std::cos(x); }, 1.0, 2.0), 0.5 * std::numbers::pi, rounding * 2.0);
  EXPECT_NEAR(find_root([](double x) { return std::log(x) - 1.0; }, 1.0, 10.0), std::numbers::e, rounding * 4.0);
  // Dottie's number, OEIS A003957.
  EXPECT_NEAR(find_root([](double x) { return std::cos(x) - x; }, 0.0, 1.0), 0.7390851332151607, rounding);
}

TEST(FindRoot, FindsRootsThatFalseAssumptionsMiss) {
  // Steep at one end, flat, of a high order, tiny, huge, and a jump instead of a root.
  EXPECT_NEAR(find_root([](double x) { return std::expm1(50.0 * (x - 0.1)); }, -1.0, 1.0), 0.1, 0.1 * rounding);
  EXPECT_NEAR(find_root([](double x) { return std::pow(x - 0.3, 3); }, -1.0, 1.0), 0.3, 0.3 * rounding);
  EXPECT_NEAR(find_root([](double x) { return x - 1e-200; }, 0.0, 1.0), 1e-200, 1e-200 * rounding);
  EXPECT_NEAR(find_root([](double x) { return x - 1e200; }, 0.0, 1e300), 1e200, 1e200 * rounding);
  EXPECT_NEAR(find_root([](double x) { return x < 0.7 ? -1.0 : 2.0; }, 0.0, 1.0), 0.7, rounding);
}

TEST(FindRoot, ReturnsAnEndThatIsARoot) {
  EXPECT_EQ(find_root([](double x) { return x - 2.0; }, 2.0, 3.0), 2.0);
  EXPECT_EQ(find_root([](double x) { return x - 3.0; }, 2.0, 3.0), 3.0);
  EXPECT_EQ(find_root([](double x) { return x; }, -1.0, 1.0), 0.0);
}

TEST(FindRoot, FallingFunctionsAreAsGoodAsRisingOnes) {
  EXPECT_NEAR(find_root([](double x) { return 2.0 - x * x; }, 0.0, 2.0), std::numbers::sqrt2, rounding * 2.0);
}

TEST(FindRoot, WithoutAChangeOfSignThereIsADomainError) {
  EXPECT_THROW((void)find_root([](double x) { return x * x + 1.0; }, -1.0, 1.0), DomainError);
  EXPECT_THROW((void)find_root([](double x) { return -x * x - 1.0; }, -1.0, 1.0), DomainError);
}

TEST(FindRoot, WhatIsNotFiniteIsADomainErrorAtTheEndsAndBetween) {
  const double infinite = std::numeric_limits<double>::infinity();
  for (const double bad : {nan, infinite, -infinite}) {
    EXPECT_THROW((void)find_root([&](double x) { return x < 0.0 ? bad : 1.0; }, -1.0, 1.0), DomainError);
    EXPECT_THROW((void)find_root([&](double x) { return x > 0.0 ? bad : -1.0; }, -1.0, 1.0), DomainError);
    EXPECT_THROW((void)find_root([&](double x) { return x == -1.0  ? -1.0
                                                        : x == 1.0 ? 1.0
                                                                   : bad; }, -1.0, 1.0),
                 DomainError);
  }
}

TEST(FindRoot, ExceptionsOfTheFunctionComeThrough) {
  const auto inside = [](double x) -> double {
    if (std::abs(x) < 0.9) throw std::out_of_range("inside");
    return x;
  };
  EXPECT_THROW((void)find_root(inside, -1.0, 1.5), std::out_of_range);
  EXPECT_THROW((void)find_root([](double) -> double { throw std::length_error("at the end"); }, 0.0, 1.0),
               std::length_error);
  // And the next search is not disturbed by it.
  EXPECT_NEAR(find_root([](double x) { return x * x - 2.0; }, 0.0, 2.0), std::numbers::sqrt2, rounding * 2.0);
}

TEST(FindRoot, MaySearchWithinASearch) {
  // sqrt(y) by an inner search, then the y whose root is 1.5.
  const auto root = [](double y) { return find_root([&](double x) { return x * x - y; }, 0.0, 10.0); };
  EXPECT_NEAR(find_root([&](double y) { return root(y) - 1.5; }, 1.0, 9.0), 2.25, 2.25 * rounding);
}

TEST(SecantRoot, FindsWhatIsNearAndTellsWhatIsNot) {
  const auto f = [](double x) -> std::optional<double> { return std::exp(x) - 1.5; };
  // Secants end when a step is below 1e-11 of the span, the root then known to far less.
  EXPECT_NEAR(secant_root(f, 0.01, 1.0).value(), std::log(1.5), 1e-11);
  EXPECT_FALSE(secant_root(f, 0.01, 0.1).has_value());
  EXPECT_FALSE(secant_root([](double) -> std::optional<double> { return std::nullopt; }, 0.01, 1.0).has_value());
  const auto ends = [&](double x) -> std::optional<double> { return x > 0.3 ? std::nullopt : f(x); };
  EXPECT_FALSE(secant_root(ends, 0.01, 1.0).has_value());
}

}  // namespace
}  // namespace epicyclic::root_finding_test
