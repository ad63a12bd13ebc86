// One kernel, three scalars: numbers, lanes and dual numbers must agree.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <numbers>
#include <random>
#include <string>
#include <tuple>
#include <utility>

#include <gtest/gtest.h>

#include "core/dual.hpp"
#include "core/errors.hpp"
#include "core/lanes.hpp"
#include "model/kernels/lane_phase_coefficients.hpp"
#include "model/lane_parameters.hpp"
#include "model/parameters.hpp"
#include "model/right_hand_side.hpp"
#include "problems/r1.hpp"

namespace epicyclic::model::scalars_test {
namespace {

constexpr std::size_t planets = 3;
constexpr Layout layout = Layout::relative_to_carrier;
constexpr std::size_t dimension = 2 * degrees_of_freedom(layout, planets);
using State = std::array<double, dimension>;
using P = Parameters<double, planets>;

gear::Stage stage(gear::BearingLaw law) {
  gear::Stage s = problems::with_unequal_angles(problems::r1_nonlinear());
  s.sun_bearing = {10.0, law, 10, 16.67, 0.0};
  return s;
}

State random_state(std::mt19937_64& random) {
  // Deflections on all three sides of a half gap of 4.
  std::uniform_real_distribution<double> component(-4.0, 4.0);
  State y;
  for (double& x : y) x = component(random);
  return y;
}

State evaluate(const P& p, std::size_t segment, double s, const State& y) {
  State f;
  right_hand_side(layout, p, segment, s, y.data(), f.data());
  return f;
}

double middle(const P& p, std::size_t segment) {
  const bool wraps = segment + 1 == p.breakpoints.size();
  return 0.5 *
         (p.breakpoints[segment] + (wraps ? p.breakpoints[0] + 2.0 * std::numbers::pi : p.breakpoints[segment + 1]));
}

TEST(Scalars, LanesWithParametersOfTheirOwnAreTheSingleRuns) {
  constexpr std::size_t width = 4;
  using L = Lanes<width>;
  std::mt19937_64 random(31);
  for (const auto& [law, w] :
       {std::pair{gear::BearingLaw::linear_xy, 0.0}, std::pair{gear::BearingLaw::palmgren_radial, 0.05},
        std::pair{gear::BearingLaw::palmgren_xy, 0.0}, std::pair{gear::BearingLaw::linear_radial, 0.0}}) {
    std::array<std::shared_ptr<const P>, width> single;
    for (std::size_t lane = 0; lane < width; ++lane) {
      gear::Stage s = stage(law);
      s.sun_planet_mesh.backlash_half_um = 10.0 * static_cast<double>(lane);
      s.ring_planet_mesh.damping_ratio = 0.01 + 0.02 * static_cast<double>(lane);
      s.sun_bearing.clearance_half_um = 5.0 * static_cast<double>(lane);
      single[lane] = std::make_shared<const P>(make_parameters<planets>(
          s, scales_of(s), 0.5 + 0.4 * static_cast<double>(lane), {GapDamping::always, Gyroscopic::automatic, w}));
    }
    LaneParameters<planets, width> packed(single[0]);
    for (std::size_t lane = 0; lane < width; ++lane) packed.load(lane, single[lane]);
    for (std::size_t trial = 0; trial < 8; ++trial) {
      std::array<State, width> states;
      std::array<std::size_t, width> segments;
      L s;
      std::array<L, dimension> y;
      std::array<L, dimension> f;
      for (std::size_t lane = 0; lane < width; ++lane) {
        states[lane] = random_state(random);
        for (std::size_t k = 0; k < dimension; ++k) y[k].set(lane, states[lane][k]);
        // Each in a segment of its own, and on another turn.
        segments[lane] = (trial + lane) % single[lane]->segments.size();
        packed.set_segment(lane, segments[lane]);
        s.set(lane, middle(*single[lane], segments[lane]) + 2.0 * std::numbers::pi * static_cast<double>(lane));
      }
      PhaseCoefficients<L, planets> now;
      make_phase_coefficients(packed, 1, &s, &now);
      right_hand_side(layout, packed.constants(), now, y.data(), f.data());
      for (std::size_t lane = 0; lane < width; ++lane) {
        const State expected = evaluate(*single[lane], segments[lane], s[lane], states[lane]);
        double largest = 0.0;
        for (const double x : expected) largest = std::max(largest, std::abs(x));
        // The same operations in the same order; sine, cosine and places in tables may round otherwise.
        constexpr double rounding = 4e-15;
        for (std::size_t k = 0; k < dimension; ++k)
          EXPECT_NEAR(f[k][lane], expected[k], rounding * largest) << "lane " << lane << " component " << k;
      }
    }
  }
}

TEST(Scalars, PointsOfOtherStructureDoNotRunSideBySide) {
  const gear::Stage s = stage(gear::BearingLaw::linear_xy);
  const auto point = [](const gear::Stage& of, double w) {
    return std::make_shared<const P>(
        make_parameters<planets>(of, scales_of(of), 0.9, {GapDamping::always, Gyroscopic::automatic, w}));
  };
  LaneParameters<planets, 4> lanes(point(s, 0.0));
  EXPECT_NO_THROW(lanes.load(1, point(s, 0.0)));
  EXPECT_THROW(lanes.load(1, point(s, 0.1)), InputError);
  EXPECT_THROW(lanes.load(1, point(stage(gear::BearingLaw::linear_radial), 0.0)), InputError);
  gear::Stage without = s;
  without.sun_planet_mesh.friction = {};
  EXPECT_THROW(lanes.load(1, point(without, 0.0)), InputError);
}

TEST(Scalars, DualJacobianIsThatOfDifferences) {
  constexpr std::size_t width = 17;  // two passes for 34 columns
  static_assert(dimension % width == 0);
  using D = Dual<width>;
  std::mt19937_64 random(32);
  double worst = 0.0;
  for (const auto& [law, w, damping] : {std::tuple{gear::BearingLaw::linear_xy, 0.0, GapDamping::always},
                                        std::tuple{gear::BearingLaw::palmgren_radial, 0.5, GapDamping::contact_slope},
                                        std::tuple{gear::BearingLaw::palmgren_xy, 0.5, GapDamping::always},
                                        std::tuple{gear::BearingLaw::linear_radial, 0.0, GapDamping::always}}) {
    const gear::Stage s = stage(law);
    const P p = make_parameters<planets>(s, scales_of(s), 0.9, {damping, Gyroscopic::automatic, w});
    const auto p_dual = convert<D>(p);
    for (int trial = 0; trial < 5; ++trial) {
      const auto segment = static_cast<std::size_t>(trial);
      const double phase = middle(p, segment);
      const State y = random_state(random);
      const State value = evaluate(p, segment, phase, y);
      for (std::size_t first = 0; first < dimension; first += width) {
        std::array<D, dimension> y_dual;
        std::array<D, dimension> f;
        for (std::size_t k = 0; k < dimension; ++k) y_dual[k] = D(y[k]);
        for (std::size_t j = 0; j < width; ++j) y_dual[first + j] = D::variable(y[first + j], j);
        right_hand_side(layout, p_dual, segment, D(phase), y_dual.data(), f.data());
        // A dual division multiplies by the inverse: one rounding more.
        constexpr double rounding = 1e-14;
        for (std::size_t k = 0; k < dimension; ++k) EXPECT_NEAR(f[k].value, value[k], rounding);
        for (std::size_t j = 0; j < width; ++j) {
          // Fourth-order differences: exact for the piecewise-linear forms, where a short step stays off the kinks,
          // (h/w)^4 for the smooth ones; rounding / h.
          const double h = w > 0.0 ? 1e-3 : 1e-5;
          const auto at = [&](double step) {
            State moved = y;
            moved[first + j] += step;
            return evaluate(p, segment, phase, moved);
          };
          const State plus = at(h);
          const State minus = at(-h);
          const State plus_2 = at(2 * h);
          const State minus_2 = at(-2 * h);
          for (std::size_t k = 0; k < dimension; ++k) {
            const double slope = (8.0 * (plus[k] - minus[k]) - (plus_2[k] - minus_2[k])) / (12.0 * h);
            worst = std::max(worst, std::abs(f[k].derivative[j] - slope));
          }
        }
      }
    }
  }
  // Entries are of order 1.
  constexpr double differences = 1e-9;
  EXPECT_LT(worst, differences);
  RecordProperty("worst", std::to_string(worst * 1e12) + "e-12");
}

}  // namespace
}  // namespace epicyclic::model::scalars_test
