#include "gear/friction_path.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/errors.hpp"
#include "gear/kinematics.hpp"
#include "problems/r1.hpp"

namespace epicyclic::gear::friction_path_test {
namespace {

// Roundings of arms of some 30 mm [mm].
constexpr double rounding_mm = 1e-12;
constexpr double rounding = 1e-13;

/// A smooth piece of a table: its two rows.
struct Piece {
  std::size_t left, right;
};

std::vector<Piece> pieces(const FrictionTable& t) {
  // Rows come as: 0 (left side), then (start, end) of each piece, the end of the last one being row 0.
  std::vector<Piece> r;
  for (std::size_t k = 1; k < t.phase.size(); k += 2) r.push_back({k, k + 1 < t.phase.size() ? k + 1 : 0});
  return r;
}

double phase_at_right(const FrictionTable& t, const Piece& p) { return p.right == 0 ? 1.0 : t.phase[p.right]; }

/// f_j and arm of each pair in contact at one row: from A and B_1 alone, the coefficient and signs not being used.
struct Pair {
  double ratio, arm_1;
};

std::vector<Pair> pairs_at(const FrictionTable& t, std::size_t row, double phase, double middle, double start,
                           double base_pitch, double contact_ratio) {
  const double h = start + base_pitch * phase;
  if (middle + 1.0 >= contact_ratio) return {{t.force_ratio[row], h}};
  // A = (f_1 + f_2) / 2, B_1 = (f_1 h + f_2 (h + p_b)) / 2
  const double second = (2.0 * t.moment_driving_mm[row] - 2.0 * t.force_ratio[row] * h) / base_pitch;
  return {{2.0 * t.force_ratio[row] - second, h}, {second, h + base_pitch}};
}

struct Mesh2 {
  std::string name;
  CoulombFriction friction;
  LineOfAction line;
  double omega_1, omega_2;  ///< relative to the carrier [rad/s]
};

std::vector<Mesh2> meshes() {
  const Stage s = problems::tang2020();
  const Speeds w = speeds(s, 1e4);
  const double sun = w.sun - w.carrier;
  const double planet = sun * 27.0 / 25.0;  // magnitudes: the arms carry the senses
  const double ring = sun / 3.0;
  return {{"sun-planet", *s.sun_planet_mesh.friction.coefficient, sun_planet_line(s), sun, planet},
          {"ring-planet", *s.ring_planet_mesh.friction.coefficient, ring_planet_line(s), planet, ring}};
}

TEST(FrictionPath, LinesOfActionAreThoseOfTable1) {
  // docs/theory/gears.md, section 8: 36.100 mm, pitch point at l_p 11.723 mm, base pitch 7.488267 mm.
  constexpr double printed_mm = 6e-4;
  constexpr double pitch_digits_mm = 1e-6;
  const Stage s = problems::tang2020();
  const LineOfAction sp = sun_planet_line(s);
  const LineOfAction rp = ring_planet_line(s);
  EXPECT_NEAR(sp.theoretical_length_mm, 36.100, printed_mm);
  EXPECT_NEAR(sp.base_pitch_mm, 7.488267, pitch_digits_mm);
  EXPECT_NEAR(rp.base_pitch_mm, 7.488267, pitch_digits_mm);
  EXPECT_NEAR(rp.pitch_arm_mm, 11.723, printed_mm);
  EXPECT_FALSE(sp.internal);
  EXPECT_TRUE(rp.internal);
  EXPECT_NEAR(sp.sliding(sp.pitch_arm_mm), 0.0, rounding);
  EXPECT_NEAR(rp.sliding(rp.pitch_arm_mm), 0.0, rounding);
  EXPECT_NEAR(sp.arm_2(10.0), sp.theoretical_length_mm - 10.0, rounding_mm);
  EXPECT_NEAR(rp.arm_2(10.0), rp.theoretical_length_mm + 10.0, rounding_mm);
}

TEST(FrictionPath, FrictionOpposesSlidingOfEveryPairAllAlongThePath) {
  for (const Mesh2& m : meshes()) {
    const FrictionTable t = friction_table(m.friction, m.line);
    const double start = path_start_mm(m.friction, m.line);
    for (const Piece& p : pieces(t)) {
      const double right = phase_at_right(t, p);
      const double middle = 0.5 * (t.phase[p.left] + right);
      for (const auto& [row, phase] : {std::pair{p.left, t.phase[p.left]}, std::pair{p.right, right}})
        for (const Pair& pair :
             pairs_at(t, row, phase, middle, start, m.line.base_pitch_mm, m.friction.contact_ratio)) {
          EXPECT_NEAR(std::abs(pair.ratio), m.friction.coefficient, rounding) << m.name << " at " << phase;
          // At the pitch point itself the sliding speed is a rounding error.
          const double sliding = m.omega_1 * pair.arm_1 - m.omega_2 * m.line.arm_2(pair.arm_1);
          EXPECT_LE(pair.ratio * sliding, rounding_mm * m.omega_1 * m.friction.coefficient)
              << m.name << " at " << phase;
        }
    }
  }
}

TEST(FrictionPath, RingMeshIsWhollyBeyondItsPitchPointSoItsRatioIsMinusMu) {
  const Mesh2 ring = meshes()[1];
  EXPECT_GT(path_start_mm(ring.friction, ring.line), ring.line.pitch_arm_mm);
  const FrictionTable t = friction_table(ring.friction, ring.line);
  for (const double a : t.force_ratio) EXPECT_NEAR(a, -ring.friction.coefficient, rounding);
}

TEST(FrictionPath, SunMeshChangesSignAtItsPitchPoint) {
  const Mesh2 sun = meshes()[0];
  const FrictionTable t = friction_table(sun.friction, sun.line);
  const double pitch = (sun.line.pitch_arm_mm - path_start_mm(sun.friction, sun.line)) / sun.line.base_pitch_mm;
  std::size_t found = 0;
  for (std::size_t k = 1; k < t.phase.size(); ++k)
    if (t.phase[k] == t.phase[k - 1] && std::abs(t.phase[k] - pitch) < rounding) {
      EXPECT_NEAR(t.force_ratio[k - 1], sun.friction.coefficient, rounding);
      EXPECT_NEAR(t.force_ratio[k], -sun.friction.coefficient, rounding);
      ++found;
    }
  EXPECT_EQ(found, 1U);
}

TEST(FrictionPath, MomentsAreThoseOfOneForceOnTheLineOfAction) {
  for (const Mesh2& m : meshes()) {
    const FrictionTable t = friction_table(m.friction, m.line);
    const double sign = m.line.internal ? -1.0 : 1.0;
    for (std::size_t k = 0; k < t.phase.size(); ++k)
      EXPECT_NEAR(t.moment_driven_mm[k] + sign * t.moment_driving_mm[k],
                  t.force_ratio[k] * m.line.theoretical_length_mm, rounding_mm)
          << m.name << " row " << k;
  }
}

TEST(FrictionPath, BreakpointsAreWherePairsEnterLeaveOrPassThePitchPoint) {
  const Mesh2 sun = meshes()[0];
  const FrictionTable t = friction_table(sun.friction, sun.line);
  const double pitch = (sun.line.pitch_arm_mm - path_start_mm(sun.friction, sun.line)) / sun.line.base_pitch_mm;
  ASSERT_EQ(t.breakpoints.size(), 3U);
  EXPECT_EQ(t.breakpoints[0], 0.0);
  EXPECT_NEAR(t.breakpoints[1], 0.2, rounding);
  EXPECT_NEAR(t.breakpoints[2], pitch, rounding);
  Stage s = problems::tang2020();
  s.sun_planet_mesh.friction = {t, std::nullopt};
  EXPECT_TRUE(problems_for_dynamics(s).empty());
}

TEST(FrictionPath, PathIsSymmetricAboutThePitchPointUnlessGiven) {
  const Mesh2 sun = meshes()[0];
  const CoulombFriction symmetric{0.05, 1.5, std::nullopt};
  const double half = 0.5 * 1.5 * sun.line.base_pitch_mm;
  EXPECT_NEAR(path_start_mm(symmetric, sun.line), sun.line.pitch_arm_mm - half, rounding_mm);
  EXPECT_EQ(path_start_mm({0.05, 1.5, 12.0}, sun.line), 12.0);
}

TEST(FrictionPath, ThreePairsShareTheForceEqually) {
  const Mesh2 sun = meshes()[0];
  const FrictionTable t = friction_table({0.06, 2.5, std::nullopt}, sun.line);
  // Two pairs or three: each ratio is mu times an odd share of the pairs, and both kinds occur.
  bool thirds = false;
  bool halves = false;
  for (const double a : t.force_ratio) {
    const double share = std::abs(a) / 0.06;
    thirds = thirds || std::abs(share - 1.0 / 3.0) < rounding;
    halves = halves || share < rounding || std::abs(share - 1.0) < rounding;
  }
  EXPECT_TRUE(thirds);
  EXPECT_TRUE(halves);
}

TEST(FrictionPath, MissingGeometryIsADomainError) {
  Stage s = problems::tang2020();
  s.planet.base_radius_mm.reset();
  EXPECT_THROW((void)sun_planet_line(s), DomainError);
}

}  // namespace
}  // namespace epicyclic::gear::friction_path_test
