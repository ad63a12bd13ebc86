// Attractors of systems for which theory says how many there are and where they lead.

#include "analysis/attractors.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "core/errors.hpp"
#include "integrate/make_field.hpp"
#include "integrate/make_flow.hpp"
#include "problems/known_systems.hpp"

namespace epicyclic::analysis::attractors_test {
namespace {

constexpr double tolerance = 1e-9;
constexpr double map_error = 3e-9;  // what kinks and steps leave of an orbit: a few tolerances

bool always() { return true; }

AttractorRecord record_of(const VectorField& field, std::vector<double> y, bool by_orbit = true) {
  integrate::IntegratorOptions o;
  o.relative_tolerance = o.absolute_tolerance = tolerance;
  const auto flow = integrate::make_flow(field, o);
  const Strobe seen = strobe(
      *flow, y, {.transient_periods = 120, .recorded_periods = 128, .phases = 1}, [](auto&&...) {}, always);
  const Recurrence recurs = recurrence(seen.section, 16, 1e-6);
  if (!by_orbit)
    return record_of_section(seen.section, recurs.period > 0 ? Regime::periodic : Regime::undecided, recurs, {},
                             map_error);
  const Classification told = classify(*flow, y, {}, always, &seen.section);
  if (told.orbit) return record_of_orbit(*flow, *told.orbit, told.period, map_error);
  return record_of_section(seen.section, told.regime, recurs, told.evidence.exponent, map_error);
}

/// x'' + 0.25 x' - x + x^3 = 0.1 cos t: small orbits of period 1 in both wells, and nothing else.
const VectorField wells = problems::duffing(0.25, -1.0, 0.1, 1.0);

TEST(Attractors, TheDoubleWellHasTwoWhichItsSymmetryExchanges) {
  integrate::IntegratorOptions o;
  o.relative_tolerance = o.absolute_tolerance = tolerance;
  const auto flow = integrate::make_flow(wells, o);
  for (const bool by_orbit : {true, false}) {
    std::vector<AttractorRecord> records;
    std::vector<double> x_ends;
    constexpr int n = 5;
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        const std::vector<double> start = {-1.5 + 0.71 * i, -1.0 + 0.47 * j};
        records.push_back(record_of(wells, start, by_orbit));
        // (x, v, t) -> (-x, -v, t + T/2) takes solutions to solutions: the mirrored start, half a period later.
        std::vector<double> mirrored = {-start[0], -start[1]};
        flow->forget();
        ASSERT_TRUE(flow->evolve(mirrored, 0.5 * wells.period, wells.period).reached());
        records.push_back(record_of(wells, mirrored, by_orbit));
        x_ends.push_back(records[records.size() - 2].orbit.front());
      }
    const Attractors told = label_attractors(records);
    ASSERT_EQ(told.all.size(), 2U) << by_orbit;
    EXPECT_EQ(told.all[0].members.size(), records.size() / 2);
    for (std::size_t k = 0; k < records.size(); k += 2) {
      EXPECT_EQ(records[k].period(), 1U);
      EXPECT_EQ(told.number[k] + told.number[k + 1], 3U) << k;
      // By the well that the motion is in.
      const std::size_t in_well_of_first = x_ends[k / 2] * x_ends[0] > 0.0 ? 1 : 2;
      EXPECT_EQ(told.number[k], in_well_of_first) << k;
    }
    EXPECT_EQ(told.number[0], 1U);
  }
}

TEST(Attractors, OfOneOrbitAreOneFromAnyOfItsPoints) {
  // Duffing's period 4 at 0.29 and period 2 at 0.28, each from starts that end on different points of the orbit.
  for (const auto& [g, period] : {std::pair{0.28, 2U}, {0.29, 4U}}) {
    const auto field = problems::duffing(0.3, -1.0, g, 1.2);
    std::vector<AttractorRecord> records;
    std::vector<double> y = {1.0, 0.0};
    integrate::IntegratorOptions o;
    const auto flow = integrate::make_flow(field, o);
    for (unsigned k = 0; k < period; ++k) {
      records.push_back(record_of(field, y));
      ASSERT_EQ(records.back().period(), period);
      ASSERT_TRUE(flow->evolve(y, 0.0, field.period).reached());
    }
    // The starts are a period apart: so are the points, and the first ones differ.
    EXPECT_GT(std::abs(records[0].orbit[0] - records[1].orbit[0]), 0.01);
    const Attractors told = label_attractors(records);
    EXPECT_EQ(told.all.size(), 1U) << g;
    // A period of another number is another attractor.
    records.push_back(record_of(wells, {1.0, 0.0}));
    EXPECT_EQ(label_attractors(records).all.size(), 2U);
  }
}

TEST(Attractors, ImagesAreToldWhereASymmetryIsGiven) {
  // x'' + 0.4 x' - (1 + 0.2 cos 2t) x + x^3 = 0 in s = t, strobed each pi: x -> -x is a symmetry without a shift.
  const auto field = integrate::make_field(2, std::numbers::pi, [](std::size_t, double t, const auto* y, auto* d) {
    d[0] = y[1];
    d[1] = -0.4 * y[1] + (1.0 + 0.2 * std::cos(2.0 * t)) * y[0] - y[0] * y[0] * y[0];
  });
  const std::vector<AttractorRecord> records = {record_of(field, {-1.0, 0.1}), record_of(field, {1.0, 0.2})};
  const Symmetry mirror = [](std::span<const double> y) { return std::vector{-y[0], -y[1]}; };
  const Symmetry none = [](std::span<const double> y) { return std::vector{-y[0], y[1] + 1.0}; };
  const Attractors told = label_attractors(records, {}, std::vector{none, mirror});
  ASSERT_EQ(told.all.size(), 2U);
  EXPECT_EQ(told.all[0].image_of, 0U);
  EXPECT_EQ(told.all[1].image_of, 1U);
  EXPECT_EQ(told.all[1].image_by, 1U);
}

TEST(Attractors, ChaosIsOneFromAnyStart) {
  const auto field = problems::duffing(0.3, -1.0, 0.5, 1.2);
  std::vector<AttractorRecord> records;
  for (int k = 0; k < 12; ++k) {
    records.push_back(record_of(field, {0.2 * k - 1.2, 0.07 * (k % 5)}));
    EXPECT_EQ(records.back().regime, Regime::chaotic) << k;
  }
  EXPECT_EQ(label_attractors(records).all.size(), 1U);
}

TEST(Attractors, AreToldByStatisticsOnlyWhereADifferenceIsSignificant) {
  // Records of the same spread about different means: told apart by many points, left together by few.
  const auto record = [](double mean, std::size_t points, unsigned seed) {
    PoincareSection section;
    section.dimension = 1;
    unsigned x = seed;
    for (std::size_t k = 0; k < points; ++k) {
      x = 1664525U * x + 1013904223U;  // Numerical Recipes' generator: the same bytes everywhere
      section.states.push_back(mean + static_cast<double>(x >> 8U) / 16777216.0 - 0.5);
    }
    return record_of_section(section, Regime::chaotic, {}, {0.1, 0.01}, map_error);
  };
  const auto count = [&](double difference, std::size_t points) {
    std::vector<AttractorRecord> records;
    for (unsigned k = 0; k < 20; ++k) records.push_back(record(k % 2 == 0 ? 0.0 : difference, points, 17U + k));
    return label_attractors(records).all.size();
  };
  EXPECT_EQ(count(0.0, 128), 1U);
  EXPECT_EQ(count(1.0, 128), 2U);
  EXPECT_EQ(count(0.1, 32), 1U);
  EXPECT_EQ(count(0.4, 2048), 2U);
  // Less than a tenth of the deviation (0.29) is none, however long the records are.
  EXPECT_EQ(count(0.02, 2048), 1U);
}

TEST(Attractors, UndecidedMotionsAreOnNone) {
  const Attractors told = label_attractors(std::vector<AttractorRecord>(3));
  EXPECT_TRUE(told.all.empty());
  EXPECT_EQ(told.number, (std::vector<std::size_t>{0, 0, 0}));
  EXPECT_THROW((void)label_attractors({}, {.level = 0.0}), InputError);
  EXPECT_THROW((void)label_attractors({}, {.tolerance = 0.0}), InputError);
}

}  // namespace
}  // namespace epicyclic::analysis::attractors_test
