#include "reports/sweep_output.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <type_traits>
#include <utility>

#include <fmt/format.h>

#include "core/csv.hpp"
#include "figures/bifurcation_figure.hpp"
#include "store/hdf5_file.hpp"

namespace epicyclic::reports {

namespace {

using studies::Direction;
using studies::MeshRecord;
using studies::PointResult;

bool ok(const PointResult& r) { return r.outcome == integrate::Outcome::reached; }

/// Periodic by an orbit and its multipliers.
bool proven(const PointResult& r) { return ok(r) && r.classified && r.regime == analysis::Regime::periodic; }

/// K of the 0-1 test; none where it was not asked.
double zero_one(const PointResult& r) { return r.evidence.zero_one.value_or(std::numeric_limits<double>::quiet_NaN()); }

/// The rows of all Poincare sections one after another.
class SectionRows {
 public:
  explicit SectionRows(const studies::PointSource& points) {
    for (std::size_t i = 0; i < points.count; ++i) {
      rows_.push_back(static_cast<std::uint32_t>(points.read(i).poincare_rows()));
      count_ += rows_.back();
    }
  }

  [[nodiscard]] std::size_t count() const { return count_; }

  /// Point and index of a row; quick in the order of rows.
  std::pair<std::size_t, std::size_t> at(std::size_t row) {
    if (row < first_) first_ = point_ = 0;
    while (row - first_ >= rows_[point_]) first_ += rows_[point_++];
    return {point_, row - first_};
  }

