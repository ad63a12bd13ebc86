#include "input/study_input.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <functional>
#include <map>
#include <mutex>
#include <set>
#include <thread>
#include <tuple>
#include <utility>

#include "input/claims_input.hpp"
#include "input/stage_completion.hpp"
#include "integrate/methods.hpp"
#include "model/dynamic_model.hpp"
#include "studies/named_parameters.hpp"
#include "studies/speed_note.hpp"
#include "studies/units.hpp"

namespace epicyclic::input {

studies::SweepOptions Study::sweep() const {
  if (const auto* run = std::get_if<RunPlan>(&plan)) return studies::sweep_of_one(mesh_frequency_ratio, run->look);
  return sweep_in(plan);
}

std::vector<VariedParameter> varied_parameters(const Study& study) {
  if (const auto* map = std::get_if<studies::MapOptions>(&study.plan))
    return {{map->plane.first, "/study/first"}, {map->plane.second, "/study/second"}};
  if (const auto* branches = std::get_if<studies::BranchesOptions>(&study.plan)) {
    // So many values of the range are tried before anything is begun.
    constexpr int tried = 33;
    std::vector<VariedParameter> varied = {{{branches->parameter, branches->from, branches->to, tried}, "/study"}};
    if (const auto& loci = branches->loci)
      varied.push_back({{loci->parameter, loci->from, loci->to, tried}, "/study/loci"});
    return varied;
  }
  const bool given = std::holds_alternative<RunPlan>(study.plan) ||
                     std::holds_alternative<studies::BasinsOptions>(study.plan) || !study.has_points();
  if (given) return {};
  return {{study.sweep().axis, "/study"}};
}

namespace {

using nlohmann::json;

constexpr std::string_view stage_root = "/stage";
constexpr std::string_view patch_root = "/stage_patch";
constexpr std::string_view operation_root = "/operation";

bool is_leaf(const json& value) { return !value.is_object(); }

bool is_bookkeeping(const std::string& key) { return key == "origin" || key == "note"; }

// ---- origins ----------------------------------------------------------------------------------------------------

bool is_origin_text(const std::string& text) {
  return std::any_of(origin_words.begin(), origin_words.end(), [&](std::string_view word) {
    return text == word || text.rfind(std::string(word) + ": ", 0) == 0;
  });
}

void check_origin_text(const json& value, const std::string& pointer, ReadContext& context) {
  static const std::vector<std::string> words(origin_words.begin(), origin_words.end());
  if (!value.is_string()) {
    context.add(Finding::Kind::type, pointer, "is " + described(value) + ", must be a string");
    return;
  }
  const auto& text = value.get_ref<const std::string&>();
  if (is_origin_text(text)) return;
  const auto word = text.substr(0, text.find_first_of(": "));
  context.add(Finding::Kind::range, pointer,
              "is " + described(value) + ", must be, or begin with and a colon and a space, one of: " + listed(words) +
                  suggestion(word, words));
}

/// Checks each "origin" of a text as written: an origin speaks of keys that stand beside it.
void check_origins(const json& value, const std::string& pointer, ReadContext& context) {
  if (!value.is_object()) return;
  if (const auto origin = value.find("origin"); origin != value.end()) {
    const std::string place = pointer + "/origin";
    if (origin->is_object()) {
      std::vector<std::string> keys;
      for (const auto& [key, child] : value.items())
        if (!is_bookkeeping(key) && keys.size() < findings_told) keys.push_back(key);
      for (const auto& [key, text] : origin->items()) {
        if (is_bookkeeping(key) || !value.contains(key)) {
          const bool in_words = context.findings.size() < findings_told;
          context.add(Finding::Kind::unknown_key, place + pointer_step(key),
                      "'" + key + "' is not a key of the object that this origin belongs to" +
                          (in_words ? suggestion(key, keys) : std::string()));
        } else {
          check_origin_text(text, place + pointer_step(key), context);
        }
      }
    } else {
      check_origin_text(*origin, place, context);
    }
  }
  for (const auto& [key, child] : value.items())
    if (!is_bookkeeping(key)) check_origins(child, pointer + pointer_step(key), context);
}

/// Writes each origin as a map from the keys of its own object, and drops what is not an origin (reported already).
void spread_origins(json& object, const json& inherited = json()) {
  if (!object.is_object()) return;
  json given = inherited;
  json map = json::object();
  if (const auto origin = object.find("origin"); origin != object.end()) {
    if (origin->is_string()) given = *origin;
    if (origin->is_object()) map = *origin;
    object.erase(origin);
  }
  for (auto& [key, child] : object.items()) {
    if (is_bookkeeping(key)) continue;
    json of_key = given;
    if (const auto it = map.find(key); it != map.end()) of_key = *it;
    if (is_leaf(child)) {
      if (of_key.is_string())
        map[key] = of_key;
      else
        map.erase(key);
    } else {
      map.erase(key);
      spread_origins(child, of_key);
    }
  }
  for (auto it = map.begin(); it != map.end();) it = object.contains(it.key()) ? std::next(it) : map.erase(it);
  if (!map.empty()) object["origin"] = map;
}

/// JSON merge patch that keeps the origins: what the patch writes comes from the patch.
void apply_patch(json& target, json patch) {
  if (!patch.is_object()) return;
  json origins = json::object();
  if (const auto it = patch.find("origin"); it != patch.end()) {
    origins = *it;
    patch.erase(it);
  }
  if (!target.is_object()) target = json::object();
  for (const auto& [key, value] : patch.items()) {
    if (value.is_object()) {
      if (target.contains("origin")) target["origin"].erase(key);
      apply_patch(target[key], value);
      continue;
    }
    if (value.is_null()) {
      target.erase(key);
      if (target.contains("origin")) target["origin"].erase(key);
      continue;
    }
    target[key] = value;
    if (is_bookkeeping(key)) continue;
    const auto given = origins.find(key);
    target["origin"][key] = given == origins.end() ? "stage_patch" : "stage_patch: " + given->get<std::string>();
  }
  if (target.contains("origin") && target["origin"].empty()) target.erase("origin");
}

/// Gives each value of `resolved` the origin that it has in `given`, or "default" where it is not there at all.
void fill_origins(json& resolved, const json& given) {
  json map = json::object();
  for (auto& [key, value] : resolved.items()) {
    const auto there = given.find(key);
    if (!is_leaf(value)) {
      static const json nothing = json::object();
      fill_origins(value, there != given.end() && there->is_object() ? *there : nothing);
    } else if (there == given.end()) {
      map[key] = "default";
    } else if (given.contains("origin") && given["origin"].contains(key)) {
      map[key] = given["origin"][key];
    }
  }
  if (!map.empty()) resolved["origin"] = map;
  if (const auto note = given.find("note"); note != given.end()) resolved["note"] = *note;
}

// ---- pointers ---------------------------------------------------------------------------------------------------

/// The value at a pointer, or null pointer.
const json* find_at(const json& root, std::string_view pointer) {
  const json* at = &root;
  for (const auto& step : pointer_steps(pointer)) {
    if (at->is_object()) {
      const auto it = at->find(step);
      if (it == at->end()) return nullptr;
      at = &*it;
    } else if (at->is_array()) {
      const bool digits = !step.empty() && step.size() < 9 && step.find_first_not_of("0123456789") == std::string::npos;
      const bool plain = digits && (step.size() == 1 || step[0] != '0');
      if (!plain || std::stoul(step) >= at->size()) return nullptr;
      at = &(*at)[std::stoul(step)];
    } else {
      return nullptr;
    }
  }
  return at;
}

json* find_at(json& root, std::string_view pointer) { return const_cast<json*>(find_at(std::as_const(root), pointer)); }

void collect_numbers(const json& value, const std::string& pointer, std::vector<std::string>& pointers) {
  if (value.is_number()) pointers.push_back(pointer);
  if (value.is_object()) {
    for (const auto& [key, child] : value.items())
      if (!is_bookkeeping(key)) collect_numbers(child, pointer + pointer_step(key), pointers);
  } else if (value.is_array()) {
    for (std::size_t i = 0; i < value.size(); ++i)
      collect_numbers(value[i], pointer + "/" + std::to_string(i), pointers);
  }
}

/// The steps of what somebody wrote for a pointer, whatever stands between them; without an element's number.
std::vector<std::string> loose_steps(std::string_view text) {
  std::vector<std::string> steps;
  std::string step;
  for (const char c : std::string(text) + "/") {
    if (std::string_view("/.:\\>[]\"' ").find(c) == std::string_view::npos)
      step += c;
    else if (!step.empty())
      steps.push_back(lower_case(std::exchange(step, {})));
  }
  while (!steps.empty() && steps.back().find_first_not_of("0123456789") == std::string::npos) steps.pop_back();
  if (!steps.empty()) steps.front().erase(0, steps.front().find_first_not_of("-$"));
  if (!steps.empty() && steps.front().empty()) steps.erase(steps.begin());
  return steps;
}

/// Pointers of keys that end in the last of the steps and have the others on their way: what was probably meant. Of
/// these the one that is the same, or those that have nothing between the steps, if there are any.
std::vector<std::string> meant_pointers(std::string_view text, const std::vector<KeyPlace>& places) {
  const std::vector<std::string> steps = loose_steps(text);
  std::array<std::vector<std::string>, 3> meant;  // the same, with the same end, with the same steps
  if (steps.empty()) return {};
  for (const auto& place : places) {
    const std::vector<std::string> there = loose_steps(place.pointer);
    if (there.empty() || there.back() != steps.back()) continue;
    std::size_t found = 0;
    for (const std::string& step : there)
      if (found < steps.size() && step == steps[found]) ++found;
    if (found < steps.size()) continue;
    const bool same_end = std::equal(steps.rbegin(), steps.rend(), there.rbegin());
    auto& these = meant[!same_end ? 2 : there.size() == steps.size() ? 0 : 1];
    if (std::find(these.begin(), these.end(), place.pointer) == these.end()) these.push_back(place.pointer);
  }
  const auto best = std::find_if(meant.begin(), meant.end(), [](const auto& these) { return !these.empty(); });
  return best == meant.end() ? std::vector<std::string>() : *best;
}

/// "; did you mean 'x'?" of some pointers, or nothing.
std::string suggested(const std::vector<std::string>& meant) {
  constexpr std::size_t most = 4;
  if (meant.empty() || meant.size() > most) return {};
  return "; did you mean " + (meant.size() == 1 ? "'" + meant.front() + "'" : "one of: " + listed(meant)) + "?";
}

/// Keys of a study with its stage, and where they stand.
const std::vector<KeyPlace>& all_places() {
  static const auto places = [] {
    std::vector<KeyPlace> all;
    study_table().collect("", all);
    return all;
  }();
  return places;
}

/// A value that is set is not computed any more: its origin says so, or would have it computed anew.
void keep_from_computing(json& root, const std::string& pointer) {
  json* at = &root;
  for (const auto& step : pointer_steps(pointer)) {
    if (!at->is_object()) break;
    if (const auto origin = at->find("origin"); origin != at->end() && origin->is_object()) {
      const auto text = origin->find(step);
      if (text != origin->end() && gives_way(*text)) *text = "set: parameter";
    }
    at = find_at(*at, pointer_step(step));
    if (at == nullptr) break;
  }
}

// ---- assignments ------------------------------------------------------------------------------------------------

std::string shown(const Assignment& set) { return "--set " + set.text; }

}  // namespace

std::string assign(json& root, std::string_view pointer, const json& value) {
  json* at = &root;
  json* object = nullptr;  // innermost object, and the key in it
  std::string key;
  std::string so_far;
  for (const auto& step : pointer_steps(pointer)) {
    if (at->is_null()) *at = json::object();
    if (at->is_object()) {
      object = at;
      key = step;
      at = &(*at)[step];
    } else if (at->is_array()) {
      json* element = find_at(*at, pointer_step(step));
      if (element == nullptr)
        return "there is no element " + step + " in the array " + so_far + " of " + std::to_string(at->size());
      at = element;
    } else {
      return so_far + " is " + described(*at) + ": there is nothing below it";
    }
    so_far += pointer_step(step);
  }
  // A text of origin holds for the whole object: one for each key, before one key gets its own.
  if (object != nullptr && object->contains("origin") && (*object)["origin"].is_string()) spread_origins(*object);
  *at = value;
  // Of the object: none where what stands there is no origin, which is told of the file.
  const auto origins = [&]() -> json* {
    const auto there = object == nullptr ? json::iterator() : object->find("origin");
    return object != nullptr && there != object->end() && there->is_object() ? &*there : nullptr;
  };
  if (is_leaf(value)) {
    if (object != nullptr && !is_bookkeeping(key) && !value.is_null()) {
      if (!object->contains("origin")) (*object)["origin"] = json::object();
      if (json* map = origins()) (*map)[key] = "set: command line";
    }
  } else {
    if (json* map = origins()) map->erase(key);
    if (!at->contains("origin")) (*at)["origin"] = "set: command line";
    spread_origins(*at);
  }
  if (value.is_null() && object != nullptr) {
    object->erase(key);
    if (json* map = origins()) map->erase(key);
  }
  return {};
}

std::vector<Assignment> parse_assignments(std::span<const std::string> texts) {
  std::vector<Assignment> sets;
  for (const auto& text : texts) {
    const auto equals = text.find('=');
    Assignment& set = sets.emplace_back(Assignment{text.substr(0, equals), {}, text});
    const auto refuse = [&](std::string message) { set.problems.push_back(std::move(message)); };
    if (std::string message = not_text(text); !message.empty()) {
      refuse(std::move(message));
      continue;
    }
    if (equals == std::string::npos) {
      const auto end = text.find_last_of(": \t");
      const auto meant =
          end == std::string::npos ? std::vector<std::string>() : meant_pointers(text.substr(0, end), all_places());
      refuse("must be /json/pointer=value: there is no '='" +
             (meant.size() == 1 ? "; did you mean '" + meant.front() + "=" + text.substr(end + 1) + "'?" : ""));
      continue;
    }
    if (set.pointer.size() < 2 || set.pointer[0] != '/') {
      std::string hint = suggested(meant_pointers(set.pointer, all_places()));
      if (const auto steps = loose_steps(set.pointer); hint.empty() && !steps.empty()) {
        for (const std::string& step : steps) hint += pointer_step(step);
        hint = "; did you mean '" + hint + "'?";
      }
      refuse("must be /json/pointer=value: a pointer begins with '/'" + hint);
      continue;
    }
    if (const auto steps = pointer_steps(set.pointer); std::find(steps.begin(), steps.end(), "origin") != steps.end()) {
      refuse("an origin is written in the file; values given here carry \"set: command line\"");
      continue;
    }
    const std::string value = text.substr(equals + 1);
    if (value.empty()) {
      refuse("must be /json/pointer=value: there is no value behind '='");
      continue;
    }
    auto parsed = parse_json(value, "--set " + text);
    ReadContext context;
    check_origins(parsed.value, "", context);
    for (auto& finding : context.findings) refuse("the value: " + finding.pointer + " " + finding.message);
    if (parsed.complete && parsed.problems.empty()) {
      set.value = std::move(parsed.value);
    } else if (const std::string hint = misspelt_number(value); !hint.empty()) {
      refuse("the value: '" + value + "' is not a number in JSON: " + hint);
    } else if (value.find_first_of("{[\"+-0123456789") == 0) {  // sets out to be more than a word
      const bool word = parsed.problems.size() == 1 && value.find_first_of("{[\"") != 0;
      for (const auto& problem : parsed.problems)
        refuse("the value: " + problem.message +
               (word ? "; a text that begins like a number stands in double quotes" : ""));
    } else {
      set.value = value;
    }
  }
  return sets;
}

/// The texts that an input was made of, and which of them a pointer of the whole leads to.
struct LoadedInput::Sources {
  std::filesystem::path path;
  std::shared_ptr<JsonFiles> files;  ///< shared by all inputs that are made of one
  JsonSource study;
  std::optional<JsonSource> stage;
  bool bare = false;  ///< the file is a stage alone
  json patch;         ///< as written
  std::vector<Assignment> sets;

