#include "input/study_model.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "core/csv.hpp"
#include "core/errors.hpp"
#include "core/text.hpp"
#include "gear/ehl_friction.hpp"
#include "gear/gear_set.hpp"
#include "gear/warnings.hpp"
#include "input/derived_study.hpp"
#include "input/pointers.hpp"
#include "input/stage_completion.hpp"
#include "input/study_kind.hpp"
#include "integrate/methods.hpp"
#include "studies/cost_estimate.hpp"
#include "studies/named_parameters.hpp"

namespace epicyclic::input {

using nlohmann::json;

model::DynamicModel model_of(const model::OperatingPoint& point, const model::Scales& scales) {
  model::DynamicModel model = model::make_dynamic_model(point.stage, scales, point.mesh_frequency_ratio, point.options);
  std::vector<double> rate(model.dimension);
  model.right_hand_side(model::segment_at(model.breakpoints, 0.0), 0.0, model.default_start.data(), rate.data());
  const auto finite = [](double x) { return std::isfinite(x); };
  if (!std::ranges::all_of(rate, finite) || !std::ranges::all_of(model.default_start, finite) ||
      !(model.static_mesh_force != 0.0))
    throw InputError("/stage: its numbers are within their bounds, but not together: at Omega = " +
                     number_text(point.mesh_frequency_ratio) + " the equations of motion are not finite");
  return model;
}

namespace {

/// The parameter of a point's value: that of a sweep, else the speed.
std::string parameter_of(const Study& study) {
  const std::vector<VariedParameter> varied = varied_parameters(study);
  return varied.empty() ? studies::speed_parameter : varied.front().axis.name;
}

}  // namespace

model::DynamicModel started(model::DynamicModel model, const Study& study) {
  if (!study.initial_state.empty()) model.default_start = study.initial_state;
  return model;
}

studies::ModelAt model_at(const LoadedInput& input) { return model_at(input, parameter_of(input.study)); }

studies::ModelAt model_at(const LoadedInput& input, const std::string& parameter) {
  (void)given_value(input, parameter);
  return [&input, parameter, scales = model::scales_of(input.study.stage)](double value) {
    return started(model_of(point_at(input, std::array{PointerValue{parameter, value}}), scales), input.study);
  };
}

studies::ModelAt model_at(std::shared_ptr<const LoadedInput> input, const std::string& parameter) {
  studies::ModelAt at = model_at(*input, parameter);
  return [input = std::move(input), at = std::move(at)](double value) { return at(value); };
}

studies::ModelAt model_family(const LoadedInput& input, const std::string& parameter, double step) {
  return [&input, parameter, step, scales = model::scales_of(input.study.stage)](double value) {
    const auto at = [&](double v) { return point_at(input, std::array{PointerValue{parameter, v}}); };
    model::DynamicModel model = model_of(at(value), scales);
    model::set_parameter_derivative(model, at, scales, value, step);
    return model;
  };
}

std::function<model::DynamicModel(double first, double second)> model_plane(const LoadedInput& input,
                                                                            const std::string& first_parameter,
                                                                            const std::string& second_parameter,
                                                                            double step) {
  return [&input, first_parameter, second_parameter, step, scales = model::scales_of(input.study.stage)](
             double first, double second) {
    const auto at = [&](double v) {
      return point_at(input, std::array{PointerValue{first_parameter, v}, PointerValue{second_parameter, second}});
    };
    model::DynamicModel model = model_of(at(first), scales);
    model::set_parameter_derivative(model, at, scales, first, step);
    return model;
  };
}

double given_value(const LoadedInput& input, const std::string& parameter) {
  if (const studies::NamedParameter* named = studies::find_parameter(parameter)) return named->get(point_at(input, {}));
  const InputError none("/study/parameter: no number '" + parameter + "'");
  try {
    const json::json_pointer pointer(parameter);
    if (!input.resolved.contains(pointer) || !input.resolved[pointer].is_number()) throw none;
    return input.resolved[pointer].get<double>();
  } catch (const json::exception&) {  // no pointer at all
    throw none;
  }
}

studies::SweepPlan plan_of(const Study& study) { return study.plan.kind()->plan(study); }

studies::ModelAtPoint model_at_point(const LoadedInput& input) {
  if (const StudyKind& kind = *input.study.plan.kind(); kind.model_at_point != nullptr)
    return kind.model_at_point(input);
  return [at = model_at(input)](const studies::GridPoint& p) { return at(p.value); };
}

std::function<model::DynamicModel(double value, double clearance_smoothing)> smoothed_model_at(
    const LoadedInput& input) {
  return [&input, parameter = parameter_of(input.study), scales = model::scales_of(input.study.stage)](
             double value, double clearance_smoothing) {
    model::OperatingPoint point = point_at(input, std::array{PointerValue{parameter, value}});
    point.options.clearance_smoothing = clearance_smoothing;
    return started(model_of(point, scales), input.study);
  };
}

namespace {

/// Warnings on a stage that passes problems_for_modes(), at mesh frequencies [rad/s] if it may move.
void warn_of_stage(std::vector<gear::Warning>& out, const gear::Stage& stage, double mesh_frequency) {
  const auto append = [&](std::vector<gear::Warning> more) { std::ranges::move(more, std::back_inserter(out)); };
  std::optional<gear::GearSet> set;
  if (stage.catalogue) {
    set = gear::make_gear_set(stage);
    append(gear::catalogue_warnings(*set, stage));
  }
  append(gear::mass_warnings(stage));
  if (!gear::problems_for_dynamics(stage).empty()) return;
  append(gear::warnings_for_dynamics(stage));
  append(gear::warnings_at(stage, mesh_frequency, set ? &*set : nullptr));
}

double last_value(const studies::Axis& axis) {
  return studies::axis_value(axis, static_cast<std::size_t>(axis.points) - 1);
}

/// A warning if the option was not chosen: printed equations may omit centrifugal forces, which load real bearings.
void warn_of_centrifugal_force(std::vector<gear::Warning>& out, const LoadedInput& input, const gear::Stage& stage,
                               double mesh_frequency) {
  const json* origin = input.value_at("/model/origin/centrifugal");
  if (stage.boundary == gear::Boundary::as_printed || origin == nullptr || *origin != "default") return;
  constexpr double negligible = 0.1;
  if (!gear::problems_for_dynamics(stage).empty()) return;
  const double force = gear::planet_centrifugal_force(stage, mesh_frequency);
  const double load = gear::mean_planet_load(stage, mesh_frequency);
  if (!(force > negligible * load)) return;
  gear::Warnings warnings;
  warnings.add_once(gear::Rank::doubtful, force / (negligible * load), "/model/centrifugal", "centrifugal force",
                    "the centrifugal force of a planet, ", force, " N, is left out, ", force / load,
                    " times what the meshes load its bearing with; \"included\" counts it, \"left_out\" says that it "
                    "is meant");
  std::ranges::move(warnings.take(), std::back_inserter(out));
}

/// Pointer of the stage in the resolved input.
std::string place_of_stage(const LoadedInput& input) { return input.resolved.contains("stage") ? "/stage" : ""; }

/// Of the mesh stiffness: whether nobody chose how many harmonics it has, nor that it has any.
bool harmonics_by_default(const LoadedInput& input, const std::string& root) {
  return std::ranges::all_of(std::array{"form", "harmonics"}, [&](const char* key) {
    const json* origin = input.value_at(root + "/catalogue/mesh_stiffness/origin/" + key);
    return origin != nullptr && *origin == "default";
  });
}

/// A warning if the value was not chosen: an amplitude that is an estimate, or follows from an accuracy grade by the
/// default rule.
/// @param root  of the stage in the resolved input
void warn_of_estimated_error(std::vector<gear::Warning>& out, const LoadedInput& input, const std::string& root,
                             const gear::Stage& stage, double mesh_frequency) {
  if (!gear::problems_for_dynamics(stage).empty()) return;
  const auto origin_is = [&](const std::string& pointer, const auto& is) {
    const json* origin = input.value_at(root + pointer);
    return origin != nullptr && origin->is_string() && is(origin->get_ref<const std::string&>());
  };
  const bool by_default =
      origin_is("/catalogue/origin/error_amplitude", [](const std::string& o) { return may_be_replaced(o); });
  const gear::MeshLoad load = gear::mean_mesh_load(stage, mesh_frequency);
  gear::Warnings warnings;
  for (const auto& [key, mesh] :
       {std::pair("sun_planet_mesh", &stage.sun_planet_mesh), std::pair("ring_planet_mesh", &stage.ring_planet_mesh)}) {
    const std::string place = std::string("/lumped/") + key;
    const bool estimated = origin_is(place + "/origin/error_amplitude_um", [&](const std::string& o) {
      return o.starts_with("estimate") || (by_default && is_computed(o));
    });
    const double amplitude = std::ranges::max(mesh->error_amplitude_um);
    const double deflection = gear::static_deflection_um(*mesh, load);
    const bool varied = std::ranges::any_of(varied_parameters(input.study), [&](const VariedParameter& v) {
      return v.axis.name.starts_with(root + place + "/error_amplitude_um");
    });
    if (estimated && !varied && amplitude > deflection)
      warnings.add_once(gear::Rank::doubtful, amplitude / deflection, place + "/error_amplitude_um", "estimated error",
                        "is ", amplitude, " um, an estimate, and ", amplitude / deflection,
                        " times the static deflection of the mesh, ", deflection,
                        " um: the estimate decides the regime. Give the amplitude that was measured, or say by "
                        "/catalogue/error_amplitude which tolerance is meant");
  }
  std::ranges::move(warnings.take(), std::back_inserter(out));
}

/// A warning if the harmonics were not chosen: those of the default omit a part of the stiffness.
void warn_of_truncation(std::vector<gear::Warning>& out, const LoadedInput& input, const std::string& root,
                        const gear::Stage& stage) {
  if (stage.catalogue && harmonics_by_default(input, root))
    std::ranges::move(gear::truncation_warnings(gear::make_gear_set(stage), stage), std::back_inserter(out));
}

/// Warns of angles at which planets cannot be assembled. The ends of a range alone do not show those between.
void warn_of_assembly(std::vector<gear::Warning>& out, const LoadedInput& input) {
  constexpr std::string_view angles = "/stage/planets/angles_deg/";
  for (const auto& [axis, place] : varied_parameters(input.study)) {
    if (!axis.name.starts_with(angles)) continue;
    gear::Stage stage = input.study.stage;
    double& angle = stage.angles_deg.at(std::stoul(axis.name.substr(angles.size())));
    const std::vector<double> values = studies::axis_values(axis);
    const auto misfits = std::ranges::count_if(values, [&](double value) {
      angle = value;
      return !gear::assembly_misfits(stage).empty();
    });
    if (misfits == 0) continue;
    const int teeth = *stage.sun.teeth + *stage.ring.teeth;
    constexpr int digits = 6;
    out.push_back({gear::Rank::impossible, static_cast<double>(misfits), place + "/parameter", "assembly",
                   fmt::format("at {} of {} values of {} the planets cannot be assembled; one fits every {} degrees, "
                               "360 over the {} teeth of sun and ring",
                               misfits, values.size(), axis.name, short_text(360.0 / teeth, digits), teeth)});
  }
}

/// Warnings at the operating points at the ends of varied ranges, and on parameters without effect.
void warn_of_points(std::vector<gear::Warning>& out, const LoadedInput& input) {
  const model::Scales scales = model::scales_of(input.study.stage);
  const std::vector<VariedParameter> varied = varied_parameters(input.study);
  const std::size_t corners = std::size_t{1} << varied.size();
  for (std::size_t corner = 0; corner < corners; ++corner) {
    std::vector<PointerValue> values;
    for (std::size_t k = 0; k < varied.size(); ++k)
      values.push_back(
          {varied[k].axis.name, (corner >> k & 1U) != 0U ? last_value(varied[k].axis) : varied[k].axis.from});
    const model::OperatingPoint point = point_at(input, values);
    warn_of_stage(out, point.stage, point.mesh_frequency_ratio * scales.omega_sn);
    warn_of_centrifugal_force(out, input, point.stage, point.mesh_frequency_ratio * scales.omega_sn);
    warn_of_estimated_error(out, input, "/stage", point.stage, point.mesh_frequency_ratio * scales.omega_sn);
    warn_of_truncation(out, input, "/stage", point.stage);
  }
  warn_of_assembly(out, input);
  for (const auto& [axis, place] : varied) {
    const double to = last_value(axis);
    if (axis.from == to) continue;
    const auto model = [&, &name = axis.name](double value) {
      return model_of(point_at(input, std::array{PointerValue{name, value}}), scales);
    };
    if (studies::same_equations(model(axis.from), model(to)))
      out.push_back(
          {gear::Rank::doubtful, 1.0, place + "/parameter", place + "/parameter",
           fmt::format("{} has no effect on the response: the equations of motion at {} and at {} are the same",
                       axis.name, axis.from, to)});
  }
}

}  // namespace

bool damping_jumps(const json& resolved) {
  const json* damping = find_at(resolved, "/model/gap_damping");
  const json* width = find_at(resolved, "/integrator/clearance_smoothing");
  return damping != nullptr && *damping == "contact_slope" && (width == nullptr || *width == 0.0);
}

gear::Warning without_tangents(std::string pointer) {
  return {gear::Rank::note, 1.0, std::move(pointer), "tangents",
          "with the exact clearance its damping jumps, and tangent vectors with it; regimes are classified by "
          "recurrence alone unless /integrator/clearance_smoothing > 0"};
}

void warn_without_tangents(std::vector<gear::Warning>& out, const LoadedInput& input) {
  if (input.study.recording().classification_periods > 0 && damping_jumps(input.resolved))
    out.push_back(without_tangents("/model/gap_damping"));
}

namespace {

std::vector<std::string> texts(std::vector<gear::Warning> warnings) {
  gear::put_in_order(warnings);
  std::vector<std::string> lines;
  for (const gear::Warning& w : warnings) lines.push_back(w.text());
  return lines;
}

}  // namespace

std::vector<std::string> warnings(const LoadedInput& input) {
  const Study& study = input.study;
  std::vector<std::string> lines;
  if (!study.integrates()) {
    lines = gear_warnings(input);
  } else {
    std::vector<gear::Warning> all;
    warn_of_points(all, input);
    std::erase_if(
        all, [](const gear::Warning& w) { return w.rank == gear::Rank::note && w.pointer.starts_with("/catalogue"); });
    for (gear::Warning& w : all)
      if (!w.pointer.starts_with("/study") && !w.pointer.starts_with("/model")) w.pointer.insert(0, "/stage");
    const StudyKind& kind = *study.plan.kind();
    if (kind.warn != nullptr) kind.warn(all, input);
    const bool own_method = kind.method != nullptr;
    const auto* method =
        integrate::find_method(own_method ? kind.method(study.plan.options()) : study.integrator.method);
    const bool located =
        method != nullptr && (own_method ? method->locates_contacts() : study.integrator.locate_contacts);
    if (method != nullptr && method->misses_kinks && study.model.clearance_smoothing == 0.0 && !located)
      all.push_back({gear::Rank::doubtful, 1.0, own_method ? "/study/method" : "/integrator/method", "kinks",
                     "the error estimate of \"" + std::string(method->name) +
                         "\" misses the kinks of the exact clearance; its errors are far above its tolerance"});
    lines = texts(std::move(all));
    lines.insert(lines.end(), input.notes.begin(), input.notes.end());
  }
  for (std::string& line : lines) line.insert(0, "warning: ");
  return lines;
}

std::vector<std::string> gear_warnings(const LoadedInput& input) {
  const gear::Stage& stage = input.study.stage;
  std::vector<gear::Warning> all;
  const double mesh_frequency = input.study.mesh_frequency_ratio * model::scales_of(stage).omega_sn;
  warn_of_stage(all, stage, mesh_frequency);
  warn_of_estimated_error(all, input, place_of_stage(input), stage, mesh_frequency);
  warn_of_truncation(all, input, place_of_stage(input), stage);
  if (stage.catalogue && stage.catalogue->carrier.shaft && stage.boundary == gear::Boundary::fixed_ring)
    all.push_back({gear::Rank::note, 1.0, "/catalogue/carrier/shaft", "shaft",
                   "not used; with boundary fixed_ring the carrier rotates freely"});
  std::vector<std::string> lines = texts(std::move(all));
  // A lumped stage may be one of modes alone; drawings are given of stages that move.
  if (stage.catalogue)
    for (const std::string& line : gear::problems_for_dynamics(stage))
      lines.push_back("no time integration, no operating point: " + line);
  lines.insert(lines.end(), input.notes.begin(), input.notes.end());
  return lines;
}

std::vector<std::string> stiffness_notes(const LoadedInput& input) {
  const gear::Stage& stage = input.study.stage;
  if (!stage.catalogue || harmonics_by_default(input, place_of_stage(input))) return {};  // a warning
  std::vector<std::string> lines;
  for (const gear::Warning& w : gear::truncation_warnings(gear::make_gear_set(stage), stage))
    lines.push_back(w.message);
  return lines;
}

}  // namespace epicyclic::input