 private:
  std::vector<std::uint32_t> rows_;  ///< by point
  std::size_t count_ = 0;
  std::size_t point_ = 0, first_ = 0;  ///< last asked for, and its first row
};

/// Extrema that were never seen are empty cells.
double seen(double x) { return std::isfinite(x) ? x : std::numeric_limits<double>::quiet_NaN(); }

/// Which direction the regimes of a figure are of; 0 for the diagrams of both.
std::size_t direction_of(SweepFigure figure) { return figure == SweepFigure::regimes_second ? 1 : 0; }

bool shows_regimes(SweepFigure figure) {
  return figure == SweepFigure::regimes_first || figure == SweepFigure::regimes_second;
}

/// File name without its ending; nothing if the study has no such figure.
std::optional<std::string> stem_of(const SweepOutput& output, SweepFigure figure) {
  if (figure == SweepFigure::delta_sp) return "bifurcation_delta_sp";
  if (figure == SweepFigure::delta_rp) return "bifurcation_delta_rp";
  const std::size_t direction = direction_of(figure);
  if (output.sweep.classification_periods == 0 || direction >= output.sweep.directions.size()) return std::nullopt;
  return "regimes_delta_sp_" + direction_word(output.sweep.directions[direction]);
}

/// Of the Poincare section.
const char* column_of(SweepFigure figure) { return figure == SweepFigure::delta_rp ? "delta_rp_1" : "delta_sp_1"; }

figures::FigureText text_of(const SweepOutput& output, SweepFigure figure) {
  figures::FigureText text{
      figures::literal_text(output.title), parameter_label(output.sweep.parameter),
      fmt::format("Poincaré points of  δ_{{{}}} / b_c", figure == SweepFigure::delta_rp ? "rp" : "sp")};
  if (shows_regimes(figure)) text.title += ", " + direction_word(output.sweep.directions[direction_of(figure)]);
  return text;
}

/// Points are numbered along the first direction, then the second.
std::size_t points_each_way(const SweepOutput& output, const studies::PointSource& points) {
  return points.count / output.sweep.directions.size();
}

/// Distinct in print, in grey and for colour-blind eyes (after Okabe and Ito). A multiplier's logarithm has intervals
/// far wider than what is looked at where it is next to nothing.
const std::vector<figures::PointClass>& classes() {
  static const std::vector<figures::PointClass> all = {{"period 1", "#12285c", false},
                                                       {"period 2 and more", "#3f8fd0", false},
                                                       {"quasiperiodic", "#1b8a6b"},
                                                       {"chaotic", "#c8553d"},
                                                       {"undecided", "#8a8a8a"}};
  return all;
}

std::size_t class_of(const PointResult& r) {
  switch (r.regime) {
    case analysis::Regime::periodic:
      return r.period <= 1 ? 0 : 1;
    case analysis::Regime::quasiperiodic:
      return 2;
    case analysis::Regime::chaotic:
      return 3;
    case analysis::Regime::undecided:
      break;
  }
  return 4;
}

/// Points along one direction as a figure takes them; `points` must live longer.
auto section(const SweepOutput& output, const studies::PointSource& points, std::size_t direction, SweepFigure figure) {
  const auto& columns = output.poincare_columns;
  const auto column =
      static_cast<std::size_t>(std::find(columns.begin(), columns.end(), column_of(figure)) - columns.begin());
  return [&points, column,
          first = direction * points_each_way(output, points)](std::size_t i) -> std::optional<figures::ClassPoint> {
    const PointResult r = points.read(first + i);
    if (!ok(r)) return std::nullopt;
    const analysis::Estimate exponent = r.lyapunov_max();
    figures::ClassPoint p{{r.point.value, {}}, class_of(r), exponent.value, exponent.half_width};
    for (std::size_t k = 0; k < r.poincare_rows(); ++k)
      p.section.push_back(r.poincare[k * r.poincare_columns + column]);
    return p;
  };
}

struct ParameterText {
  const char *name, *words, *symbol, *unit;
};

/// @returns nullptr for a number of the input, which has no words of its own
const ParameterText* text_of(const std::string& parameter) {
  static constexpr std::array<ParameterText, 5> texts{
      {{"mesh_frequency_ratio", "Mesh frequency ratio", "Ω", " = ω_m / ω_{sn}"},
       {"damping_ratio", "Mesh damping ratio", "ζ", ""},
       {"sun_planet_backlash", "Half backlash of the sun-planet mesh", "b_{sp}", " / b_c"},
       {"ring_planet_backlash", "Half backlash of the ring-planet mesh", "b_{rp}", " / b_c"},
       {"sun_bearing_clearance", "Half clearance of the sun bearing", "b_s", " / b_c"}}};
  const auto* const found =
      std::ranges::find_if(texts, [&](const ParameterText& text) { return text.name == parameter; });
  return found == texts.end() ? nullptr : found;
}

}  // namespace

std::string direction_word(Direction direction) { return direction == Direction::up ? "up" : "down"; }

std::string regime_word(const PointResult& r) { return ok(r) ? to_string(r.regime) : ""; }

std::string parameter_label(const std::string& parameter) {
  const ParameterText* text = text_of(parameter);
  return text == nullptr ? figures::literal_text(parameter)
                         : fmt::format("{}  {}{}", text->words, text->symbol, text->unit);
}

std::string parameter_symbol(const std::string& parameter) {
  const ParameterText* text = text_of(parameter);
  return text == nullptr ? figures::literal_text(parameter) : text->symbol;
}

std::string figure_title(const input::Study& study) {
  const gear::Boundary b = study.stage.boundary;
  const char* boundary = b == gear::Boundary::literal ? "literal" : b == gear::Boundary::star ? "star" : "fixed ring";
  std::string title = (study.name.empty() ? study.stage.name : study.name) + ", boundary " + boundary;
  const bool speed_is_given = study.kind == "run" || study.kind == "basins";
  const bool speed_is_varied =
      study.sweep && (study.sweep->parameter == "mesh_frequency_ratio" ||
                      (study.kind == "map" && study.plane.second.name == "mesh_frequency_ratio"));
  if (speed_is_given || (study.sweep && !speed_is_varied)) {
    title += ", Ω = ";
    append_number(title, study.mesh_frequency_ratio);
  }
  return title;
}

std::string status_word(integrate::Outcome outcome) {
  switch (outcome) {
    case integrate::Outcome::reached:
      return "ok";
    case integrate::Outcome::diverged:
      return "diverged";
    case integrate::Outcome::step_limit:
      return "step_limit";
    case integrate::Outcome::failed:
      return "failed";
  }
  return "failed";
}

void write_points_csv(const std::filesystem::path& file, const studies::PointSource& points,
                      const std::vector<PointColumn>& more) {
  std::vector<std::string> columns = {"point",
                                      "direction",
                                      "value",
                                      "status",
                                      "regime",
                                      "period",
                                      "lyapunov_max",
                                      "delta_sp_min",
                                      "delta_sp_max",
                                      "delta_rp_min",
                                      "delta_rp_max",
                                      "contact_sp",
                                      "contact_rp",
                                      "rhs_evaluations",
                                      "recurrence_error",
                                      "recurrence_error_late",
                                      "planet_spread",
                                      "pull_sp",
                                      "pull_rp",
                                      "pull_time_sp",
                                      "pull_time_rp",
                                      "lyapunov_max_error",
                                      "multiplier_max",
                                      "multiplier_error",
                                      "orbit_residual",
                                      "orbit_error",
                                      "zero_one",
                                      "classified_periods",
                                      "evidence"};
  for (std::size_t k = 0; k < more.size(); ++k)
    columns.insert(columns.begin() + 3 + static_cast<std::ptrdiff_t>(k), more[k].name);
  const std::size_t planets = points.count == 0 ? 0 : points.read_brief(0).sun_planet.size();
  for (const char* mesh : {"sp", "rp"})
    for (std::size_t i = 1; i <= planets; ++i) {
      const std::string name = std::string(mesh) + "_" + std::to_string(i);
      columns.push_back("delta_" + name + "_min");
      columns.push_back("delta_" + name + "_max");
      columns.push_back("contact_" + name);
    }
  columns.emplace_back("message");
  CsvWriter csv(file, columns);
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t i = 0; i < points.count; ++i) {
    const PointResult r = points.read_brief(i);
    const MeshRecord& sp = r.sun_planet.front();
    const MeshRecord& rp = r.ring_planet.front();
    csv.cell(r.point.index).cell(direction_word(r.point.direction)).cell(r.point.value);
    for (const PointColumn& column : more) csv.cell(column.value(r));
    csv.cell(status_word(r.outcome))
        .cell(regime_word(r))
        .cell(ok(r) ? r.period : 0)
        .cell(r.lyapunov_max().value)
        .cell(seen(sp.delta_min))
        .cell(seen(sp.delta_max))
        .cell(seen(rp.delta_min))
        .cell(seen(rp.delta_max))
        .cell(sp.contact())
        .cell(rp.contact())
        .cell(r.rhs_evaluations)
        .cell(ok(r) ? seen(r.recurrence.error) : unknown)
        .cell(ok(r) ? r.recurrence.late_error : unknown)
        .cell(r.planet_spread)
        .cell(PointResult::pull(r.sun_planet))
        .cell(PointResult::pull(r.ring_planet))
        .cell(PointResult::pull_time(r.sun_planet))
        .cell(PointResult::pull_time(r.ring_planet))
        .cell(r.lyapunov_max().half_width)
        .cell(proven(r) ? r.evidence.largest_multiplier : unknown)
        .cell(proven(r) ? r.evidence.multiplier_error : unknown)
        .cell(proven(r) ? r.evidence.residual : unknown)
        .cell(proven(r) ? r.evidence.orbit_error : unknown)
        .cell(zero_one(r))
        .cell(r.evidence.periods)
        .cell(r.evidence.note);
    for (const auto* meshes : {&r.sun_planet, &r.ring_planet})
      for (const MeshRecord& m : *meshes) csv.cell(seen(m.delta_min)).cell(seen(m.delta_max)).cell(m.contact());
    csv.cell(r.message);
    csv.end_row();
  }
  csv.commit();
}

