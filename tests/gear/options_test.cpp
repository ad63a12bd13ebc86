// Options of stiffnesses refuse what no tooth can be computed with, each member by its name, where they enter.

#include <limits>

#include <gtest/gtest.h>

#include "core/errors.hpp"
#include "gear/catalogue.hpp"
#include "gear/gear_set.hpp"
#include "gear/tooth_compliance.hpp"
#include "wrong_options.hpp"

namespace epicyclic::gear::options_test {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

TEST(GearOptions, CompliancesHaveAPanel) {
  using O = ComplianceOptions;
  test::expect_refused<O>({}, {{"panels", [](O& o) { o.panels = 0; }}});
}

TEST(GearOptions, StiffnessesArePositive) {
  using O = StiffnessOptions;
  test::expect_refused<O>({}, {{"panels", [](O& o) { o.compliance.panels = -1; }},
                               {"harmonics", [](O& o) { o.harmonics = -1; }},
                               {"sun_planet_factor", [](O& o) { o.sun_planet_factor = 0; }},
                               {"sun_planet_factor", [](O& o) { o.sun_planet_factor = nan; }},
                               {"ring_planet_factor", [](O& o) { o.ring_planet_factor = -1; }},
                               {"ring_planet_factor", [](O& o) { o.ring_planet_factor = nan; }},
                               {"table_tolerance", [](O& o) { o.table_tolerance = 0; }},
                               {"table_tolerance", [](O& o) { o.table_tolerance = nan; }}});
}

TEST(GearOptions, NothingIsComputedWithWhatIsWrong) {
  Stage stage;
  stage.catalogue.emplace();
  stage.catalogue->stiffness.harmonics = -1;
  EXPECT_THROW((void)make_gear_set(stage), InputError);
  EXPECT_THROW((void)tooth_compliance({}, 20.0, {.panels = 0}), InputError);
}

}  // namespace
}  // namespace epicyclic::gear::options_test
