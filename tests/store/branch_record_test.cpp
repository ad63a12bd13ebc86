// Journal records of branches: exact, and damaged ones refused.

#include "store/branch_record.hpp"

#include <cstddef>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include "problems/branches.hpp"
#include "store/journal.hpp"

namespace epicyclic::store::branch_record_test {
namespace {

/// A tree of two branches, with folds, flips and an end at a flip of the other.
analysis::BifurcationDiagram planted() {
  const FieldFamily fields = problems::duffing(0.3, -1.0, 1.2);
  const analysis::OrbitFamily family{problems::flows(fields, 1e-8)};
  analysis::BifurcationDiagram tree(family, {.continuation = {.from = 0.1, .to = 0.5}});
  const analysis::Correction first = first_orbit(family, 0.2, problems::settled(family.flows, 0.2, {1.0, 0.0}, 100));
  EXPECT_TRUE(first.found);
  if (first.found) tree.start(first.orbit);
  return tree;
}

void expect_equal(const analysis::SpecialPoint& a, const analysis::SpecialPoint& b) {
  EXPECT_EQ(a.kind, b.kind);
  EXPECT_EQ(a.value, b.value);
  EXPECT_EQ(a.multiplier, b.multiplier);
  EXPECT_EQ(a.outwards, b.outwards);
  EXPECT_EQ(a.resonance, b.resonance);
  EXPECT_EQ(a.orbit.at.states, b.orbit.at.states);
  EXPECT_EQ(a.orbit.monodromy.factors, b.orbit.monodromy.factors);
}

TEST(BranchRecord, ATreeOfReadStepsIsTheSame) {
  analysis::BifurcationDiagram tree = planted();
  analysis::BifurcationDiagram again = planted();
  std::size_t branch_switches = 0;
  while (const auto step = tree.advance()) {
    branch_switches += step->branch_switches.size();
    again.apply(decode_step(encode_step(*step)));
  }
  EXPECT_GE(branch_switches, 1U);
  EXPECT_FALSE(again.advance().has_value());
  ASSERT_EQ(again.branches().size(), tree.branches().size());
  for (std::size_t b = 0; b < tree.branches().size(); ++b) {
    const analysis::Branch& expected = tree.branches()[b];
    const analysis::Branch& branch = again.branches()[b];
    ASSERT_EQ(branch.orbits.size(), expected.orbits.size());
    for (std::size_t k = 0; k < branch.orbits.size(); ++k) {
      EXPECT_EQ(branch.orbits[k].at.value, expected.orbits[k].at.value);
      EXPECT_EQ(branch.orbits[k].direction.states, expected.orbits[k].direction.states);
      EXPECT_EQ(branch.orbits[k].monodromy.factors, expected.orbits[k].monodromy.factors);
    }
    ASSERT_EQ(branch.special.size(), expected.special.size());
    for (std::size_t k = 0; k < branch.special.size(); ++k) expect_equal(branch.special[k], expected.special[k]);
    EXPECT_EQ(branch.first.born, expected.first.born);
    EXPECT_EQ(branch.last.end, expected.last.end);
    EXPECT_EQ(branch.first.place.has_value(), expected.first.place.has_value());
  }
}

TEST(BranchRecord, AStrongResonanceIsKept) {
  analysis::TreeStep step;
  step.special.emplace_back();
  step.special[0].kind = analysis::SpecialKind::neimark_sacker;
  step.special[0].resonance = 3;
  step.special[0].note = "as it was";
  const analysis::TreeStep again = decode_step(encode_step(step));
  ASSERT_EQ(again.special.size(), 1U);
  expect_equal(again.special[0], step.special[0]);
  EXPECT_EQ(again.special[0].note, step.special[0].note);
}

TEST(BranchRecord, DamageIsRefused) {
  analysis::BifurcationDiagram tree = planted();
  std::vector<std::byte> longest;
  while (const auto step = tree.advance()) {
    const std::vector<std::byte> record = encode_step(*step);
    if (record.size() > longest.size()) longest = record;
  }
  for (std::size_t size = 0; size < longest.size(); ++size)
    EXPECT_THROW((void)decode_step(std::span(longest).first(size)), DamagedData) << size;
  std::vector<std::byte> longer = longest;
  longer.push_back(std::byte{});
  EXPECT_THROW((void)decode_step(longer), DamagedData);
  std::vector<std::byte> kind = longest;
  kind[0] = std::byte{9};
  EXPECT_THROW((void)decode_step(kind), DamagedData);
}

}  // namespace
}  // namespace epicyclic::store::branch_record_test
