#include "study_report.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <fcntl.h>
#include <fmt/format.h>

#include "command/session.hpp"
#include "command/shell_word.hpp"
#include "core/atomic_file.hpp"
#include "core/counted.hpp"
#include "core/csv.hpp"
#include "core/errors.hpp"
#include "core/text.hpp"
#include "input/json_source.hpp"
#include "input/keys.hpp"
#include "input/study_kind.hpp"
#include "input/study_model.hpp"
#include "reports/gear_output.hpp"
#include "reports/quantity_words.hpp"
#include "reports/sweep_output.hpp"
#include "store/branch_columns.hpp"
#include "store/hdf5_file.hpp"
#include "store/manifest.hpp"
#include "store/point_columns.hpp"
#include "store/point_store.hpp"
#include "studies/known_attractors.hpp"
#include "studies/named_parameters.hpp"
#include "studies/plane_options.hpp"
#include "studies/ramp.hpp"
#include "sweep_changes.hpp"
#include "sweep_records.hpp"

namespace epicyclic::app {

namespace {

using nlohmann::json;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Bytes of a study's columns before they are deflated: what is beyond is left out of the page, which says so.
constexpr std::size_t table_bytes_max = std::size_t{6} << 20;
/// Tables of at most so many rows keep their numbers to the last bit.
constexpr std::size_t exact_rows_max = 4096;
/// Of the multipliers of all orbits; of more orbits those beside special points are kept.
constexpr std::size_t multiplier_bytes_max = std::size_t{3} << 20;
/// A longer summary in words is left to its file.
constexpr std::size_t summary_bytes_max = std::size_t{256} << 10;

void require_unchanged(const std::filesystem::path& folder, const store::Manifest& files) {
  for (const store::ChangedFile& file : store::changed_files(folder, files))
    throw store::DamagedData(fmt::format("{}: {} was changed; re-run the command of this study to write it again",
                                         folder.string(), file.name));
}

// ---- words --------------------------------------------------------------------------------------------------------

/// Without what figures take for markup: "b_sp" of "b_{sp}".
std::string without_braces(std::string text) {
  std::erase_if(text, [](char c) { return c == '{' || c == '}'; });
  return text;
}

json parameter_json(const std::string& name) {
  json parameter = {{"name", name}, {"is_speed", name == studies::speed_parameter}, {"unit", ""}};
  if (const studies::NamedParameter* named = studies::find_parameter(name)) {
    parameter["label"] = without_braces(fmt::format("{}  {}{}", named->words, named->symbol, named->unit));
    parameter["symbol"] = without_braces(named->symbol);
    return parameter;
  }
  const auto [words, unit] = reports::quantity_words(name);
  parameter["label"] = words + (unit.empty() ? "" : "  [" + unit + "]");
  parameter["symbol"] = words;
  parameter["unit"] = unit;
  return parameter;
}

/// A component of the initial state.
json component_json(const std::string& name) {
  return {{"name", name},
          {"label", fmt::format("{}  [{}]", name, name.ends_with("_rate") ? "b_c per τ" : "b_c")},
          {"symbol", name},
          {"unit", ""},
          {"is_speed", false}};
}

using Described = std::map<std::string, ReportColumn>;

template <class Row>
void describe(Described& known, const std::vector<store::Column<Row>>& columns) {
  for (const auto& column : columns) known.emplace(column.name, ReportColumn{column.name, column.unit, column.meaning});
}

/// Columns of a table that this program knows; of the others the name says the unit.
Described described_columns(const std::string& table) {
  Described known;
  if (table == "points.csv") describe(known, store::point_columns(gear::planets_max, {}, {true, true}));
  if (table == "branch.csv") describe(known, store::branch_columns(gear::planets_max, {true, true}));
  if (table == "special.csv") describe(known, store::special_columns());
  if (table == "loci.csv") describe(known, store::locus_columns());
  if (table == "points.csv") known.emplace("second_value", ReportColumn{"second_value", "", "of the second axis"});
  if (table == "points.csv") known.emplace("attractor", ReportColumn{"attractor", "1", "number of the attractor"});
  return known;
}

ReportColumn described(const Described& known, const std::string& table, const std::string& name) {
  if (const auto found = known.find(name); found != known.end()) return found->second;
  if (table == "ramp.csv" || table == "orders.csv") {
    if (name == "mesh_frequency_ratio") return {name, "1", "Mesh frequency ratio Ω"};
    const auto order = name.find("_order_");
    if (order != std::string::npos) return {name, "b_c", "order " + name.substr(order + 7) + " of δ_sp,1"};
    if (name.starts_with("delta_")) return {name, "b_c", ""};
  }
  if (table == "history.csv") {
    if (name == "periods") return {name, "1", "time in mesh periods"};
    if (name == "tau") return {name, "1", "dimensionless time τ"};
    if (name == "time_s") return {name, "s", "time"};
    if (name.ends_with("_um")) return {name, "um", ""};
    if (name.ends_with("_m_per_s")) return {name, "m/s", ""};
    if (name.ends_with("_rate")) return {name, "b_c per tau", ""};
    if (name.starts_with("force_") || name.starts_with("bearing_")) return {name, "N", ""};
    if (name.starts_with("load_sharing_")) return {name, "1", ""};
    return {name, "b_c", ""};
  }
  return {name, "", ""};
}

/// "deflection of sun-planet mesh 1" of delta_sp_1; the name of a component of the state.
ReportColumn section_column(const std::string& name) {
  ReportColumn column{name, name.ends_with("_rate") ? "b_c per tau" : "b_c", name};
  if (name.starts_with("delta_sp_") || name.starts_with("delta_rp_")) {
    const std::string mesh = name.starts_with("delta_sp_") ? "sun-planet" : "ring-planet";
    const bool rate = name.ends_with("_rate");
    const std::string number = name.substr(9, name.size() - 9 - (rate ? 5 : 0));
    column.meaning = fmt::format("{}deflection of {} mesh {}", rate ? "rate of the " : "", mesh, number);
  }
  return column;
}

const char* title_of_table(const std::string& name) {
  static const std::map<std::string, const char*> titles = {
      {"points.csv", "points of the study"},
      {"branch.csv", "orbits of the branches"},
      {"special.csv", "special points"},
      {"branches.csv", "branches"},
      {"orbits.csv", "orbits found"},
      {"loci.csv", "loci of special points"},
      {"attractors.csv", "attractors"},
      {"history.csv", "time history"},
      {"spectrum.csv", "spectra"},
      {"exponents.csv", "running Lyapunov exponents"},
      {"multipliers.csv", "multipliers"},
      {"proof.csv", "changes of the sweep and their explanations"},
      {"crosscheck.csv", "check by other methods"},
      {"geometry.csv", "geometry"},
      {"stiffness.csv", "mesh stiffness over the mesh phase, in mesh periods"},
      {"load_sharing.csv", "share of a pair of teeth along the path of contact"},
      {"friction.csv", "friction along the path of contact"},
      {"friction_ratios.csv", "friction over normal force, over the mesh phase in mesh periods"},
      {"bearings.csv", "force and stiffness of the bearings over their deflection"},
      {"static_transmission_error.csv", "static transmission error under load"},
      {"modes.csv", "natural modes"},
      {"mode_shapes.csv", "shapes of the modes"},
      {"campbell.csv", "mesh frequencies at which a harmonic meets a natural frequency"},
      {"ramp.csv", "response to the changing speed, window by window"},
      {"orders.csv", "amplitudes of mesh orders, window by window"},
      {"tolerance.csv", "errors and cost of each method and tolerance"},
      {"smoothing.csv", "distance from the orbit with exact clearance"},
      {"quantities.csv", "error bars of quantities"},
      {"statistics.csv", "statistics of points that are not periodic"},
      {"scorecard.csv", "verdicts of the claims"},
      {"candidates.csv", "candidates of the search"},
      {"profile.csv", "cost along each parameter"},
      {"draws.csv", "draws of the unpublished parameters"},
      {"robustness.csv", "part of the draws for which each claim holds"},
      {"influence.csv", "influence of each parameter on each claim"},
      {"options.csv", "claims by the options of each choice"},
      {"crossing.csv", "states at which contact is made"},
  };
  const auto found = titles.find(name);
  return found == titles.end() ? "" : found->second;
}

// ---- input --------------------------------------------------------------------------------------------------------

/// Values of the resolved input with their origins; units and meanings from the tables of keys.
class InputList {
 public:
  InputList() {
    for (const input::KeyLine& key : input::key_lines()) keys_.emplace(key.pointer, key);
  }

