#include "core/text.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace epicyclic::text_test {
namespace {

TEST(WithError, TheErrorHasTwoDigitsAndTheValueReachesDownToThem) {
  EXPECT_EQ(with_error(-0.00154, 0.000076), "-0.001540 ± 0.000076");
  EXPECT_EQ(with_error(2.1e-5, 2.06e-5), "0.000021 ± 0.000021");
  EXPECT_EQ(with_error(0.0123, 0.0996), "0.01 ± 0.10");
  EXPECT_EQ(with_error(1234.56, 78.9), "1235 ± 79");
  EXPECT_EQ(with_error(0.951234567891, 3e-9), "0.9512345679 ± 3.0e-09");
  EXPECT_EQ(with_error(-1234.5, 4.4e-9), "-1234.5000000000 ± 4.4e-09");
  EXPECT_EQ(with_error(2.1e-9, 4e-10), "2.10e-09 ± 4.0e-10");
  EXPECT_EQ(with_error(0.0, 1e-12), "0e+00 ± 1.0e-12");
  EXPECT_EQ(with_error(1e-9, 0.01), "0.000 ± 0.010");
}

TEST(WithError, NoErrorIsPrintedAsZeroThatIsNone) {
  for (double error = 1e-30; error < 1e30; error *= 3.7) {
    const std::string text = with_error(0.731, error);
    const std::string printed = text.substr(text.find("± ") + std::string("± ").size());
    EXPECT_NEAR(std::stod(printed), error, 0.051 * error) << text;
  }
}

TEST(WithError, ValuesApartByMoreThanTheirErrorsDifferInPrint) {
  for (double error = 1e-13; error < 10.0; error *= 1.9) {
    const std::string a = with_error(0.5, error);
    const std::string b = with_error(0.5 + 2.01 * error, error);
    EXPECT_NE(a, b) << error;
  }
}

TEST(WithError, WhatIsNotKnownIsSaid) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(with_error(std::nan(""), 1.0), "unknown");
  EXPECT_EQ(with_error(0.25, infinity), "0.25 (no interval)");
  EXPECT_EQ(with_error(0.25, 0.0), "0.25");
  EXPECT_FALSE(with_error(1e300, 1e290).empty());
  EXPECT_FALSE(with_error(-5e-324, 5e-324).empty());
}

}  // namespace
}  // namespace epicyclic::text_test
