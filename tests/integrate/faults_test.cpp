// Injected faults: whatever goes wrong inside the right-hand side becomes a status with a text, soon, silently, and
// with finite numbers.

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <random>
#include <string>

#include <gtest/gtest.h>

#include "integrate/make_flow.hpp"
#include "integrate/methods.hpp"
#include "problems/known_systems.hpp"

namespace epicyclic::integrate::faults_test {
namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;
constexpr int periods = 5;

enum class Fault { nan_from, inf_from, nan_once, growth, pole, chatter };

/// The clearance oscillator until phase `at`, then the fault.
VectorField faulty(Fault fault, double at, int component, long& calls) {
  auto field = problems::clearance_oscillator(0.85);
  const auto f = [fault, at, component, &calls, healthy = field.right_hand_side](std::size_t k, double s,
                                                                                 const double* y, double* d) {
    ++calls;
    healthy(k, s, y, d);
    if (s < at) return;
    double& hit = d[component];
    switch (fault) {
      case Fault::nan_from:
        hit = std::numeric_limits<double>::quiet_NaN();
        break;
      case Fault::inf_from:
        hit = component == 0 ? std::numeric_limits<double>::infinity() : -std::numeric_limits<double>::infinity();
        break;
      case Fault::nan_once:
        if (s < at + 1e-3) hit = calls % 2 == 0 ? hit : std::numeric_limits<double>::quiet_NaN();
        break;
      case Fault::growth:
        hit += 20.0 * y[component] + 1.0;
        break;
      case Fault::pole:
        hit += 1.0 / ((at + 0.1 - s) * (at + 0.1 - s));
        break;
      case Fault::chatter:
        hit += 50.0 * (std::sin(1e13 * s + 1e13 * y[0]) > 0.0 ? 1.0 : -1.0);
        break;
    }
  };
  field.right_hand_side = f;
  // Tangents of the healthy field: a Jacobian that is merely wrong must not hide the fault.
  return field;
}

TEST(Faults, TwoHundredInjectedFaultsEachHaveTheirStatus) {
  ::testing::internal::CaptureStdout();
  ::testing::internal::CaptureStderr();
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> phase(0.0, two_pi * periods);
  const std::array<const char*, 5> names = {"arkode-dopri5", "arkode-verner65", "arkode-kvaerno5", "cvode-adams",
                                            "cvode-bdf"};
  int injected = 0;
  for (const char* name : names) {
    IntegratorOptions o;
    o.method = name;
    o.max_steps_per_period = 1000000;
    const auto run = [&](VectorField field, Evolution& e, std::array<double, 2>& y) {
      const auto flow = make_flow(std::move(field), o);
      y = {1.1, 0.0};
      for (int k = 0; k < periods; ++k) {
        e = flow->evolve(y, k * two_pi, (k + 1) * two_pi);
        if (!e.reached()) break;
      }
      return flow->work().steps;
    };
    Evolution e;
    std::array<double, 2> y{};
    const long nominal = run(problems::clearance_oscillator(0.85), e, y);
    ASSERT_TRUE(e.reached());
    o.max_steps_per_period = 10 * nominal / periods;
    for (const Fault fault :
         {Fault::nan_from, Fault::inf_from, Fault::nan_once, Fault::growth, Fault::pole, Fault::chatter}) {
      for (int k = 0; k < 7; ++k) {
        long calls = 0;
        // Not in the last half period, so that each has room to show.
        const double at = phase(random) * (periods - 0.5) / periods;
        const long steps = run(faulty(fault, at, k % 2, calls), e, y);
        ++injected;
        const std::string what = std::string(name) + " fault " + std::to_string(static_cast<int>(fault)) + " at " +
                                 std::to_string(at) + ": " + e.message;
        EXPECT_LE(steps, 10 * nominal + 20) << what;
        EXPECT_TRUE(std::isfinite(y[0]) && std::isfinite(y[1])) << what;
        EXPECT_EQ(e.message.empty(), e.reached()) << what;
        switch (fault) {
          case Fault::nan_from:
          case Fault::inf_from:
            EXPECT_EQ(e.outcome, Outcome::failed) << what;
            EXPECT_LE(e.s, at) << what;
            break;
          case Fault::nan_once:
            // Stepped over, or given up: never a number that is not one.
            EXPECT_TRUE(e.reached() || e.outcome == Outcome::failed) << what;
            break;
          case Fault::growth:
            EXPECT_EQ(e.outcome, Outcome::diverged) << what;
            break;
          case Fault::pole:
            EXPECT_TRUE(e.outcome == Outcome::diverged || e.outcome == Outcome::failed ||
                        e.outcome == Outcome::step_limit)
                << what << static_cast<int>(e.outcome);
            EXPECT_LE(e.s, at + 0.1) << what;
            break;
          case Fault::chatter:
            EXPECT_TRUE(e.outcome == Outcome::step_limit || e.outcome == Outcome::failed) << what;
            break;
        }
      }
    }
  }
  EXPECT_GE(injected, 200);
  EXPECT_EQ(::testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace epicyclic::integrate::faults_test
