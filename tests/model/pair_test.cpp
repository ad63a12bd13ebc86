// A lone pair of gears: its equations written once more, in each layout; lanes, tangents, modes.

#include "problems/pair.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "gear/kinematics.hpp"
#include "model/dynamic_model.hpp"
#include "model/lane_field.hpp"
#include "model/modes.hpp"

namespace epicyclic::model::pair_test {
namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;
constexpr double omega = 0.9;

DynamicModel model_of(const gear::Stage& stage, const ModelOptions& options = {}) {
  return make_dynamic_model(stage, scales_of(stage), omega, options);
}

gear::Stage without_shafts(gear::Stage stage) {
  stage.sun.torsional_support_N_per_m = 0.0;
  stage.planet.torsional_support_N_per_m.reset();
  return stage;
}

gear::Stage without_bearings(gear::Stage stage) {
  stage.sun.support_N_per_m = stage.planet.bearing_N_per_m = gear::rigid;
  stage.sun_bearing.clearance_half_um = 0.0;
  return stage;
}

/// x, y, u of gear 1, then of gear 2.
using Six = std::array<double, 6>;

/// Accelerations d^2/d tau^2, from Newton's law for each gear in SI units.
Six accelerations(const gear::Stage& g, double s, const Six& q, const Six& v) {
  const Scales scales = scales_of(g);
  const double metre = length_scale_m;
  const double per_second = length_scale_m * scales.omega_sn;
  const auto harmonics = [s](const auto& cosine, const auto& sine) {
    double sum = 0.0;
    for (std::size_t h = 0; h < cosine.size(); ++h) sum += cosine[h] * std::cos(static_cast<double>(h + 1) * s);
    for (std::size_t h = 0; h < sine.size(); ++h) sum += sine[h] * std::sin(static_cast<double>(h + 1) * s);
    return sum;
  };
  const auto open = [](double x, double b) { return x > b ? x - b : x < -b ? x + b : 0.0; };
  const auto& mesh = g.sun_planet_mesh;
  const double alpha = *mesh.operating_pressure_angle_deg * std::numbers::pi / 180.0;
  const double phase = s + mesh.error_phase_deg[0] * std::numbers::pi / 180.0;
  const double e = 1e-6 * mesh.error_amplitude_um[0];
  const double m_1 = g.sun.inertia_over_r2_kg;
  const double m_2 = g.planet.inertia_over_r2_kg;
  const double delta =
      metre * ((q[0] - q[3]) * std::sin(alpha) + (q[1] - q[4]) * std::cos(alpha) + q[2] + q[5]) - e * std::sin(phase);
  const double rate = per_second * ((v[0] - v[3]) * std::sin(alpha) + (v[1] - v[4]) * std::cos(alpha) + v[2] + v[5]) -
                      e * omega * scales.omega_sn * std::cos(phase);
  const double k = mesh.stiffness_N_per_m + harmonics(mesh.stiffness_cos_N_per_m, mesh.stiffness_sin_N_per_m);
  const double c = 2.0 * *mesh.damping_ratio * std::sqrt(mesh.stiffness_N_per_m * m_1 * m_2 / (m_1 + m_2));
  const double force = k * open(delta, 1e-6 * mesh.backlash_half_um) + c * rate;
  const double static_force = *g.load.torque_Nm / (1e-3 * *g.sun.base_radius_mm);
  const auto ratio = [&](const auto& cosine, const auto& sine) {
    return 1.0 + harmonics(cosine.value_or(std::vector<double>{}), sine.value_or(std::vector<double>{}));
  };
  const auto dashpot = [](double zeta, double stiffness, double mass) {
    return 2.0 * zeta * std::sqrt(stiffness * mass);
  };
  Six f{};
  if (std::isfinite(g.sun.support_N_per_m)) {
    const double b = 1e-6 * g.sun_bearing.clearance_half_um;
    const double c_1 = dashpot(g.sun.damping.ratio.value_or(0.0), g.sun.support_N_per_m, g.sun.mass_kg);
    const double c_2 = dashpot(g.planet.damping.ratio.value_or(0.0), g.planet.bearing_N_per_m, g.planet.mass_kg);
    const double friction = force * mesh.friction.table->force_ratio[0];
    const std::array on_2{force * std::sin(alpha) + friction * std::cos(alpha),
                          force * std::cos(alpha) - friction * std::sin(alpha)};
    for (std::size_t i = 0; i < 2; ++i) {
      f[i] = -g.sun.support_N_per_m * open(metre * q[i], b) - c_1 * per_second * v[i] - on_2[i];
      f[3 + i] = -g.planet.bearing_N_per_m * metre * q[3 + i] - c_2 * per_second * v[3 + i] + on_2[i];
    }
  }
  const auto shaft = [&](double stiffness, double zeta, double mass, double u, double u_rate) {
    return stiffness * metre * u + dashpot(zeta, stiffness, mass) * per_second * u_rate;
  };
  f[2] = static_force * ratio(g.load.input_cos, g.load.input_sin) -
         force * (1.0 - mesh.friction.table->moment_driving_mm[0] / *g.sun.base_radius_mm) -
         shaft(g.sun.torsional_support_N_per_m, g.sun.damping.ratio.value_or(0.0), m_1, q[2], v[2]);
  f[5] = static_force * ratio(g.load.output_cos, g.load.output_sin) -
         force * (1.0 - mesh.friction.table->moment_driven_mm[0] / *g.planet.base_radius_mm) -
         shaft(g.planet.torsional_support_N_per_m.value_or(0.0), g.planet.damping.ratio.value_or(0.0), m_2, q[5], v[5]);
  const Six mass = {g.sun.mass_kg, g.sun.mass_kg, m_1, g.planet.mass_kg, g.planet.mass_kg, m_2};
  for (std::size_t i = 0; i < 6; ++i) f[i] /= mass[i] * metre * scales.omega_sn * scales.omega_sn;
  return f;
}

/// Both gears from a state of the layout, gear 2 at rest where only w = u_1 + u_2 is known.
Six gears(Layout layout, const double* y) {
  Six q{};
  std::size_t k = 0;
  if (has_translations(layout)) q[0] = y[k++], q[1] = y[k++];
  q[2] = y[k++];
  if (has_translations(layout)) q[3] = y[k++], q[4] = y[k++];
  if (has_both_rotations(layout)) q[5] = y[k];
  return q;
}

std::vector<double> state_of(Layout layout, Six q) {
  if (!has_both_rotations(layout)) q[2] += q[5];
  std::vector<double> y;
  if (has_translations(layout)) y.insert(y.end(), {q[0], q[1]});
  y.push_back(q[2]);
  if (has_translations(layout)) y.insert(y.end(), {q[3], q[4]});
  if (has_both_rotations(layout)) y.push_back(q[5]);
  return y;
}

std::vector<gear::Stage> all_pairs() {
  const gear::Stage all = problems::pair_on_shafts();
  return {all, without_shafts(all), without_bearings(all), without_bearings(without_shafts(all))};
}

TEST(Pair, LayoutsFollowFromSupports) {
  const std::array layouts = {Layout::pair_supported, Layout::pair, Layout::pair_torsional_supported,
                              Layout::pair_torsional};
  const std::array<std::vector<std::string>, 4> names = {
      {{"x_1", "y_1", "u_1", "x_2", "y_2", "u_2"}, {"x_1", "y_1", "w", "x_2", "y_2"}, {"u_1", "u_2"}, {"w"}}};
  const std::vector<gear::Stage> pairs = all_pairs();
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const DynamicModel m = model_of(pairs[k]);
    EXPECT_EQ(m.layout, layouts[k]);
    EXPECT_EQ(m.dimension, 2 * names[k].size());
    EXPECT_EQ(std::vector<std::string>(m.state_names.begin(),
                                       m.state_names.begin() + static_cast<std::ptrdiff_t>(names[k].size())),
              names[k]);
    EXPECT_FALSE(m.has_ring());
    EXPECT_EQ(m.surfaces.count, contact_surfaces(m).size());
  }
}

