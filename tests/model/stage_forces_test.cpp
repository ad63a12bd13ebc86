// Forces and the symmetry of a stage, as a model tells them.

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "core/largest_difference.hpp"
#include "model/dynamic_model.hpp"
#include "problems/r1.hpp"

namespace epicyclic::model::stage_forces_test {
namespace {

constexpr double rounding = 1e-14;      // of some ten operations
constexpr double of_the_start = 5e-12;  // rounding of the equilibrium, which is solved for

DynamicModel model_of(const gear::Stage& stage, double ratio = 0.9) {
  return make_dynamic_model(stage, scales_of(stage), ratio, {});
}

gear::Stage r1_without_errors() {
  gear::Stage stage = problems::with_gap(problems::r1());
  stage.sun_planet_mesh.error_amplitude_um = stage.ring_planet_mesh.error_amplitude_um = {0.0};
  return stage;
}

/// What both meshes load a planet of R1 with, each with the force f.
struct PlanetLoad {
  double tangential, radial;
};
PlanetLoad load_of_r1(double f) {
  const double alpha_sp = std::acos((32.17853 + 29.79493) / 71.72084);
  const double alpha_rp = std::acos((96.53557 - 29.79493) / 71.72084);
  return {f * (std::cos(alpha_sp) + std::cos(alpha_rp)), f * (std::sin(alpha_sp) - std::sin(alpha_rp))};
}

TEST(StageForces, AtRestAreTheStaticOnes) {
  // Fixed ring, no error, no friction: each mesh carries T_D / (N r_bs), the planet's bearing both tangential parts.
  const gear::Stage stage = r1_without_errors();
  ModelOptions options;
  options.gyroscopic = Gyroscopic::off;
  const Scales scales = scales_of(stage);
  const DynamicModel m = make_dynamic_model(stage, scales, 1.0, options);
  StageForces f;
  m.forces(0.0, m.default_start.data(), f);
  const double f_0 = m.static_mesh_force;
  // omega_s = omega_m / z_s (1 + z_s / z_r) with the ring fixed; 400 kW.
  const double omega_s = scales.omega_sn / 27.0 * (1.0 + 27.0 / 81.0);
  EXPECT_NEAR(scales.force_newton(f_0), 400e3 / omega_s / (3.0 * 32.17853e-3), rounding * scales.force_newton(f_0));
  const PlanetLoad load = load_of_r1(f_0);
  constexpr double digits = 1e-6;  // of R1's radii, whose ratio is that of the teeth to 2e-7
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(f.sun_planet[i] / f_0, 1.0, digits);
    EXPECT_NEAR(f.ring_planet[i] / f_0, 1.0, digits);
    EXPECT_NEAR(f.planet_bearing[i] / std::hypot(load.tangential, load.radial), 1.0, digits);
  }
  EXPECT_NEAR(f.sun_bearing / f_0, 0.0, of_the_start);
}

TEST(StageForces, CentrifugalForceLoadsPlanetBearingsAlone) {
  const gear::Stage stage = r1_without_errors();
  ModelOptions options;
  options.gyroscopic = Gyroscopic::off;
  const Scales scales = scales_of(stage);
  const DynamicModel without = make_dynamic_model(stage, scales, 1.0, options);
  options.centrifugal = Centrifugal::included;
  const DynamicModel with = make_dynamic_model(stage, scales, 1.0, options);
  StageForces f;
  with.forces(0.0, with.default_start.data(), f);
  StageForces f_without;
  without.forces(0.0, without.default_start.data(), f_without);
  const double f_0 = with.static_mesh_force;
  // omega_c = omega_m / z_r; both mesh forces pull the planet along the tangent, what is left of them along the radius.
  const double omega_c = scales.omega_sn / 81.0;
  const double centrifugal = stage.planet.mass_kg * omega_c * omega_c * 71.72084e-3 / scales.force_newton(1.0);
  EXPECT_NEAR(scales.force_newton(centrifugal), gear::planet_centrifugal_force(stage, scales.omega_sn),
              1e-7 * scales.force_newton(centrifugal));
  EXPECT_GT(centrifugal, f_0);
  const PlanetLoad load = load_of_r1(f_0);
  constexpr double digits = 1e-6;  // of R1's radii
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(f.sun_planet[i] / f_without.sun_planet[i], 1.0, of_the_start * centrifugal / f_0) << i;
    EXPECT_NEAR(f.ring_planet[i] / f_without.ring_planet[i], 1.0, of_the_start * centrifugal / f_0) << i;
    EXPECT_NEAR(f.planet_bearing[i] / std::hypot(load.tangential, load.radial + centrifugal), 1.0, digits) << i;
  }
  // A star's carrier stands still.
  const gear::Stage star = problems::star(stage);
  EXPECT_EQ(make_dynamic_model(star, scales_of(star), 1.0, options).default_start,
            make_dynamic_model(star, scales_of(star), 1.0, {GapDamping::always, Gyroscopic::off, 0.0}).default_start);
}

