#include "io/study_model.hpp"

#include <array>
#include <span>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "core/errors.hpp"
#include "gear/gear_set.hpp"
#include "integrate/methods.hpp"
#include "io/csv.hpp"
#include "io/digest.hpp"
#include "io/journal.hpp"
#include "io/stage_completion.hpp"
#include "studies/operating_point.hpp"
#include "studies/plane.hpp"

namespace epicyclic::io {

namespace {

/// The operating point at values of parameters, by names or pointers.
studies::OperatingPoint point_at(const LoadedInput& input, std::span<const PointerValue> values) {
  std::vector<PointerValue> pointers;
  for (const PointerValue& v : values)
    if (v.pointer.rfind('/', 0) == 0) pointers.push_back(v);
  const Study study = pointers.empty() ? input.study : input.with_values(pointers);
  studies::OperatingPoint point{study.stage, study.mesh_frequency_ratio, study.model};
  for (const PointerValue& v : values)
    if (v.pointer.rfind('/', 0) != 0 && !studies::set_parameter(point, v.pointer, v.value))
      throw InputError("/study/parameter: no sweep parameter '" + v.pointer + "'");
  return point;
}

model::DynamicModel model_of(const studies::OperatingPoint& point, const model::Scales& scales) {
  return model::make_dynamic_model(point.stage, scales, point.mesh_frequency_ratio, point.model);
}

}  // namespace

studies::ModelAt model_at(const LoadedInput& input) {
  return [&input, scales = model::scales_of(input.study.stage)](double value) {
    return model_of(point_at(input, std::array{PointerValue{input.study.sweep->parameter, value}}), scales);
  };
}

studies::SweepPlan plan_of(const Study& study) {
  if (study.kind == "map") return studies::plan_map(*study.sweep, study.plane);
  if (study.kind == "basins") return studies::plan_basins(study.plane);
  return studies::plan_sweep(*study.sweep);
}

studies::ModelAtPoint model_at_point(const LoadedInput& input) {
  const Study& study = input.study;
  if (study.kind == "map")
    return [&input, scales = model::scales_of(study.stage)](const studies::GridPoint& p) {
      const studies::PlaneOptions& plane = input.study.plane;
      return model_of(point_at(input, std::array{PointerValue{plane.first.name, p.value},
                                                 PointerValue{plane.second.name, p.second_value}}),
                      scales);
    };
  if (study.kind == "basins")
    return [&input, model = model_at(input)(study.mesh_frequency_ratio)](const studies::GridPoint& p) {
      model::DynamicModel started = model;
      started.default_start = studies::start_in_plane(model, input.study.plane, p);
      return started;
    };
  return [at = model_at(input)](const studies::GridPoint& p) { return at(p.value); };
}

std::function<model::DynamicModel(double value, double clearance_smoothing)> smoothed_model_at(
    const LoadedInput& input) {
  return [&input, scales = model::scales_of(input.study.stage)](double value, double clearance_smoothing) {
    studies::OperatingPoint point = point_at(input, std::array{PointerValue{input.study.sweep->parameter, value}});
    point.model.clearance_smoothing = clearance_smoothing;
    return model_of(point, scales);
  };
}

std::vector<std::string> warnings(const LoadedInput& input) {
  std::vector<std::string> lines;
  for (const std::string& line : gear::warnings_for_motion(input.study.stage))
    lines.push_back("warning: /stage" + line);
  if (const auto* method = integrate::find_method(input.study.integrator.method);
      method != nullptr && method->misses_kinks && input.study.model.clearance_smoothing == 0.0 &&
      !input.study.integrator.locate_contacts)
    lines.push_back("warning: /integrator/method: the error estimate of \"" + std::string(method->name) +
                    "\" misses the kinks of the exact clearance; its errors are far above its tolerance");
  if (input.study.sweep && input.study.sweep->classification_periods > 0 && input.study.kind != "crosscheck" &&
      input.study.kind != "tolerance" && input.study.model.gap_damping == model::GapDamping::contact_slope &&
      input.study.model.clearance_smoothing == 0.0)
    lines.emplace_back(
        "warning: /model/gap_damping: with the exact clearance its damping jumps, and tangent vectors with it; regimes "
        "are told from recurrence alone, unless /integrator/clearance_smoothing > 0");
  for (const std::string& line : input.notes) lines.push_back("warning: " + line);
  return lines;
}

std::vector<std::string> catalogue_warnings(const LoadedInput& input) {
  std::vector<std::string> lines;
  const gear::Stage& stage = input.study.stage;
  if (!stage.catalogue) return lines;
  for (const std::string& line : gear::catalogue_warnings(gear::make_gear_set(stage))) lines.push_back(line);
  if (stage.catalogue->carrier.shaft && stage.boundary == gear::Boundary::fixed_ring)
    lines.emplace_back("/catalogue/carrier/shaft: not used; with boundary fixed_ring the carrier turns freely");
  const auto problems = gear::problems_for_motion(stage);
  for (const std::string& line : problems) lines.push_back("no motion in time, no operating point: " + line);
  if (problems.empty())
    for (const std::string& line : gear::warnings_for_motion(stage)) lines.push_back(line);
  lines.insert(lines.end(), input.notes.begin(), input.notes.end());
  return lines;
}

namespace {

/// What decides results: values without origins and notes. One that is what the catalogue data give, to the last digit,
/// is written as such: it follows from the rest, and its last digits from the machine's mathematical library. So two
/// inputs have the same identifying values exactly where they have the same values, on each machine.
nlohmann::json identifying_values(nlohmann::json value, const nlohmann::json& computed) {
  if (!value.is_object()) return !computed.is_null() && value == computed ? nlohmann::json(computed_word) : value;
  value.erase("origin");
  value.erase("note");
  static const nlohmann::json nothing;
  for (auto& [key, child] : value.items()) {
    const bool known = computed.is_object() && computed.contains(key);
    child = identifying_values(std::move(child), known ? computed.at(key) : nothing);
  }
  return value;
}

}  // namespace

std::string identity(const LoadedInput& input, std::string_view command) {
  const nlohmann::json what = {{"command", command},
                               {"input", identifying_values(input.resolved, input.computed)},
                               {"journal_format", journal_format_version},
                               {"numerics", studies::numerics_version}};
  return sha256_hex(canonical_json(what));
}

std::vector<std::string> differences(const nlohmann::json& other, const LoadedInput& input) {
  // The other one as this machine computes it.
  nlohmann::json whole = other;
  const bool bare = !whole.contains("stage");
  ReadContext unused;
  nlohmann::json computed = complete_stage(bare ? whole : whole["stage"], "", unused).computed;
  if (!bare) computed = {{"stage", computed}};
  const nlohmann::json there = identifying_values(whole, computed);
  const nlohmann::json here = identifying_values(input.resolved, input.computed);
  const auto text = [](const nlohmann::json& values, const nlohmann::json::json_pointer& at) {
    constexpr std::size_t longest = 60;
    if (!values.contains(at)) return std::string("nothing");
    std::string value = values.at(at).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
    return value.size() <= longest ? value : std::string("another value");
  };
  std::vector<std::string> lines;
  for (const nlohmann::json& change : nlohmann::json::diff(there, here)) {
    const std::string pointer = change.at("path");
    const nlohmann::json::json_pointer at(pointer);
    lines.push_back(fmt::format("{}: {} there, {} here", pointer, text(whole, at), text(input.resolved, at)));
  }
  return lines;
}

std::string figure_title(const Study& study) {
  const gear::Boundary b = study.stage.boundary;
  const char* boundary = b == gear::Boundary::literal ? "literal" : b == gear::Boundary::star ? "star" : "fixed ring";
  std::string title = (study.name.empty() ? study.stage.name : study.name) + ", boundary " + boundary;
  const bool speed_is_given = study.kind == "run" || study.kind == "basins";
  const bool speed_is_varied =
      study.sweep && (study.sweep->parameter == "mesh_frequency_ratio" ||
                      (study.kind == "map" && study.plane.second.name == "mesh_frequency_ratio"));
  if (speed_is_given || (study.sweep && !speed_is_varied)) {
    title += ", Ω = ";
    append_number(title, study.mesh_frequency_ratio);
  }
  return title;
}

Cost estimate_cost(const LoadedInput& input) {
  const studies::SweepOptions& sweep = *input.study.sweep;
  const studies::SweepPlan plan = plan_of(input.study);
  Cost cost;
  cost.points = plan.points.size();
  cost.chains = plan.chains.size();
  cost.mesh_periods =
      static_cast<std::int64_t>(plan.points.size()) * (sweep.transient_periods + sweep.recorded_periods);
  const studies::ModelAtPoint at = model_at_point(input);
  constexpr int probed_periods = 4;
  studies::SweepOptions probe = studies::by_recurrence_alone(sweep);
  probe.transient_periods = 0;
  probe.recorded_periods = probed_periods;
  double calls = 0.0;
  const studies::GridPoint probed[] = {plan.points.front(), plan.points[plan.points.size() / 2], plan.points.back()};
  for (const studies::GridPoint& point : probed) {
    const model::DynamicModel model = at(point);
    cost.dimension = model.dimension;
    const studies::PointResult result =
        studies::compute_point(point, model, {}, probe, input.study.integrator, [] { return true; });
    calls += static_cast<double>(result.rhs_evaluations);
  }
  cost.rhs_per_period = calls / (probed_periods * std::size(probed));
  return cost;
}

}  // namespace epicyclic::io