  json of(const json& resolved) {
    add(resolved, "", "", nullptr);
    return std::move(list_);
  }

 private:
  /// @param general  the pointer with N for each index, as keys have it
  void add(const json& value, const std::string& pointer, const std::string& general, const json* origin) {
    if (value.is_object() && !value.empty()) {
      const auto origins = value.find("origin");
      for (const auto& [key, member] : value.items()) {
        if (key == "origin" && member.is_object()) continue;
        const json* of =
            origins != value.end() && origins->is_object() && origins->contains(key) ? &(*origins)[key] : nullptr;
        const std::string step = input::pointer_step(key);
        add(member, pointer + step, general + step, of);
      }
      return;
    }
    if (value.is_array() && std::ranges::any_of(value, [](const json& element) { return element.is_object(); })) {
      for (std::size_t k = 0; k < value.size(); ++k)
        add(value[k], fmt::format("{}/{}", pointer, k), general + "/N", nullptr);
      return;
    }
    json entry = {{"pointer", pointer}, {"value", value}};
    if (const auto key = keys_.find(general); key != keys_.end()) {
      if (!key->second.unit.empty()) entry["unit"] = key->second.unit;
      entry["meaning"] = key->second.meaning;
    }
    if (origin != nullptr && origin->is_string()) entry["origin"] = *origin;
    list_.push_back(std::move(entry));
  }

