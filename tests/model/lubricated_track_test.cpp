// Tables of lubricated contact as the model has them: against the law, in lanes, and half as fine.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <numbers>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "core/instruction_set.hpp"
#include "gear/ehl_friction.hpp"
#include "gear/gear_set.hpp"
#include "gear/kinematics.hpp"
#include "model/dynamic_model.hpp"
#include "model/friction_track.hpp"
#include "model/lane_field.hpp"
#include "model/parameters.hpp"
#include "model/right_hand_side.hpp"
#include "problems/r1.hpp"
#include "problems/table1.hpp"

namespace epicyclic::model::lubricated_track_test {
namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;

const gear::GearSet& table1() {
  static const gear::GearSet set = gear::make_gear_set(problems::table1());
  return set;
}

gear::Friction lubricated(const gear::MeshedPair& mesh, double tolerance) {
  gear::Friction f;
  f.ehl = gear::ehl_of(mesh, {5, 0.6, tolerance});
  return f;
}

/// The paper's train with an oil in place of coefficients.
gear::Stage oiled(double tolerance = gear::Lubrication{}.table_tolerance) {
  gear::Stage s = problems::tang2020();
  s.sun_planet_mesh.friction = lubricated(table1().sun_planet, tolerance);
  s.ring_planet_mesh.friction = lubricated(table1().ring_planet, tolerance);
  return s;
}

struct LawAndTrack {
  const gear::MeshedPair& mesh;
  gear::LineOfAction line;
  gear::EhlFriction ehl;
  gear::MeshLoad load;
  gear::FrictionTable table;
  FrictionTrack track;

  LawAndTrack(const gear::MeshedPair& of, double tolerance, double omega)
      : mesh(of),
        line(problems::line_of(of.pair)),
        ehl(*lubricated(of, tolerance).ehl),
        load(gear::mean_mesh_load(oiled(), omega * scales_of(oiled()).omega_sn)),
        table(gear::friction_table(ehl, line, load)),
        track(table, 0.0, line.base_radius_1_mm, line.base_radius_2_mm) {}

  /// Greatest difference of the ratios, with the load sharing of the teeth, close to the breakpoints as well.
  [[nodiscard]] double error() const {
    double worst = 0.0;
    for (std::size_t b = 0; b < table.breakpoints.size(); ++b) {
      const double from = table.breakpoints[b];
      const double to = b + 1 < table.breakpoints.size() ? table.breakpoints[b + 1] : 1.0;
      const double inside = 0.5 * (from + to);
      std::vector<double> ways;
      for (double way = 0.5; way > 1e-9; way *= 0.87) ways.insert(ways.end(), {way, 1.0 - way});
      for (const double way : ways) {
        const double phase = from + (to - from) * way;
        std::array<double, 3> law{};
        for (int j = 0; inside + j < ehl.contact_ratio; ++j) {
          const double share = mesh.load_share(phase + j, inside + j);
          const auto contact = gear::lubricated_contact(ehl, line, load, phase + j, share);
          const double f = -std::copysign(share * gear::xu_friction_coefficient(contact), contact.slide_to_roll);
          const double arm = mesh.arm_mm(phase + j);
          law[0] += f;
          law[1] += f * arm / line.base_radius_1_mm;
          law[2] += f * line.arm_2(arm) / line.base_radius_2_mm;
        }
        const FrictionRatios<double> r = track.at(track.place(inside), phase);
        worst = std::max({worst, std::abs(r.force - law[0]), std::abs(r.moment_driving - law[1]),
                          std::abs(r.moment_driven - law[2])});
      }
    }
    return worst;
  }
};

TEST(LubricatedTrack, IsTheLawToTheErrorThatItTells) {
  for (const gear::MeshedPair* mesh : {&table1().sun_planet, &table1().ring_planet})
    for (const double tolerance : {1e-6, 1e-9, 1e-11})
      for (const double omega : {0.3, 2.8}) {
        const LawAndTrack t(*mesh, tolerance, omega);
        const double error = t.error();
        // The tolerance is met by the table and by the load shares that it is made of, one on the other.
        EXPECT_LE(t.track.error(), 1.1 * tolerance);
        constexpr double rounding = 1e-15;  // of ratios of order 0.01
        EXPECT_LE(error, t.track.error() + rounding);
        std::size_t rows = 0;
        for (const IntervalGrid& g : t.track.grids()) rows += g.count;
        RecordProperty("rows", std::to_string(rows));
        if (tolerance == 1e-9) {
          EXPECT_LT(rows, 500U);
        }
      }
}

TEST(LubricatedTrack, IsGradedTowardsThePitchPointOfTheSunMesh) {
  const LawAndTrack sun(table1().sun_planet, 1e-9, 1.0);
  std::size_t towards_end = 0;
  std::size_t towards_start = 0;
  for (const IntervalGrid& g : sun.track.grids())
    if (g.per_octave > 0) ++(g.from_end ? towards_end : towards_start);
  EXPECT_EQ(towards_end, 1U);
  EXPECT_EQ(towards_start, 1U);
  // The ring mesh lies beyond its pitch point.
  const LawAndTrack ring(table1().ring_planet, 1e-9, 1.0);
  for (const IntervalGrid& g : ring.track.grids()) EXPECT_EQ(g.per_octave, 0U);
}

/// Forces of friction that the right-hand side applies, against the law and the teeth's own load sharing.
class AppliedFriction {
 public:
  static constexpr std::size_t planets = 3;
  using P = Parameters<double, planets>;

