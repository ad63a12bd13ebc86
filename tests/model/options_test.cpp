// The model's options refuse what no force can be computed with, by its name, where they enter.

#include "model/options.hpp"

#include <limits>

#include <gtest/gtest.h>

#include "core/errors.hpp"
#include "model/dynamic_model.hpp"
#include "model/scales.hpp"
#include "problems/r1.hpp"
#include "wrong_options.hpp"

namespace epicyclic::model::options_test {
namespace {

using O = ModelOptions;

TEST(ModelOptions, TheClearanceIsExactOrSmooth) {
  test::expect_refused<O>(
      {}, {{"clearance_smoothing", [](O& o) { o.clearance_smoothing = -0.1; }},
           {"clearance_smoothing", [](O& o) { o.clearance_smoothing = std::numeric_limits<double>::quiet_NaN(); }}});
}

TEST(ModelOptions, NoModelIsMadeOfWhatIsWrong) {
  const gear::Stage stage = problems::r1();
  O wrong;
  wrong.clearance_smoothing = -1;
  EXPECT_THROW((void)make_dynamic_model(stage, scales_of(stage), 1.0, wrong), InputError);
}

}  // namespace
}  // namespace epicyclic::model::options_test
