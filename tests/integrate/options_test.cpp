// Options of integrators refuse what no step can be taken with, each member by its name, wherever they enter.

#include "integrate/options.hpp"

#include <limits>
#include <string>

#include <gtest/gtest.h>

#include "core/errors.hpp"
#include "integrate/lanes/lane_ensemble.hpp"
#include "integrate/make_flow.hpp"
#include "integrate/methods.hpp"
#include "integrate/sundials/arkode_flow.hpp"
#include "integrate/sundials/cvode_flow.hpp"
#include "problems/known_systems.hpp"
#include "wrong_options.hpp"

namespace epicyclic::integrate::options_test {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

using O = IntegratorOptions;

TEST(IntegratorOptions, HaveAMethodTolerancesAndCaps) {
  test::expect_refused<O>({}, {{"method", [](O& o) { o.method = ""; }},
                               {"method", [](O& o) { o.method = "dopri5"; }},
                               {"relative_tolerance", [](O& o) { o.relative_tolerance = 0; }},
                               {"relative_tolerance", [](O& o) { o.relative_tolerance = nan; }},
                               {"absolute_tolerance", [](O& o) { o.absolute_tolerance = -1e-8; }},
                               {"absolute_tolerance", [](O& o) { o.absolute_tolerance = nan; }},
                               {"max_steps_per_period", [](O& o) { o.max_steps_per_period = 0; }},
                               {"escape_bound", [](O& o) { o.escape_bound = 0; }},
                               {"escape_bound", [](O& o) { o.escape_bound = nan; }},
                               {"max_order", [](O& o) { o.max_order = -1; }}});
  O least;
  least.max_steps_per_period = 1;
  least.escape_bound = infinity;
  EXPECT_NO_THROW(least.validate());
}

TEST(IntegratorOptions, ExplicitMethodsOfArkodeAloneLocateContacts) {
  for (const Method& method : methods()) {
    O o;
    o.method = method.name;
    EXPECT_NO_THROW(o.validate()) << method.name;
    o.locate_contacts = true;
    if (method.family == Family::erk)
      EXPECT_NO_THROW(o.validate()) << method.name;
    else
      EXPECT_THROW(o.validate(), InputError) << method.name;
  }
}

TEST(IntegratorOptions, AnUnknownMethodIsToldWhichThereAre) {
  try {
    (void)method_named("dopri5");
    ADD_FAILURE() << "was found";
  } catch (const InputError& e) {
    for (const std::string& name : method_names()) EXPECT_NE(std::string(e.what()).find(name), std::string::npos);
  }
}

TEST(IntegratorOptions, NoFlowAndNoLanesAreMadeOfWhatIsWrong) {
  const VectorField field = problems::smooth_nonlinear();
  for (const Method& method : methods()) {
    O o;
    o.method = method.name;
    o.relative_tolerance = nan;
    EXPECT_THROW((void)make_flow(field, o), InputError) << method.name;
  }
  O wrong;
  wrong.max_steps_per_period = 0;
  EXPECT_THROW((void)make_arkode_flow(field, wrong), InputError);
  EXPECT_THROW((void)make_arkode_fixed_step_flow(field, wrong, 0.1), InputError);
  wrong.method = "cvode-adams";
  EXPECT_THROW((void)make_cvode_flow(field, wrong), InputError);
  wrong.method = "lanes-dopri5";
  EXPECT_THROW(LaneEnsemble(one_by_one(step_loops().width, field.dimension), wrong), InputError);
  EXPECT_THROW((void)make_arkode_flow(field, {.method = "cvode-bdf"}), InputError);
  EXPECT_THROW((void)make_cvode_flow(field, {.method = "lanes-dopri5"}), InputError);
}

}  // namespace
}  // namespace epicyclic::integrate::options_test