  explicit AppliedFriction(double tolerance, double omega)
      : stage_(oiled(tolerance)), scales_(scales_of(stage_)), omega_(omega), parameters(made({})) {}

  [[nodiscard]] P made(const ModelOptions& options) const {
    return make_parameters<planets>(stage_, scales_, omega_, options);
  }

  /// Greatest difference over the mesh force, at random states and at random phases: half of them all over the mesh
  /// period, half beside the phases where a pair enters, leaves or passes the pitch point.
  [[nodiscard]] double worst(const P& p, bool sun) const {
    const gear::Mesh& given = sun ? stage_.sun_planet_mesh : stage_.ring_planet_mesh;
    const gear::MeshedPair& teeth = sun ? table1().sun_planet : table1().ring_planet;
    const gear::EhlFriction& ehl = *given.friction.ehl;
    const gear::LineOfAction line = sun ? gear::sun_planet_line(stage_) : gear::ring_planet_line(stage_);
    const gear::MeshLoad load = gear::mean_mesh_load(stage_, omega_ * scales_.omega_sn);
    const double cycles = sun ? -*stage_.sun.teeth : *stage_.ring.teeth;
    const double lead = sun ? 0.0 : stage_.ring_mesh_lead_1;
    constexpr std::size_t dimension = 2 * degrees_of_freedom(Layout::full, planets);
    std::mt19937 random(7);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    double most = 0.0;
    for (int trial = 0; trial < 6000; ++trial) {
      double s = two_pi * uniform(random);
      if (trial % 2 == 1) {
        const double beside = std::pow(10.0, -1.0 - 9.0 * uniform(random)) * (trial % 4 == 1 ? 1.0 : -1.0);
        s = p.breakpoints[static_cast<std::size_t>(trial / 4) % p.breakpoints.size()] + beside;
        s -= two_pi * std::floor(s / two_pi);
      }
      std::array<double, dimension> y{};
      for (double& x : y) x = 4.0 * uniform(random) - 2.0;
      const auto g = stage_state(Layout::full, p, segment_at(p.breakpoints, s), s, y.data());
      const auto& mesh = sun ? g.sun_planet : g.ring_planet;
      for (std::size_t i = 0; i < planets; ++i) {
        const double turns = cycles * (stage_.planet_angles_deg()[i] - stage_.planet_angles_deg()[0]) / 360.0 + lead;
        double phase = s / two_pi + turns;
        phase -= std::floor(phase);
        std::array<double, 3> law{};
        for (int j = 0; phase + j < ehl.contact_ratio; ++j) {
          const double share = teeth.load_share(phase + j);
          const auto contact = gear::lubricated_contact(ehl, line, load, phase + j, share);
          const double f = -std::copysign(share * gear::xu_friction_coefficient(contact), contact.slide_to_roll);
          const double arm = ehl.path_start_mm + line.base_pitch_mm * (phase + j);
          law[0] += f;
          law[1] += f * arm / line.base_radius_1_mm;
          law[2] += f * line.arm_2(arm) / line.base_radius_2_mm;
        }
        const double force = mesh.force[i];
        if (std::abs(force) < 1e-3) continue;
        most = std::max({most, std::abs(mesh.friction[i] / force - law[0]),
                         std::abs(mesh.moment_driving[i] / force - law[1]),
                         std::abs(mesh.moment_driven[i] / force - law[2])});
      }
    }
    return most;
  }

