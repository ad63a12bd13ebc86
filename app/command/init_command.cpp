// epicyclic init: a stage and studies for a new user to begin with.

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "commands.hpp"
#include "core/atomic_file.hpp"
#include "core/errors.hpp"
#include "core/text.hpp"
#include "input/helix.hpp"
#include "input/json_source.hpp"
#include "input/starter.hpp"
#include "input/study_input.hpp"
#include "input/study_model.hpp"
#include "shell_word.hpp"
#include "stop.hpp"
#include "streams.hpp"

namespace epicyclic::app {

namespace {

namespace fs = std::filesystem;

constexpr const char* stage_name = "stage.json";
constexpr const char* sweep_name = "speed.json";
constexpr const char* run_name = "point.json";

/// As many numbers as the drawing has gears; no planets of a pair.
void check_numbers(const InitArguments& given) {
  const auto refuse = [](const char* why) { throw InputError(std::string("init: ") + why); };
  const std::size_t shifts = given.profile_shifts.size();
  if (!given.pair) {
    if (shifts != 0 && shifts != 3) refuse("--shifts of a stage are three: X_SUN,X_PLANET,X_RING");
    return;
  }
  if (shifts != 0 && shifts != 2) refuse("--shifts of a pair are two: X_1,X_2");
  if (given.teeth.size() > 2) refuse("--teeth of a pair are two: Z_1,Z_2; without --pair they are of a stage");
  if (given.planets || !given.angles_deg.empty())
    refuse("a pair has no planets: leave out --planets and --angles, or --pair");
}

}  // namespace

input::Drawing drawing_of(const Arguments& arguments) {
  const InitArguments& given = arguments.init;
  if (given.helix_angle_deg) throw InputError(std::string("--helix-angle: ") + input::no_helix);
  input::Drawing d;
  d.pair = given.pair;
  check_numbers(given);
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
  if (!given.pair && !given.planets && given.angles_deg.empty()) d.assumed.emplace("count");
  d.angles_deg = given.angles_deg;
  const int of_angles = d.angles_deg.empty() ? d.planets : static_cast<int>(d.angles_deg.size());
  d.planets = given.pair ? 1 : given.planets.value_or(of_angles);
  d.torque_Nm = given.torque_Nm;
  d.speed_rpm = given.speed_rpm;
  return d;
}

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
      throw InputError((folder / name).string() + ": exists; init does not overwrite files");
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
      give_up_if_stopped();  // none of them is kept, since the same command would not overwrite them
      for (const std::string& warning : input::warnings(input::load_input(folder / name)))
        if (name == sweep_name) print_message("{}\n", warning);
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
  const auto path = [&](const char* name) { return shell_word((folder / name).string()); };
  const std::string program = shell_word(arguments.called);
  if (const std::vector<double> angles = input::assembly_angles(drawing); !angles.empty()) {
    std::string at;
    for (const double angle : angles) at += (at.empty() ? "" : ", ") + short_text(angle, 6);
    print(
        "{} + {} teeth of sun and ring are not a multiple of {} planets: the planets are at {} degrees, not equally "
        "spaced\n",
        drawing.sun_teeth, drawing.ring(), drawing.planets, at);
  }
  if (drawing.assumed.contains("module_mm")) print("no --module: {:g} mm\n", drawing.module_mm);
  if (drawing.assumed.contains("count")) print("no --planets: {}\n", drawing.planets);
  if (!drawing.torque_Nm)
    print("no --torque: {:g} N m on {}, 60 N/mm2 times module and face width{}\n", input::torque_Nm(drawing),
          drawing.pair ? "gear 1" : "the sun", drawing.pair ? "" : " on each mesh");
  if (!drawing.speed_rpm)
    print("no --speed: the diagram is over mesh frequency ratios from 0.2 to 2; `check` prints them in rpm\n");
  print(
      "{}  the {}; values that no drawing states have the origin \"estimate\", a reason and a range: enter what "
      "you know\n"
      "{}  study of a diagram over the speed\n"
      "{}  study of one speed, with all results\n"
      "\nnext:\n"
      "  {} gear {} -o {}\n"
      "  {} check {}\n"
      "  {} sweep {} -o {}\n",
      path(stage_name), drawing.pair ? "pair" : "gear set", path(sweep_name), path(run_name), program, path(run_name),
      path("out/gear"), program, path(sweep_name), program, path(sweep_name), path("out/speed"));
  return done;
}

}  // namespace epicyclic::app
