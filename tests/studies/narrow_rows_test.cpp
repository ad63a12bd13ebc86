// Motions of stages whose stiffness changes within a small part of the mesh period.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "core/random_numbers.hpp"
#include "integrate/make_flow.hpp"
#include "model/dynamic_model.hpp"
#include "problems/r1.hpp"

namespace epicyclic::studies::narrow_rows_test {
namespace {

using model::DynamicModel;

/// R1 with constant stiffness but for a dip of the sun-planet mesh.
/// @param width  of the dip, in parts of the period
DynamicModel with_dip(double centre, double width, double depth, int rows, bool straight) {
  gear::Stage s = problems::with_teeth(problems::r1(), 28, 26, 80, 3);
  for (gear::Mesh* mesh : {&s.sun_planet_mesh, &s.ring_planet_mesh}) mesh->error_amplitude_um = {0.0};
  gear::Mesh& mesh = s.sun_planet_mesh;
  gear::StiffnessCurve curve;
  if (straight) curve.interpolation = Interpolation::linear;
  curve.phase.push_back(0.0);
  for (int k = -rows; k <= rows; ++k) curve.phase.push_back(centre + 0.5 * width * k / rows);
  const auto part = [&](double phase) { return std::max(0.0, 1.0 - std::abs(phase - centre) / (0.5 * width)); };
  double mean = 1.0;
  mean -= 0.5 * depth * width;
  const double outside = mesh.stiffness_N_per_m / mean;
  for (const double phase : curve.phase) curve.stiffness_N_per_m.push_back(outside * (1.0 - depth * part(phase)));
  mesh.stiffness_curve = curve;
  EXPECT_TRUE(gear::problems_for_dynamics(s).empty());
  return model::make_dynamic_model(s, model::scales_of(s), 1.0, {});
}

/// The state after two periods from the static equilibrium.
std::vector<double> carried(const DynamicModel& model, const integrate::IntegratorOptions& options) {
  std::vector<double> y = model.default_start;
  const auto flow = integrate::make_flow(model, options);
  for (int k = 0; k < 2; ++k) EXPECT_TRUE(flow->evolve(y, 0.0, model.period).reached());
  return y;
}

double apart(const std::vector<double>& a, const std::vector<double>& b) {
  double most = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, std::abs(a[i] - b[i]));
  return most;
}

/// Random dips of 0.1 % to 3 % of the period, by rows at the edges and in between.
void no_dip_is_stepped_over(int dips) {
  integrate::IntegratorOptions exact;
  exact.relative_tolerance = exact.absolute_tolerance = 1e-11;
  exact.max_steps_per_period = 1'000'000;
  for (int k = 0; k < dips; ++k) {
    const auto draw = [k](std::uint64_t n) { return random_uniform(5, 8 * static_cast<std::uint64_t>(k) + n); };
    const double width = std::pow(10.0, -3.0 + 1.5 * draw(1));
    const double centre = 0.05 + 0.9 * draw(2);
    const double depth = 0.2 + 0.6 * draw(3);
    const int rows = 1 + static_cast<int>(3.0 * draw(4));
    const DynamicModel model = with_dip(centre, width, depth, rows, draw(5) < 0.5);
    exact.max_step_periods = width / (8.0 * rows);
    const std::vector<double> expected = carried(model, exact);
    ASSERT_GT(apart(expected, model.default_start), 1e-5);
    for (const char* method : {"arkode-dopri5", "lanes-dopri5"}) {
      integrate::IntegratorOptions o;
      o.method = method;
      // Errors of steps add up, over a hundred of them.
      constexpr double of_a_tolerance = 1e2;
      ASSERT_LT(apart(carried(model, o), expected), of_a_tolerance * o.relative_tolerance)
          << method << ": a dip of " << depth << " at " << centre << ", " << width << " wide";
    }
  }
}

TEST(NarrowRows, NoDipOfAStiffnessCurveIsSteppedOver) { no_dip_is_stepped_over(40); }
TEST(NarrowRowsLong, NoneOfAThousandDipsIsSteppedOver) { no_dip_is_stepped_over(1000); }

}  // namespace
}  // namespace epicyclic::studies::narrow_rows_test