TEST(Pair, EquationsAreNewtonsForEachGear) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> component(-3.0, 3.0);
  std::uniform_real_distribution<double> phase(0.0, two_pi);
  for (const gear::Stage& pair : all_pairs()) {
    const DynamicModel m = model_of(pair);
    const std::size_t n = m.dimension / 2;
    std::vector<double> y(2 * n), slope(2 * n);
    for (int trial = 0; trial < 100; ++trial) {
      for (double& x : y) x = component(random);
      const double s = phase(random);
      m.right_hand_side(0, s, y.data(), slope.data());
      const std::vector<double> expected =
          state_of(m.layout, accelerations(pair, s, gears(m.layout, y.data()), gears(m.layout, y.data() + n)));
      for (std::size_t k = 0; k < n; ++k) {
        EXPECT_NEAR(slope[k], y[n + k] / omega, 1e-13);
        EXPECT_NEAR(slope[n + k], expected[k] / omega, 1e-11 * (1.0 + std::abs(expected[k]))) << m.state_names[k];
      }
    }
  }
}

TEST(Pair, StartsFromTheEquilibriumOfItsMeanLoad) {
  for (gear::Stage pair : all_pairs()) {
    pair.sun_planet_mesh.error_amplitude_um = {0.0};
    const DynamicModel m = model_of(pair);
    if (has_both_rotations(m.layout)) continue;  // shafts carry a part of the torque
    MeshDeflections d;
    m.deflections(0.0, m.default_start.data(), d);
    const double force = *pair.load.torque_Nm / (1e-3 * *pair.sun.base_radius_mm);
    const gear::Mesh& mesh = pair.sun_planet_mesh;
    EXPECT_NEAR(d.sun_planet[0], m.scales.displacement(1e-6 * mesh.backlash_half_um + force / mesh.stiffness_N_per_m),
                1e-12);
    StageForces f;
    m.forces(0.0, m.default_start.data(), f);
    EXPECT_EQ(f.ring_planet[0], 0.0);
  }
}

