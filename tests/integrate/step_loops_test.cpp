// The step control of lanes, one lane at a time, against its formula; on every instruction set that there is.

#include "integrate/lanes/step_loops.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "problems/lane_sets.hpp"

namespace epicyclic::integrate::step_loops_test {
namespace {

using problems::lane_sets;

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double none = std::numeric_limits<double>::quiet_NaN();
constexpr double bound = 1e6;

/// One lane of `steps` in lane `lane` of otherwise idle ones.
LaneSteps alone(const LaneSteps& one, std::size_t lane) {
  LaneSteps steps;
  steps.sample.fill(infinite);
  const auto move = [&](auto member) { (steps.*member)[lane] = (one.*member)[0]; };
  for (auto member : {&LaneSteps::s, &LaneSteps::stop, &LaneSteps::sample, &LaneSteps::proposed, &LaneSteps::hop,
                      &LaneSteps::h, &LaneSteps::end, &LaneSteps::norm, &LaneSteps::largest})
    move(member);
  for (auto member : {&LaneSteps::running, &LaneSteps::cut, &LaneSteps::hopping, &LaneSteps::refused,
                      &LaneSteps::attempts, &LaneSteps::allowed})
    move(member);
  return steps;
}

/// A step of length 0.5 at 1, with everything in order.
LaneSteps plain() {
  LaneSteps one;
  one.s[0] = 1.0;
  one.stop[0] = 4.0;
  one.sample[0] = infinite;
  one.proposed[0] = one.h[0] = 0.5;
  one.end[0] = 1.5;
  one.norm[0] = 0.01;
  one.largest[0] = 3.0;
  one.running[0] = -1;
  one.attempts[0] = 7;
  one.allowed[0] = 100;
  return one;
}

TEST(StepLoops, ProposeStepsByTheErrorsFifthRoot) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> exponent(-30.0, 3.0);
  constexpr double rounding = 1e-14;  // of a fifth root by Newton's method, and of its factors
  for (int k = 0; k < 2000; ++k) {
    LaneSteps one = plain();
    one.norm[0] = std::pow(10.0, exponent(random));
    const double norm = std::max(std::sqrt(one.norm[0]), 1e-10);
    const double wanted = 0.96 * std::pow(1.5 * norm, -0.2);
    double first_bits = 0.0;
    for (const StepLoops* kernels : lane_sets()) {
      const std::size_t lane = static_cast<std::size_t>(k) % kernels->width;
      LaneSteps steps = alone(one, lane);
      const LaneVerdict verdict = kernels->judge(steps, bound);
      EXPECT_NEAR(steps.wanted[lane], wanted, rounding * wanted) << kernels->name;
      if (kernels == lane_sets().front()) first_bits = steps.wanted[lane];
      EXPECT_EQ(steps.wanted[lane], first_bits) << kernels->name;
      EXPECT_EQ(steps.attempts[lane], 8);
      EXPECT_FALSE(verdict.eventful);
      if (one.norm[0] > 1.0) {
        EXPECT_EQ(verdict.accepted, 0U);
        EXPECT_EQ(steps.accepted[lane], 0);
        EXPECT_EQ(steps.refused[lane], -1);
        EXPECT_EQ(steps.proposed[lane], 0.5 * std::clamp(steps.wanted[lane], 0.1, 1.0));
        continue;
      }
      EXPECT_EQ(verdict.accepted, 1U);
      EXPECT_EQ(steps.accepted[lane], -1);
      EXPECT_EQ(steps.refused[lane], 0);
      const double grown = std::min(steps.wanted[lane], 20.0);
      EXPECT_EQ(steps.proposed[lane], 0.5 * (grown >= 1.0 && grown <= 1.5 ? 1.0 : grown));
    }
  }
}

/// `one` judged in the last lane, and what became of it in lane 0.
LaneSteps judged(const StepLoops& kernels, const LaneSteps& one) {
  const std::size_t lane = kernels.width - 1;
  LaneSteps steps = alone(one, lane);
  const LaneVerdict verdict = kernels.judge(steps, bound);
  EXPECT_EQ(verdict.eventful, steps.event[lane] != 0);
  EXPECT_EQ(verdict.accepted, steps.accepted[lane] != 0 ? 1U : 0U);
  for (auto member : {&LaneSteps::accepted, &LaneSteps::refused, &LaneSteps::hopping, &LaneSteps::event})
    (steps.*member)[0] = (steps.*member)[lane];
  for (auto member : {&LaneSteps::proposed, &LaneSteps::hop}) (steps.*member)[0] = (steps.*member)[lane];
  return steps;
}

TEST(StepLoops, TellWhatHasToBeLookedAt) {
  for (const StepLoops* kernels : lane_sets()) {
    SCOPED_TRACE(kernels->name);
    LaneSteps cut = plain();
    cut.cut[0] = -1;
    cut.h[0] = 1e-3;  // far shorter than proposed: that stays
    const LaneSteps arrived = judged(*kernels, cut);
    EXPECT_EQ(arrived.event[0], -1);
    EXPECT_EQ(arrived.accepted[0], -1);
    EXPECT_EQ(arrived.proposed[0], 0.5);
    cut.norm[0] = 2.0;  // refused: nothing is reached
    EXPECT_EQ(judged(*kernels, cut).event[0], 0);
    LaneSteps sampled = plain();
    sampled.sample[0] = 1.5;
    EXPECT_EQ(judged(*kernels, sampled).event[0], -1);
    sampled.sample[0] = 1.5000001;
    EXPECT_EQ(judged(*kernels, sampled).event[0], 0);
    LaneSteps last = plain();
    last.allowed[0] = 8;
    EXPECT_EQ(judged(*kernels, last).event[0], -1);
    last.allowed[0] = 9;
    EXPECT_EQ(judged(*kernels, last).event[0], 0);
    LaneSteps far = plain();
    far.largest[0] = 2.0 * bound;
    EXPECT_EQ(judged(*kernels, far).event[0], -1);
    EXPECT_EQ(judged(*kernels, far).accepted[0], 0);
    LaneSteps idle = plain();
    idle.running[0] = 0;
    idle.norm[0] = none;
    EXPECT_EQ(judged(*kernels, idle).event[0], 0);
    EXPECT_EQ(judged(*kernels, idle).accepted[0], 0);
    EXPECT_EQ(judged(*kernels, idle).refused[0], 0);
    EXPECT_EQ(judged(*kernels, idle).proposed[0], 0.5);
  }
}

TEST(StepLoops, ShortenRefusedSteps) {
  for (const StepLoops* kernels : lane_sets()) {
    SCOPED_TRACE(kernels->name);
    for (const double norm : {none, infinite, 1e30}) {  // as far as one refusal may
      LaneSteps one = plain();
      one.norm[0] = norm;
      const LaneSteps steps = judged(*kernels, one);
      EXPECT_EQ(steps.accepted[0], 0) << norm;
      EXPECT_EQ(steps.refused[0], -1) << norm;
      EXPECT_EQ(steps.proposed[0], 0.05) << norm;
    }
    LaneSteps endless = plain();
    endless.largest[0] = infinite;  // with a norm that says nothing
    EXPECT_EQ(judged(*kernels, endless).accepted[0], 0);
    EXPECT_EQ(judged(*kernels, endless).event[0], 0);
    LaneSteps twice = plain();
    twice.norm[0] = 1.1;
    EXPECT_GT(judged(*kernels, twice).proposed[0], 0.4);
    twice.refused[0] = -1;
    EXPECT_EQ(judged(*kernels, twice).proposed[0], 0.15);
    LaneSteps after = plain();
    after.refused[0] = -1;  // accepted after a refusal: does not grow
    after.norm[0] = 1e-8;
    EXPECT_EQ(judged(*kernels, after).proposed[0], 0.5);
    EXPECT_EQ(judged(*kernels, after).refused[0], 0);
    EXPECT_EQ(judged(*kernels, after).event[0], 0);
    LaneSteps stuck = plain();
    stuck.s[0] = -100.0;
    stuck.norm[0] = none;
    stuck.h[0] = 1.1e-11;
    EXPECT_EQ(judged(*kernels, stuck).event[0], 0);
    stuck.h[0] = 0.9e-11;
    EXPECT_EQ(judged(*kernels, stuck).event[0], -1);
  }
}

/// Of an odd number of components and of an even one: they are gone through in twos.
/// A surface's values and slopes at both ends of a step in the last lane; elsewhere no number.
struct Surfaces {
  Surfaces(const StepLoops& kernels, std::size_t count)
      : width(kernels.width), at(4, std::vector<double>(count * width, none)) {}
  /// The cubic (t - root) (b + c t + d t^2) along a step of length h.
  void set(std::size_t k, double root, double b, double c, double d, double h) {
    const std::size_t i = k * width + width - 1;
    at[0][i] = -root * b;
    at[1][i] = (b - root * c) / h;
    at[2][i] = (1.0 - root) * (b + c + d);
    at[3][i] = ((b + c + d) + (1.0 - root) * (c + 2.0 * d)) / h;
  }
  std::size_t width;
  std::vector<std::vector<double>> at;  ///< values, rates, and both at the end
};

/// After a refused step of length 0.5, in the last lane.
LaneSteps after_landing(const StepLoops& kernels, const Surfaces& s, std::size_t count, double margin, bool again,
                        bool refused) {
  struct alignas(64) Aligned {
    std::array<double, 4 * most_lanes> x{};
  };
  std::array<Aligned, 4> copies{};
  for (std::size_t j = 0; j < 4; ++j)
    for (std::size_t i = 0; i < count * kernels.width; ++i) copies[j].x[i] = s.at[j][i];
  const std::size_t lane = kernels.width - 1;
  LaneSteps steps = alone(plain(), lane);
  steps.proposed[lane] = 0.05;
  steps.refused[lane] = refused ? -1 : 0;
  steps.again[lane] = again ? -1 : 0;
  kernels.land(steps, margin, count, copies[0].x.data(), copies[1].x.data(), copies[2].x.data(), copies[3].x.data());
  for (std::size_t other = 0; other < lane; ++other) EXPECT_EQ(steps.proposed[other], 0.0);
  return steps;
}

/// What is proposed.
double landed(const StepLoops& kernels, const Surfaces& s, std::size_t count, bool again = false, bool refused = true) {
  const LaneSteps steps = after_landing(kernels, s, count, 0.0, again, refused);
  EXPECT_EQ(steps.hop[kernels.width - 1], 0.0);
  return steps.proposed[kernels.width - 1];
}

TEST(StepLoops, LandBeforeACrossingAndGoOverItWithAMargin) {
  constexpr double margin = 0.01;
  constexpr double rounding = 1e-15;  // of the root of a straight line
  for (const StepLoops* kernels : lane_sets()) {
    SCOPED_TRACE(kernels->name);
    const std::size_t lane = kernels->width - 1;
    Surfaces s(*kernels, 1);
    s.set(0, 0.4, 1.0, 0.0, 0.0, 0.5);
    LaneSteps steps = after_landing(*kernels, s, 1, margin, false, true);
    EXPECT_NEAR(steps.proposed[lane], 0.195, rounding);
    EXPECT_NEAR(steps.hop[lane], 0.01, rounding);
    EXPECT_EQ(steps.hopping[lane], 0);
    s.set(0, 0.015, 1.0, 0.0, 0.0, 0.5);  // no room
    steps = after_landing(*kernels, s, 1, margin, false, true);
    EXPECT_EQ(steps.proposed[lane], 0.05);
    EXPECT_NEAR(steps.hop[lane], 0.015, rounding);
    EXPECT_EQ(steps.hopping[lane], -1);
  }
}

TEST(StepLoops, GoOnBehindACrossingAsBeforeIt) {
  constexpr double hop = 0.01;
  for (const StepLoops* kernels : lane_sets()) {
    SCOPED_TRACE(kernels->name);
    LaneSteps landing = plain();  // the step that ends before it is accepted
    landing.hop[0] = hop;
    landing.norm[0] = 0.01;
    const LaneSteps landed = judged(*kernels, landing);
    EXPECT_EQ(landed.hopping[0], -1);
    EXPECT_EQ(landed.hop[0], hop);
    LaneSteps over = plain();
    over.hopping[0] = -1;
    over.hop[0] = hop;
    over.stop[0] = 9.0;
    const double node = 1.0;
    struct alignas(64) Aligned {
      std::array<double, most_lanes> x{};
    } places;
    kernels->measure(over, 1, &node, places.x.data());
    EXPECT_EQ(over.h[0], hop);
    over.norm[0] = 1e-6;
    LaneSteps behind = judged(*kernels, over);
    EXPECT_EQ(behind.hopping[0], 0);
    EXPECT_EQ(behind.hop[0], 0.0);
    EXPECT_EQ(behind.proposed[0], over.proposed[0]);
    over.norm[0] = 4.0;  // refused: as any other
    behind = judged(*kernels, over);
    EXPECT_EQ(behind.hopping[0], 0);
    EXPECT_EQ(behind.hop[0], 0.0);
    EXPECT_LT(behind.proposed[0], hop);
    landing.norm[0] = 4.0;  // the landing is refused: nothing is gone over
    behind = judged(*kernels, landing);
    EXPECT_EQ(behind.hopping[0], 0);
    EXPECT_EQ(behind.hop[0], 0.0);
  }
}

TEST(StepLoops, LandOnTheFirstCrossing) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> place(0.01, 0.99);
  std::uniform_real_distribution<double> part(-0.7, 0.7);
  constexpr double closed = 1e-9;  // measured: six steps of Newton's method leave 7.4e-10 of the worst of these
  for (int k = 0; k < 200; ++k) {
    const double root = place(random);
    // b + c t + d t^2 has no root in [0, 1]: | c | + | d | < b.
    const double b = k % 2 == 0 ? 1.0 : -1.0;
    const double c = part(random);
    const double d = (1.0 - std::abs(c)) * part(random);
    double first_bits = 0.0;
    for (const StepLoops* kernels : lane_sets()) {
      Surfaces s(*kernels, 2);
      s.set(0, root, b, c, d, 0.5);
      s.set(1, 0.995, b, c, d, 0.5);  // later
      const double h = landed(*kernels, s, 2);
      EXPECT_NEAR(h, 0.5 * root, closed) << kernels->name << ": " << b << " " << c << " " << d;
      if (kernels == lane_sets().front()) first_bits = h;
      EXPECT_EQ(h, first_bits) << kernels->name;
      s.set(0, 0.995, b, c, d, 0.5);
      s.set(1, root, b, c, d, 0.5);
      EXPECT_NEAR(landed(*kernels, s, 2), 0.5 * root, closed) << kernels->name;
    }
  }
}