  /// The parameters with two neighbouring rows of the sun meshes' table exchanged.
  [[nodiscard]] P with_rows_exchanged() const {
    const gear::LineOfAction line = gear::sun_planet_line(stage_);
    gear::FrictionTable table = gear::friction_table(*stage_.sun_planet_mesh.friction.ehl, line,
                                                     gear::mean_mesh_load(stage_, omega_ * scales_.omega_sn));
    const std::size_t k = table.phase.size() / 2;
    std::swap(table.force_ratio[k], table.force_ratio[k + 1]);
    P p = parameters;
    p.sun_planet.friction = std::make_shared<FrictionTrack>(table, 0.0, line.base_radius_1_mm, line.base_radius_2_mm);
    return p;
  }

 private:
  gear::Stage stage_;
  Scales scales_;
  double omega_;

 public:
  P parameters;
};

TEST(LubricatedTrack, ForcesOfTheRightHandSideAreTheLawsToTheErrorThatTheTableTells) {
  for (const auto& [tolerance, omega] : {std::pair(1e-9, 0.4), {1e-9, 2.8}, {1e-7, 1.3}}) {
    const AppliedFriction applied(tolerance, omega);
    const auto& p = applied.parameters;
    constexpr double rounding = 1e-14;
    for (const bool sun : {true, false}) {
      const double told = (sun ? p.sun_planet : p.ring_planet).friction->error();
      const double worst = applied.worst(p, sun);
      EXPECT_LE(worst, told + rounding) << (sun ? "sun " : "ring ") << tolerance << " " << omega;
      EXPECT_LE(told, 10.0 * worst) << (sun ? "sun " : "ring ") << tolerance << " " << omega;
      RecordProperty((sun ? "sun" : "ring") + std::to_string(omega), std::to_string(told / worst));
      // Another table is told from it.
      ModelOptions half;
      half.halved_tables = true;
      EXPECT_GT(applied.worst(applied.made(half), sun), told);
    }
    EXPECT_GT(applied.worst(applied.with_rows_exchanged(), true), p.sun_planet.friction->error());
  }
}

TEST(LubricatedTrack, LanesAreTheSingleRuns) {
  const gear::Stage stage = oiled();
  const auto model_at = [&](double omega) { return make_dynamic_model(stage, scales_of(stage), omega, {}); };
  const DynamicModel like = model_at(1.0);
  std::size_t compared = 0;
  std::array<std::size_t, 2> told_apart{};  // from tables half as fine: all over the segments, beside their ends
  for (const char* set : {"baseline", "avx2", "avx512"}) {
    const LaneField lanes = make_lane_field(like, set);
    if (lanes.width == 0) continue;
    std::vector<DynamicModel> models;
    std::vector<DynamicModel> halved;
    for (std::size_t w = 0; w < lanes.width; ++w) {
      models.push_back(model_at(0.4 + 0.3 * static_cast<double>(w)));
      halved.push_back(models.back().with_halved_tables());
      lanes.load(w, models.back());
    }
    const std::vector<double>& breaks = like.breakpoints;
    for (std::size_t trial = 0; trial < 80 * breaks.size(); ++trial) {
      // Each lane in a segment of its own, from its start over its end.
      alignas(64) std::array<double, 8> s{};
      std::vector<std::size_t> segment;
      for (std::size_t w = 0; w < lanes.width; ++w) {
        const std::size_t k = (trial + w) % breaks.size();
        const double to = k + 1 < breaks.size() ? breaks[k + 1] : breaks[0] + two_pi;
        const double part = static_cast<double>(trial % 40) / 39.0;
        // All over the segment, and down to the finest intervals beside a pitch point.
        const double way = trial / 40 < breaks.size() ? std::pow(part, 3.0) : 0.5 * std::pow(10.0, -11.0 * part);
        s[w] = breaks[k] + (to - breaks[k]) * (trial % 2 == 0 ? way : 1.0 - way);
        segment.push_back(k);
        lanes.set_segment(w, k);
      }
      const std::size_t n = like.dimension;
      alignas(64) std::array<double, 64 * 8> y{};
      alignas(64) std::array<double, 64 * 8> f{};
      ASSERT_LE(n, 64U);
      std::vector<double> own(n);
      for (std::size_t i = 0; i < n; ++i) {
        own[i] = 3.0 * std::sin(static_cast<double>(i + 1 + trial));
        for (std::size_t w = 0; w < lanes.width; ++w) y[i * lanes.width + w] = own[i];
      }
      lanes.set_places(1, s.data());
      lanes.right_hand_side(0, y.data(), f.data());
      std::vector<double> expected(n);
      for (std::size_t w = 0; w < lanes.width; ++w) {
        models[w].right_hand_side(segment[w], s[w], own.data(), expected.data());
        const auto tolerance = [&](std::size_t i) { return 1e-11 * (1.0 + std::abs(expected[i])); };
        for (std::size_t i = 0; i < n; ++i)
          ASSERT_NEAR(f[i * lanes.width + w], expected[i], tolerance(i))
              << set << " lane " << w << " segment " << segment[w] << " s " << s[w];
        ++compared;
        std::vector<double> other(n);
        halved[w].right_hand_side(segment[w], s[w], own.data(), other.data());
        bool apart = false;
        for (std::size_t i = 0; i < n; ++i) apart = apart || std::abs(other[i] - f[i * lanes.width + w]) > tolerance(i);
        if (apart) ++told_apart[trial / 40 < breaks.size() ? 0 : 1];
      }
    }
  }
  EXPECT_GT(compared, 0U);
  EXPECT_GT(told_apart[0], compared / 20);
  EXPECT_GT(told_apart[1], compared / 20);
  RecordProperty(
      "apart", std::to_string(told_apart[0]) + " " + std::to_string(told_apart[1]) + " of " + std::to_string(compared));
}

TEST(LubricatedTrack, HalfAsFineIsAboutSixteenTimesAsFarOff) {
  const gear::Stage stage = oiled(1e-7);
  const gear::Stage fine = oiled(1e-12);
  const DynamicModel m = make_dynamic_model(stage, scales_of(stage), 0.7, {});
  const DynamicModel exact = make_dynamic_model(fine, scales_of(fine), 0.7, {});
  ASSERT_TRUE(m.with_halved_tables);
  const DynamicModel half = m.with_halved_tables();
  ASSERT_EQ(half.breakpoints, m.breakpoints);
  const auto off = [&](const DynamicModel& other) {
    double sum = 0.0;
    std::vector<double> a(m.dimension);
    std::vector<double> b(m.dimension);
    for (int k = 0; k < 2003; ++k) {
      const double s = two_pi * k / 2003.0;
      const std::size_t segment = segment_at(m.breakpoints, s);
      exact.right_hand_side(segment, s, m.default_start.data(), a.data());
      other.right_hand_side(segment, s, m.default_start.data(), b.data());
      double most = 0.0;
      for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, std::abs(a[i] - b[i]));
      sum += most;
    }
    return sum;
  };
  const double ratio = off(half) / off(m);
  EXPECT_GT(ratio, 6.0);
  EXPECT_LT(ratio, 40.0);
  // Coefficients and given tables are what they are.
  const gear::Stage plain = problems::tang2020();
  EXPECT_FALSE(make_dynamic_model(plain, scales_of(plain), 0.7, {}).with_halved_tables);
}

}  // namespace
}  // namespace epicyclic::model::lubricated_track_test
