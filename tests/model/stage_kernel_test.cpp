// The right-hand side compiled once per instruction set: the same bits from each, and from the text itself.

#include "model/kernels/stage_kernel.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <random>

#include <gtest/gtest.h>

#include "model/right_hand_side.hpp"
#include "problems/r1.hpp"

namespace epicyclic::model {
namespace {

/// One error for all planets: r1_nonlinear() has those of three.
template <std::size_t N>
Parameters<double, N> parameters(double smoothing, GapDamping damping) {
  gear::Stage stage = problems::with_friction(problems::with_moving_stiffness(problems::with_gap(problems::r1())));
  stage.planet_count = static_cast<int>(N);
  return make_parameters<N>(stage, scales_of(stage), 0.9, {damping, Gyroscopic::automatic, smoothing});
}

template <std::size_t N>
double phase_in(const Parameters<double, N>& p, std::size_t segment, int trial) {
  return p.breakpoints.empty() ? 0.3 * trial : p.breakpoints[segment] + 0.01;
}

template <Layout L, std::size_t N>
void expect_same_bits(double smoothing, GapDamping damping) {
  constexpr std::size_t dimension = 2 * degrees_of_freedom(L, N);
  const auto p = parameters<N>(smoothing, damping);
  std::mt19937_64 random(71);
  std::uniform_real_distribution<double> component(-6.0, 6.0);  // on all three sides of the gaps
  for (int trial = 0; trial < 20; ++trial) {
    const std::size_t segment = static_cast<std::size_t>(trial) % p.segments.size();
    const double s = phase_in(p, segment, trial);
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
  EPICYCLIC_FOR_ALL_LAYOUTS(EPICYCLIC_EXPECT)
#undef EPICYCLIC_EXPECT
}

/// Values are the kernel's own, and a direction's derivatives do not depend on the set or on how many go with it.
template <Layout L, std::size_t N>
void expect_same_tangents(double smoothing, GapDamping damping) {
  constexpr std::size_t dimension = 2 * degrees_of_freedom(L, N);
  const auto p = parameters<N>(smoothing, damping);
  std::mt19937_64 random(73);
  std::uniform_real_distribution<double> component(-6.0, 6.0);
  for (int trial = 0; trial < 5; ++trial) {
    const std::size_t segment = static_cast<std::size_t>(trial) % p.segments.size();
    const double s = phase_in(p, segment, trial);
    std::array<Dual<4>, dimension> y;
    std::array<double, dimension> plain;
    for (std::size_t i = 0; i < dimension; ++i) {
      plain[i] = y[i].value = component(random);
      for (double& d : y[i].derivative) d = component(random);
    }
    std::array<double, dimension> value;
    stage_kernel<L, N>()(p, segment, s, plain.data(), value.data());
    std::array<Dual<4>, dimension> four;
    const TangentKernel<N, 4> by_four = tangent_kernel<L, N, 4>();
    if (by_four != nullptr) by_four(p, segment, s, y.data(), four.data());
    for (std::size_t j = 0; j < 4; ++j) {
      std::array<Dual<1>, dimension> one;
      for (std::size_t i = 0; i < dimension; ++i) {
        one[i].value = plain[i];
        one[i].derivative[0] = y[i].derivative[j];
      }
      std::array<Dual<1>, dimension> expected;
      tangent_kernel<L, N, 1>("baseline")(p, segment, s, one.data(), expected.data());
      std::array<Dual<1>, dimension> fast;
      tangent_kernel<L, N, 1>()(p, segment, s, one.data(), fast.data());
      for (std::size_t i = 0; i < dimension; ++i) {
        EXPECT_EQ(expected[i].value, value[i]);
        EXPECT_EQ(fast[i].value, value[i]);
        EXPECT_EQ(fast[i].derivative[0], expected[i].derivative[0]);
        if (by_four != nullptr) {
          EXPECT_EQ(four[i].value, value[i]);
          EXPECT_EQ(four[i].derivative[j], expected[i].derivative[0]);
        }
      }
    }
  }
}

TEST(TangentKernel, BitsDoNotDependOnTheInstructionSetOrOnCompany) {
#define EPICYCLIC_EXPECT(L, N)                         \
  expect_same_tangents<L, N>(0.0, GapDamping::always); \
  expect_same_tangents<L, N>(0.5, GapDamping::contact_slope);
  EPICYCLIC_FOR_ALL_LAYOUTS(EPICYCLIC_EXPECT)
#undef EPICYCLIC_EXPECT
}

TEST(TangentKernel, FourDirectionsAreForRelativeCoordinates) {
  EXPECT_EQ((tangent_kernel<Layout::full, 3, 4>()), nullptr);
  EXPECT_EQ((tangent_kernel<Layout::relative_to_ring, 3, 4>("baseline")), nullptr);
  EXPECT_NE((tangent_kernel<Layout::full, 3, 1>("baseline")), nullptr);
}

TEST(StageKernel, BaselineIsAlwaysThereAndUnknownNamesAreNot) {
  EXPECT_NE((stage_kernel<Layout::full, 3>("baseline")), nullptr);
  EXPECT_EQ((stage_kernel<Layout::full, 3>("avx1024")), nullptr);
  EXPECT_NE((stage_kernel<Layout::full, 3>()), nullptr);
}

}  // namespace
}  // namespace epicyclic::model
