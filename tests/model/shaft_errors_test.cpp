// Errors that repeat with the rotation of a member: against the displacement of its centre, tooth by tooth, and in
// every mode of drive.

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "gear/kinematics.hpp"
#include "model/dynamic_model.hpp"
#include "model/parameters.hpp"
#include "model/right_hand_side.hpp"
#include "problems/r1.hpp"

namespace epicyclic::model::shaft_errors_test {
namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;
constexpr double radian = std::numbers::pi / 180.0;
constexpr double omega = 0.9;
constexpr std::size_t planets = 3;

/// Nothing else moves the teeth.
gear::Stage quiet(gear::Stage s) {
  s.sun_planet_mesh.error_amplitude_um = s.ring_planet_mesh.error_amplitude_um = {0.0};
  s.load = {std::nullopt, 600.0};
  return s;
}

gear::Stage mirrored(gear::Stage s) {
  s.load.torque_Nm = -600.0;
  return s;
}

gear::Stage backward(gear::Stage s) {
  s.driver = s.boundary == gear::Boundary::fixed_ring ? gear::Driver::carrier : gear::Driver::ring;
  return s;
}

MeshDeflections deflections_at_rest(const DynamicModel& m, double s) {
  MeshDeflections d;
  const std::vector<double> rest(m.dimension, 0.0);
  m.deflections(s, rest.data(), d);
  return d;
}

/// Deflections if centres are displaced: a state whose members stand at these places [um].
MeshDeflections displaced(const DynamicModel& plain, std::array<double, 2> sun,
                          const std::vector<std::array<double, 2>>& of, std::array<double, 2> ring) {
  std::vector<double> y(plain.dimension, 0.0);
  const auto b_c = [](double um) { return um * 1e-6 / length_scale_m; };
  y[Slots::x_s] = b_c(sun[0]), y[Slots::y_s] = b_c(sun[1]);
  for (std::size_t i = 0; i < planets; ++i) y[Slots::x_p(i)] = b_c(of[i][0]), y[Slots::y_p(i)] = b_c(of[i][1]);
  y[Slots::x_r(planets)] = b_c(ring[0]), y[Slots::y_r(planets)] = b_c(ring[1]);
  MeshDeflections d;
  plain.deflections(0.0, y.data(), d);
  return d;
}

/// The centre of the teeth turns about the axis with the member, as seen from the carrier.
TEST(ShaftErrors, AreTheDisplacementOfTheCentre) {
  const double e_s = 7.0, e_r = 4.0, psi_s = 33.0, psi_r = -70.0;
  const std::vector<double> e_p = {5.0, 3.0, 9.0};
  const std::vector<double> psi_p = {0.0, 100.0, 215.0};
  const gear::Stage fixed = problems::with_unequal_angles(quiet(problems::r1()));
  for (const gear::Stage& given : {fixed, mirrored(fixed), backward(fixed), mirrored(backward(fixed)),
                                   problems::star(fixed), backward(problems::star(fixed)), problems::fixed_sun(fixed),
                                   backward(problems::fixed_sun(fixed)), problems::differential(fixed)}) {
    gear::Stage stage = given;
    stage.sun.errors.eccentricity_um = e_s;
    stage.sun.errors.eccentricity_phase_deg = psi_s;
    stage.ring.errors.eccentricity_um = e_r;
    stage.ring.errors.eccentricity_phase_deg = psi_r;
    stage.planet.eccentricity_um = e_p;
    stage.planet.eccentricity_phase_deg = psi_p;
    ASSERT_EQ(stage.mesh_periods(), 2025);  // lcm(27, 25, 81)
    const DynamicModel m = make_dynamic_model(stage, scales_of(stage), omega, {});
    const DynamicModel plain = make_dynamic_model(given, scales_of(given), omega, {});
    EXPECT_EQ(m.period, 2025 * two_pi);
    const double mirror = *stage.load.torque_Nm < 0.0 ? -1.0 : 1.0;
    const double d = stage.runs_backward() ? -1.0 : 1.0;
    const std::vector<double> angles = stage.planet_angles_deg();
    for (const double s : {0.0, 1.3, 40.0, 9000.0}) {
      const auto at = [](double amount, double angle) {
        return std::array<double, 2>{amount * std::cos(angle), amount * std::sin(angle)};
      };
      // Along the torque on the sun: the sun runs ahead of the carrier, planets and ring fall behind.
      std::vector<std::array<double, 2>> of;
      for (std::size_t i = 0; i < planets; ++i)
        of.push_back(at(e_p[i], mirror * (angles[i] + psi_p[i]) * radian - d * s / 25.0));
      const MeshDeflections expected = displaced(plain, at(e_s, mirror * psi_s * radian + d * s / 27.0), of,
                                                 at(e_r, mirror * psi_r * radian - d * s / 81.0));
      const MeshDeflections seen = deflections_at_rest(m, s);
      for (std::size_t i = 0; i < planets; ++i) {
        EXPECT_NEAR(seen.sun_planet[i], expected.sun_planet[i], 1e-12) << s;
        EXPECT_NEAR(seen.ring_planet[i], expected.ring_planet[i], 1e-12) << s;
      }
    }
  }
}

TEST(ShaftErrors, RatesAreDerivatives) {
  gear::Stage stage = quiet(problems::r1());
  stage.sun.errors.eccentricity_um = 7.0;
  stage.sun.errors.pitch_error_um.emplace();
  for (int k = 0; k < 27; ++k) stage.sun.errors.pitch_error_um->push_back(std::sin(1.0 + k * k));
  const DynamicModel m = make_dynamic_model(stage, scales_of(stage), omega, {});
  constexpr double h = 1e-4;
  for (const double s : {0.4, 77.0}) {
    const double slope =
        (deflections_at_rest(m, s + h).sun_planet[1] - deflections_at_rest(m, s - h).sun_planet[1]) / (2 * h);
    EXPECT_NEAR(deflections_at_rest(m, s).sun_planet_rate[1], omega * slope, 1e-7);
  }
}

/// Each tooth brings its own error to each planet that it passes.
TEST(ShaftErrors, ToothByTooth) {
  for (const bool of_sun : {true, false})
    for (const bool runs_backward : {false, true}) {
      gear::Stage stage = quiet(problems::r1());
      if (runs_backward) stage = backward(stage);
      const int z = of_sun ? 27 : 81;
      std::vector<double> teeth;
      for (int k = 0; k < z; ++k) teeth.push_back(3.0 * std::sin(0.3 + 1.7 * k * k) + 1.0);
      (of_sun ? stage.sun : stage.ring).errors.pitch_error_um = teeth;
      const DynamicModel m = make_dynamic_model(stage, scales_of(stage), omega, {});
      ASSERT_EQ(m.mesh_periods, z);
      // The sun runs ahead of the carrier, so that earlier teeth come; the ring falls behind.
      const int direction = of_sun == runs_backward ? 1 : -1;
      for (int k = 0; k < 2 * z; ++k)
        for (std::size_t i = 0; i < planets; ++i) {
          const MeshDeflections d = deflections_at_rest(m, k * two_pi);
          const int tooth = ((direction * k + static_cast<int>(i) * z / 3) % z + z) % z;
          const double error = teeth[static_cast<std::size_t>(tooth)] * 1e-6 / length_scale_m;
          EXPECT_NEAR((of_sun ? d.sun_planet : d.ring_planet)[i], -error, 1e-11) << k << ' ' << i;
        }
    }
}

/// Each flank of a planet brings its own error when its contact begins, to each of its two meshes.
TEST(ShaftErrors, ToothByToothOfPlanets) {
  const int z = 25;
  for (const bool of_sun : {true, false})
    for (const bool each : {true, false})
      for (const bool runs_backward : {false, true}) {
        gear::Stage stage = quiet(problems::r1());
        if (runs_backward) stage = backward(stage);
        const std::size_t count = each ? planets * z : z;
        std::vector<double> teeth;
        for (std::size_t k = 0; k < count; ++k)
          teeth.push_back(3.0 * std::sin(0.3 + 1.7 * static_cast<double>(k * k)) + 1.0);
        (of_sun ? stage.planet.pitch_error_um : stage.planet.pitch_error_ring_um) = teeth;
        const DynamicModel m = make_dynamic_model(stage, scales_of(stage), omega, {});
        ASSERT_EQ(m.mesh_periods, z);
        ASSERT_EQ(m.shafts.size(), 1U);
        EXPECT_EQ(m.shafts[0].member, "planets");
        const double lead = of_sun ? 0.0 : stage.ring_mesh_lead_1;
        const int direction = runs_backward ? -1 : 1;
        for (int k = 1; k < 2 * z; ++k)
          for (std::size_t i = 0; i < planets; ++i) {
            // All planets of this stage mesh in phase: a contact begins at s = 2 pi (k - lead).
            const double cycles = lead - std::floor(lead);
            const MeshDeflections d = deflections_at_rest(m, (k - cycles) * two_pi);
            const int tooth = ((direction * k) % z + z) % z;
            const double error = teeth[static_cast<std::size_t>(tooth) + (each ? i * z : 0)] * 1e-6 / length_scale_m;
            EXPECT_NEAR((of_sun ? d.sun_planet : d.ring_planet)[i], -error, 1e-11) << k << ' ' << i;
            EXPECT_EQ((of_sun ? d.ring_planet : d.sun_planet)[i], 0.0);
          }
      }
}

TEST(ShaftErrors, RepeatWithTheCommonPeriod) {
  gear::Stage stage = problems::r1_nonlinear();
  stage.sun.errors.eccentricity_um = 7.0;
  stage.ring.errors.eccentricity_um = 2.0;
  const DynamicModel m = make_dynamic_model(stage, scales_of(stage), omega, {});
  const DynamicModel plain = make_dynamic_model(problems::r1_nonlinear(), scales_of(stage), omega, {});
  ASSERT_EQ(m.mesh_periods, 81);  // lcm(27, 81)
  EXPECT_EQ(m.breakpoints.size(), 81 * plain.breakpoints.size());
  std::vector<double> y(m.dimension);
  for (std::size_t i = 0; i < y.size(); ++i) y[i] = std::sin(1.0 + 3.0 * static_cast<double>(i));
  std::vector<double> a(m.dimension);
  std::vector<double> b(m.dimension);
  const auto at = [&](double s, std::vector<double>& out) {
    m.right_hand_side(segment_at(m.breakpoints, std::fmod(s, m.period)), s, y.data(), out.data());
  };
  at(0.7, a);
  at(0.7 + m.period, b);
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], 1e-9 * (1.0 + std::abs(a[i])));
  at(0.7 + two_pi, b);
  double apart = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) apart = std::max(apart, std::abs(a[i] - b[i]));
  EXPECT_GT(apart, 1e-5);
}

