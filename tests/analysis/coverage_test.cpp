// How often do 95 % intervals hold the truth? 400 runs from 400 seeds for each chaotic motion's largest exponent, 4000
// for each autoregressive series. Of 400 exact intervals, the part that holds has a standard deviation of 1.1 %. Short
// looks are taken one after the other, as many as fit into a run: of 4000, it has 0.3 %. Seeds are 1, 2, 3 ..., none
// left out. A chaotic motion is another one after a change of a rounding: then a look of 2000 periods, which fits once
// into a run, is outside 93 % to 97 % once in 15 times by chance alone.

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <iostream>
#include <numbers>
#include <numeric>
#include <random>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "analysis/lyapunov.hpp"
#include "analysis/statistics.hpp"
#include "integrate/make_flow.hpp"
#include "problems/clearance_exact.hpp"
#include "problems/clearance_points.hpp"
#include "problems/known_systems.hpp"

namespace epicyclic::analysis::coverage_test {
namespace {

constexpr int runs = 400;

/// Numbers from the bits of the generator, which the standard fixes; its distributions it does not.
class Numbers {
 public:
  explicit Numbers(int seed) : bits_(static_cast<std::uint64_t>(seed)) {}

  /// In [0, 1), of 53 bits.
  double uniform() { return static_cast<double>(bits_() >> 11U) * 0x1p-53; }

  /// Of mean 0 and variance 1, by Box and Muller.
  double normal() {
    const double r = std::sqrt(-2.0 * std::log(1.0 - uniform()));
    return r * std::cos(2.0 * std::numbers::pi * uniform());
  }

