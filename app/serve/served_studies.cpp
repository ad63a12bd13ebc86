#include "served_studies.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <system_error>

#include <fmt/format.h>
#include <sys/stat.h>

#include "command/failure.hpp"
#include "command/session.hpp"
#include "command/shell_word.hpp"
#include "command/stop.hpp"
#include "core/atomic_file.hpp"
#include "core/errors.hpp"
#include "core/version.hpp"
#include "input/json_source.hpp"
#include "input/keys.hpp"
#include "input/study_input.hpp"
#include "input/study_kind.hpp"
#include "input/study_model.hpp"
#include "report/report_data.hpp"
#include "report/study_report.hpp"
#include "store/point_store.hpp"
#include "studies/known_attractors.hpp"
#include "studies/named_parameters.hpp"
#include "studies/short_history.hpp"

namespace epicyclic::app {

namespace {

using nlohmann::json;
namespace fs = std::filesystem;

constexpr std::size_t numbers_max = 4;  ///< that a request may change
constexpr std::size_t long_array = 8;   ///< arrays with more elements are tables and not offered
constexpr int values_max = 20000;       ///< of a region
constexpr int history_periods_max = 256;
constexpr int history_phases = 32;

/// A first diagram for changed numbers, in about a second: few values, short records, every point from the default
/// start, so that all threads and lanes have work.
const std::vector<std::string>& coarse_sets() {
  static const std::vector<std::string> sets = {"/study/points=41",
                                                "/study/directions=[\"up\"]",
                                                "/study/start=cold",
                                                "/study/transient=fixed",
                                                "/study/transient_periods=60",
                                                "/study/recorded_periods=24",
                                                "/study/classification_periods=0",
                                                "/integrator/method=lanes-cash-karp",
                                                "/integrator/relative_tolerance=1e-6",
                                                "/integrator/absolute_tolerance=1e-8"};
  return sets;
}

std::string text_of(const json& value) { return value.dump(-1, ' ', false, json::error_handler_t::replace); }

std::string set_text(const std::string& pointer, double value) { return pointer + "=" + text_of(json(value)); }

/// A member of a request that is a finite number.
double number_in(const json& request, const char* name) {
  const auto found = request.find(name);
  if (found == request.end() || !found->is_number() || !std::isfinite(found->get<double>()))
    throw InputError(fmt::format("{}: is not a number", name));
  return found->get<double>();
}

int integer_in(const json& request, const char* name, int least, int most) {
  const double value = number_in(request, name);
  if (value != std::floor(value) || value < least || value > most)
    throw InputError(fmt::format("{}: is not a whole number from {} to {}", name, least, most));
  return static_cast<int>(value);
}

void require_only(const json& request, const std::set<std::string>& names) {
  for (const auto& [name, value] : request.items())
    if (!names.contains(name)) throw InputError("an unknown member of the request");
}

/// Times and sizes of the files that grow with a study.
std::string revision_of(const fs::path& folder) {
  std::vector<std::string> names = {"run.json"};
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error))
    if (const std::string name = entry->path().filename().string(); name.starts_with("journal.")) names.push_back(name);
  std::ranges::sort(names);
  std::string text;
  for (const std::string& name : names) {
    struct stat facts {};
    if (::stat((folder / name).c_str(), &facts) == 0)
      text += fmt::format("{}.{}.{}-", facts.st_size, facts.st_mtim.tv_sec, facts.st_mtim.tv_nsec);
  }
  return text;
}

bool is_table(const json& resolved, const std::string& pointer) {
  const json::json_pointer at(pointer);
  if (at.empty()) return false;
  const json& parent = resolved.at(at.parent_pointer());
  return parent.is_array() && parent.size() > long_array;
}

/// Of a named parameter, a key, or the amplitudes of an error, by the pointers that they stand for.
class NumberList {
 public:
  explicit NumberList(const input::LoadedInput& input) : input_(input) {
    for (const input::KeyLine& key : input::key_lines()) keys_.emplace(key.pointer, key);
  }