  /// File and line of a pointer; of its nearest parent, if it is not there. The pointer is kept.
  [[nodiscard]] Problem locate(const std::string& pointer, std::string message) const {
    for (auto set = sets.rbegin(); set != sets.rend(); ++set) {
      const bool made_by_set = pointer_within(set->pointer, pointer) && !stands(pointer);
      if (pointer_within(pointer, set->pointer) || made_by_set) return {shown(*set), 0, pointer, std::move(message)};
    }
    if (!bare && pointer_within(pointer, stage_root)) {
      const std::string rest = pointer.substr(stage_root.size());
      if (patches(rest)) {
        const int line = study.line_of(std::string(patch_root) + rest);
        return {study.name, line, pointer, std::move(message) + " (from stage_patch)"};
      }
      if (stage) return {stage->name, stage->line_of(rest), pointer, std::move(message)};
    }
    return {study.name, study.line_of(pointer), pointer, std::move(message)};
  }

  /// Was the value at this pointer replaced because it could not be read (and that reported)?
  [[nodiscard]] bool is_unreadable(const std::string& pointer) const {
    for (const auto& set : sets)
      if (pointer_within(pointer, set.pointer)) return false;
    if (!bare && pointer_within(pointer, stage_root)) {
      const std::string rest = pointer.substr(stage_root.size());
      if (patches(rest)) return study.unreadable.count(std::string(patch_root) + rest) > 0;
      if (stage) return stage->unreadable.count(rest) > 0;
    }
    return study.unreadable.count(pointer) > 0;
  }