TEST(Pulls, AreTheTensionOfTheForces) {
  // Teeth that lie on each other press; in the open gap and before they part, damping may pull.
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> component(-6.0, 6.0);  // on all three sides of the gaps
  const gear::Stage harmonics = problems::r1_nonlinear();
  const gear::Stage curve = problems::with_stiffness_curve(harmonics);
  long pulling = 0;
  long in_contact = 0;
  long on_the_back = 0;
  long meshes = 0;
  for (const gear::Stage& stage : {harmonics, curve})
    for (const GapDamping damping : {GapDamping::always, GapDamping::contact_slope})
      for (const double width : {0.0, 0.3}) {
        const DynamicModel m =
            make_dynamic_model(stage, scales_of(stage), 0.9, {damping, Gyroscopic::automatic, width});
        MeshDeflections d;
        StageForces f;
        std::vector<double> y(m.dimension);
        for (int trial = 0; trial < 400; ++trial) {
          for (double& x : y) x = component(random);
          const double s = 2.0 * std::numbers::pi * trial / 400.0;
          m.deflections(s, y.data(), d);
          m.forces(s, y.data(), f);
          const auto check = [&](const std::vector<double>& delta, const std::vector<double>& force, double gap,
                                 const std::vector<double>& elastic) {
            ASSERT_EQ(elastic.size(), 3U);
            for (std::size_t i = 0; i < elastic.size(); ++i) {
              const double told = tensile_force(delta[i], gap, elastic[i], force[i]);
              const bool back = delta[i] < -gap;
              const double tension = std::max(0.0, back ? force[i] : -force[i]);
              // A smoothed clearance has some of the other flank's force in the gap, which is none.
              if (width == 0.0 || std::abs(delta[i]) > gap) {
                EXPECT_NEAR(told, tension, rounding * (1.0 + std::abs(force[i])));
              } else {
                EXPECT_LE(told, tension + rounding * (1.0 + std::abs(force[i])));
              }
              ++meshes;
              if (!(tension > 0.0)) continue;
              ++pulling;
              if (delta[i] > gap) ++in_contact;
              if (back) ++on_the_back;
              // With damping in contact only and the exact clearance an open gap is without force.
              if (damping == GapDamping::contact_slope && width == 0.0) {
                EXPECT_GE(std::abs(delta[i]), gap);
              }
            }
          };
          check(d.sun_planet, f.sun_planet, m.sun_planet_half_gap, f.sun_planet_elastic);
          check(d.ring_planet, f.ring_planet, m.ring_planet_half_gap, f.ring_planet_elastic);
        }
      }
  EXPECT_GT(pulling, meshes / 20);
  EXPECT_LT(pulling, meshes / 2);
  EXPECT_GT(in_contact, 0);
  EXPECT_GT(on_the_back, 0);
}

TEST(RemoveSynchronous, IsThereForPlanetsThatAreAlike) {
  EXPECT_TRUE(model_of(problems::r1()).remove_synchronous);
  EXPECT_TRUE(model_of(problems::as_printed(problems::with_moving_stiffness(problems::r1()))).remove_synchronous);
  gear::Stage unequal = problems::r1();
  unequal.sun_planet_mesh.error_amplitude_um = {8.5, 8.5, 8.6};
  EXPECT_FALSE(model_of(unequal).remove_synchronous);
  EXPECT_FALSE(model_of(problems::with_unequal_angles(problems::r1())).remove_synchronous);
  gear::Stage four = problems::r1();  // 27 / 4 is not whole: the planets mesh one after the other
  four.planet_count = 4;
  EXPECT_FALSE(model_of(four).remove_synchronous);
}

TEST(RemoveSynchronous, SplitsWhatTheLinearisedFlowKeepsApart) {
  // About a synchronous state the Jacobian maps synchronous deviations to such, and the others to others.
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> component(-1.0, 1.0);
  for (const gear::Stage& stage : {problems::with_friction(problems::with_gap(problems::r1())),
                                   problems::as_printed(problems::with_moving_stiffness(problems::r1()))}) {
    const DynamicModel m = model_of(stage);
    const std::size_t n = m.dimension;
    const auto transverse_part = [&](std::vector<double> v) {
      m.remove_synchronous(v);
      return v;
    };
    std::vector<double> y = m.default_start;
    std::vector<double> v(n);
    std::vector<double> w(n);
    for (std::size_t i = 0; i < n; ++i) {
      v[i] = component(random);
      w[i] = component(random);
    }
    // The default start is synchronous, and so is what is taken away from w.
    const std::vector<double> off = transverse_part(y);
    EXPECT_LT(largest_difference(off, std::vector<double>(n, 0.0)), of_the_start);
    v = transverse_part(v);
    EXPECT_LT(largest_difference(transverse_part(v), v), rounding);
    const std::vector<double> rest = transverse_part(w);
    for (std::size_t i = 0; i < n; ++i) w[i] -= rest[i];
    std::vector<double> f(n);
    std::vector<double> jv(n);
    std::vector<double> jw(n);
    const std::size_t segment = m.breakpoints.empty() ? 0 : m.breakpoints.size() - 1;
    m.tangents(segment, 0.01, y.data(), {v.data(), 1, n}, f.data(), {jv.data(), 1, n});
    m.tangents(segment, 0.01, y.data(), {w.data(), 1, n}, f.data(), {jw.data(), 1, n});
    double size = 0.0;
    for (const double x : jv) size = std::max(size, std::abs(x));
    constexpr double of_the_jacobian = 1e-13;  // rounding of some 100 operations a row
    EXPECT_LT(largest_difference(transverse_part(jv), jv), of_the_jacobian * size);
    const std::vector<double> leaked = transverse_part(jw);
    const std::vector<double> nothing(n, 0.0);
    EXPECT_LT(largest_difference(leaked, nothing), of_the_jacobian * size);
    EXPECT_GT(largest_difference(jw, nothing), 1e10 * of_the_jacobian);
  }
}

}  // namespace
}  // namespace epicyclic::model::stage_forces_test
