// Who drives: the stage that runs backward, and the one whose other flanks are loaded, against the stage driven by its
// sun.

#include <cmath>
#include <cstddef>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/largest_difference.hpp"
#include "gear/gear_set.hpp"
#include "model/dynamic_model.hpp"
#include "model/parameters.hpp"
#include "problems/r1.hpp"
#include "problems/table1.hpp"

namespace epicyclic::model::drive_test {
namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;
constexpr double omega = 0.9;

gear::Stage driven_by(gear::Stage stage, gear::Driver driver) {
  stage.driver = driver;
  return stage;
}

/// Driven by the member that is driven otherwise.
gear::Stage backward(const gear::Stage& stage) {
  return driven_by(stage, stage.boundary == gear::Boundary::star ? gear::Driver::ring : gear::Driver::carrier);
}

/// Nothing that dissipates.
gear::Stage conservative(gear::Stage stage) {
  for (gear::Mesh* mesh : {&stage.sun_planet_mesh, &stage.ring_planet_mesh}) {
    mesh->damping_ratio = 0.0;
    mesh->friction = {};
    mesh->error_phase_deg = {20.0, 70.0, 110.0};
  }
  for (gear::SupportDamping* damping :
       {&stage.sun.damping, &stage.ring.damping, &stage.carrier.damping, &stage.planet.damping})
    *damping = {0.0, std::nullopt};
  return stage;
}

DynamicModel model_of(const gear::Stage& stage) { return make_dynamic_model(stage, scales_of(stage), omega, {}); }

/// Without dissipation, the equations of a stage that runs backward are those of time that runs backward.
TEST(Drive, BackwardIsTimeThatRunsBackward) {
  const gear::Stage fixed = problems::with_gap(problems::with_unequal_errors(problems::r1()));
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> component(-6.0, 6.0);
  std::uniform_real_distribution<double> phase(0.0, two_pi);
  for (const gear::Stage& given :
       {problems::with_moving_stiffness(fixed), problems::with_stiffness_curve(fixed), problems::rigid_ring(fixed),
        problems::with_error_curve(problems::with_stiffness_curve(fixed)),
        problems::with_moving_stiffness(problems::with_unequal_angles(fixed)),
        problems::with_moving_stiffness(problems::star(fixed))}) {
    gear::Stage stage = conservative(given);
    stage.ring_mesh_lead_1 = 0.31;
    const DynamicModel forward_model = model_of(stage);
    const DynamicModel backward_model = model_of(backward(stage));
    const std::size_t n = forward_model.dimension / 2;
    for (int k = 0; k < 40; ++k) {
      const double s = phase(random);
      std::vector<double> y(2 * n);
      for (double& x : y) x = component(random);
      std::vector<double> reversed = y;
      for (std::size_t i = n; i < 2 * n; ++i) reversed[i] = -reversed[i];
      std::vector<double> of_backward(2 * n);
      std::vector<double> of_forward(2 * n);
      std::vector<double> of_sun(2 * n);
      const double mirrored = two_pi - s;
      backward_model.right_hand_side(segment_at(backward_model.breakpoints, s), s, y.data(), of_backward.data());
      forward_model.right_hand_side(segment_at(forward_model.breakpoints, mirrored), mirrored, reversed.data(),
                                    of_forward.data());
      // It is not the stage that its sun drives.
      forward_model.right_hand_side(segment_at(forward_model.breakpoints, s), s, y.data(), of_sun.data());
      EXPECT_GT(largest_difference(of_backward, of_sun), 1e-6);
      for (std::size_t i = n; i < 2 * n; ++i)
        EXPECT_NEAR(of_backward[i], of_forward[i], 1e-12 * (1.0 + std::abs(of_forward[i]))) << stage.name << ' ' << i;
    }
  }
}

/// The other flanks are those of the mirror image, in which planets stand at the opposite angles.
TEST(Drive, NegativeTorqueIsTheMirrorImage) {
  for (const bool is_backward : {false, true}) {
    gear::Stage stage = problems::with_unequal_angles(problems::r1_nonlinear());
    if (is_backward) stage = backward(stage);
    stage.load = {std::nullopt, 400.0};
    gear::Stage mirrored = stage;
    mirrored.angles_deg = stage.planet_angles_deg();
    for (double& angle : mirrored.angles_deg) angle = -angle;
    mirrored.load.torque_Nm = -400.0;
    const auto p = make_parameters<3>(stage, scales_of(stage), omega, {});
    const auto q = make_parameters<3>(mirrored, scales_of(mirrored), omega, {});
    EXPECT_EQ(constant_values(p), constant_values(q));
    EXPECT_EQ(p.breakpoints, q.breakpoints);
    // Unequal angles as they are given make another stage of it.
    mirrored.angles_deg = stage.angles_deg;
    EXPECT_NE(constant_values(p), constant_values(make_parameters<3>(mirrored, scales_of(mirrored), omega, {})));
  }
}

/// Friction takes power from the nominal rotation: in the frame of the carrier base circles move with one speed V, sun
/// forward, planet and ring backward, and the power is V F (B_1 / r_b1 - B_2 / r_b2).
void expect_losses(const gear::Stage& stage) {
  const auto p = make_parameters<3>(stage, scales_of(stage), omega, {});
  const double direction = stage.runs_backward() ? -1.0 : 1.0;
  double largest = 0.0;
  for (const auto* mesh : {&p.sun_planet, &p.ring_planet})
    for (int k = 0; k < 400; ++k) {
      const double x = (k + 0.5) / 400.0;
      const auto f = mesh->friction->at(mesh->friction->place(x), x);
      const double power = direction * (f.moment_driving - f.moment_driven);
      EXPECT_LE(power, 1e-15) << x;
      largest = std::max(largest, -power);
    }
  EXPECT_GT(largest, 1e-4);
}

gear::Stage lubricated() {
  const gear::GearSet set = gear::make_gear_set(problems::table1());
  gear::Stage stage = problems::with_gap(problems::r1());
  stage.sun_planet_mesh.friction.ehl = gear::ehl_of(set.sun_planet, {5, 0.6, 1e-6});
  stage.ring_planet_mesh.friction.ehl = gear::ehl_of(set.ring_planet, {5, 0.6, 1e-6});
  return stage;
}

TEST(Drive, FrictionTakesPowerInEitherDirection) {
  for (const gear::Stage& stage : {problems::with_friction(problems::r1()), lubricated()}) {
    expect_losses(stage);
    expect_losses(backward(stage));
    expect_losses(backward(problems::star(stage)));
  }
}

TEST(Drive, TablesRunBackward) {
  for (const gear::Stage& stage : {problems::with_friction(problems::r1()), lubricated()}) {
    const auto p = make_parameters<3>(stage, scales_of(stage), omega, {});
    const auto q = make_parameters<3>(backward(stage), scales_of(stage), omega, {});
    // Grids of one are those of the other, so that rows of derivatives are the same.
    const auto again = make_parameters<3>(backward(stage), scales_of(stage), omega, {}, &q);
    for (const auto mesh : {&Parameters<double, 3>::sun_planet, &Parameters<double, 3>::ring_planet})
      for (int k = 0; k < 300; ++k) {
        const double x = (k + 0.37) / 300.0;
        const auto at = [](const auto& parameters, double phase) {
          return parameters.friction->at(parameters.friction->place(phase), phase);
        };
        const auto a = at(p.*mesh, x);
        const auto b = at(q.*mesh, 1.0 - x);
        const auto c = at(again.*mesh, 1.0 - x);
        EXPECT_NEAR(a.force, -b.force, 1e-12) << x;
        EXPECT_NEAR(a.moment_driving, -b.moment_driving, 1e-12) << x;
        EXPECT_NEAR(a.moment_driven, -b.moment_driven, 1e-12) << x;
        EXPECT_EQ(b.force, c.force);
      }
  }
}

TEST(Drive, AMemberThatIsHeldDoesNotDrive) {
  const auto refused = [](const gear::Stage& stage) {
    for (const std::string& problem : gear::problems_for_dynamics(stage))
      if (problem.starts_with("/driver: ")) return true;
    return false;
  };
  using enum gear::Driver;
  const gear::Stage fixed = problems::r1();
  const gear::Stage star = problems::star(fixed);
  EXPECT_FALSE(refused(driven_by(fixed, sun)));
  EXPECT_FALSE(refused(driven_by(fixed, carrier)));
  EXPECT_TRUE(refused(driven_by(fixed, ring)));
  EXPECT_FALSE(refused(driven_by(star, ring)));
  EXPECT_TRUE(refused(driven_by(star, carrier)));
  EXPECT_TRUE(refused(driven_by(problems::as_printed(fixed), carrier)));
}

}  // namespace
}  // namespace epicyclic::model::drive_test
