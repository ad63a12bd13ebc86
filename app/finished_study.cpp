#include "finished_study.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <optional>
#include <system_error>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/csv.hpp"
#include "core/errors.hpp"
#include "core/text.hpp"
#include "input/json_source.hpp"
#include "input/study_model.hpp"
#include "session.hpp"
#include "store/manifest.hpp"
#include "studies/probes.hpp"

namespace epicyclic::app {

namespace {

using nlohmann::json;

/// run.json of a complete study.
json complete_run(const std::filesystem::path& folder) {
  const input::JsonSource run = input::read_json_file(folder / "run.json");
  if (!run.complete || !run.value.is_object() || !run.value.contains("identity"))
    throw InputError(folder.string() + ": holds no study of this program (no run.json that says so)");
  if (run.value.value("state", json()) != "complete")
    throw InputError(folder.string() + ": the study in it is not complete; let its command end first");
  return run.value;
}

/// The files of the manifest as they were left.
/// @throws DamagedData
void require_unchanged(const std::filesystem::path& folder, const json& run, std::initializer_list<const char*> names) {
  const auto manifest = store::manifest_from(run.value("files", json()));
  if (!manifest) throw store::DamagedData(folder.string() + ": run.json does not say which files it has");
  store::Manifest needed;
  for (const char* name : names)
    if (const auto file = manifest->find(name); file != manifest->end()) needed.insert(*file);
  for (const store::ChangedFile& file : store::changed_files(folder, needed))
    throw store::DamagedData(
        fmt::format("{}: {} is not as the study left it; its own command makes it again", folder.string(), file.name));
}

CsvTable read_table(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  auto table = parse_csv(text);
  if (!table) throw store::DamagedData(file.string() + ": is not a table that this program writes");
  return *std::move(table);
}

double number_of(const std::string& cell) {
  double value = 0.0;
  std::from_chars(cell.data(), cell.data() + cell.size(), value);
  return value;
}

input::LoadedInput load_resolved(const std::filesystem::path& folder, const json& run) {
  require_unchanged(folder, run, {"input.resolved.json", "points.csv", "poincare.csv"});
  return input::load_input(folder / "input.resolved.json");
}

}  // namespace

FinishedStudy::FinishedStudy(const std::filesystem::path& folder) : FinishedStudy(folder, complete_run(folder)) {}

FinishedStudy::FinishedStudy(const std::filesystem::path& folder, const json& run)
    : folder_(folder), input_(load_resolved(folder, run)), identity_(run.at("identity")) {
  const std::string kind(input_.study.kind());
  if (kind != "sweep" && kind != "map" && kind != "run")
    throw InputError(
        fmt::format("{}: is a study of kind {}; points are taken from a sweep, a map or a run", folder.string(), kind));
  if (identity_ != identity_of(input_, kind))
    throw InputError(folder.string() + ": was computed by another version of the numerics, or by another command");
  if (kind == "run") {
    plan_ = std::make_unique<studies::SweepPlan>(studies::plan_sweep(input_.study.sweep()));
    read_run();
    return;
  }
  plan_ = std::make_unique<studies::SweepPlan>(input::plan_of(input_.study));
  store_ = std::make_unique<store::PointStore>(folder_, identity_, plan_->points.size(), store::Journal::Use::read);
  if (store_->size() != plan_->points.size())
    throw store::DamagedData(folder_.string() +
                             ": its journal does not hold all points; its own command makes them again");
}

void FinishedStudy::read_run() {
  const CsvTable points = read_table(folder_ / "points.csv");
  const CsvTable section = read_table(folder_ / "poincare.csv");
  const auto cell = [&](const char* column) -> const std::string& {
    const std::size_t index = points.index_of(column);
    if (points.rows.size() != 1 || index == points.columns.size())
      throw store::DamagedData((folder_ / "points.csv").string() + ": is not the table of one point");
    return points.rows.front()[index];
  };
  studies::PointResult result;
  result.point = plan_->points[0];
  result.period = static_cast<int>(number_of(cell("period")));
  result.outcome = cell("status") == "ok" ? integrate::Outcome::reached : integrate::Outcome::failed;
  for (const auto regime : {analysis::Regime::periodic, analysis::Regime::quasiperiodic, analysis::Regime::chaotic})
    if (cell("regime") == to_string(regime)) result.regime = regime;
  constexpr std::size_t keys = 2;  // point, index
  result.poincare_columns = section.columns.size() - keys;
  for (const auto& row : section.rows)
    for (std::size_t j = keys; j < row.size(); ++j) result.poincare.push_back(number_of(row[j]));
  run_.push_back(std::move(result));
}

studies::PointSource FinishedStudy::points() const {
  return store_ ? store_->source() : studies::points_in_memory(run_);
}

model::DynamicModel FinishedStudy::model_at(std::size_t point) const {
  if (!store_) return input::model_at(input_)(input_.study.mesh_frequency_ratio);
  return input::model_at_point(input_)(plan_->points[point]);
}

FinishedBranches finished_branches(const std::filesystem::path& folder) {
  const json run = complete_run(folder);
  require_unchanged(folder, run, {"input.resolved.json", "special.csv"});
  FinishedBranches branches{input::load_input(folder / "input.resolved.json"), {}};
  if (branches.input.study.kind() != "continue")
    throw InputError(fmt::format("{}: is a study of kind {}; special points are those of a continue", folder.string(),
                                 branches.input.study.kind()));
  const CsvTable table = read_table(folder / "special.csv");
  const auto column = [&](const char* name) {
    const std::size_t index = table.index_of(name);
    if (index == table.columns.size())
      throw store::DamagedData((folder / "special.csv").string() + ": has no column " + name);
    return index;
  };
  const auto kind = column("kind"), period = column("period"), value = column("value"), bound = column("error_bound"),
             contact = column("contact"), symmetry = column("broken_symmetry"), same = column("same_as");
  for (const auto& row : table.rows)
    if (row[same].empty())
      branches.points.push_back({row[kind], static_cast<int>(number_of(row[period])), number_of(row[value]),
                                 row[bound].empty() ? std::numeric_limits<double>::quiet_NaN() : number_of(row[bound]),
                                 row[contact], row[symmetry]});
  return branches;
}

Donor parse_donor(const std::string& text) {
  Donor donor{text, text};
  const std::size_t colon = text.rfind(':');
  if (colon == std::string::npos || colon + 1 == text.size() ||
      !std::all_of(text.begin() + static_cast<std::ptrdiff_t>(colon) + 1, text.end(),
                   [](char c) { return c >= '0' && c <= '9'; }))
    return donor;
  donor.folder = text.substr(0, colon);
  donor.all = false;
  const auto read = std::from_chars(text.data() + colon + 1, text.data() + text.size(), donor.point);
  if (read.ec != std::errc()) throw InputError("--from " + text + ": there is no such point");
  return donor;
}

namespace {

/// Takes seeds from donors for one study.
class Sower {
 public:
  Sower(const input::LoadedInput& study, std::vector<std::string>& notes)
      : study_(study),
        options_(std::get<studies::BranchesOptions>(study.study.plan)),
        notes_(notes),
        seeds_(study.resolved.at("study").value("seeds", json::array())) {}