  std::map<std::string, input::KeyLine> keys_;
  json list_ = json::array();
};

// ---- the study ----------------------------------------------------------------------------------------------------

class StudyReport {
 public:
  StudyReport(std::filesystem::path folder, ReportData& data, const std::function<void()>& stop_here, int threads)
      : folder_(std::move(folder)), data_(data), stop_here_(stop_here), threads_(threads), run_(run_of(folder_)) {
    complete_ = run_.value("state", json()) == "complete";
    if (complete_) {
      auto files = store::manifest_from(run_.value("files", json()));
      if (!files) throw store::DamagedData(folder_.string() + ": run.json does not list its files");
      files_ = *std::move(files);
    }
    std::error_code error;
    if (!std::filesystem::exists(folder_ / "input.resolved.json", error))
      throw InputError(folder_.string() + ": the study in it has no input.resolved.json");
    require_unchanged({"input.resolved.json"});
    input_ = input::load_input(folder_ / "input.resolved.json");
  }

  json report() {
    describe_study();
    add_points();
    add_tables();
    add_modes();
    add_section();
    add_multipliers();
    add_summaries();
    if (tables_.empty())
      throw InputError(folder_.string() + (complete_ ? ": the study in it has no table"
                                                     : ": the study in it is not complete, and nothing of it can be "
                                                       "shown yet; re-run its command first"));
    for (const ReportTable& table : tables_) {
      study_["tables"].push_back(table.to_json());
      if (const auto left_out = table.to_json().find("left_out"); left_out != table.to_json().end())
        leave_out(fmt::format("{} of {}: they would make this file too large",
                              counted(left_out->size(), "columns", "column"),
                              table.to_json()["name"].get<std::string>()));
    }
    return std::move(study_);
  }

 private:
  void leave_out(const std::string& text) { study_["left_out"].push_back(text); }

  void require_unchanged(const std::vector<std::string>& names) const {
    store::Manifest needed;
    for (const std::string& name : names)
      if (const auto file = files_.find(name); file != files_.end()) needed.insert(*file);
    app::require_unchanged(folder_, needed);
  }

  void describe_study() {
    const input::Study& study = input_.study;
    const std::string kind = study.has_dynamics() ? std::string(study.kind()) : "gear";
    study_ = {
        {"folder", folder_.string()},
        {"label", folder_.filename().empty() ? folder_.parent_path().filename().string() : folder_.filename().string()},
        {"kind", kind},
        {"title", study.name.empty() ? study.stage.name : study.name},
        {"note",
         input_.resolved.value("note", json("")).is_string() ? input_.resolved.value("note", json("")) : json("")},
        {"command", own_command(kind)},
        {"warnings", input::warnings(input_)},
        {"input", InputList().of(input_.resolved)},
        {"tables", json::array()},
        {"left_out", json::array()}};
    json run = json::object();
    for (const char* fact : {"state", "identity", "version", "commit", "simd", "dependencies", "started", "ended"})
      if (run_.contains(fact)) run[fact] = run_[fact];
    study_["run"] = std::move(run);
    describe_axes();
    describe_tolerance();
    describe_symbols();
    describe_drawing();
    if (!complete_) study_["progress"] = "no point is finished";
    leave_out("Figures as PNG and SVG, the journal and results.h5: they are in the folder of the study.");
  }

  /// Empty of a kind that several commands compute.
  [[nodiscard]] std::string own_command(const std::string& kind) const {
    if (input_.study.has_dynamics() && !input_.study.plan.kind()->commands.empty()) return {};
    return fmt::format("epicyclic {} {} -o NEW_FOLDER", kind, shell_word((folder_ / "input.resolved.json").string()));
  }

  void describe_axes() {
    const input::Study& study = input_.study;
    std::string lead = study.stage.name.empty() ? "" : "Stage: " + study.stage.name + ". ";
    std::vector<studies::Axis> axes;
    if (study.has_dynamics())
      for (const auto& varied : input::varied_parameters(study)) axes.push_back(varied.axis);
    std::vector<json> parameters;
    for (const studies::Axis& axis : axes) parameters.push_back(parameter_json(axis.name));
    if (const auto* basins = study.plan.get_if<studies::BasinsOptions>()) {
      axes = {basins->plane.first, basins->plane.second};
      parameters = {component_json(axes[0].name), component_json(axes[1].name)};
    }
    for (std::size_t k = 0; k < axes.size(); ++k)
      lead += fmt::format(
          "{} from {} to {}{}. ", parameters[k]["label"].get<std::string>(), short_text(axes[k].from, 6),
          short_text(axes[k].to, 6),
          axes[k].points > 1 && study.kind() != "continue" ? fmt::format(", {} values", axes[k].points) : "");
    const auto* ramp = study.plan.get_if<studies::RampOptions>();
    if (ramp != nullptr) {
      const auto course = studies::ramp_course(*ramp, study.stage, model::scales_of(study.stage));
      lead += fmt::format("Mesh frequency ratio Ω from {} to {} by {} per unit of τ. ", short_text(course.from, 6),
                          short_text(course.to, 6), short_text(course.rate, 6));
    }
    if (const std::string directions = directions_of(study); !directions.empty())
      lead += "Direction: " + directions + ". ";
    if (study.has_dynamics() && axes.empty() && ramp == nullptr)
      lead += "Mesh frequency ratio Ω = " + short_text(study.mesh_frequency_ratio, 8) + ". ";
    lead += "Boundary: " + boundary_words(study.stage.boundary) + ".";
    study_["lead"] = lead;
    study_["parameter"] = parameters.empty()
                              ? json({{"name", ""}, {"label", ""}, {"symbol", ""}, {"unit", ""}, {"is_speed", false}})
                              : parameters.front();
    if (parameters.size() > 1) study_["second_parameter"] = parameters[1];
  }

