// The kind of study "ramp": the speed changes at a constant rate, up and down.

#include <fmt/format.h>

#include "core/errors.hpp"
#include "input/plan_tables.hpp"
#include "input/study_kind.hpp"
#include "input/study_model.hpp"
#include "integrate/methods.hpp"
#include "kinds/list.hpp"
#include "model/scales.hpp"
#include "studies/ramp.hpp"

namespace epicyclic::kinds {

using namespace input;
using studies::RampOptions;

namespace {

const Table<Study>& ramp_table() {
  static const auto table = [] {
    Table<Study> t("ramp", "Run-up and run-down: the speed changes at a constant rate. No regimes are claimed.");
    add_kind_key(t, "ramp");
    const auto of = [](auto member) { return in_plan(whole_plan<RampOptions>, member); };
    const Bounds ratio = between(1e-6, 1e3);
    const Bounds rpm = between(1e-6, 1e7);
    t.number("from", of(&RampOptions::from), ratio, "Lowest speed, as mesh frequency ratio [-].");
    t.number("to", of(&RampOptions::to), ratio, "Highest speed, as mesh frequency ratio [-].");
    t.number("from_sun_speed_rpm", of(&RampOptions::from_sun_speed_rpm), rpm, "Lowest speed, of the sun [rpm].");
    t.number("to_sun_speed_rpm", of(&RampOptions::to_sun_speed_rpm), rpm, "Highest speed, of the sun [rpm].");
    t.number("rate_per_tau", of(&RampOptions::rate_per_tau), between(1e-12, 1e3),
             "Change of the mesh frequency ratio per unit of the dimensionless time [-].");
    t.number("rate_rpm_per_s", of(&RampOptions::rate_rpm_per_s), between(1e-6, 1e9),
             "Change of the sun's speed [rpm/s].");
    t.choices("directions", of(&RampOptions::directions), direction_choices(),
              "Directions, one after the other; each starts from the last state of the one before.");
    t.integer("hold_periods", of(&RampOptions::hold_periods), between(0, 1e7),
              "Mesh periods at constant speed before each direction [-].");
    t.integer("window_periods", of(&RampOptions::window_periods), between(2, 1000),
              "Mesh periods of a window of the order analysis [-].");
    t.integer("output_phases", of(&RampOptions::output_phases), between(16, 10000), "Samples per mesh period [-].");
    t.integer("orders", of(&RampOptions::orders), between(1, 64), "Highest order of the mesh frequency [-].");
    t.numbers("torque_time_s", of(&RampOptions::torque_time_s), between(-1e9, 1e9), 1, 100000,
              "Times of a torque on the sun that changes, from the beginning of the first ramp, rising [s].");
    t.numbers("torque_Nm", of(&RampOptions::torque_Nm), between(-1e12, 1e12), 1, 100000,
              "Torque on the sun at each time, in place of that of the load; linear between [N m].");
    t.text("torque_file", of(&RampOptions::torque_file),
           "CSV file with the columns time_s and torque_Nm, in place of both; a path relative to the study.");
    add_initial_state(t);
    t.rule(KeyRule::Kind::exactly_one, {"from", "from_sun_speed_rpm"});
    t.rule(KeyRule::Kind::exactly_one, {"to", "to_sun_speed_rpm"});
    t.rule(KeyRule::Kind::exactly_one, {"rate_per_tau", "rate_rpm_per_s"});
    t.rule(KeyRule::Kind::together, {"torque_time_s", "torque_Nm"});
    return t;
  }();
  return table;
}

void check_ramp(const Study& study, const IsBad& is_bad, ReadContext& context) {
  const auto& o = study.plan.as<RampOptions>();
  const auto refuse = [&](const char* pointer, std::string message) {
    context.add(Finding::Kind::rule, pointer, std::move(message));
  };
  if (2 * o.orders >= o.output_phases && !is_bad("/study/orders"))
    refuse("/study/orders", fmt::format("is {}, must be < half of output_phases = {}", o.orders, o.output_phases));
  if (const integrate::Method* method = integrate::find_method(study.integrator.method);
      method != nullptr && method->family != integrate::Family::erk)
    refuse("/integrator/method", study.integrator.method +
                                     " cannot follow a speed that changes; an explicit method "
                                     "of ARKODE can, such as arkode-dopri5");
  if (o.torque_time_s.empty() || is_bad("/study/torque_time_s") || is_bad("/study/torque_Nm")) return;
  if (o.torque_time_s.size() != o.torque_Nm.size())
    refuse("/study/torque_Nm",
           fmt::format("has {} numbers, torque_time_s has {}", o.torque_Nm.size(), o.torque_time_s.size()));
  for (std::size_t k = 1; k < o.torque_time_s.size(); ++k)
    if (!(o.torque_time_s[k - 1] < o.torque_time_s[k])) {
      refuse("/study/torque_time_s", fmt::format("must rise: number {} is not above the one before", k));
      break;
    }
  if (!study.stage.load.torque_Nm)
    refuse("/study/torque_Nm", "needs a load by torque_Nm: a power decides over the torque at each speed");
}

void check_course(const LoadedInput& input,
                  const std::function<void(const std::string& pointer, std::string message)>& refuse) {
  const Study& study = input.study;
  try {
    const auto course = studies::ramp_course(study.plan.as<RampOptions>(), study.stage, model::scales_of(study.stage));
    if (course.windows < 1)
      refuse("/study/window_periods",
             fmt::format("is {}, more mesh periods than the whole ramp has; a lower rate makes it longer",
                         course.window_periods));
  } catch (const DomainError& error) {
    refuse("/study/from", error.what());
  }
}

}  // namespace

const StudyKind& ramp_kind() {
  static const StudyKind kind = {
      .name = "ramp",
      .table = &ramp_table,
      .defaults = RampOptions{},
      .at_given_speed = false,
      .check = &check_ramp,
      .check_values = &check_course,
      .cost =
          [](const LoadedInput& input) {
            const auto& options = input.study.plan.as<RampOptions>();
            const auto c = studies::ramp_course(options, input.study.stage, model::scales_of(input.study.stage));
            return fmt::format("{} windows of {} mesh periods, one after the other, and {} periods at constant speed",
                               c.windows * static_cast<int>(options.directions.size()), c.window_periods,
                               options.hold_periods * static_cast<int>(options.directions.size()));
          },
  };
  return kind;
}

}  // namespace epicyclic::kinds