  void take(const Donor& donor) {
    const FinishedStudy from(donor.folder);
    const studies::PointSource points = from.points();
    if (!donor.all) {
      if (donor.point >= points.count)
        throw InputError(fmt::format("--from {}: there is no point {}, the last one is {}", donor.text, donor.point,
                                     points.count - 1));
      take_point(donor, from, donor.point);
      return;
    }
    const std::size_t before = seeds_.size();
    // The middle of each stretch of points of one period.
    std::size_t first = 0;
    while (first < points.count) {
      const studies::PointSummary begun = points.read_brief(first);
      std::size_t last = first;
      const auto goes_on = [&](const studies::PointSummary& r) {
        return is_periodic(r) && r.period == begun.period && r.point.direction == begun.point.direction &&
               r.point.second_value == begun.point.second_value;
      };
      if (is_periodic(begun)) {
        while (last + 1 < points.count && goes_on(points.read_brief(last + 1))) ++last;
        const std::size_t middle = first + (last - first) / 2;
        const double value = value_of(from, middle);
        if (value >= options_.from && value <= options_.to) {
          take_point(donor, from, middle);
          if (const double reach = reach_of(from, first, middle, last); reach > 0.0) seeds_.back()["reach"] = reach;
        }
      }
      first = last + 1;
    }
    if (seeds_.size() == before)
      throw InputError(fmt::format("--from {}: none of its points is periodic, with a value from {} to {}", donor.text,
                                   options_.from, options_.to));
    notes_.push_back(
        fmt::format("--from {}: {} seeds, one of each periodic stretch", donor.text, seeds_.size() - before));
  }