  /// The message of a finding; of an unknown key that an assignment made, with the pointer that was probably meant.
  [[nodiscard]] std::string meant_by_set(const Finding& finding) const {
    if (finding.kind == Finding::Kind::unknown_key && !stands(finding.pointer))
      for (auto set = sets.rbegin(); set != sets.rend(); ++set) {
        if (!pointer_within(set->pointer, finding.pointer)) continue;
        const std::vector<std::string> pointers = meant_pointers(set->pointer, all_places());
        const std::string meant = suggested(pointers);
        const std::size_t end = finding.message.find("'; ");
        const bool same = pointers.size() == 1 && pointers.front() == set->pointer;  // known elsewhere, not here
        if (!meant.empty() && !same && end != std::string::npos) return finding.message.substr(0, end + 1) + meant;
      }
    return finding.message;
  }

 private:
  [[nodiscard]] bool stands(const std::string& pointer) const {
    if (study.line.count(pointer) > 0) return true;
    if (bare || !pointer_within(pointer, stage_root)) return false;
    const std::string rest = pointer.substr(stage_root.size());
    return patches(rest) || (stage && stage->line.count(rest) > 0);
  }

  /// Does the patch write the value at this pointer of the stage?
  [[nodiscard]] bool patches(std::string_view rest) const {
    const json* at = &patch;
    for (const auto& step : pointer_steps(rest)) {
      if (!at->is_object()) break;
      const auto it = at->find(step);
      if (it == at->end()) return false;
      at = &*it;
    }
    if (!at->is_object()) return !at->is_null();
    return !rest.empty() && stage && stage->line.count(rest) == 0;  // an object that only the patch has
  }
};

namespace {

/// Whether a rule of gear can be judged at a pointer, when some values were not read and stand at their defaults.
class Judge {
 public:
  /// @param unread  pointers, relative to the stage
  explicit Judge(std::vector<std::string> unread) : unread_(std::move(unread)) {}