  static std::string directions_of(const input::Study& study) {
    std::vector<studies::Direction> directions;
    if (const auto* sweep = study.plan.get_if<studies::SweepOptions>()) directions = sweep->directions;
    if (const auto* map = study.plan.get_if<studies::MapOptions>()) directions = map->directions;
    if (const auto* ramp = study.plan.get_if<studies::RampOptions>()) directions = ramp->directions;
    std::string words;
    for (const studies::Direction direction : directions)
      words += (words.empty() ? "" : " and ") + store::direction_word(direction);
    return words;
  }

  static std::string boundary_words(gear::Boundary boundary) {
    if (boundary == gear::Boundary::pair) return "none: a lone pair of gears";
    if (boundary == gear::Boundary::as_printed) return "as printed (the equations as the paper prints them)";
    if (boundary == gear::Boundary::fixed_sun) return "fixed sun";
    if (boundary == gear::Boundary::free) return "free (no member is held)";
    return boundary == gear::Boundary::star ? "star (the carrier is held)" : "fixed ring";
  }

  void describe_tolerance() {
    const input::Study& study = input_.study;
    json rows = json::array();
    if (study.has_dynamics()) {
      const integrate::IntegratorOptions& integrator = study.integrator;
      rows.push_back({"Method of integration", integrator.method});
      rows.push_back({"Tolerances", fmt::format("relative {}, absolute {} (b_c, b_c per τ)",
                                                short_text(integrator.relative_tolerance, 6),
                                                short_text(integrator.absolute_tolerance, 6))});
    }
    if (study.has_points()) {
      const studies::RecordingOptions& recording = study.recording();
      rows.push_back({"Mesh periods", fmt::format("{}{} recorded, at most {} to classify the regime",
                                                  recording.transient == studies::Transient::fixed
                                                      ? fmt::format("{} of transient, ", recording.transient_periods)
                                                      : std::string("transient of its own length, "),
                                                  recording.recorded_periods, recording.classification_periods)});
    }
    study_["tolerance"] = std::move(rows);
  }

  /// What a drawing of the stage needs: radii of base circles, in centre distances, and angles of the planets [deg].
  void describe_drawing() {
    const gear::Stage& stage = input_.study.stage;
    const auto& sun = stage.sun.base_radius_mm;
    const auto& planet = stage.planet.base_radius_mm;
    const auto& ring = stage.ring.base_radius_mm;
    if (!sun || !planet || !ring || !stage.centre_distance_mm) return;
    const double a = *stage.centre_distance_mm;
    study_["drawing"] = {
        {"sun", *sun / a}, {"planet", *planet / a}, {"ring", *ring / a}, {"angles_deg", stage.planet_angles_deg()}};
  }

  void describe_symbols() {
    study_["symbols"] = json::array({
        {"b_c", fmt::format("unit of length, {} µm", short_text(micrometres_per_length_scale(), 6))},
        {"τ", "dimensionless time: time multiplied by ω_sn"},
        {"ω_sn", "frequency that makes the time dimensionless"},
        {"Ω", "mesh frequency over ω_sn"},
        {"δ_sp,i", "deflection of the mesh of the sun and planet i; δ_rp,i of the ring and planet i"},
        {"λ_1", "largest Lyapunov exponent, per τ; positive: chaotic"},
        {"μ", "Floquet multiplier of a periodic orbit; stable: no modulus is above 1"},
        {"±", "error bound of a value; of an exponent half of its 95 % interval"},
        {"period n", "the orbit repeats after n mesh periods"},
        {"drive, loss, back", "contact on the drive flank, no contact, contact on the back flank"},
    });
  }

  // ---- tables -----------------------------------------------------------------------------------------------------

