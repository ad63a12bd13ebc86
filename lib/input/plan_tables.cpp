#include "input/plan_tables.hpp"

#include "integrate/methods.hpp"

namespace epicyclic::input {

using nlohmann::json;
using nlohmann::ordered_json;
using studies::RecordingOptions;
using studies::SweepOptions;

void add_kind_key(Table<Study>& t, std::string_view name) {
  Field<Study> kind;
  kind.key = "kind";
  kind.description = "What is computed.";
  kind.read = [](const json&, const std::string&, Study&, ReadContext&) {};  // decided which table reads
  kind.write = [name](const Study&) { return json(name); };
  kind.schema = [name] { return ordered_json{{"const", name}}; };
  t.custom(std::move(kind)).required();
}

const std::vector<std::pair<std::string, studies::Direction>>& direction_choices() {
  static const std::vector<std::pair<std::string, studies::Direction>> all = {{"up", studies::Direction::up},
                                                                              {"down", studies::Direction::down}};
  return all;
}

const std::vector<std::pair<std::string, studies::Start>>& start_choices() {
  static const std::vector<std::pair<std::string, studies::Start>> all = {{"continued", studies::Start::continued},
                                                                          {"cold", studies::Start::cold}};
  return all;
}

void add_grid(Table<Study>& t) {
  using studies::Axis;
  constexpr auto sweep = [](auto& plan) -> auto& { return plan.sweep(); };
  const auto of = [=](auto member) { return in_plan(sweep, &SweepOptions::axis, member); };
  t.text("parameter", of(&Axis::name), parameter_words);
  t.number("from", of(&Axis::from), any_value, "First value of the parameter, in its unit.");
  t.number("to", of(&Axis::to), any_value, "Last value of the parameter, in its unit.");
  t.integer("points", of(&Axis::points), between(1, 100000), "Number of points, evenly spaced, ends included [-].");
  add_course(t, sweep, &SweepOptions::directions, &SweepOptions::start);
  t.integer_or_auto(
      "segments", in_plan(sweep, &SweepOptions::segments), between(1, 100000),
      "Chains per direction of a sweep with `start` = `continued` [-], or \"auto\": by the number of points.");
  t.integer("coarse_periods", in_plan(sweep, &SweepOptions::coarse_periods), between(1, 1e6),
            "Mesh periods of each point in the first pass along the range, which gives the initial states of the "
            "segments [-].");
}

namespace {

constexpr auto recording = [](auto& plan) -> auto& { return plan.recording(); };

}  // namespace

void add_recording(Table<Study>& t) {
  const auto of = [](auto member) { return in_plan(recording, member); };
  t.integer("transient_periods", of(&RecordingOptions::transient_periods), between(0, 1e7),
            "Mesh periods before the record, if the transient is fixed [-].");
  t.integer("recorded_periods", of(&RecordingOptions::recorded_periods), between(1, 1e5), "Mesh periods recorded [-].");
  t.integer("output_phases", of(&RecordingOptions::output_phases), between(1, 10000),
            "Samples per recorded mesh period for means and harmonics [-]; extrema have at least four times as many.");
  t.integer("period_max", of(&RecordingOptions::period_max), between(1, 10000),
            "Longest period that is sought, in mesh periods [-].");
  t.number("recurrence_tolerance", of(&RecordingOptions::recurrence_tolerance), between(tolerance_min, 1),
           "Two states recur if no component differs by more, in the units of the state.");
}

void add_classification(Table<Study>& t) {
  const auto of = [](auto member) { return in_plan(recording, member); };
  t.choice("transient", of(&RecordingOptions::transient),
           std::vector<std::pair<std::string, studies::Transient>>{{"fixed", studies::Transient::fixed},
                                                                   {"adaptive", studies::Transient::adaptive}},
           "Length of the transient: transient_periods, or until the regime is classified.");
  t.integer("classification_periods", of(&RecordingOptions::classification_periods), between(0, 1e7),
            "Mesh periods after the record in which the regime may be classified [-]; 0: by recurrence alone.");
}

void add_initial_state(Table<Study>& t) {
  t.numbers("initial_state", &Study::initial_state, component_value, 1, 1000,
            "Initial state at the mesh phase 0 in place of the default one, in the order of poincare.csv [b_c, b_c per "
            "tau]; `--from` writes it.");
}

std::vector<std::pair<std::string, std::string>> method_choices() {
  std::vector<std::pair<std::string, std::string>> same;
  for (const auto& name : integrate::method_names()) same.emplace_back(name, name);
  return same;
}

void add_axis_range(Table<studies::Axis>& t) {
  using studies::Axis;
  t.number("from", &Axis::from, any_value, "First value, in its unit.").required();
  t.number("to", &Axis::to, any_value, "Last value, in its unit.").required();
  t.integer("points", &Axis::points, between(1, 10000), "Number of values, evenly spaced, ends included [-].");
}

}  // namespace epicyclic::input
