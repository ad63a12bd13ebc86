// epicyclic init: a stage and studies of one's own to begin with.

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "commands.hpp"
#include "core/atomic_file.hpp"
#include "core/errors.hpp"
#include "core/text.hpp"
#include "input/json_source.hpp"
#include "input/starter.hpp"
#include "input/study_input.hpp"
#include "input/study_model.hpp"
#include "stop.hpp"
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
  fs::path folder = fs::weakly_canonical(arguments.output);
  if (folder.filename().empty()) folder = folder.parent_path();  // "set/"
  if (const std::string name = folder.filename().string(); !name.empty()) d.name = name;
  if (!given.teeth.empty()) {
    d.sun_teeth = given.teeth[0];
    d.planet_teeth = given.teeth[1];
    if (given.teeth.size() > 2) d.ring_teeth = given.teeth[2];
  }
  for (std::size_t k = 0; k < given.profile_shifts.size(); ++k) d.profile_shift.at(k) = given.profile_shifts[k];
  const auto take = [&d](double& of, const std::optional<double>& value, const char* key) {
    if (!value) d.assumed.emplace(key);
    of = value.value_or(of);
  };
  take(d.module_mm, given.module_mm, "module_mm");
  take(d.pressure_angle_deg, given.pressure_angle_deg, "pressure_angle_deg");
  take(d.width_mm, given.width_mm, "width_mm");
  if (given.teeth.empty()) d.assumed.emplace("teeth");
  if (given.profile_shifts.empty()) d.assumed.emplace("profile_shift");
  if (!given.planets && given.angles_deg.empty()) d.assumed.emplace("count");
  d.angles_deg = given.angles_deg;
  const int of_angles = d.angles_deg.empty() ? d.planets : static_cast<int>(d.angles_deg.size());
  d.planets = given.planets.value_or(of_angles);
  d.torque_Nm = given.torque_Nm;
  d.speed_rpm = given.speed_rpm;
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
    if (fs::exists(fs::symlink_status(folder / name, error)))
      throw InputError((folder / name).string() + ": is there already; init writes over nothing");
  const bool was_there = fs::exists(folder, error);
  fs::create_directories(folder, error);
  if (error) throw OutputError(folder.string() + ": " + error.message());
  const auto take_back = [&] {
    for (const auto& [name, unused] : files) fs::remove(folder / name, error);
    if (!was_there) fs::remove(folder, error);
  };
  try {
    for (const auto& [name, content] : files)
      write_file_atomically(folder / name,
                            content.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n");
    for (const char* name : {sweep_name, run_name}) {
      give_up_if_stopped();  // none of them is kept, since the same command would not write over them
      for (const std::string& warning : input::warnings(input::load_input(folder / name)))
        if (name == sweep_name) tell("{}\n", warning);
    }
  } catch (const input::InputProblems& found) {
    take_back();
    std::vector<input::Problem> problems = found.problems();
    for (input::Problem& problem : problems) {  // of files that are not kept
      problem.file = "init";
      problem.line = 0;
    }
    throw input::InputProblems(std::move(problems));
  } catch (...) {
    take_back();
    throw;
  }
  // As a shell takes it.
  const auto path = [&](const char* name) {
    const std::string text = (folder / name).string();
    constexpr std::string_view plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./,:+";
    if (text.find_first_not_of(plain) == std::string::npos) return text;
    std::string quoted = "'";
    for (const char c : text) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return quoted + "'";
  };
  if (const std::vector<double> angles = input::assembly_angles(drawing); !angles.empty()) {
    std::string at;
    for (const double angle : angles) at += (at.empty() ? "" : ", ") + short_text(angle, 6);
    print("{} + {} teeth of sun and ring are no multiple of {} planets: these stand at {} degrees, not evenly\n",
          drawing.sun_teeth, drawing.ring(), drawing.planets, at);
  }
  if (!drawing.torque_Nm)
    print("no --torque: {:g} N m on the sun, 60 N/mm2 times module and face width on each mesh\n",
          input::torque_Nm(drawing));
  if (!drawing.speed_rpm)
    print("no --speed: the diagram goes over 0.2 to 2 of the mesh frequency ratio; `epicyclic check` says in rpm\n");
  print(
      "{}  the set: what no drawing gives has the origin \"estimate\", with its reason and range; put in what you "
      "know\n"
      "{}  its diagram over the speed\n"
      "{}  one speed, with everything\n"
      "\nnext:\n"
      "  epicyclic gear {} -o {}\n"
      "  epicyclic check {}\n"
      "  epicyclic sweep {} -o {}\n",
      path(stage_name), path(sweep_name), path(run_name), path(run_name), path("out/gear"), path(sweep_name),
      path(sweep_name), path("out/speed"));
  return done;
}

}  // namespace epicyclic::app