 private:
  std::mt19937_64 bits_;
};

struct Range {
  double low = 0;
  double high = 0;
};

/// A chaotic motion seen once per period of its field. The reference is the mean of 100 runs of 10000 periods at a
/// tolerance of 1e-8, from seeds 1001 to 1100 and otherwise as below; its error is their standard deviation over 10.
struct System {
  VectorField field;
  std::vector<Range> start;
  double exponent = 0;        ///< per unit of time
  double standard_error = 0;  ///< of that
};

/// A look at a motion: periods that are counted, and the percentage of intervals that may hold the reference.
struct Look {
  std::size_t periods = 0;
  Range percent;
};

void expect_coverage(const System& system, std::span<const Look> windows) {
  integrate::IntegratorOptions o;
  o.relative_tolerance = o.absolute_tolerance = 1e-6;  // the references at 1e-8 show that it does not matter
  o.max_steps_per_period = 1000000;
  const double period = system.field.period;
  std::vector<int> taken(windows.size(), 0);
  std::vector<int> held(windows.size(), 0);
  std::vector<double> width(windows.size(), 0.0);
  for (int seed = 1; seed <= runs; ++seed) {
    Numbers numbers(seed);
    std::vector<double> y;
    for (const Range& r : system.start) y.push_back(r.low + (r.high - r.low) * numbers.uniform());
    const auto flow = integrate::make_flow(system.field, o);
    // What aligns the tangent vector for 200 periods lets the motion settle, too.
    const int counted = static_cast<int>(windows.back().periods);
    const LargestExponent e =
        largest_exponent(*flow, y, {.aligning_periods = 200, .periods = counted}, {}, [] { return true; });
    ASSERT_TRUE(e.evolution.reached()) << "seed " << seed;
    for (std::size_t k = 0; k < windows.size(); ++k) {
      const std::size_t n = windows[k].periods;
      for (std::size_t first = 0; first + n <= e.growth.size(); first += n) {
        // As largest_exponent says, having counted these.
        const Estimate window = series_mean(std::span(e.growth).subspan(first, n));
        ++taken[k];
        held[k] += window.low() <= system.exponent * period && system.exponent * period <= window.high() ? 1 : 0;
        width[k] += window.half_width / period;
        if (n == e.growth.size()) {
          EXPECT_DOUBLE_EQ(window.half_width / period, e.per_s.half_width);
        }
      }
    }
  }
  for (std::size_t k = 0; k < windows.size(); ++k) {
    const double percent = 100.0 * held[k] / taken[k];
    width[k] /= taken[k];
    ::testing::Test::RecordProperty("percent_" + std::to_string(windows[k].periods), std::to_string(percent));
    ::testing::Test::RecordProperty("half_width_" + std::to_string(windows[k].periods), std::to_string(width[k]));
    EXPECT_GE(percent, windows[k].percent.low) << windows[k].periods << " periods";
    EXPECT_LE(percent, windows[k].percent.high) << windows[k].periods << " periods";
    EXPECT_LT(system.standard_error, 0.1 * width[k]) << windows[k].periods << " periods";
  }
}

/// 95 %, give or take less than twice the scatter of 400 runs, where there is no more than one look in each.
constexpr Range right = {93.0, 97.0};

/// The classification's looks of 256 and 512 periods without their first quarters, LyapunovOptions' periods, and more.
constexpr std::array<Look, 5> as_said = {{{192, right}, {384, right}, {500, right}, {1000, right}, {2000, right}}};

TEST(CoverageLong, OfDuffingsExponent) {
  const System duffing = {problems::duffing(0.25, -1.0, 0.4, 1.0), {{-1.0, 1.0}, {-1.0, 1.0}}, 0.15726, 0.00016};
  expect_coverage(duffing, as_said);
}

TEST(CoverageLong, OfLorenzExponent) {
  System lorenz = {problems::lorenz(), {{-10.0, 10.0}, {-10.0, 10.0}, {15.0, 35.0}}, 0.90570, 0.00016};
  lorenz.field.period = 1.0;
  // Seen without regard to its turns, the motion leaves the tangent vector longer here and shorter there: most of a
  // short look's variance are its two ends, which the waves see grow with their frequency. The interval of 192 periods
  // is too wide, then (97.3 % in 2000 other runs), and right from 384 on.
  std::array<Look, as_said.size()> windows = as_said;
  windows[0].percent.high = 98.5;
  expect_coverage(lorenz, windows);
}

TEST(CoverageLong, OfRoesslersExponent) {
  // Once per turn, roughly.
  System roessler = {problems::roessler(), {{-4.0, 4.0}, {-4.0, 4.0}, {0.0, 0.0}}, 0.07146, 0.00005};
  roessler.field.period = 6.0;
  expect_coverage(roessler, as_said);
}

/// Growth of a vector, period by period, of a motion that is known without an integrator.
using Growth = std::function<std::vector<double>(int seed, std::size_t periods)>;

/// By the closed form of the clearance oscillator.
Growth of_clearance(const problems::ClearancePoint& p) {
  return [p](int seed, std::size_t periods) {
    const problems::BasicClearanceExact<double> exact(p.w, p.z, p.mean, p.e);
    Numbers numbers(seed);
    constexpr int settling = 2000;
    auto y = exact.periods({1.1 + 0.1 * numbers.uniform(), 0.1 * numbers.uniform()}, settling);
    std::array<double, 2> v = {0.8, 0.6};
    std::vector<double> growth;
    constexpr std::size_t aligning = 200;
    for (std::size_t k = 0; k < aligning + periods; ++k) {
      problems::BasicClearanceExact<double>::Matrix m = {1.0, 0.0, 0.0, 1.0};
      y = exact.periods(y, 1, &m);
      v = {m[0] * v[0] + m[1] * v[1], m[2] * v[0] + m[3] * v[1]};
      const double length = std::hypot(v[0], v[1]);
      v = {v[0] / length, v[1] / length};
      if (k >= aligning) growth.push_back(std::log(length));
    }
    return growth;
  };
}

/// x -> r x (1 - x).
Growth of_logistic(double r) {
  return [r](int seed, std::size_t periods) {
    double x = 0.2 + 0.6 * Numbers(seed).uniform();
    std::vector<double> growth;
    constexpr std::size_t settling = 1000;
    for (std::size_t k = 0; k < settling + periods; ++k) {
      if (k >= settling) growth.push_back(std::log(std::abs(r * (1.0 - 2.0 * x))));
      x = r * x * (1.0 - x);
    }
    return growth;
  };
}

/// x -> 1 - 1.4 x^2 + y, y -> 0.3 x.
std::vector<double> of_henon(int seed, std::size_t periods) {
  constexpr double a = 1.4;
  constexpr double b = 0.3;
  Numbers numbers(seed);
  std::array<double, 2> y = {0.1 * numbers.uniform(), 0.1 * numbers.uniform()};
  std::array<double, 2> v = {0.8, 0.6};
  std::vector<double> growth;
  constexpr std::size_t settling = 1000;
  for (std::size_t k = 0; k < settling + periods; ++k) {
    v = {-2.0 * a * y[0] * v[0] + v[1], b * v[0]};
    y = {1.0 - a * y[0] * y[0] + y[1], b * y[0]};
    const double length = std::hypot(v[0], v[1]);
    v = {v[0] / length, v[1] / length};
    if (k >= settling) growth.push_back(std::log(length));
  }
  return growth;
}

/// Of 1000 looks one after another, at a truth from another seed and as many periods.
void expect_coverage_of_a_thousand(const std::string& name, const Growth& growth, std::size_t periods) {
  constexpr std::size_t windows = 1000;
  const std::vector<double> other = growth(2, windows * periods);
  const double truth = std::accumulate(other.begin(), other.end(), 0.0) / static_cast<double>(other.size());
  const std::vector<double> all = growth(1, windows * periods);
  int held = 0;
  for (std::size_t k = 0; k < windows; ++k) {
    const Estimate e = series_mean(std::span(all).subspan(k * periods, periods));
    held += e.low() <= truth && truth <= e.high() ? 1 : 0;
  }
  const double percent = 100.0 * held / static_cast<double>(windows);
  ::testing::Test::RecordProperty(name + "_" + std::to_string(periods), std::to_string(percent));
  std::cout << name << ", " << periods << " periods: " << percent << " %\n";
  EXPECT_GE(percent, right.low) << name << ", " << periods << " periods";
  EXPECT_LE(percent, right.high) << name << ", " << periods << " periods";
}

/// The first is where outside use found 6 of 10.
const std::array<std::pair<const char*, Growth>, 5> without_integrator = {
    {{"clearance_1.70", of_clearance({0.05, 0.1, 0.1, 1.70})},
     {"clearance_1.45", of_clearance({0.0339, 0.0708, 0.1154, 1.45})},
     {"clearance_1.19", of_clearance({0.034062, 0.083886, 0.172234, 1.189867})},
     {"logistic_3.9", of_logistic(3.9)},
     {"henon", of_henon}}};

TEST(Coverage, OfAThousandIntervalsOfFiveSystems) {
  for (const auto& [name, growth] : without_integrator) expect_coverage_of_a_thousand(name, growth, 500);
}

TEST(CoverageLong, OfAThousandIntervalsOfFiveSystems) {
  for (const auto& [name, growth] : without_integrator)
    for (const std::size_t periods : {384U, 1000U, 2000U}) expect_coverage_of_a_thousand(name, growth, periods);
}

TEST(Coverage, OfAutoregressiveMeans) {
  // x_t+1 = m x_t + noise remembers for about 1 / (1 - m) values; the longest memory here is a twenty-fifth of its
  // series.
  struct Series {
    double m = 0;
    std::size_t length = 0;
  };
  for (const auto& [m, length] :
       {Series{-0.8, 500}, Series{-0.5, 500}, Series{0.0, 192}, Series{0.5, 192}, Series{0.8, 384}, Series{0.9, 250},
        Series{0.9, 500}, Series{0.95, 500}, Series{0.95, 1000}}) {
    constexpr int cheap_runs = 10 * runs;
    int held = 0;
    for (int seed = 1; seed <= cheap_runs; ++seed) {
      Numbers numbers(seed);
      std::vector<double> series(length);
      double x = numbers.normal() / std::sqrt(1.0 - m * m);
      for (double& value : series) value = x = m * x + numbers.normal();
      const Estimate e = series_mean(series);
      held += e.low() <= 0.0 && 0.0 <= e.high() ? 1 : 0;
    }
    const double percent = 100.0 * held / cheap_runs;
    EXPECT_GE(percent, right.low) << "m = " << m;
    EXPECT_LE(percent, right.high) << "m = " << m;
  }
}

}  // namespace
}  // namespace epicyclic::analysis::coverage_test
