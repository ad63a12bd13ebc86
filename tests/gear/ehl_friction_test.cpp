#include "gear/ehl_friction.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "gear/gear_set.hpp"
#include "problems/table1.hpp"

namespace epicyclic::gear::ehl_friction_test {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double rounding = 1e-14;

const GearSet& table1() {
  static const GearSet set = [] {
    Stage s = problems::table1();
    s.catalogue->stiffness.harmonics = 0;
    return make_gear_set(s);
  }();
  return set;
}

/// Table 1 at a sun's speed of 10000 rpm, 400 kW, ring fixed.
MeshLoad load_at_10000_rpm() {
  const double sun = 1e4 * 2.0 * pi / 60.0;
  return mean_mesh_load(problems::table1(), 20.25 * sun);
}

struct Case {
  std::string name;
  const MeshedPair& mesh;
  LineOfAction line;
  EhlFriction ehl;
};

std::vector<Case> cases() {
  std::vector<Case> r;
  for (const MeshedPair* m : {&table1().sun_planet, &table1().ring_planet})
    r.push_back({m->driven.tooth.internal ? "ring-planet" : "sun-planet", *m, problems::line_of(m->pair),
                 ehl_of(*m, *table1().catalogue.lubrication)});
  return r;
}

/// mu at a position, the load shared as the pairs' stiffness has it.
LubricatedContact contact_at(const Case& c, double position, double inside) {
  return lubricated_contact(c.ehl, c.line, load_at_10000_rpm(), position, c.mesh.load_share(position, inside));
}

TEST(XuFriction, UnitNumbersToTheirDigits) {
  // docs/theory/friction.md, section 6, full coefficients.
  struct Row {
    double slip, pressure, viscosity, roughness, rolling, radius, mu;
  };
  const Row rows[] = {
      {0.05, 0.8, 5, 0.6, 10, 0.010, 0.003640735},   {0.10, 1.0, 10, 0.6, 10, 0.010, 0.012769308},
      {0.20, 1.0, 10, 0.6, 10, 0.010, 0.019839052},  {0.50, 1.0, 10, 0.6, 10, 0.010, 0.025382379},
      {0.20, 1.5, 10, 0.6, 10, 0.010, 0.023382937},  {0.20, 1.0, 5, 0.6, 20, 0.010, 0.012940222},
      {0.20, 1.0, 65, 0.07, 10, 0.005, 0.044684380},
  };
  constexpr double digit = 0.5001e-9;
  for (const Row& r : rows) {
    EXPECT_NEAR(xu_friction_coefficient({r.slip, r.pressure, r.viscosity, r.roughness, r.rolling, r.radius}), r.mu,
                digit);
    EXPECT_NEAR(xu_friction_coefficient({-r.slip, r.pressure, r.viscosity, r.roughness, r.rolling, r.radius}), r.mu,
                digit);
  }
}

TEST(XuFriction, VanishesWithTheSlidingAndWithTheLoad) {
  EXPECT_EQ(xu_friction_coefficient({0.0, 1.0, 10, 0.6, 10, 0.01}), 0.0);
  EXPECT_EQ(xu_friction_coefficient({0.1, 0.0, 10, 0.6, 10, 0.01}), 0.0);
  // mu ~ |SR|^1.036077 towards zero.
  const auto mu = [](double slip) { return xu_friction_coefficient({slip, 1.0, 10, 0.6, 10, 0.01}); };
  constexpr double measured_order = 1e-5;
  EXPECT_NEAR(std::log10(mu(1e-7) / mu(1e-8)), 1.036077, measured_order);
}

TEST(XuFriction, ThinOilCountsAsOneMillipascalSecond) {
  EXPECT_EQ(xu_friction_coefficient({0.1, 1.0, 0.2, 0.6, 10, 0.01}),
            xu_friction_coefficient({0.1, 1.0, 1.0, 0.6, 10, 0.01}));
}

TEST(XuFriction, RangeIsThatOfTheRegression) {
  const LubricatedContact good{0.1, 1.0, 10, 0.6, 10, 0.01};
  EXPECT_TRUE(within_xu_range(good));
  const auto changed = [&](auto change) {
    LubricatedContact c = good;
    change(c);
    return within_xu_range(c);
  };
  EXPECT_FALSE(changed([](LubricatedContact& c) { c.pressure_GPa = 0.4; }));
  EXPECT_FALSE(changed([](LubricatedContact& c) { c.rolling_m_per_s = 36.0; }));
  EXPECT_FALSE(changed([](LubricatedContact& c) { c.viscosity_mPas = 4.0; }));
  EXPECT_FALSE(changed([](LubricatedContact& c) { c.roughness_um = 1.0; }));
}

TEST(Hertz, PressureIsThatOfTheTextbook) {
  // p = sqrt(F' E* / (pi R)), SI throughout, E' = 2 E*.
  const double load = 66.0e3;  // N/m
  const double modulus = 206e9 / (2.0 * (1.0 - 0.09));
  const double radius = 8.4e-3;
  const double textbook = std::sqrt(load * modulus / (pi * radius));
  EXPECT_NEAR(hertz_pressure(66.0, 2.0 * modulus * 1e-9, 8.4) * 1e9, textbook, rounding * textbook);
  const Material steel;
  EXPECT_NEAR(equivalent_modulus(steel, steel) * 1e9, 2.0 * modulus, rounding * modulus);
  // And the half width b = 4 R p / E' holds the load: F' = pi b p / 2.
  const double half_width = 4.0 * radius * textbook / (2.0 * modulus);
  EXPECT_NEAR(0.5 * pi * half_width * textbook, load, 10.0 * rounding * load);
}

TEST(Hertz, UnequalMaterialsAddTheirCompliances) {
  const Material steel;
  const Material bronze{105, 0.34, 8800};
  const double star = 1.0 / ((1.0 - 0.09) / 206.0 + (1.0 - 0.34 * 0.34) / 105.0);
  EXPECT_NEAR(equivalent_modulus(steel, bronze), 2.0 * star, rounding * star);
}

TEST(EhlFriction, LoadOfAMeshIsItsShareOfTheTorque) {
  // 9549 P / n, shared by three sun-planet meshes; both bodies at one speed of their base circles.
  const MeshLoad load = load_at_10000_rpm();
  const double torque = 400e3 / (1e4 * 2.0 * pi / 60.0);
  EXPECT_NEAR(load.force_N, torque / (3.0 * 32.1784579787363e-3), rounding * load.force_N);
  const double sun = 0.75 * 1e4 * 2.0 * pi / 60.0;
  EXPECT_NEAR(load.base_speed_m_per_s, sun * 32.1784579787363e-3, rounding * load.base_speed_m_per_s);
}

TEST(EhlFriction, CoefficientsAlongThePathsAreAsPrinted) {
  // docs/theory/friction.md, section 6: sp 0.0138 -> 0 -> 0.0124, rp 0.0014 -> 0.0043 -> 0.0031 at 10000 rpm and 400
  // kW. One unit of the last digit: 0.01235 and 0.00436 here.
  constexpr double digit = 1e-4;
  const std::vector<Case> all = cases();
  const auto mu = [](const Case& c, double position, double inside) {
    return xu_friction_coefficient(contact_at(c, position, inside));
  };
  const Case& sp = all[0];
  EXPECT_NEAR(mu(sp, 0.0, 0.01), 0.0138, digit);
  const double pitch = (sp.mesh.pair.pitch_arm_mm - sp.mesh.pair.start_mm) / sp.mesh.pair.base_pitch_mm;
  EXPECT_NEAR(mu(sp, pitch, pitch), 0.0, rounding);
  const double sp_end = sp.mesh.contact_ratio();
  EXPECT_NEAR(mu(sp, sp_end, sp_end - 0.01), 0.0124, digit);
  const Case& rp = all[1];
  const double rp_end = rp.mesh.contact_ratio();
  EXPECT_NEAR(mu(rp, 0.0, 0.01), 0.0014, digit);
  EXPECT_NEAR(mu(rp, rp_end, rp_end - 0.01), 0.0031, digit);
  double greatest = 0.0;
  for (double x = 0.0; x < rp_end; x += 0.001) greatest = std::max(greatest, mu(rp, x, x));
  EXPECT_NEAR(greatest, 0.0043, digit);
}

TEST(EhlFriction, PressuresAreAsPrinted) {
  // docs/theory/friction.md, section 6: P_h 0.35-0.52 and 0.16-0.32 GPa. The last is 0.3205 at the start of single
  // contact, where F / b = 65.95 N/mm meet on R = 23.13 mm.
  constexpr double digit = 0.005001;
  for (const Case& c : cases()) {
    double least = 1e9;
    double greatest = 0.0;
    const double end = c.mesh.contact_ratio();
    for (int k = 0; k <= 2000; ++k) {
      const double position = end * (0.0005 + 0.999 * k / 2000.0);
      const double p = contact_at(c, position, position).pressure_GPa;
      least = std::min(least, p);
      greatest = std::max(greatest, p);
    }
    const bool ring = c.line.internal;
    EXPECT_NEAR(least, ring ? 0.16 : 0.35, digit) << c.name;
    EXPECT_NEAR(greatest, ring ? 0.3205 : 0.52, digit) << c.name;
  }
}

TEST(EhlFriction, SpeedsOfAContactAreThoseOfThePair) {
  const MeshLoad load = load_at_10000_rpm();
  for (const Case& c : cases())
    for (const double position : {0.0, 0.4, 1.1}) {
      const LubricatedContact contact = lubricated_contact(c.ehl, c.line, load, position, 1.0);
      const ContactSpeeds v = contact_speeds(c.mesh.pair, c.mesh.arm_mm(position), load.base_speed_m_per_s);
      EXPECT_NEAR(contact.rolling_m_per_s, v.rolling(), rounding * v.rolling());
      EXPECT_NEAR(contact.slide_to_roll, v.sliding() / v.rolling(), rounding);
      EXPECT_NEAR(contact.radius_m * 1e3, c.mesh.pair.curvature_radius_mm(c.mesh.arm_mm(position)), rounding * 1e3);
      EXPECT_EQ(contact.viscosity_mPas, 5.0);
      EXPECT_EQ(contact.roughness_um, 0.6);
    }
}

TEST(EhlFriction, ForcesOpposeTheSlidingAllAlongThePath) {
  // One pair at a time: a table whose contact ratio is 1 has no second pair, so A is f_j.
  for (const Case& c : cases()) {
    EhlFriction one = c.ehl;
    one.contact_ratio = 1.0;
    one.share_position.clear();
    one.share.clear();
    for (const double start : {0.0, 0.1, 0.19}) {
      one.path_start_mm = c.ehl.path_start_mm + start * c.line.base_pitch_mm;
      const FrictionTable t = friction_table(one, c.line, load_at_10000_rpm());
      for (std::size_t k = 1; k < t.phase.size(); ++k) {
        const double arm = one.path_start_mm + c.line.base_pitch_mm * t.phase[k];
        EXPECT_LE(t.force_ratio[k] * c.line.sliding(arm), rounding) << c.name << " " << t.phase[k];
      }
    }
  }
}

TEST(EhlFriction, RatioOfTheRingMeshHasOneSign) {
  const Case ring = cases()[1];
  const FrictionTable t = friction_table(ring.ehl, ring.line, load_at_10000_rpm());
  for (const double a : t.force_ratio) EXPECT_LT(a, 0.0);
}

TEST(EhlFriction, RowsAreDirectSumsOverThePairsInContact) {
  for (const Case& c : cases()) {
    const FrictionTable t = friction_table(c.ehl, c.line, load_at_10000_rpm());
    const std::size_t n = t.phase.size();
    ASSERT_GT(n, 10U);
    for (std::size_t k = 0; k < n; ++k) {
      // The first row is the end of the period; of two rows of one phase the first is the left side.
      const double phase = k == 0 ? 1.0 : t.phase[k];
      const bool left = k == 0 || (k + 1 < n && t.phase[k + 1] == t.phase[k]);
      const double inside = phase + (left ? -1e-6 : 1e-6);
      double force = 0.0;
      double moment_1 = 0.0;
      double moment_2 = 0.0;
      for (int j = 0; inside + j < c.mesh.contact_ratio(); ++j) {
        const double position = std::min(phase + j, c.mesh.contact_ratio());
        const double share = c.mesh.load_share(position, inside + j);
        const LubricatedContact contact = lubricated_contact(c.ehl, c.line, load_at_10000_rpm(), position, share);
        const double f = (contact.slide_to_roll > 0.0 ? -1.0 : 1.0) * xu_friction_coefficient(contact);
        const double arm = c.ehl.path_start_mm + c.line.base_pitch_mm * position;
        force += share * f;
        moment_1 += share * f * arm;
        moment_2 += share * f * c.line.arm_2(arm);
      }
      EXPECT_NEAR(t.force_ratio[k], force, rounding) << c.name << " row " << k << " at " << t.phase[k];
      EXPECT_NEAR(t.moment_driving_mm[k], moment_1, 40.0 * rounding) << c.name << " row " << k;
      EXPECT_NEAR(t.moment_driven_mm[k], moment_2, 120.0 * rounding) << c.name << " row " << k;
    }
  }
}

TEST(EhlFriction, IsContinuousAtThePitchPoint) {
  const Case sun = cases()[0];
  const FrictionTable t = friction_table(sun.ehl, sun.line, load_at_10000_rpm());
  const double pitch = (sun.line.pitch_arm_mm - sun.ehl.path_start_mm) / sun.line.base_pitch_mm;
  std::size_t found = 0;
  for (std::size_t k = 1; k < t.phase.size(); ++k)
    if (t.phase[k] == t.phase[k - 1] && std::abs(t.phase[k] - pitch) < rounding) {
      EXPECT_NEAR(t.force_ratio[k], t.force_ratio[k - 1], rounding);
      EXPECT_NEAR(t.moment_driving_mm[k], t.moment_driving_mm[k - 1], 100.0 * rounding);
      EXPECT_NEAR(t.moment_driven_mm[k], t.moment_driven_mm[k - 1], 100.0 * rounding);
      // One pair is in contact there, and it does not slide.
      EXPECT_NEAR(t.force_ratio[k], 0.0, rounding);
      ++found;
    }
  EXPECT_EQ(found, 1U);
}

TEST(EhlFriction, LoadSharesAreThoseOfTheStiffness) {
  for (const Case& c : cases()) {
    const auto& x = c.ehl.share_position;
    ASSERT_EQ(x.size(), c.ehl.share.size());
    EXPECT_EQ(x.front(), 0.0);
    EXPECT_EQ(x.back(), c.mesh.contact_ratio());
    EXPECT_TRUE(std::is_sorted(x.begin(), x.end()));
    for (std::size_t k = 0; k < x.size(); ++k) {
      const bool left = k + 1 == x.size() || x[k + 1] == x[k];
      EXPECT_NEAR(c.ehl.share[k], c.mesh.load_share(x[k], x[k] + (left ? -1e-6 : 1e-6)), rounding) << c.name << x[k];
    }
  }
  // Three pairs: the path has five pieces.
  const EhlFriction tall = ehl_of(problems::tall_pair(), {});
  std::size_t jumps = 0;
  for (std::size_t k = 1; k < tall.share_position.size(); ++k)
    if (tall.share_position[k] == tall.share_position[k - 1]) ++jumps;
  EXPECT_EQ(jumps, 4U);
}

TEST(EhlFriction, NarrowFeaturesOfTheShareAreInTheTable) {
  // A dip to 60 % over 1 % and 0.1 % of a base pitch, where one pair carries the load alone.
  for (const Case& c : cases())
    for (const Interpolation interpolation : {Interpolation::linear, Interpolation::smooth})
      for (const double width : {1e-2, 1e-3}) {
        const double middle = 0.837;
        EhlFriction dip = c.ehl;
        dip.share_error.reset();
        dip.share_interpolation = interpolation;
        dip.share_position = {0.0, middle - 0.5 * width, middle, middle + 0.5 * width, dip.contact_ratio};
        dip.share = {1.0, 1.0, 0.6, 1.0, 1.0};
        const FrictionTable t = friction_table(dip, c.line, load_at_10000_rpm());
        const auto above = std::upper_bound(t.phase.begin(), t.phase.end(), middle);
        ASSERT_NE(above, t.phase.end());
        const auto k = static_cast<std::size_t>(above - t.phase.begin());
        EXPECT_LE(t.phase[k] - middle, 0.5 * width) << c.name;
        const LubricatedContact contact = lubricated_contact(dip, c.line, load_at_10000_rpm(), middle, 0.6);
        const double force = 0.6 * xu_friction_coefficient(contact);
        const double between = (middle - t.phase[k - 1]) / (t.phase[k] - t.phase[k - 1]);
        const double at_dip = t.force_ratio[k - 1] + between * (t.force_ratio[k] - t.force_ratio[k - 1]);
        EXPECT_NEAR(std::abs(at_dip), force, 0.05 * force) << c.name << ", width " << width;
      }
}

TEST(EhlFriction, WithoutShareTableThePairsShareEqually) {
  Case sun = cases()[0];
  sun.ehl.share_position.clear();
  sun.ehl.share.clear();
  const FrictionTable t = friction_table(sun.ehl, sun.line, load_at_10000_rpm());
  const double phase = t.phase[3];
  ASSERT_LT(phase, sun.mesh.contact_ratio() - 1.0);
  double force = 0.0;
  for (int j = 0; j < 2; ++j) {
    const LubricatedContact c = lubricated_contact(sun.ehl, sun.line, load_at_10000_rpm(), phase + j, 0.5);
    force += 0.5 * (c.slide_to_roll > 0.0 ? -1.0 : 1.0) * xu_friction_coefficient(c);
  }
  EXPECT_NEAR(t.force_ratio[3], force, rounding);
}

TEST(EhlFriction, TableFallsOffWithTheLoad) {
  // mu ~ P_h^(1.03 + ...): a mesh that carries nothing has no friction.
  const Case sun = cases()[0];
  const FrictionTable t = friction_table(sun.ehl, sun.line, {0.0, 25.0});
  for (const double a : t.force_ratio) EXPECT_EQ(a, 0.0);
}

}  // namespace
}  // namespace epicyclic::gear::ehl_friction_test