  std::vector<AdjustableNumber> list() {
    const std::vector<std::string> pointers = input_.number_pointers();
    const std::set<std::string> known(pointers.begin(), pointers.end());
    std::map<std::string, std::vector<std::string>> arrays;
    for (const studies::NamedParameter& named : studies::named_parameters())
      if (named.pointers.size() > 1 &&
          std::ranges::all_of(named.pointers, [&](const auto& p) { return known.contains(p); }))
        add({named.name, named.description, "", named.pointers, {}, false, true});
    for (const std::string& pointer : pointers) {
      if (!pointer.starts_with("/stage/") || pointer.starts_with("/stage/catalogue/") ||
          is_table(input_.resolved, pointer) || !input_.value_at(pointer)->is_number_float())
        continue;
      const std::string general = generalised(pointer);
      if (general.ends_with("error_amplitude_um/N")) {
        arrays[pointer.substr(0, pointer.rfind('/'))].push_back(pointer);
        continue;
      }
      const auto key = keys_.find(general);
      add({pointer,
           key == keys_.end() ? "" : key->second.meaning,
           key == keys_.end() ? "" : key->second.unit,
           {pointer},
           {},
           false,
           is_usual(pointer)});
    }
    for (const auto& [pointer, elements] : arrays)
      add({pointer, "factor of the amplitudes of the transmission error", "", elements, {}, true, is_usual(pointer)});
    // What the page begins with comes first.
    std::ranges::stable_sort(list_, {}, [](const AdjustableNumber& n) { return !n.is_suggested; });
    return std::move(list_);
  }

 private:
  /// Torque or power, backlash and error of the mesh of the sun.
  static bool is_usual(const std::string& pointer) {
    return pointer.starts_with("/stage/load/") || pointer.ends_with("sun_planet_mesh/backlash_half_um") ||
           pointer.ends_with("sun_planet_mesh/error_amplitude_um");
  }

  static std::string generalised(const std::string& pointer) {
    std::string text;
    for (const std::string& step : input::pointer_steps(pointer))
      text += !step.empty() && step.find_first_not_of("0123456789") == std::string::npos ? std::string("/N")
                                                                                         : input::pointer_step(step);
    return text;
  }

  void add(AdjustableNumber number) {
    for (const std::string& pointer : number.pointers) number.values.push_back(input_.value_at(pointer)->get<double>());
    list_.push_back(std::move(number));
  }

  const input::LoadedInput& input_;
  std::map<std::string, input::KeyLine> keys_;
  std::vector<AdjustableNumber> list_;
};

/// Where an answer is not 200.
struct Refused {
  int status;
  std::string message;
};

}  // namespace

struct ServedStudies::Served {
  std::size_t id = 0;
  fs::path folder;
  const Served* root = nullptr;               ///< whose input it is derived from; null of a FOLDER of the command line
  std::string place{};                        ///< "refined" or "changed" of a derived one
  std::optional<input::LoadedInput> input{};  ///< of a study whose points a journal keeps
  bool is_sweep = false;
  bool has_branches = false;                ///< a study of kind `continue`
  std::vector<AdjustableNumber> numbers{};  ///< of a root that is a sweep
  std::vector<Change> changes{};            ///< from the root's
  json how{};                               ///< region, number of values, changed numbers

  std::mutex mutex{};
  std::string revision{};
  std::string encoded{};                        ///< of that revision
  std::unique_ptr<store::PointStore> points{};  ///< as read for histories
  std::string revision_of_points{};

  [[nodiscard]] const Served& top() const { return root == nullptr ? *this : *root; }

  void describe() {
    const json& study = input->resolved.at("study");
    how = {{"place", place},
           {"from", study.at("from")},
           {"to", study.at("to")},
           {"values", study.at("points")},
           {"recorded_periods", study.at("recorded_periods")},
           {"changes", json::array()}};
    std::set<std::string> known;  // by a name that stands for several
    for (std::size_t k = 0; k < top().numbers.size(); ++k) {
      const AdjustableNumber& number = top().numbers[k];
      if (known.contains(number.pointers.front())) continue;
      known.insert(number.pointers.begin(), number.pointers.end());
      const json* now = input->value_at(number.pointers.front());
      if (now == nullptr || !now->is_number() || now->get<double>() == number.values.front()) continue;
      const double value = now->get<double>();
      const double shown = number.is_factor ? value / number.values.front() : value;
      changes.emplace_back(k, shown);
      how["changes"].push_back({{"number", k}, {"name", number.name}, {"unit", number.unit}, {"value", shown}});
    }
  }
};

ServedStudies::ServedStudies(const Arguments& arguments)
    : arguments_(arguments), computation_(std::make_unique<ServedComputation>()) {
  for (const fs::path& folder : arguments.report_folders) {
    std::error_code error;
    if (!fs::is_directory(folder, error)) throw InputError(folder.string() + ": is not a folder");
    for (const char* file : {"run.json", "input.resolved.json"})
      if (!fs::exists(folder / file, error))
        throw InputError(fmt::format("{}: contains no study of this program (no {})", folder.string(), file));
    add(folder, nullptr);
  }
  const std::size_t given = all_.size();
  for (std::size_t k = 0; k < given; ++k) find_derived(*all_[k]);
}

