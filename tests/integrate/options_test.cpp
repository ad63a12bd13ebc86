// Options of integrators refuse what no step can be taken with, each member by its name, wherever they enter.

#include "integrate/options.hpp"

#include <functional>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

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
                               {"relative_tolerance", [](O& o) { o.relative_tolerance = 1e-300; }},
                               {"relative_tolerance", [](O& o) { o.relative_tolerance = 1e300; }},
                               {"absolute_tolerance", [](O& o) { o.absolute_tolerance = 1e-300; }},
                               {"absolute_tolerance", [](O& o) { o.absolute_tolerance = 1e300; }},
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

TEST(Flows, OfEachMethodRefuseAFieldThatIsNone) {
  const VectorField sound = problems::smooth_nonlinear();
  const std::vector<std::pair<std::string, std::function<void(VectorField&)>>> wrong = {
      {"right_hand_side", [](VectorField& f) { f.right_hand_side = {}; }},
      {"dimension", [](VectorField& f) { f.dimension = 0; }},
      {"period", [](VectorField& f) { f.period = -1.0; }},
      {"period", [](VectorField& f) { f.period = nan; }},
      {"breakpoint",
       [](VectorField& f) {
         f.breakpoints = {0.2, 0.1};
       }},
      {"breakpoint", [](VectorField& f) { f.breakpoints = {f.period}; }},
      {"sampling_interval", [](VectorField& f) { f.sampling_interval = {0.0}; }},
      {"sampling", [](VectorField& f) {
         f.sampling_interval = {1.0, 1.0};
       }}};
  for (const Method& method : methods())
    for (const auto& [word, set] : wrong) {
      VectorField field = sound;
      set(field);
      try {
        (void)make_flow(field, {.method = std::string(method.name)});
        ADD_FAILURE() << method.name << " takes a field whose " << word << " is wrong";
      } catch (const InputError& e) {
        EXPECT_NE(std::string(e.what()).find(word), std::string::npos) << e.what();
      }
    }
}

TEST(Flows, OfEachMethodRefuseSamplesThatDoNotRise) {
  for (const Method& method : methods()) {
    const auto flow = make_flow(problems::smooth_nonlinear(), {.method = std::string(method.name)});
    for (const std::vector<double>& samples :
         {std::vector{0.4, 0.2}, std::vector{-0.1, 0.2}, std::vector{0.1, nan}, std::vector{nan, 0.1}}) {
      std::vector<double> state(flow->field().dimension, 0.5);
      EXPECT_THROW((void)flow->evolve(state, 0.0, 1.0, samples, [](std::size_t, double, std::span<const double>) {}),
                   InputError)
          << method.name;
    }
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
