// The right-hand side compiled once per instruction set: the same bits from each, and from the text itself.

#include "model/kernels/stage_kernel.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "model/right_hand_side.hpp"
#include "problems/r1.hpp"

namespace epicyclic::model::stage_kernel_test {
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

constexpr std::array layouts = {Layout::relative_to_ring, Layout::relative_to_carrier,
                                Layout::relative_to_carrier_rigid_ring, Layout::full};

template <std::size_t N>
void expect_same_bits(Layout layout, double smoothing, GapDamping damping) {
  const std::size_t dimension = 2 * degrees_of_freedom(layout, N);
  const auto p = parameters<N>(smoothing, damping);
  std::mt19937_64 random(71);
  std::uniform_real_distribution<double> component(-6.0, 6.0);  // on all three sides of the gaps
  for (int trial = 0; trial < 20; ++trial) {
    const std::size_t segment = static_cast<std::size_t>(trial) % p.segments.size();
    const double s = phase_in(p, segment, trial);
    std::vector<double> y(dimension);
    for (double& x : y) x = component(random);
    std::vector<double> expected(dimension);
    right_hand_side(layout, p, segment, s, y.data(), expected.data());
    for (const double x : expected) ASSERT_TRUE(std::isfinite(x));
    for (const char* name : {"baseline", "avx2"}) {
      const StageKernel<N> kernel = stage_kernel<N>(layout, name);
      if (kernel == nullptr) continue;
      std::vector<double> f(dimension);
      kernel(layout, p, segment, s, y.data(), f.data());
      EXPECT_EQ(f, expected) << name << ", planets: " << N << ", layout: " << static_cast<int>(layout);
    }
  }
}

TEST(StageKernel, BitsDoNotDependOnTheInstructionSet) {
  for (const Layout layout : layouts) {
#define EPICYCLIC_EXPECT(N)                             \
  expect_same_bits<N>(layout, 0.0, GapDamping::always); \
  expect_same_bits<N>(layout, 0.5, GapDamping::contact_slope);
    EPICYCLIC_FOR_PLANETS(EPICYCLIC_EXPECT)
#undef EPICYCLIC_EXPECT
  }
}

/// Values are the kernel's own, and a direction's derivatives do not depend on the set or on how many go with it.
template <std::size_t N>
void expect_same_tangents(Layout layout, double smoothing, GapDamping damping) {
  const std::size_t dimension = 2 * degrees_of_freedom(layout, N);
  const auto p = parameters<N>(smoothing, damping);
  std::mt19937_64 random(73);
  std::uniform_real_distribution<double> component(-6.0, 6.0);
  for (int trial = 0; trial < 5; ++trial) {
    const std::size_t segment = static_cast<std::size_t>(trial) % p.segments.size();
    const double s = phase_in(p, segment, trial);
    std::vector<Dual<4>> y(dimension);
    std::vector<double> plain(dimension);
    for (std::size_t i = 0; i < dimension; ++i) {
      plain[i] = y[i].value = component(random);
      for (double& d : y[i].derivative) d = component(random);
    }
    std::vector<double> value(dimension);
    stage_kernel<N>(layout)(layout, p, segment, s, plain.data(), value.data());
    std::vector<Dual<4>> four(dimension);
    const TangentKernel<N, 4> by_four = tangent_kernel<N, 4>();
    if (by_four != nullptr) by_four(layout, p, segment, s, y.data(), four.data());
    for (std::size_t j = 0; j < 4; ++j) {
      std::vector<Dual<1>> one(dimension);
      for (std::size_t i = 0; i < dimension; ++i) {
        one[i].value = plain[i];
        one[i].derivative[0] = y[i].derivative[j];
      }
      std::vector<Dual<1>> expected(dimension);
      tangent_kernel<N, 1>("baseline")(layout, p, segment, s, one.data(), expected.data());
      std::vector<Dual<1>> fast(dimension);
      tangent_kernel<N, 1>()(layout, p, segment, s, one.data(), fast.data());
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
  for (const Layout layout : layouts) {
#define EPICYCLIC_EXPECT(N)                                 \
  expect_same_tangents<N>(layout, 0.0, GapDamping::always); \
  expect_same_tangents<N>(layout, 0.5, GapDamping::contact_slope);
    EPICYCLIC_FOR_PLANETS(EPICYCLIC_EXPECT)
#undef EPICYCLIC_EXPECT
  }
}

TEST(TangentKernel, FourDirectionsWantWideRegisters) {
  EXPECT_EQ((tangent_kernel<3, 4>("baseline")), nullptr);
  EXPECT_NE((tangent_kernel<3, 1>("baseline")), nullptr);
}

TEST(StageKernel, BaselineIsAlwaysThereAndUnknownNamesAreNot) {
  EXPECT_NE(stage_kernel<3>(Layout::full, "baseline"), nullptr);
  EXPECT_EQ(stage_kernel<3>(Layout::full, "avx1024"), nullptr);
  EXPECT_NE(stage_kernel<3>(Layout::full), nullptr);
}

}  // namespace
}  // namespace epicyclic::model::stage_kernel_test
