#include "input/read_study.hpp"

#include <algorithm>
#include <set>

#include "input/pointers.hpp"
#include "input/stage_completion.hpp"
#include "input/study_kind.hpp"

namespace epicyclic::input {

using nlohmann::json;

namespace {

/// Can a rule of gear be judged at a pointer, if some values were not read and have their defaults?
class Judge {
 public:
  /// @param unread  pointers, relative to the stage
  explicit Judge(std::vector<std::string> unread) : unread_(std::move(unread)) {}

  [[nodiscard]] bool can_judge(std::string_view pointer) const {
    const std::string_view member = member_of(pointer);
    return std::none_of(unread_.begin(), unread_.end(), [&](const std::string& u) {
      const std::string_view other = member_of(u);
      // On these, and on whole objects, many rules rest; the pressure angle follows from the members that mesh.
      const bool far = other == "/boundary" || other == "/planets" || other.empty() || other == "/lumped";
      const bool angle = pointer.ends_with("/operating_pressure_angle_deg") && pointer_within(other, "/lumped");
      // Both bearings of a pair are rigid or none is.
      const bool bearing = pointer.ends_with("/planet/bearing_N_per_m") && other == "/lumped/sun";
      return far || angle || bearing || other == member;
    });
  }

 private:
  /// "/lumped/sun", "/load", ...
  static std::string_view member_of(std::string_view pointer) {
    constexpr std::string_view lumped = "/lumped/";
    return pointer.substr(0, pointer.find('/', pointer.starts_with(lumped) ? lumped.size() : 1));
  }
  std::vector<std::string> unread_;
};

/// The rules of gear. They need values, and report only new errors.
/// @param root          pointer of the stage
/// @param not_computed  is the value at a place of the stage missing because it could not be computed?
/// @returns false if values of the stage were not read
template <class F>
bool judge_stage(const Study& study, const std::string& root, F not_computed, ReadContext& context) {
  std::set<std::string, std::less<>> known;
  std::vector<std::string> unread;
  for (const auto& finding : context.findings) {
    known.insert(finding.pointer);
    if (!finding.meant.empty()) known.insert(finding.meant);
    const bool leaves_value = finding.kind == Finding::Kind::unknown_key || finding.kind == Finding::Kind::range;
    const bool of_catalogue = pointer_within(finding.pointer, root + "/catalogue");
    if (pointer_within(finding.pointer, root) && !leaves_value && !of_catalogue)
      unread.push_back(finding.pointer.substr(root.size()));
  }
  const bool sound = unread.empty();
  if (study.stage.planet_count < 1 || study.stage.planet_count > gear::planets_max) return sound;
  auto rules = gear::problems_for_modes(study.stage);
  if (study.integrates()) {
    const auto more = gear::problems_for_dynamics(study.stage);
    rules.insert(rules.end(), more.begin(), more.end());
    if (rules.empty() && study.stage.mesh_periods() > 1 && !study.plan.kind()->with_shaft_errors)
      rules.push_back(
          "/lumped: eccentricities and pitch errors repeat after " + std::to_string(study.stage.mesh_periods()) +
          " mesh periods; sections once per mesh period do not see whether such a response repeats; only the "
          "kind \"run\" computes them");
  }
  const Judge judge(std::move(unread));
  std::set<std::string> reported;
  for (const auto& rule : rules) {
    if (!reported.insert(rule).second) continue;
    const auto colon = rule.find(": ");
    const std::string place = colon == std::string::npos ? "" : rule.substr(0, colon);
    const std::string pointer = root + place;
    // A value that was not computed can break no rule.
    if (!judge.can_judge(place) || not_computed(pointer)) continue;
    if (known.count(pointer) == 0)
      context.add(Finding::Kind::rule, pointer, colon == std::string::npos ? rule : rule.substr(colon + 2));
  }
  return sound;
}

}  // namespace

bool feeds_completion(std::string_view pointer, bool bare, const gear::Stage& stage) {
  const std::string root = bare ? "" : std::string(stage_root);
  const bool loaded = stage.catalogue && stage.catalogue->is_modified() && !stage.catalogue->stiffness.design_torque_Nm;
  return pointer_within(pointer, root + "/catalogue") || pointer_within(pointer, root + "/planets") ||
         (loaded && pointer_within(pointer, root + "/load"));
}

std::pair<Study, bool> read_study(json& whole, bool bare, ReadContext& context, json* computed) {
  Study study;
  const std::string root = bare ? "" : std::string(stage_root);
  Completion completion;
  if (computed == nullptr)
    completion.complete = true;
  else if (bare)
    completion = complete_stage(whole, root, context);
  else if (const auto stage = whole.find("stage"); stage != whole.end())
    completion = complete_stage(*stage, root, context);
  const bool complete = completion.complete;
  if (computed != nullptr)
    *computed = bare || completion.computed.is_null() ? std::move(completion.computed)
                                                      : json{{"stage", std::move(completion.computed)}};
  if (bare) {
    stage_table().collect("", context.places);
    stage_table().read(whole, "", study.stage, context);
  } else {
    context.places = all_places();
    study_table().read(whole, "", study, context);
  }

  if (study.stage.is_pair() && find_at(whole, root + "/planets/count") == nullptr) study.stage.planet_count = 1;
  // A value that could not be computed is not missing.
  if (!complete)
    std::erase_if(context.findings, [&](const Finding& finding) {
      return finding.kind == Finding::Kind::missing_key && pointer_within(finding.pointer, root + "/lumped");
    });
  const auto not_computed = [&](const std::string& pointer) { return !complete && find_at(whole, pointer) == nullptr; };
  const bool sound = judge_stage(study, root, not_computed, context);
  return {std::move(study), complete && sound};
}

std::optional<Study> change_study(const Study& sound, bool bare, std::span<const PointerValue> values,
                                  ReadContext& context) {
  Study study = sound;
  for (const auto& [pointer, value] : values)
    if (!(bare ? stage_table().change(pointer, value, pointer, study.stage, context)
               : study_table().change(pointer, value, pointer, study, context)))
      return std::nullopt;
  (void)judge_stage(
      study, bare ? "" : std::string(stage_root), [](const std::string&) { return false; }, context);
  return study;
}

}  // namespace epicyclic::input
