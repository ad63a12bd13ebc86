// Transmission errors beyond one sine: harmonics, curves, their derivative, and meshes that run backward.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "gear/kinematics.hpp"
#include "model/dynamic_model.hpp"
#include "model/friction_track.hpp"
#include "problems/pair.hpp"
#include "problems/r1.hpp"

namespace epicyclic::model::error_curve_test {
namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;
constexpr double rounding = 1e-13;
constexpr double omega = 0.7;

DynamicModel model_of(const gear::Stage& stage) {
  return make_dynamic_model(stage, scales_of(stage), omega, ModelOptions{});
}

/// e_i and e_i' of the sun-planet meshes: what is missing in the deflections of a stage at rest in the origin.
struct Errors {
  std::vector<double> value, rate;
};
Errors errors_at(const DynamicModel& m, double s) {
  MeshDeflections d;
  const std::vector<double> rest(m.dimension, 0.0);
  m.deflections(s, rest.data(), d);
  Errors e{d.sun_planet, d.sun_planet_rate};
  for (auto* list : {&e.value, &e.rate})
    for (double& x : *list) x = -x;
  return e;
}

gear::Stage quiet(gear::Stage s) {
  for (gear::Mesh* mesh : {&s.sun_planet_mesh, &s.ring_planet_mesh}) mesh->error_amplitude_um = {0.0};
  return s;
}

TEST(ErrorHarmonics, TheFirstOneIsTheSineOfAmplitudeAndPhase) {
  const gear::Stage base = problems::with_teeth(quiet(problems::r1()), 28, 26, 80, 3);  // planets out of phase
  gear::Stage sine = base;
  sine.sun_planet_mesh.error_amplitude_um = {6.0};
  sine.sun_planet_mesh.error_phase_deg = {35.0};
  gear::Stage harmonics = base;
  const double phase = 35.0 * std::numbers::pi / 180.0;
  harmonics.sun_planet_mesh.error_cos_um = {6.0 * std::sin(phase)};
  harmonics.sun_planet_mesh.error_sin_um = {6.0 * std::cos(phase)};
  for (const gear::Driver driver : {gear::Driver::sun, gear::Driver::carrier}) {
    sine.driver = harmonics.driver = driver;
    const DynamicModel a = model_of(sine);
    const DynamicModel b = model_of(harmonics);
    for (const double s : {0.0, 0.4, 2.9, 5.0})
      for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_NEAR(errors_at(a, s).value[i], errors_at(b, s).value[i], rounding);
        EXPECT_NEAR(errors_at(a, s).rate[i], errors_at(b, s).rate[i], rounding);
      }
  }
}

TEST(ErrorHarmonics, AreSumsOverTheMeshPhase) {
  gear::Stage s = quiet(problems::torsional_pair());
  s.sun_planet_mesh.error_cos_um = {1.0, 0.0, -2.0, 0.5};
  s.sun_planet_mesh.error_sin_um = {0.0, 3.0};
  const DynamicModel m = model_of(s);
  for (const double x : {0.0, 0.3, 1.7, 4.4}) {
    // In b_c = 10 um.
    const double e = 0.1 * (std::cos(x) - 2.0 * std::cos(3.0 * x) + 0.5 * std::cos(4.0 * x) + 3.0 * std::sin(2.0 * x));
    const double slope =
        0.1 * (-std::sin(x) + 6.0 * std::sin(3.0 * x) - 2.0 * std::sin(4.0 * x) + 6.0 * std::cos(2.0 * x));
    EXPECT_NEAR(errors_at(m, x).value[0], e, rounding);
    EXPECT_NEAR(errors_at(m, x).rate[0], omega * slope, rounding);
  }
}

TEST(ErrorCurve, RateIsTheDerivativeOfTheCurve) {
  for (const Interpolation how : {Interpolation::linear, Interpolation::monotone, Interpolation::smooth}) {
    gear::Stage stage = problems::with_error_curve(problems::with_teeth(problems::r1(), 28, 26, 80, 3));
    stage.sun_planet_mesh.error_curve->interpolation = how;
    const DynamicModel m = model_of(stage);
    for (const double s : {0.2, 1.0, 2.2, 3.1, 4.9}) {
      constexpr double h = 1e-4;
      // Each of these instants and its neighbours are in one interval of the rows: differences of cubics are exact but
      // for the harmonics.
      const auto at = [&](double x) { return errors_at(m, x).value; };
      const Errors here = errors_at(m, s);
      for (std::size_t i = 0; i < 3; ++i) {
        const double slope = (8.0 * (at(s + h)[i] - at(s - h)[i]) - (at(s + 2 * h)[i] - at(s - 2 * h)[i])) / (12.0 * h);
        EXPECT_NEAR(here.rate[i], omega * slope, 1e-11) << i << " at " << s;
      }
    }
  }
}

