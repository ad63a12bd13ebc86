#include "finished_study.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/atomic_file.hpp"
#include "core/counted.hpp"
#include "core/csv.hpp"
#include "core/errors.hpp"
#include "core/text.hpp"
#include "input/aliases.hpp"
#include "input/derived_study.hpp"
#include "input/json_source.hpp"
#include "input/study_kind.hpp"
#include "input/study_model.hpp"
#include "reports/axis_words.hpp"
#include "reports/speed_words.hpp"
#include "reports/transient_chaos.hpp"
#include "session.hpp"
#include "store/manifest.hpp"
#include "store/point_columns.hpp"
#include "streams.hpp"
#include "studies/branches_options.hpp"
#include "studies/cost_estimate.hpp"
#include "studies/known_attractors.hpp"
#include "studies/plane_options.hpp"

namespace epicyclic::app {

namespace {

using nlohmann::json;

/// run.json of a complete study.
json complete_run(const std::filesystem::path& folder) {
  const input::JsonSource run = input::read_json_file(folder / "run.json");
  if (!run.complete || !run.value.is_object() || !run.value.value("identity", json()).is_string())
    throw InputError(folder.string() + ": contains no study of this program (no valid run.json)");
  if (run.value.value("state", json()) != "complete")
    throw InputError(folder.string() + ": the study in it is not complete; re-run its command first");
  return run.value;
}

/// The unchanged files of the manifest.
/// @throws DamagedData
void require_unchanged(const std::filesystem::path& folder, const json& run, const std::vector<std::string>& names) {
  const auto manifest = store::manifest_from(run.value("files", json()));
  if (!manifest) throw store::DamagedData(folder.string() + ": run.json does not list its files");
  store::Manifest needed;
  for (const std::string& name : names)
    if (const auto file = manifest->find(name); file != manifest->end()) needed.insert(*file);
  for (const store::ChangedFile& file : store::changed_files(folder, needed))
    throw store::DamagedData(fmt::format("{}: {} was changed; re-run the command of this study to write it again",
                                         folder.string(), file.name));
}

CsvTable read_table(const std::filesystem::path& file) {
  const FileDescriptor descriptor = open_descriptor(file, O_RDONLY);
  if (!descriptor.is_open()) throw_output_error(file, "open the file", errno);
  auto table = parse_csv(read_all(descriptor.get(), file));
  if (!table) throw store::DamagedData(file.string() + ": is not a table that this program writes");
  for (std::string& name : table->columns) name = input::new_column(file.filename().string(), name);
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
  const input::StudyKind* own = input_.study.plan.kind();
  const input::PointsKept kept = own == nullptr ? input::PointsKept::none : own->points_kept;
  if (kept == input::PointsKept::none)
    throw InputError(fmt::format("{}: is a study of kind {}; points are taken from a sweep, a map, basins or a run",
                                 folder.string(), kind));
  if (identity_ != identity_of(input_, kind))
    throw InputError(folder.string() + ": another version of the numerics, or another command, computed it");
  plan_ = std::make_unique<studies::SweepPlan>(input::plan_of(input_.study));
  if (kept == input::PointsKept::tables) {
    read_run();
    return;
  }
  if (std::error_code error; !std::filesystem::exists(folder_ / "journal.bin", error))
    throw store::DamagedData(folder_.string() +
                             ": its journal is missing; re-run the command of this study to compute its points again");
  store_ = std::make_unique<store::PointStore>(folder_, identity_, plan_->points.size(), store::Journal::Use::read);
  if (store_->size() != plan_->points.size())
    throw store::DamagedData(
        folder_.string() + ": its journal does not have all points; re-run the command of this study to compute them");
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
  result.outcome = integrate::Outcome::failed;
  for (const auto outcome : {integrate::Outcome::reached, integrate::Outcome::diverged, integrate::Outcome::step_limit})
    if (cell("status") == store::status_word(outcome)) result.outcome = outcome;
  for (const auto regime : {analysis::Regime::periodic, analysis::Regime::quasiperiodic, analysis::Regime::chaotic})
    if (cell("regime") == to_string(regime)) result.regime = regime;
  constexpr std::size_t keys = 2;  // point, index
  result.poincare_columns = section.columns.size() - std::min(section.columns.size(), keys);
  for (const auto& row : section.rows)
    for (std::size_t j = keys; j < row.size(); ++j) result.poincare.push_back(number_of(row[j]));
  const studies::RecordingOptions& recording = input_.study.recording();
  const model::DynamicModel model = input::model_at(input_)(input_.study.mesh_frequency_ratio);
  if (result.poincare_columns < model.dimension)
    throw store::DamagedData((folder_ / "poincare.csv").string() + ": is not a table of states of its study");
  result.classified = recording.classification_periods > 0 && studies::has_classification(model);
  result.recurrence = analysis::recurrence(studies::section_of(result, model.dimension), recording.period_max,
                                           recording.recurrence_tolerance);
  run_.push_back(std::move(result));
}

studies::PointSource FinishedStudy::points() const {
  return store_ ? store_->source() : studies::points_in_memory(run_);
}

model::DynamicModel FinishedStudy::model_at(std::size_t point) const {
  if (!store_) return input::model_at(input_)(input_.study.mesh_frequency_ratio);
  return input::model_at_point(input_)(plan_->points[point]);
}

FinishedTables finished_tables(const std::filesystem::path& folder,
                               const std::function<std::vector<std::string>(const input::Study&)>& tables) {
  const json run = complete_run(folder);
  require_unchanged(folder, run, {"input.resolved.json"});
  FinishedTables finished{folder, input::load_input(folder / "input.resolved.json")};
  require_unchanged(folder, run, tables(finished.input.study));
  return finished;
}

FinishedBranches finished_branches(const std::filesystem::path& folder) {
  const auto tables = [](const input::Study& study) {
    return study.plan.get_if<studies::BranchesOptions>() != nullptr ? std::vector<std::string>{"special.csv"}
                                                                    : std::vector<std::string>{};
  };
  FinishedBranches branches{finished_tables(folder, tables).input, {}};
  if (branches.input.study.plan.get_if<studies::BranchesOptions>() == nullptr)
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
  if (colon == std::string::npos || colon + 1 == text.size()) return donor;
  const std::string_view which = std::string_view(text).substr(colon + 1);
  const char* const end = which.data() + which.size();
  if (std::ranges::all_of(which, [](char c) { return c >= '0' && c <= '9'; })) {
    std::size_t point = 0;
    if (std::from_chars(which.data(), end, point).ec != std::errc())
      throw InputError("--from " + text + ": the number of the point is too large");
    donor.point = point;
  } else {
    for (const auto direction : {studies::Direction::up, studies::Direction::down})
      if (which.starts_with(store::direction_word(direction) + "=")) donor.direction = direction;
    if (!donor.direction) {
      if ((which == "up" || which == "down") && !std::filesystem::exists(text))
        throw InputError(fmt::format("--from {}: give the value, as FOLDER:{}=VALUE", text, which));
      return donor;
    }
    const auto read = std::from_chars(which.data() + which.find('=') + 1, end, donor.value);
    donor.unit = std::string(read.ptr, end);
    if (read.ec != std::errc() || !(donor.unit.empty() || donor.unit == "rpm" || donor.unit == "Hz") ||
        !std::isfinite(donor.value))
      throw InputError("--from " + text + ": give a number after =, or one with rpm or Hz");
  }
  donor.folder = text.substr(0, colon);
  return donor;
}

std::size_t point_of(const Donor& donor, const FinishedStudy& from) {
  const studies::SweepPlan& plan = from.plan();
  if (donor.point) {
    if (*donor.point >= plan.points.size())
      throw InputError(fmt::format("--from {}: there is no point {}; the study has {}, numbered from 0{}", donor.text,
                                   *donor.point, counted(plan.points.size(), "points"),
                                   from.input().study.kind() == "sweep"
                                       ? "; FOLDER:up=VALUE or FOLDER:down=VALUE names the point nearest to a value"
                                       : ""));
    return *donor.point;
  }
  const std::string kind(from.input().study.kind());
  if (donor.all() || kind != "sweep")
    throw InputError(fmt::format("--from {}: must name one point, as FOLDER:INDEX{}", donor.text,
                                 kind == "sweep" ? ", FOLDER:up=VALUE or FOLDER:down=VALUE" : ""));
  const studies::Axis& axis = plan.grid.first;
  const double half_step = axis.points > 1 ? 0.5 * std::abs(axis.to - axis.from) / (axis.points - 1) : 0.0;
  constexpr double rounding = 1.0 + 1e-9;
  double value = donor.value;
  if (!donor.unit.empty()) {
    if (axis.name != studies::speed_parameter)
      throw InputError(fmt::format("--from {}: the sweep goes along {}, not along the speed", donor.text, axis.name));
    value *= input::ratio_per_unit(*input::find_speed_alias(donor.unit == "Hz" ? "mesh_frequency_Hz" : "sun_speed_rpm"),
                                   from.input().study.stage)
                 .value();
  } else if (from.input().study.axis_speed && std::abs(value) > std::max(std::abs(axis.from), std::abs(axis.to))) {
    value /= from.input().study.axis_speed->per_ratio;  // beyond every ratio of the sweep: in the unit of its speeds
  }
  std::optional<studies::GridPoint> nearest;
  for (const studies::GridPoint& p : plan.points)
    if (p.direction == *donor.direction && (!nearest || std::abs(p.value - value) < std::abs(nearest->value - value)))
      nearest = p;
  if (!nearest) throw InputError(fmt::format("--from {}: the sweep has no points in that direction", donor.text));
  const reports::AxisWords words = reports::axis_words(axis.name, from.input().study.axis_speed);
  if (std::abs(nearest->value - value) > half_step * rounding)
    throw InputError(fmt::format("--from {}: {} is from {} to {} in that sweep{}", donor.text, words.name,
                                 words.text(axis.from, 9), words.text(axis.to, 9),
                                 axis.name == studies::speed_parameter && donor.unit.empty()
                                     ? "; give a speed in rpm or Hz as up=3000rpm"
                                     : ""));
  return nearest->index;
}

namespace {

/// A point in words: "point 137 (up, mesh_frequency_ratio = 0.885), period 1". A run has one point, and no number is
/// needed: "the run at mesh_frequency_ratio = 0.885, sun 6000 rpm, period 1".
std::string point_words(const FinishedStudy& from, const studies::PointSummary& r) {
  const auto varied = input::varied_parameters(from.input().study);
  const input::Study& study = from.input().study;
  std::string words;
  if (study.kind() == "run") {
    const double mesh_frequency = study.mesh_frequency_ratio * input::time_scale(from.input());
    words = fmt::format("the run at {} = {}, {}", studies::speed_parameter, short_text(study.mesh_frequency_ratio, 9),
                        reports::sun_speed_words(study.stage, mesh_frequency, 5));
  } else {
    words = fmt::format("point {}", r.point.index);
  }
  for (std::size_t k = 0; k < varied.size(); ++k) {
    words += fmt::format("{}{} = {}", k == 0 ? fmt::format(" ({}, ", store::direction_word(r.point.direction)) : ", ",
                         varied[k].axis.name, short_text(k == 0 ? r.point.value : r.point.second_value, 9));
    if (varied[k].axis.name == studies::speed_parameter && std::isfinite(r.meshes.speeds.sun))
      words += ", " + reports::sun_speed_words(r.meshes.speeds, 5);
  }
  if (!varied.empty()) words += ")";
  return words + ", " +
         (r.outcome == integrate::Outcome::reached ? studies::regime_name(r) : store::status_word(r.outcome));
}

/// Other attractors of the study at the values of a point, a line each.
std::vector<std::string> other_attractors(const FinishedStudy& from, std::size_t point,
                                          const model::DynamicModel& model) {
  const bool basins = from.input().study.plan.get_if<studies::BasinsOptions>() != nullptr;
  const studies::PointSource points = from.points();
  const studies::KnownAttractors known =
      studies::attractors_known_at(from.plan(), points, point, basins, model, from.input().study.integrator);
  std::vector<std::string> lines;
  for (std::size_t k = 0; k < known.all.size(); ++k) {
    const studies::KnownAttractor& attractor = known.all[k];
    if (k + 1 == known.here) continue;
    std::string line = basins
                           ? fmt::format("coexists there: {}, {} of {} cells, the first of them point {}",
                                         attractor.regime, attractor.points, known.considered, attractor.point)
                           : fmt::format("coexists there: {}", point_words(from, points.read_summary(attractor.point)));
    const auto root = [&](std::size_t of) {
      return of > 0 && known.all[of - 1].image_of > 0 ? known.all[of - 1].image_of : of;
    };
    if (known.here > 0 && root(k + 1) == root(known.here))
      line += "; it is this attractor with the planets permuted";
    else if (attractor.image_of > 0)
      line += "; it is another one of these with the planets permuted";
    lines.push_back(std::move(line));
  }
  const auto is_chaotic = [](const studies::KnownAttractor& a) { return a.regime.starts_with("chaotic"); };
  if (std::ranges::any_of(known.all, is_chaotic) && !std::ranges::all_of(known.all, is_chaotic))
    lines.emplace_back(reports::transient_chaos);
  return lines;
}

}  // namespace

input::LoadedInput with_start(const Arguments& arguments, std::string_view kind, StartFacts* facts) {
  const std::vector<input::Assignment> sets = input::parse_assignments(arguments.sets);
  if (arguments.from.empty()) {
    if (arguments.input.empty())
      throw InputError(fmt::format("{} needs INPUT, or --from FOLDER:INDEX of a finished study", kind));
    return input::load_input(arguments.input, sets);
  }
  if (arguments.from.size() > 1) throw InputError("--from: only one start is allowed");
  const Donor donor = parse_donor(arguments.from.front());
  const FinishedStudy from(donor.folder);
  const std::size_t index = point_of(donor, from);
  const studies::PointResult r = from.points().read(index);
  const model::DynamicModel there = from.model_at(index);
  std::vector<double> state = studies::state_on(r, there.dimension);
  if (r.outcome != integrate::Outcome::reached || state.empty())
    throw InputError(fmt::format("--from {}: {}: has no stored state", donor.text, point_words(from, r)));
  std::vector<std::string> lines = other_attractors(from, index, there);
  lines.insert(lines.begin(), point_words(from, r));

  std::vector<input::Assignment> of_point;
  const bool stage_changes =
      std::ranges::any_of(sets, [](const auto& set) { return set.pointer.starts_with("/stage"); });
  if (arguments.input.empty())
    of_point = input::point_as_study(from.input(), from.plan().points[index], kind, stage_changes);
  of_point.insert(of_point.end(), sets.begin(), sets.end());
  const input::LoadedInput stage =
      arguments.input.empty() ? from.input().with_further(of_point) : input::load_input(arguments.input, sets);
  if (!stage.study.has_points()) return stage;  // refused for its kind
  const bool plans = std::ranges::any_of(sets, [](const auto& set) {
    return set.pointer == "/study" || set.pointer == "/study/parameter" || set.pointer == "/study/from" ||
           set.pointer == "/study/to";
  });
  std::vector<input::Assignment> further;
  if (arguments.input.empty() && kind != "run" && !plans) {
    // At the speed that is set, if one is.
    for (const char* end : {"/study/from", "/study/to"})
      further.push_back({end, stage.study.mesh_frequency_ratio, std::string(end) + ", by --from"});
  }
  // Rates are per tau = omega_sn t, and omega_sn is the stage's own.
  const double slower = input::time_scale(from.input()) / input::time_scale(stage);
  for (std::size_t k = state.size() / 2; k < state.size(); ++k) state[k] *= slower;
  further.push_back({"/study/initial_state", state, "/study/initial_state, by --from"});
  input::LoadedInput input = stage.with_further(further);
  const bool same_equations = input::moves_like(input, from.input(), there);
  if (!same_equations)
    lines.emplace_back("its equations of motion are not those of this study; its state is only an initial state");
  for (const std::string& line : lines) print_message("--from {}: {}\n", donor.text, line);
  if (facts != nullptr) *facts = {std::move(lines), same_equations && r.regime == analysis::Regime::chaotic};
  return input;
}

namespace {

/// Takes seeds from donors for one study.
class Sower {
 public:
  Sower(const input::LoadedInput& study, std::vector<std::string>& notes)
      : study_(study),
        options_(study.study.plan.as<studies::BranchesOptions>()),
        notes_(notes),
        seeds_(study.resolved.at("study").value("seeds", json::array())) {}

