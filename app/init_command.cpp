// epicyclic init: a stage and studies of one's own to begin with.

#include <array>
#include <filesystem>
#include <string>
#include <system_error>
#include <utility>

#include <nlohmann/json.hpp>

#include "commands.hpp"
#include "core/atomic_file.hpp"
#include "core/errors.hpp"
#include "input/starter.hpp"
#include "input/study_input.hpp"
#include "input/study_model.hpp"
#include "streams.hpp"

namespace epicyclic::app {

namespace {

namespace fs = std::filesystem;

constexpr const char* stage_name = "stage.json";
constexpr const char* sweep_name = "speed.json";
constexpr const char* run_name = "point.json";

input::Drawing drawing_of(const Arguments& arguments) {
  const InitArguments& given = arguments.init;
  input::Drawing d;
  const std::string folder = fs::weakly_canonical(arguments.output).filename().string();
  if (!folder.empty()) d.name = folder;
  if (!given.teeth.empty()) {
    d.sun_teeth = given.teeth[0];
    d.planet_teeth = given.teeth[1];
    if (given.teeth.size() > 2) d.ring_teeth = given.teeth[2];
  }
  for (std::size_t k = 0; k < given.profile_shifts.size(); ++k) d.profile_shift.at(k) = given.profile_shifts[k];
  d.module_mm = given.module_mm;
  d.pressure_angle_deg = given.pressure_angle_deg;
  d.width_mm = given.width_mm;
  d.planets = given.planets;
  d.torque_is_given = given.torque_Nm > 0.0;
  if (d.torque_is_given) d.torque_Nm = given.torque_Nm;
  if (given.speed_rpm > 0.0) d.speed_rpm = given.speed_rpm;
  return d;
}

}  // namespace

int init_command(const Arguments& arguments) {
  const fs::path& folder = arguments.output;
  const input::Drawing drawing = drawing_of(arguments);
  const std::array<std::pair<const char*, nlohmann::ordered_json>, 3> files = {
      {{stage_name, input::starter_stage(drawing)},
       {sweep_name, input::starter_sweep(drawing, stage_name)},
       {run_name, input::starter_run(drawing, stage_name)}}};
  std::error_code error;
  for (const auto& [name, unused] : files)
    if (fs::exists(folder / name, error))
      throw InputError((folder / name).string() + ": is there already; init writes over nothing");
  const bool was_there = fs::exists(folder, error);
  fs::create_directories(folder, error);
  if (error) throw OutputError(folder.string() + ": " + error.message());
  const auto take_back = [&] {
    for (const auto& [name, unused] : files) fs::remove(folder / name, error);
    if (!was_there) fs::remove(folder, error);
  };
  try {
    for (const auto& [name, content] : files) write_file_atomically(folder / name, content.dump(2) + "\n");
    for (const char* name : {sweep_name, run_name})
      for (const std::string& warning : input::warnings(input::load_input(folder / name)))
        if (name == sweep_name) tell("{}\n", warning);
  } catch (...) {
    take_back();
    throw;
  }
  const auto path = [&](const char* name) { return (folder / name).string(); };
  print(
      "{}  the set: what no drawing gives has the origin \"estimate\", with its reason and range; put in what you "
      "know\n"
      "{}  its diagram over the speed\n"
      "{}  one speed, with everything\n"
      "\nnext:\n"
      "  epicyclic gear  {} -o {}\n"
      "  epicyclic check {}\n"
      "  epicyclic sweep {} -o {}\n",
      path(stage_name), path(sweep_name), path(run_name), path(stage_name), path("out/gear"), path(sweep_name),
      path(sweep_name), path("out/speed"));
  return done;
}

}  // namespace epicyclic::app
