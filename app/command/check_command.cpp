// epicyclic check: validates an input and states its cost; writes nothing. How long it takes on this machine is
// measured: points spread over its ranges are computed as the study would compute them.

#include <string>
#include <utility>

#include <nlohmann/json.hpp>

#include "commands.hpp"
#include "core/text.hpp"
#include "expected_time.hpp"
#include "input/study_kind.hpp"
#include "input/study_model.hpp"
#include "kind_commands.hpp"
#include "progress.hpp"
#include "reports/gear_report.hpp"
#include "reports/speed_words.hpp"
#include "session.hpp"
#include "streams.hpp"
#include "studies/cost_estimate.hpp"

namespace epicyclic::app {

namespace {

/// How long it takes, in words.
std::string time_of(const input::LoadedInput& input, const studies::SweepPlan& plan, int threads,
                    const TimeLimit& limit) {
  const TimeOfStudy measure = command_of(input.study.kind()).expected;
  if (measure == nullptr) return "not measured for this kind of study";
  const Expected expected = measure(input, plan, threads, limit);
  std::string text;
  if (expected.at_least > 0.0) text = "more than " + duration_text(expected.at_least);
  if (expected.seconds > 0.0) text += (text.empty() ? "about " : ", perhaps ") + duration_text(expected.seconds);
  const int used = expected.one_thread ? 1 : threads;
  return fmt::format("{} on {} of this machine{}, {}", text, used == 1 ? "1 thread" : fmt::format("{} threads", used),
                     expected.besides, expected.measured);
}

/// The speeds of the study's points in usual units, and the stage values that determine their excitation.
void print_operation(const input::LoadedInput& input) {
  double from = input.study.mesh_frequency_ratio;
  double to = from;
  for (const auto& [axis, place] : input::varied_parameters(input.study))
    if (axis.name == studies::speed_parameter) {
      from = axis.from;
      to = axis.to;
    }
  const auto words = [&](double ratio) {
    return fmt::format("mesh frequency ratio {}: {}", short_text(ratio, 6),
                       reports::speed_words(input.study.stage, ratio));
  };
  print_message("speed: {}\n", words(from));
  if (to != from) print_message("    to {}\n", words(to));
  if (const std::string drive = reports::drive_words(input.study.stage); !drive.empty())
    print_message("drive: {}\n", drive);
  // The load may go with the speed.
  const std::string error = reports::error_words(input.study.stage, from);
  print_message("{}\n", error);
  if (const std::string other = reports::error_words(input.study.stage, to); other != error)
    print_message("    at the last speed: {}\n", other);
  for (const std::string& line : input::stiffness_notes(input)) print_message("mesh stiffness: {}\n", line);
}

}  // namespace

int check_command(const Arguments& arguments) {
  const input::LoadedInput input = input::load_input(arguments.input, input::parse_assignments(arguments.sets));
  print_warnings(input);
  if (arguments.json) print("{}\n", input.resolved.dump(2));
  if (!input.study.has_dynamics()) {
    print_message("{}: valid; a stage alone, for `epicyclic gear`\n", arguments.input.string());
    return done;
  }
  if (!input.study.has_points()) {
    const auto cost_of = input.study.plan.kind()->cost;
    const std::string cost = cost_of != nullptr ? cost_of(input) : "not known";
    print_message("{}: valid\ncost: {}\n", arguments.input.string(), cost);
    print_operation(input);
    return done;
  }
  const studies::SweepPlan plan = input::plan_of(input.study);
  print_message("{}: valid\n", arguments.input.string());
  TimeLimit limit;
  const studies::RecordingOptions& recording = input.study.recording();
  const auto cost = limit.in_time([&] {
    return studies::estimate_cost(plan, recording, input.study.integrator, input::model_at_point(input),
                                  [&] { return !limit.over(); });
  });
  print_message(
      "cost: {} points in {} chains, {} mesh periods{}{}\n", plan.points.size(), plan.chains.size(),
      studies::mesh_periods_of(plan, recording),
      cost && !limit.over()
          ? fmt::format(", {} state variables, about {:.2g} right-hand sides", cost->dimension, cost->rhs_evaluations())
          : "; the cost is not known: a few mesh periods exceed the time limit of this estimate",
      recording.classification_periods > 0 ? " and those that classify the regimes" : "");
  print_operation(input);
  if (!arguments.no_time && cost) {
    const auto time = limit.in_time([&] { return time_of(input, plan, arguments.threads, limit); });
    print_message("time: {}\n", time.value_or("not known: no trial ended within the time limit"));
  }
  limit.leave();
  return done;
}

}  // namespace epicyclic::app
