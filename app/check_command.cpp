// epicyclic check: validates, prints the resolved input on stdout and its cost on stderr; writes nothing.

#include <nlohmann/json.hpp>

#include "commands.hpp"
#include "input/study_model.hpp"
#include "session.hpp"
#include "streams.hpp"
#include "studies/probes.hpp"

namespace epicyclic::app {

int check_command(const Arguments& arguments) {
  const input::LoadedInput input = input::load_input(arguments.input, input::parse_assignments(arguments.sets));
  tell_warnings(input);
  if (!input.study.has_motion()) {
    print("{}\n", input.resolved.dump(2));
    tell("{}: valid; a stage alone, for `epicyclic gear`\n", arguments.input.string());
    return done;
  }
  if (!input.study.has_points()) {
    print("{}\n", input.resolved.dump(2));
    tell("{}: valid\ncost: that of branches is not known before they are followed; `orbits` and `branches` bound it\n",
         arguments.input.string());
    return done;
  }
  const studies::Cost cost = studies::estimate_cost(input::plan_of(input.study), input.study.look(),
                                                    input.study.integrator, input::model_at_point(input));
  print("{}\n", input.resolved.dump(2));
  tell(
      "{}: valid\n"
      "cost: {} points in {} chains, {} mesh periods, {} state variables, about {:.2g} right-hand sides{}\n",
      arguments.input.string(), cost.points, cost.chains, cost.mesh_periods, cost.dimension, cost.rhs_evaluations(),
      input.study.look().classification_periods > 0 ? " and what it takes to tell the regimes" : "");
  return done;
}

}  // namespace epicyclic::app