  /// @param cells  of each column
  void add_table(const std::string& name, const std::vector<ReportColumn>& columns,
                 const std::vector<std::vector<std::string>>& cells) {
    const std::size_t rows = cells.empty() ? 0 : cells.front().size();
    ReportTable table(name, title_of_table(name), rows);
    std::set<std::string> kept_exact = {"value", "second_value", "error_bound", "frequency", "amplitude"};
    for (std::size_t k = 0; k < columns.size(); ++k) {
      stop_here_();
      std::vector<double> numbers;
      numbers.reserve(rows);
      bool is_numeric = true;
      bool any = false;
      for (const std::string& cell : cells[k]) {
        double value = nan;
        const auto read = std::from_chars(cell.data(), cell.data() + cell.size(), value);
        if (!cell.empty() && (read.ec != std::errc() || read.ptr != cell.data() + cell.size())) is_numeric = false;
        any = any || !cell.empty();
        numbers.push_back(value);
      }
      const std::size_t width = rows <= exact_rows_max ? 8 : 2;
      if (table_bytes_ + width * rows > table_bytes_max) {
        table.leave_out(columns[k].name);
        continue;
      }
      table_bytes_ += width * rows;
      if (!is_numeric || (!any && columns[k].unit.empty())) {
        json column = data_.words(columns[k], cells[k]);
        if (column.is_null())
          table.leave_out(columns[k].name);
        else
          table.add(std::move(column));
        continue;
      }
      const auto form = are_counts(numbers)                                              ? ReportData::Form::uint32
                        : rows <= exact_rows_max || kept_exact.contains(columns[k].name) ? ReportData::Form::float64
                                                                                         : ReportData::Form::quantised;
      if (form == ReportData::Form::quantised) any_quantised_ = true;
      table.add(data_.numbers(columns[k], numbers, form));
    }
    tables_.push_back(std::move(table));
  }

  void add_csv(const std::string& name, const std::string& text) {
    const Described known = described_columns(name);
    std::vector<ReportColumn> columns;
    std::vector<std::vector<std::string>> cells;
    const bool is_table = scan_csv(text, [&](std::vector<std::string>& row) {
      if (columns.empty()) {
        for (const std::string& column : row) columns.push_back(described(known, name, column));
        cells.resize(columns.size());
        return;
      }
      for (std::size_t k = 0; k < row.size(); ++k) cells[k].push_back(std::move(row[k]));
    });
    if (!is_table) throw store::DamagedData((folder_ / name).string() + ": is not a table that this program writes");
    add_table(name, columns, cells);
  }

  [[nodiscard]] std::string text_of(const std::string& name) const {
    const std::filesystem::path file = folder_ / name;
    const FileDescriptor descriptor = open_descriptor(file, O_RDONLY);
    if (!descriptor.is_open()) throw_output_error(file, "open the file", errno);
    return read_all(descriptor.get(), file);
  }

  /// Points of a study that keeps them in a journal.
  [[nodiscard]] bool has_journal() const {
    const input::StudyKind* kind = input_.study.plan.kind();
    std::error_code error;
    return kind != nullptr && kind->points_kept == input::PointsKept::journal &&
           std::filesystem::exists(folder_ / "journal.bin", error);
  }

  /// Of a study that is not complete the table of its points comes from the journal.
  void add_points() {
    if (!has_journal()) return;
    const studies::SweepPlan plan = input::plan_of(input_.study);
    store_ = std::make_unique<store::PointStore>(folder_, run_["identity"].get<std::string>(), plan.points.size(),
                                                 store::Journal::Use::read);
    for (std::size_t point = 0; point < plan.points.size(); ++point)
      if (store_->holds(point)) points_.push_back(point);
    if (complete_ && points_.size() != plan.points.size())
      throw store::DamagedData(
          folder_.string() +
          ": its journal does not have all points; re-run the command of this study to compute them");
    if (complete_) return;
    study_["progress"] = fmt::format("{} of {} are finished", points_.size(), counted(plan.points.size(), "points"));
    if (points_.empty()) return;
    std::vector<store::PointColumn> more;
    if (study_.contains("second_parameter"))
      more.push_back({"second_value", "", "of the second axis",
                      store::PointColumn::Getter<double>([](const auto& r) { return r.point.second_value; })});
    const auto columns = store::point_columns_like(store_->read_summary(points_.front()), more);
    std::vector<std::string> names;
    for (const auto& column : columns) names.push_back(column.name);
    CsvWriter csv(names);
    for (const std::size_t point : points_) {
      stop_here_();
      const studies::PointSummary summary = store_->read_summary(point);
      for (const auto& column : columns) std::visit([&](const auto& value) { csv.cell(value(summary)); }, column.value);
      csv.end_row();
    }
    add_csv("points.csv", csv.text());
  }

  void add_tables() {
    std::vector<std::string> names;
    for (const auto& [name, facts] : files_)
      if (facts && name.ends_with(".csv") && name.find('/') == std::string::npos && name != "poincare.csv")
        names.push_back(name);
    // What is drawn comes before what is only listed.
    constexpr std::array<std::string_view, 5> drawn = {"points.csv", "branch.csv", "special.csv", "attractors.csv",
                                                       "history.csv"};
    std::ranges::stable_sort(names, {},
                             [&](const std::string& name) { return std::ranges::find(drawn, name) - drawn.begin(); });
    require_unchanged(names);
    for (const std::string& name : names) {
      stop_here_();
      add_csv(name, text_of(name));
    }
    if (any_quantised_)
      leave_out(
          fmt::format("Digits: in tables of more than {} rows a number is kept to 1/65534 of the range of its column.",
                      exact_rows_max));
  }