void write_poincare_csv(const std::filesystem::path& file, const SweepOutput& output,
                        const studies::PointSource& points) {
  std::vector<std::string> columns = {"point", "index"};
  columns.insert(columns.end(), output.poincare_columns.begin(), output.poincare_columns.end());
  CsvWriter csv(file, columns);
  for (std::size_t i = 0; i < points.count; ++i) {
    const PointResult r = points.read(i);
    for (std::size_t k = 0; k < r.poincare_rows(); ++k) {
      csv.cell(r.point.index).cell(k);
      for (std::size_t j = 0; j < r.poincare_columns; ++j) csv.cell(r.poincare[k * r.poincare_columns + j]);
      csv.end_row();
    }
  }
  csv.commit();
}

void write_point_columns(store::Hdf5File& h5, const studies::PointSource& points) {
  h5.create_group("/points");
  const auto column = [&](const std::string& name, auto&& value, const char* units) {
    using Value = std::decay_t<decltype(value(std::declval<PointResult>()))>;
    // Column after column through the points: a row of all columns at once would need each column's chunk in memory.
    h5.write("/points/" + name, points.count,
             store::Hdf5File::Column<Value>([&](std::size_t row) { return value(points.read_brief(row)); }));
    if (units != nullptr) h5.set_units("/points/" + name, units);
  };
  const auto integer = [](auto x) { return static_cast<std::int64_t>(x); };
  column(
      "point", [&](const PointResult& r) { return integer(r.point.index); }, nullptr);
  column(
      "direction", [](const PointResult& r) { return std::string(direction_word(r.point.direction)); }, nullptr);
  column(
      "value", [](const PointResult& r) { return r.point.value; }, nullptr);
  column(
      "status", [](const PointResult& r) { return status_word(r.outcome); }, nullptr);
  column(
      "regime", [](const PointResult& r) { return std::string(regime_word(r)); }, nullptr);
  column(
      "period", [&](const PointResult& r) { return integer(ok(r) ? r.period : 0); }, "mesh periods");
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  column(
      "lyapunov_max", [](const PointResult& r) { return r.lyapunov_max().value; }, "1 per tau");
  column(
      "lyapunov_max_error", [](const PointResult& r) { return r.lyapunov_max().half_width; }, "1 per tau");
  column(
      "multiplier_max", [](const PointResult& r) { return proven(r) ? r.evidence.largest_multiplier : unknown; }, "1");
  column(
      "multiplier_error", [](const PointResult& r) { return proven(r) ? r.evidence.multiplier_error : unknown; }, "1");
  column(
      "orbit_residual", [](const PointResult& r) { return proven(r) ? r.evidence.residual : unknown; },
      "b_c, b_c per tau");
  column(
      "orbit_error", [](const PointResult& r) { return proven(r) ? r.evidence.orbit_error : unknown; },
      "b_c, b_c per tau");
  column("zero_one", zero_one, "1");
  column(
      "classified_periods", [&](const PointResult& r) { return integer(r.evidence.periods); }, "mesh periods");
  column(
      "evidence", [](const PointResult& r) { return r.evidence.note; }, nullptr);
  column(
      "recurrence_error",
      [](const PointResult& r) { return ok(r) ? seen(r.recurrence.error) : std::numeric_limits<double>::quiet_NaN(); },
      "b_c, b_c per tau");
  column(
      "planet_spread", [](const PointResult& r) { return r.planet_spread; }, "b_c");
  column(
      "pull_sp", [](const PointResult& r) { return PointResult::pull(r.sun_planet); }, "static mesh force");
  column(
      "pull_rp", [](const PointResult& r) { return PointResult::pull(r.ring_planet); }, "static mesh force");
  column(
      "pull_time_sp", [](const PointResult& r) { return PointResult::pull_time(r.sun_planet); }, "part of the time");
  column(
      "pull_time_rp", [](const PointResult& r) { return PointResult::pull_time(r.ring_planet); }, "part of the time");
  column(
      "rhs_evaluations", [&](const PointResult& r) { return integer(r.rhs_evaluations); }, "1");
  column(
      "message", [](const PointResult& r) { return r.message; }, nullptr);
  const std::size_t planets = points.count == 0 ? 0 : points.read_brief(0).sun_planet.size();
  for (std::size_t i = 0; i < planets; ++i) {
    const std::string planet = "_" + std::to_string(i + 1);
    column(
        "delta_sp" + planet + "_min", [i](const PointResult& r) { return seen(r.sun_planet[i].delta_min); }, "b_c");
    column(
        "delta_sp" + planet + "_max", [i](const PointResult& r) { return seen(r.sun_planet[i].delta_max); }, "b_c");
    column(
        "contact_sp" + planet, [i](const PointResult& r) { return r.sun_planet[i].contact(); }, nullptr);
    column(
        "delta_rp" + planet + "_min", [i](const PointResult& r) { return seen(r.ring_planet[i].delta_min); }, "b_c");
    column(
        "delta_rp" + planet + "_max", [i](const PointResult& r) { return seen(r.ring_planet[i].delta_max); }, "b_c");
    column(
        "contact_rp" + planet, [i](const PointResult& r) { return r.ring_planet[i].contact(); }, nullptr);
  }
}

