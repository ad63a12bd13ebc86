// Static load sharing with errors of the planets' positions, against the closed form for a floating sun.
//
// The sun has no support, so that its mesh forces have no resultant: sum F_i exp(i phi_i) = 0, and their sum is the
// torque. Ring and carrier then are loaded by torque alone. What is left of the errors, beside parts that move the sun,
// turns into force by the stiffness of one planet's path:
//
//   F_i = F_0 - k (e_i - P e_i) ,  1/k = 1/k_sp + 1/k_rp + (2 + 2 cos(alpha_sp + alpha_rp)) / k_p
//
// with P the projection on 1, cos phi_i, sin phi_i. Three planets share evenly whatever their errors are. Source: own
// derivation, docs/theory/model.md, section 5.

#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "gear/kinematics.hpp"
#include "model/dynamic_model.hpp"
#include "problems/r1.hpp"

namespace epicyclic::model::load_sharing_test {
namespace {

/// Equally spaced planets around a floating sun, loaded by torque alone.
gear::Stage floating(int planets) {
  gear::Stage stage = problems::r1();
  stage.planet_count = planets;
  stage.sun.support_N_per_m = 0.0;
  stage.sun_planet_mesh.error_amplitude_um = stage.ring_planet_mesh.error_amplitude_um = {0.0};
  stage.load = {std::nullopt, 600.0};
  return stage;
}

/// e - P e: what is left beside a rotation and a translation of the sun.
std::vector<double> left_over(const std::vector<double>& e) {
  const auto n = static_cast<double>(e.size());
  std::vector<double> left = e;
  for (std::size_t i = 0; i < e.size(); ++i)
    for (std::size_t j = 0; j < e.size(); ++j) {
      const double apart = 2.0 * std::numbers::pi * (static_cast<double>(i) - static_cast<double>(j)) / n;
      left[i] -= (1.0 + 2.0 * std::cos(apart)) / n * e[j];
    }
  return left;
}

/// Elastic forces of the sun's meshes at rest [N].
std::vector<double> forces_of(const gear::Stage& stage) {
  ModelOptions options;
  options.gyroscopic = Gyroscopic::off;
  const DynamicModel m = make_dynamic_model(stage, scales_of(stage), 1.0, options);
  StageForces f;
  m.forces(0.0, m.default_start.data(), f);
  std::vector<double> newton;
  for (const double x : f.sun_planet_elastic) newton.push_back(m.scales.force_newton(x));
  return newton;
}

/// @param errors_um  e_sp + e_rp of each planet
void expect_sharing(const gear::Stage& stage, const std::vector<double>& errors_um) {
  const gear::PressureAngles alpha = gear::pressure_angles(stage);
  const double compliance = 1.0 / stage.sun_planet_mesh.stiffness_N_per_m +
                            1.0 / stage.ring_planet_mesh.stiffness_N_per_m +
                            (2.0 + 2.0 * std::cos(alpha.sun_planet + alpha.ring_planet)) / stage.planet.bearing_N_per_m;
  const double mean = 600.0 / (stage.planet_count * 32.17853e-3);
  const std::vector<double> left = left_over(errors_um);
  const std::vector<double> forces = forces_of(stage);
  for (std::size_t i = 0; i < forces.size(); ++i)
    EXPECT_NEAR(forces[i], mean - left[i] * 1e-6 / compliance, 1e-6 * mean) << i;
}

TEST(LoadSharing, OfThreePlanetsIsEvenWhateverTheirErrors) {
  gear::Stage stage = floating(3);
  stage.planet.pin_error_tangential_um = {12.0, -5.0, 3.0};
  stage.planet.pin_error_radial_um = {-7.0, 4.0, 0.0};
  stage.sun_planet_mesh.error_mean_um = {1.0, 0.0, -2.0};
  expect_sharing(stage, {0.0, 0.0, 0.0});
}

TEST(LoadSharing, OfMorePlanetsIsThatOfTheClosedForm) {
  for (const int planets : {4, 5, 6}) {
    const auto n = static_cast<std::size_t>(planets);
    const gear::Stage even = floating(planets);
    const gear::PressureAngles alpha = gear::pressure_angles(even);
    std::vector<double> given(n);
    std::vector<double> tangential(n);
    std::vector<double> radial(n);
    for (std::size_t i = 0; i < n; ++i) {
      given[i] = 4.0 * std::sin(1.0 + 2.3 * static_cast<double>(i * i));
      tangential[i] = given[i] * (std::cos(alpha.sun_planet) + std::cos(alpha.ring_planet));
      radial[i] = given[i] * (std::sin(alpha.sun_planet) - std::sin(alpha.ring_planet));
    }
    const auto expect_with = [&](const auto& set, const std::vector<double>& errors_um) {
      gear::Stage stage = even;
      set(stage) = given;
      expect_sharing(stage, errors_um);
    };
    expect_with(
        [](gear::Stage & s) -> auto& { return s.planet.pin_error_tangential_um; }, tangential);
    expect_with(
        [](gear::Stage & s) -> auto& { return s.planet.pin_error_radial_um; }, radial);
    expect_with(
        [](gear::Stage & s) -> auto& { return s.sun_planet_mesh.error_mean_um; }, given);
    expect_with(
        [](gear::Stage & s) -> auto& { return s.ring_planet_mesh.error_mean_um; }, given);
    // The mirror image: tangential errors are towards rising angles, which are now against the torque.
    gear::Stage stage = even;
    stage.planet.pin_error_tangential_um = given;
    stage.load.torque_Nm = -600.0;
    std::vector<double> opposite = tangential;
    for (double& e : opposite) e = -e;
    expect_sharing(stage, opposite);
  }
}

TEST(LoadSharing, APlanetThatStandsAheadCarriesLess) {
  gear::Stage stage = floating(4);
  stage.planet.pin_error_tangential_um = {5.0, 0.0, 0.0, 0.0};
  const std::vector<double> forces = forces_of(stage);
  EXPECT_LT(forces[0], forces[1]);
  EXPECT_NEAR(forces[0], forces[2], 1e-6 * forces[0]);
}

TEST(LoadSharing, ErrorsThatAreEqualAreNone) {
  gear::Stage stage = floating(4);
  stage.planet.pin_error_tangential_um = {9.0};
  expect_sharing(stage, {0.0, 0.0, 0.0, 0.0});
}

}  // namespace
}  // namespace epicyclic::model::load_sharing_test
