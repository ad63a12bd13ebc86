// Runs of the paper's stage: ended at any time, and what the errors of multipliers hold.

#include <algorithm>
#include <complex>
#include <cstddef>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <gtest/gtest.h>

#include "input/study_model.hpp"
#include "kinds/run/plan.hpp"
#include "studies/run.hpp"

namespace epicyclic::kinds::paper_run_test {
namespace {

struct Case {
  input::LoadedInput input;
  studies::RecordingOptions recording;
  studies::RunOptions options;
  model::DynamicModel model;

  explicit Case(const std::vector<std::string>& changes)
      : input(input::load_input("inputs/tang2020_run.json", input::parse_assignments(changes))),
        recording(input.study.recording()),
        options(input.study.plan.as<kinds::RunPlan>().run),
        model(input::model_at(input)(input.study.mesh_frequency_ratio)) {
    recording.transient_periods = 200;
    recording.recorded_periods = 32;
    recording.classification_periods = 64;
    options.spectrum_periods = 4;
    options.history_periods = 2;
    options.exponent_periods = 0;
  }

  [[nodiscard]] std::optional<studies::RunResult> run(const studies::RunControl& control = {}) const {
    return studies::run_operating_point(model, recording, options, input.study.integrator, control);
  }
};

TEST(PaperRun, EndsWheneverItIsAsked) {
  Case c({"/operation/mesh_frequency_ratio=2.8"});
  c.options.check_tolerance = 1e-6;
  c.options.exponent_periods = 10;
  std::size_t calls = 0;
  studies::RunControl control;
  control.go_on = [&calls] { return ++calls > 0; };
  const auto whole = c.run(control);
  ASSERT_TRUE(whole.has_value());
  ASSERT_TRUE(whole->checks.has_value());
  control.memory.point = whole->point;
  calls = 0;
  ASSERT_TRUE(c.run(control).has_value());
  const std::size_t all = calls;
  ASSERT_GT(all, 20U);
  // Each of the last ones, and some before.
  constexpr std::size_t each = 12;
  const std::size_t step = std::max<std::size_t>(1, all / each);
  for (std::size_t last = 1; last < all; last += last + each < all ? std::min(step, all - each - last) : 1) {
    calls = 0;
    control.go_on = [&calls, last] { return ++calls < last; };
    EXPECT_FALSE(c.run(control).has_value()) << last << " of " << all;
  }
}

/// Multipliers at a speed of period 1, the tables made for a tolerance.
analysis::FloquetMultipliers multipliers_at(const std::string& tolerance, bool curve) {
  std::vector<std::string> changes = {"/operation/mesh_frequency_ratio=0.42",
                                      "/stage/catalogue/lubrication/table_tolerance=" + tolerance,
                                      "/stage/catalogue/mesh_stiffness/table_tolerance=" + tolerance};
  if (curve) changes.emplace_back("/stage/catalogue/mesh_stiffness/form=curve");
  const auto r = Case(changes).run();
  EXPECT_TRUE(r && r->multipliers) << tolerance;
  return r && r->multipliers ? *r->multipliers : analysis::FloquetMultipliers{};
}

TEST(PaperRun, ErrorsOfMultipliersHoldThatOfTheTables) {
  for (const bool curve : {false, true}) {
    const analysis::FloquetMultipliers fine = multipliers_at("1e-12", curve);
    for (const char* tolerance : {"1e-3", "1e-6"}) {
      const analysis::FloquetMultipliers rough = multipliers_at(tolerance, curve);
      ASSERT_EQ(rough.values.size(), fine.values.size());
      for (std::size_t k = 0; k < rough.values.size(); ++k) {
        std::size_t nearest = 0;
        for (std::size_t i = 0; i < fine.values.size(); ++i)
          if (std::abs(fine.values[i] - rough.values[k]) < std::abs(fine.values[nearest] - rough.values[k]))
            nearest = i;
        EXPECT_LE(std::abs(fine.values[nearest] - rough.values[k]), rough.errors[k] + fine.errors[nearest])
            << tolerance << (curve ? ", curve, " : ", harmonics, ") << k;
      }
    }
  }
}

}  // namespace
}  // namespace epicyclic::kinds::paper_run_test
