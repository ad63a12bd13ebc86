// Orbits of systems that turn freely, beside the same systems in coordinates that do not.

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "analysis/bifurcation_diagram.hpp"
#include "analysis/orbit_search.hpp"
#include "core/errors.hpp"
#include "problems/branches.hpp"
#include "problems/free_rotation.hpp"

namespace epicyclic::analysis::neutral_directions_test {
namespace {

constexpr double tolerance = 1e-11;
constexpr double clearance_e = 0.2;

// What is located holds to eight digits, however it is reached.
constexpr double eight_digits = 1e-8;

Eigen::MatrixXd both_alike() { return Eigen::Vector4d(1.0, 1.0, 0.0, 0.0); }

OrbitFamily free_pair(double drift) {
  OrbitFamily family{problems::free_pair_flows(clearance_e, drift, tolerance)};
  family.neutral = both_alike();
  return family;
}

/// The orbit in contact at W = 0.3: r by the closed form, both bodies with half of its speed and half of the drift.
std::vector<double> in_contact(double drift) {
  const std::vector<double> r =
      problems::settled(problems::clearance_flows(clearance_e, tolerance), 0.3, {1.1, 0.0}, 100);
  return {r[0], 0.0, 0.5 * (drift + r[1]), 0.5 * (drift - r[1])};
}

std::vector<Branch> tree_from(const OrbitFamily& family, const std::vector<double>& state) {
  const Correction first = first_orbit(family, 0.3, state);
  EXPECT_TRUE(first.found) << first.message;
  BifurcationDiagram tree(family, {.continuation = {.from = 0.2, .to = 2.2}});
  if (first.found) tree.start(first.orbit);
  while (tree.advance()) {
  }
  return tree.branches();
}

TEST(NeutralDirections, BranchesOfAPairThatDriftsAreThoseOfItsRelativeMotion) {
  const std::vector<Branch> reduced =
      tree_from({problems::clearance_flows(clearance_e, tolerance)},
                problems::settled(problems::clearance_flows(clearance_e, tolerance), 0.3, {1.1, 0.0}, 100));
  const std::vector<Branch> whole = tree_from(free_pair(1.7), in_contact(1.7));
  ASSERT_EQ(reduced.size(), 3U);
  ASSERT_EQ(whole.size(), reduced.size());
  for (std::size_t b = 0; b < whole.size(); ++b) {
    EXPECT_EQ(whole[b].family.period, reduced[b].family.period);
    ASSERT_EQ(whole[b].special.size(), reduced[b].special.size());
    for (std::size_t k = 0; k < whole[b].special.size(); ++k) {
      EXPECT_EQ(to_string(whole[b].special[k].kind), to_string(reduced[b].special[k].kind));
      EXPECT_NEAR(whole[b].special[k].value, reduced[b].special[k].value, eight_digits);
    }
    EXPECT_EQ(whole[b].first.born, reduced[b].first.born);
    EXPECT_EQ(whole[b].last.born, reduced[b].last.born);
  }
}

TEST(NeutralDirections, LeaveOutTheirOwnMultiplierAlone) {
  const OrbitFamily family = free_pair(1.7);
  const Correction c = first_orbit(family, 0.3, in_contact(1.7));
  ASSERT_TRUE(c.found) << c.message;
  const auto multipliers = multipliers_of(family, c.orbit.monodromy);
  ASSERT_EQ(multipliers.size(), 3U);
  // exp(-2 pi d / W) of the sum of speeds, and the pair of modulus exp(-2 pi z / W).
  std::vector<double> moduli;
  for (const auto& x : multipliers) moduli.push_back(std::abs(x));
  std::sort(moduli.begin(), moduli.end());
  const double pair = std::exp(-2.0 * std::numbers::pi * 0.05 / 0.3);
  EXPECT_NEAR(moduli[0], pair, eight_digits);
  EXPECT_NEAR(moduli[1], pair, eight_digits);
  EXPECT_NEAR(moduli[2], std::exp(-2.0 * std::numbers::pi * 0.04 / 0.3), eight_digits);

  // It has gone on by its drift in a period.
  const auto flow = family.flows(0.3);
  Eigen::VectorXd y = c.orbit.at.states.col(0);
  ASSERT_TRUE(flow->evolve({y.data(), 4}, 0.0, 2.0 * std::numbers::pi).reached());
  const Eigen::VectorXd gone = y - c.orbit.at.states.col(0);
  const double expected = 0.5 * 1.7 * 2.0 * std::numbers::pi / 0.3;
  EXPECT_LT((gone - expected * both_alike()).lpNorm<Eigen::Infinity>(), eight_digits);
}

TEST(NeutralDirections, TheSearchFindsTheOrbitsOfTheRelativeMotion) {
  constexpr double w = 0.6;
  const OrbitSearch reduced =
      search_orbits({problems::clearance_flows(clearance_e, tolerance)}, w,
                    starts_in_box(std::array{1.1, 0.0}, std::array{1.0, 1.0}, 12), {.return_periods = 40, .rounds = 1});
  const OrbitSearch whole = search_orbits(
      free_pair(-0.6), w, starts_in_box(std::array{1.1, 0.0, -0.3, -0.3}, std::array{1.0, 0.3, 0.5, 0.5}, 12),
      {.return_periods = 40, .rounds = 1});
  ASSERT_EQ(whole.orbits.size(), reduced.orbits.size());
  for (const FoundOrbit& f : whole.orbits) {
    const Eigen::VectorXd y = f.orbit.at.states.col(0);
    const auto same = std::find_if(reduced.orbits.begin(), reduced.orbits.end(), [&](const FoundOrbit& g) {
      const Eigen::VectorXd r = g.orbit.at.states.col(0);
      return std::max(std::abs(y(0) - y(1) - r(0)), std::abs(y(2) - y(3) - r(1))) < eight_digits;
    });
    ASSERT_NE(same, reduced.orbits.end());
    EXPECT_EQ(f.unstable, same->unstable);
  }
}

TEST(NeutralDirections, OfAlikePartsLeaveTheWaveThatTheyAreIn) {
  OrbitFamily family{problems::flows(problems::free_ring(0.2, 0.3), tolerance)};
  family.neutral = (Eigen::VectorXd(6) << 1.0, 1.0, 1.0, 0.0, 0.0, 0.0).finished();
  family.symmetry = cyclic_symmetry(6, 3, [](std::span<const double> y) {
    std::vector<double> next(6);
    for (std::size_t i = 0; i < 3; ++i) {
      next[(i + 1) % 3] = y[i];
      next[3 + (i + 1) % 3] = y[3 + i];
    }
    return next;
  });
  const auto blocks = invariant_blocks(6, family.kept());
  ASSERT_EQ(blocks.size(), 2U);
  EXPECT_EQ(blocks[0].basis.cols(), 1);
  EXPECT_EQ(blocks[1].basis.cols(), 2);
  const Correction first = first_orbit(family, -0.1, std::vector<double>{0.0, 0.0, 0.0, 1.0, 1.0, 1.0});
  ASSERT_TRUE(first.found) << first.message;
  const auto alike = multipliers_of(blocks[0], first.orbit.monodromy);
  EXPECT_NEAR(alike[0].real(), std::exp(-0.4 * std::numbers::pi), eight_digits);
  const problems::Traced t = problems::trace(
      family, {.from = -0.1, .to = 0.02},
      problems::with_bounds(
          [](double to_tolerance) { return problems::flows(problems::free_ring(0.2, 0.3), to_tolerance); }, tolerance),
      first.orbit);
  ASSERT_EQ(t.special.size(), 1U);
  EXPECT_EQ(to_string(t.special[0].kind), "branch_point");
  EXPECT_EQ(t.special[0].symmetry_index, 1);
  constexpr double rounding = 1e-15;
  EXPECT_NEAR(t.special[0].value, 0.0, t.special[0].error_bound + rounding);
  EXPECT_LT(t.special[0].error_bound, eight_digits);
  EXPECT_EQ(t.end, BranchEnd::range);
}

TEST(NeutralDirections, AreAskedOfTheField) {
  OrbitFamily family = free_pair(0.0);
  const std::vector<double> state = in_contact(0.0);
  EXPECT_NO_THROW(check_neutral(family, 0.3, state));
  family.neutral = Eigen::Vector4d(1.0, 0.9, 0.0, 0.0);
  EXPECT_THROW(check_neutral(family, 0.3, state), InputError);
  EXPECT_THROW((void)first_orbit(family, 0.3, state), InputError);
  family.neutral = Eigen::Vector4d(0.0, 0.0, 1.0, 1.0);  // speeds are damped
  EXPECT_THROW(check_neutral(family, 0.3, state), InputError);
  family.neutral = Eigen::Vector3d(1.0, 1.0, 1.0);
  EXPECT_THROW(check_neutral(family, 0.3, state), InputError);
  family.neutral = Eigen::MatrixXd(4, 2);
  family.neutral << both_alike(), 2.0 * both_alike();
  EXPECT_THROW(check_neutral(family, 0.3, state), InputError);
}

}  // namespace
}  // namespace epicyclic::analysis::neutral_directions_test