TEST(StepLoops, LandNowhereElse) {
  for (const StepLoops* kernels : lane_sets()) {
    SCOPED_TRACE(kernels->name);
    constexpr double proposed = 0.05;
    constexpr double rounding = 1e-15;  // of the root of a straight line
    Surfaces s(*kernels, 1);
    EXPECT_EQ(landed(*kernels, s, 1), proposed);  // no number
    EXPECT_EQ(landed(*kernels, s, 0), proposed);
    s.set(0, 0.4, 1.0, 0.0, 0.0, 0.5);
    EXPECT_NEAR(landed(*kernels, s, 1), 0.2, rounding);
    EXPECT_NEAR(landed(*kernels, s, 1, true), 0.2, rounding);
    EXPECT_EQ(landed(*kernels, s, 1, false, false), proposed);  // not refused
    s.set(0, 1.4, 1.0, 0.0, 0.0, 0.5);
    EXPECT_EQ(landed(*kernels, s, 1), proposed);  // not crossed
    s.set(0, 5e-4, 1.0, 0.0, 0.0, 0.5);
    EXPECT_EQ(landed(*kernels, s, 1), proposed);  // where the step began
    s.set(0, 0.95, 1.0, 0.0, 0.0, 0.5);
    EXPECT_NEAR(landed(*kernels, s, 1), 0.475, rounding);
    EXPECT_EQ(landed(*kernels, s, 1, true), proposed);  // refused for something else
    // The slope is 0 on the way: halving finds it. Five steps of Newton's method gain a third each: 0.0165 is left.
    s.set(0, 0.5, 0.25, -1.0, 1.0, 0.5);  // (t - 1/2)^3
    constexpr double flat = 0.02;
    EXPECT_NEAR(landed(*kernels, s, 1), 0.25, flat);
  }
}