  [[nodiscard]] bool can_tell(std::string_view pointer) const {
    const std::string_view member = member_of(pointer);
    return std::none_of(unread_.begin(), unread_.end(), [&](const std::string& u) {
      const std::string_view other = member_of(u);
      // On these, and on whole objects, many rules rest; the pressure angle follows from the members that mesh.
      const bool far = other == "/boundary" || other == "/planets" || other.empty() || other == "/lumped";
      const bool angle = pointer.ends_with("/operating_pressure_angle_deg") && pointer_within(other, "/lumped");
      return far || angle || other == member;
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

/// Is this a value that others are computed from [stage_completion.hpp]?
bool feeds_completion(std::string_view pointer, bool bare) {
  const std::string root = bare ? "" : std::string(stage_root);
  return pointer_within(pointer, root + "/catalogue") || pointer_within(pointer, root + "/planets");
}

/// The rules of gear, which need values to judge, and say nothing new about what was found already.
/// @param root          pointer of the stage
/// @param not_computed  tells of a place of the stage that it has no value because none could be computed
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
  if (study.stage.planet_count < gear::planets_min || study.stage.planet_count > gear::planets_max) return sound;
  auto rules = gear::problems_for_modes(study.stage);
  if (study.has_motion()) {
    const auto more = gear::problems_for_motion(study.stage);
    rules.insert(rules.end(), more.begin(), more.end());
  }
  const Judge judge(std::move(unread));
  std::set<std::string> told;
  for (const auto& rule : rules) {
    if (!told.insert(rule).second) continue;
    const auto colon = rule.find(": ");
    const std::string place = colon == std::string::npos ? "" : rule.substr(0, colon);
    const std::string pointer = root + place;
    // What was not computed can break no rule.
    if (!judge.can_tell(place) || not_computed(pointer)) continue;
    if (known.count(pointer) == 0)
      context.add(Finding::Kind::rule, pointer, colon == std::string::npos ? rule : rule.substr(colon + 2));
  }
  return sound;
}

/// Reads the whole input from one JSON value, which is completed from catalogue data first: the tables, then the rules
/// that span objects.
/// @param computed  becomes what the catalogue data give, at its places; null: the input has been completed already,
///                  from these very catalogue data
/// @returns false beside the study if values of the stage could not be read or computed
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

  // What could not be computed is not missing.
  if (!complete)
    std::erase_if(context.findings, [&](const Finding& finding) {
      return finding.kind == Finding::Kind::missing_key && pointer_within(finding.pointer, root + "/lumped");
    });
  const auto not_computed = [&](const std::string& pointer) { return !complete && find_at(whole, pointer) == nullptr; };
  const bool sound = judge_stage(study, root, not_computed, context);
  return {std::move(study), complete && sound};
}

/// A study that was read without a finding, with other numbers in it that nothing is computed from.
/// @returns nothing if one of them is not a number of the study's tables
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

/// Values that say that they were computed, where nothing computes them: in one line, or none.
void note_uncomputed(const json& resolved, const json& computed, std::vector<std::string>& notes) {
  std::vector<std::string> found;
  const std::function<void(const json&, const json*, const std::string&)> walk = [&](const json& object,
                                                                                     const json* known,
                                                                                     const std::string& pointer) {
    const auto origin = object.find("origin");
    for (const auto& [key, value] : object.items()) {
      if (is_bookkeeping(key)) continue;
      const json* there = known != nullptr && known->is_object() && known->contains(key) ? &known->at(key) : nullptr;
      const std::string place = pointer + pointer_step(key);
      if (value.is_object()) {
        walk(value, there, place);
      } else if (origin != object.end() && origin->contains(key) && is_computed(origin->at(key)) &&
                 (there == nullptr || *there != value)) {
        found.push_back(place);
      }
    }
  };
  walk(resolved, &computed, "");
  if (found.empty()) return;
  const std::string others = found.size() == 1 ? "" : " and " + std::to_string(found.size() - 1) + " more";
  notes.push_back(found.front() + others + ": \"computed\" is the origin in the file, but nothing computes " +
                  (others.empty() ? "it here; it stands" : "them here; they stand") + " as given");
}

/// The first value at which something is wrong, and what; nothing if all are sound.
struct Unsound {
  std::size_t value = 0;
  std::vector<Problem> problems;
};

/// @param problems_at  what is wrong at a value; asked by several threads at once
template <class F>
Unsound first_unsound(std::size_t values, F problems_at) {
  Unsound first{values, {}};
  std::mutex mutex;
  std::atomic<std::size_t> least{values};
  constexpr std::size_t few = 16;  // not worth a thread
  const int threads = values < few ? 1 : static_cast<int>(std::thread::hardware_concurrency());
  (void)studies::for_units(values, threads, nullptr, [&](std::size_t k) {
    if (k > least) return;
    std::vector<Problem> problems = problems_at(k);
    const std::scoped_lock lock(mutex);
    if (problems.empty() || k > first.value) return;
    first = {k, std::move(problems)};
    least = k;
  });
  return first;
}

/// Rules of a range of values that span its keys.
///
/// @param place   of the object with from, to and points
/// @param is_bad  tells whether the value at a pointer is not the one in the text
/// @param hint    added where from is above to
template <class F>
void check_range(const studies::Axis& axis, const std::string& place, F is_bad, const std::string& hint,
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

/// A parameter with a name, and its values. Pointers are checked with the values in place.
template <class F>
void check_named_parameter(const studies::Axis& axis, const std::string& place, F is_bad, ReadContext& context) {
  if (axis.name.rfind('/', 0) == 0) return;
  const studies::NamedParameter* const parameter = studies::find_parameter(axis.name);
  if (parameter == nullptr) {
    std::vector<std::string> names;
    for (const auto& p : studies::named_parameters()) names.push_back(p.name);
    if (!place.starts_with("/study/sweeps"))  // of claims, whose values are in Omega
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

/// Why a number of the input is no parameter of the motion; nothing where it may be one.
std::string why_no_parameter(const std::string& pointer) {
  if (pointer_within(pointer, "/integrator") && pointer != "/integrator/clearance_smoothing")
    return "an option of the integrator is not a parameter of the motion and cannot be swept";
  if (pointer_within(pointer, "/study/initial_state"))
    return "a component of the start is no parameter of the motion; `epicyclic basins` varies two of them";
  if (pointer == "/stage/planets/count") return "the number of planets changes the state itself and cannot be swept";
  return {};
}

/// Pointers of the input that a parameter stands for.
std::vector<std::string> values_set_by(const std::string& parameter) {
  const studies::NamedParameter* named = studies::find_parameter(parameter);
  return named == nullptr ? std::vector{parameter} : named->pointers;
}

/// Two parameters that are varied at once set different numbers.
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

/// Rules of the two parameters of a map.
template <class F>
void check_map(const studies::Plane& plane, F is_bad, ReadContext& context) {
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
template <class F>
void check_basins(const studies::BasinsOptions& basins, const gear::Stage& stage, F is_bad, ReadContext& context) {
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
template <class F>
void check_branches(const studies::BranchesOptions& b, const gear::Stage& stage, F is_bad, ReadContext& context) {
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
template <class F>
void check_points(const Study& study, F is_bad, ReadContext& context) {
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

/// Rules of claims: those of the options themselves, and names of parameters.
template <class F>
void check_claims(const studies::ClaimsOptions& claims, F is_bad, ReadContext& context) {
  if (is_bad("/study")) return;
  for (auto& [place, message] : claims.problems())
    if (!is_bad("/study" + place)) context.add(Finding::Kind::rule, "/study" + place, std::move(message));
  const studies::LookOptions& look = claims.look;
  if (look.transient == studies::Transient::adaptive && look.classification_periods == 0)
    context.add(Finding::Kind::rule, "/study/classification_periods", "is 0, must be >= 1 for an adaptive transient");
  for (std::size_t k = 0; k < claims.sweeps.size(); ++k) {
    const studies::ClaimSweep& sweep = claims.sweeps[k];
    const std::string place = "/study/sweeps/" + std::to_string(k);
    if (!is_bad(place + "/parameter")) check_named_parameter(sweep.axis, place, is_bad, context);
    if (std::string why = why_no_parameter(sweep.axis.name); !why.empty())
      context.add(Finding::Kind::rule, place + "/parameter", std::move(why));
    for (std::size_t j = 0; j < sweep.at.size(); ++j) {
      const studies::SetValue& set = sweep.at[j];
      const std::string at = place + "/at/" + std::to_string(j);
      if (!is_bad(at + "/parameter") && set.value)
        check_named_parameter(studies::Axis{set.parameter, *set.value, *set.value, 1}, at, is_bad, context);
      if (set.value.has_value() != set.as.empty())
        context.add(Finding::Kind::rule, at, "must have \"value\" or \"as\", and not both");
      check_different(sweep.axis.name, set.parameter, at + "/parameter", context);
      for (std::size_t before = 0; before < j; ++before)
        check_different(sweep.at[before].parameter, set.parameter, at + "/parameter", context);
      if (std::string why = why_no_parameter(set.parameter); !why.empty())
        context.add(Finding::Kind::rule, at + "/parameter", std::move(why));
    }
  }
}

/// Collects problems in the order of the texts: study, stage, assignments.
class Problems {
 public:
  void add(Problem problem) { all_.push_back(std::move(problem)); }
  void add(const JsonSource& source, std::string_view prefix = {}) {
    for (auto problem : source.problems) {
      if (!problem.pointer.empty() || problem.line > 0) problem.pointer.insert(0, prefix);
      all_.push_back(std::move(problem));
    }
  }
  [[nodiscard]] bool empty() const { return all_.empty(); }

  [[noreturn]] void raise(const std::string& study, const std::optional<JsonSource>& stage) {
    const auto rank = [&](const Problem& p) { return p.file == study ? 0 : stage && p.file == stage->name ? 1 : 2; };
    std::stable_sort(all_.begin(), all_.end(), [&](const Problem& a, const Problem& b) {
      return std::pair(rank(a), a.line) < std::pair(rank(b), b.line);
    });
    constexpr std::size_t most = 200;
    std::vector<Problem> once;
    std::set<std::string> told;
    for (auto& problem : all_) {
      if (!told.insert(problem.text()).second || told.size() > most) continue;
      once.push_back(std::move(problem));
    }
    if (told.size() > most) {
      Problem more = once.back();
      more.message = "and " + std::to_string(told.size() - most) + " more problems";
      once.push_back(std::move(more));
    }
    throw InputProblems(std::move(once));
  }

 private:
  std::vector<Problem> all_;
};

}  // namespace

/// Reads an input step by step: its texts into one, that into values, and the values that a study varies.
class LoadedInput::Loader {
 public:
  Loader(const std::filesystem::path& path, std::shared_ptr<JsonFiles> files) {
    sources_->path = path;
    sources_->files = std::move(files);
  }

  /// @throws InputProblems with all that is wrong
  LoadedInput load(std::span<const Assignment> sets) {
    read_study_file(sets);
    // Assignments that change which stage is read, or the patch, come first.
    for (const auto& set : sources_->sets)
      if (is_early(set)) make(set);
    if (!sources_->bare && whole_.contains("stage") && whole_["stage"].is_string()) read_stage_file();
    if (whole_.contains("stage_patch") && !sources_->bare) patch_stage();
    spread_all_origins();
    for (const auto& set : sources_->sets)
      if (!is_early(set) && !(stage_missing_ && pointer_within(set.pointer, stage_root))) make(set);
    for (auto& set : sources_->sets)
      if (sources_->bare && pointer_within(set.pointer, stage_root)) set.pointer.erase(0, stage_root.size());
    read_values();
    check_varied();
    if (!problems_.empty()) raise();
    return std::move(input_);
  }

 private:
  [[noreturn]] void raise() { problems_.raise(sources_->study.name, sources_->stage); }

  void refuse(const std::string& pointer, std::string message) {
    problems_.add(sources_->locate(pointer, std::move(message)));
  }

  void note_origins(const json& value, const JsonSource& source, const std::string& prefix) {
    ReadContext context;
    check_origins(value, "", context);
    for (auto& finding : context.findings)
      problems_.add(
          {source.name, source.line_of(finding.pointer), prefix + finding.pointer, std::move(finding.message)});
  }

  void read_study_file(std::span<const Assignment> sets) {
    JsonSource& file = sources_->study;
    file = sources_->files->read(sources_->path);
    problems_.add(file);
    for (const Assignment& set : sets) {
      if (set.problems.empty()) sources_->sets.push_back(set);
      for (const std::string& message : set.problems) problems_.add({shown(set), 0, "", message});
    }
    if (file.complete && !file.value.is_object())
      problems_.add({file.name, file.line_of(""), "", "is " + described(file.value) + ", must be an object"});
    if (!file.complete || !file.value.is_object()) raise();
    note_origins(file.value, file, "");
    whole_ = file.value;
    sources_->bare = (whole_.contains("lumped") || whole_.contains("catalogue")) && !whole_.contains("stage");
  }

  [[nodiscard]] bool is_early(const Assignment& set) const {
    return !sources_->bare &&
           (pointer_within(set.pointer, patch_root) || (set.pointer == stage_root && set.value.is_string()));
  }

  void make(const Assignment& set) {
    std::string pointer = set.pointer;
    if (sources_->bare && pointer_within(pointer, stage_root)) pointer.erase(0, stage_root.size());
    if (pointer_parent(pointer) == operation_root && !set.value.is_null()) drop_other_speeds(pointer_leaf(pointer));
    if (auto message = assign(whole_, pointer, set.value); !message.empty())
      problems_.add({shown(set), 0, set.pointer, std::move(message)});
  }

  /// A speed that is set takes the place of one that was given otherwise.
  void drop_other_speeds(const std::string& key) {
    const auto is_speed = [](std::string_view k) {
      return k == studies::speed_parameter || find_speed_alias(k) != nullptr;
    };
    const auto operation = whole_.find("operation");
    if (!is_speed(key) || operation == whole_.end() || !operation->is_object()) return;
    std::vector<std::string> others;
    for (const auto& [other, value] : operation->items())
      if (is_speed(other) && other != key) others.push_back(other);
    for (const std::string& other : others) (void)assign(whole_, std::string(operation_root) + "/" + other, nullptr);
  }

  /// Omega at a speed that stands at a pointer; nothing where it is out of range, which is told.
  std::optional<double> ratio_of(const SpeedAlias& alias, double value, const std::string& pointer) {
    const std::optional<double> per_unit = ratio_per_unit(alias, input_.study.stage);
    const studies::NamedParameter& speed = *studies::find_parameter(studies::speed_parameter);
    const Bounds bounds = between(speed.least, speed.most);
    std::string why;
    if (!per_unit)
      why = "is a speed of a member that stands still in this stage";
    else if (!bounds.contains(value * *per_unit))
      why = "is " + number_text(value) + ", with which the mesh frequency ratio is " + number_text(value * *per_unit) +
            ", must be " + bounds.text();
    if (why.empty()) return value * *per_unit;
    context_.add(Finding::Kind::range, pointer, std::move(why));
    found_.insert(pointer);
    return std::nullopt;
  }

  /// The same along an axis: to as many digits as the values between its ends have, so that a longer range has the same
  /// values and an end is one of them.
  std::optional<double> axis_ratio_of(const SpeedAlias& alias, double value, const std::string& pointer) {
    const std::optional<double> ratio = ratio_of(alias, value, pointer);
    constexpr double between_ends = 0.5;
    return ratio ? std::optional(studies::grid_value(*ratio, *ratio, between_ends)) : std::nullopt;
  }

  /// Where the number at a key comes from: as before, with the speed that it was.
  /// @param moved  key that the speed stood at, if that is another one
  static void note_conversion(json& object, const std::string& key, std::string_view moved, const SpeedAlias& alias,
                              double given) {
    if (object.contains("origin") && object["origin"].is_string()) spread_origins(object);
    json& origin = object["origin"];
    if (!origin.is_null() && !origin.is_object()) return;  // told of the file
    const std::string from(moved.empty() ? std::string_view(key) : moved);
    std::string text =
        origin.contains(from) && origin[from].is_string() ? origin[from].get<std::string>() : std::string("choice");
    if (!moved.empty()) {
      object.erase(from);
      if (origin.is_object()) origin.erase(from);
      object[key] = 0.0;  // stands there: no default
    }
    origin[key] = studies::with_speed_note(std::move(text), alias.key, number_text(given));
  }

  /// The number at a key whose origin notes that it was another speed, as in a resolved input: of this stage that is
  /// still so, or what the origin says is told and does not stand.
  /// @returns the note, where it is so
  std::optional<studies::SpeedNote> speed_noted_at(const std::string& place, const std::string& key, double value) {
    json* object = find_at(whole_, place);
    if (object == nullptr || !object->is_object() || !object->contains("origin")) return std::nullopt;
    json& origin = (*object)["origin"];
    json* text = origin.is_object() && origin.contains(key) ? &origin[key] : nullptr;
    if (text == nullptr || !text->is_string()) return std::nullopt;
    std::optional<studies::SpeedNote> note = studies::find_speed_note(text->get_ref<const std::string&>());
    const SpeedAlias* alias = note ? find_speed_alias(note->key) : nullptr;
    if (alias == nullptr) return std::nullopt;
    constexpr double same = 1e-9;  // relative; computed data of another machine may differ in their last digits
    const std::optional<double> per_unit = ratio_per_unit(*alias, input_.study.stage);
    if (per_unit && std::abs(value - note->value * *per_unit) <= same * std::abs(value)) return note;
    const auto here = [&] {
      return note->key + " = " + number_text(studies::grid_value(0, 2 * value / *per_unit, 0.5));
    };
    context_.notes.push_back(place + pointer_step(key) + ": stays " + number_text(value) + ", which is " +
                             (per_unit ? here() : "no speed of that member") + " in this stage and not " + note->text +
                             ", as its origin notes of another stage; give " + note->key + " to keep that speed");
    *text = note->before;
    return std::nullopt;
  }

  void keep_axis_speed(const SpeedAlias& alias) {
    if (const auto per_unit = ratio_per_unit(alias, input_.study.stage))
      input_.study.axis_speed = studies::SpeedUnit{std::string(alias.key), 1.0 / *per_unit};
  }

  /// The speeds in rpm and Hz, of the operating point and of axes, as Omega.
  void convert_speeds() {
    Study& read = input_.study;
    const bool moves = sound_ && gear::problems_for_motion(read.stage).empty();
    for (const SpeedAlias& alias : speed_aliases()) {
      std::optional<double>& given = read.given_speed.*alias.given;
      const std::string place = std::string(operation_root) + "/" + std::string(alias.key);
      if (const auto value = std::exchange(given, std::nullopt); value && moves && !is_bad(place))
        if (const auto ratio = ratio_of(alias, *value, place)) {
          read.mesh_frequency_ratio = *ratio;
          note_conversion(whole_["operation"], studies::speed_parameter, alias.key, alias, *value);
        }
    }
    if (moves)
      if (const auto note =
              speed_noted_at(std::string(operation_root), studies::speed_parameter, read.mesh_frequency_ratio))
        input_.given_speed.*find_speed_alias(note->key)->given = note->value;
    // By its pointer it is the same parameter, and is to be told as that.
    const auto by_name = [](std::string& name) {
      if (name == studies::find_parameter(studies::speed_parameter)->pointers.front()) name = studies::speed_parameter;
    };
    const auto convert = [&](std::string& name, double& from, double& to, const std::string& place) {
      by_name(name);
      const SpeedAlias* alias = find_speed_alias(name);
      if (alias == nullptr) {
        if (moves && name == studies::speed_parameter)
          for (const auto& [key, value] : {std::pair("from", from), {"to", to}})
            if (const auto note = speed_noted_at(place, key, value)) keep_axis_speed(*find_speed_alias(note->key));
        return;
      }
      name = studies::speed_parameter;
      if (moves) keep_axis_speed(*alias);
      json& object = *find_at(whole_, place);
      const studies::Axis standard = studies::SweepOptions{}.axis;
      if (object.contains("from") && object.contains("to") && !is_bad(place + "/from") && !is_bad(place + "/to") &&
          from > to) {
        context_.add(Finding::Kind::rule, place + "/from",
                     "is " + number_text(from) + ", must be <= to = " + number_text(to));
        found_.insert(place + "/from");
      }
      for (const auto& [key, value, otherwise] : {std::tuple("from", &from, standard.from), {"to", &to, standard.to}}) {
        const double given = std::exchange(*value, otherwise);
        const std::string at = place + "/" + key;
        if (!object.contains(key)) {
          if (place == "/study")  // else its table has told
            context_.add(Finding::Kind::missing_key, at,
                         "is missing; " + std::string(alias->key) + " needs a range of its own");
          found_.insert(at);
        } else if (moves && !is_bad(at)) {
          *value = axis_ratio_of(*alias, given, at).value_or(otherwise);
          note_conversion(object, key, {}, *alias, given);
        }
      }
    };
    const auto each = [&](const SpeedAlias* alias, std::vector<double>& values, const std::string& place) {
      if (alias == nullptr || !moves) return;
      for (std::size_t k = 0; k < values.size(); ++k)
        values[k] = axis_ratio_of(*alias, values[k], place + "/" + std::to_string(k)).value_or(1.0);
    };
    const auto axis = [&](studies::Axis& of, const std::string& place) { convert(of.name, of.from, of.to, place); };
    if (auto* map = std::get_if<studies::MapOptions>(&read.plan)) {
      axis(map->plane.first, "/study/first");
      axis(map->plane.second, "/study/second");
    } else if (auto* b = std::get_if<studies::BranchesOptions>(&read.plan)) {
      const SpeedAlias* alias = find_speed_alias(b->parameter);
      each(alias, b->starts, "/study/starts");
      each(alias, b->values, "/study/values");
      if (b->search) each(alias, b->search->values, "/study/search/values");
      if (b->loci) each(alias, b->loci->near, "/study/loci/near");
      for (std::size_t k = 0; k < b->seeds.size() && alias != nullptr && moves; ++k) {
        studies::BranchSeed& seed = b->seeds[k];
        const std::string place = "/study/seeds/" + std::to_string(k);
        seed.value = axis_ratio_of(*alias, seed.value, place + "/value").value_or(1.0);
        if (seed.reach) seed.reach = axis_ratio_of(*alias, *seed.reach, place + "/reach").value_or(1.0);
      }
      convert(b->parameter, b->from, b->to, "/study");
      if (b->loci) convert(b->loci->parameter, b->loci->from, b->loci->to, "/study/loci");
    } else if (auto* claims = std::get_if<studies::ClaimsOptions>(&read.plan)) {
      for (studies::ClaimSweep& sweep : claims->sweeps) by_name(sweep.axis.name);
    } else if (read.has_points() && !std::holds_alternative<RunPlan>(read.plan) &&
               !std::holds_alternative<studies::BasinsOptions>(read.plan)) {
      axis(sweep_in(read.plan).axis, "/study");
    }
  }

  /// Puts the stage that the study names in the place of its name.
  void read_stage_file() {
    const auto named = whole_["stage"].get<std::string>();
    const std::filesystem::path stage_path = sources_->path.parent_path() / named;
    JsonSource stage = sources_->files->read(stage_path);
    whole_.erase("stage");
    if (whole_.contains("origin") && whole_["origin"].is_object()) whole_["origin"].erase("stage");
    if (stage.bytes.empty() && !stage.problems.empty()) {  // not readable at all: say who named it
      for (const auto& problem : stage.problems)
        refuse(std::string(stage_root), "the stage file " + problem.file + ": " + problem.message);
    } else {
      problems_.add(stage, stage_root);
      if (stage.complete && !stage.value.is_object())
        problems_.add({stage.name, stage.line_of(""), std::string(stage_root),
                       "is " + described(stage.value) + ", must be an object"});
    }
    stage_missing_ = !stage.complete || !stage.value.is_object();
    if (!stage_missing_) {
      note_origins(stage.value, stage, std::string(stage_root));
      whole_["stage"] = stage.value;
    }
    input_.stage_file = RawFile{stage_path.filename().string(), stage.bytes};
    sources_->stage = std::move(stage);
  }

  void patch_stage() {
    const auto patch = whole_.find("stage_patch");
    sources_->patch = *patch;
    whole_.erase(patch);
    const bool has_stage = !stage_missing_ && whole_.contains("stage") && whole_["stage"].is_object();
    if (!sources_->patch.is_object()) {
      refuse(std::string(patch_root), "is " + described(sources_->patch) + ", must be an object: a JSON merge patch");
      sources_->patch = json::object();
    } else if (has_stage && problems_.empty()) {
      json patch_spread = sources_->patch;
      spread_origins(patch_spread);
      spread_origins(whole_["stage"]);
      apply_patch(whole_["stage"], std::move(patch_spread));
    } else if (has_stage) {
      whole_["stage"].merge_patch(sources_->patch);  // the origins are not needed any more
    }
  }

  /// An origin of the study does not speak for another file.
  void spread_all_origins() {
    if (!sources_->stage || !whole_.contains("stage")) {
      spread_origins(whole_);
      return;
    }
    json stage = std::move(whole_["stage"]);
    whole_.erase("stage");
    spread_origins(stage);
    spread_origins(whole_);
    whole_["stage"] = std::move(stage);
  }

  /// Whether the value at a pointer is not the one in the text.
  [[nodiscard]] bool is_bad(const std::string& pointer) const {
    return found_.count(pointer) > 0 || sources_->is_unreadable(pointer);
  }

  void check_integrator() {
    const integrate::IntegratorOptions& integrator = input_.study.integrator;
    const auto* method = integrate::find_method(integrator.method);
    if (!integrator.locate_contacts || method == nullptr || method->locates_contacts() || is_bad("/integrator/method"))
      return;
    std::vector<std::string> able;
    for (const auto& other : integrate::methods())
      if (other.locates_contacts()) able.emplace_back(other.name);
    context_.add(Finding::Kind::rule, "/integrator/locate_contacts",
                 "is true, must be false with \"method\": \"" + integrator.method +
                     "\"; those that locate contacts are " + listed(able));
  }

  /// The study of the whole text, and all that is wrong with its values.
  void read_values() {
    std::tie(input_.study, sound_) = read_study(whole_, sources_->bare, context_, &input_.computed);
    for (const auto& finding : context_.findings) found_.insert(finding.pointer);
    convert_speeds();
    check_integrator();
    const auto bad = [this](const std::string& pointer) { return is_bad(pointer); };
    if (input_.study.has_points()) check_points(input_.study, bad, context_);
    if (auto* sweep = std::get_if<studies::SweepOptions>(&input_.study.plan)) sweep->segments = segments_of(*sweep);
    if (const auto* claims = std::get_if<studies::ClaimsOptions>(&input_.study.plan))
      check_claims(*claims, bad, context_);
    if (const auto* branches = std::get_if<studies::BranchesOptions>(&input_.study.plan))
      check_branches(*branches, input_.study.stage, bad, context_);
    input_.resolved = sources_->bare ? stage_table().write(input_.study.stage) : study_table().write(input_.study);
    fill_origins(input_.resolved, whole_);
    note_uncomputed(input_.resolved, input_.computed, context_.notes);
    note_undone();
    input_.study_file = {sources_->path.filename().string(), sources_->study.bytes};
    input_.sources_ = sources_;
    input_.notes = std::move(context_.notes);
    for (const auto& finding : context_.findings) {
      if (stage_missing_ && pointer_within(finding.pointer, stage_root)) continue;
      if (sources_->is_unreadable(finding.pointer)) continue;
      refuse(finding.pointer, sources_->meant_by_set(finding));
    }
  }

  /// What was taken out and is there again, since it follows from what was left.
  void note_undone() {
    const auto note = [&](const std::string& pointer, const std::string& who) {
      if (find_at(input_.computed, pointer) != nullptr && find_at(input_.resolved, pointer) != nullptr)
        context_.notes.push_back(pointer + ": " + who +
                                 " takes it out, and it is computed from the catalogue data again; give a value in its "
                                 "place, or take out the data that it follows from");
    };
    for (const Assignment& set : sources_->sets)
      if (set.value.is_null()) note(set.pointer, shown(set));
    const std::function<void(const json&, const std::string&)> walk = [&](const json& patch, const std::string& at) {
      for (const auto& [key, value] : patch.items()) {
        if (value.is_object()) walk(value, at + pointer_step(key));
        if (value.is_null()) note(at + pointer_step(key), "stage_patch");
      }
    };
    if (sources_->patch.is_object()) walk(sources_->patch, std::string(stage_root));
  }

  /// The values that the study's parameters take, each with the rest of the input.
  void check_varied() {
    std::vector<VariedParameter> varied = varied_parameters(input_.study);
    const bool has_range = !lacks_range(varied);
    for (const auto& finding : context_.findings) found_.insert(finding.pointer);
    std::erase_if(varied, [&](const VariedParameter& parameter) {
      const auto& [axis, place] = parameter;
      const bool is_pointer = axis.name.rfind('/', 0) == 0;
      return !is_pointer || is_bad(place) || is_bad(place + "/parameter") ||
             (stage_missing_ && pointer_within(axis.name, stage_root));
    });
    bool have_values = has_range;
    for (const auto& [axis, place] : varied) {
      const bool values = has_range && !is_bad(place + "/from") && !is_bad(place + "/to") && !is_bad(place + "/points");
      check_ends(axis, place, values);
      have_values = have_values && values;
    }
    if (ends_are_sound_ && have_values && varied.size() == 1)
      check_values(varied[0].axis, varied[0].place, as_given(), {}, "");
    if (problems_.empty() && varied.size() == 2) check_edges(varied);
    if (const auto* claims = std::get_if<studies::ClaimsOptions>(&input_.study.plan); claims && problems_.empty())
      check_claimed_values(*claims);
  }

  /// Numbers that sweeps and parameters of claims write at pointers, each alone with the rest of the input.
  void check_claimed_values(const studies::ClaimsOptions& claims) {
    const auto check = [&](const std::string& pointer, double value, const std::string& place) {
      if (pointer.empty() || pointer.front() != '/') return;
      Study unused;
      for (const auto& problem : input_.check_with(as_given(), std::array{PointerValue{pointer, value}}, unused))
        refuse(place, "takes the value " + number_text(value) + " at " + pointer + ", with which " + problem.pointer +
                          " " + problem.message);
    };
    for (std::size_t k = 0; k < claims.sweeps.size(); ++k) {
      const studies::ClaimSweep& sweep = claims.sweeps[k];
      const std::string place = "/study/sweeps/" + std::to_string(k);
      check(sweep.axis.name, sweep.axis.from, place + "/from");
      check(sweep.axis.name, sweep.axis.to, place + "/to");
      for (std::size_t j = 0; j < sweep.at.size(); ++j) {
        const studies::SetValue& set = sweep.at[j];
        const std::string at = place + "/at/" + std::to_string(j);
        // It is taken of the input as it is given, once for the whole sweep.
        const auto is_of = [&set](const std::string& parameter) {
          const studies::NamedParameter* named = studies::find_parameter(parameter);
          const std::vector<std::string> pointers = named != nullptr ? named->pointers : std::vector{parameter};
          return !set.as.empty() && std::ranges::any_of(pointers, [&set](const std::string& pointer) {
            return pointer_within(set.as, pointer) || pointer_within(pointer, set.as);
          });
        };
        if (is_of(sweep.axis.name))
          refuse(at + "/as", "is \"" + set.as + "\", which the sweep varies: it is not followed along it");
        for (std::size_t other = 0; other < sweep.at.size(); ++other)
          if (other != j && is_of(sweep.at[other].parameter))
            refuse(at + "/as", "is \"" + set.as + "\", which /at/" + std::to_string(other) +
                                   " sets: it would be as it is in the input; set it to that value, too");
        // Of a candidate it would be another number than that of the stage as it is given.
        if (!set.as.empty() && find_at(input_.computed, set.as) != nullptr)
          refuse(at + "/as", "is \"" + set.as + "\", which is computed from other numbers: it cannot be followed");
        else if (const auto value = number_to_set(input_, {}, set))
          check(set.parameter, *value, at + (set.value ? "/value" : "/as"));
        else
          refuse(at + "/as", "is \"" + set.as + "\", which is no number of the resolved input");
      }
    }
    for (std::size_t k = 0; k < claims.space.parameters.size(); ++k) {
      const studies::FreeParameter& p = claims.space.parameters[k];
      if (!p.choice.empty()) continue;  // with that option in place: looked at when candidates are made
      for (std::size_t t = 0; t < p.targets.size(); ++t) {
        const studies::ParameterTarget& target = p.targets[t];
        const std::string place = "/study/parameters/" + std::to_string(k) + "/targets/" + std::to_string(t);
        if (!target.times.empty()) continue;
        for (const double x : {p.from, p.to})
          check(target.pointer, target.factor * std::pow(x, target.power), place + "/pointer");
      }
    }
  }

  /// Whether the one parameter of a sweep has the default range, which is one of speeds, and is none.
  bool lacks_range(const std::vector<VariedParameter>& varied) {
    const bool one = varied.size() == 1 || (!varied.empty() && varied.front().place == "/study");
    if (!one || varied.front().axis.name == studies::speed_parameter) return false;
    bool lacks = false;
    const json origins = input_.resolved["study"].value("origin", json::object());
    for (const char* key : {"from", "to"})
      if (origins.is_object() && origins.value(key, std::string()) == "default") {
        refuse(std::string("/study/") + key, "is missing; " +
                                                 std::string(input_.study.has_points() ? "a sweep" : "a branch") +
                                                 " of " + varied.front().axis.name + " needs a range of its own");
        lacks = true;
      }
    return lacks;
  }

  void refuse_end(const std::string& pointer, std::string message) {
    refuse(pointer, std::move(message));
    ends_are_sound_ = false;
  }

  [[nodiscard]] Base as_given() const {
    return {input_.resolved, sound_ && context_.findings.empty() ? &input_.study : nullptr};
  }

  /// What a value of a parameter does wrong, where the rest of the input does nothing wrong itself: anywhere, if all of
  /// the rest was read, else at the parameter's own place.
  std::vector<Problem> check_with(const Base& base, const studies::Axis& axis, const std::vector<PointerValue>& values,
                                  Study& changed, json* completed = nullptr) const {
    std::vector<Problem> wrong = input_.check_with(base, values, changed, completed);
    std::erase_if(wrong, [&](const Problem& problem) {
      return found_.count(problem.pointer) > 0 || (!sound_ && problem.pointer != axis.name);
    });
    return wrong;
  }

  /// At each of its values, so that nothing is begun that cannot be finished; the first bad one tells.
  void check_values(const studies::Axis& axis, const std::string& place, const Base& base,
                    const std::vector<PointerValue>& beside, const std::string& words) {
    const auto at = [&](std::size_t k) {
      std::vector<PointerValue> values = beside;
      values.push_back({axis.name, studies::axis_value(axis, k)});
      Study unused;
      return check_with(base, axis, values, unused);
    };
    const auto bad = first_unsound(static_cast<std::size_t>(axis.points), at);
    for (const auto& problem : bad.problems)
      refuse_end(place + "/parameter", "takes the value " + number_text(studies::axis_value(axis, bad.value)) +
                                           ", with which" + words + " " + problem.pointer + " " + problem.message);
  }

  /// A parameter that is a pointer: its place, and the ends of its range, if there is one.
  void check_ends(const studies::Axis& axis, const std::string& place, bool has_values) {
    const json* there = find_at(input_.resolved, axis.name);
    if (std::string why = why_no_parameter(axis.name); !why.empty()) {
      refuse_end(place + "/parameter", std::move(why));
    } else if (there == nullptr || !there->is_number() || pointer_within(axis.name, "/study")) {
      // Whether there is a value that was not read, or not computed, cannot be told.
      const auto at_place = [&](const KeyPlace& p) { return p.pointer == axis.name; };
      if (there == nullptr && !sound_ && std::any_of(context_.places.begin(), context_.places.end(), at_place)) return;
      Study unused;
      for (auto& problem : input_.check_with(as_given(), std::array{PointerValue{axis.name, axis.from}}, unused))
        refuse_end(place + "/parameter", std::move(problem.message));
    } else if (has_values) {
      Study unused;
      for (const auto& [key, value] : {std::pair("/from", axis.from), std::pair("/to", axis.to)})
        for (const auto& problem : check_with(as_given(), axis, {PointerValue{axis.name, value}}, unused))
          refuse_end(place + key,
                     "is " + number_text(value) + ", with which " + problem.pointer + " " + problem.message);
    }
  }

  /// Two values together, on the edges of the plane: within them a rule that both have to keep is kept.
  void check_edges(const std::vector<VariedParameter>& varied) {
    for (const std::size_t k : {0U, 1U}) {
      const auto& [along, place] = varied[k];
      const studies::Axis& other = varied[1 - k].axis;
      for (const double end : {other.from, other.to}) {
        if (!ends_are_sound_) break;
        const PointerValue fixed{other.name, end};
        const std::string words = ", and " + other.name + " = " + number_text(end) + ",";
        // What is computed from catalogue data is computed once, where only the value that stays is one of those.
        json completed;
        Study with_fixed;
        if (!feeds_completion(along.name, sources_->bare) && feeds_completion(other.name, sources_->bare) &&
            check_with(as_given(), other, {fixed}, with_fixed, &completed).empty())
          check_values(along, place, {completed, as_given().study == nullptr ? nullptr : &with_fixed}, {}, words);
        else
          check_values(along, place, as_given(), {fixed}, words);
      }
    }
  }

  std::shared_ptr<Sources> sources_ = std::make_shared<Sources>();
  Problems problems_;
  json whole_;                  ///< all texts in one
  bool stage_missing_ = false;  ///< the stage that the study names could not be read
  LoadedInput input_;
  ReadContext context_;
  bool sound_ = false;                        ///< all values were read
  std::set<std::string, std::less<>> found_;  ///< pointers that something was found at
  bool ends_are_sound_ = true;                ///< no value of a parameter was refused
};

LoadedInput load_input(const std::filesystem::path& path, std::span<const Assignment> sets) {
  return LoadedInput::Loader(path, std::make_shared<JsonFiles>()).load(sets);
}

LoadedInput LoadedInput::with_further(std::span<const Assignment> sets) const {
  std::vector<Assignment> all = sources_->sets;
  all.insert(all.end(), sets.begin(), sets.end());
  return Loader(sources_->path, sources_->files).load(all);
}

const json* LoadedInput::value_at(std::string_view pointer) const {
  return pointer.starts_with('/') ? find_at(resolved, pointer) : nullptr;
}

std::vector<std::string> LoadedInput::number_pointers() const {
  std::vector<std::string> pointers;
  for (const auto& [key, value] : resolved.items())
    if (key != "study" && !is_bookkeeping(key)) collect_numbers(value, pointer_step(key), pointers);
  return pointers;
}

std::vector<Problem> LoadedInput::check_with(const Base& base, std::span<const PointerValue> values, Study& changed,
                                             json* completed) const {
  bool is_completed = true;
  std::vector<PointerValue> places;
  for (const auto& [pointer, value] : values) {
    std::string place = pointer;
    if (sources_->bare && pointer_within(place, stage_root)) place.erase(0, stage_root.size());
    const auto refuse = [this, &pointer = pointer](std::string message) {
      return std::vector<Problem>{sources_->locate(pointer, std::move(message))};
    };
    const json* there = place.empty() || place[0] != '/' ? nullptr : find_at(resolved, place);
    if (pointer_within(place, "/study"))
      return refuse("\"" + place + "\" is part of the plan, which a study cannot vary");
    if (there == nullptr) {
      const auto& all = all_places();
      const auto at_place = [&pointer = pointer](const KeyPlace& p) { return p.pointer == pointer; };
      if (std::any_of(all.begin(), all.end(), at_place))
        return refuse("\"" + pointer + "\" is no value of the resolved input: the input does not give it" +
                      (find_speed_alias(pointer_leaf(pointer)) != nullptr
                           ? "; did you mean '" + pointer_leaf(pointer) + "'?"
                           : std::string()));
      const auto meant = meant_pointers(place, all);
      return refuse("\"" + pointer + "\" is no value of the resolved input" +
                    (meant.empty() ? suggestion(place, number_pointers()) : suggested(meant)));
    }
    if (!there->is_number())
      return refuse("\"" + place + "\" is " + described(*there) + ", must be a number" +
                    (there->is_array() && !there->empty() ? "; did you mean '" + pointer + "/0'?" : ""));
    if (!std::isfinite(value)) return refuse("is " + number_text(value) + ", must be a finite number");
    is_completed = is_completed && !feeds_completion(place, sources_->bare);
    places.push_back({std::move(place), value});
  }
  ReadContext context;
  std::optional<Study> read;
  if (is_completed && base.study != nullptr && completed == nullptr)
    read = change_study(*base.study, sources_->bare, places, context);
  if (!read) {
    context = {};
    json whole = base.resolved;
    for (const auto& [place, value] : places) {
      *find_at(whole, place) = value;
      keep_from_computing(whole, place);
    }
    json unused;
    read = read_study(whole, sources_->bare, context, is_completed ? nullptr : &unused).first;
    if (completed != nullptr) *completed = std::move(whole);
  }
  changed = std::move(*read);
  std::vector<Problem> problems;
  for (auto& finding : context.findings)
    problems.push_back(sources_->locate(finding.pointer, std::move(finding.message)));
  return problems;
}

Study LoadedInput::with_value(std::string_view pointer, double value) const {
  return with_values(std::array{PointerValue{std::string(pointer), value}});
}

json LoadedInput::resolved_with(std::span<const PointerValue> values) const {
  Study unused;
  json completed;
  if (auto problems = check_with({resolved, &study}, values, unused, &completed); !problems.empty())
    throw InputProblems(std::move(problems));
  return completed;
}

Study LoadedInput::with_values(std::span<const PointerValue> values) const {
  Study changed;
  if (auto problems = check_with({resolved, &study}, values, changed); !problems.empty())
    throw InputProblems(std::move(problems));
  return changed;
}

}  // namespace epicyclic::input