  /// `gear` has them as tables.
  void add_modes() {
    if (!complete_ || !input_.study.has_dynamics() || input_.study.kind() != "run") return;
    add_csv("modes.csv", reports::modes_table(input_));
    add_csv("mode_shapes.csv", reports::mode_shapes_table(input_));
  }

  /// Of orbits of branches, a row for each row of branch.csv.
  void add_multipliers() {
    if (!input_.study.has_dynamics() || input_.study.kind() != "continue" || !files_.contains("results.h5")) return;
    require_unchanged({"results.h5"});
    const store::Hdf5Dataset real = store::read_hdf5(folder_ / "results.h5", "/multipliers/real");
    const store::Hdf5Dataset imaginary = store::read_hdf5(folder_ / "results.h5", "/multipliers/imaginary");
    if (real.shape.size() != 2 || imaginary.shape != real.shape || real.values.empty()) return;
    if (2 * sizeof(double) * real.values.size() > multiplier_bytes_max) {
      leave_out("Multipliers of the orbits but the largest: results.h5 has them.");
      return;
    }
    ReportTable table("multipliers", "", real.values.size());
    table.add(data_.numbers({"real", "1", ""}, real.values, ReportData::Form::float64));
    table.add(data_.numbers({"imaginary", "1", ""}, imaginary.values, ReportData::Form::float64));
    tables_.push_back(std::move(table));
    study_["multipliers_of_orbit"] = real.shape[1];
  }

  /// Pages in words that the command has written.
  void add_summaries() {
    json all = json::array();
    for (const auto& [name, facts] : files_) {
      if (!facts || !name.ends_with(".md") || name.find('/') != std::string::npos) continue;
      require_unchanged({name});
      std::string text = text_of(name);
      if (text.size() > summary_bytes_max)
        leave_out(name + ": it is too long");
      else
        all.push_back({{"name", name}, {"text", std::move(text)}});
    }
    // The results of the study itself come first.
    const std::string own = std::string(input_.study.kind()) + ".md";
    std::stable_partition(all.begin(), all.end(), [&](const json& one) { return one["name"] == own; });
    if (!all.empty()) study_["summaries"] = std::move(all);
  }

  // ---- Poincaré sections --------------------------------------------------------------------------------------------

  /// Rows of the section, column by column, and where those of each point begin.
  struct Section {
    std::vector<std::string> names;
    std::vector<std::vector<double>> columns;
    std::vector<double> starts{0.0};
  };

  void add_section() {
    const std::string_view kind = input_.study.has_dynamics() ? input_.study.kind() : "gear";
    Section section;
    if (kind == "sweep" && store_ && !points_.empty())
      section = section_of_sweep();
    else if (kind != "sweep" && files_.contains("poincare.csv"))
      section = section_of_table();
    if (kind == "sweep" && !store_) leave_out("Poincaré points and spectra: the journal of the study is missing.");
    if (section.columns.empty() || section.columns.front().empty()) return;
    const std::size_t rows = section.columns.front().size();
    ReportTable table("section", "Poincaré points", rows);
    const std::vector<bool> kept = kept_columns(section.names, rows, SweepRecordLimits().section);
    for (std::size_t k = 0; k < section.names.size(); ++k)
      if (kept[k])
        table.add(data_.numbers(section_column(section.names[k]), section.columns[k], ReportData::Form::quantised));
    const auto left = static_cast<std::size_t>(std::ranges::count(kept, false));
    tables_.push_back(std::move(table));
    ReportTable starts("section_starts", "", section.starts.size());
    starts.add(data_.numbers({"start", "1", ""}, section.starts, ReportData::Form::uint32));
    tables_.push_back(std::move(starts));
    leave_out(
        "Digits of the Poincaré points: each is kept to 1/65534 of the range of its column. poincare.csv has all.");
    leave_out(kind == "run"
                  ? "Poincaré points of quantities that the section above does not offer: poincare.csv has them."
                  : "Components of the state at the Poincaré points: poincare.csv has them.");
    if (left > 0)
      leave_out(fmt::format("{} of the Poincaré section: they would make this file too large",
                            counted(left, "columns", "column")));
  }

  using Histories = std::array<std::vector<double>, studies::ShortHistory::names.size()>;

  void add_histories(const SweepRecords& records) {
    if (!records.any_history) return;
    add_history_table(records.histories);
    leave_out(fmt::format(
        "Histories of more than {} mesh periods, and of meshes of other planets: `epicyclic run --from` computes them.",
        SweepRecords::periods));
    if (records.points_of_histories < records.points())
      leave_out(fmt::format("Histories behind the first {}: they would make this file too large.",
                            counted(records.points_of_histories, "points", "point")));
  }

