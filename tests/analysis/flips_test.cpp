// Where Duffing's orbits flip: the root in g of (multiplier + 1) along a branch of periodic orbits, beside published
// values.

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "analysis/periodic_orbit.hpp"
#include "core/dense.hpp"
#include "core/root_finding.hpp"
#include "integrate/make_flow.hpp"
#include "problems/known_systems.hpp"

namespace epicyclic::analysis::flips_test {
namespace {

constexpr double damping = 0.3;
constexpr double frequency = 1.2;
constexpr double period = 2.0 * std::numbers::pi / frequency;

/// One unit of the tenth decimal. The published digits are the limit here: tolerances of 1e-12 to 1e-14 move g and the
/// state by less than 1e-12, and what is found rounds to the digits published, all of them.
constexpr double last_digit = 1e-10;

/// An orbit of period n that is carried along from one g to the next.
class Branch {
 public:
  Branch(int n, std::vector<double> start) : n_(n), state_(std::move(start)) {}

  /// The most negative multiplier, plus 1, at g.
  double beyond_the_flip(double g) {
    const auto flow = at(g);
    const PeriodicOrbit orbit = find_periodic_orbit(*flow, state_, n_, {.iterations = 20, .residual = 1e-12});
    EXPECT_TRUE(orbit.found()) << "g = " << g << ": " << orbit.message;
    if (!orbit.found()) return std::nan("");
    state_ = orbit.state;
    const auto multipliers = epicyclic::eigenvalues(orbit.monodromy);
    least_ = std::min(multipliers[0].real(), multipliers[1].real());
    other_ = std::max(multipliers[0].real(), multipliers[1].real());
    return least_ + 1.0;
  }

  /// Carries the start on for some periods, to the orbit that attracts at g.
  void settle(double g, int periods) {
    const auto flow = at(g);
    for (int k = 0; k < periods; ++k) ASSERT_TRUE(flow->evolve(state_, 0.0, period).reached());
  }

  [[nodiscard]] std::span<const double> state() const { return state_; }
  [[nodiscard]] double least() const { return least_; }
  [[nodiscard]] double other() const { return other_; }

 private:
  [[nodiscard]] static std::unique_ptr<integrate::Flow> at(double g) {
    integrate::IntegratorOptions o;
    o.relative_tolerance = o.absolute_tolerance = 1e-13;
    o.max_steps_per_period = 1000000;
    o.tangent_error_control = true;
    return integrate::make_flow(problems::duffing(damping, -1.0, g, frequency), o);
  }

  int n_;
  std::vector<double> state_;
  double least_ = 0;
  double other_ = 0;
};

TEST(Flips, DuffingsFirstIsThePublishedOne) {
  Branch branch(1, {0.42, 0.31});
  const double g = find_root([&](double at) { return branch.beyond_the_flip(at); }, 0.26, 0.27);
  EXPECT_NEAR(g, 0.2655817861, last_digit);
  branch.beyond_the_flip(g);
  EXPECT_NEAR(branch.state()[0], 0.4075754662, last_digit);
  EXPECT_NEAR(branch.state()[1], 0.3226140050, last_digit);
  constexpr double resolved = 1e-11;  // the integrator's tolerance times the multiplier's slope in g, 25
  EXPECT_NEAR(branch.least(), -1.0, resolved);
  constexpr double eighth_digit = 1e-8;
  EXPECT_NEAR(branch.other(), -0.20787958, eighth_digit);
  // The divergence is the same everywhere, so that the product of the multipliers is known.
  EXPECT_NEAR(branch.least() * branch.other(), std::exp(-damping * period), resolved);
}

TEST(Flips, DuffingsSecondIsThePublishedOne) {
  Branch branch(2, {0.5, 0.0});
  ASSERT_NO_FATAL_FAILURE(branch.settle(0.28, 300));
  const double g = find_root([&](double at) { return branch.beyond_the_flip(at); }, 0.284, 0.29);
  EXPECT_NEAR(g, 0.2866931578, last_digit);
  branch.beyond_the_flip(g);
  constexpr double resolved = 1e-10;  // as above: the slope is 106 here, and the orbit twice as long
  EXPECT_NEAR(branch.least(), -1.0, resolved);
  EXPECT_NEAR(branch.least() * branch.other(), std::exp(-damping * 2.0 * period), resolved);
}

}  // namespace
}  // namespace epicyclic::analysis::flips_test
