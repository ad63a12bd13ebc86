// The step control of lanes, one lane at a time, against its formula; on every instruction set that there is.

#include "integrate/lane_kernels.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace epicyclic::integrate {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double none = std::numeric_limits<double>::quiet_NaN();
constexpr double bound = 1e6;

std::vector<const LaneKernels*> sets() {
  std::vector<const LaneKernels*> all;
  for (const char* name : {"baseline", "avx2", "avx512"})
    if (const LaneKernels* kernels = lane_kernels(name)) all.push_back(kernels);
  return all;
}

/// One lane of `steps` in lane `lane` of otherwise idle ones.
LaneSteps alone(const LaneSteps& one, std::size_t lane) {
  LaneSteps steps;
  steps.sample.fill(infinite);
  const auto move = [&](auto member) { (steps.*member)[lane] = (one.*member)[0]; };
  for (auto member : {&LaneSteps::s, &LaneSteps::stop, &LaneSteps::sample, &LaneSteps::proposed, &LaneSteps::h,
                      &LaneSteps::end, &LaneSteps::norm, &LaneSteps::largest})
    move(member);
  for (auto member :
       {&LaneSteps::running, &LaneSteps::cut, &LaneSteps::refused, &LaneSteps::attempts, &LaneSteps::allowed})
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

TEST(LaneKernels, ProposeStepsByTheErrorsFifthRoot) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> exponent(-30.0, 3.0);
  for (int k = 0; k < 2000; ++k) {
    LaneSteps one = plain();
    one.norm[0] = std::pow(10.0, exponent(random));
    const double norm = std::max(std::sqrt(one.norm[0]), 1e-10);
    const double wanted = 0.96 * std::pow(1.5 * norm, -0.2);
    double first_bits = 0.0;
    for (const LaneKernels* kernels : sets()) {
      const std::size_t lane = static_cast<std::size_t>(k) % kernels->width;
      LaneSteps steps = alone(one, lane);
      const bool eventful = kernels->judge(steps, bound);
      EXPECT_NEAR(steps.wanted[lane], wanted, 1e-14 * wanted) << kernels->name;
      if (kernels == sets().front()) first_bits = steps.wanted[lane];
      EXPECT_EQ(steps.wanted[lane], first_bits) << kernels->name;
      EXPECT_EQ(steps.attempts[lane], 8);
      if (one.norm[0] > 1.0) {
        EXPECT_EQ(steps.accepted[lane], 0);
        EXPECT_EQ(steps.proposed[lane], 0.5);
        EXPECT_TRUE(eventful);
        continue;
      }
      EXPECT_EQ(steps.accepted[lane], -1);
      EXPECT_FALSE(eventful);
      const double grown = std::min(steps.wanted[lane], 20.0);
      EXPECT_EQ(steps.proposed[lane], 0.5 * (grown >= 1.0 && grown <= 1.5 ? 1.0 : grown));
    }
  }
}

TEST(LaneKernels, TellWhatHasToBeLookedAt) {
  const auto judged = [](const LaneKernels& kernels, const LaneSteps& one, LaneSteps& steps) {
    const std::size_t lane = kernels.width - 1;
    steps = alone(one, lane);
    const bool eventful = kernels.judge(steps, bound);
    steps.accepted[0] = steps.accepted[lane];
    steps.proposed[0] = steps.proposed[lane];
    return eventful;
  };
  for (const LaneKernels* kernels : sets()) {
    SCOPED_TRACE(kernels->name);
    LaneSteps steps;
    for (const double norm : {none, infinite, 1.0001}) {
      LaneSteps one = plain();
      one.norm[0] = norm;
      EXPECT_TRUE(judged(*kernels, one, steps));
      EXPECT_EQ(steps.accepted[0], 0) << norm;
    }
    for (const double largest : {infinite, 2.0 * bound}) {
      LaneSteps one = plain();
      one.largest[0] = largest;
      EXPECT_TRUE(judged(*kernels, one, steps));
      EXPECT_EQ(steps.accepted[0], 0) << largest;
    }
    LaneSteps cut = plain();
    cut.cut[0] = -1;
    cut.h[0] = 1e-3;  // far shorter than proposed: that stays
    EXPECT_TRUE(judged(*kernels, cut, steps));
    EXPECT_EQ(steps.accepted[0], -1);
    EXPECT_EQ(steps.proposed[0], 0.5);
    LaneSteps refused = plain();
    refused.refused[0] = -1;  // does not grow
    refused.norm[0] = 1e-8;
    EXPECT_TRUE(judged(*kernels, refused, steps));
    EXPECT_EQ(steps.proposed[0], 0.5);
    LaneSteps sampled = plain();
    sampled.sample[0] = 1.5;
    EXPECT_TRUE(judged(*kernels, sampled, steps));
    sampled.sample[0] = 1.5000001;
    EXPECT_FALSE(judged(*kernels, sampled, steps));
    LaneSteps last = plain();
    last.allowed[0] = 8;
    EXPECT_TRUE(judged(*kernels, last, steps));
    LaneSteps idle = plain();
    idle.running[0] = 0;
    idle.norm[0] = none;
    EXPECT_FALSE(judged(*kernels, idle, steps));
    EXPECT_EQ(steps.accepted[0], 0);
  }
}

TEST(LaneKernels, EndStepsOnStopsToTheLastBit) {
  const double nodes[] = {0.0, 0.3, 1.0};
  for (const LaneKernels* kernels : sets()) {
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

}  // namespace
}  // namespace epicyclic::integrate
