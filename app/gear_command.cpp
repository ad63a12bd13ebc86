// epicyclic gear: what follows from the stage alone.

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "commands.hpp"
#include "folder.hpp"
#include "io/gear_output.hpp"
#include "io/study_model.hpp"

namespace epicyclic::app {

int gear_command(const Arguments& arguments) {
  const io::LoadedInput input = io::load_input(arguments.input, io::parse_assignments(arguments.sets));
  const io::OutputFolder folder(arguments.output, io::identity(input, "gear"));
  if (const auto code = refuse_or_finish(folder)) return *code;
  io::Provenance facts = provenance(1);
  write_inputs(folder, input);
  const auto modes = folder.file("modes.csv");
  const std::string table = io::write_modes_csv(modes, input.study.stage);
  facts.ended = io::utc_now();
  folder.write_run(io::RunState::complete, io::run_facts(facts));
  fmt::print(stderr, "modes: {}\n", modes.string());
  if (arguments.json)
    fmt::print("{}\n", nlohmann::json{{"folder", folder.path().string()}, {"modes", modes.string()}}.dump(
                           2, ' ', false, nlohmann::json::error_handler_t::replace));
  else
    fmt::print("{}", table);
  return done;
}

}  // namespace epicyclic::app