  [[nodiscard]] json seeds() const { return seeds_; }

 private:
  static bool is_periodic(const studies::PointSummary& r) {
    return r.outcome == integrate::Outcome::reached && r.regime == analysis::Regime::periodic;
  }

  /// Of the parameter in the donor, which may vary it.
  [[nodiscard]] double value_of(const FinishedStudy& from, std::size_t point) const {
    const auto varied = input::varied_parameters(from.input().study);
    const studies::GridPoint at = from.plan().points[point];
    for (std::size_t k = 0; k < varied.size(); ++k)
      if (varied[k].axis.name == options_.parameter) return k == 0 ? at.value : at.second_value;
    return input::given_value(from.input(), options_.parameter);
  }

  /// From the middle of a stretch to two steps of the grid beyond its ends; 0 where the donor varies something else.
  [[nodiscard]] double reach_of(const FinishedStudy& from, std::size_t first, std::size_t middle,
                                std::size_t last) const {
    const double here = value_of(from, middle);
    const studies::SweepPlan& plan = from.plan();
    double step = 0.0;
    for (const std::size_t other :
         {middle > 0 ? middle - 1 : middle, middle + 1 < plan.points.size() ? middle + 1 : middle}) {
      const double apart = std::abs(value_of(from, other) - here);
      if (apart > 0.0 && (step == 0.0 || apart < step)) step = apart;
    }
    constexpr double beyond = 2.0;
    return std::max(std::abs(value_of(from, first) - here), std::abs(value_of(from, last) - here)) + beyond * step;
  }

  void take_point(const Donor& donor, const FinishedStudy& from, std::size_t point) {
    const studies::PointResult r = from.points().read(point);
    const std::string which = fmt::format("--from {}: point {}", donor.text, point);
    if (r.outcome != integrate::Outcome::reached) throw InputError(which + " was not reached: it has no state");
    const model::DynamicModel there = from.model_at(point);
    std::vector<double> state = r.orbit;
    if (state.empty() && r.poincare_rows() > 0)
      state.assign(r.poincare.end() - static_cast<std::ptrdiff_t>(r.poincare_columns),
                   r.poincare.end() - static_cast<std::ptrdiff_t>(r.poincare_columns - there.dimension));
    if (state.empty()) state = r.attractor.orbit;
    if (state.size() > there.dimension) state.resize(there.dimension);
    if (state.size() != there.dimension) throw InputError(which + " has no state that was kept");
    const double value = value_of(from, point);
    const model::DynamicModel here = input::model_family(study_, options_.parameter, family_step(options_))(value);
    if (here.dimension != there.dimension)
      throw InputError(
          fmt::format("{} has a state of {} numbers, this study one of {}", which, there.dimension, here.dimension));
    if (!studies::same_motion(here, there))
      notes_.push_back(
          fmt::format("{}: its equations of motion are not those of this study at {} = {}; its state is a "
                      "guess only",
                      which, options_.parameter, short_text(value, 9)));
    if (!is_periodic(r))
      notes_.push_back(fmt::format("{}: is {}; an orbit of period {} is looked for near it", which,
                                   studies::motion_name(r), options_.period));
    seeds_.push_back({{"value", value}, {"period", is_periodic(r) ? r.period : options_.period}, {"state", state}});
  }

  const input::LoadedInput& study_;
  const studies::BranchesOptions& options_;
  std::vector<std::string>& notes_;
  json seeds_;
};

}  // namespace

input::LoadedInput with_seeds(const std::filesystem::path& study, const std::vector<input::Assignment>& sets,
                              const std::vector<std::string>& donors, std::vector<std::string>& notes) {
  input::LoadedInput input = input::load_input(study, sets);
  if (donors.empty() || !std::holds_alternative<studies::BranchesOptions>(input.study.plan)) return input;
  Sower sower(input, notes);
  for (const std::string& donor : donors) sower.take(parse_donor(donor));
  std::vector<input::Assignment> all = sets;
  all.push_back({"/study/seeds", sower.seeds(), "/study/seeds, by --from"});
  return input::load_input(study, all);
}

}  // namespace epicyclic::app