/// Pins of an eccentric circle stand as the same pins given one by one.
TEST(ShaftErrors, AnEccentricCarrierMovesItsPins) {
  for (const double torque : {600.0, -600.0}) {
    gear::Stage stage = problems::with_unequal_angles(quiet(problems::r1()));
    stage.load.torque_Nm = torque;
    gear::Stage pins = stage;
    stage.carrier.errors.eccentricity_um = 12.0;
    stage.carrier.errors.eccentricity_phase_deg = 50.0;
    std::vector<double> t, r;
    for (const double angle : stage.planet_angles_deg()) {
      // Of the vector 12 um at 50 deg: what is across and along the planet's radius.
      t.push_back(12.0 * std::sin((50.0 - angle) * radian));
      r.push_back(12.0 * std::cos((50.0 - angle) * radian));
    }
    pins.planet.pin_error_tangential_um = t;
    pins.planet.pin_error_radial_um = r;
    EXPECT_EQ(stage.mesh_periods(), 1);
    const auto p = make_parameters<planets>(stage, scales_of(stage), omega, {});
    const auto q = make_parameters<planets>(pins, scales_of(pins), omega, {});
    for (std::size_t i = 0; i < planets; ++i) {
      EXPECT_NEAR(p.sun_planet.error_mean[i], q.sun_planet.error_mean[i], 1e-14);
      EXPECT_NEAR(p.ring_planet.error_mean[i], q.ring_planet.error_mean[i], 1e-14);
    }
    // An eccentric carrier with a sun and a ring that follow it is no error.
    EXPECT_GT(std::abs(p.sun_planet.error_mean[0]), 1e-3);
  }
}

