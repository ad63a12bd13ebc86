#include "gear/accuracy.hpp"

#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "core/errors.hpp"
#include "gear/gear_set.hpp"
#include "problems/table1.hpp"

namespace epicyclic::gear::accuracy_test {
namespace {

// Products of a step and a whole number.
constexpr double rounding = 1e-12;

void expect_tolerances(const Tolerances& t, const Tolerances& expected, const std::string& where) {
  EXPECT_NEAR(t.single_pitch, expected.single_pitch, rounding) << where;
  EXPECT_NEAR(t.cumulative_pitch, expected.cumulative_pitch, rounding) << where;
  EXPECT_NEAR(t.profile, expected.profile, rounding) << where;
  EXPECT_NEAR(t.profile_form, expected.profile_form, rounding) << where;
  EXPECT_NEAR(t.profile_slope, expected.profile_slope, rounding) << where;
  EXPECT_NEAR(t.helix, expected.helix, rounding) << where;
  EXPECT_NEAR(t.single_flank, expected.single_flank, rounding) << where;
}

TEST(Accuracy, GradeSixOfTable1IsAsPrinted) {
  // docs/theory/parameters.md, section 4.
  const Tolerances external{8.5, 27, 11, 8.5, 7.0, 14, 22};
  const Tolerances ring{9.0, 35, 13, 9.5, 8.0, 15, 24};
  expect_tolerances(tolerances(6, 2.63, 71.01, 60, 1.2), external, "sun");
  expect_tolerances(tolerances(6, 2.63, 65.75, 60, 1.2), external, "planet");
  expect_tolerances(tolerances(6, 2.57627, 208.678, 60, 1.196), ring, "ring");
  Stage s = problems::table1();
  s.catalogue->stiffness.harmonics = 0;
  const MemberTolerances m = member_tolerances(make_gear_set(s));
  expect_tolerances(m.sun.value(), external, "sun of the set");
  expect_tolerances(m.planet.value(), external, "planet of the set");
  expect_tolerances(m.ring.value(), ring, "ring of the set");
}

TEST(Accuracy, TabulatedValuesOfTheStandard) {
  // Tables of ISO 1328-1:1995 as handbooks print them: grade 5, m 2 to 3.5, d 50 to 125: f_pt 6.0, F_p 19, F_alpha 8.0,
  // F_beta 10 (b 40 to 80); grade 8 of the same: 17, 53, 22, 28.
  const Tolerances five = tolerances(5, 3, 100, 60, 1.6);
  EXPECT_NEAR(five.single_pitch, 6.0, rounding);
  EXPECT_NEAR(five.cumulative_pitch, 19.0, rounding);
  EXPECT_NEAR(five.profile, 8.0, rounding);
  EXPECT_NEAR(five.helix, 10.0, rounding);
  const Tolerances eight = tolerances(8, 3, 100, 60, 1.6);
  EXPECT_NEAR(eight.single_pitch, 17.0, rounding);
  EXPECT_NEAR(eight.cumulative_pitch, 53.0, rounding);
  EXPECT_NEAR(eight.profile, 22.0, rounding);
  EXPECT_NEAR(eight.helix, 28.0, rounding);
}

TEST(Accuracy, TwoGradesDoubleTheToleranceButForItsRounding) {
  for (int grade = 0; grade <= 10; ++grade) {
    const Tolerances fine = tolerances(grade, 3, 100, 60, 1.6);
    const Tolerances coarse = tolerances(grade + 2, 3, 100, 60, 1.6);
    const auto step = [](double x) { return x > 10.0 ? 1.0 : x >= 5.0 ? 0.5 : 0.1; };
    EXPECT_NEAR(coarse.single_pitch, 2.0 * fine.single_pitch,
                step(fine.single_pitch) + 0.5 * step(coarse.single_pitch) + rounding)
        << grade;
    EXPECT_NEAR(coarse.helix, 2.0 * fine.helix, step(fine.helix) + 0.5 * step(coarse.helix) + rounding) << grade;
  }
}

TEST(Accuracy, RoundingIsWholeHalfAndTenthMicrometres) {
  for (int grade = 0; grade <= 12; ++grade)
    for (const double module : {1.0, 3.0, 8.0, 30.0})
      for (const double width : {8.0, 60.0, 300.0}) {
        const Tolerances t = tolerances(grade, module, 300.0, width, 1.5);
        for (const double x : {t.single_pitch, t.cumulative_pitch, t.profile, t.profile_form, t.profile_slope, t.helix,
                               t.single_flank}) {
          const double step = x > 10.0 ? 1.0 : x > 5.0 ? 0.5 : 0.1;
          EXPECT_NEAR(x / step, std::round(x / step), rounding) << x;
          EXPECT_GT(x, 0.0);
        }
      }
}

TEST(Accuracy, IsConstantWithinTheRangesAndTheUpperLimitBelongsToThem) {
  const Tolerances inside = tolerances(6, 3.0, 100.0, 60.0, 1.5);
  expect_tolerances(tolerances(6, 2.01, 51.0, 41.0, 1.5), inside, "low");
  expect_tolerances(tolerances(6, 3.5, 125.0, 80.0, 1.5), inside, "upper limits");
  EXPECT_GT(tolerances(8, 3.51, 100.0, 60.0, 1.5).profile, tolerances(8, 3.5, 100.0, 60.0, 1.5).profile);
  EXPECT_GT(tolerances(8, 3.0, 125.1, 60.0, 1.5).cumulative_pitch, tolerances(8, 3.0, 125, 60, 1.5).cumulative_pitch);
  EXPECT_GT(tolerances(8, 3.0, 100.0, 80.1, 1.5).helix, tolerances(8, 3.0, 100.0, 80.0, 1.5).helix);
}

TEST(Accuracy, SingleFlankToleranceDependsOnTheContactRatioUpToFour) {
  const auto f = [](double ratio) { return tolerances(12, 3, 100, 60, ratio).single_flank; };
  EXPECT_GT(f(1.2), f(2.0));
  EXPECT_EQ(f(4.0), f(7.0));
  // K = 0.2 (eps + 4) / eps is 1 at 1 and 0.4 at 4: the standard's two cases meet.
  constexpr double rounded = 1.5;
  EXPECT_NEAR(f(3.9999), f(4.0), rounded);
  EXPECT_NEAR(f(1.0), 2.5 * f(4.0), 2.5 * rounded);
}

TEST(Accuracy, OutsideItsRangesThereIsNoStandard) {
  EXPECT_THROW((void)tolerances(-1, 3, 100, 60, 1.5), DomainError);
  EXPECT_THROW((void)tolerances(13, 3, 100, 60, 1.5), DomainError);
  EXPECT_THROW((void)tolerances(6, 0.49, 100, 60, 1.5), DomainError);
  EXPECT_THROW((void)tolerances(6, 70.1, 100, 60, 1.5), DomainError);
  EXPECT_THROW((void)tolerances(6, 3, 4.9, 60, 1.5), DomainError);
  EXPECT_THROW((void)tolerances(6, 3, 10001, 60, 1.5), DomainError);
  EXPECT_THROW((void)tolerances(6, 3, 100, 3.9, 1.5), DomainError);
  EXPECT_THROW((void)tolerances(6, 3, 100, 1001, 1.5), DomainError);
  EXPECT_THROW((void)tolerances(6, std::nan(""), 100, 60, 1.5), DomainError);
  EXPECT_NO_THROW((void)tolerances(0, 0.5, 5, 4, 1.5));
  EXPECT_NO_THROW((void)tolerances(12, 70, 10000, 1000, 1.5));
}

TEST(ErrorAmplitude, IsHalfOfTheFormDeviationOfTheWorseMember) {
  // Grade 6 of Table 1: f_f alpha 8.5 and 9.5, f_pt 8.5 and 9 um.
  Stage s = problems::table1();
  s.catalogue->stiffness.harmonics = 0;
  const MemberTolerances m = member_tolerances(make_gear_set(s));
  EXPECT_NEAR(error_amplitude_um(ErrorAmplitude::profile_form, m.sun, m.planet).value(), 4.25, rounding);
  EXPECT_NEAR(error_amplitude_um(ErrorAmplitude::profile_form, m.planet, m.ring).value(), 4.75, rounding);
  EXPECT_NEAR(error_amplitude_um(ErrorAmplitude::profile_form, m.ring, m.planet).value(), 4.75, rounding);
  EXPECT_NEAR(error_amplitude_um(ErrorAmplitude::single_pitch, m.planet, m.ring).value(), 9.0, rounding);
  // Of one member alone, and of none.
  EXPECT_NEAR(error_amplitude_um(ErrorAmplitude::profile_form, std::nullopt, m.ring).value(), 4.75, rounding);
  EXPECT_FALSE(error_amplitude_um(ErrorAmplitude::profile_form, std::nullopt, std::nullopt).has_value());
}

}  // namespace
}  // namespace epicyclic::gear::accuracy_test
