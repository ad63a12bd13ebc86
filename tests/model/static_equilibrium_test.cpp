// The quasi-static solution of stages, against balances of forces and of what bodies do without speed.

#include "model/static_equilibrium.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "model/dynamic_model.hpp"
#include "problems/r1.hpp"

namespace epicyclic::model::static_equilibrium_test {
namespace {

constexpr double solved = 1e-6;  // of an equilibrium, whose accelerations fall to 1e-7 of the load's
constexpr double digits = 1e-6;  // of R1's radii, whose ratio is that of the teeth to 2e-7

std::vector<double> phases() {
  std::vector<double> s;
  for (int k = 1; k <= 40; ++k) s.push_back(2.0 * std::numbers::pi * k / 40.0);
  return s;
}

DynamicModel model_of(const gear::Stage& stage, const ModelOptions& options = {}) {
  return make_dynamic_model(stage, scales_of(stage), 0.9, options);
}

gear::Stage loaded(gear::Stage stage) {
  stage.load = {};
  stage.load.torque_Nm = 900.0;
  return stage;
}

/// Supports and bearings so stiff that planets cannot give way to each other.
gear::Stage stiffly_held(gear::Stage stage) {
  for (double* support : {&stage.sun.support_N_per_m, &stage.ring.support_N_per_m, &stage.carrier.support_N_per_m})
    *support = 1e10;
  stage.planet.bearing_N_per_m = 1e10;
  return stage;
}

/// A stage of each boundary, with all that is nonlinear but friction.
std::vector<gear::Stage> frictionless() {
  using namespace problems;
  const gear::Stage moving = loaded(with_unequal_errors(with_moving_stiffness(with_gap(r1()))));
  gear::Stage floating = moving;
  floating.sun.support_N_per_m = 0.0;
  gear::Stage slack = moving;
  slack.sun_bearing.clearance_half_um = 30.0;
  return {moving,
          floating,
          slack,
          rigid_ring(moving),
          star(moving),
          with_stiffness_curve(moving),
          with_error_curve(moving),
          with_unequal_angles(moving)};
}

TEST(QuasiStatic, BalancesTheTorqueOfSunAndPlanets) {
  // Without friction a planet at rest takes from the ring what the sun gives it, and the sun's torque is on N meshes.
  for (const gear::Stage& stage : frictionless())
    for (const double width : {0.0, 0.05}) {
      const DynamicModel m = model_of(stage, {GapDamping::always, Gyroscopic::automatic, width});
      const std::vector<double> at = phases();
      const auto states = m.quasi_static_states(at);
      ASSERT_EQ(states.size(), at.size());
      StageForces f;
      for (std::size_t k = 0; k < at.size(); ++k) {
        m.forces(at[k], states[k].data(), f);
        double sum = 0.0;
        for (std::size_t i = 0; i < f.sun_planet.size(); ++i) {
          EXPECT_NEAR(f.sun_planet_elastic[i], f.ring_planet_elastic[i], digits * m.static_mesh_force) << k;
          sum += f.sun_planet_elastic[i];
        }
        EXPECT_NEAR(sum / (3.0 * m.static_mesh_force), 1.0, digits) << k;
      }
    }
}

TEST(QuasiStatic, IsAtRestWithFriction) {
  // The field itself, without frame terms, and with errors that do not move: nothing accelerates.
  using namespace problems;
  gear::Stage stage = loaded(with_friction(with_moving_stiffness(with_gap(r1()))));
  for (gear::Mesh* mesh : {&stage.sun_planet_mesh, &stage.ring_planet_mesh}) mesh->error_amplitude_um = {0.0};
  for (const gear::Stage& one : {stage, as_printed(stage), star(stage), with_unequal_angles(stage)}) {
    const DynamicModel m = model_of(one, {GapDamping::always, Gyroscopic::off, 0.0});
    const std::vector<double> at = phases();
    const auto states = m.quasi_static_states(at);
    ASSERT_EQ(states.size(), at.size());
    std::vector<double> slope(m.dimension);
    m.right_hand_side(segment_at(m.breakpoints, 0.0), 0.0, std::vector<double>(m.dimension, 0.0).data(), slope.data());
    const double load = *std::ranges::max_element(slope);
    for (std::size_t k = 0; k < at.size(); ++k) {
      m.right_hand_side(segment_at(m.breakpoints, at[k]), at[k], states[k].data(), slope.data());
      for (const double x : slope) EXPECT_NEAR(x / load, 0.0, solved) << k;
    }
  }
}

TEST(QuasiStatic, IsFoundWherePlanetsAreOutOfContact) {
  // Errors of ten times the static deflection, with phases drawn anew: most of the load is on one planet or two.
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> turn(0.0, 360.0);
  gear::Stage stage = stiffly_held(loaded(problems::with_moving_stiffness(problems::with_gap(problems::r1()))));
  int out_of_contact = 0;
  for (int trial = 0; trial < 60; ++trial) {
    for (gear::Mesh* mesh : {&stage.sun_planet_mesh, &stage.ring_planet_mesh}) {
      mesh->error_amplitude_um = {60.0, 50.0, 70.0};
      mesh->error_phase_deg = {turn(random), turn(random), turn(random)};
    }
    stage.sun.support_N_per_m = trial % 2 == 0 ? 1e10 : 0.0;
    stage.sun_bearing.clearance_half_um = trial % 3 == 0 ? 20.0 : 0.0;
    const DynamicModel m = model_of(stage);
    const std::vector<double> at = phases();
    const auto states = m.quasi_static_states(at);
    ASSERT_EQ(states.size(), at.size()) << trial;
    StageForces f;
    for (std::size_t k = 0; k < at.size(); ++k) {
      m.forces(at[k], states[k].data(), f);
      double sum = 0.0;
      for (const double force : f.sun_planet_elastic) {
        sum += force;
        out_of_contact += force == 0.0 ? 1 : 0;
      }
      EXPECT_NEAR(sum / (3.0 * m.static_mesh_force), 1.0, digits) << trial << ' ' << k;
    }
  }
  EXPECT_GT(out_of_contact, 100);
}

}  // namespace
}  // namespace epicyclic::model::static_equilibrium_test
