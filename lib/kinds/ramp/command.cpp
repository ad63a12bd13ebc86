// epicyclic ramp: run-up and run-down at a given rate.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <system_error>
#include <vector>

#include <nlohmann/json.hpp>

#include "commands.hpp"
#include "core/atomic_file.hpp"
#include "finished_study.hpp"
#include "folder.hpp"
#include "gear/kinematics.hpp"
#include "input/study_model.hpp"
#include "kind_commands.hpp"
#include "kinds/ramp/output.hpp"
#include "model/scales.hpp"
#include "progress.hpp"
#include "reports/sweep_output.hpp"
#include "session.hpp"
#include "stop.hpp"
#include "store/journal.hpp"
#include "store/point_record.hpp"
#include "streams.hpp"
#include "studies/ramp.hpp"

namespace epicyclic::app {

namespace {

/// Windows one after the other. They are used until the ramp is complete.
std::optional<studies::RampResult> compute(Session& session, const input::Study& study, const model::Scales& scales) {
  const auto& options = study.plan.as<studies::RampOptions>();
  const studies::RampCourse course = studies::ramp_course(options, study.stage, scales);
  const auto file = session.folder().file("journal.bin");
  store::Journal journal(file, session.identity());
  report_cut_tail(file, journal.cut_bytes());
  std::size_t next = 0;
  Progress progress("windows", options.directions.size() * static_cast<std::size_t>(course.windows));
  studies::RampControl control;
  control.go_on = [&stop = stop_requested()] { return !stop.load(); };
  control.at = [&](std::size_t done) { progress.update(done, 0); };
  control.recall = [&](std::size_t numbers) -> std::optional<std::vector<double>> {
    if (next == journal.entries().size()) return std::nullopt;
    return store::decode_numbers(journal.read(journal.entries()[next++]), numbers);
  };
  control.keep = [&, number = journal.entries().size()](std::span<const double> numbers) mutable {
    journal.append(number++, store::encode_numbers(numbers));
  };
  auto result =
      studies::run_ramp(study.stage, scales, study.model, options, study.initial_state, study.integrator, control);
  journal.close();
  progress.finish();
  return result;
}

int run_ramp(const Arguments& arguments) {
  const input::LoadedInput input = input::load_input(arguments.input, input::parse_assignments(arguments.sets));
  require_kind(input, arguments, "ramp");
  const input::Study& study = input.study;
  print_warnings(input);
  Session session(arguments, input, identity_of(input, "ramp"), arguments.threads);
  if (const auto code = session.exit_code()) return *code;
  const store::OutputFolder& folder = session.folder();
  const model::Scales scales = model::scales_of(study.stage);
  const auto result = compute(session, study, scales);
  if (!result) {
    session.end(store::RunState::stopped, {});
    print_message("stopped; re-run the same command to resume\n");
    return stopped_early;
  }
  folder.require_there();
  kinds::RampOutput output;
  output.options = study.plan.as<studies::RampOptions>();
  output.resolved_input = session.resolved();
  output.title = reports::figure_title(study);
  output.omega_sn = scales.omega_sn;
  output.speeds = gear::speeds(study.stage, scales.omega_sn);
  const gear::Torques torques = gear::torques(study.stage, scales.omega_sn);
  output.carrier_torque = torques.carrier / torques.sun;
  output.has_ring = !study.stage.is_pair();
  output.lubricated = study.stage.sun_planet_mesh.friction.ehl || study.stage.ring_planet_mesh.friction.ehl;
  const bool reached = result->outcome == integrate::Outcome::reached;
  const std::string summary = kinds::ramp_summary(output, *result);
  kinds::write_ramp_tables(folder.path(), output, *result);
  write_file_atomically(folder.file("ramp.md"), summary);
  const auto figures = kinds::draw_ramp_figures(folder.file("figures"), output, *result);
  const std::int64_t undrawn = report_undrawn(figures);
  session.end(store::RunState::complete, {{"windows", static_cast<std::int64_t>(result->windows.size())},
                                          {"failed", reached ? 0 : 1},
                                          {"undrawn", undrawn}});
  std::error_code error;
  std::filesystem::remove(folder.file("journal.bin"), error);  // the tables hold all that follows from it
  nlohmann::json printed = {{"folder", folder.path().string()},
                            {"windows", result->windows.size()},
                            {"complete", reached},
                            {"figures", nlohmann::json::array()}};
  for (const reports::DrawnFigure& figure : figures)
    if (figure.outcome.drawn()) printed["figures"].push_back(figure.file.string());
  if (arguments.json) {
    print("{}\n", printed.dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
  } else {
    print("{}\n", summary);
    for (const auto& figure : printed["figures"]) print("figure: {}\n", figure.get<std::string>());
  }
  return reached && undrawn == 0 ? done : done_with_failures;
}

}  // namespace

const Command& ramp_command() {
  static const Command command = {
      .name = "ramp",
      .meaning = "run the speed up and down at a given rate: amplitudes of mesh orders, Campbell maps",
      .run = &run_ramp,
      .takes = Takes::output,
  };
  return command;
}

}  // namespace epicyclic::app
