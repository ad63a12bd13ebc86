// Special points of orbits some of whose directions grow and decay by many orders of magnitude, or come in twos.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include <Eigen/LU>
#include <Eigen/QR>
#include <gtest/gtest.h>

#include "analysis/branch_switching.hpp"
#include "analysis/shooting.hpp"
#include "core/random_numbers.hpp"
#include "core/root_finding.hpp"
#include "integrate/make_field.hpp"
#include "problems/branches.hpp"

namespace epicyclic::analysis::hyperbolic_orbits_test {
namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;

/// x'' + c x' + (d + p cos s) x, of which the flips over p are known from two dimensions alone.
struct Mathieu {
  double c = 0.2;
  double d = 0.25;
  template <class P, class T>
  void operator()(const P& p, double s, const T* y, T* dyds) const {
    dyds[0] = y[1];
    dyds[1] = -1.0 * c * y[1] - (d + p * std::cos(s)) * y[0];
  }
};

FieldFamily alone(const Mathieu& m) {
  return integrate::make_field_family(
      2, two_pi, [m](const auto& p, std::size_t, double s, const auto* y, auto* dyds) { m(p, s, y, dyds); });
}

/// The same beside u' = r u and w' = -r w, all four mixed by a rotation of the space.
FieldFamily beside_a_saddle(const Mathieu& m, double r, const Eigen::Matrix4d& q) {
  return integrate::make_field_family(4, two_pi,
                                      [m, r, q](const auto& p, std::size_t, double s, const auto* y, auto* dyds) {
                                        using T = std::remove_cvref_t<decltype(dyds[0])>;
                                        std::array<T, 4> x{}, slope{};
                                        for (Eigen::Index i = 0; i < 4; ++i)
                                          for (Eigen::Index j = 0; j < 4; ++j)
                                            x[static_cast<std::size_t>(i)] += q(j, i) * y[j];
                                        slope[0] = r * x[0];
                                        slope[1] = -r * x[1];
                                        m(p, s, x.data() + 2, slope.data() + 2);
                                        for (Eigen::Index i = 0; i < 4; ++i) {
                                          dyds[i] = T(0.0);
                                          for (Eigen::Index j = 0; j < 4; ++j)
                                            dyds[i] += q(i, j) * slope[static_cast<std::size_t>(j)];
                                        }
                                      });
}

Eigen::Matrix4d random_rotation(std::uint64_t seed) {
  Eigen::Matrix4d any;
  std::uint64_t number = 0;
  for (double& x : any.reshaped()) x = random_uniform(seed, ++number) - 0.5;
  return Eigen::HouseholderQR<Eigen::Matrix4d>(any).householderQ();
}

/// Where a multiplier of the two-dimensional system is -1.
double flip_of(const Mathieu& m, double low, double high) {
  const integrate::FlowFamily flows = problems::flows(alone(m), 1e-13);
  return find_root(
      [&](double p) {
        Eigen::MatrixXd y = Eigen::MatrixXd::Zero(2, 1);
        const MatrixProduct monodromy = shoot(*flows(p), y, 1).monodromy();
        const Eigen::MatrixXd shifted = monodromy.factors[0] + Eigen::Matrix2d::Identity();
        return shifted.determinant();
      },
      low, high);
}

std::vector<SpecialPoint> points(const FieldFamily& fields, double low, double high, int shooting_intervals,
                                 double tolerance) {
  OrbitFamily family{problems::flows(fields, tolerance)};
  family.shooting_intervals = shooting_intervals;
  const std::vector<double> origin(fields(low).dimension, 0.0);
  const Correction a = first_orbit(family, low, origin);
  const Correction b = first_orbit(family, high, origin);
  EXPECT_TRUE(a.found && b.found);
  if (!a.found || !b.found) return {};
  return special_points_between(
      family, a.orbit, b.orbit,
      problems::with_bounds([&](double to) { return problems::flows(fields, to); }, tolerance));
}

/// The flip is there, alone, within its bound, or told to be between the two orbits.
void expect_flip(const std::vector<SpecialPoint>& found, double truth, double largest_bound, const std::string& what) {
  ASSERT_EQ(found.size(), 1U) << what;
  EXPECT_EQ(to_string(found[0].kind), "flip") << what;
  constexpr double known_to = 3e-12;  // tangents at a tolerance of 1e-13, over a thousand steps
  EXPECT_LE(std::abs(found[0].value - truth), found[0].error_bound + known_to) << what;
  EXPECT_LE(found[0].error_bound, largest_bound) << what;
}

TEST(HyperbolicOrbits, AFlipStaysWhereItIsWhateverGrowsBesideIt) {
  const Mathieu m;
  const double truth = flip_of(m, 0.15, 0.3);
  for (const double r : {1.0, 3.0, 5.0, 7.0})
    for (const int shooting_intervals : {3, 9}) {
      // Of a third of a period vectors part by e^(4 pi r / 3), 5e12 for r = 7: the tangents' own errors.
      const double bound = r * two_pi / shooting_intervals > 7.0 ? 1e-2 : 1e-6;
      expect_flip(
          points(beside_a_saddle(m, r, random_rotation(1)), truth - 0.05, truth + 0.03, shooting_intervals, 1e-11),
          truth, bound, "r = " + std::to_string(r) + ", " + std::to_string(shooting_intervals) + " pieces");
    }
}

void random_flips_are_within_their_bounds(std::uint64_t first, std::uint64_t count) {
  for (std::uint64_t k = first; k < first + count; ++k) {
    const auto draw = [k](std::uint64_t n) { return random_uniform(23, 16 * k + n); };
    const Mathieu m{0.05 + 0.1 * draw(0), 0.22 + 0.06 * draw(1)};
    const double r = 7.0 * draw(2);
    const int shooting_intervals =
        std::max(2, static_cast<int>(r * two_pi / 6.0) + 1 + static_cast<int>(4.0 * draw(3)));
    const double truth = flip_of(m, 0.03, 0.5);
    expect_flip(points(beside_a_saddle(m, r, random_rotation(100 + k)), truth - 0.02 - 0.02 * draw(4),
                       truth + 0.02 + 0.02 * draw(5), shooting_intervals, 1e-10),
                truth, 1e-5, "draw " + std::to_string(k));
    if (testing::Test::HasFailure()) return;
  }
}

TEST(HyperbolicOrbits, RandomFlipsAreWithinTheirBounds) { random_flips_are_within_their_bounds(0, 20); }
TEST(HyperbolicOrbitsLong, AThousandRandomFlipsAreWithinTheirBounds) { random_flips_are_within_their_bounds(20, 1000); }

/// Two parts x_i' = p x_i - x_i^3 that do not know of each other.
FieldFamily two_pitchforks(double second_scale) {
  return integrate::make_field_family(2, 1.0,
                                      [second_scale](const auto& p, std::size_t, double, const auto* y, auto* dyds) {
                                        for (int i = 0; i < 2; ++i)
                                          dyds[i] = p * y[i] - (i == 0 ? 1.0 : second_scale) * y[i] * y[i] * y[i];
                                      });
}

TEST(HyperbolicOrbits, TwoAlikePitchforksTogetherAreABranchPointOfNullityTwo) {
  const FieldFamily fields = two_pitchforks(1.0);
  const std::vector<SpecialPoint> found = points(fields, -0.021, 0.02, 1, 1e-11);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(to_string(found[0].kind), "branch_point");
  EXPECT_EQ(found[0].nullity, 2);
  EXPECT_EQ(found[0].resonance, 0);
  EXPECT_LE(std::abs(found[0].value), found[0].error_bound);
  EXPECT_LT(found[0].error_bound, 1e-8);
}

TEST(HyperbolicOrbits, FromABranchPointOfNullityTwoTheBranchesOfBothPartsAreFollowed) {
  const FieldFamily fields = two_pitchforks(1.0);
  const std::vector<SpecialPoint> found = points(fields, -0.021, 0.02, 1, 1e-11);
  ASSERT_EQ(found.size(), 1U);
  const std::vector<BranchSwitch> all = branch_switches({problems::flows(fields, 1e-11)}, found[0]);
  // (+-a, 0), (0, +-a), (+-a, +-a)
  EXPECT_EQ(all.size(), 8U);
  std::array<int, 2> alone{};
  for (const BranchSwitch& d : all) {
    const Eigen::VectorXd y = d.orbit.at.states.col(0);
    const double a = std::sqrt(d.orbit.at.value);
    constexpr double solved = 1e-8;
    for (Eigen::Index i = 0; i < 2; ++i) {
      EXPECT_LT(std::min(std::abs(y(i)), std::abs(std::abs(y(i)) - a)), solved);
      if (std::abs(y(i)) > solved && std::abs(y(1 - i)) < solved) ++alone[static_cast<std::size_t>(i)];
    }
  }
  EXPECT_EQ(alone, (std::array{2, 2}));
}

TEST(HyperbolicOrbits, OfAConservativeSystemNoPairLeavesTheCircle) {
  // Mathieu with q = 5 and a cubic term; a where the origin is stable.
  const FieldFamily fields = integrate::make_field_family(
      2, std::numbers::pi, [](const auto& a, std::size_t, double s, const auto* y, auto* dyds) {
        dyds[0] = y[1];
        dyds[1] = (10.0 * std::cos(2.0 * s) - a) * y[0] - 0.1 * y[0] * y[0] * y[0];
      });
  // Between a_1 = 1.858 and b_2 = 2.099, and between a_2 = 7.449 and b_3 = 9.237.
  for (const auto& [low, high] : {std::array{1.9, 2.05}, std::array{7.6, 9.1}}) {
    constexpr int steps = 12;
    for (int k = 0; k < steps; ++k) {
      const double from = low + (high - low) * k / steps;
      EXPECT_TRUE(points(fields, from, from + (high - low) / steps, 1, 1e-10).empty()) << from;
    }
  }
}

/// Of the clearance oscillator, whose orbit is one harmonic until it grazes: E W^2 = F_m |1 - W^2 + 2 i z W|.
TEST(HyperbolicOrbits, AGrazingIsWithinItsBoundOfTheClosedForm) {
  const problems::ClearanceConstants constants{.z = 0.03, .mean = 0.1, .e = 0.15};
  const double truth = find_root(
      [&](double w) { return constants.e * w * w - constants.mean * std::hypot(1.0 - w * w, 2.0 * constants.z * w); },
      0.5, 0.7);
  const auto flows = [&](double tolerance) {
    integrate::IntegratorOptions o = problems::exactly(tolerance);
    o.locate_contacts = true;
    return integrate::make_flow_family([=](double w) { return problems::clearance_oscillator(w, 0.0, constants); }, o);
  };
  for (const double tolerance : {1e-9, 1e-11, 1e-12}) {
    OrbitFamily family{flows(tolerance)};
    family.residual = 10.0 * tolerance;
    const std::vector<double> state = problems::settled(flows(1e-11), truth - 0.02, {1.1, 0.0}, 300);
    const Correction a = first_orbit(family, truth - 0.02, state);
    ASSERT_TRUE(a.found);
    const Correction b = correct_at(family, truth + 0.003, a.orbit.at.states);
    ASSERT_TRUE(b.found);
    const double finer = std::max(0.1 * tolerance, 3e-14);
    const std::vector<SpecialPoint> found = special_points_between(
        family, a.orbit, b.orbit,
        {.others = {{flows(finer), 1}, {flows(finer), 2}, {flows(std::max(0.1 * finer, 3e-14)), 1}},
         .branch_counts = false});
    const auto grazing =
        std::find_if(found.begin(), found.end(), [](const SpecialPoint& p) { return p.kind == SpecialKind::grazing; });
    ASSERT_NE(grazing, found.end()) << tolerance;
    EXPECT_LE(std::abs(grazing->value - truth), grazing->error_bound) << tolerance;
    EXPECT_LT(grazing->error_bound, 10.0 * tolerance) << tolerance;
  }
}

}  // namespace
}  // namespace epicyclic::analysis::hyperbolic_orbits_test
