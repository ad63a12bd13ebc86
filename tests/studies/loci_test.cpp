// Loci of the paper's stage in two parameters: where they are cut, branches have the same special points.

#include <cstddef>
#include <string>

#include <gtest/gtest.h>

#include "analysis/locus.hpp"
#include "problems/r1.hpp"
#include "studies/branches.hpp"

namespace epicyclic::studies::loci_test {
namespace {

model::DynamicModel model_at(double omega, double damping_ratio) {
  gear::Stage stage = problems::tang2020();
  for (gear::Mesh* mesh : {&stage.sun_planet_mesh, &stage.ring_planet_mesh}) mesh->damping_ratio = damping_ratio;
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

/// Branches over the frequency ratio at a damping ratio of the meshes.
BranchSystem system_at(double damping_ratio) {
  BranchesOptions options;
  options.from = 2.0;
  options.to = 3.5;
  options.starts = {3.3};
  return branch_system([damping_ratio](double omega) { return model_at(omega, damping_ratio); }, options,
                       model_at(3.3, damping_ratio));
}

struct Flip {
  bool found = false;
  bool keeps_symmetry = false;
  analysis::SpecialPoint point;
};

Flip flip_at(double damping_ratio) {
  const BranchSystem system = system_at(damping_ratio);
  const BranchOrigin from = steady_state_start(system, model_at(3.3, damping_ratio), 3.3, 400);
  EXPECT_TRUE(from.orbit.has_value()) << from.message;
  if (!from.orbit) return {};
  analysis::BifurcationDiagram tree(system.system, system.options);
  tree.start(*from.orbit, from.keeps_symmetry);
  while (tree.branches().empty() && tree.advance()) {
  }
  for (const analysis::SpecialPoint& p : tree.branches().at(0).special)
    if (p.kind == analysis::SpecialKind::period_doubling) return {true, from.keeps_symmetry, p};
  return {};
}

TEST(LociOfGearsLong, FlipsOfThePapersStageAreThoseOfItsBranches) {
  constexpr double light = 0.05;
  constexpr double heavy = 0.06;
  const Flip start = flip_at(light);
  const Flip end = flip_at(heavy);
  ASSERT_TRUE(start.found && end.found);
  analysis::OrbitSurface surface;
  surface.flows = [](double omega, double damping_ratio) { return system_at(damping_ratio).system.flows(omega); };
  surface.family = system_at(light).system;
  surface.family.keeps_symmetry = start.keeps_symmetry;
  surface.second_scale = 0.1;
  const auto finer = [](std::size_t k) {
    return [k](double omega, double damping_ratio) {
      return system_at(damping_ratio).options.special.others[k].flows(omega);
    };
  };
  const analysis::LocusOptions options{.along = {.from = 2.0, .to = 3.5},
                                       .second_from = 0.01,
                                       .second_to = heavy,
                                       .others = {{finer(0), 1}, {finer(1), 2}}};
  const analysis::LocusCorrection first = locus_start(surface, start.point, light);
  ASSERT_TRUE(first.found) << first.message;
  analysis::LocusTrace locus(surface, analysis::subject_of(start.point), options, first.point);
  while (locus.advance()) EXPECT_TRUE(locus.marks().empty());
  EXPECT_EQ(locus.end(), analysis::LocusEnd::range);
  EXPECT_EQ(locus.current().second(), heavy);
  EXPECT_NEAR(locus.current().first(), end.point.value, locus.current().first_bound + end.point.error_bound);
  constexpr double six_digits = 1e-6;  // bounds on the branch itself are 1e-7 at this tolerance
  EXPECT_LT(locus.current().first_bound, six_digits);
  RecordProperty("difference", std::to_string(locus.current().first() - end.point.value));
}

}  // namespace
}  // namespace epicyclic::studies::loci_test