TEST(StepLoops, MeasureTheWeightedRootMeanSquare) {
  constexpr std::size_t most = 7;
  constexpr double rounding = 1e-14;  // of sums of three products and of seven squares
  std::mt19937 random(2);
  std::uniform_real_distribution<double> any(-3.0, 3.0);
  for (const StepLoops* kernels : lane_sets()) {
    const std::size_t width = kernels->width;
    for (std::size_t dimension = 1; dimension <= most; ++dimension) {
      alignas(64) std::array<std::array<double, most * most_lanes>, 5> numbers{};
      for (auto& values : numbers)
        for (double& x : values) x = any(random);
      alignas(64) std::array<double, most_lanes> h{}, square{}, largest{};
      h.fill(0.3);
      const std::array<double, 3> e = {0.5, -0.2, 0.1};
      const std::array<const double*, 3> k = {numbers[0].data(), numbers[1].data(), numbers[2].data()};
      alignas(64) std::array<double, most_lanes> relative{}, absolute{};
      for (std::size_t lane = 0; lane < width; ++lane) {
        relative[lane] = 1e-3 * static_cast<double>(lane + 1);
        absolute[lane] = 1e-5 / static_cast<double>(lane + 1);
      }
      kernels->error(dimension, 3, e.data(), k.data(), h.data(), numbers[3].data(), numbers[4].data(), relative.data(),
                     absolute.data(), square.data(), largest.data());
      for (std::size_t lane = 0; lane < width; ++lane) {
        double squares = 0.0;
        double longest = 0.0;
        for (std::size_t i = 0; i < dimension; ++i) {
          const std::size_t at = i * width + lane;
          const double error = 0.3 * (0.5 * numbers[0][at] - 0.2 * numbers[1][at] + 0.1 * numbers[2][at]);
          const double part = error / (relative[lane] * std::abs(numbers[3][at]) + absolute[lane]);
          squares += part * part;
          longest = std::max(longest, std::abs(numbers[4][at]));
        }
        const double expected = squares / static_cast<double>(dimension);
        EXPECT_NEAR(square[lane], expected, rounding * expected) << kernels->name << " " << dimension;
        EXPECT_EQ(largest[lane], longest);
      }
    }
  }
}

