// Regimes of the paper's stage as a look tells them, and what their evidence is worth.

#include <cmath>
#include <functional>
#include <vector>

#include <gtest/gtest.h>

#include "analysis/lyapunov.hpp"
#include "core/errors.hpp"
#include "integrate/make_flow.hpp"
#include "problems/r1.hpp"
#include "studies/sweep.hpp"

namespace epicyclic::studies::regimes_test {
namespace {

bool always() { return true; }

model::DynamicModel nonlinear(double ratio, const model::ModelOptions& options = {}) {
  const gear::Stage stage = problems::as_printed(problems::r1_nonlinear());
  return model::make_dynamic_model(stage, model::scales_of(stage), ratio, options);
}

PointResult point_at(const model::DynamicModel& m, const RecordingOptions& recording) {
  return compute_point({0, Direction::up, m.omega}, m, {}, recording, {}, always);
}

TEST(Regimes, WithoutTangentsThereIsRecurrenceAlone) {
  // Damping that ends at the gap's edge jumps there; a smooth edge has tangents again.
  RecordingOptions recording;
  recording.transient_periods = 20;
  recording.recorded_periods = 16;
  recording.classification_periods = 64;
  model::ModelOptions options;
  options.gap_damping = model::GapDamping::contact_slope;
  const model::DynamicModel jumping = nonlinear(2.0, options);
  EXPECT_TRUE(jumping.jumps_at_surfaces);
  EXPECT_FALSE(point_at(jumping, recording).classified);
  const auto flow = integrate::make_flow(jumping, {});
  std::vector<double> y = jumping.default_start;
  std::vector<double> v(y.size(), 1.0);
  EXPECT_THROW((void)flow->evolve_tangents(y, v, 0.0, 1.0), InputError);
  options.clearance_smoothing = 0.1;
  EXPECT_TRUE(point_at(nonlinear(2.0, options), recording).classified);
}

TEST(Regimes, ASwitchedOffClassificationChangesNoOtherNumber) {
  RecordingOptions recording;
  recording.transient_periods = 60;
  recording.recorded_periods = 16;
  const model::DynamicModel m = nonlinear(2.0);
  const PointResult with = point_at(m, recording);
  const PointResult without = point_at(m, by_recurrence_alone(recording));
  EXPECT_EQ(with.poincare, without.poincare);
  EXPECT_EQ(with.end_state, without.end_state);
  EXPECT_GT(with.rhs_evaluations, without.rhs_evaluations);
  EXPECT_FALSE(without.classified);
  EXPECT_TRUE(std::isnan(without.lyapunov_max().value));
}

TEST(Regimes, AnAdaptiveTransientEndsOnTheOrbitOfALongOne) {
  RecordingOptions fixed;
  fixed.transient_periods = 1000;
  fixed.recorded_periods = 16;
  RecordingOptions adaptive = fixed;
  adaptive.transient = Transient::adaptive;
  for (const double ratio : {0.4, 2.0, 3.0}) {
    const model::DynamicModel m = nonlinear(ratio);
    const PointResult a = point_at(m, fixed);
    const PointResult b = point_at(m, adaptive);
    EXPECT_EQ(to_string(a.regime), to_string(b.regime)) << ratio;
    EXPECT_EQ(a.period, b.period) << ratio;
    if (a.regime == analysis::Regime::periodic) {
      constexpr double settled = 1e-5;  // the relative tolerance of 1e-8 times what multipliers near 1 hold up
      EXPECT_LT(b.recurrence.error, settled) << ratio;
    }
  }
}

}  // namespace
}  // namespace epicyclic::studies::regimes_test
