// A sun without support, in time: its meshes hold it if there are three planets or more, and nothing holds it across
// two.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "integrate/make_flow.hpp"
#include "model/dynamic_model.hpp"
#include "problems/r1.hpp"

namespace epicyclic::floating_sun_test {
namespace {

using model::Slots;

gear::Stage floating(int planets) {
  gear::Stage stage =
      problems::with_teeth(problems::with_moving_stiffness(problems::with_gap(problems::r1())), 24, 24, 72, planets);
  stage.sun.support_N_per_m = 0.0;
  stage.load = {std::nullopt, 600.0};
  return stage;
}

/// Largest distance of the sun from the centre in each quarter of a record, after a push.
std::vector<double> excursions(const gear::Stage& stage, int periods) {
  const model::DynamicModel m = model::make_dynamic_model(stage, model::scales_of(stage), 0.3, {});
  const auto flow = integrate::make_flow(m, {});
  std::vector<double> y = m.default_start;
  y[m.dimension / 2 + Slots::x_s] += 0.05;
  y[m.dimension / 2 + Slots::y_s] += 0.05;
  std::vector<double> largest(4, 0.0);
  for (int k = 0; k < periods; ++k) {
    EXPECT_TRUE(flow->evolve(y, 0.0, 2.0 * std::numbers::pi).reached());
    double& most = largest[static_cast<std::size_t>(4 * k / periods)];
    most = std::max(most, std::hypot(y[Slots::x_s], y[Slots::y_s]));
  }
  return largest;
}

TEST(FloatingSun, IsHeldByThreePlanetsAndMore) {
  for (const int planets : {3, 4}) {
    const std::vector<double> largest = excursions(floating(planets), 160);
    EXPECT_LT(largest[3], 0.2 * largest[0]) << planets;
    EXPECT_LT(largest[0], 5.0) << planets;
  }
}

/// Two planets stand opposite: their lines of action are parallel. Across them there is no force, and in the turning
/// frame the motion grows exponentially.
TEST(FloatingSun, DriftsBetweenTwoPlanets) {
  const std::vector<double> largest = excursions(floating(2), 80);
  EXPECT_GT(largest[3], 50.0 * largest[0]);
  EXPECT_GT(largest[3], 100.0);
}

}  // namespace
}  // namespace epicyclic::floating_sun_test