ServedStudies::~ServedStudies() = default;

bool ServedStudies::end() { return computation_->end(); }

void ServedStudies::add(fs::path folder, const Served* root) {
  auto study = std::make_unique<Served>();
  study->folder = std::move(folder);
  study->root = root;
  input::LoadedInput input = input::load_input(study->folder / "input.resolved.json");
  study->has_branches = input.study.has_dynamics() && input.study.kind() == "continue";
  study->is_sweep = input.study.has_dynamics() && input.study.kind() == "sweep";
  if (root != nullptr && !study->is_sweep) throw InputError(study->folder.string() + ": is not derived from a sweep");
  const input::StudyKind* kind = input.study.plan.kind();
  if (kind != nullptr && kind->points_kept == input::PointsKept::journal) study->input = std::move(input);
  if (study->is_sweep) {
    if (root == nullptr) study->numbers = NumberList(*study->input).list();
    if (root != nullptr) study->place = study->folder.parent_path().filename().string();
    if (root != nullptr) study->describe();
  }
  const std::scoped_lock lock(mutex_);
  study->id = all_.size();
  all_.push_back(std::move(study));
}

void ServedStudies::find_derived(const Served& root) {
  if (!root.is_sweep) return;
  for (const char* place : {"refined", "changed"}) {
    std::vector<fs::path> folders;
    std::error_code error;
    for (fs::directory_iterator entry(root.folder / place, error), end; !error && entry != end;
         entry.increment(error)) {
      const std::string name = entry->path().filename().string();
      if (name.size() >= 3 && name.find_first_not_of("0123456789") == std::string::npos &&
          fs::exists(entry->path() / "run.json", error) && fs::exists(entry->path() / "input.resolved.json", error))
        folders.push_back(entry->path());
    }
    std::ranges::sort(folders);
    for (const fs::path& folder : folders) try {
        add(folder, &root);
      } catch (const InputError&) {
        // Not what this program has written: it is not shown.
      }
  }
}

std::vector<std::string> ServedStudies::actions() { return {"state", "data", "history", "refine", "change", "cancel"}; }

std::string ServedStudies::title() const {
  std::string title;
  for (const auto& study : all_) {
    if (study->root != nullptr) continue;
    const input::LoadedInput input = input::load_input(study->folder / "input.resolved.json");
    const std::string& name = input.study.name.empty() ? input.study.stage.name : input.study.name;
    title += (title.empty() ? "" : ", ") + name;
  }
  return title.empty() ? "Studies" : title;
}

std::pair<int, std::string> ServedStudies::answer(std::string_view action, std::string body) {
  const auto failed = [](int status, const std::string& why) { return std::pair(status, text_of({{"error", why}})); };
  try {
    const input::JsonSource source = input::parse_json(std::move(body), "request");
    if (!source.complete || !source.problems.empty() || !source.value.is_object())
      return failed(400, "the request is not an object of valid JSON");
    const json& request = source.value;
    if (action == "state") return (require_only(request, {}), std::pair(200, text_of(state())));
    if (action == "cancel") {
      require_only(request, {});
      computation_->cancel();
      return {200, "{}"};
    }
    Served& study = served(request);
    if (action == "data") return (require_only(request, {"study"}), std::pair(200, data(study)));
    if (action == "history") return {200, text_of(history(study, request))};
    if (action == "refine") return {202, text_of(refine(study, request))};
    if (action == "change") return {202, text_of(change(study, request))};
    return failed(404, "no such action");
  } catch (const Refused& refused) {
    return failed(refused.status, refused.message);
  } catch (const Stopped&) {
    return failed(503, "the server ends");
  } catch (const InputError& e) {
    return failed(422, e.what());
  } catch (...) {
    return failed(500, failure_of(std::current_exception()).what());
  }
}

ServedStudies::Served& ServedStudies::served(const json& request) const {
  const std::scoped_lock lock(mutex_);
  return *all_[static_cast<std::size_t>(integer_in(request, "study", 0, static_cast<int>(all_.size()) - 1))];
}

