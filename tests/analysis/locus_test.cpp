// Loci of special points in two parameters, and the points of codimension two on them, on systems with known answers.

#include "analysis/locus.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "core/errors.hpp"
#include "problems/harmonic_balance.hpp"
#include "problems/planes.hpp"

namespace epicyclic::analysis::locus_test {
namespace {

using problems::FieldPlane;

constexpr double tolerance = 1e-11;

// The tolerance of the finest family that bounds are from: what that one is off by they do not tell.
constexpr double finest = 0.1 * tolerance;

// What is located holds to what is asked of it, eight digits, and to its own bound.
constexpr double eight_digits = 1e-8;

/// Where a locus is found: on the branch over the first parameter, from an orbit on it.
struct Start {
  double first = 0, second = 0;
  std::vector<double> state;
  bool rising = true;
};

struct LocusProblem {
  std::string name;
  FieldPlane fields;
  SpecialKind kind = SpecialKind::fold;
  Start start;
  LocusOptions options;
  CyclicSymmetry symmetry{};
  int shooting_intervals = 1;
};

struct Followed {
  std::vector<LocusPoint> points;
  std::vector<Codim2Point> marks;
  LocusEnd end = LocusEnd::none;
  std::string message;
};

Followed follow(LocusTrace& trace) {
  Followed f;
  f.points.push_back(trace.current());
  while (trace.advance()) {
    f.points.push_back(trace.current());
    for (const Codim2Point& m : trace.marks()) f.marks.push_back(m);
  }
  f.end = trace.end();
  f.message = trace.state().message;
  return f;
}

/// A locus with what it starts from.
struct Located {
  OrbitSurface surface;
  LocusOptions options;
  LocusSubject subject;
  LocusPoint start;
  bool found = false;

