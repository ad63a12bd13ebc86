// The model with a stiffness curve in place of harmonics.

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "model/dynamic_model.hpp"
#include "model/lane_field.hpp"
#include "problems/r1.hpp"

namespace epicyclic::model::stiffness_curve_motion_test {
namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;

/// R1 with two harmonics on both meshes and teeth with unequal phases of the planets.
gear::Stage with_harmonics() {
  gear::Stage s = problems::with_teeth(problems::r1(), 28, 26, 80, 3);
  s.ring_mesh_lead_1 = 0.3;
  for (gear::Mesh* mesh : {&s.sun_planet_mesh, &s.ring_planet_mesh}) {
    mesh->stiffness_cos_N_per_m = {1.6e8, 0.7e8};
    mesh->stiffness_sin_N_per_m = {1.3e8, 2.2e8};
  }
  return s;
}

/// The same stiffness as a table of `rows` rows a period.
gear::Stage tabulated(gear::Stage s, int rows) {
  for (gear::Mesh* mesh : {&s.sun_planet_mesh, &s.ring_planet_mesh}) {
    gear::StiffnessCurve curve;
    for (int k = 0; k < rows; ++k) {
      const double phase = static_cast<double>(k) / rows;
      double stiffness = mesh->stiffness_N_per_m;
      for (std::size_t h = 0; h < 2; ++h) {
        const double angle = two_pi * static_cast<double>(h + 1) * phase;
        stiffness +=
            mesh->stiffness_cos_N_per_m[h] * std::cos(angle) + mesh->stiffness_sin_N_per_m[h] * std::sin(angle);
      }
      curve.phase.push_back(phase);
      curve.stiffness_N_per_m.push_back(stiffness);
    }
    mesh->stiffness_curve = curve;
    mesh->stiffness_cos_N_per_m.clear();
    mesh->stiffness_sin_N_per_m.clear();
  }
  return s;
}

DynamicModel model_of(const gear::Stage& s) { return make_dynamic_model(s, scales_of(s), 0.9, {}); }

/// Greatest difference of the two right-hand sides over a period, relative to the greatest entry.
double difference(const DynamicModel& a, const DynamicModel& b) {
  const std::vector<double> y = a.default_start;
  std::vector<double> of_a(a.dimension);
  std::vector<double> of_b(b.dimension);
  double most = 0.0;
  double size = 0.0;
  for (int k = 0; k < 997; ++k) {
    const double s = two_pi * k / 997.0;
    a.right_hand_side(0, s, y.data(), of_a.data());
    b.right_hand_side(0, s, y.data(), of_b.data());
    for (std::size_t i = 0; i < a.dimension; ++i) {
      most = std::max(most, std::abs(of_a[i] - of_b[i]));
      size = std::max(size, std::abs(of_a[i]));
    }
  }
  return most / size;
}

TEST(StiffnessCurve, OfASmoothSeriesIsTheSeries) {
  const gear::Stage s = with_harmonics();
  ASSERT_TRUE(gear::problems_for_dynamics(s).empty());
  ASSERT_TRUE(gear::problems_for_dynamics(tabulated(s, 256)).empty());
  const double coarse = difference(model_of(s), model_of(tabulated(s, 256)));
  const double fine = difference(model_of(s), model_of(tabulated(s, 1024)));
  // Steffen's slopes vanish at extrema: the error there is of second order, some (2 pi / 1024)^2 / 8 of a harmonic.
  constexpr double of_second_order = 1e-5;
  EXPECT_LT(fine, of_second_order);
  EXPECT_GT(std::log(coarse / fine) / std::log(4.0), 1.8);
}

TEST(StiffnessCurve, BreakpointsOfEachPlanetAreKnownToTheIntegrator) {
  gear::Stage s = with_harmonics();
  for (gear::Mesh* mesh : {&s.sun_planet_mesh, &s.ring_planet_mesh}) {
    mesh->stiffness_cos_N_per_m.clear();
    mesh->stiffness_sin_N_per_m.clear();
  }
  // Two pairs until phase 0.2, one behind it.
  s.sun_planet_mesh.stiffness_curve = gear::StiffnessCurve{{0.0, 0.0, 0.2, 0.2}, {1e9, 1.8e9, 1.8e9, 1e9}, {0.0, 0.2}};
  s.sun_planet_mesh.stiffness_N_per_m = 0.2 * 1.8e9 + 0.8 * 1e9;
  ASSERT_TRUE(gear::problems_for_dynamics(s).empty());
  const DynamicModel model = model_of(s);
  // s_spi = s - z_s phi_i: 28/3 leaves planets 2 and 3 a third of a period apart.
  std::vector<double> expected;
  for (const double lag : {0.0, 1.0 / 3.0, 2.0 / 3.0})
    for (const double own : {0.0, 0.2}) expected.push_back(two_pi * std::fmod(own + lag, 1.0));
  std::sort(expected.begin(), expected.end());
  ASSERT_EQ(model.breakpoints.size(), expected.size());
  constexpr double rounding = 1e-13;  // of phases of nine turns
  for (std::size_t k = 0; k < expected.size(); ++k) EXPECT_NEAR(model.breakpoints[k], expected[k], rounding);
}

TEST(StiffnessCurve, DefaultStartTakesTheMeanStiffness) {
  const gear::Stage s = with_harmonics();
  const auto a = model_of(s).default_start;
  const auto b = model_of(tabulated(s, 64)).default_start;
  ASSERT_EQ(a.size(), b.size());
  constexpr double rounding = 1e-12;
  for (std::size_t k = 0; k < a.size(); ++k) EXPECT_NEAR(a[k], b[k], rounding);
}

TEST(StiffnessCurve, MustHaveTheMeanThatIsGiven) {
  gear::Stage s = tabulated(with_harmonics(), 64);
  s.ring_planet_mesh.stiffness_N_per_m *= 1.02;
  const auto problems = gear::problems_for_dynamics(s);
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_EQ(problems[0].rfind("/lumped/ring_planet_mesh/stiffness_N_per_m: is ", 0), 0U);
}

TEST(StiffnessCurve, ExcludesHarmonics) {
  gear::Stage s = tabulated(with_harmonics(), 16);
  s.sun_planet_mesh.stiffness_cos_N_per_m = {1e8};
  EXPECT_FALSE(gear::problems_for_dynamics(s).empty());
}

TEST(StiffnessCurve, LanesOnPiecesOfDifferentKindsAreTheSingleRuns) {
  // Rows on a grid in one piece and on none in the other: each lane reads its own as a single run does.
  const DynamicModel m = model_of(problems::with_stiffness_curve(problems::r1()));
  ASSERT_GE(m.breakpoints.size(), 2U);
  constexpr double rounding = 1e-12;  // of some hundred operations
  for (const char* set : {"baseline", "avx2", "avx512"}) {
    const LaneField lanes = make_lane_field(m, set);
    for (std::size_t trial = 0; trial < 100 && lanes.width > 0; ++trial) {
      alignas(64) std::array<double, 8> s{};
      std::vector<std::size_t> segment;
      for (std::size_t w = 0; w < lanes.width; ++w) {
        s[w] = two_pi * (0.5 + static_cast<double>((trial + 13 * w) % 100)) / 100.0;
        segment.push_back(segment_at(m.breakpoints, s[w]));
        lanes.load(w, m);
        lanes.set_segment(w, segment[w]);
      }
      alignas(64) std::array<double, 8 * 64> y{};
      alignas(64) std::array<double, 8 * 64> f{};
      ASSERT_LE(m.dimension, 64U);
      for (std::size_t i = 0; i < m.dimension; ++i)
        for (std::size_t w = 0; w < lanes.width; ++w) y[i * lanes.width + w] = m.default_start[i];
      lanes.set_places(1, s.data());
      lanes.right_hand_side(0, y.data(), f.data());
      std::vector<double> expected(m.dimension);
      for (std::size_t w = 0; w < lanes.width; ++w) {
        m.right_hand_side(segment[w], s[w], m.default_start.data(), expected.data());
        for (std::size_t i = 0; i < m.dimension; ++i)
          ASSERT_NEAR(f[i * lanes.width + w], expected[i], rounding * (1.0 + std::abs(expected[i])))
              << set << " lane " << w << " s " << s[w];
      }
    }
  }
}

}  // namespace
}  // namespace epicyclic::model::stiffness_curve_motion_test
