#include "model/dynamic_model.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "core/errors.hpp"
#include "gear/kinematics.hpp"
#include "problems/r1.hpp"

namespace epicyclic::model::dynamic_model_test {
namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;

DynamicModel model_of(const gear::Stage& s, double omega = 0.9, CoordinateChoice choice = CoordinateChoice::relative) {
  return make_dynamic_model(s, scales_of(s), omega, {}, choice);
}

TEST(DynamicModel, DegreesOfFreedomAreThoseOfTheBoundary) {
  for (const auto& [stage, planets] :
       {std::pair{problems::r1(), 3U}, std::pair{problems::with_teeth(problems::r1(), 30, 24, 78, 4), 4U},
        std::pair{problems::with_teeth(problems::r1(), 27, 27, 81, 2), 2U},
        std::pair{problems::with_teeth(problems::r1(), 27, 27, 81, 6), 6U},
        std::pair{problems::with_teeth(problems::r1(), 24, 26, 76, 5), 5U}}) {
    EXPECT_EQ(model_of(stage).dimension, 2 * (3 * planets + 8));
    EXPECT_EQ(model_of(problems::rigid_ring(stage)).dimension, 2 * (3 * planets + 7));
    EXPECT_EQ(model_of(problems::as_printed(stage)).dimension, 2 * (3 * planets + 8));
    EXPECT_EQ(model_of(problems::star(stage)).dimension, 2 * (3 * planets + 8));
    const DynamicModel full = model_of(stage, 0.9, CoordinateChoice::full);
    EXPECT_EQ(full.dimension, 2 * (3 * planets + 9));
    EXPECT_EQ(full.state_names.size(), full.dimension);
    EXPECT_EQ(full.default_start.size(), full.dimension);
  }
}

TEST(DynamicModel, StateNamesStandAtTheirSlots) {
  const DynamicModel as_printed = model_of(problems::as_printed(problems::r1()));
  EXPECT_EQ(as_printed.state_names[2], "w_s");
  EXPECT_EQ(as_printed.state_names[Slots::w_p(2)], "w_p3");
  EXPECT_EQ(as_printed.state_names[Slots::u_c(Layout::relative_to_ring, 3)], "u_c");
  EXPECT_EQ(as_printed.state_names[17], "x_s_rate");
  const DynamicModel fixed = model_of(problems::r1());
  EXPECT_EQ(fixed.state_names[Slots::u_r(3)], "u_r");
  EXPECT_EQ(fixed.state_names[Slots::y_c(3)], "y_c");
  const DynamicModel full = model_of(problems::r1(), 0.9, CoordinateChoice::full);
  EXPECT_EQ(full.state_names[Slots::w_s], "u_s");
  EXPECT_EQ(full.state_names[Slots::u_c(Layout::full, 3)], "u_c");
}

TEST(DynamicModel, SevenPlanetsAreAnInputError) {
  gear::Stage s = problems::r1();
  s.planet_count = 7;
  EXPECT_THROW((void)model_of(s), InputError);
}

// ---- default start ----------------------------------------------------------------------------------------------

// Rounding times the condition of the stiffness matrix (some 1e3), in b_c.
constexpr double equilibrium = 1e-11;

/// R1 with radii in the exact ratio of the teeth: those of R1 have five decimals, and the loads balance to as many.
gear::Stage exact_r1() { return problems::with_teeth(problems::r1(), 27, 25, 81, 3); }

/// Shares of T_D / (N r_bs) that the meshes carry.
struct Shares {
  double sun_planet, ring_planet;
};

Shares shares(const gear::Stage& s) {
  if (s.boundary != gear::Boundary::as_printed) return {1.0, 1.0};
  // The train accelerates as one: mesh forces are shares of inertia.
  const double m_p = s.planet_count * s.planet.inertia_over_r2_kg;
  const double m_r = s.ring.inertia_over_r2_kg;
  const double all = s.sun.inertia_over_r2_kg + m_p + m_r;
  return {(m_p + m_r) / all, m_r / all};
}

TEST(DefaultStart, HasEachMeshAtTheGapPlusTheStaticDeflection) {
  for (const gear::Stage& base :
       {exact_r1(), problems::with_gap(exact_r1()),
        problems::with_friction(problems::with_moving_stiffness(problems::with_gap(exact_r1()))),
        problems::with_gap(problems::with_teeth(problems::r1(), 27, 27, 81, 6), 25.0)})
    for (const gear::Stage& s : {base, problems::as_printed(base), problems::star(base), problems::rigid_ring(base)})
      for (const CoordinateChoice choice : {CoordinateChoice::relative, CoordinateChoice::full}) {
        gear::Stage equal = s;
        for (gear::Mesh* mesh : {&equal.sun_planet_mesh, &equal.ring_planet_mesh}) mesh->error_amplitude_um = {0.0};
        if (s.boundary == gear::Boundary::as_printed && choice == CoordinateChoice::full) continue;  // no equilibrium
        if (!std::isfinite(s.ring.torsional_support_N_per_m) && choice == CoordinateChoice::full) continue;
        const Scales scales = scales_of(equal);
        const DynamicModel m = make_dynamic_model(equal, scales, 0.8, {}, choice);
        MeshDeflections d;
        m.deflections(0.0, m.default_start.data(), d);
        const double torque = gear::torques(equal, 0.8 * scales.omega_sn).sun;
        const double force = torque / (equal.planet_count * *equal.sun.base_radius_mm * 1e-3);
        const auto expected = [&](const gear::Mesh& mesh, double share) {
          return scales.displacement(mesh.backlash_half_um * 1e-6 + share * force / mesh.stiffness_N_per_m);
        };
        const Shares share = shares(equal);
        for (std::size_t i = 0; i < d.sun_planet.size(); ++i) {
          EXPECT_NEAR(d.sun_planet[i], expected(equal.sun_planet_mesh, share.sun_planet), equilibrium)
              << static_cast<int>(s.boundary);
          EXPECT_NEAR(d.ring_planet[i], expected(equal.ring_planet_mesh, share.ring_planet), equilibrium)
              << static_cast<int>(s.boundary);
        }
        for (std::size_t k = m.dimension / 2; k < m.dimension; ++k) EXPECT_EQ(m.default_start[k], 0.0);
      }
}

TEST(DefaultStart, LiteralMeshForcesAre88And59Percent) {
  // docs/theory/model.md, section 4, printed to the percent.
  constexpr double percent = 0.005;
  const Shares share = shares(problems::as_printed(problems::r1()));
  EXPECT_NEAR(share.sun_planet, 0.88, percent);
  EXPECT_NEAR(share.ring_planet, 0.59, percent);
}

TEST(DefaultStart, KeepsTheStaticDeflectionWithErrorsInPhase) {
  // E sin 0 = 0 on the sun's meshes; the ring meshes lead, so their error at s = 0 moves the members, not the loads.
  const gear::Stage s = problems::with_moving_stiffness(problems::with_gap(exact_r1()));
  const Scales scales = scales_of(s);
  const DynamicModel m = make_dynamic_model(s, scales, 0.8, {});
  MeshDeflections d;
  m.deflections(0.0, m.default_start.data(), d);
  const double force = gear::torques(s, 0.8 * scales.omega_sn).sun / (3.0 * *s.sun.base_radius_mm * 1e-3);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(d.sun_planet[i], 4.0 + scales.displacement(force / s.sun_planet_mesh.stiffness_N_per_m), equilibrium);
    EXPECT_NEAR(d.ring_planet[i], 4.0 + scales.displacement(force / s.ring_planet_mesh.stiffness_N_per_m), equilibrium);
  }
}