  [[nodiscard]] LocusTrace trace(bool rising) const {
    return {surface, subject, options, rising ? start : reversed(start)};
  }
  [[nodiscard]] Followed follow(bool rising) const {
    LocusTrace way = trace(rising);
    return locus_test::follow(way);
  }
};

Located locate(const LocusProblem& problem, double to_tolerance = tolerance) {
  Located l;
  l.surface.flows = problems::plane_flows(problem.fields, to_tolerance);
  l.surface.family.symmetry = problem.symmetry;
  l.surface.family.shooting_intervals = problem.shooting_intervals;
  l.surface.family.residual = std::max(10.0 * to_tolerance, 1e-12);
  l.options = problem.options;
  l.options.others = problems::finer_planes(problem.fields, to_tolerance);
  const OrbitFamily family = l.surface.at(problem.start.second);
  const Correction first = first_orbit(family, problem.start.first, problem.start.state);
  EXPECT_TRUE(first.found) << problem.name << ": " << first.message;
  if (!first.found) return l;
  BranchOrbit from = first.orbit;
  if (!problem.start.rising) from.direction = -1.0 * from.direction;
  for (const SpecialPoint& p : problems::trace(family, problem.options.along, {}, from).special) {
    if (p.kind != problem.kind) continue;
    const LocusCorrection start = locus_start(l.surface, p, problem.start.second);
    EXPECT_TRUE(start.found) << problem.name << ": " << start.message;
    l.subject = subject_of(p);
    l.start = start.point;
    l.found = start.found;
    return l;
  }
  ADD_FAILURE() << problem.name << ": no " << to_string(problem.kind) << " to start from";
  return l;
}

LocusOptions rectangle(double first_from, double first_to, double from, double to) {
  return {.along = {.from = first_from, .to = first_to}, .second_from = from, .second_to = to};
}

void expect_at(const Codim2Point& m, CodimTwo kind, double first, double second, double known_to = 0.0) {
  EXPECT_EQ(to_string(m.kind), to_string(kind));
  EXPECT_LT(m.point.first_bound, eight_digits);
  EXPECT_LT(m.point.second_bound, eight_digits);
  EXPECT_NEAR(m.point.first(), first, m.point.first_bound + finest + known_to) << to_string(kind);
  EXPECT_NEAR(m.point.second(), second, m.point.second_bound + finest + known_to) << to_string(kind);
  EXPECT_TRUE(m.note.empty()) << m.note;
}

/// All points have e(p, q) = 0 to within their bounds.
/// @param slopes  |de/dp| and |de/dq| at most
void expect_on(const Followed& f, const std::function<double(const LocusPoint&)>& e, double slope_p, double slope_q) {
  for (const LocusPoint& p : f.points) {
    EXPECT_LT(p.first_bound, eight_digits);
    EXPECT_LT(p.second_bound, eight_digits);
    EXPECT_NEAR(e(p), 0.0, slope_p * p.first_bound + slope_q * p.second_bound + finest)
        << p.first() << ", " << p.second();
  }
}

double squared(double x) { return x * x; }

LocusProblem cusp_problem(int shooting_intervals) {
  LocusProblem problem{
      "cusp", problems::cusp_of_folds(), SpecialKind::fold, {0.9, 0.1, {0.11}, false}, rectangle(-1.0, 1.0, -1.0, 1.0)};
  problem.shooting_intervals = shooting_intervals;
  return problem;
}

TEST(Loci, FoldsPassTheirCuspAndEndAtTheEdges) {
  for (const int shooting_intervals : {1, 3}) {
    const Located l = locate(cusp_problem(shooting_intervals));
    ASSERT_TRUE(l.found);
    EXPECT_GT(l.start.direction.values(1), 0.0);
    for (const bool rising : {true, false}) {
      const Followed f = l.follow(rising);
      EXPECT_EQ(f.end, LocusEnd::range);
      EXPECT_EQ(f.points.back().first(), 1.0);
      const double edge = 2.0 / std::sqrt(27.0);
      EXPECT_NEAR(f.points.back().second(), rising ? edge : -edge, f.points.back().second_bound);
      expect_on(
          f, [](const LocusPoint& p) { return 4.0 * std::pow(p.first(), 3) - 27.0 * squared(p.second()); }, 12.0,
          54.0 * edge);
      ASSERT_EQ(f.marks.size(), rising ? 0U : 1U);
      if (!rising) expect_at(f.marks[0], CodimTwo::cusp, 0.0, 0.0);
    }
  }
}

TEST(Loci, FoldsPassOneToOneResonances) {
  const Located l = locate(
      {"1:1", problems::double_one(), SpecialKind::fold, {-0.05, 0.1, {0.72, 0.0}}, rectangle(-0.1, 0.1, -0.3, 0.3)});
  ASSERT_TRUE(l.found);
  const Followed f = l.follow(false);
  EXPECT_EQ(f.end, LocusEnd::range);
  EXPECT_EQ(f.points.back().second(), -0.3);
  expect_on(
      f, [](const LocusPoint& p) { return p.first() - 0.25 * squared(p.second()); }, 1.0, 0.15);
  ASSERT_EQ(f.marks.size(), 1U);
  expect_at(f.marks[0], CodimTwo::resonance_1_1, 0.0, 0.0);
}

TEST(Loci, NeimarkSackerPointsEndAtOneToOne) {
  const Located l = locate({"tori",
                            problems::double_one(),
                            SpecialKind::neimark_sacker,
                            {-0.002, -0.14, {0.987, 0.0}},
                            rectangle(-0.1, 0.1, -0.2, 0.3)});
  ASSERT_TRUE(l.found);
  const Followed f = l.follow(true);
  EXPECT_EQ(f.end, LocusEnd::resonance);
  expect_on(
      f, [](const LocusPoint& p) { return p.first(); }, 1.0, 0.0);
  ASSERT_EQ(f.marks.size(), 3U);
  expect_at(f.marks[0], CodimTwo::resonance_1_3, 0.0, -1.0 / 9.0);
  expect_at(f.marks[1], CodimTwo::resonance_1_4, 0.0, -1.0 / 16.0);
  expect_at(f.marks[2], CodimTwo::resonance_1_1, 0.0, 0.0);
  EXPECT_EQ(f.points.back().at.values, f.marks[2].point.at.values);
  // The angle 1:2 is not met within the rectangle.
  const Followed other = l.follow(false);
  EXPECT_EQ(other.end, LocusEnd::range);
  EXPECT_TRUE(other.marks.empty());
}

TEST(Loci, FlipsPassOneToTwoWhereNeimarkSackerPointsEnd) {
  const Located flips = locate({"flips",
                                problems::double_minus_one(),
                                SpecialKind::period_doubling,
                                {0.01, -0.1, {1.0, 0.0}, false},
                                rectangle(-0.1, 0.1, -0.2, 0.2)});
  ASSERT_TRUE(flips.found);
  const Followed f = flips.follow(true);
  EXPECT_EQ(f.end, LocusEnd::range);
  expect_on(
      f, [](const LocusPoint& p) { return p.first(); }, 1.0, 0.0);
  ASSERT_EQ(f.marks.size(), 1U);
  expect_at(f.marks[0], CodimTwo::resonance_1_2, 0.0, 0.0);

  const Located tori = locate({"tori beside",
                               problems::double_minus_one_turned(),
                               SpecialKind::neimark_sacker,
                               {-0.05, 0.1, {1.0, 0.0}},
                               rectangle(-0.1, 0.1, -0.1, 0.2)});
  ASSERT_TRUE(tori.found);
  const Followed t = tori.follow(false);
  EXPECT_EQ(t.end, LocusEnd::resonance);
  expect_on(
      t, [](const LocusPoint& p) { return p.first(); }, 1.0, 0.0);
  ASSERT_EQ(t.marks.size(), 3U);
  expect_at(t.marks[0], CodimTwo::resonance_1_4, 0.0, 1.0 / 16.0);
  expect_at(t.marks[1], CodimTwo::resonance_1_3, 0.0, 1.0 / 36.0);
  expect_at(t.marks[2], CodimTwo::resonance_1_2, 0.0, 0.0);
}

// Characteristic values of Mathieu's equation at q = 1, as docs/theory/published_results.md, section 4, has them to
// eight decimals.
constexpr double mathieu_a0 = -0.45513860;
constexpr double mathieu_b1 = -0.11024882;
constexpr double mathieu_a1 = 1.85910807;
constexpr double eighth_decimal = 0.5e-8;

TEST(Loci, MathieusFlipsAreAClosedCurveThroughHisCharacteristicValues) {
  Located l = locate({"Mathieu's flips",
                      problems::mathieu(),
                      SpecialKind::period_doubling,
                      {0.9, 0.5, {1.0, 0.0}, false},
                      rectangle(-1.0, 1.0, -1.0, 3.0)});
  ASSERT_TRUE(l.found);
  l.options.along.orbits = 200;  // twice around, if it were not known
  const Followed f = l.follow(true);
  EXPECT_EQ(f.end, LocusEnd::closed);
  EXPECT_EQ(f.points.back().at.values, f.points.front().at.values);
  ASSERT_EQ(f.marks.size(), 2U);
  expect_at(f.marks[0], CodimTwo::resonance_1_2, 0.0, mathieu_a1, eighth_decimal);
  expect_at(f.marks[1], CodimTwo::resonance_1_2, 0.0, mathieu_b1, eighth_decimal);
  // The trace of his monodromy is even in p.
  double least = 0.0, greatest = 0.0;
  for (const LocusPoint& p : f.points) {
    least = std::min(least, p.first());
    greatest = std::max(greatest, p.first());
  }
  constexpr double step = 0.02;  // of neighbours where the curve turns
  EXPECT_NEAR(least, -greatest, step);
}

TEST(Loci, MathieusNeimarkSackerPointsEndAtHisCharacteristicValues) {
  const Located l = locate({"Mathieu's tori",
                            problems::mathieu(),
                            SpecialKind::neimark_sacker,
                            {0.2, -0.3, {1.0, 0.0}, false},
                            rectangle(-1.0, 1.0, -1.0, 3.0)});
  ASSERT_TRUE(l.found);
  const Followed up = l.follow(true);
  EXPECT_EQ(up.end, LocusEnd::resonance);
  ASSERT_EQ(up.marks.size(), 2U);
  EXPECT_EQ(up.marks[0].kind, CodimTwo::resonance_1_3);
  expect_at(up.marks[1], CodimTwo::resonance_1_2, 0.0, mathieu_b1, eighth_decimal);
  const Followed down = l.follow(false);
  EXPECT_EQ(down.end, LocusEnd::resonance);
  ASSERT_EQ(down.marks.size(), 2U);
  EXPECT_EQ(down.marks[0].kind, CodimTwo::resonance_1_4);
  expect_at(down.marks[1], CodimTwo::resonance_1_1, 0.0, mathieu_a0, eighth_decimal);
}

TEST(Loci, OfFoldsAndOfOthersMeetWhereBothSay) {
  // Folds p = 3 w^2, q = -2 w^3 at p = 0.3.
  const double q = 2.0 * std::pow(0.1, 1.5);
  struct Case {
    FieldPlane fields;
    SpecialKind other;
    CodimTwo kind;
  };
  for (const Case& c : {Case{problems::folds_and_flips(), SpecialKind::period_doubling, CodimTwo::fold_period_doubling},
                        Case{problems::folds_and_tori(), SpecialKind::neimark_sacker, CodimTwo::fold_neimark_sacker}}) {
    const LocusOptions options = rectangle(-1.0, 0.5, -0.5, 0.5);
    const Located folds =
        locate({"folds", c.fields, SpecialKind::fold, {0.48, 0.08, {0.26, 0.0, 0.0}, false}, options});
    ASSERT_TRUE(folds.found);
    const Followed f = folds.follow(false);
    EXPECT_EQ(f.end, LocusEnd::range);
    ASSERT_EQ(f.marks.size(), 3U);
    expect_at(f.marks[0], c.kind, 0.3, q);
    expect_at(f.marks[1], CodimTwo::cusp, 0.0, 0.0);
    expect_at(f.marks[2], c.kind, 0.3, -q);
    // From the sheet of orbits above over both folds to that below.
    const Located others = locate({"others", c.fields, c.other, {0.4, 0.01, {1.64, 0.0, 0.0}, false}, options});
    ASSERT_TRUE(others.found);
    const Followed o = others.follow(false);
    EXPECT_EQ(o.end, LocusEnd::range);
    expect_on(
        o, [](const LocusPoint& p) { return p.first() - 0.3; }, 1.0, 0.0);
    ASSERT_EQ(o.marks.size(), 2U);
    expect_at(o.marks[0], c.kind, 0.3, -q);
    expect_at(o.marks[1], c.kind, 0.3, q);
  }
}

TEST(Loci, OfFlipsAndToriMeetWhereBothSay) {
  const LocusOptions options = rectangle(-0.1, 0.1, 0.0, 0.2);
  const std::vector<double> state = {1.0, 0.0, 0.0, 0.0};
  const Located flips =
      locate({"flips", problems::flips_and_tori(), SpecialKind::period_doubling, {-0.05, 0.05, state}, options});
  ASSERT_TRUE(flips.found);
  const Followed f = flips.follow(true);
  ASSERT_EQ(f.marks.size(), 1U);
  expect_at(f.marks[0], CodimTwo::period_doubling_neimark_sacker, 0.0, 0.1);
  const Located tori =
      locate({"tori", problems::flips_and_tori(), SpecialKind::neimark_sacker, {-0.05, 0.05, state}, options});
  ASSERT_TRUE(tori.found);
  const Followed t = tori.follow(true);
  expect_on(
      t, [](const LocusPoint& p) { return p.first() + p.second() - 0.1; }, 1.0, 1.0);
  ASSERT_EQ(t.marks.size(), 1U);
  expect_at(t.marks[0], CodimTwo::period_doubling_neimark_sacker, 0.0, 0.1);
}

template <std::size_t N>
LocusProblem alike_problem(SpecialKind kind, double tangent_derivative, double turn) {
  return {"alike parts",
          problems::alike_parts_over<N>(tangent_derivative, turn),
          kind,
          {-0.2, 0.1, std::vector<double>(N, 1.0)},
          rectangle(-0.3, 0.3, -0.3, 0.3),
          problems::moved_on(N)};
}

TEST(Loci, BranchPointsThatBreakASymmetryAreFollowed) {
  const auto expect_followed = [](const LocusProblem& problem) {
    const Located l = locate(problem);
    ASSERT_TRUE(l.found);
    EXPECT_EQ(l.subject.symmetry_index, 1);
    for (const bool rising : {true, false}) {
      const Followed f = l.follow(rising);
      EXPECT_EQ(f.end, LocusEnd::range);
      EXPECT_EQ(f.points.back().second(), rising ? 0.3 : -0.3);
      expect_on(
          f, [](const LocusPoint& p) { return p.first() - squared(p.second()); }, 1.0, 0.6);
      EXPECT_TRUE(f.marks.empty());
    }
  };
  expect_followed(alike_problem<2>(SpecialKind::branch_point, 1.0, 0.0));
  // Of three the block of the wave stands for two: one real multiplier there is a pair of the whole.
  expect_followed(alike_problem<3>(SpecialKind::branch_point, 1.0, 0.0));
}

TEST(Loci, NeimarkSackerPointsOfAWaveHaveTheirResonances) {
  const Located l = locate(alike_problem<3>(SpecialKind::neimark_sacker, 0.0, 1.0));
  ASSERT_TRUE(l.found);
  EXPECT_EQ(l.subject.symmetry_index, 1);
  const Followed f = l.follow(true);
  EXPECT_EQ(f.end, LocusEnd::range);
  expect_on(
      f, [](const LocusPoint& p) { return p.first(); }, 1.0, 0.0);
  ASSERT_EQ(f.marks.size(), 3U);
  // The angle is 2 pi q sqrt 3.
  expect_at(f.marks[0], CodimTwo::resonance_1_4, 0.0, 0.25 / std::numbers::sqrt3);
  expect_at(f.marks[1], CodimTwo::resonance_1_3, 0.0, 1.0 / 3.0 / std::numbers::sqrt3);
  expect_at(f.marks[2], CodimTwo::resonance_1_2, 0.0, 0.5 / std::numbers::sqrt3);
}

TEST(Loci, DuffingsFoldsAndTheirCuspAreThoseOfHarmonicBalance) {
  const FieldPlane fields = problems::duffing_over_frequency(0.1, 1.0);
  const Located l = locate(
      {"Duffing's folds",
       fields,
       SpecialKind::fold,
       {0.7, 0.3,
        problems::settled(problems::flows(problems::duffing_in_frequency(0.1, 1.0, 0.3), 1e-10), 0.7, {1.0, 0.0}, 200)},
       rectangle(0.6, 3.0, 0.05, 0.5)});
  ASSERT_TRUE(l.found);
  const Followed f = l.follow(false);
  EXPECT_EQ(f.end, LocusEnd::range);
  EXPECT_EQ(f.points.back().second(), 0.5);
  const auto by_balance = [&](const LocusPoint& p) {
    const auto flow = l.surface.flows(p.first(), p.second());
    const Eigen::VectorXd y = p.at.states.col(0);
    const std::vector<double> x = problems::over_a_period(*flow, y);
    constexpr double aside = 1e-4;
    std::vector<double> along = problems::over_a_period(*flow, y + aside * p.right);
    for (std::size_t i = 0; i < along.size(); ++i) along[i] -= x[i];
    return problems::HarmonicBalance::start(x, p.first(), along);
  };
  constexpr double balanced = 1e-12;  // differences between 16 and 20 harmonics
  for (std::size_t k = 0; k < f.points.size(); k += 8) {
    const LocusPoint& p = f.points[k];
    const double fold = problems::HarmonicBalance(0.1, p.second()).fold(by_balance(p));
    // On the locus W moves less than g.
    EXPECT_NEAR(p.first(), fold, p.first_bound + 10.0 * p.second_bound + balanced) << p.second();
  }
  ASSERT_EQ(f.marks.size(), 1U);
  const LocusPoint& cusp = f.marks[0].point;
  const auto [w, g] = problems::HarmonicBalance(0.1, cusp.second()).cusp(by_balance(cusp));
  expect_at(f.marks[0], CodimTwo::cusp, w, g, balanced);
}

TEST(Loci, DuffingsFlipsPassThePublishedOnes) {
  constexpr double tenth_decimal = 0.5e-10;
  constexpr double beside = 1.21;
  struct Published {
    int period;
    double start, g;
  };
  for (const Published& p : {Published{1, 0.22, 0.2655817861}, Published{2, 0.275, 0.2866931578}}) {
    const FieldPlane fields = problems::duffing_over_force(0.3, -1.0);
    OrbitSurface surface{problems::plane_flows(fields, tolerance)};
    surface.family.period = p.period;
    const OrbitFamily family = surface.at(beside);
    const Correction first =
        first_orbit(family, p.start + 0.01, problems::settled(family.flows, p.start + 0.01, {1.0, 0.0}, 400));
    ASSERT_TRUE(first.found);
    LocusOptions options = rectangle(0.2, 0.4, 1.2, 1.25);
    options.others = problems::finer_planes(fields, tolerance);
    const auto special = problems::trace(family, options.along, {}, first.orbit).special;
    const auto flip = std::find_if(special.begin(), special.end(), [](const SpecialPoint& q) {
      return q.kind == SpecialKind::period_doubling && q.outwards;
    });
    ASSERT_NE(flip, special.end());
    const LocusCorrection start = locus_start(surface, *flip, beside);
    ASSERT_TRUE(start.found) << start.message;
    LocusTrace trace(surface, subject_of(*flip), options, reversed(start.point));
    const Followed f = follow(trace);
    EXPECT_EQ(f.end, LocusEnd::range);
    EXPECT_EQ(f.points.back().second(), 1.2);
    EXPECT_LT(f.points.back().first_bound, eight_digits);
    EXPECT_NEAR(f.points.back().first(), p.g, f.points.back().first_bound + tenth_decimal);
  }
}

TEST(Loci, GrazingsOfTheClearanceOscillatorAreInClosedForm) {
  // Until the gap is reached the motion is linear, x = 1 + F_m + amplitude: it grazes where the amplitude is F_m.
  constexpr double contact_tolerance = 1e-10;
  const OrbitSurface surface{problems::clearance_plane(contact_tolerance)};
  const OrbitFamily family = surface.at(0.05);
  const Correction first = first_orbit(family, 0.5, problems::settled(family.flows, 0.5, {1.1, 0.0}, 100));
  ASSERT_TRUE(first.found);
  // At W = 1, the edge, x is least where periods, and the pieces of the orbit, begin.
  LocusOptions options = rectangle(0.4, 1.0, 0.005, 0.2);
  for (const int shooting_intervals : {1, 2})
    options.others.push_back({problems::clearance_plane(0.1 * contact_tolerance), shooting_intervals});
  ContinuationOptions until = options.along;
  until.to = 0.825;
  const auto special = problems::trace(family, until, {}, first.orbit).special;
  ASSERT_GE(special.size(), 1U);
  ASSERT_EQ(special[0].kind, SpecialKind::grazing);
  const LocusCorrection start = locus_start(surface, special[0], 0.05);
  ASSERT_TRUE(start.found) << start.message;
  for (const bool rising : {true, false}) {
    LocusTrace trace(surface, subject_of(special[0]), options, rising ? start.point : reversed(start.point));
    const Followed f = follow(trace);
    EXPECT_EQ(f.end, LocusEnd::range);
    EXPECT_EQ(rising ? f.points.back().second() : f.points.back().first(), rising ? 0.2 : 1.0);
    const problems::ClearanceConstants constants;
    // |dE/dW| is below 2 here.
    expect_on(
        f,
        [&](const LocusPoint& p) {
          const double w = p.first();
          return p.second() - constants.mean * std::hypot(1.0 - w * w, 2.0 * constants.z * w) / (w * w);
        },
        2.0, 1.0);
  }
}

TEST(Loci, KindsOfTheirMarksHaveNames) {
  const std::vector<std::string> names = {
      "cusp",      "resonance_1_1",       "resonance_1_2",       "resonance_1_3",   "resonance_1_4",
      "fold_flip", "fold_neimark_sacker", "flip_neimark_sacker", "double_crossing", "unresolved"};
  for (std::size_t k = 0; k < names.size(); ++k) EXPECT_EQ(to_string(static_cast<CodimTwo>(k)), names[k]);
}

TEST(Loci, GoOnWithTheSameBits) {
  const Located l = locate(cusp_problem(1));
  ASSERT_TRUE(l.found);
  LocusTrace whole = l.trace(false);
  LocusTrace first = l.trace(false);
  for (int k = 0; k < 4; ++k) {
    ASSERT_TRUE(whole.advance());
    ASSERT_TRUE(first.advance());
  }
  LocusTrace again = l.trace(false);
  again.restore(first.state());
  const Followed a = follow(whole);
  const Followed b = follow(again);
  EXPECT_EQ(a.end, b.end);
  ASSERT_EQ(a.points.size(), b.points.size());
  for (std::size_t k = 0; k < a.points.size(); ++k) {
    EXPECT_EQ(a.points[k].at.states, b.points[k].at.states);
    EXPECT_EQ(a.points[k].at.values, b.points[k].at.values);
    EXPECT_EQ(a.points[k].first_bound, b.points[k].first_bound);
  }
  ASSERT_EQ(a.marks.size(), b.marks.size());
  for (std::size_t k = 0; k < a.marks.size(); ++k) EXPECT_EQ(a.marks[k].point.at.values, b.marks[k].point.at.values);
}

TEST(Loci, StopAtAsManyPointsAsAskedForAndWhereNothingIsFound) {
  Located l = locate(cusp_problem(1));
  ASSERT_TRUE(l.found);
  l.options.along.orbits = 3;
  const Followed few = l.follow(true);
  EXPECT_EQ(few.end, LocusEnd::many);
  EXPECT_EQ(few.points.size(), 3U);
  l.options.along.orbits = 1000;
  // Beyond q = 0.3 there is no motion.
  l.surface.flows = [](double first, double second) {
    VectorField field = problems::cusp_of_folds()(first, second);
    if (second > 0.3) {
      field.right_hand_side = [](std::size_t, double, const double*, double* d) {
        d[0] = std::numeric_limits<double>::quiet_NaN();
      };
      field.tangents = [](std::size_t, double, const double*, const Columns<const double>&, double* d,
                          const Columns<double>&) { d[0] = std::numeric_limits<double>::quiet_NaN(); };
    }
    return integrate::make_flow(field, problems::exactly(tolerance));
  };
  const Followed f = l.follow(true);
  EXPECT_EQ(f.end, LocusEnd::min_step);
  EXPECT_FALSE(f.message.empty());
  constexpr double near = 1e-3;  // of the last step and of the differences beyond it
  EXPECT_NEAR(f.points.back().second(), 0.3, near);
}

TEST(Loci, AreRefusedWhereThereAreNone) {
  const Located l = locate(cusp_problem(1));
  ASSERT_TRUE(l.found);
  SpecialPoint point;
  point.kind = SpecialKind::branch_point;
  point.orbit.at.states = l.start.at.states;
  EXPECT_THROW((void)locus_start(l.surface, point, 0.1), InputError);
  point.kind = SpecialKind::unresolved;
  EXPECT_THROW((void)locus_start(l.surface, point, 0.1), InputError);
  point.kind = SpecialKind::period_doubling;
  point.symmetry_index = 1;
  EXPECT_THROW((void)locus_start(l.surface, point, 0.1), InputError);
  const auto refused = [&](const LocusOptions& options) {
    EXPECT_THROW(LocusTrace(l.surface, l.subject, options, l.start), InputError);
  };
  refused(rectangle(-1.0, 1.0, 0.5, 1.0));
  refused(rectangle(0.8, 1.0, -1.0, 1.0));
  refused(rectangle(-1.0, 1.0, 1.0, 1.0));
  LocusOptions unsafe = l.options;
  unsafe.safety = 0.5;
  refused(unsafe);
  OrbitSurface flat = l.surface;
  flat.second_scale = 0.0;
  EXPECT_THROW(flat.validate(), InputError);
  flat = l.surface;
  flat.gradient_step = 0.0;
  EXPECT_THROW(flat.validate(), InputError);
}

/// A locus by its equation, and where points of codimension two are on it.
struct KnownLocus {
  LocusProblem problem;
  std::function<double(const LocusPoint&)> equation;
  std::function<Eigen::Vector2d(const LocusPoint&)> slopes;  ///< of the equation
  std::vector<Eigen::Vector2d> marks;
};

std::vector<KnownLocus> known_loci() {
  const auto line = [](const LocusPoint& p) { return p.first(); };
  const auto along = [](const LocusPoint&) { return Eigen::Vector2d(1.0, 0.0); };
  std::vector<KnownLocus> all;
  all.push_back({cusp_problem(1),
                 [](const LocusPoint& p) { return 4.0 * std::pow(p.first(), 3) - 27.0 * squared(p.second()); },
                 [](const LocusPoint& p) { return Eigen::Vector2d(12.0 * squared(p.first()), -54.0 * p.second()); },
                 {{0.0, 0.0}}});
  all.push_back(
      {{"1:1", problems::double_one(), SpecialKind::fold, {-0.05, 0.1, {0.72, 0.0}}, rectangle(-0.1, 0.1, -0.3, 0.3)},
       [](const LocusPoint& p) { return p.first() - 0.25 * squared(p.second()); },
       [](const LocusPoint& p) { return Eigen::Vector2d(1.0, -0.5 * p.second()); },
       {{0.0, 0.0}}});
  all.push_back({{"tori",
                  problems::double_one(),
                  SpecialKind::neimark_sacker,
                  {-0.002, -0.14, {0.987, 0.0}},
                  rectangle(-0.1, 0.1, -0.2, 0.3)},
                 line,
                 along,
                 {{0.0, -1.0 / 9.0}, {0.0, -1.0 / 16.0}, {0.0, 0.0}}});
  all.push_back({{"flips",
                  problems::double_minus_one(),
                  SpecialKind::period_doubling,
                  {0.01, -0.1, {1.0, 0.0}, false},
                  rectangle(-0.1, 0.1, -0.2, 0.2)},
                 line,
                 along,
                 {{0.0, 0.0}}});
  const double q = 2.0 * std::pow(0.1, 1.5);
  all.push_back({{"flips over folds",
                  problems::folds_and_flips(),
                  SpecialKind::period_doubling,
                  {0.4, 0.01, {1.64, 0.0, 0.0}, false},
                  rectangle(-1.0, 0.5, -0.5, 0.5)},
                 [](const LocusPoint& p) { return p.first() - 0.3; },
                 along,
                 {{0.3, q}, {0.3, -q}}});
  all.push_back({alike_problem<2>(SpecialKind::branch_point, 1.0, 0.0),
                 [](const LocusPoint& p) { return p.first() - squared(p.second()); },
                 [](const LocusPoint& p) { return Eigen::Vector2d(1.0, -2.0 * p.second()); },
                 {}});
  all.push_back({alike_problem<3>(SpecialKind::neimark_sacker, 0.0, 1.0), line, along, {{0.0, 0.0}}});
  for (const double turns : {1.0 / 4.0, 1.0 / 3.0, 1.0 / 2.0})
    for (const double sign : {1.0, -1.0}) all.back().marks.emplace_back(0.0, sign * turns / std::numbers::sqrt3);
  return all;
}

TEST(LociLong, BoundsHoldAndAreNotIdle) {
  std::mt19937_64 random(2026);
  std::uniform_real_distribution<double> exponent(-10.0, -6.0);
  std::uniform_int_distribution<int> shooting_intervals(1, 3);
  std::size_t points = 0, points_outside = 0, marks = 0, marks_outside = 0, marks_unresolved = 0, strange = 0;
  std::vector<double> ratios;
  for (const KnownLocus& known : known_loci()) {
    constexpr int trials = 8;
    for (int trial = 0; trial < trials; ++trial) {
      LocusProblem problem = known.problem;
      problem.shooting_intervals = shooting_intervals(random);
      const Located l = locate(problem, std::pow(10.0, exponent(random)));
      ASSERT_TRUE(l.found);
      for (const bool rising : {true, false}) {
        const Followed f = l.follow(rising);
        EXPECT_NE(f.end, LocusEnd::min_step) << problem.name << ": " << f.message;
        for (const LocusPoint& p : f.points) {
          ++points;
          const Eigen::Vector2d s = known.slopes(p).cwiseAbs();
          const double bound = s(0) * p.first_bound + s(1) * p.second_bound;
          const double error = std::abs(known.equation(p));
          constexpr double rounding = 1e-14;
          if (!(error <= bound + rounding)) ++points_outside;
          if (error > rounding) ratios.push_back(bound / error);
        }
        for (const Codim2Point& m : f.marks) {
          if (m.kind == CodimTwo::unresolved) {
            ++marks_unresolved;
            continue;
          }
          const auto distance = [&](const Eigen::Vector2d& at) { return (m.point.at.values - at).norm(); };
          const auto truth = std::min_element(known.marks.begin(), known.marks.end(),
                                              [&](const auto& a, const auto& b) { return distance(a) < distance(b); });
          // No two are so near, and none is so far off.
          constexpr double another = 1e-3;
          if (truth == known.marks.end() || distance(*truth) > another) {
            ++strange;
            continue;
          }
          ++marks;
          const Eigen::Vector2d off = (m.point.at.values - *truth).cwiseAbs();
          constexpr double rounding = 1e-14;
          if (off(0) > m.point.first_bound + rounding || off(1) > m.point.second_bound + rounding) ++marks_outside;
        }
      }
    }
  }
  std::sort(ratios.begin(), ratios.end());
  const double median = ratios.at(ratios.size() / 2);
  RecordProperty("points", std::to_string(points));
  RecordProperty("points_outside", std::to_string(points_outside));
  RecordProperty("marks", std::to_string(marks));
  RecordProperty("marks_outside", std::to_string(marks_outside));
  RecordProperty("marks_unresolved", std::to_string(marks_unresolved));
  RecordProperty("median_ratio", std::to_string(median));
  EXPECT_GE(points, 1000U);
  EXPECT_LE(100 * points_outside, points);
  EXPECT_GE(marks, 60U);
  EXPECT_LE(100 * marks_outside, 2 * marks);
  EXPECT_LE(100 * marks_unresolved, 3 * marks);
  EXPECT_EQ(strange, 0U);
  EXPECT_LE(median, 100.0);
}

}  // namespace
}  // namespace epicyclic::analysis::locus_test