TEST(ErrorCurve, OfManyRowsIsTheFunctionToTheOrderOfItsInterpolation) {
  const auto worst = [](int rows) {
    gear::Stage stage = quiet(problems::torsional_pair());
    gear::ErrorCurve curve;
    curve.interpolation = Interpolation::smooth;
    for (int k = 0; k < rows; ++k) {
      curve.phase.push_back(static_cast<double>(k) / rows);
      curve.error_um.push_back(10.0 * std::sin(two_pi * curve.phase.back() + 0.3));
    }
    stage.sun_planet_mesh.error_curve = curve;
    const DynamicModel m = model_of(stage);
    double value = 0.0;
    double rate = 0.0;
    for (double s = 0.0; s < two_pi; s += 0.01) {
      const Errors e = errors_at(m, s);
      value = std::max(value, std::abs(e.value[0] - std::sin(s + 0.3)));
      rate = std::max(rate, std::abs(e.rate[0] - omega * std::cos(s + 0.3)));
    }
    return std::pair(value, rate);
  };
  const auto coarse = worst(24);
  const auto fine = worst(48);
  EXPECT_NEAR(std::log2(coarse.first / fine.first), 4.0, 0.3);
  EXPECT_NEAR(std::log2(coarse.second / fine.second), 3.0, 0.3);
  EXPECT_LT(fine.first, 1e-6);
}

TEST(ErrorCurve, OfMeshesThatRunBackwardIsPassedInTheOppositeOrder) {
  const gear::Stage forward = problems::with_error_curve(quiet(problems::r1()));
  gear::Stage backward = forward;
  backward.driver = gear::Driver::carrier;
  const DynamicModel a = model_of(forward);
  const DynamicModel b = model_of(backward);
  for (const double s : {0.3, 1.1, 2.5, 4.4}) {
    EXPECT_NEAR(errors_at(b, s).value[0], errors_at(a, two_pi - s).value[0], rounding);
    EXPECT_NEAR(errors_at(b, s).rate[0], -errors_at(a, two_pi - s).rate[0], rounding);
  }
}

TEST(ErrorCurve, StepsEndOnItsKinks) {
  const gear::Stage stage = problems::with_error_curve(quiet(problems::torsional_pair()));
  const DynamicModel m = model_of(stage);
  for (const double kink : {0.0, 0.3})
    EXPECT_TRUE(std::ranges::any_of(m.breakpoints, [&](double s) { return std::abs(s - two_pi * kink) < 1e-12; }));
}

TEST(ErrorCurve, LinearEquilibriumHasItsValue) {
  const gear::Stage moving = problems::with_error_curve(quiet(problems::r1()));
  gear::Stage constant = quiet(problems::r1());
  // At s = 0, with the curve at 0 there.
  constant.sun_planet_mesh.error_mean_um = {1.5 - 0.7 + 0.4};
  constant.ring_planet_mesh.error_mean_um = {-1.5 - 0.7 + 0.4};
  const std::vector<double> expected = model_of(constant).default_start;
  const std::vector<double> start = model_of(moving).default_start;
  ASSERT_EQ(start.size(), expected.size());
  for (std::size_t k = 0; k < start.size(); ++k) EXPECT_NEAR(start[k], expected[k], 1e-11) << k;
}

TEST(ErrorCurve, JumpsAreRefused) {
  gear::Stage stage = problems::with_error_curve(problems::torsional_pair());
  ASSERT_TRUE(gear::problems_for_dynamics(stage).empty());
  stage.sun_planet_mesh.error_curve = gear::ErrorCurve{{0.0, 0.5, 0.5}, {0.0, 1.0, 2.0}, {0.5}};
  const std::vector<std::string> problems = gear::problems_for_dynamics(stage);
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_NE(problems[0].find("/lumped/sun_planet_mesh/error_curve/phase/2: stands twice"), std::string::npos);
}

TEST(StiffnessCurveMean, IsThatOfItsCubics) {
  const gear::StiffnessCurve straight{{0.0, 0.5}, {1.0, 3.0}, {}, Interpolation::linear};
  EXPECT_NEAR(mean_stiffness(straight), 2.0, rounding);
  // 2 before a jump at 0.25, 4 behind it.
  const gear::StiffnessCurve step{{0.0, 0.0, 0.25, 0.25}, {4.0, 2.0, 2.0, 4.0}, {0.0, 0.25}};
  EXPECT_NEAR(mean_stiffness(step), 3.5, rounding);
}

}  // namespace
}  // namespace epicyclic::model::error_curve_test
