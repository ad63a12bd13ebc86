// A torsional pair of gears against the clearance oscillator in closed form: flows, points of sweeps, branches.

#include <cmath>
#include <cstddef>
#include <numbers>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "analysis/bifurcation_diagram.hpp"
#include "integrate/make_flow.hpp"
#include "problems/clearance_exact.hpp"
#include "problems/clearance_points.hpp"
#include "problems/pair.hpp"
#include "studies/branches.hpp"
#include "studies/sweep.hpp"

namespace epicyclic::studies::pair_oscillator_test {
namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;

model::DynamicModel pair_at(double w, double z, double mean, double e) {
  const gear::Stage stage = problems::torsional_pair(z, mean, e);
  return model::make_dynamic_model(stage, model::scales_of(stage), w, {});
}

/// State of the pair at mesh phase 0 from deflection and rate: w = delta + e sin s.
std::vector<double> state_of(const problems::ClearanceExact::State& x, double w, double e) {
  return {x[0], x[1] + e * w};
}
problems::ClearanceExact::State deflection_of(const double* y, double w, double e) { return {y[0], y[1] - e * w}; }

/// How far the closed form is from returning to a state after n periods.
double does_not_close(const problems::ClearanceExact& exact, const problems::ClearanceExact::State& x, int n) {
  const auto after = exact.periods(x, n);
  return std::max(std::abs(after[0] - x[0]), std::abs(after[1] - x[1]));
}

TEST(PairOscillator, FlowsAreTheClosedForm) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> component(-1.5, 1.5);
  integrate::IntegratorOptions tight;
  tight.relative_tolerance = tight.absolute_tolerance = 1e-13;
  tight.locate_contacts = true;  // a step over a kink has a lower order
  double most = 0.0;
  for (const problems::ClearancePoint& p : problems::near_flips_and_folds) {
    const problems::ClearanceExact exact(p.w, p.z, p.mean, p.e);
    const model::DynamicModel pair = pair_at(p.w, p.z, p.mean, p.e);
    const auto flow = integrate::make_flow(pair, tight);
    const problems::ClearanceExact::State x = {component(random), component(random)};
    std::vector<double> y = state_of(x, p.w, p.e);
    ASSERT_TRUE(flow->evolve(y, 0.0, two_pi).reached());
    const auto there = deflection_of(y.data(), p.w, p.e);
    const auto wanted = exact.evolve(x, 0.0, two_pi);
    most = std::max({most, std::abs(there[0] - wanted[0]), std::abs(there[1] - wanted[1])});
  }
  EXPECT_LT(most, 1e-10);
}

TEST(PairOscillator, OrbitsOfASweepAreThoseOfTheClosedForm) {
  RecordingOptions recording;
  recording.transient_periods = 100;
  integrate::IntegratorOptions tight;
  tight.relative_tolerance = tight.absolute_tolerance = 1e-12;
  tight.locate_contacts = true;  // a step over a kink has a lower order
  int periodic = 0;
  for (const double w : {0.6, 0.75, 0.9, 1.1, 1.3, 1.7}) {
    const model::DynamicModel pair = pair_at(w, 0.05, 0.1, 0.05);
    GridPoint point;
    point.value = w;
    const PointResult r = compute_point(point, pair, {}, recording, tight, [] { return true; });
    ASSERT_EQ(r.regime, analysis::Regime::periodic) << w;
    ASSERT_EQ(r.poincare_columns, 3U);  // w, w', delta
    ASSERT_EQ(r.orbit.size(), 2U);
    EXPECT_LT(
        does_not_close(problems::ClearanceExact(w, 0.05, 0.1, 0.05), deflection_of(r.orbit.data(), w, 0.05), r.period),
        1e-10)
        << w;
    periodic += r.period;
  }
  EXPECT_GE(periodic, 6);
}

TEST(PairOscillator, BranchesAreOrbitsOfTheClosedForm) {
  const auto model_at = [](double w) {
    const gear::Stage stage = problems::torsional_pair();
    const model::Scales scales = model::scales_of(stage);
    model::DynamicModel m = model::make_dynamic_model(stage, scales, w, {});
    model::set_parameter_derivative(
        m,
        [&](double value) {
          return model::OperatingPoint{stage, value, {}};
        },
        scales, w, 1e-3);
    return m;
  };
  BranchesOptions options;
  options.from = 0.6;
  options.to = 1.0;
  const BranchSystem system = branch_system(model_at, options, model_at(0.6));
  const BranchOrigin from = steady_state_start(system, model_at(0.6), 0.6, 100);
  ASSERT_TRUE(from.orbit.has_value()) << from.message;
  analysis::BifurcationDiagram tree(system.system, system.options);
  tree.start(*from.orbit, from.keeps_symmetry);
  while (tree.advance()) {
  }
  const std::vector<analysis::Branch> branches = tree.branches();
  ASSERT_FALSE(branches.empty());
  int folds = 0;
  double most = 0.0;
  for (const analysis::BranchOrbit& orbit : branches[0].orbits) {
    const double w = orbit.at.value;
    const std::vector<double> y(orbit.at.states.col(0).begin(), orbit.at.states.col(0).end());
    most = std::max(most,
                    does_not_close(problems::ClearanceExact(w, 0.05, 0.1, 0.05), deflection_of(y.data(), w, 0.05), 1));
  }
  EXPECT_LT(most, 1e-9);
  for (const analysis::SpecialPoint& p : branches[0].special) folds += p.kind == analysis::SpecialKind::fold ? 1 : 0;
  EXPECT_EQ(folds, 2);  // jump up, jump down
}

}  // namespace
}  // namespace epicyclic::studies::pair_oscillator_test
