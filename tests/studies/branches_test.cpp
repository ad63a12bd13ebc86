// Branches of the paper's stage: what they tell is what motions do.

#include "studies/branches.hpp"

#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "analysis/poincare.hpp"
#include "core/errors.hpp"
#include "problems/gear_flow.hpp"
#include "problems/r1.hpp"

namespace epicyclic::studies::branches_test {
namespace {

model::DynamicModel model_at(double omega) {
  const gear::Stage stage = problems::tang2020();
  const model::Scales scales = model::scales_of(stage);
  const auto at = [&](double value) {
    model::OperatingPoint p;
    p.stage = stage;
    p.mesh_frequency_ratio = value;
    return p;
  };
  model::DynamicModel model = model::make_dynamic_model(stage, scales, omega, {});
  model::set_parameter_derivative(model, at, scales, omega, 1e-3);
  return model;
}

std::vector<analysis::Branch> grown(const BranchSystem& system, double start, int transient_periods) {
  const BranchOrigin from = settled_start(system, model_at(start), start, transient_periods);
  EXPECT_TRUE(from.orbit.has_value()) << from.message;
  analysis::BifurcationDiagram tree(system.system, system.options);
  if (from.orbit) tree.start(*from.orbit, from.keeps_symmetry);
  while (tree.advance()) {
  }
  return tree.branches();
}

/// Least period that a motion recurs with after some thousand periods from near an orbit.
int period_near(const analysis::OrbitFamily& family, const analysis::BranchOrbit& orbit, double omega) {
  const auto flow = family.flows(omega);
  std::vector<double> y(orbit.at.states.col(0).begin(), orbit.at.states.col(0).end());
  y[0] += 1e-3;
  const auto s = analysis::strobe(
      *flow, y, {1500, 32, 1}, [](auto&&...) {}, [] { return true; });
  EXPECT_TRUE(s.evolution.reached());
  return analysis::recurrence(s.section, 8, 1e-5).period;
}

TEST(Branches, FlipOfThePapersStageIsWhereMotionsDouble) {
  BranchesOptions options;
  options.from = 2.0;
  options.to = 3.5;
  options.starts = {3.3};
  options.values = {2.1, 2.2};
  const BranchSystem system = branch_system(model_at, options, model_at(3.3));
  ASSERT_EQ(system.system.symmetry.order, 3);
  const std::vector<analysis::Branch> all = grown(system, 3.3, 400);
  ASSERT_EQ(all.size(), 2U);
  const analysis::Branch& one = all[0];
  const analysis::Branch& two = all[1];
  ASSERT_EQ(one.special.size(), 1U);
  EXPECT_EQ(to_string(one.special[0].kind), "flip");
  constexpr double eight_digits = 1e-8;
  EXPECT_LT(one.special[0].error_bound, eight_digits);
  EXPECT_EQ(two.family.period, 2);
  EXPECT_TRUE(two.first.born);

  // What rows say is stable attracts motions from beside it, and the others do not.
  const auto orbit_at = [](const analysis::Branch& branch, double value) -> const analysis::BranchOrbit& {
    for (const analysis::BranchOrbit& o : branch.orbits)
      if (o.at.value == value) return o;
    throw std::out_of_range("no orbit there");
  };
  struct Case {
    const analysis::Branch* branch;
    double value;
    bool stable;
    int period;  ///< of a motion from beside it
  };
  for (const Case& c : {Case{&one, 2.2, true, 1}, Case{&one, 2.1, false, 2}, Case{&two, 2.1, true, 2}}) {
    const analysis::BranchOrbit& orbit = orbit_at(*c.branch, c.value);
    const auto row = branch_row(c.branch->family, orbit, model_at(c.value), 64);
    ASSERT_TRUE(row.carried);
    EXPECT_EQ(row.stable, c.stable) << c.value;
    EXPECT_EQ(row.stable, row.multiplier_max() < 1.0);
    EXPECT_EQ(row.section.size(), static_cast<std::size_t>(c.branch->family.period) * 40U);  // state, deflections
    EXPECT_EQ(period_near(c.branch->family, orbit, c.value), c.period) << c.value;
    // The meshes of one kind move alike, and what they do is what a sweep records of the motion.
    EXPECT_LT(row.meshes.planet_spread, eight_digits);
    EXPECT_LT(row.meshes.sun_planet[0].delta.least, row.meshes.sun_planet[0].delta.largest);
  }
}

// Over the whole range the planets' contacts are made and lost together, to rounding: steps onto them are as short.
TEST(BranchesLong, OfPeriod1GoesThroughTheWholeRange) {
  BranchesOptions options;
  options.starts = {3.3};
  options.period_max = 1;
  options.branch_points = false;
  const BranchSystem system = branch_system(model_at, options, model_at(3.3));
  const std::vector<analysis::Branch> all = grown(system, 3.3, 400);
  ASSERT_EQ(all.size(), 1U);
  EXPECT_EQ(all[0].orbits.front().at.value, 0.2);
  EXPECT_EQ(all[0].orbits.back().at.value, 3.5);
  EXPECT_GE(all[0].special.size(), 20U);
  for (const analysis::SpecialPoint& p : all[0].special) {
    EXPECT_NE(p.kind, analysis::SpecialKind::unresolved) << p.value << ": " << p.note;
    EXPECT_TRUE(p.note.empty()) << p.value << ": " << p.note;
  }
}

TEST(Branches, RowsAreWhatASweepRecords) {
  BranchesOptions options;
  options.from = 2.9;
  options.to = 3.5;
  options.starts = {3.3};
  const BranchSystem system = branch_system(model_at, options, model_at(3.3));
  const BranchOrigin start = settled_start(system, model_at(3.3), 3.3, 400);
  ASSERT_TRUE(start.orbit.has_value()) << start.message;
  const auto row = branch_row(system.system, *start.orbit, model_at(3.3), 64);
  ASSERT_TRUE(row.carried);
  GridPoint at;
  at.value = 3.3;
  RecordingOptions recording;
  recording.transient_periods = 6000;  // the softest support mode decays by half a percent a period
  const PointResult point =
      compute_point(at, model_at(3.3), {}, recording, problems::tight(1e-11), [] { return true; });
  ASSERT_EQ(point.period, 1);
  constexpr double settled = 1e-5;  // what the soft support modes leave after so many periods
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(row.meshes.sun_planet[i].delta.least, point.meshes.sun_planet[i].delta.least, settled);
    EXPECT_NEAR(row.meshes.ring_planet[i].delta.largest, point.meshes.ring_planet[i].delta.largest, settled);
    EXPECT_EQ(row.meshes.sun_planet[i].contact(), point.meshes.sun_planet[i].contact());
  }
  ASSERT_EQ(row.section.size(), point.poincare_columns);
  const std::size_t last = point.poincare.size() - point.poincare_columns;
  for (std::size_t k = 0; k < row.section.size(); ++k) EXPECT_NEAR(row.section[k], point.poincare[last + k], settled);
}

TEST(Branches, AStartWithoutAnOrbitSaysSo) {
  BranchesOptions options;
  options.starts = {0.7};
  const BranchSystem system = branch_system(model_at, options, model_at(0.7));
  const BranchOrigin start = settled_start(system, model_at(0.7), 0.7, 50);
  ASSERT_FALSE(start.orbit.has_value());
  EXPECT_NE(start.message.find("no orbit of period 1"), std::string::npos) << start.message;
  BranchesOptions wrong;
  EXPECT_EQ(wrong.all_starts(), (std::vector<double>{0.2, 1.85, 3.5}));
  wrong.starts = {4.0};
  EXPECT_THROW(wrong.validate(), InputError);
  BranchesOptions bad_seed;
  bad_seed.seeds = {{1.0, 1, {}}};
  EXPECT_THROW(bad_seed.validate(), InputError);
  bad_seed.seeds = {{4.0, 1, {0.0}}};
  EXPECT_THROW(bad_seed.validate(), InputError);
}

}  // namespace
}  // namespace epicyclic::studies::branches_test
