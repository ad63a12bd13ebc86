// epicyclic gear: results of the stage alone: geometry, stiffness, load sharing of tooth pairs, friction, bearings,
// modes.

#include <nlohmann/json.hpp>

#include "commands.hpp"
#include "input/study_model.hpp"
#include "reports/gear_output.hpp"
#include "session.hpp"
#include "streams.hpp"

namespace epicyclic::app {

int gear_command(const Arguments& arguments) {
  const input::LoadedInput input = input::load_input(arguments.input, input::parse_assignments(arguments.sets));
  reports::require_finite_numbers(input);
  Session session(arguments, input, identity_of(input, "gear"), 1);
  if (const auto code = session.exit_code()) return *code;
  const store::OutputFolder& folder = session.folder();
  const reports::GearOutput written = reports::write_gear_output(folder.path(), input);
  session.end(store::RunState::complete, {{"undrawn", static_cast<std::int64_t>(written.undrawn.size())}});
  for (const std::string& line : written.undrawn) print_message("figure not drawn: {}\n", line);
  // Another command that calls this one reports missing figures, too; it has printed the warnings of the stage.
  if (arguments.quiet) return written.undrawn.empty() ? done : done_with_failures;
  for (const std::string& line : written.warnings) print_message("warning: {}\n", line);
  for (const std::string& line : written.verdicts) print_message("{}\n", line);
  print_message("summary: {}\n", folder.file("gear.md").string());
  if (arguments.json)
    print("{}\n", nlohmann::json{{"folder", folder.path().string()},
                                 {"modes", folder.file("modes.csv").string()},
                                 {"summary", folder.file("gear.md").string()}}
                      .dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
  else
    print("{}", written.mode_summary);
  return written.undrawn.empty() ? done : done_with_failures;
}

}  // namespace epicyclic::app
