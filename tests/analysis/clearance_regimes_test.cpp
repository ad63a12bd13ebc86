// Regimes of the clearance oscillator where they are easily told wrongly, beside what its exact solver says: near flips
// and folds, where M^n - I is nearly singular, and where motions are chaotic for long before they settle.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iostream>
#include <memory>
#include <numbers>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "analysis/regime.hpp"
#include "core/dense.hpp"
#include "core/largest_difference.hpp"
#include "integrate/make_flow.hpp"
#include "problems/clearance_exact.hpp"
#include "problems/clearance_points.hpp"
#include "problems/known_systems.hpp"
#include "problems/told_regimes.hpp"

namespace epicyclic::analysis::clearance_regimes_test {
namespace {

using problems::ClearancePoint;
using Exact = problems::BasicClearanceExact<double>;
using State = Exact::State;

/// What the exact solver says.
struct Truth {
  std::vector<int> periods;  ///< of the attractors that starts a hair apart end on; 0: none up to the longest
  double transient = 0;      ///< mean over the starts, until the motion is near its attractor for good [periods]
  double multiplier = 0;     ///< largest, modulus
};

constexpr int carried = 20000;
constexpr int longest_period = 16;

/// The period-n orbit next to a state by Newton's method with exact tangents; its multiplier, or infinity if there is
/// none within `near`.
double multiplier_of_orbit(const Exact& exact, const State& start, int n, double near) {
  constexpr double none = std::numeric_limits<double>::infinity();
  constexpr double rounding = 1e-12;  // of up to 16 periods in closed form
  State x = start;
  for (int k = 0; k < 12; ++k) {
    Exact::Matrix t = {1.0, 0.0, 0.0, 1.0};
    const State end = exact.periods(x, n, &t);
    Eigen::Matrix2d m;
    m << t[0], t[1], t[2], t[3];
    const Eigen::Vector2d f(end[0] - x[0], end[1] - x[1]);
    if (f.lpNorm<Eigen::Infinity>() < rounding) return epicyclic::eigenvalues(m).cwiseAbs().maxCoeff();
    const Eigen::Vector2d d = (Eigen::Matrix2d::Identity() - m).partialPivLu().solve(f);
    x = {x[0] + d(0), x[1] + d(1)};
    if (!(largest_difference(x, start) < near)) return none;
  }
  return none;
}

/// @param starts  1e-3 apart: chaos forgets that, other motions do not notice
Truth truth_of(const ClearancePoint& p, int starts) {
  const Exact exact(p.w, p.z, p.mean, p.e);
  Truth truth;
  for (int j = 0; j < starts; ++j) {
    std::vector<State> y = {{1.1 + 1e-3 * j, 0.0}};
    for (int k = 0; k < carried; ++k) y.push_back(exact.periods(y.back(), 1));
    const auto at = [&y](int k) -> const State& { return y[static_cast<std::size_t>(k)]; };
    int period = 0;
    constexpr double closed = 2e-3;  // what multipliers of 0.9995 leave of a transient is far less
    for (int n = 1; n <= longest_period && period == 0; ++n) {
      double error = 0.0;
      for (int k = carried - 64; k + n <= carried; ++k) error = std::max(error, largest_difference(at(k), at(k + n)));
      if (error > closed) continue;
      // The shortest orbit that attracts beside the motion's end.
      for (int d = 1; d <= n && period == 0; ++d) {
        const double multiplier = n % d == 0 ? multiplier_of_orbit(exact, y.back(), d, closed) : 1.0;
        if (multiplier >= 1.0) continue;
        period = d;
        truth.multiplier = std::max(truth.multiplier, multiplier);
      }
    }
    if (std::find(truth.periods.begin(), truth.periods.end(), period) == truth.periods.end())
      truth.periods.push_back(period);
    if (period == 0) continue;
    constexpr double near = 0.05;
    int k = carried;
    while (k > 0 && largest_difference(at(k - 1), at(carried - (carried - k + 1) % period)) < near) --k;
    truth.transient += static_cast<double>(k) / starts;
  }
  return truth;
}

struct Told {
  Classification result;
  long work = 0;  ///< right-hand sides
};

/// As a sweep does it: looks at a looser tolerance, orbits by flows that control tangents, at the tolerance and at ten
/// times it.
Told tell(const ClearancePoint& p) {
  const auto field = problems::clearance_oscillator(p.w, 0.0, {p.z, p.mean, p.e});
  const auto flow_at = [&](double tolerance, bool controlled) {
    integrate::IntegratorOptions o;
    o.relative_tolerance = o.absolute_tolerance = tolerance;
    o.max_steps_per_period = 1000000;
    o.tangent_error_control = controlled;
    return integrate::make_flow(field, o);
  };
  constexpr double tolerance = 1e-9;
  const auto windows = flow_at(100.0 * tolerance, false);
  const auto exact = flow_at(tolerance, true);
  const auto coarser = flow_at(10.0 * tolerance, true);
  RegimeOptions options;
  options.exact = exact.get();
  options.coarser = coarser.get();
  options.residual = 3.0 * tolerance;
  options.longest_period = longest_period;
  State y = {1.1, 0.0};
  Told told{classify(*windows, y, options, [] { return true; }), 0};
  for (const auto* flow : {&windows, &exact, &coarser}) told.work += (*flow)->right_hand_side_calls();
  return told;
}

std::string text(const ClearancePoint& p) {
  return "z " + std::to_string(p.z) + " F " + std::to_string(p.mean) + " E " + std::to_string(p.e) + " W " +
         std::to_string(p.w);
}

std::string text(const Classification& c) {
  return to_string(c.regime) + " " + std::to_string(c.period) + " (" + c.evidence.note + ", after " +
         std::to_string(c.evidence.periods) + " periods)";
}

/// Which of several attractors chaos leads to is a matter of rounding: then it may be another one, if the exact solver
/// says that it is there and attracts.
bool is_right(const ClearancePoint& p, const Truth& truth, const Classification& c) {
  if (std::find(truth.periods.begin(), truth.periods.end(), c.period) != truth.periods.end()) return true;
  if (truth.transient < 100.0) return false;
  const Exact exact(p.w, p.z, p.mean, p.e);
  const State found = {c.orbit->state[0], c.orbit->state[1]};
  constexpr double near = 1e-4;
  for (int d = 1; d < c.period; ++d)
    if (c.period % d == 0 && multiplier_of_orbit(exact, found, d, near) < 1.0) return false;
  return multiplier_of_orbit(exact, found, c.period, near) < 1.0;
}

struct Score {
  int wrong = 0;
  int undecided = 0;
  int points = 0;
};

/// @param starts  of the truth
Score score(std::span<const ClearancePoint> points, int starts, const std::function<void(const Truth&)>& belongs) {
  Score s;
  for (const ClearancePoint& p : points) {
    const Truth truth = truth_of(p, starts);
    {
      SCOPED_TRACE(text(p));
      belongs(truth);
    }
    const Classification c = tell(p).result;
    ++s.points;
    if (c.regime == Regime::periodic && is_right(p, truth, c)) continue;
    (c.regime == Regime::undecided ? s.undecided : s.wrong) += 1;
    std::cout << text(p) << ": period " << truth.periods.front() << " (multiplier " << truth.multiplier
              << ", transient " << truth.transient << ") told " << text(c) << "\n";
  }
  std::cout << s.points << " points: " << s.wrong << " wrong, " << s.undecided << " undecided\n";
  return s;
}

void near_one(const Truth& truth) {
  EXPECT_GT(truth.periods.front(), 0);
  EXPECT_GT(truth.multiplier, 0.95);
  EXPECT_LT(truth.multiplier, 0.9998);
}

/// How long chaos lasts is a matter of chance, of rounding in the end: with a mean of a quarter of the budget, most end
/// within its half.
void settles_late(const Truth& truth) {
  EXPECT_GT(truth.periods.front(), 0);
  EXPECT_LT(truth.transient, 0.25 * RegimeOptions{}.budget);
}

TEST(ClearanceRegimes, NearAFlipThePeriodIsThatOfTheOrbit) {
  // Those that outside use found: periods 1, 1, 1, 2, 2, 2, each told twice as long.
  const Score s = score(std::span(problems::near_flips_and_folds).first(6), 1, near_one);
  EXPECT_EQ(s.wrong + s.undecided, 0);
}

TEST(ClearanceRegimes, AnOrbitSaysHowFarItMayBeOff) {
  for (const ClearancePoint& p : std::span(problems::near_flips_and_folds).first(6)) {
    const Classification c = tell(p).result;
    ASSERT_TRUE(c.orbit.has_value()) << text(p) << ": " << text(c);
    const Exact exact(p.w, p.z, p.mean, p.e);
    State settled = {1.1, 0.0};
    settled = exact.periods(settled, carried);
    // The motion may have come to another point of the orbit than the one that was found.
    double off = std::numeric_limits<double>::infinity();
    for (int k = 0; k < 100 * c.period; ++k) {
      settled = exact.periods(settled, c.period);
    }
    for (int k = 0; k < c.period; ++k) {
      settled = exact.periods(settled, 1);
      off = std::min(off, largest_difference(settled, c.orbit->state));
    }
    // What a multiplier of 0.9996 leaves of the motion after 20 000 periods.
    const double left = 2.0 * std::pow(c.evidence.largest_multiplier, carried / c.period);
    EXPECT_LT(off, c.evidence.orbit_error + left) << text(p) << ": " << text(c);
    EXPECT_GT(c.evidence.orbit_error, 0.0);
    constexpr double held_up = 1e-5;  // the tolerance of 1e-9 over what multipliers leave of 1, 4e-4, some steps
    EXPECT_LT(c.evidence.orbit_error, held_up) << text(p);
  }
}

TEST(ClearanceRegimes, ATransientIsNotChaos) {
  // Those that outside use found.
  const Score s = score(std::span(problems::chaotic_at_first).first(2), 1, [](const Truth&) {});
  EXPECT_EQ(s.wrong + s.undecided, 0);
}

// The rule of validation/regimes/README.md: at most 1 % wrong, at most 3 % undecided, of 200 points.
TEST(ClearanceRegimesLong, TwoHundredPointsNearFlipsFoldsAndWithTransients) {
  constexpr int starts = 6;
  const Score flips = score(problems::near_flips_and_folds, 1, near_one);
  const Score transients = score(problems::chaotic_at_first, starts, settles_late);
  EXPECT_EQ(flips.points + transients.points, 200);
  EXPECT_LE(100 * (flips.wrong + transients.wrong), flips.points + transients.points);
  EXPECT_LE(100 * (flips.undecided + transients.undecided), 3 * (flips.points + transients.points));
}

/// Of drawn points: how many are told otherwise than the exact solver has it.
Score score_of(std::span<const problems::HardPoint> points, double tolerance) {
  Score s;
  for (const problems::HardPoint& p : points) {
    const Classification c = problems::told_regime(p.at, p.start, tolerance).result;
    const problems::Verdict verdict = problems::verdict(p, c);
    ++s.points;
    if (verdict == problems::Verdict::right) continue;
    (verdict == problems::Verdict::undecided ? s.undecided : s.wrong) += 1;
    std::cout << tolerance << ", " << to_string(p.kind) << ", " << text(p.at) << " x " << p.start[0] << " v "
              << p.start[1] << ": period " << p.truth.period << " (multiplier " << p.truth.multiplier << ") told "
              << text(c) << "\n";
  }
  return s;
}

/// The seed of all drawn points, of the short test and of the long one.
constexpr std::uint64_t seed = 6262;

std::vector<problems::HardPoint> drawn(std::size_t count) {
  std::vector<problems::HardPoint> points;
  for (std::size_t n = 0; n < count; ++n) points.push_back(problems::hard_point(seed, n));
  return points;
}

TEST(ClearanceHardPoints, AnAttackFromOutsideFindsTheOrbitsOfTheExactSolver) {
  // Next to flips and folds, where a torus, chaos, twice the period or nothing at all was told.
  constexpr double z = 0.06;
  std::vector<problems::HardPoint> points;
  for (const auto& [at, start] : {std::pair{ClearancePoint{z, 0.12, 0.25, 1.046536849}, State{0.830963, 0.059196}},
                                  {ClearancePoint{0.025, 0.08, 0.15, 0.615898296}, State{1.038710, 0.0795}},
                                  {ClearancePoint{0.025, 0.08, 0.15, 0.596659890}, State{1.0120, 0.0882}},
                                  {ClearancePoint{z, 0.12, 0.25, 0.858845355}, State{0.1817, 0.2073}},
                                  {ClearancePoint{0.04, 0.15, 0.12, 1.033463179}, State{0.5168, 0.3422}}}) {
    points.push_back({.at = at, .start = start, .truth = problems::hard_points::truth_of(at, start)});
    EXPECT_GT(points.back().truth.period, 0);
  }
  for (const double tolerance : {1e-8, 1e-10}) {
    const Score s = score_of(points, tolerance);
    EXPECT_EQ(s.wrong + s.undecided, 0) << tolerance;
  }
}

/// The first ten points of the seed and their starts: to draw them takes longer than the test.
constexpr std::array<std::pair<ClearancePoint, State>, 10> first_drawn = {{
    {{0.035794197093027384, 0.14637537061158382, 0.098505569963990278, 0.59735109710215639},
     {0.2524293010817073, 0.061182979187490792}},
    {{0.028201374117019735, 0.14837264603750067, 0.1190917202682676, 1.4778687324060606},
     {1.0265812979618532, -0.12168634454157348}},
    {{0.02184167929472669, 0.12055344638547551, 0.28353485308136883, 1.6805725456459293},
     {-1.4575370249304878, 0.048717332934017095}},
    {{0.031450122231936238, 0.053073465150295568, 0.2676175650314993, 0.5263169035209504},
     {1.7858907824658556, 0.40272453492118188}},
    {{0.048289142433444392, 0.054549357114721191, 0.089747144068516152, 1.3996685065779435},
     {-0.47238097616120456, 0.25079861667716474}},
    {{0.067469280897592701, 0.11488726883316142, 0.17147780935833368, 0.56644116851392212},
     {0.28291955126362178, 0.030733575560381435}},
    {{0.048500585990206124, 0.12603255390590229, 0.19570965226058185, 1.2943591875452387},
     {-0.9374691767289548, -0.19543043879369321}},
    {{0.06485532267609953, 0.11228412496263043, 0.17081048044568231, 0.94857055285660419},
     {0.86394819836888814, -0.29518491730847524}},
    {{0.027247921019390824, 0.053559923034857432, 0.25830790231074979, 1.658329618397314},
     {0.53501996975291721, 0.16907776424870524}},
    {{0.040908900143654392, 0.089325296002204832, 0.097056671599947034, 1.5653533897809193},
     {0.73886233835468573, -0.48155692135631667}},
}};

TEST(ClearanceHardPoints, DrawnOnesAreToldAsTheExactSolverHasThem) {
  std::vector<problems::HardPoint> points;
  for (const auto& [at, start] : first_drawn)
    points.push_back({.at = at, .start = start, .truth = problems::hard_points::truth_of(at, start)});
  const Score s = score_of(points, 1e-8);
  EXPECT_EQ(s.wrong + s.undecided, 0);
}

// The rule of validation/regimes/README.md: at most 1 % wrong, at most 3 % undecided, at each tolerance.
TEST(ClearanceHardPointsLong, ThreeHundredDrawnOnesAtThreeTolerances) {
  const std::vector<problems::HardPoint> points = drawn(300);
  constexpr double rounding = 1e-9;
  for (std::size_t n = 0; n < first_drawn.size(); ++n) {
    EXPECT_NEAR(points[n].at.w, first_drawn[n].first.w, rounding) << n;
    EXPECT_LT(largest_difference(points[n].start, first_drawn[n].second), rounding) << n;
  }
  for (const double tolerance : {1e-8, 1e-10, 1e-12}) {
    const Score s = score_of(points, tolerance);
    std::cout << tolerance << ": " << s.points << " points, " << s.wrong << " wrong, " << s.undecided << " undecided\n";
    EXPECT_LE(100 * s.wrong, s.points) << tolerance;
    EXPECT_LE(100 * s.undecided, 3 * s.points) << tolerance;
  }
}

}  // namespace
}  // namespace epicyclic::analysis::clearance_regimes_test
