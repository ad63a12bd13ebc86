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

#include <algorithm>
#include <array>
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

/// Quasi-static forces of the sun's meshes [S-static], which are those of the default start [N].
std::vector<double> forces_of(const gear::Stage& stage) {
  ModelOptions options;
  options.gyroscopic = Gyroscopic::off;
  const DynamicModel m = make_dynamic_model(stage, scales_of(stage), 1.0, options);
  const auto newtons_at = [&](const std::vector<double>& state) {
    StageForces f;
    m.forces(0.0, state.data(), f);
    std::vector<double> newton;
    for (const double x : f.sun_planet_elastic) newton.push_back(m.scales.force_newton(x));
    return newton;
  };
  const std::vector<double> phase = {0.0};
  const auto states = m.quasi_static_states(phase);
  if (states.empty()) {
    ADD_FAILURE() << "no quasi-static state";
    return newtons_at(m.default_start);
  }
  const std::vector<double> newton = newtons_at(states[0]);
  const std::vector<double> start = newtons_at(m.default_start);
  for (std::size_t i = 0; i < newton.size(); ++i) EXPECT_NEAR(newton[i], start[i], 1e-6 * start[i]) << i;
  return newton;
}

/// 1 / k of one planet's path [m/N].
double compliance_of(const gear::Stage& stage, const gear::PressureAngles& alpha) {
  return 1.0 / stage.sun_planet_mesh.stiffness_N_per_m + 1.0 / stage.ring_planet_mesh.stiffness_N_per_m +
         (2.0 + 2.0 * std::cos(alpha.sun_planet + alpha.ring_planet)) / stage.planet.bearing_N_per_m;
}

/// @param errors_um  e_sp + e_rp of each planet
void expect_sharing(const gear::Stage& stage, const std::vector<double>& errors_um) {
  const gear::PressureAngles alpha = gear::pressure_angles(stage);
  const double compliance = compliance_of(stage, alpha);
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

/// One pin t ahead: F_1 = F_0 - (1 - 3 / N) k e ,  F_i = F_0 + (1 + 2 cos(2 pi (i - 1) / N)) k e / N. With four planets
/// the pairs that stand opposite carry F_0 -+ k e / 4. A table of docs/theory/model.md, section 5, has the numbers.
TEST(LoadSharing, OnePinAheadLoadsThePlanetsByNumberAndStiffness) {
  struct Row {
    int planets;
    double least, most;  ///< F_i / F_0, as printed
  };
  constexpr Row printed[] = {{3, 1.0000, 1.0000}, {4, 0.9717, 1.0283}, {5, 0.9433, 1.0459}, {6, 0.9150, 1.0567}};
  for (const Row& row : printed) {
    gear::Stage stage = floating(row.planets);
    const auto n = static_cast<std::size_t>(row.planets);
    std::vector<double> pins(n, 0.0);
    pins[0] = 10.0;
    stage.planet.pin_error_tangential_um = pins;
    const gear::PressureAngles alpha = gear::pressure_angles(stage);
    const double force =
        1e-5 * (std::cos(alpha.sun_planet) + std::cos(alpha.ring_planet)) / compliance_of(stage, alpha);
    const double mean = 600.0 / (row.planets * 32.17853e-3);
    const std::vector<double> forces = forces_of(stage);
    for (std::size_t i = 0; i < n; ++i) {
      const double part = 1.0 + 2.0 * std::cos(2.0 * std::numbers::pi * static_cast<double>(i) / row.planets);
      const double expected = mean + force * (part / row.planets - (i == 0 ? 1.0 : 0.0));
      EXPECT_NEAR(forces[i], expected, 1e-6 * mean) << row.planets << ' ' << i;
    }
    if (row.planets == 4) {
      EXPECT_NEAR(forces[0], forces[2], 1e-6 * mean);
      EXPECT_NEAR(forces[1] - forces[0], force / 2.0, 1e-6 * mean);
    }
    const auto [least, most] = std::minmax_element(forces.begin(), forces.end());
    EXPECT_NEAR(*least / mean, row.least, 5e-5) << row.planets;
    EXPECT_NEAR(*most / mean, row.most, 5e-5) << row.planets;
  }
}

/// Tooth thickness: both flanks' meshes of a planet with thinner teeth.
TEST(LoadSharing, ThinnerTeethOfAPlanetCarryLess) {
  gear::Stage stage = floating(4);
  const std::vector<double> half = {3.0, 0.0, 0.0, 0.0};
  stage.sun_planet_mesh.error_mean_um = stage.ring_planet_mesh.error_mean_um = half;
  expect_sharing(stage, {6.0, 0.0, 0.0, 0.0});
}

/// Planets whose bearings differ: a softer path carries less of what the carrier's rotation and the sun leave.
TEST(LoadSharing, OfUnlikeBearingsIsThatOfTheLeastEnergy) {
  gear::Stage stage = floating(5);
  const std::vector<double> bearings = {1e8, 0.4e8, 1.5e8, 0.8e8, 1.1e8};
  stage.planet.bearing_N_per_m = bearings;
  const gear::PressureAngles alpha = gear::pressure_angles(stage);
  // The forces that balance on the sun and the carrier with the least elastic energy: F_i = k_i (a + b cos + c sin).
  std::vector<double> k;
  for (const double bearing : bearings) {
    gear::Stage one = stage;
    one.planet.bearing_N_per_m = bearing;
    k.push_back(1.0 / compliance_of(one, alpha));
  }
  std::array<std::array<double, 4>, 3> rows{};
  for (std::size_t i = 0; i < 5; ++i) {
    const double phi = 2.0 * std::numbers::pi * static_cast<double>(i) / 5.0;
    const std::array<double, 3> basis = {1.0, std::cos(phi), std::sin(phi)};
    for (std::size_t r = 0; r < 3; ++r)
      for (std::size_t c = 0; c < 3; ++c) rows[r][c] += k[i] * basis[r] * basis[c];
  }
  rows[0][3] = 600.0 / 32.17853e-3;
  for (std::size_t r = 0; r < 3; ++r)
    for (std::size_t below = 0; below < 3; ++below) {
      if (below == r) continue;
      const double factor = rows[below][r] / rows[r][r];
      for (std::size_t c = 0; c < 4; ++c) rows[below][c] -= factor * rows[r][c];
    }
  const std::vector<double> forces = forces_of(stage);
  for (std::size_t i = 0; i < 5; ++i) {
    const double phi = 2.0 * std::numbers::pi * static_cast<double>(i) / 5.0;
    const double expected = k[i] * (rows[0][3] / rows[0][0] + rows[1][3] / rows[1][1] * std::cos(phi) +
                                    rows[2][3] / rows[2][2] * std::sin(phi));
    EXPECT_NEAR(forces[i], expected, 1e-6 * expected) << i;
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