TEST(DefaultStart, IsTheEquilibriumOfTheLinearStageWithUnequalErrors) {
  gear::Stage s = problems::with_unequal_angles(problems::with_unequal_errors(problems::with_gap(exact_r1())));
  const Scales scales = scales_of(s);
  // With closed drive flanks and the frame terms off the accelerations differ from 0 by the damping of e' alone.
  for (gear::Mesh* mesh : {&s.sun_planet_mesh, &s.ring_planet_mesh}) mesh->damping_ratio = 0.0;
  s.load = {std::nullopt, 3000.0};  // keeps every mesh closed
  const DynamicModel m = make_dynamic_model(s, scales, 0.8, {GapDamping::always, Gyroscopic::off, 0.0});
  MeshDeflections d;
  m.deflections(0.0, m.default_start.data(), d);
  for (std::size_t i = 0; i < 3; ++i) {
    ASSERT_EQ(DynamicModel::contact(d.sun_planet[i], m.sun_planet_half_gap), Contact::drive);
    ASSERT_EQ(DynamicModel::contact(d.ring_planet[i], m.ring_planet_half_gap), Contact::drive);
  }
  std::vector<double> slope(m.dimension);
  m.right_hand_side(0, 0.0, m.default_start.data(), slope.data());
  for (const double x : slope) EXPECT_NEAR(x, 0.0, equilibrium);
}

