#include "input/plan_checks.hpp"

#include <algorithm>
#include <utility>

#include "input/added_kind.hpp"
#include "input/pointers.hpp"
#include "input/speed_aliases.hpp"
#include "model/dynamic_model.hpp"
#include "studies/named_parameters.hpp"

namespace epicyclic::input {

std::string why_no_parameter(const std::string& pointer) {
  if (pointer_within(pointer, "/integrator") && pointer != "/integrator/clearance_smoothing")
    return "an option of the integrator is not a parameter of the motion and cannot be swept";
  if (pointer_within(pointer, "/study/initial_state"))
    return "a component of the start is no parameter of the motion; `epicyclic basins` varies two of them";
  if (pointer == "/stage/planets/count") return "the number of planets changes the state itself and cannot be swept";
  return {};
}

void check_named_parameter(const studies::Axis& axis, const std::string& place, const IsBad& is_bad,
                           ReadContext& context, bool other_speeds) {
  if (axis.name.rfind('/', 0) == 0) return;
  const studies::NamedParameter* const parameter = studies::find_parameter(axis.name);
  if (parameter == nullptr) {
    std::vector<std::string> names;
    for (const auto& p : studies::named_parameters()) names.push_back(p.name);
    if (other_speeds)
      for (const SpeedAlias& alias : speed_aliases()) names.emplace_back(alias.key);
    context.add(Finding::Kind::range, place + "/parameter",
                "is \"" + axis.name + "\", must be one of: " + listed(names) +
                    ", or a JSON pointer to a number, such as /stage/lumped/planet/bearing_N_per_m" +
                    (nearest(axis.name, names).empty() ? suggested(meant_pointers(axis.name, context.places))
                                                       : suggestion(axis.name, names)));
    return;
  }
  const Bounds bounds = between(parameter->least, parameter->most);
  for (const auto& [key, value] : {std::pair("/from", axis.from), std::pair("/to", axis.to)}) {
    if (!bounds.contains(value) && !is_bad(place + key)) {
      context.add(Finding::Kind::range, place + key,
                  "is " + number_text(value) + ", must be " + bounds.text() + " for " + parameter->name + ", " +
                      parameter->description);
    }
  }
}

namespace {

/// Pointers of the input that a parameter stands for.
std::vector<std::string> values_set_by(const std::string& parameter) {
  const studies::NamedParameter* named = studies::find_parameter(parameter);
  return named == nullptr ? std::vector{parameter} : named->pointers;
}

}  // namespace

void check_different(const std::string& first_name, const std::string& second_name, const std::string& place,
                     ReadContext& context) {
  const auto first = values_set_by(first_name);
  for (const auto& pointer : values_set_by(second_name))
    if (std::find(first.begin(), first.end(), pointer) != first.end()) {
      context.add(Finding::Kind::rule, place,
                  "is \"" + second_name + "\", which the first axis varies already, by \"" + first_name + "\"");
      return;
    }
}

namespace {

/// Rules of a range of values that span its keys.
///
/// @param place   of the object with from, to and points
/// @param is_bad  tells whether the value at a pointer is not the one in the text
/// @param hint    added where from is above to
void check_range(const studies::Axis& axis, const std::string& place, const IsBad& is_bad, const std::string& hint,
                 ReadContext& context) {
  if (is_bad(place + "/from") || is_bad(place + "/to")) return;
  if (axis.from > axis.to) {
    context.add(Finding::Kind::rule, place + "/from",
                "is " + number_text(axis.from) + ", must be <= to = " + number_text(axis.to) + hint);
  }
  if (axis.points == 1 && axis.from != axis.to) {
    context.add(Finding::Kind::rule, place + "/points",
                "is 1, must be >= 2 for the range from " + number_text(axis.from) + " to " + number_text(axis.to));
  }
}

/// Rules of the two parameters of a map.
void check_map(const studies::Plane& plane, const IsBad& is_bad, ReadContext& context) {
  const auto named = [&](const std::string& place) { return !is_bad(place) && !is_bad(place + "/parameter"); };
  for (const auto& [axis, place] : {std::pair(&plane.first, "/study/first"), {&plane.second, "/study/second"}}) {
    check_range(*axis, place, is_bad, "", context);
    if (named(place)) check_named_parameter(*axis, place, is_bad, context);
  }
  if (!named("/study/first") || !named("/study/second")) return;
  check_different(plane.first.name, plane.second.name, "/study/second/parameter", context);
}

/// Names of the state's components.
std::vector<std::string> state_names(const gear::Stage& stage) {
  std::vector<std::string> names =
      model::coordinate_names(model::layout_of(stage, model::CoordinateChoice::relative), stage.planet_count);
  for (std::size_t k = 0, n = names.size(); k < n; ++k) names.push_back(names[k] + "_rate");
  return names;
}

/// What is wrong with a state of this stage, if one is given.
std::string why_no_state(const std::vector<double>& state, const gear::Stage& stage) {
  if (state.empty() || stage.planet_count < gear::planets_min || stage.planet_count > gear::planets_max) return {};
  const std::size_t components = state_names(stage).size();
  if (state.size() == components) return {};
  return "has " + std::to_string(state.size()) + " numbers, must have " + std::to_string(components) +
         ", the state of this stage";
}

/// Rules of the components that basins start from.
void check_basins(const studies::BasinsOptions& basins, const gear::Stage& stage, const IsBad& is_bad,
                  ReadContext& context) {
  if (stage.planet_count < gear::planets_min || stage.planet_count > gear::planets_max) return;
  const studies::Plane& plane = basins.plane;
  const std::vector<std::string> names = state_names(stage);
  const auto known = [&](const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  const auto named = [&](const std::string& place) { return !is_bad(place) && !is_bad(place + "/component"); };
  const std::string those = ", which is no component of the state of this stage: " + listed(names);
  for (const auto& [axis, at] : {std::pair(&plane.first, "/study/first"), {&plane.second, "/study/second"}}) {
    const std::string place = at;
    check_range(*axis, place, is_bad, "", context);
    if (named(place) && !known(axis->name))
      context.add(Finding::Kind::range, place + "/component",
                  "is \"" + axis->name + "\"" + those + suggestion(axis->name, names));
  }
  if (plane.first.name == plane.second.name && named("/study/first") && named("/study/second"))
    context.add(Finding::Kind::rule, "/study/second/component",
                "is \"" + plane.second.name + "\", which the first axis varies already");
  for (const auto& [name, value] : basins.base) {
    const std::string place = "/study/base" + pointer_step(name);
    if (!known(name)) {
      const bool in_words = context.findings.size() < findings_told;
      context.add(Finding::Kind::unknown_key, place,
                  "unknown key '" + name + "'" + (in_words ? those + suggestion(name, names) : std::string()));
    } else if (name == plane.first.name || name == plane.second.name) {
      context.add(Finding::Kind::rule, place, "is given, but an axis varies this component");
    }
  }
}

/// Rules of branches that span their keys.
void check_branches(const studies::BranchesOptions& b, const gear::Stage& stage, const IsBad& is_bad,
                    ReadContext& context) {
  if (is_bad("/study")) return;
  const auto refuse = [&](const std::string& place, const std::string& message) {
    if (!is_bad(place)) context.add(Finding::Kind::rule, place, message);
  };
  const bool has_range = !is_bad("/study/from") && !is_bad("/study/to");
  if (has_range && !(b.from < b.to))
    refuse("/study/from", "is " + number_text(b.from) + ", must be < to = " + number_text(b.to));
  const auto outside = [&](double value) { return has_range && b.from < b.to && !(value >= b.from && value <= b.to); };
  const std::string range = ", must be within from = " + number_text(b.from) + " and to = " + number_text(b.to);
  const auto check_each = [&](const std::string& place, const std::vector<double>& values) {
    for (std::size_t k = 0; k < values.size(); ++k)
      if (outside(values[k])) refuse(place + "/" + std::to_string(k), "is " + number_text(values[k]) + range);
  };
  check_each("/study/starts", b.starts);
  check_each("/study/values", b.values);
  if (b.search) check_each("/study/search/values", b.search->values);
  if (b.largest_period < b.period)
    refuse("/study/largest_period",
           "is " + std::to_string(b.largest_period) + ", must be >= period = " + std::to_string(b.period));
  for (std::size_t k = 0; k < b.seeds.size(); ++k) {
    const studies::BranchSeed& seed = b.seeds[k];
    const std::string place = "/study/seeds/" + std::to_string(k);
    if (outside(seed.value)) refuse(place + "/value", "is " + number_text(seed.value) + range);
    if (seed.reach && !(seed.value - *seed.reach < seed.value && seed.value + *seed.reach > seed.value))
      refuse(place + "/reach", "is " + number_text(*seed.reach) + ", which is nothing beside the value");
    if (std::string why = why_no_state(seed.state, stage); !why.empty()) refuse(place + "/state", why);
  }
  if (!is_bad("/study/parameter"))
    check_named_parameter(studies::Axis{b.parameter, b.from, b.to, 2}, "/study", is_bad, context);
  if (!b.loci || is_bad("/study/loci")) return;
  const studies::LociOptions& loci = *b.loci;
  if (!is_bad("/study/loci/from") && !is_bad("/study/loci/to") && !(loci.from < loci.to))
    refuse("/study/loci/from", "is " + number_text(loci.from) + ", must be < to = " + number_text(loci.to));
  check_each("/study/loci/near", loci.near);
  if (is_bad("/study/parameter") || is_bad("/study/loci/parameter")) return;
  check_named_parameter(studies::Axis{loci.parameter, loci.from, loci.to, 2}, "/study/loci", is_bad, context);
  check_different(b.parameter, loci.parameter, "/study/loci/parameter", context);
}

/// Rules of a study of points that span its keys.
void check_points(const Study& study, const IsBad& is_bad, ReadContext& context) {
  const studies::LookOptions& look = study.look();
  if (look.transient == studies::Transient::adaptive && look.classification_periods == 0) {
    context.add(Finding::Kind::rule, "/study/classification_periods",
                "is 0, must be >= 1 for an adaptive transient, which ends when the regime is told; without it give "
                "\"transient\": \"fixed\"");
  }
  if (std::string why = why_no_state(study.initial_state, study.stage); !why.empty() && !is_bad("/study/initial_state"))
    context.add(Finding::Kind::rule, "/study/initial_state", std::move(why));
  if (const auto* map = std::get_if<studies::MapOptions>(&study.plan)) return check_map(map->plane, is_bad, context);
  if (const auto* basins = std::get_if<studies::BasinsOptions>(&study.plan))
    return check_basins(*basins, study.stage, is_bad, context);
  if (std::holds_alternative<RunPlan>(study.plan)) return;
  const studies::SweepOptions sweep = study.sweep();
  check_range(sweep.axis, "/study", is_bad, "; to go downwards give \"directions\": [\"down\"]", context);
  if (!is_bad("/study/points") && sweep.segments > sweep.axis.points) {
    context.add(Finding::Kind::rule, "/study/segments",
                "is " + std::to_string(sweep.segments) + ", must be <= points = " + std::to_string(sweep.axis.points));
  }
  if (sweep.segments > 1 && sweep.start == studies::Start::cold) {
    context.add(Finding::Kind::rule, "/study/segments",
                "is " + std::to_string(sweep.segments) + ", but points that start cold are chains of their own");
  }
  if (!is_bad("/study/parameter")) check_named_parameter(sweep.axis, "/study", is_bad, context);
}

}  // namespace

void check_plan(const Study& study, const IsBad& is_bad, ReadContext& context) {
  if (study.has_points()) check_points(study, is_bad, context);
  if (const auto* added = std::get_if<AddedPlan>(&study.plan); added != nullptr && !is_bad("/study"))
    added->kind->check(study, is_bad, context);
  if (const auto* branches = std::get_if<studies::BranchesOptions>(&study.plan))
    check_branches(*branches, study.stage, is_bad, context);
}

}  // namespace epicyclic::input
