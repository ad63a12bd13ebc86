#include "io/study_model.hpp"

#include "core/errors.hpp"
#include "gear/gear_set.hpp"
#include "integrate/methods.hpp"
#include "io/csv.hpp"
#include "io/digest.hpp"
#include "io/journal.hpp"
#include "io/stage_completion.hpp"
#include "studies/operating_point.hpp"

namespace epicyclic::io {

namespace {

/// The operating point at a value of the sweep parameter.
studies::OperatingPoint point_at(const LoadedInput& input, double value) {
  const std::string& parameter = input.study.sweep->parameter;
  const bool pointer = !parameter.empty() && parameter.front() == '/';
  const Study study = pointer ? input.with_value(parameter, value) : input.study;
  studies::OperatingPoint point{study.stage, study.mesh_frequency_ratio, study.model};
  if (!pointer && !studies::set_parameter(point, parameter, value))
    throw InputError("/study/parameter: no sweep parameter '" + parameter + "'");
  return point;
}

}  // namespace

studies::ModelAt model_at(const LoadedInput& input) {
  return [&input, scales = model::scales_of(input.study.stage)](double value) {
    const studies::OperatingPoint point = point_at(input, value);
    return model::make_dynamic_model(point.stage, scales, point.mesh_frequency_ratio, point.model);
  };
}

std::function<model::DynamicModel(double value, double clearance_smoothing)> smoothed_model_at(
    const LoadedInput& input) {
  return [&input, scales = model::scales_of(input.study.stage)](double value, double clearance_smoothing) {
    studies::OperatingPoint point = point_at(input, value);
    point.model.clearance_smoothing = clearance_smoothing;
    return model::make_dynamic_model(point.stage, scales, point.mesh_frequency_ratio, point.model);
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
  if (input.study.sweep && input.study.sweep->classification_periods > 0 &&
      (input.study.kind == "sweep" || input.study.kind == "run") &&
      input.study.model.gap_damping == model::GapDamping::contact_slope && input.study.model.clearance_smoothing == 0.0)
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

std::string identity(const LoadedInput& input, std::string_view command) {
  // Computed values follow from the rest, and their last digits from the machine's mathematical library.
  nlohmann::json given = input.resolved;
  drop_computed(given);
  const nlohmann::json what = {{"command", command},
                               {"input", given},
                               {"journal_format", journal_format_version},
                               {"numerics", studies::numerics_version}};
  return sha256_hex(canonical_json(what));
}

std::string figure_title(const Study& study) {
  const gear::Boundary b = study.stage.boundary;
  const char* boundary = b == gear::Boundary::literal ? "literal" : b == gear::Boundary::star ? "star" : "fixed ring";
  std::string title = (study.name.empty() ? study.stage.name : study.name) + ", boundary " + boundary;
  if (study.kind == "run" || (study.sweep && study.sweep->parameter != "mesh_frequency_ratio")) {
    title += ", Ω = ";
    append_number(title, study.mesh_frequency_ratio);
  }
  return title;
}

Cost estimate_cost(const LoadedInput& input) {
  const studies::SweepOptions& sweep = *input.study.sweep;
  const studies::SweepPlan plan = studies::plan_sweep(sweep);
  Cost cost;
  cost.points = plan.points.size();
  cost.chains = plan.chains.size();
  cost.mesh_periods =
      static_cast<std::int64_t>(plan.points.size()) * (sweep.transient_periods + sweep.recorded_periods);
  const studies::ModelAt at = model_at(input);
  constexpr int probed_periods = 4;
  studies::SweepOptions probe = studies::by_recurrence_alone(sweep);
  probe.transient_periods = 0;
  probe.recorded_periods = probed_periods;
  double calls = 0.0;
  const double values[] = {sweep.from, 0.5 * (sweep.from + sweep.to), sweep.to};
  for (const double value : values) {
    const model::DynamicModel model = at(value);
    cost.dimension = model.dimension;
    const studies::PointResult result = studies::compute_point({0, studies::Direction::up, value}, model, {}, probe,
                                                               input.study.integrator, [] { return true; });
    calls += static_cast<double>(result.rhs_evaluations);
  }
  cost.rhs_per_period = calls / (probed_periods * std::size(values));
  return cost;
}

}  // namespace epicyclic::io