TEST(DynamicModel, ContactNamesTheSideOfTheTeeth) {
  EXPECT_EQ(DynamicModel::contact(4.1, 4.0), Contact::drive);
  EXPECT_EQ(DynamicModel::contact(4.0, 4.0), Contact::loss);
  EXPECT_EQ(DynamicModel::contact(-4.0, 4.0), Contact::loss);
  EXPECT_EQ(DynamicModel::contact(-4.1, 4.0), Contact::back);
}

// ---- phases: turning by one planet ------------------------------------------------------------------------------

std::size_t segment_of(const DynamicModel& m, double s) {
  if (m.breakpoints.empty()) return 0;
  const double phase = s - two_pi * std::floor(s / two_pi);
  const auto next = std::upper_bound(m.breakpoints.begin(), m.breakpoints.end(), phase);
  const auto index = static_cast<std::size_t>(next - m.breakpoints.begin());
  return index == 0 ? m.breakpoints.size() - 1 : index - 1;
}

/// The same motion, each planet in the place of the next.
std::vector<double> turned(const DynamicModel& m, const std::vector<double>& y) {
  const auto n = static_cast<std::size_t>(m.planets);
  const double angle = two_pi / m.planets;
  const std::size_t dof = m.dimension / 2;
  std::vector<double> r = y;
  for (const std::size_t half : {std::size_t{0}, dof}) {
    const auto turn = [&](std::size_t x_from, std::size_t x_to) {
      const double x = y[half + x_from];
      const double y_old = y[half + x_from + 1];
      r[half + x_to] = x * std::cos(angle) - y_old * std::sin(angle);
      r[half + x_to + 1] = x * std::sin(angle) + y_old * std::cos(angle);
    };
    turn(Slots::x_s, Slots::x_s);
    turn(Slots::x_r(n), Slots::x_r(n));
    turn(Slots::x_c(n), Slots::x_c(n));
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t next = (i + 1) % n;
      turn(Slots::x_p(i), Slots::x_p(next));
      r[half + Slots::w_p(next)] = y[half + Slots::w_p(i)];
    }
  }
  return r;
}

TEST(Phases, TurningByOnePlanetIsAShiftOfTheMeshPhase) {
  const gear::Stage base = problems::with_friction(problems::with_moving_stiffness(problems::with_gap(problems::r1())));
  struct Case {
    const char* name;
    gear::Stage stage;
    bool in_phase;
  };
  const Case cases[] = {
      {"27/81, 3 planets", base, true},
      {"28/80, 3 planets", problems::with_teeth(base, 28, 26, 80, 3), false},
      {"30/78, 4 planets", problems::with_teeth(base, 30, 24, 78, 4), false},
      {"24/76, 5 planets", problems::with_teeth(base, 24, 26, 76, 5), false},
      {"27/81, 2 planets", problems::with_teeth(base, 27, 27, 81, 2), false},
      {"27/81, 6 planets", problems::with_teeth(base, 27, 27, 81, 6), false},
  };
  std::mt19937_64 random(61);
  std::uniform_real_distribution<double> component(-4.0, 4.0);
  // Roundings of phases of several turns times the slope of stiffness and moments.
  constexpr double rounding = 1e-12;
  constexpr double felt = 1e-3;  // far above rounding
  for (const Case& c : cases)
    for (const gear::Stage& stage : {c.stage, problems::as_printed(c.stage)}) {
      const DynamicModel m = model_of(stage);
      const double shift = two_pi * *stage.sun.teeth / stage.planet_count;
      EXPECT_EQ(std::abs(std::remainder(shift, two_pi)) < rounding, c.in_phase) << c.name;
      double unshifted = 0.0;
      for (int trial = 0; trial < 20; ++trial) {
        std::vector<double> y(m.dimension);
        for (double& x : y) x = component(random);
        const double s = 0.013 + 0.31 * trial;
        std::vector<double> f(m.dimension);
        std::vector<double> g(m.dimension);
        std::vector<double> h(m.dimension);
        m.right_hand_side(segment_of(m, s), s, y.data(), f.data());
        const std::vector<double> y_turned = turned(m, y);
        m.right_hand_side(segment_of(m, s + shift), s + shift, y_turned.data(), g.data());
        m.right_hand_side(segment_of(m, s), s, y_turned.data(), h.data());
        const std::vector<double> f_turned = turned(m, f);
        for (std::size_t k = 0; k < m.dimension; ++k) {
          EXPECT_NEAR(g[k], f_turned[k], rounding) << c.name << " component " << k;
          unshifted = std::max(unshifted, std::abs(h[k] - f_turned[k]));
        }
      }
      // Planets out of phase need the shift.
      if (!c.in_phase) {
        EXPECT_GT(unshifted, felt) << c.name;
      }
    }
}

