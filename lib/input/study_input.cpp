#include "input/study_input.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <functional>
#include <mutex>
#include <optional>
#include <set>
#include <thread>
#include <tuple>
#include <utility>

#include "core/errors.hpp"
#include "input/aliases.hpp"
#include "input/csv_columns.hpp"
#include "input/curve_files.hpp"
#include "input/given_speeds.hpp"
#include "input/input_sources.hpp"
#include "input/origins.hpp"
#include "input/plan_checks.hpp"
#include "input/pointers.hpp"
#include "input/read_study.hpp"
#include "input/study_kind.hpp"
#include "integrate/methods.hpp"
#include "studies/named_parameters.hpp"
#include "studies/parallel_for.hpp"

namespace epicyclic::input {

using nlohmann::json;

std::vector<VariedParameter> varied_parameters(const Study& study) {
  Plan plan = study.plan;
  std::vector<VariedParameter> varied;
  for (const PlanAxis& axis : axes_of(plan))
    varied.push_back({{*axis.name, *axis.from, *axis.to, axis.points}, axis.place});
  return varied;
}

namespace {

/// The first value with an error, and the error; nothing if all are valid.
struct Unsound {
  std::size_t value = 0;
  std::vector<Problem> problems;
};

/// @param problems_at  errors at a value; called by several threads at once
template <class F>
Unsound first_unsound(std::size_t values, F problems_at) {
  Unsound first{values, {}};
  std::mutex mutex;
  std::atomic<std::size_t> least{values};
  constexpr std::size_t few = 16;  // not worth a thread
  const int threads = values < few ? 1 : static_cast<int>(std::thread::hardware_concurrency());
  (void)studies::parallel_for(values, threads, nullptr, [&](std::size_t k) {
    if (k > least) return;
    std::vector<Problem> problems = problems_at(k);
    const std::scoped_lock lock(mutex);
    if (problems.empty() || k > first.value) return;
    first = {k, std::move(problems)};
    least = k;
  });
  return first;
}

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
    read_torque_file();
    for (auto& set : sources_->sets)
      if (sources_->bare && pointer_within(set.pointer, stage_root)) set.pointer.erase(0, stage_root.size());
    read_curves();
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

  /// By this key an editor finds the schema. Nothing depends on it. What is no string is left for the reader to refuse.
  static void remove_schema_key(json& object) {
    if (!object.is_object()) return;
    if (const auto found = object.find(schema_key); found != object.end() && found->is_string()) object.erase(found);
  }

  void read_study_file(std::span<const Assignment> sets) {
    JsonSource& file = sources_->study;
    file = sources_->files->read(sources_->path);
    problems_.add(file);
    for (const Assignment& set : sets) {
      if (set.problems.empty()) sources_->sets.push_back(set);
      for (const std::string& message : set.problems) problems_.add({set.shown(), 0, "", message});
    }
    sources_->bare = file.value.is_object() && !file.value.contains("stage") &&
                     (file.value.contains("lumped") || file.value.contains("catalogue"));
    rename_sets();
    if (file.complete && !file.value.is_object())
      problems_.add({file.name, file.line_of(""), "", "is " + described(file.value) + ", must be an object"});
    if (!file.complete || !file.value.is_object()) raise();
    rename(file, std::string(sources_->bare ? stage_root : ""), "");
    note_origins(file.value, file, "");
    whole_ = file.value;
    remove_schema_key(whole_);
    if (const auto stage = whole_.find("stage"); stage != whole_.end()) remove_schema_key(*stage);
  }

  /// Kind of the study from the assignments or the file; empty if neither gives it.
  [[nodiscard]] std::string study_kind() const {
    std::string kind = study_of(sources_->study.value);
    for (const Assignment& set : sources_->sets) {
      json alone;
      if (pointer_within(set.pointer, "/study") && assign(alone, set.pointer, set.value).empty())
        if (std::string given = study_of(alone); !given.empty()) kind = std::move(given);
    }
    return kind;
  }

  /// Old names of a text.
  /// @param place        of the text in the whole input
  /// @param shown_below  text before its pointers in messages
  void rename(JsonSource& source, const std::string& place, std::string_view shown_below) {
    Renaming renaming;
    use_new_names(source.value, place, study_kind(), renaming);
    for (const auto& [from, to] : renaming.moved) source.move(from, to);
    for (const auto& [pointer, message] : renaming.clashes)
      problems_.add({source.name, source.line_of(pointer), std::string(shown_below) + pointer, message});
    for (const std::string& warning : renaming.warnings) note_once(warning);
  }