TEST(StepLoops, MeasureVectorsInPartsOfTheirSize) {
  constexpr std::size_t dimension = 5;
  constexpr double rounding = 1e-14;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(-0.4, 0.4);
  for (const StepLoops* kernels : lane_sets())
    for (const double least : {0.0, 1.0}) {
      const std::size_t width = kernels->width;
      alignas(64) std::array<std::array<double, dimension * most_lanes>, 3> numbers{};
      for (auto& values : numbers)
        for (double& x : values) x = any(random);
      for (std::size_t i = 0; i < dimension; ++i) numbers[2][i * width] = 0.0;  // a vector of no length
      alignas(64) std::array<double, most_lanes> h{}, relative{}, absolute{}, square{};
      h.fill(0.3);
      relative.fill(1e-3);
      absolute.fill(1e-4);
      constexpr double large = 1e12;
      square.back() = large;  // of the last lane of the widest
      const std::array<double, 2> e = {0.5, -0.2};
      const std::array<const double*, 2> k = {numbers[0].data(), numbers[1].data()};
      kernels->vector_error(dimension, 2, e.data(), k.data(), h.data(), numbers[2].data(), relative.data(),
                            absolute.data(), least, square.data());
      for (std::size_t lane = 0; lane < width; ++lane) {
        double size = least;
        for (std::size_t i = 0; i < dimension; ++i) size = std::max(size, std::abs(numbers[2][i * width + lane]));
        if (size == 0.0) size = 1.0;
        double squares = 0.0;
        for (std::size_t i = 0; i < dimension; ++i) {
          const std::size_t at = i * width + lane;
          const double part =
              0.3 * (0.5 * numbers[0][at] - 0.2 * numbers[1][at]) / (1e-3 * std::abs(numbers[2][at]) + 1e-4 * size);
          squares += part * part;
        }
        const double own = squares / static_cast<double>(dimension);
        const double expected = lane + 1 == most_lanes ? large : own;
        EXPECT_NEAR(square[lane], expected, rounding * expected) << kernels->name << " " << least;
      }
    }
}