TEST(Pair, LanesAndTangentsAreThoseOfTheEquations) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> component(-3.0, 3.0);
  for (const gear::Stage& pair : all_pairs()) {
    const DynamicModel m = model_of(pair, {.clearance_smoothing = 0.05});
    const std::size_t n = m.dimension;
    std::vector<double> y(n), v(n), slope(n), pushed(n), beyond(n), before(n);
    for (double& x : y) x = component(random);
    for (double& x : v) x = component(random);
    m.tangents(0, 0.7, y.data(), {v.data(), 1, n}, slope.data(), {pushed.data(), 1, n});
    constexpr double h = 1e-5;
    std::vector<double> there = y;
    for (std::size_t k = 0; k < n; ++k) there[k] = y[k] + h * v[k];
    m.right_hand_side(0, 0.7, there.data(), beyond.data());
    for (std::size_t k = 0; k < n; ++k) there[k] = y[k] - h * v[k];
    m.right_hand_side(0, 0.7, there.data(), before.data());
    for (std::size_t k = 0; k < n; ++k) EXPECT_NEAR(pushed[k], (beyond[k] - before[k]) / (2.0 * h), 1e-6);

    for (const char* set : {"baseline", "avx2", "avx512"}) {
      const LaneField lanes = make_lane_field(m, set, 0, 0);
      const std::size_t w = lanes.width;
      if (w == 0) continue;  // not of this machine
      alignas(64) std::array<double, 8> s{};
      s.fill(0.7);
      for (std::size_t lane = 0; lane < w; ++lane) lanes.load(lane, m);
      lanes.set_places(1, s.data());
      alignas(64) std::array<double, 12 * 8> state{}, rate{};
      for (std::size_t k = 0; k < n; ++k)
        for (std::size_t lane = 0; lane < w; ++lane) state[k * w + lane] = y[k];
      lanes.right_hand_side(0, state.data(), rate.data());
      for (std::size_t k = 0; k < n; ++k)
        for (std::size_t lane = 0; lane < w; ++lane) EXPECT_NEAR(rate[k * w + lane], slope[k], 1e-12) << set;
    }
  }
}

/// The only mode of a torsional pair is at omega_sn; with shafts the two of two masses in a row.
TEST(Pair, ModesAreThoseOfOneAndTwoMasses) {
  const gear::Stage one = problems::torsional_pair();
  const auto alone = modes(one, scales_of(one));
  ASSERT_EQ(alone.size(), 2U);
  EXPECT_NEAR(alone[0].frequency_ratio, 0.0, 1e-7);  // both gears rotate freely
  EXPECT_NEAR(alone[1].frequency_ratio, 1.0, 1e-12);

  const gear::Stage two = without_bearings(problems::pair_on_shafts());
  const Scales scales = scales_of(two);
  const double k = scales.stiffness(two.sun_planet_mesh.stiffness_N_per_m);
  const double k_1 = scales.stiffness(two.sun.torsional_support_N_per_m);
  const double k_2 = scales.stiffness(*two.planet.torsional_support_N_per_m);
  const double m_1 = scales.mass_ratio(two.sun.inertia_over_r2_kg);
  const double m_2 = scales.mass_ratio(two.planet.inertia_over_r2_kg);
  const double sum = (k + k_1) / m_1 + (k + k_2) / m_2;
  const double product = ((k + k_1) * (k + k_2) - k * k) / (m_1 * m_2);
  const double root = std::sqrt(0.25 * sum * sum - product);
  const auto both = modes(two, scales);
  ASSERT_EQ(both.size(), 2U);
  EXPECT_NEAR(both[0].frequency_ratio, std::sqrt(0.5 * sum - root), 1e-9);
  EXPECT_NEAR(both[1].frequency_ratio, std::sqrt(0.5 * sum + root), 1e-9);
}

TEST(Pair, SpeedsAndProblems) {
  const gear::Stage pair = problems::torsional_pair();
  EXPECT_NEAR(gear::speeds(pair, 300.0).sun, 10.0, 1e-12);
  EXPECT_TRUE(gear::problems_for_modes(pair).empty());
  EXPECT_TRUE(gear::problems_for_dynamics(pair).empty());
  const auto refused = [&](auto change, const char* pointer) {
    gear::Stage s = pair;
    change(s);
    auto all = gear::problems_for_modes(s);
    for (const std::string& problem : gear::problems_for_dynamics(s)) all.push_back(problem);
    ASSERT_EQ(all.size(), 1U) << pointer;
    EXPECT_EQ(all[0].rfind(pointer, 0), 0U) << all[0];
  };
  refused([](auto& s) { s.planet_count = 2; }, "/planets/count");
  refused([](auto& s) { s.ring.mass_kg = 1.0; }, "/lumped/ring");
  refused([](auto& s) { s.ring_planet_mesh.stiffness_N_per_m = 1e8; }, "/lumped/ring_planet_mesh");
  refused([](auto& s) { s.planet.bearing_N_per_m = 1e8; }, "/lumped/planet/bearing_N_per_m");
  refused([](auto& s) { s.driver = gear::Driver::ring; }, "/driver");
  refused([](auto& s) { s.planet.pin_error_radial_um = {1.0}; }, "/lumped/planet");
}

}  // namespace
}  // namespace epicyclic::model::pair_test