  void take(const Donor& donor) {
    const FinishedStudy from(donor.folder);
    const studies::PointSource points = from.points();
    if (!donor.all()) {
      take_point(donor, from, point_of(donor, from));
      return;
    }
    if (from.input().study.plan.get_if<studies::BasinsOptions>() != nullptr) (void)point_of(donor, from);
    const std::size_t before = seeds_.size();
    // The middle of each stretch of points of one period.
    std::size_t first = 0;
    while (first < points.count) {
      const studies::PointSummary begun = points.read_summary(first);
      std::size_t last = first;
      const auto goes_on = [&](const studies::PointSummary& r) {
        return is_periodic(r) && r.period == begun.period && r.point.direction == begun.point.direction &&
               r.point.second_value == begun.point.second_value;
      };
      if (is_periodic(begun)) {
        while (last + 1 < points.count && goes_on(points.read_summary(last + 1))) ++last;
        const std::size_t middle = first + (last - first) / 2;
        const double value = value_of(from, middle);
        if (value >= options_.from && value <= options_.to) {
          take_point(donor, from, middle);
          if (const double reach = reach_of(from, first, middle, last); reach > 0.0)
            seeds_.back()["max_distance"] = reach;
        }
      }
      first = last + 1;
    }
    if (seeds_.size() == before)
      throw InputError(fmt::format("--from {}: none of its points with a value from {} to {} is periodic", donor.text,
                                   options_.from, options_.to));
    notes_.push_back(
        fmt::format("--from {}: {} seeds, one for each range of one period", donor.text, seeds_.size() - before));
  }

