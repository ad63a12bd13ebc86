#include "gear/mesh_stiffness.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "gear/gear_set.hpp"
#include "problems/table1.hpp"

namespace epicyclic::gear::mesh_stiffness_test {
namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;
constexpr double rounding = 1e-14;

/// The set of Table 1, made once: its Fourier series is what takes time.
const GearSet& table1() {
  static const GearSet set = make_gear_set(problems::table1());
  return set;
}

/// Pairs with one or two, one to two with few teeth, and two or three teeth in contact.
std::vector<MeshedPair> meshes() {
  return {table1().sun_planet, table1().ring_planet, problems::tian_pair(), problems::tall_pair()};
}

/// Half a unit of the last of n significant digits of a printed number.
double digits(double printed, int n) {
  const double unit = std::pow(10.0, std::floor(std::log10(std::abs(printed))) - (n - 1));
  return 0.5001 * unit;
}

/// Composite trapezoid of one smooth piece of the period, by the pairs' own stiffness: no part of the library's
/// quadrature, no `inside`.
double trapezoid(const MeshedPair& mesh, const std::function<double(double)>& weight, int intervals) {
  const double ratio = mesh.contact_ratio();
  const double rest = ratio - std::floor(ratio);
  double sum = 0.0;
  for (const auto& [from, to] : {std::pair{0.0, rest}, std::pair{rest, 1.0}}) {
    const int pairs = static_cast<int>(std::floor(ratio)) + (from == 0.0 ? 1 : 0);
    for (int k = 0; k <= intervals; ++k) {
      const double phase = from + (to - from) * k / intervals;
      double stiffness = 0.0;
      for (int j = 0; j < pairs; ++j) stiffness += mesh.pair_stiffness(std::min(phase + j, ratio));
      sum += (k == 0 || k == intervals ? 0.5 : 1.0) * (to - from) / intervals * weight(phase) * stiffness;
    }
  }
  return sum;
}

TEST(MeshStiffness, RegressionCasesOfTwoPublishedPairs) {
  // docs/theory/gears.md, section 9.2: middle of single and of double contact, without and with the teeth's bodies,
  // h_f = 2.
  struct Row {
    MeshedPair mesh;
    double contact_ratio, single, twice, single_body, double_body;
  };
  const Row rows[] = {
      {problems::tian_pair(), 1.64563, 5.0442e8, 8.1611e8, 1.98458e8, 3.39796e8},
      {problems::yi_pair(), 1.55684, 8.4411e8, 1.34171e9, 3.38432e8, 5.67625e8},
  };
  // The first pair's numbers are those of samples up to 0.0014 periods off the middle, where its stiffness has a slope;
  // equal gears have none, and agree to all digits.
  constexpr double off_the_middle = 3e-5;
  const auto tolerance = [](const MeshedPair& mesh, double printed, int n) {
    const bool equal = mesh.driving.tooth.teeth == mesh.driven.tooth.teeth;
    return equal ? digits(printed, n) : off_the_middle * printed;
  };
  for (Row r : rows) {
    EXPECT_NEAR(r.mesh.contact_ratio(), r.contact_ratio, digits(r.contact_ratio, 6));
    const double twice_at = 0.5 * (r.mesh.contact_ratio() - 1.0);
    const double single_at = 0.5 * r.mesh.contact_ratio();
    EXPECT_NEAR(r.mesh.stiffness(single_at), r.single_body, tolerance(r.mesh, r.single_body, 6));
    EXPECT_NEAR(r.mesh.stiffness(twice_at), r.double_body, tolerance(r.mesh, r.double_body, 6));
    r.mesh.options.foundation = false;
    EXPECT_NEAR(r.mesh.stiffness(single_at), r.single, tolerance(r.mesh, r.single, 5));
    EXPECT_NEAR(r.mesh.stiffness(twice_at), r.twice, tolerance(r.mesh, r.twice, 5));
  }
}

TEST(MeshStiffness, OrderOfThatOfAPublishedSimulation) {
  // Yi et al. 2019 use 3.6228e8 and 6.5072e8 N/m by a method they do not name: within the +-30 % between such models.
  const MeshedPair mesh = problems::yi_pair();
  constexpr double between_models = 0.3;
  EXPECT_NEAR(mesh.stiffness(0.5 * mesh.contact_ratio()) / 3.6228e8, 1.0, between_models);
  EXPECT_NEAR(mesh.stiffness(0.5 * (mesh.contact_ratio() - 1.0)) / 6.5072e8, 1.0, between_models);
}

TEST(MeshStiffness, FourierCoefficientsOfTable1AreAsPrinted) {
  // docs/theory/parameters.md, section 3, Eq. (4) with its origin at the start of double contact; printed for
  // h_f = 1.44 of the planet. Units of the last digit: the page's radii and angles are rounded too.
  constexpr double units = 2.5;
  const auto tolerance = [](double printed, int n) { return 2.0 * units * digits(printed, n); };
  Stage stage = problems::table1();
  stage.catalogue->planet.body_radius_ratio = 1.44;
  const GearSet set = make_gear_set(stage);
  const FourierSeries& sp = set.sun_planet_stiffness;
  EXPECT_NEAR(sp.mean, 1.2589e9, tolerance(1.2589e9, 5));
  EXPECT_NEAR(sp.cosine[0], 1.6636e8, tolerance(1.6636e8, 5));
  EXPECT_NEAR(sp.sine[0], 1.2810e8, tolerance(1.2810e8, 5));
  EXPECT_NEAR(sp.cosine[1], 7.143e7, tolerance(7.143e7, 4));
  EXPECT_NEAR(sp.sine[1], 2.2474e8, tolerance(2.2474e8, 5));
  const FourierSeries& rp = set.ring_planet_stiffness;
  EXPECT_NEAR(rp.mean, 1.3165e9, tolerance(1.3165e9, 5));
  EXPECT_NEAR(rp.cosine[0], 2.0219e8, tolerance(2.0219e8, 5));
  EXPECT_NEAR(rp.sine[0], 1.0712e8, tolerance(1.0712e8, 5));
  EXPECT_NEAR(rp.cosine[1], 9.008e7, tolerance(9.008e7, 4));
  EXPECT_NEAR(rp.sine[1], 2.3471e8, tolerance(2.3471e8, 5));
}

TEST(MeshStiffness, RangesOfTable1AreAsPrinted) {
  // One unit of the last digit: between h_f = 1.44 of the page and 1.4375 of the bore.
  constexpr double unit = 1e6;
  const StiffnessRange sp = stiffness_range(table1().sun_planet);
  EXPECT_NEAR(sp.least, 0.998e9, unit);
  EXPECT_NEAR(sp.greatest, 1.820e9, unit);
  const StiffnessRange rp = stiffness_range(table1().ring_planet);
  EXPECT_NEAR(rp.least, 1.027e9, unit);
  EXPECT_NEAR(rp.greatest, 1.946e9, unit);
}

TEST(MeshStiffness, FourierCoefficientsAreThoseOfABruteForceTrapezoid) {
  for (const MeshedPair& mesh : {table1().sun_planet, problems::tall_pair()}) {
    const FourierSeries series = fourier_series(mesh, 3);
    const auto check = [&](double value, const std::function<double(double)>& weight, double scale) {
      const double coarse = trapezoid(mesh, weight, 64);
      const double fine = trapezoid(mesh, weight, 128);
      // Measured order: Romberg's first step leaves h^4.
      const double extrapolated = (4.0 * fine - coarse) / 3.0;
      constexpr double fourth_order = 2e-7;
      EXPECT_NEAR(value, scale * extrapolated, fourth_order * series.mean);
      constexpr double second_order = 1e-3;  // what the trapezoid has before it
      EXPECT_LE(std::abs(extrapolated - fine), second_order * series.mean);
    };
    check(
        series.mean, [](double) { return 1.0; }, 1.0);
    for (std::size_t h = 1; h <= 3; ++h) {
      const double w = two_pi * static_cast<double>(h);
      check(
          series.cosine[h - 1], [w](double p) { return std::cos(w * p); }, 2.0);
      check(
          series.sine[h - 1], [w](double p) { return std::sin(w * p); }, 2.0);
    }
  }
}

TEST(MeshStiffness, EnergyBeyondTheSeriesIsThatOfItsJumps) {
  // Parseval: what H harmonics leave of the mean square falls as sum J^2 / (2 pi^2 H) for jumps J.
  const MeshedPair& mesh = table1().sun_planet;
  const double rest = mesh.contact_ratio() - 1.0;
  double square = 0.0;
  constexpr int intervals = 200;
  for (const auto& [from, to] : {std::pair{0.0, rest}, std::pair{rest, 1.0}})
    for (int k = 0; k <= intervals; ++k) {
      const double k_at = mesh.stiffness(from + (to - from) * k / intervals, 0.5 * (from + to));
      const double simpson = k == 0 || k == intervals ? 1.0 : k % 2 == 1 ? 4.0 : 2.0;
      square += simpson * (to - from) / (3.0 * intervals) * k_at * k_at;
    }
  const double enters = mesh.stiffness(0.0, 0.5 * rest) - mesh.stiffness(1.0, 0.5 * (1.0 + rest));
  const double leaves = mesh.stiffness(rest, 0.5 * (1.0 + rest)) - mesh.stiffness(rest, 0.5 * rest);
  const FourierSeries series = fourier_series(mesh, 40);
  const auto left = [&](std::size_t harmonics) {
    double energy = series.mean * series.mean;
    for (std::size_t h = 0; h < harmonics; ++h)
      energy += 0.5 * (series.cosine[h] * series.cosine[h] + series.sine[h] * series.sine[h]);
    return square - energy;
  };
  // Beside the jumps' products, which oscillate, and the slopes' h^-4.
  constexpr double measured = 0.15;
  for (const std::size_t harmonics : {20U, 40U}) {
    const double law =
        (enters * enters + leaves * leaves) / (0.5 * two_pi * two_pi * (static_cast<double>(harmonics) + 0.5));
    EXPECT_NEAR(left(harmonics) / law, 1.0, measured) << harmonics;
  }
}

TEST(MeshStiffness, SeriesConvergesBetweenTheJumps) {
  // Tail of a jump J at distance d: |J| / (pi (H + 1) |sin pi d|), by Abel's summation; kinks and slopes add less.
  for (const MeshedPair& mesh : {table1().sun_planet, table1().ring_planet, problems::tian_pair()}) {
    const std::vector<double> breaks = mesh.breakpoints();
    ASSERT_EQ(breaks.size(), 2U);
    const double rest = breaks[1];
    const double enters = std::abs(mesh.stiffness(0.0, 0.5 * rest) - mesh.stiffness(1.0, 0.5 * (1.0 + rest)));
    const double leaves = std::abs(mesh.stiffness(rest, 0.5 * (1.0 + rest)) - mesh.stiffness(rest, 0.5 * rest));
    const FourierSeries series = fourier_series(mesh, 40);
    constexpr double slopes = 1.1;
    for (double phase = 0.015; phase < 1.0; phase += 0.03) {
      if (std::abs(phase - rest) < 0.02) continue;
      const double bound = (enters / std::abs(std::sin(0.5 * two_pi * phase)) +
                            leaves / std::abs(std::sin(0.5 * two_pi * (phase - rest)))) /
                           (0.5 * two_pi * 41.0);
      EXPECT_LE(std::abs(series.at(phase) - mesh.stiffness(phase)), slopes * bound) << phase;
    }
    // And at a jump the series is between both sides.
    constexpr double first_order = 0.02;
    EXPECT_NEAR(series.at(0.0), 0.5 * (mesh.stiffness(0.0, 0.5 * rest) + mesh.stiffness(1.0, 0.5 * (1.0 + rest))),
                first_order * series.mean);
  }
}

TEST(MeshStiffness, CoefficientsDoNotDependOnHowManyAreAskedFor) {
  const MeshedPair& mesh = table1().sun_planet;
  const FourierSeries two = fourier_series(mesh, 2);
  const FourierSeries many = fourier_series(mesh, 12);
  const FourierSeries none = fourier_series(mesh, 0);
  ASSERT_EQ(two.cosine.size(), 2U);
  EXPECT_TRUE(none.cosine.empty());
  EXPECT_NEAR(two.mean, many.mean, rounding * two.mean);
  EXPECT_NEAR(none.mean, many.mean, rounding * two.mean);
  for (std::size_t h = 0; h < 2; ++h) {
    EXPECT_NEAR(two.cosine[h], many.cosine[h], rounding * two.mean);
    EXPECT_NEAR(two.sine[h], many.sine[h], rounding * two.mean);
  }
}

TEST(MeshStiffness, SharesOfThePairsInContactSumToOne) {
  for (const MeshedPair& mesh : meshes()) {
    for (double phase = 0.0; phase < 1.0; phase += 0.0625) {
      double sum = 0.0;
      for (int j = 0; phase + j < mesh.contact_ratio(); ++j) {
        const double share = mesh.load_share(phase + j);
        EXPECT_GT(share, 0.0);
        EXPECT_LE(share, 1.0 + rounding);
        sum += share;
      }
      EXPECT_NEAR(sum, 1.0, 10.0 * rounding) << mesh.contact_ratio() << " at " << phase;
    }
  }
}

TEST(MeshStiffness, SharesGiveEveryPairTheSameDeformation) {
  const MeshedPair mesh = problems::tall_pair();
  const double phase = 0.05;
  for (int j = 0; j < 3; ++j)
    EXPECT_NEAR(mesh.load_share(phase + j) / mesh.pair_stiffness(phase + j), 1.0 / mesh.stiffness(phase),
                rounding / mesh.stiffness(phase));
}

TEST(MeshStiffness, TallTeethHaveTwoOrThreePairsInContact) {
  const MeshedPair mesh = problems::tall_pair();
  const double ratio = mesh.contact_ratio();
  ASSERT_GT(ratio, 2.0);
  ASSERT_LT(ratio, 3.0);
  ASSERT_GT(mesh.driving.tooth.thickness_at(mesh.driving.tooth.tip_radius_mm), 0.0);
  EXPECT_EQ(mesh.pairs_in_contact(0.5 * (ratio - 2.0)), 3);
  EXPECT_EQ(mesh.pairs_in_contact(0.5 * (ratio - 1.0)), 2);
  ASSERT_EQ(mesh.breakpoints().size(), 2U);
  EXPECT_NEAR(mesh.breakpoints()[1], ratio - 2.0, rounding * ratio);
  EXPECT_NEAR(mesh.stiffness(0.1), mesh.pair_stiffness(0.1) + mesh.pair_stiffness(1.1) + mesh.pair_stiffness(2.1),
              rounding * mesh.stiffness(0.1));
}

TEST(MeshStiffness, JumpsByOnePairAtItsBreakpoints) {
  for (const MeshedPair& mesh : meshes()) {
    const double rest = mesh.breakpoints()[1];
    const double inside_1 = 0.5 * rest;
    const double inside_2 = 0.5 * (1.0 + rest);
    const double scale = mesh.stiffness(0.0, inside_1);
    EXPECT_NEAR(mesh.stiffness(0.0, inside_1) - mesh.stiffness(1.0, inside_2), mesh.pair_stiffness(0.0),
                rounding * scale * 10.0);
    EXPECT_NEAR(mesh.stiffness(rest, inside_1) - mesh.stiffness(rest, inside_2),
                mesh.pair_stiffness(mesh.contact_ratio()), rounding * scale * 10.0);
  }
}

TEST(MeshStiffness, PairIsTheSumOfBothTeethInSeries) {
  const MeshedPair& mesh = table1().sun_planet;
  const double position = 0.6;
  const double l = mesh.pair.start_mm + position * mesh.pair.base_pitch_mm;
  const double sum = hertz_compliance(mesh.driving.material, 60.0) +
                     tooth_compliance(mesh.driving, mesh.pair.radius_1_mm(l), {}).sum() +
                     tooth_compliance(mesh.driven, mesh.pair.radius_2_mm(l), {}).sum();
  EXPECT_NEAR(mesh.pair_stiffness(position), 1.0 / sum, rounding / sum);
  MeshedPair rigid = mesh;
  rigid.options = {false, false, false, true, false, Fillet::none, RingFoundation::rigid, FoundationLever::centreline,
                   4};
  const double hertz = hertz_compliance(mesh.driving.material, 60.0);
  EXPECT_NEAR(rigid.pair_stiffness(position), 1.0 / hertz, rounding / hertz);
  rigid.options = mesh.options;
  rigid.options.hertz = false;
  EXPECT_NEAR(1.0 / mesh.pair_stiffness(position) - 1.0 / rigid.pair_stiffness(position), hertz, 10.0 * rounding / 1e9);
}

TEST(MeshStiffness, TheSmallerFaceWidthBears) {
  for (const MeshedPair& mesh : meshes()) {
    MeshedPair wider_driving = mesh;
    wider_driving.driving.tooth.width_mm *= 2.0;
    MeshedPair wider_driven = mesh;
    wider_driven.driven.tooth.width_mm *= 1.5;
    MeshedPair narrower = mesh;
    narrower.driven.tooth.width_mm *= 0.5;
    for (const double position : {0.1, 0.6}) {
      EXPECT_EQ(wider_driving.pair_stiffness(position), mesh.pair_stiffness(position));
      EXPECT_EQ(wider_driven.pair_stiffness(position), mesh.pair_stiffness(position));
      EXPECT_NEAR(narrower.pair_stiffness(position), 0.5 * mesh.pair_stiffness(position),
                  rounding * mesh.pair_stiffness(position));
    }
    EXPECT_EQ(iso_stiffness(wider_driving).mesh, iso_stiffness(mesh).mesh);
  }
}

TEST(MeshStiffness, EqualGearsAreSymmetricAlongThePath) {
  const MeshedPair mesh = problems::yi_pair();
  for (const double position : {0.0, 0.2, 0.7})
    EXPECT_NEAR(mesh.pair_stiffness(position), mesh.pair_stiffness(mesh.contact_ratio() - position),
                10.0 * rounding * mesh.pair_stiffness(position));
}

TEST(MeshStiffness, FactorScalesTheStiffnessAndLeavesTheShares) {
  const MeshedPair& mesh = table1().ring_planet;
  MeshedPair scaled = mesh;
  scaled.factor = 1.3;
  EXPECT_NEAR(scaled.stiffness(0.1), 1.3 * mesh.stiffness(0.1), rounding * mesh.stiffness(0.1));
  EXPECT_NEAR(fourier_series(scaled, 1).sine[0], 1.3 * fourier_series(mesh, 1).sine[0],
              rounding * table1().ring_planet_stiffness.mean);
  EXPECT_NEAR(scaled.load_share(0.1), mesh.load_share(0.1), rounding);
  Stage s = problems::table1();
  s.catalogue->stiffness.sun_planet_factor = 0.7;
  EXPECT_NEAR(make_gear_set(s).sun_planet_stiffness.mean, 0.7 * table1().sun_planet_stiffness.mean, rounding * 1e9);
}

TEST(MeshStiffness, RangeHoldsTheCurveAndIsReached) {
  for (const MeshedPair& mesh : meshes()) {
    const StiffnessRange range = stiffness_range(mesh);
    double least = 1e300;
    double greatest = 0.0;
    for (double phase = 0.0005; phase < 1.0; phase += 0.005) {
      least = std::min(least, mesh.stiffness(phase));
      greatest = std::max(greatest, mesh.stiffness(phase));
    }
    // The samples' distance to an extremum, squared.
    constexpr double second_order = 1e-4;
    EXPECT_LE(range.least, least * (1.0 + second_order));
    EXPECT_GE(range.greatest, greatest * (1.0 - second_order));
    constexpr double first_order = 5e-3;
    EXPECT_NEAR(range.least / least, 1.0, first_order);
    EXPECT_NEAR(range.greatest / greatest, 1.0, first_order);
  }
}

TEST(MeshStiffness, ContactRatioOfAWholeNumberMakesOnePieceWithoutAJumpOfItsOwn) {
  // The centre distance at which 20/20 teeth have a contact ratio of 1: one pair always, k = k_pair.
  MeshedPair mesh = problems::yi_pair();
  for (const double off : {0.0, 1e-11, -1e-11}) {
    mesh.pair.end_mm = mesh.pair.start_mm + (1.0 + off) * mesh.pair.base_pitch_mm;
    EXPECT_EQ(mesh.breakpoints(), std::vector<double>{0.0});
    EXPECT_EQ(mesh.pairs_in_contact(0.5), 1);
    const StiffnessRange range = stiffness_range(mesh);
    EXPECT_LT(range.greatest, 1.5 * mesh.pair_stiffness(0.5)) << off;
    const FourierSeries series = fourier_series(mesh, 1);
    EXPECT_GT(series.mean, range.least) << off;
    EXPECT_LT(series.mean, range.greatest) << off;
  }
}

TEST(MeshStiffness, RepeatsFromPeriodToPeriod) {
  const MeshedPair mesh = table1().sun_planet;
  for (const double phase : {0.0, 0.125, 0.25, 0.875}) {
    EXPECT_GT(mesh.stiffness(phase), 0.0);
    for (const double periods : {-3.0, 1.0, 1000.0}) {
      EXPECT_EQ(mesh.stiffness(phase + periods), mesh.stiffness(phase)) << phase << ' ' << periods;
      EXPECT_EQ(mesh.pairs_in_contact(phase + periods), mesh.pairs_in_contact(phase)) << phase << ' ' << periods;
    }
  }
}

TEST(IsoStiffness, SingleStiffnessOfTable1IsThatOfThePinionAndTheWheel) {
  // By hand from the standard's sum, the planet of 25 teeth as the pinion: c' 15.513 N/(mm um), 16.634 with the ring,
  // times C_B = (1 + 0.5 (1.2 - 1.25)) (1 + 0.02 (25 - 20)) = 1.0725 and, with the ring's 22.3 degrees, 1.046175.
  // docs/theory/gears.md, section 9.3.
  const IsoStiffness sp = iso_stiffness(table1().sun_planet);
  const IsoStiffness rp = iso_stiffness(table1().ring_planet);
  constexpr double third_digit = 0.5001e-3;
  EXPECT_NEAR(sp.single / 60e6, 15.513 * 1.0725, third_digit);
  EXPECT_NEAR(rp.single / 60e6, 16.634 * 1.046175, third_digit);
  EXPECT_EQ(rp.mesh, rp.single * (0.75 * table1().ring_planet.contact_ratio() + 0.25));
}

TEST(IsoStiffness, WhichGearDrivesDoesNotCount) {
  MeshedPair mesh = table1().sun_planet;
  const IsoStiffness forwards = iso_stiffness(mesh);
  std::swap(mesh.driving, mesh.driven);
  EXPECT_EQ(iso_stiffness(mesh).single, forwards.single);
}

TEST(IsoStiffness, EnergyMethodIsWithinTwoPercentOfIt) {
  // docs/theory/gears.md, section 7: single pair 0.998e9 and 1.027e9 N/m; c' b as above 0.9983e9 and 1.0441e9.
  const auto above = [](const MeshedPair& mesh) {
    return (stiffness_range(mesh).least / iso_stiffness(mesh).single - 1.0) * 100.0;
  };
  constexpr double digit = 0.1;
  EXPECT_NEAR(above(table1().sun_planet), -0.1, digit);
  EXPECT_NEAR(above(table1().ring_planet), -1.6, digit);
}

TEST(IsoStiffness, StandardSteelGearsHaveTheUsual14) {
  // ISO 6336-1: c' = 14 N/(mm um) is the value for gears without calculation, c_gamma 20; within some 10 %.
  const IsoStiffness iso = iso_stiffness(problems::tian_pair());
  constexpr double usual = 0.1;  // what the source says of it
  EXPECT_NEAR(iso.single / 16e6, 14.0, usual * 14.0);
  EXPECT_NEAR(iso.mesh / 16e6, 20.0, usual * 20.0);
}

}  // namespace
}  // namespace epicyclic::gear::mesh_stiffness_test