  /// Old names of assignments.
  void rename_sets() {
    const std::string kind = study_kind();
    std::vector<const Assignment*> old;
    for (Assignment& set : sources_->sets) {
      Renaming renaming;
      // Of a stage alone pointers may begin at the stage.
      const bool at_stage = sources_->bare && !pointer_within(set.pointer, stage_root);
      const std::string root(at_stage ? stage_root : "");
      const std::string pointer = new_pointer(root + set.pointer, kind, renaming).substr(root.size());
      use_new_names(set.value, root + pointer, kind, renaming, pointer);
      for (const auto& [at, message] : renaming.clashes) problems_.add({set.shown(), 0, at, message});
      if (pointer != set.pointer) old.push_back(&set);
      set.pointer = pointer;
      set.notes.insert(set.notes.end(), renaming.warnings.begin(), renaming.warnings.end());
      for (const std::string& note : set.notes) note_once(note);
    }
    for (const Assignment* by_old_name : old)
      for (const Assignment& set : sources_->sets)
        if (set.pointer == by_old_name->pointer && std::ranges::find(old, &set) == old.end())
          problems_.add(
              {by_old_name->shown(), 0, set.pointer,
               "is given by its old name and, in " + set.shown() + ", by its new one; give the new one alone"});
  }

  void note_once(const std::string& note) {
    if (std::ranges::find(context_.notes, note) == context_.notes.end()) context_.notes.push_back(note);
  }

  [[nodiscard]] bool is_early(const Assignment& set) const {
    return !sources_->bare &&
           (pointer_within(set.pointer, patch_root) || (set.pointer == stage_root && set.value.is_string()));
  }

  void make(const Assignment& set) {
    std::string pointer = set.pointer;
    if (sources_->bare && pointer_within(pointer, stage_root)) pointer.erase(0, stage_root.size());
    if (pointer_parent(pointer) == operation_root && !set.value.is_null())
      drop_other_speeds(whole_, pointer_leaf(pointer));
    if (auto message = assign(whole_, pointer, set.value); !message.empty())
      problems_.add({set.shown(), 0, set.pointer, std::move(message)});
  }

  /// The speeds in rpm and Hz as Omega.
  /// @returns the study as it is given
  Study convert_speeds() {
    name_speeds(input_.study);
    Study given = input_.study;
    input_.given_speed = given.given_speed;
    input::convert_speeds(
        input_.study, whole_, sound_ && gear::problems_for_dynamics(given.stage).empty(),
        [this](const std::string& pointer) { return is_bad(pointer); },
        [this](Finding::Kind kind, const std::string& pointer, std::string message) {
          if (!message.empty()) context_.add(kind, pointer, std::move(message));
          found_.insert(pointer);
        });
    return given;
  }

  /// Puts the stage that the study names in the place of its name.
  void read_stage_file() {
    const auto named = whole_["stage"].get<std::string>();
    const std::filesystem::path stage_path = sources_->path.parent_path() / named;
    JsonSource stage = sources_->files->read(stage_path);
    whole_.erase("stage");
    if (whole_.contains("origin") && whole_["origin"].is_object()) whole_["origin"].erase("stage");
    if (stage.bytes.empty() && !stage.problems.empty()) {  // not readable at all: name the file that refers to it
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
      rename(stage, std::string(stage_root), stage_root);
      note_origins(stage.value, stage, std::string(stage_root));
      whole_["stage"] = stage.value;
      remove_schema_key(whole_["stage"]);
    }
    input_.stage_file = RawFile{stage_path.filename().string(), stage.bytes};
    sources_->stage = std::move(stage);
  }

  /// Puts the rows of the CSV file that a ramp names in its place.
  void read_torque_file() {
    const std::string place = "/study/torque_file";
    const auto plan = whole_.find("study");
    if (plan == whole_.end() || !plan->is_object() || study_of(whole_) != "ramp") return;
    const auto named = plan->find("torque_file");
    if (named == plan->end() || !named->is_string()) return;
    if (plan->contains("torque_time_s") || plan->contains("torque_Nm"))
      return refuse(place, "gives torque_time_s and torque_Nm; take these out");
    const auto name = named->get<std::string>();
    try {
      const auto rows =
          csv_columns(sources_->files->read_text(sources_->path.parent_path() / name, "CSV"), {"time_s", "torque_Nm"});
      (*plan)["torque_time_s"] = rows[0];
      (*plan)["torque_Nm"] = rows[1];
      for (const char* key : {"torque_time_s", "torque_Nm"}) (*plan)["origin"][key] = "table: " + name;
    } catch (const InputError& error) {
      return refuse(place, "the file " + name + ": " + error.what());
    }
    plan->erase("torque_file");
    (*plan)["origin"].erase("torque_file");
  }