TEST(Phases, Of28And80TeethAreTwoThirds) {
  // docs/theory/model.md, section 5: both meshes of planet 2 are 2/3 of a period on; Eq. (1) as printed gives 1/3 and
  // 2/3. Seen in the errors of planets 2 and 3 at rest.
  gear::Stage s = problems::with_teeth(problems::r1(), 28, 26, 80, 3);
  const DynamicModel m = model_of(s);
  const std::vector<double> rest(m.dimension, 0.0);
  constexpr double rounding = 1e-13;
  for (const double phase : {0.0, 0.4, 2.0}) {
    MeshDeflections d;
    m.deflections(phase, rest.data(), d);
    for (std::size_t i = 0; i < 3; ++i) {
      const double own = phase + two_pi * 2.0 / 3.0 * static_cast<double>(i);
      EXPECT_NEAR(d.sun_planet[i], -0.85 * std::sin(own), rounding);
      EXPECT_NEAR(d.ring_planet[i], -0.85 * std::sin(own), rounding);
    }
  }
}

TEST(Contacts, WhatHasNoGapIsNowhereMadeOrLost) {
  for (const gear::BearingLaw law : {gear::BearingLaw::linear_xy, gear::BearingLaw::linear_radial}) {
    gear::Stage stage = problems::r1_nonlinear();
    stage.sun_bearing.law = law;
    stage.sun_bearing.clearance_half_um = 0.0;
    const auto distances_of = [&] {
      const DynamicModel m = model_of(stage, 0.7, CoordinateChoice::relative);
      std::vector<double> y(m.dimension, -0.3);
      std::vector<double> distances(m.surfaces.count);
      std::vector<double> rates(m.surfaces.count);
      m.surfaces.evaluate(1.0, y.data(), distances.data(), rates.data());
      return distances;
    };
    const auto is_nowhere = [](double d) { return d == std::numeric_limits<double>::infinity(); };
    const std::vector<double> preloaded = distances_of();
    constexpr std::size_t of_meshes = 12;
    for (std::size_t k = 0; k < preloaded.size(); ++k) EXPECT_EQ(is_nowhere(preloaded[k]), k >= of_meshes) << k;
    stage.sun_planet_mesh.backlash_half_um = 0.0;
    stage.sun_bearing.clearance_half_um = 8.0;
    const std::vector<double> tight = distances_of();
    for (std::size_t k = 0; k < tight.size(); ++k) EXPECT_EQ(is_nowhere(tight[k]), k < of_meshes && k % 4 < 2) << k;
  }
}

TEST(Contacts, DistancesAreDeflectionsFromTheGapsAndTheirRates) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(-2.0, 2.0);
  for (const gear::BearingLaw law : {gear::BearingLaw::linear_xy, gear::BearingLaw::linear_radial})
    for (const auto& base : {problems::r1_nonlinear(), problems::as_printed(problems::r1_nonlinear()),
                             problems::rigid_ring(problems::r1_nonlinear())})
      for (const CoordinateChoice choice : {CoordinateChoice::relative, CoordinateChoice::full}) {
        gear::Stage stage = base;
        stage.sun_bearing.law = law;
        stage.sun_bearing.clearance_half_um = 8.0;
        const DynamicModel m = model_of(stage, 0.7, choice);
        const std::size_t n = static_cast<std::size_t>(m.planets);
        ASSERT_EQ(m.surfaces.count, 4 * n + (law == gear::BearingLaw::linear_xy ? 4 : 1));
        std::vector<double> y(m.dimension);
        for (double& x : y) x = any(random);
        const double s = 1.0 + any(random) / 4.0;
        std::vector<double> distances(m.surfaces.count);
        std::vector<double> rates(m.surfaces.count);
        m.surfaces.evaluate(s, y.data(), distances.data(), rates.data());
        MeshDeflections d;
        m.deflections(s, y.data(), d);
        constexpr double rounding = 1e-13;
        for (std::size_t i = 0; i < n; ++i) {
          EXPECT_NEAR(distances[4 * i], d.sun_planet[i] - m.sun_planet_half_gap, rounding);
          EXPECT_NEAR(distances[4 * i + 1], d.sun_planet[i] + m.sun_planet_half_gap, rounding);
          EXPECT_NEAR(distances[4 * i + 2], d.ring_planet[i] - m.ring_planet_half_gap, rounding);
          EXPECT_NEAR(distances[4 * i + 3], d.ring_planet[i] + m.ring_planet_half_gap, rounding);
          for (const std::size_t side : {0U, 1U}) {
            EXPECT_NEAR(rates[4 * i + side], d.sun_planet_rate[i] / m.omega, rounding);
            EXPECT_NEAR(rates[4 * i + 2 + side], d.ring_planet_rate[i] / m.omega, rounding);
          }
        }
        // Along the motion, by differences.
        const std::size_t segment = segment_at(m.breakpoints, s);
        std::vector<double> f(m.dimension);
        m.right_hand_side(segment, s, y.data(), f.data());
        constexpr double e = 1e-6;
        constexpr double differences = 1e-8;  // rounding of some ten operations over 2 e
        const auto beside = [&](double way) {
          std::vector<double> there(m.dimension);
          for (std::size_t k = 0; k < there.size(); ++k) there[k] = y[k] + way * f[k];
          std::vector<double> values(m.surfaces.count);
          std::vector<double> unused(m.surfaces.count);
          m.surfaces.evaluate(s + way, there.data(), values.data(), unused.data());
          return values;
        };
        const std::vector<double> after = beside(e);
        const std::vector<double> before = beside(-e);
        for (std::size_t k = 0; k < m.surfaces.count; ++k)
          EXPECT_NEAR((after[k] - before[k]) / (2.0 * e), rates[k], differences * (1.0 + std::abs(rates[k]))) << k;
        // The sun's bearing opens where its distances say so.
        const std::vector<double> bearing(distances.begin() + static_cast<std::ptrdiff_t>(4 * n), distances.end());
        const double b = bearing.size() == 4 ? (bearing[1] - bearing[0]) / 2.0 : std::hypot(y[0], y[1]) - bearing[0];
        EXPECT_GT(b, 0.0);
        StageForces forces;
        y[0] = b * (1.0 - 1e-9);
        y[1] = y[m.dimension / 2] = y[m.dimension / 2 + 1] = 0.0;
        m.forces(s, y.data(), forces);
        EXPECT_EQ(forces.sun_bearing, 0.0);
        y[0] = b * (1.0 + 1e-9);
        m.forces(s, y.data(), forces);
        EXPECT_GT(forces.sun_bearing, 0.0);
      }
}