  void add_history_table(const Histories& histories) {
    ReportTable table("histories", "", histories.front().size());
    for (std::size_t k = 0; k < histories.size(); ++k) {
      const std::string name(studies::ShortHistory::names[k]);
      if (input_.study.stage.is_pair() && name.find("_rp_") != std::string::npos) continue;
      ReportColumn column = section_column(name);
      if (name.starts_with("force_"))
        column = {name, "N",
                  fmt::format("force of {} mesh 1", name.starts_with("force_sp") ? "sun-planet" : "ring-planet")};
      table.add(data_.numbers(column, histories[k], ReportData::Form::quantised));
    }
    tables_.push_back(std::move(table));
    study_["history"] = {{"periods", SweepRecords::periods}, {"phases", SweepRecords::phases}};
  }

  /// Of orbits of branches, from their first states, in the order of branch.csv.
  void add_orbit_histories(const std::vector<std::vector<double>>& states) {
    if (states.empty() || identity_of(input_, "continue") != run_["identity"].get<std::string>()) return;
    std::vector<double> values;
    std::size_t at = std::string::npos;
    if (!scan_csv(text_of("branch.csv"), [&](std::vector<std::string>& cells) {
          if (at == std::string::npos) {
            at = static_cast<std::size_t>(std::ranges::find(cells, "value") - cells.begin());
            return;
          }
          double value = nan;
          if (at < cells.size()) std::from_chars(cells[at].data(), cells[at].data() + cells[at].size(), value);
          values.push_back(value);
        }))
      return;
    const studies::ModelAt model_at = input::model_at(input_);
    Histories histories;
    const std::size_t most = SweepRecordLimits().histories / (2 * SweepRecords::history_rows * histories.size());
    for (std::size_t k = 0; k < std::min({states.size(), values.size(), most}); ++k) {
      stop_here_();
      std::optional<studies::ShortHistory> history;
      try {
        const model::DynamicModel model = model_at(values[k]);
        if (states[k].size() >= model.dimension)
          history = studies::short_history(model, std::span(states[k]).first(model.dimension), input_.study.integrator,
                                           SweepRecords::periods, SweepRecords::phases);
      } catch (const SolverError&) {
        history.reset();
      }
      for (std::size_t j = 0; j < histories.size(); ++j) {
        if (history) histories[j].insert(histories[j].end(), history->columns[j].begin(), history->columns[j].end());
        histories[j].resize((k + 1) * SweepRecords::history_rows, nan);
      }
    }
    if (histories.front().empty()) return;
    add_history_table(histories);
    if (states.size() > most)
      leave_out(fmt::format("Histories of orbits behind the first {}: they would make this file too large.", most));
  }

  void add_spectra(const SweepRecords& records) {
    if (records.orders == 0) return;
    ReportTable table("spectra", "", records.spectra.size());
    table.add(data_.numbers({"log10_amplitude", "1", ""}, records.spectra, ReportData::Form::quantised));
    tables_.push_back(std::move(table));
    study_["spectrum"] = {
        {"orders", records.orders}, {"resolution", records.resolution}, {"periods", studies::spectrum_periods}};
    if (records.points_of_spectra < records.points())
      leave_out(fmt::format("Spectra behind the first {}: they would make this file too large.",
                            counted(records.points_of_spectra, "points", "point")));
  }

  Section section_of_sweep() {
    const bool same = identity_of(input_, input_.study.kind()) == run_["identity"].get<std::string>();
    const studies::SweepPlan plan = input::plan_of(input_.study);
    std::function<model::DynamicModel(std::size_t)> model_at;
    if (same) {
      const studies::ModelAtPoint model_of = input::model_at_point(input_);
      model_at = [&plan, model_of](std::size_t point) { return model_of(plan.points[point]); };
      if (complete_) add_changes(model_of);
    } else
      leave_out("Rates at the Poincaré points, and histories: another version of the numerics computed this study.");
    SweepRecords records = sweep_records(
        points_, [this](std::size_t point) { return store_->read(point); }, model_at, input_.study.integrator,
        stop_here_);
    add_spectra(records);
    add_histories(records);
    if (static_cast<std::size_t>(input_.study.recording().recorded_periods) > records.rows_of_a_point)
      leave_out(fmt::format("Poincaré points behind the first {} of each point of the sweep: poincare.csv has them.",
                            records.rows_of_a_point));
    return {std::move(records.names), std::move(records.section), std::move(records.starts)};
  }

