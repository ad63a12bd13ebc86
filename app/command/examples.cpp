#include "examples.hpp"

#include <algorithm>
#include <iterator>

namespace epicyclic::app {

namespace {

struct Row {
  std::string_view command;
  Example example;
};

constexpr Row rows[] = {
    {"init", {"a stage and two studies of a drawing", "epicyclic init set --teeth 21,28,77 --module 3 --width 30"}},
    {"init",
     {"with torque [N m] and speed [rpm] of the sun",
      "epicyclic init set --teeth 21,28,77 --module 3 --width 30 --torque 480 --speed 3000"}},
    {"init", {"a lone pair of gears", "epicyclic init pair --pair --teeth 24,37 --module 4 --shifts 0.25,0.1"}},
    {"gear", {"stiffness, friction and modes of a stage", "epicyclic gear tang2020 -o out/gear"}},
    {"gear", {"the same with another load", "epicyclic gear tang2020 -o out/load --set /load/power_kW=200"}},
    {"sweep", {"an installed study, into out/tang2020_speed", "epicyclic sweep tang2020_speed"}},
    {"sweep",
     {"a study of your own with fewer points",
      "epicyclic sweep set/speed.json -o out/speed --set "
      "/study/points=101"}},
    {"sweep",
     {"with other damping",
      "epicyclic sweep tang2020_speed -o out/damped --set /stage/lumped/"
      "sun_planet_mesh/damping_ratio=0.1"}},
    {"map", {"regimes over speed and damping", "epicyclic map tang2020_map"}},
    {"map",
     {"a coarse map first",
      "epicyclic map tang2020_map -o out/coarse --set /study/first/points=11 --set "
      "/study/second/points=9"}},
    {"basins", {"attractors over a plane of initial states", "epicyclic basins tang2020_basins"}},
    {"basins",
     {"with fewer cells in one direction",
      "epicyclic basins tang2020_basins -o out/coarse --set /study/first/points=15"}},
    {"run", {"one operating point", "epicyclic run tang2020_run"}},
    {"run", {"a point of a finished sweep, at 3000 rpm", "epicyclic run --from out/speed:up=3000rpm -o out/point"}},
    {"ramp", {"run-up and run-down of a stage", "epicyclic ramp tang2020_ramp"}},
    {"crosscheck", {"the same points by several methods", "epicyclic crosscheck tang2020_crosscheck"}},
    {"crosscheck", {"one point of a finished sweep", "epicyclic crosscheck --from out/speed:137 -o out/checked"}},
    {"tolerance", {"error bars of results", "epicyclic tolerance tang2020_tolerance"}},
    {"tolerance", {"of one point of a finished sweep", "epicyclic tolerance --from out/speed:137 -o out/bars"}},
    {"continue", {"branches of periodic orbits and their bifurcations", "epicyclic continue tang2020_branches"}},
    {"continue",
     {"explain each change of a finished sweep",
      "epicyclic continue tang2020_branches -o out/proof --against out/tang2020_speed"}},
    {"reproduce", {"the claims of a paper", "epicyclic reproduce tang2020 -o out/claims"}},
    {"calibrate", {"search for parameters that meet claims", "epicyclic calibrate claims.json -o out/calibrated"}},
    {"robustness",
     {"how much of the parameters' ranges meets a claim", "epicyclic robustness claims.json -o out/draws"}},
    {"sweep", {"part 2 of 8", "epicyclic sweep tang2020_speed -o out/speed --part 2/8"}},
    {"merge", {"two parts in folders of their own", "epicyclic merge out/part1 out/part2 -o out/speed"}},
    {"assert",
     {"compare with recorded points, for CI",
      "epicyclic assert out/branches expected.json --junit "
      "verdicts.xml"}},
    {"assert", {"record them", "epicyclic assert out/branches expected.json --record"}},
    {"plot", {"the dynamic factor K_v of two designs", "epicyclic plot out/a out/b -o out/figures --quantity kv_sp"}},
    {"plot",
     {"against the speed of the sun, as PDF",
      "epicyclic plot out/speed -o out/figures --x sun_speed_rpm --quantity force_sp_max --format pdf"}},
    {"report", {"a page of one study", "epicyclic report out/tang2020_speed"}},
    {"report", {"a page of two designs", "epicyclic report out/a out/b -o designs.html"}},
    {"serve", {"a page that computes what you choose", "epicyclic serve out/tang2020_speed"}},
    {"check", {"is this input valid, how long does it take?", "epicyclic check tang2020_speed"}},
    {"check", {"all keys with their values", "epicyclic check tang2020_speed --json --no-time"}},
    {"keys", {"keys that have to do with backlash", "epicyclic keys backlash"}},
    {"keys", {"those of a sweep", "epicyclic keys /study sweep"}},
    {"inputs", {"names for INPUT", "epicyclic inputs"}},
    {"schema", {"for an editor", "epicyclic schema > input.schema.json"}},
    {"doctor", {"is something missing here?", "epicyclic doctor"}},
    {"help", {"options of a command", "epicyclic help sweep"}},
};

}  // namespace

std::vector<Example> examples_of(std::string_view command) {
  std::vector<Example> examples;
  for (const Row& row : rows)
    if (row.command == command) examples.push_back(row.example);
  return examples;
}

std::string examples_text(std::string_view command) {
  std::string text;
  for (const Example& example : examples_of(command)) {
    text += text.empty() ? "Examples:\n" : "\n";
    text.append("  # ").append(example.purpose).append("\n  ").append(example.line);
  }
  return text;
}

}  // namespace epicyclic::app
