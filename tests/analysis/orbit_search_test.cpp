// Orbits that exist side by side: on systems where it is known which there are.

#include "analysis/orbit_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "analysis/branch_switching.hpp"
#include "core/dense.hpp"
#include "core/errors.hpp"
#include "problems/branches.hpp"
#include "problems/clearance_exact.hpp"
#include "problems/known_systems.hpp"

namespace epicyclic::analysis::orbit_search_test {
namespace {

using problems::flows;

constexpr double tolerance = 1e-11;

// The residual asked for over the least distance of a multiplier from 1.
constexpr double solved = 1e-8;

// The integrator's tolerance times what it grows by in half a period of chaos, at most some hundred times.
constexpr double mirrored = 1e-6;

double distance(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) { return (a - b).lpNorm<Eigen::Infinity>(); }

/// Sum over the points of all orbits whose periods divide n of the sign of det(I - M^(n / period)): the degree of
/// y - P^n(y) on a disk that P^n maps into itself, which is 1.
int degree(const std::vector<FoundOrbit>& orbits, int n) {
  int sum = 0;
  for (const FoundOrbit& f : orbits) {
    if (n % f.family.period != 0) continue;
    double det = 1.0;
    std::complex<double> product = 1.0;
    for (const auto& x : eigenvalues(f.orbit.monodromy)) product *= 1.0 - std::pow(x, n / f.family.period);
    det = product.real();
    sum += f.family.period * f.images * (det > 0.0 ? 1 : -1);
  }
  return sum;
}

void expect_same(const OrbitSearch& a, const OrbitSearch& b) {
  ASSERT_EQ(a.orbits.size(), b.orbits.size());
  for (std::size_t k = 0; k < a.orbits.size(); ++k) {
    EXPECT_EQ(a.orbits[k].family.period, b.orbits[k].family.period);
    EXPECT_EQ(a.orbits[k].orbit.at.states, b.orbits[k].orbit.at.states);
    EXPECT_EQ(a.orbits[k].multiplier_max, b.orbits[k].multiplier_max);
    EXPECT_EQ(a.orbits[k].starts.size(), b.orbits[k].starts.size());
  }
}

// Between its folds at 1.324 and 1.780.
constexpr double between_duffings_folds = 1.5;

TEST(OrbitSearch, FindsDuffingsThreeOrbitsBetweenItsFolds) {
  const OrbitFamily family{flows(problems::duffing_in_frequency(0.1, 1.0, 0.3), tolerance)};
  const auto starts = starts_in_box(std::array{0.0, 0.0}, std::array{2.0, 3.0}, 12);
  const OrbitSearch search = search_orbits(family, between_duffings_folds, starts);
  ASSERT_EQ(search.orbits.size(), 3U);
  EXPECT_EQ(degree(search.orbits, 1), 1);

  // The branch passes here three times.
  const Correction first = first_orbit(family, 0.6, problems::settled(family.flows, 0.6, {1.0, 0.0}, 100));
  ASSERT_TRUE(first.found);
  const problems::Traced branch =
      problems::trace(family, {.from = 0.5, .to = 2.5, .values = {between_duffings_folds}}, {}, first.orbit);
  std::size_t passed = 0, unstable = 0;
  for (const BranchOrbit& o : branch.orbits) {
    if (o.at.value != between_duffings_folds) continue;
    ++passed;
    const auto same = std::find_if(search.orbits.begin(), search.orbits.end(), [&](const FoundOrbit& f) {
      return distance(f.orbit.at.states, o.at.states) < solved;
    });
    ASSERT_NE(same, search.orbits.end());
    EXPECT_EQ(same->stable(), o.direction.value > 0.0);  // between the folds it goes back
    unstable += static_cast<std::size_t>(same->unstable);
  }
  EXPECT_EQ(passed, 3U);
  EXPECT_EQ(unstable, 1U);
}

TEST(OrbitSearch, StartsThatLeadToOneOrbitLeadToTheOthersByDeflation) {
  const OrbitFamily family{flows(problems::duffing_in_frequency(0.1, 1.0, 0.3), tolerance)};
  const auto starts = starts_in_box(std::array{-0.2, 0.0}, std::array{0.2, 0.2}, 12);
  const OrbitSearch plain = search_orbits(family, between_duffings_folds, starts, {.rounds = 0});
  ASSERT_EQ(plain.orbits.size(), 1U);
  EXPECT_EQ(plain.orbits[0].starts.size(), starts.size());
  const OrbitSearch deflated = search_orbits(family, between_duffings_folds, starts, {.rounds = 1});
  EXPECT_EQ(deflated.orbits.size(), 3U);
  EXPECT_EQ(degree(deflated.orbits, 1), 1);
}

TEST(OrbitSearch, IsTheSameForAnyOrderOfStartsAndNumberOfThreads) {
  const OrbitFamily family{flows(problems::duffing_in_frequency(0.1, 1.0, 0.3), 1e-9)};
  auto starts = starts_in_box(std::array{0.0, 0.0}, std::array{2.0, 3.0}, 8);
  const SearchOptions options{.largest_period = 2, .return_periods = 10};
  const OrbitSearch search = search_orbits(family, between_duffings_folds, starts, options);
  SearchOptions threaded = options;
  threaded.threads = 3;
  const OrbitSearch by_threads = search_orbits(family, between_duffings_folds, starts, threaded);
  expect_same(search, by_threads);
  EXPECT_EQ(search.evaluations, by_threads.evaluations);
  std::reverse(starts.begin(), starts.end());
  std::swap(starts[1], starts[4]);
  expect_same(search, search_orbits(family, between_duffings_folds, starts, options));
}

TEST(OrbitSearch, ABranchGoesOnFromEachOrbit) {
  const OrbitFamily family{flows(problems::duffing_in_frequency(0.1, 1.0, 0.3), tolerance)};
  const auto starts = starts_in_box(std::array{0.0, 0.0}, std::array{2.0, 3.0}, 12);
  const OrbitSearch search = search_orbits(family, between_duffings_folds, starts);
  for (const FoundOrbit& f : search.orbits) {
    Continuation branch(f.family, {.from = 1.4, .to = 1.6}, f.orbit);
    while (branch.advance()) {
    }
    EXPECT_EQ(branch.end(), BranchEnd::range);
    EXPECT_EQ(branch.current().at.value, 1.6);
  }
}

TEST(OrbitSearch, ImagesOfThreeAlikePartsAreOneOrbit) {
  // In w = y - cos s the system is autonomous, with equilibria at 0, at (a, -a, 0), a^2 = p, and near (2, -1, -1) and
  // their negatives: cyclic shifts make three of each but the first, and the two orders of (a, -a, 0) are not shifts.
  OrbitFamily family{flows(problems::alike_parts<3>(), tolerance)};
  family.symmetry = problems::moved_on(3);
  family.keeps_symmetry = false;
  constexpr double p = 0.05;
  const auto starts = starts_in_box(std::array{1.0, 1.0, 1.0}, std::array{0.4, 0.4, 0.4}, 30);
  const OrbitSearch search = search_orbits(family, p, starts);
  ASSERT_EQ(search.orbits.size(), 5U);
  int opposite = 0;
  for (const FoundOrbit& f : search.orbits) {
    const Eigen::VectorXd w = f.orbit.at.states.col(0).array() - 1.0;
    EXPECT_EQ(f.images, f.keeps_symmetry() ? 1 : 3);
    EXPECT_EQ(f.keeps_symmetry(), w.lpNorm<Eigen::Infinity>() < solved);
    // Multipliers exp(2 pi mu), mu of the Jacobian of the equilibrium.
    Eigen::MatrixXd j = Eigen::MatrixXd::Constant(3, 3, -(p + 1.0) / 3.0);
    for (Eigen::Index i = 0; i < 3; ++i) j(i, i) += p - 3.0 * w(i) * w(i);
    const Eigen::VectorXd rates = symmetric_modes(j).values;
    EXPECT_EQ(f.unstable, (rates.array() > 0.0).count());
    EXPECT_NEAR(f.multiplier_max, std::exp(2.0 * std::numbers::pi * rates.maxCoeff()), solved);
    Eigen::Vector3d sorted = w;
    std::sort(sorted.begin(), sorted.end());
    if (!f.keeps_symmetry() && std::abs(sorted(1)) < solved) {
      ++opposite;
      EXPECT_NEAR(sorted(2), std::sqrt(p), solved);
    }
  }
  EXPECT_EQ(opposite, 2);

  family.keeps_symmetry = true;
  EXPECT_EQ(search_orbits(family, p, starts).orbits.size(), 1U);
}

/// By the exact clearance oscillator's closed form.
void expect_closes(const FoundOrbit& f, double e) {
  const problems::ClearanceExact exact(f.orbit.at.value, 0.05, 0.1, e);
  const problems::ClearanceExact::State y = {f.orbit.at.states(0, 0), f.orbit.at.states(1, 0)};
  problems::ClearanceExact::Matrix m = {1.0, 0.0, 0.0, 1.0};
  const auto end = exact.periods(y, f.family.period, &m);
  EXPECT_NEAR(end[0], y[0], solved);
  EXPECT_NEAR(end[1], y[1], solved);
  const Eigen::MatrixXd closed{{m[0], m[1]}, {m[2], m[3]}};
  // Of a derivative: second ones times what the state is known to.
  constexpr double derived = 1e-6;
  EXPECT_NEAR(eigenvalues(closed).cwiseAbs().maxCoeff(), f.multiplier_max, derived * (1.0 + f.multiplier_max));
}

TEST(OrbitSearch, OfTheClearanceOscillatorOneOrbitStaysInContactAndTwoLoseIt) {
  constexpr double e = 0.05;
  constexpr double w = 0.77;  // past the fold that the orbits of lost contact begin at, before grazing
  const OrbitFamily family{problems::clearance_flows(e, tolerance)};
  const auto starts = starts_in_box(std::array{1.1, 0.0}, std::array{0.4, 0.4}, 12);
  const OrbitSearch search = search_orbits(family, w, starts);
  ASSERT_EQ(search.orbits.size(), 3U);
  EXPECT_EQ(degree(search.orbits, 1), 1);
  // In contact throughout x = 1 + F + Im(A e^(i s)), A = E W^2 / (1 - W^2 + 2 i z W).
  const std::complex<double> amplitude = e * w * w / std::complex<double>(1.0 - w * w, 2.0 * 0.05 * w);
  const Eigen::Vector2d linear(1.1 + amplitude.imag(), w * amplitude.real());
  int in_contact = 0;
  for (const FoundOrbit& f : search.orbits) {
    expect_closes(f, e);
    if (distance(f.orbit.at.states, linear) < solved) {
      ++in_contact;
      EXPECT_NEAR(f.multiplier_max, std::exp(-2.0 * std::numbers::pi * 0.05 / w), solved);
    }
  }
  EXPECT_EQ(in_contact, 1);
  EXPECT_EQ(std::count_if(search.orbits.begin(), search.orbits.end(), [](const FoundOrbit& f) { return f.stable(); }),
            2);
}

TEST(OrbitSearch, CountsAnOrbitAtItsLeastPeriodAndOnceForAllOfItsPeriods) {
  constexpr double e = 0.2;
  const OrbitFamily family{problems::clearance_flows(e, tolerance)};
  const auto starts = starts_in_box(std::array{1.1, 0.0}, std::array{2.0, 2.0}, 12);
  // Where the period-1 orbit has lost its stability at a flip.
  constexpr double w = 1.7;
  const OrbitSearch search = search_orbits(family, w, starts, {.largest_period = 2, .return_periods = 40});
  int once = 0, twice = 0;
  for (const FoundOrbit& f : search.orbits) {
    (f.family.period == 1 ? once : twice) += 1;
    expect_closes(f, e);
  }
  EXPECT_GE(once, 1);
  EXPECT_GE(twice, 1);
  EXPECT_EQ(degree(search.orbits, 1), 1);
  EXPECT_EQ(degree(search.orbits, 2), 1);
  // At n = 2 alone the same ones are found, those of period 1 as such.
  const OrbitSearch alone =
      search_orbits(family, w, starts, {.smallest_period = 2, .largest_period = 2, .return_periods = 40});
  ASSERT_EQ(alone.orbits.size(), search.orbits.size());
  for (std::size_t k = 0; k < alone.orbits.size(); ++k)
    EXPECT_EQ(alone.orbits[k].family.period, search.orbits[k].family.period);
}

TEST(OrbitSearch, TellsWhyAStartLedNowhere) {
  // w' < 0 everywhere: there is no orbit.
  const OrbitFamily family{flows(problems::closed_branch(), tolerance)};
  const auto starts = starts_in_box(std::array{1.0}, std::array{0.5}, 4);
  const OrbitSearch search = search_orbits(family, 1.2, starts);
  EXPECT_TRUE(search.orbits.empty());
  ASSERT_EQ(search.missed.size(), 4U);
  for (const MissedStart& m : search.missed) EXPECT_FALSE(m.message.empty()) << to_string(m.why);
  const std::vector<std::vector<double>> wrong = {{1.0, 2.0}};
  EXPECT_THROW((void)search_orbits(family, 0.0, wrong), InputError);
}

TEST(OrbitSearch, StartsAreTheSameEverywhere) {
  const auto starts = starts_in_box(std::array{1.0, -1.0}, std::array{0.5, 2.0}, 1000);
  EXPECT_EQ(starts[0], (std::vector<double>{1.0, -1.0}));
  // Published numbers of SplitMix64 from 1234567, in parts of 2^64.
  const auto known = starts_in_box(std::array{0.5, 0.5}, std::array{0.5, 0.5}, 2, 1234567);
  constexpr double rounding = 1e-15;
  EXPECT_NEAR(known[1][0], 6457827717110365317.0 * 0x1p-64, rounding);
  EXPECT_NEAR(known[1][1], 3203168211198807973.0 * 0x1p-64, rounding);
  double mean = 0.0;
  for (const auto& y : starts) {
    EXPECT_LE(std::abs(y[0] - 1.0), 0.5);
    EXPECT_LE(std::abs(y[1] + 1.0), 2.0);
    mean += y[1] / 1000.0;
  }
  // Four standard deviations of the mean of uniform numbers.
  EXPECT_NEAR(mean, -1.0, 4.0 * 2.0 / std::sqrt(3000.0));
  EXPECT_EQ(starts_in_box(std::array{1.0, -1.0}, std::array{0.5, 2.0}, 7)[6], starts[6]);
  EXPECT_THROW((void)starts_in_box(std::array{1.0}, std::array{0.5, 2.0}, 7), InputError);
}

TEST(OrbitSearchLong, OrbitsInChaosComeWithTheirMirrorImagesAndAsTheDegreeOfTheMapAsks) {
  // With x(t) the motion -x(t + T/2) is one, too: of even periods another one, since half of one is a whole number.
  const OrbitFamily family{flows(problems::duffing(0.3, -1.0, 1.2), 1e-10)};
  constexpr double g = 0.5;
  const auto starts = starts_in_box(std::array{0.0, 0.0}, std::array{1.6, 1.2}, 200);
  const OrbitSearch search = search_orbits(family, g, starts, {.largest_period = 2, .rounds = 1});
  EXPECT_EQ(degree(search.orbits, 1), 1);
  EXPECT_EQ(degree(search.orbits, 2), 1);
  std::size_t of_period_2 = 0;
  for (const FoundOrbit& f : search.orbits) {
    EXPECT_FALSE(f.stable());
    of_period_2 += f.family.period == 2 ? 1 : 0;
    const auto flow = family.flows(g);
    std::array<double, 2> y = {f.orbit.at.states(0, 0), f.orbit.at.states(1, 0)};
    const double period = flow->field().period;
    ASSERT_TRUE(flow->evolve(y, 0.0, 0.5 * period).reached());
    int images = 0;
    for (const FoundOrbit& other : search.orbits) {
      if (other.family.period != f.family.period) continue;
      Eigen::MatrixXd states = period_states(other.family, other.orbit.at);
      for (Eigen::Index k = 0; k < states.cols(); ++k)
        images += distance(states.col(k), Eigen::Vector2d(-y[0], -y[1])) < mirrored ? 1 : 0;
    }
    EXPECT_EQ(images, 1);
  }
  EXPECT_GE(of_period_2, 6U);
  EXPECT_EQ(of_period_2 % 2, 0U);
}

}  // namespace
}  // namespace epicyclic::analysis::orbit_search_test