void write_results_h5(const std::filesystem::path& file, const SweepOutput& output,
                      const studies::PointSource& points) {
  store::Hdf5File h5(file);
  h5.set_attribute("/", "input_resolved", output.resolved_input);
  h5.set_attribute("/", "sweep_parameter", output.sweep.parameter);

  write_point_columns(h5, points);

  h5.create_group("/poincare");
  SectionRows section(points);
  h5.write("/poincare/columns", std::span<const std::string>(output.poincare_columns));
  h5.write("/poincare/point", section.count(), store::Hdf5File::Column<std::int64_t>([&](std::size_t row) {
             return static_cast<std::int64_t>(section.at(row).first);
           }));
  h5.write("/poincare/index", section.count(), store::Hdf5File::Column<std::int64_t>([&](std::size_t row) {
             return static_cast<std::int64_t>(section.at(row).second);
           }));
  const std::size_t columns = output.poincare_columns.size();
  PointResult current;
  h5.write("/poincare/values", section.count(), columns, [&](std::size_t row, std::span<double> values) {
    const auto [point, k] = section.at(row);
    if (k == 0) current = points.read(point);
    std::copy_n(current.poincare.begin() + static_cast<std::ptrdiff_t>(k * columns), columns, values.begin());
  });
  h5.set_units("/poincare/values", "b_c, b_c per tau");
  h5.close();
}