  [[nodiscard]] json seeds() const { return seeds_; }

 private:
  static bool is_periodic(const studies::PointSummary& r) {
    return r.outcome == integrate::Outcome::reached && r.regime == analysis::Regime::periodic;
  }

  /// Factor for rates and Omega of the donor: they are in the scale of time of its stage.
  [[nodiscard]] double slower(const FinishedStudy& from) const {
    return input::time_scale(from.input()) / input::time_scale(study_);
  }

  /// Of the parameter in the donor, which may vary it.
  [[nodiscard]] double value_of(const FinishedStudy& from, std::size_t point) const {
    const auto varied = input::varied_parameters(from.input().study);
    const studies::GridPoint at = from.plan().points[point];
    const double scale = options_.parameter == studies::speed_parameter ? slower(from) : 1.0;
    for (std::size_t k = 0; k < varied.size(); ++k)
      if (varied[k].axis.name == options_.parameter) return scale * (k == 0 ? at.value : at.second_value);
    return scale * input::given_value(from.input(), options_.parameter);
  }

  /// From the middle of a stretch to two steps of the grid beyond its ends; 0 if the donor varies another parameter.
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
    std::vector<double> state = studies::state_on(r, there.dimension);
    for (std::size_t k = state.size() / 2; k < state.size(); ++k) state[k] *= slower(from);
    if (state.empty()) throw InputError(which + " has no stored state");
    const double value = value_of(from, point);
    const model::DynamicModel here = input::model_family(study_, options_.parameter, family_step(options_))(value);
    if (here.dimension != there.dimension)
      throw InputError(
          fmt::format("{} has a state of {} numbers, this study one of {}", which, there.dimension, here.dimension));
    if (!studies::same_equations(here, there))
      notes_.push_back(
          fmt::format("{}: its equations of motion are not those of this study at {} = {}; its state is only a guess",
                      which, options_.parameter, short_text(value, 9)));
    if (!is_periodic(r))
      notes_.push_back(fmt::format("{}: is {}; an orbit of period {} is sought near it", which, studies::regime_name(r),
                                   options_.period));
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
  if (donors.empty() || input.study.plan.get_if<studies::BranchesOptions>() == nullptr) return input;
  Sower sower(input, notes);
  for (const std::string& donor : donors) sower.take(parse_donor(donor));
  json resolved = input.resolved.at("study");
  resolved["seeds"] = sower.seeds();
  // In the unit of its parameter.
  if (const auto& speed = input.study.axis_speed)
    for (json& seed : resolved["seeds"])
      for (const char* key : {"value", "max_distance"})
        if (seed.contains(key)) seed[key] = seed[key].get<double>() * speed->per_ratio;
  return input.with_further(std::array{input::Assignment{"/study", std::move(resolved), "/study, by --from"}});
}

}  // namespace epicyclic::app