json ServedStudies::state() const {
  json studies = json::array();
  std::vector<const Served*> all;
  {
    const std::scoped_lock lock(mutex_);
    for (const auto& study : all_) all.push_back(study.get());
  }
  for (const Served* study : all) {
    json one = {{"id", study->id},
                {"folder", study->folder.string()},
                {"revision", revision_of(study->folder)},
                {"sweep", study->is_sweep}};
    if (study->root != nullptr) {
      one["root"] = study->root->id;
      one["how"] = study->how;
      one["command"] =
          fmt::format("epicyclic sweep {} -o {}", shell_word((study->folder / "input.resolved.json").string()),
                      shell_word(study->folder.string()));
    }
    studies.push_back(std::move(one));
  }
  return {{"studies", std::move(studies)},
          {"computing", computation_->current()},
          {"last", computation_->last()},
          {"threads", arguments_.threads}};
}

std::string ServedStudies::data(Served& study) const {
  const std::scoped_lock lock(study.mutex);
  const std::string revision = revision_of(study.folder);
  if (revision == study.revision && !study.encoded.empty()) return study.encoded;
  // Of branches the report reads HDF5, which one thread at a time may use.
  std::unique_lock<std::mutex> no_start(starting_, std::defer_lock);
  if (study.has_branches) {
    no_start.lock();
    if (computation_->busy()) throw Refused{202, "It is shown when the computation has ended"};
  }
  ReportData data;
  const auto stop_here = [] {
    if (stop_requested()) throw Stopped();
  };
  json described;
  try {
    described = study_report(study.folder, data, stop_here);
  } catch (const InputError& e) {
    throw Refused{202, e.what()};  // nothing to be shown yet
  }
  json numbers = json::array();
  for (const AdjustableNumber& number : study.numbers)
    numbers.push_back({{"name", number.name},
                       {"meaning", number.meaning},
                       {"unit", number.unit},
                       {"value", number.value()},
                       {"is_factor", number.is_factor},
                       {"suggested", number.is_suggested}});
  described["numbers"] = std::move(numbers);
  described["served"] = study.id;
  if (study.is_sweep) described["recorded_periods"] = study.input->study.recording().recorded_periods;
  study.encoded = data.encoded({{"format", 1},
                                {"program", {{"version", EPICYCLIC_VERSION}, {"commit", EPICYCLIC_COMMIT}}},
                                {"um_per_b_c", micrometres_per_length_scale()},
                                {"studies", json::array({std::move(described)})}});
  study.revision = revision;
  return study.encoded;
}

json ServedStudies::history(Served& study, const json& request) const {
  require_only(request, {"study", "point", "periods"});
  const int periods = integer_in(request, "periods", 1, history_periods_max);
  if (!study.input) throw Refused{409, "this study keeps no points"};
  const input::LoadedInput& input = *study.input;
  const studies::SweepPlan plan = input::plan_of(input.study);
  const auto point =
      static_cast<std::size_t>(integer_in(request, "point", 0, static_cast<int>(plan.points.size()) - 1));
  const std::scoped_lock lock(study.mutex);
  const std::string identity = identity_of(input, input.study.kind());
  if (run_of(study.folder).at("identity") != identity)
    throw Refused{409, "another version of the numerics computed this study"};
  const std::string revision = revision_of(study.folder);
  if (!study.points || study.revision_of_points != revision) {
    study.points =
        std::make_unique<store::PointStore>(study.folder, identity, plan.points.size(), store::Journal::Use::read);
    study.revision_of_points = revision;
  }
  if (!study.points->holds(point)) throw Refused{409, "this point is not finished"};
  const studies::PointResult result = study.points->read(point);
  const model::DynamicModel model = input::model_at_point(input)(plan.points[point]);
  const std::vector<double> state = studies::state_on(result, model.dimension);
  if (state.empty()) throw Refused{409, "no state of this point is stored"};
  const auto history = studies::short_history(model, state, input.study.integrator, periods, history_phases);
  if (!history) throw Refused{409, "the end of the history was not reached"};
  json columns = json::object();
  for (std::size_t k = 0; k < history->columns.size(); ++k)
    columns[std::string(studies::ShortHistory::names[k])] = history->columns[k];
  return {{"periods", periods}, {"phases", history_phases}, {"columns", std::move(columns)}};
}