std::optional<DrawnFigure> write_sweep_figure(const std::filesystem::path& folder, const SweepOutput& output,
                                              const studies::PointSource& points, SweepFigure figure) {
  const auto stem = stem_of(output, figure);
  if (!stem) return std::nullopt;
  const figures::FigureText text = text_of(output, figure);
  figures::FigureOutcome outcome;
  if (shows_regimes(figure)) {
    outcome = figures::class_bifurcation_figure(
        folder, *stem, text, "Exponent  λ_1 / ω_{sn}", classes(), points_each_way(output, points),
        section(output, points, direction_of(figure), figure), figures::Pictures::none);
  } else {
    std::vector<figures::BifurcationSeries> series;
    for (std::size_t d = 0; d < output.sweep.directions.size(); ++d)
      series.push_back({direction_word(output.sweep.directions[d]), points_each_way(output, points),
                        section(output, points, d, figure)});
    outcome = figures::bifurcation_figure(folder, *stem, text, series, {}, figures::Pictures::none);
  }
  if (outcome.drawn()) return std::nullopt;
  return DrawnFigure{folder / (*stem + ".png"), outcome};
}

std::optional<DrawnFigure> draw_sweep_picture(const std::filesystem::path& folder, const SweepOutput& output,
                                              SweepFigure figure, figures::Pictures picture) {
  const auto stem = stem_of(output, figure);
  if (!stem || !std::filesystem::exists(folder / (*stem + ".gp"))) return std::nullopt;
  return DrawnFigure{folder / (*stem + (picture == figures::Pictures::svg ? ".svg" : ".png")),
                     figures::draw_pictures(folder, *stem, picture)};
}

}  // namespace epicyclic::reports