  /// Puts the rows of the CSV files that curves name in the places of the names.
  void read_curves() {
    json* stage = sources_->bare ? &whole_ : find_at(whole_, stage_root);
    if (stage == nullptr) return;
    read_curve_files(
        *stage, std::string(sources_->bare ? "" : stage_root),
        [this](const std::string& pointer, const std::string& name) -> const TextFile& {
          const bool of_stage = sources_->stage && sources_->locate(pointer, "").file == sources_->stage->name;
          const std::filesystem::path beside = of_stage ? sources_->stage->name : sources_->path.string();
          return sources_->files->read_text(beside.parent_path() / name, "CSV");
        },
        [this](const std::string& pointer, std::string message) {
          refuse(pointer, std::move(message));
          found_.insert(pointer);
        });
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
    Study given = convert_speeds();
    check_integrator();
    const auto bad = [this](const std::string& pointer) { return is_bad(pointer); };
    check_plan(input_.study, bad, context_);
    if (const StudyKind* kind = input_.study.plan.kind(); kind != nullptr && kind->complete != nullptr) {
      kind->complete(input_.study.plan.options());
      kind->complete(given.plan.options());
    }
    input_.resolved = sources_->bare ? stage_table().write(given.stage) : study_table().write(given);
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

  /// Values that were removed and exist again, since they follow from the remaining ones.
  void note_undone() {
    const auto note = [&](const std::string& pointer, const std::string& who) {
      if (find_at(input_.computed, pointer) != nullptr && find_at(input_.resolved, pointer) != nullptr)
        context_.notes.push_back(pointer + ": " + who +
                                 " takes it out, and it is computed from the catalogue data again; give a value in its "
                                 "place, or take out the data that it follows from");
    };
    for (const Assignment& set : sources_->sets)
      if (set.value.is_null()) note(set.pointer, set.shown());
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
    const StudyKind* kind = input_.study.plan.kind();
    if (kind != nullptr && kind->check_values != nullptr && problems_.empty())
      kind->check_values(
          input_, [this](const std::string& pointer, std::string message) { refuse(pointer, std::move(message)); });
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

  /// Errors due to a value of a parameter, if the rest of the input has no errors. They may be anywhere if all of the
  /// rest was read, else at the parameter's own place.
  std::vector<Problem> check_with(const Base& base, const studies::Axis& axis, const std::vector<PointerValue>& values,
                                  Study& changed, json* completed = nullptr) const {
    std::vector<Problem> wrong = input_.check_with(base, values, changed, completed);
    std::erase_if(wrong, [&](const Problem& problem) {
      return found_.count(problem.pointer) > 0 || (!sound_ && problem.pointer != axis.name);
    });
    return wrong;
  }

  /// At each of its values, so that no study starts that cannot finish. The first bad value is reported.
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
      // It is unknown whether a value that was not read, or not computed, exists.
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
        // Values from catalogue data are computed only once if the fixed value alone affects them.
        json completed;
        Study with_fixed;
        const auto feeds = [this](const std::string& pointer) {
          return feeds_completion(pointer, sources_->bare, input_.study.stage);
        };
        if (!feeds(along.name) && feeds(other.name) &&
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

LoadedInput load_input_text(std::string text, const std::filesystem::path& path, std::span<const Assignment> sets) {
  const auto files = std::make_shared<JsonFiles>();
  files->add(path, std::move(text));
  return LoadedInput::Loader(path, files).load(sets);
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
    // In place of the speed that is given.
    static const json omega = 1.0;
    if (there == nullptr && place == speed_pointer && given_speed.any()) there = &omega;
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
    is_completed = is_completed && !feeds_completion(place, sources_->bare, study.stage);
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
      if (place == speed_pointer) drop_other_speeds(whole, studies::speed_parameter);
      whole[json::json_pointer(place)] = value;
      keep_from_computing(whole, place);
    }
    json unused;
    read = read_study(whole, sources_->bare, context, is_completed ? nullptr : &unused).first;
    read->plan = study.plan;
    read->axis_speed = study.axis_speed;
    if (completed != nullptr) *completed = std::move(whole);
  }
  for (const SpeedAlias& alias : speed_aliases())
    if (const auto value = std::exchange(read->given_speed.*alias.given, std::nullopt))
      read->mesh_frequency_ratio = *value * ratio_per_unit(alias, study.stage).value_or(1.0);
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