json ServedStudies::refine(const Served& study, const json& request) {
  require_only(request, {"study", "from", "to", "values", "records"});
  if (!study.is_sweep) throw Refused{409, "regions of sweeps only are computed finer"};
  const double from = number_in(request, "from");
  const double to = number_in(request, "to");
  if (!(from < to)) throw InputError("from: is not below to");
  const int values = integer_in(request, "values", 2, values_max);
  const int records = integer_in(request, "records", 1, 64);
  const studies::RecordingOptions& recording = study.top().input->study.recording();
  const std::scoped_lock lock(starting_);
  return begin(study.top(), "refined", study.changes,
               {set_text("/study/from", from), set_text("/study/to", to), fmt::format("/study/points={}", values),
                "/study/segments=auto", "/study/crosscheck/points=0",
                fmt::format("/study/recorded_periods={}", records * recording.recorded_periods)},
               /*figures=*/true);
}

json ServedStudies::change(const Served& study, const json& request) {
  require_only(request, {"study", "numbers", "coarse"});
  const Served& root = study.top();
  if (!root.is_sweep) throw Refused{409, "numbers of sweeps only are changed"};
  const auto coarse = request.find("coarse");
  if (coarse == request.end() || !coarse->is_boolean()) throw InputError("coarse: is not true or false");
  const auto numbers = request.find("numbers");
  if (numbers == request.end() || !numbers->is_array() || numbers->empty() || numbers->size() > numbers_max)
    throw InputError(fmt::format("numbers: is not an array of 1 to {} changes", numbers_max));
  std::vector<Change> changes;
  for (const json& one : *numbers) {
    if (!one.is_object()) throw InputError("numbers: has an element that is no object");
    require_only(one, {"number", "value"});
    changes.emplace_back(integer_in(one, "number", 0, static_cast<int>(root.numbers.size()) - 1),
                         number_in(one, "value"));
  }
  std::vector<std::string> sets = {"/study/segments=auto", "/study/crosscheck/points=0"};
  if (coarse->get<bool>()) sets.insert(sets.end(), coarse_sets().begin(), coarse_sets().end());
  const std::scoped_lock lock(starting_);
  // Whoever moves a slider has no use for the diagram before it. A region is not given up for it.
  if (const json current = computation_->current(); !current.is_null())
    if (served(current).place == "refined") throw Refused{409, "a region is being computed; cancel it first"};
  computation_->cancel();
  if (!computation_->wait(std::chrono::seconds(3))) throw Refused{409, "another computation is at work"};
  return begin(root, "changed", std::move(changes), sets, /*figures=*/!coarse->get<bool>());
}

json ServedStudies::begin(const Served& root, const char* place, std::vector<Change> changes,
                          const std::vector<std::string>& sets, bool figures) {
  if (computation_->busy()) throw Refused{409, "another computation is at work"};
  Arguments arguments = arguments_;
  arguments.report_folders.clear();
  arguments.input = root.folder / "input.resolved.json";
  arguments.figures = figures;
  for (const auto& [k, value] : changes) {
    const AdjustableNumber& number = root.numbers[k];
    for (std::size_t j = 0; j < number.pointers.size(); ++j)
      arguments.sets.push_back(set_text(number.pointers[j], number.is_factor ? value * number.values[j] : value));
  }
  arguments.sets.insert(arguments.sets.end(), sets.begin(), sets.end());
  // What is not valid shows here, before there is a folder.
  input::LoadedInput input = input::load_input(arguments.input, input::parse_assignments(arguments.sets));
  (void)input::model_at_point(input)(input::plan_of(input.study).points.front());

  const fs::path parent = root.folder / place;
  create_folder(parent, /*parents=*/false);
  int last = 0;
  for (const auto& entry : fs::directory_iterator(parent)) {
    const std::string name = entry.path().filename().string();
    if (name.find_first_not_of("0123456789") == std::string::npos && name.size() < 9)
      last = std::max(last, std::stoi(name));
  }
  fs::path folder;
  do {
    folder = parent / fmt::format("{:03}", ++last);
  } while (!fs::create_directory(folder));  // another server may have made it
  arguments.output = folder;

  auto study = std::make_unique<Served>();
  study->folder = folder;
  study->root = &root;
  study->place = place;
  study->input = std::move(input);
  study->is_sweep = true;
  study->describe();
  std::size_t id = 0;
  {
    const std::scoped_lock lock(mutex_);
    id = study->id = all_.size();
    all_.push_back(std::move(study));
  }
  if (!computation_->start({"sweep", std::move(arguments), id})) throw Refused{409, "another computation is at work"};
  return {{"study", id}, {"folder", folder.string()}};
}

}  // namespace epicyclic::app
