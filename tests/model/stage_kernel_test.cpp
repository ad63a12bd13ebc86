// The right-hand side compiled once per instruction set: the same bits from each, and from the text itself.

#include "model/stage_kernel.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <random>

#include <gtest/gtest.h>

#include "model/right_hand_side.hpp"
#include "problems/r1.hpp"

namespace epicyclic::model {
namespace {

template <Layout L, std::size_t N>
void expect_same_bits(double smoothing, GapDamping damping) {
  constexpr std::size_t dimension = 2 * degrees_of_freedom(L, N);
  // One error for all planets: r1_nonlinear() has those of three.
  gear::Stage stage = problems::with_friction(problems::with_moving_stiffness(problems::with_gap(problems::r1())));
  stage.planet_count = static_cast<int>(N);
  const auto p = make_parameters<N>(stage, scales_of(stage), 0.9, {damping, Gyroscopic::automatic, smoothing});
  std::mt19937_64 random(71);
  std::uniform_real_distribution<double> component(-6.0, 6.0);  // on all three sides of the gaps
  for (int trial = 0; trial < 20; ++trial) {
    const std::size_t segment = static_cast<std::size_t>(trial) % p.segments.size();
    const double s = p.breakpoints.empty() ? 0.3 * trial : p.breakpoints[segment] + 0.01;
    std::array<double, dimension> y;
    for (double& x : y) x = component(random);
    std::array<double, dimension> expected;
    right_hand_side<L>(p, segment, s, y.data(), expected.data());
    for (const double x : expected) ASSERT_TRUE(std::isfinite(x));
    for (const char* name : {"baseline", "avx2"}) {
      const StageKernel<N> kernel = stage_kernel<L, N>(name);
      if (kernel == nullptr) continue;
      std::array<double, dimension> f;
      kernel(p, segment, s, y.data(), f.data());
      EXPECT_EQ(f, expected) << name << ", planets: " << N << ", layout: " << static_cast<int>(L);
    }
  }
}

TEST(StageKernel, BitsDoNotDependOnTheInstructionSet) {
#define EPICYCLIC_EXPECT(L, N)                     \
  expect_same_bits<L, N>(0.0, GapDamping::always); \
  expect_same_bits<L, N>(0.5, GapDamping::contact_slope);
  EPICYCLIC_FOR_STAGE_KERNELS(EPICYCLIC_EXPECT)
#undef EPICYCLIC_EXPECT
}

TEST(StageKernel, BaselineIsAlwaysThereAndUnknownNamesAreNot) {
  EXPECT_NE((stage_kernel<Layout::full, 3>("baseline")), nullptr);
  EXPECT_EQ((stage_kernel<Layout::full, 3>("avx1024")), nullptr);
  EXPECT_NE((stage_kernel<Layout::full, 3>()), nullptr);
}

}  // namespace
}  // namespace epicyclic::model