  /// Multipliers of the periodic orbits beside changes of the regime.
  void add_changes(const studies::ModelAtPoint& model_at) {
    std::vector<studies::PointSummary> points;
    for (const std::size_t point : points_) {
      studies::PointSummary summary = store_->read_summary(point);
      if (summary.orbit.empty() && summary.period > 0)
        summary.orbit = studies::state_on(store_->read(point), model_at(summary.point).dimension);
      points.push_back(std::move(summary));
    }
    const ChangeMultipliers changes =
        change_multipliers(points, model_at, input_.study.integrator, stop_here_, threads_);
    if (changes.left_out > 0)
      leave_out(fmt::format("Multipliers at {}: the orbits are too long.",
                            counted(changes.left_out, "changes of the regime", "change of the regime")));
    if (changes.columns.front().empty()) return;
    ReportTable table("change_multipliers", "", changes.columns.front().size());
    for (std::size_t k = 0; k < changes.columns.size(); ++k)
      table.add(data_.numbers({std::string(ChangeMultipliers::names[k]), "1", ""}, changes.columns[k],
                              ReportData::Form::float64));
    tables_.push_back(std::move(table));
  }

  /// Of one operating point all columns, of branches the deflections.
  Section section_of_table() {
    require_unchanged({"poincare.csv"});
    const bool branches = input_.study.kind() == "continue";
    Section section;
    std::vector<std::size_t> at;
    std::string orbit;
    std::optional<model::DynamicModel> model;
    if (input_.study.kind() == "run" && identity_of(input_, "run") == run_["identity"].get<std::string>())
      model = input::model_at(input_)(input_.study.mesh_frequency_ratio);
    const std::size_t keys = branches ? 3 : 2;  // branch, index, crossing; or point, index
    std::vector<std::vector<double>> states;    // of branches: the first of each orbit
    const bool is_table = scan_csv(text_of("poincare.csv"), [&](std::vector<std::string>& cells) {
      if (at.empty()) {
        for (std::size_t k = 0; k < cells.size(); ++k)
          if (cells[k].starts_with("delta_") || (!branches && k >= keys)) {
            at.push_back(k);
            section.names.push_back(cells[k]);
          }
        if (model && cells.size() < keys + model->dimension) model.reset();
        if (model) section.names.emplace_back("delta_sp_1_rate");
        if (model && model->has_ring()) section.names.emplace_back("delta_rp_1_rate");
        section.columns.resize(section.names.size());
        return;
      }
      const std::string of = branches ? cells[0] + ":" + cells[1] : cells[0];
      const bool is_first = of != orbit;
      if (of != orbit && !orbit.empty()) section.starts.push_back(static_cast<double>(section.columns.front().size()));
      orbit = of;
      const auto number = [&](std::size_t k) {
        double value = nan;
        std::from_chars(cells[k].data(), cells[k].data() + cells[k].size(), value);
        return value;
      };
      for (std::size_t k = 0; k < at.size(); ++k) section.columns[k].push_back(number(at[k]));
      if (branches && is_first) {
        std::vector<double>& state = states.emplace_back();
        for (std::size_t k = keys; k < at.front(); ++k) state.push_back(number(k));
      }
      if (!model) return;
      std::vector<double> state;
      for (std::size_t k = 0; k < model->dimension; ++k) state.push_back(number(keys + k));
      model::MeshDeflections d;
      model->deflections(0.0, state.data(), d);
      section.columns[at.size()].push_back(d.sun_planet_rate.front());
      if (model->has_ring()) section.columns[at.size() + 1].push_back(d.ring_planet_rate.front());
    });
    if (!is_table)
      throw store::DamagedData((folder_ / "poincare.csv").string() + ": is not a table that this program writes");
    if (!section.columns.empty()) section.starts.push_back(static_cast<double>(section.columns.front().size()));
    if (branches) add_orbit_histories(states);
    return section;
  }

  std::filesystem::path folder_;
  ReportData& data_;
  const std::function<void()>& stop_here_;
  int threads_;
  json run_;
  bool complete_ = false;
  store::Manifest files_;
  input::LoadedInput input_;
  std::unique_ptr<store::PointStore> store_;
  std::vector<std::size_t> points_;  ///< that are finished
  std::vector<ReportTable> tables_;
  std::size_t table_bytes_ = 0;
  bool any_quantised_ = false;
  json study_;
};

}  // namespace

nlohmann::json run_of(const std::filesystem::path& folder) {
  std::error_code error;
  if (!std::filesystem::is_directory(folder, error)) throw InputError(folder.string() + ": is not a folder");
  if (!std::filesystem::exists(folder / "run.json", error))
    throw InputError(folder.string() + ": contains no study of this program (no run.json)");
  const input::JsonSource run = input::read_json_file(folder / "run.json");
  if (!run.complete || !run.value.is_object() || !run.value.value("identity", json()).is_string())
    throw InputError(folder.string() + ": contains no study of this program (no valid run.json)");
  return run.value;
}

double micrometres_per_length_scale() { return 1e6 * model::length_scale_m; }

json study_report(const std::filesystem::path& folder, ReportData& data, const std::function<void()>& stop_here,
                  int threads) {
  return StudyReport(folder, data, stop_here, threads).report();
}

}  // namespace epicyclic::app