TEST(Phases, BreakpointsAreRisingAndOnePerPieceOfEachMesh) {
  const gear::Stage base = problems::with_friction(problems::r1());
  for (const gear::Stage& s : {base, problems::with_moving_stiffness(base), problems::with_teeth(base, 28, 26, 80, 3),
                               problems::with_unequal_angles(base)}) {
    const DynamicModel m = model_of(s);
    EXPECT_FALSE(m.breakpoints.empty());
    EXPECT_TRUE(std::is_sorted(m.breakpoints.begin(), m.breakpoints.end()));
    EXPECT_GE(m.breakpoints.front(), 0.0);
    EXPECT_LT(m.breakpoints.back(), two_pi);
  }
  // In phase all planets jump together: 3 of the sun mesh; start and end of the double contact of the ring mesh, of
  // which the start is common.
  EXPECT_EQ(model_of(base).breakpoints.size(), 4U);
  EXPECT_TRUE(model_of(problems::r1()).breakpoints.empty());
}

TEST(DynamicModel, RightHandSideJumpsOnlyAtBreakpoints) {
  const gear::Stage s = problems::with_unequal_angles(problems::r1_nonlinear());
  const DynamicModel m = model_of(s);
  std::vector<double> y = m.default_start;
  std::vector<double> left(m.dimension);
  std::vector<double> right(m.dimension);
  double smallest_jump = 1e300;
  for (std::size_t k = 0; k < m.breakpoints.size(); ++k) {
    const std::size_t before = k == 0 ? m.breakpoints.size() - 1 : k - 1;
    m.right_hand_side(before, m.breakpoints[k], y.data(), left.data());
    m.right_hand_side(k, m.breakpoints[k], y.data(), right.data());
    double jump = 0.0;
    for (std::size_t j = 0; j < m.dimension; ++j) jump = std::max(jump, std::abs(right[j] - left[j]));
    smallest_jump = std::min(smallest_jump, jump);
  }
  // Each declared breakpoint is one: friction changes by some mu F.
  constexpr double step = 1e-7;
  EXPECT_GT(smallest_jump, 100 * step);
  // Inside a segment it is continuous: a step moves it by no more than that.
  for (double phase = 0.05; phase < 6.2; phase += 0.1) {
    const std::size_t segment = segment_of(m, phase);
    if (segment_of(m, phase + step) != segment) continue;
    m.right_hand_side(segment, phase, y.data(), left.data());
    m.right_hand_side(segment, phase + step, y.data(), right.data());
    for (std::size_t j = 0; j < m.dimension; ++j) EXPECT_NEAR(left[j], right[j], 100 * step);
  }
}

}  // namespace
}  // namespace epicyclic::model::dynamic_model_test