TEST(StepLoops, EndStepsOnStopsToTheLastBit) {
  const double nodes[] = {0.0, 0.3, 1.0};
  for (const StepLoops* kernels : lane_sets()) {
    SCOPED_TRACE(kernels->name);
    const std::size_t width = kernels->width;
    alignas(64) std::array<double, 3 * most_lanes> at{};
    const auto measured = [&](double proposed, double stop) {
      LaneSteps one = plain();
      one.proposed[0] = proposed;
      one.stop[0] = stop;
      LaneSteps steps = alone(one, width - 1);
      kernels->measure(steps, 3, nodes, at.data());
      for (auto* member : {&steps.h, &steps.end}) (*member)[0] = (*member)[width - 1];
      steps.cut[0] = steps.cut[width - 1];
      return steps;
    };
    const LaneSteps free = measured(0.5, 1.6);
    EXPECT_EQ(free.cut[0], 0);
    EXPECT_EQ(free.h[0], 0.5);
    EXPECT_EQ(free.end[0], 1.5);
    EXPECT_EQ(at[width - 1], 1.0);
    EXPECT_EQ(at[2 * width - 1], 1.0 + 0.3 * 0.5);
    EXPECT_EQ(at[3 * width - 1], 1.5);
    const double stop = 1.0 + 0.1 * 3.0;
    const LaneSteps cut = measured(0.5, stop);
    EXPECT_EQ(cut.cut[0], -1);
    EXPECT_EQ(cut.h[0], stop - 1.0);
    EXPECT_EQ(cut.end[0], stop);
    EXPECT_EQ(at[3 * width - 1], stop);
    // Nearly there is there.
    EXPECT_EQ(measured(0.5 - 1e-12, 1.5).end[0], 1.5);
  }
}

TEST(StepLoops, CopiesLieInMemoryOfTheirOwn) {
  // A linker that folds the same text into one would undo them.
  if (lane_sets().size() == 1) GTEST_SKIP() << "this machine has the baseline only";
  for (const char* name : {"avx2", "avx512"}) {
    const StepLoops* first = step_loops(name, 0);
    if (first == nullptr) continue;
    const StepLoops* second = step_loops(name, 1);
    EXPECT_NE(first->stage, second->stage) << name;
    EXPECT_NE(first->error, second->error) << name;
    EXPECT_EQ(first->copy, 0U) << name;
    EXPECT_EQ(second->copy, 1U) << name;
    EXPECT_EQ(step_loops(name, kernel_copies), first) << name;
  }
}

}  // namespace
}  // namespace epicyclic::integrate::step_loops_test