/// A quasi-static linear stage answers at the order of the shaft alone.
TEST(ShaftErrors, OfTheSunLeaveThreePlanetsSharingEvenly) {
  gear::Stage stage = quiet(problems::r1());
  stage.sun.support_N_per_m = 0.0;
  stage.sun.errors.eccentricity_um = 20.0;
  ModelOptions options;
  options.gyroscopic = Gyroscopic::off;
  const DynamicModel m = make_dynamic_model(stage, scales_of(stage), omega, options);
  const std::vector<double> phases = {0.0, 20.0, 50.0, 111.0};
  const auto states = m.quasi_static_states(phases);
  ASSERT_EQ(states.size(), phases.size());
  StageForces f;
  for (std::size_t k = 0; k < phases.size(); ++k) {
    m.forces(phases[k], states[k].data(), f);
    for (const double force : f.sun_planet_elastic) EXPECT_NEAR(force, m.static_mesh_force, 1e-6 * m.static_mesh_force);
    // The floating sun moves its axis so that its teeth stay centred.
    const double radius = std::hypot(states[k][Slots::x_s], states[k][Slots::y_s]);
    EXPECT_NEAR(radius, 2.0, 1e-5);
  }
}

TEST(ShaftErrors, RefusalsNameTheKey) {
  const auto refused = [](auto change, const char* key) {
    gear::Stage stage = problems::r1();
    change(stage);
    for (const std::string& line : gear::problems_for_dynamics(stage))
      if (line.starts_with(key)) return true;
    return false;
  };
  EXPECT_TRUE(refused([](auto& s) { s.sun.errors.pitch_error_um = {1.0, 2.0}; }, "/lumped/sun/pitch_error_um: "));
  EXPECT_TRUE(
      refused([](auto& s) { s.ring.errors.eccentricity_phase_deg = 3.0; }, "/lumped/ring/eccentricity_phase_deg: "));
  EXPECT_TRUE(refused([](auto& s) { s.planet.eccentricity_um = {1.0, 2.0}; }, "/lumped/planet/eccentricity_um: "));
  EXPECT_TRUE(refused([](auto& s) { s.planet.pitch_error_um = {1.0, 2.0}; }, "/lumped/planet/pitch_error_um: "));
  EXPECT_TRUE(refused(
      [](auto& s) {
        s.planet.pitch_error_ring_um = {1.0, 2.0};
      },
      "/lumped/planet/pitch_error_ring_um: "));
  EXPECT_TRUE(refused(
      [](auto& s) {
        s = problems::with_teeth(s, 29, 31, 91, 3);
        s.sun.errors.eccentricity_um = s.ring.errors.eccentricity_um = 1.0;
        s.planet.eccentricity_um = {1.0};
      },
      "/lumped: "));
  EXPECT_FALSE(refused([](auto& s) { s.sun.errors.eccentricity_um = 1.0; }, "/lumped"));
}

}  // namespace
}  // namespace epicyclic::model::shaft_errors_test
