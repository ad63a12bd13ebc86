#include "reports/sweep_output.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "core/csv.hpp"
#include "core/text.hpp"
#include "figures/bifurcation_figure.hpp"
#include "figures/sketch.hpp"
#include "gear/kinematics.hpp"
#include "input/study_kind.hpp"
#include "reports/quantity_words.hpp"
#include "reports/response_output.hpp"
#include "reports/section_output.hpp"
#include "reports/table_output.hpp"
#include "store/hdf5_file.hpp"
#include "studies/named_parameters.hpp"

namespace epicyclic::reports {

namespace {

using studies::Direction;
using studies::PointResult;
using studies::PointSummary;

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
  std::size_t point_ = 0, first_ = 0;  ///< last requested, and its first row
};

/// The direction of a figure of one direction; nothing for other figures.
std::optional<std::size_t> direction_of(SweepFigure figure) {
  switch (figure) {
    case SweepFigure::regimes_first:
    case SweepFigure::waterfall_first:
      return 0;
    case SweepFigure::regimes_second:
    case SweepFigure::waterfall_second:
      return 1;
    default:
      return std::nullopt;
  }
}

bool shows_regimes(SweepFigure figure) {
  return figure == SweepFigure::regimes_first || figure == SweepFigure::regimes_second;
}

/// File name without its ending; nothing if the study has no such figure.
std::optional<std::string> stem_of(const SweepOutput& output, SweepFigure figure) {
  const auto direction = direction_of(figure);
  if (direction && *direction >= output.sweep.directions.size()) return std::nullopt;
  if (shows_regimes(figure) && output.sweep.recording.classification_periods == 0) return std::nullopt;
  const std::string of_direction =
      direction ? "_" + store::direction_word(output.sweep.directions[*direction]) : std::string();
  switch (figure) {
    case SweepFigure::delta_sp:
      return "bifurcation_delta_sp";
    case SweepFigure::delta_rp:
      return "bifurcation_delta_rp";
    case SweepFigure::regimes_first:
    case SweepFigure::regimes_second:
      return "regimes_delta_sp" + of_direction;
    case SweepFigure::response_sp:
      return "response_delta_sp";
    case SweepFigure::response_rp:
      return "response_delta_rp";
    case SweepFigure::dynamic_factor:
      return "dynamic_factor";
    case SweepFigure::kv:
      return "kv";
    case SweepFigure::load_sharing:
      return "load_sharing";
    case SweepFigure::load_sharing_max:
      return "load_sharing_max";
    case SweepFigure::waterfall_first:
    case SweepFigure::waterfall_second:
      return "waterfall_delta_sp" + of_direction;
  }
  return std::nullopt;
}

/// Of the Poincare section.
const char* column_of(SweepFigure figure) { return figure == SweepFigure::delta_rp ? "delta_rp_1" : "delta_sp_1"; }

figures::FigureText text_of(const SweepOutput& output, const studies::PointSource& points, SweepFigure figure) {
  figures::FigureText text{
      figures::verbatim_text(output.title), parameter_label(output.sweep.axis.name),
      fmt::format("Poincaré points of  δ_{{{},1}} / b_c", figure == SweepFigure::delta_rp ? "rp" : "sp")};
  if (const auto direction = direction_of(figure))
    text.title += ", " + store::direction_word(output.sweep.directions[*direction]);
  text.above = speed_above(output.sweep.axis.name, output.speed, points);
  return text;
}

/// Points are numbered along the first direction, then the second.
std::size_t points_per_direction(const SweepOutput& output, const studies::PointSource& points) {
  return points.count / output.sweep.directions.size();
}

/// The colours differ in print, in grey and for colour-blind readers (after Okabe and Ito). The logarithm of a
/// multiplier near zero has an interval far wider than the figure needs.
const std::vector<figures::PointClass>& classes() {
  static const std::vector<figures::PointClass> all = {
      {"period 1", "#12285c", false}, {"period 2 and more", "#3f8fd0", false},
      {"quasiperiodic", "#1b8a6b"},   {"chaotic", "#c8553d"},
      {"undecided", "#8a8a8a"},       {not_converged_words, std::string(figures::ink::ochre), false}};
  return all;
}

std::size_t class_of(const PointSummary& r) {
  if (r.is_unconverged()) return 5;
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
  return [&points, column, first = direction * points_per_direction(output, points)](
             std::size_t i) -> std::optional<figures::ClassPoint> {
    const PointResult r = points.read(first + i);
    if (r.outcome != integrate::Outcome::reached) return std::nullopt;
    const analysis::Estimate exponent = r.lyapunov_max();
    figures::ClassPoint p{{r.point.value, {}, r.is_unconverged()}, class_of(r), exponent.value, exponent.half_width};
    for (std::size_t k = 0; k < r.poincare_rows(); ++k)
      p.section.push_back(r.poincare[k * r.poincare_columns + column]);
    return p;
  };
}

}  // namespace

std::string parameter_label(const std::string& parameter) {
  if (const studies::NamedParameter* named = studies::find_parameter(parameter))
    return fmt::format("{}  {}{}", named->words, named->symbol, named->unit);
  const auto [words, unit] = quantity_words(parameter);
  return figures::verbatim_text(words) + (unit.empty() ? std::string() : "  [" + unit + "]");
}

std::string parameter_symbol(const std::string& parameter) {
  const studies::NamedParameter* named = studies::find_parameter(parameter);
  return named == nullptr ? figures::verbatim_text(quantity_words(parameter).words) : named->symbol;
}

std::string speed_label(std::string_view key) {
  if (key == "sun_speed_rpm") return "Sun speed  n_s  [rpm]";
  if (key == "carrier_speed_rpm") return "Carrier speed  n_c  [rpm]";
  if (key == "mesh_frequency_Hz") return "Mesh frequency  f_m  [Hz]";
  return {};
}

std::optional<figures::SecondAbscissa> speed_above(const std::string& parameter,
                                                   const std::optional<studies::SpeedUnit>& given, double omega,
                                                   const studies::StageRecord& record) {
  if (parameter != studies::speed_parameter) return std::nullopt;
  if (given) return figures::SecondAbscissa{speed_label(given->key), given->per_ratio};
  if (!(omega > 0.0) || !(record.speeds.sun > 0.0)) return std::nullopt;
  return figures::SecondAbscissa{record.is_pair() ? "Speed of gear 1  n_1  [rpm]" : speed_label("sun_speed_rpm"),
                                 gear::rpm * record.speeds.sun / omega};
}

std::optional<figures::SecondAbscissa> speed_above(const std::string& parameter,
                                                   const std::optional<studies::SpeedUnit>& given,
                                                   const studies::PointSource& points) {
  if (points.count == 0) return std::nullopt;
  const PointSummary first = points.read_summary(0);
  return speed_above(parameter, given, first.omega, first.meshes);
}

bool is_pair(const studies::PointSource& points) { return points.count > 0 && points.read_summary(0).meshes.is_pair(); }

std::string figure_title(const input::Study& study) {
  const gear::Boundary b = study.stage.boundary;
  const char* boundary = b == gear::Boundary::as_printed  ? "as_printed"
                         : b == gear::Boundary::star      ? "star"
                         : b == gear::Boundary::fixed_sun ? "fixed sun"
                         : b == gear::Boundary::free      ? "free"
                                                          : "fixed ring";
  std::string title = study.name.empty() ? study.stage.name : study.name;
  if (!title.empty()) title += ", ";
  title += study.stage.is_pair() ? "pair of gears" : std::string("boundary ") + boundary;
  const bool speed_is_given = study.has_dynamics() && study.plan.kind()->at_given_speed &&
                              std::ranges::none_of(input::varied_parameters(study), [](const auto& varied) {
                                return varied.axis.name == studies::speed_parameter;
                              });
  if (speed_is_given) {
    title += ", Ω = " + short_text(study.mesh_frequency_ratio, 8);
  }
  return title;
}

namespace {

std::vector<store::PointColumn> columns_of(const studies::PointSource& points,
                                           const std::vector<store::PointColumn>& more) {
  return points.count == 0 ? store::point_columns(0, more) : store::point_columns_like(points.read_summary(0), more);
}

}  // namespace

void write_points_csv(const std::filesystem::path& file, const studies::PointSource& points,
                      const std::vector<store::PointColumn>& more) {
  write_table_csv(file, columns_of(points, more), points.count, [&](std::size_t i) { return points.read_summary(i); });
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

void write_point_columns(store::Hdf5File& h5, const studies::PointSource& points,
                         const std::vector<store::PointColumn>& more) {
  write_table_h5(
      h5, "/points", columns_of(points, more), points.count, [&](std::size_t i) { return points.read_summary(i); },
      "point");
}

namespace {

/// A row of amplitudes for each point; of points without, NaN.
void write_spectra(store::Hdf5File& h5, const studies::PointSource& points) {
  std::size_t orders = 0;
  double resolution = 0.0;
  for (std::size_t i = 0; i < points.count && orders == 0; ++i) {
    const PointResult r = points.read(i);
    orders = r.spectrum.size();
    resolution = r.spectrum_resolution;
  }
  if (orders == 0) return;
  h5.create_group("/spectra");
  h5.write("/spectra/order", orders, store::Hdf5File::Column<double>([resolution](std::size_t k) {
             return resolution * static_cast<double>(k);
           }));
  h5.set_units("/spectra/order", "mesh frequency");
  h5.write("/spectra/delta_sp_1", points.count, orders, [&](std::size_t row, std::span<double> values) {
    std::fill(values.begin(), values.end(), std::numeric_limits<double>::quiet_NaN());
    const PointResult r = points.read(row);
    std::copy_n(r.spectrum.begin(), std::min(orders, r.spectrum.size()), values.begin());
  });
  h5.set_units("/spectra/delta_sp_1", "b_c");
  h5.name_axes("/spectra/order", {"order"});
  h5.name_axes("/spectra/delta_sp_1", {"point", "order"});
}

}  // namespace

void write_results_h5(const std::filesystem::path& file, const SweepOutput& output,
                      const studies::PointSource& points) {
  store::Hdf5File h5(file);
  h5.set_attribute("/", "input_resolved", output.resolved_input);
  h5.set_attribute("/", "sweep_parameter", output.sweep.axis.name);

  write_point_columns(h5, points);

  SectionRows section(points);
  h5.write("/poincare/point", section.count(), store::Hdf5File::Column<std::int64_t>([&](std::size_t row) {
             return static_cast<std::int64_t>(section.at(row).first);
           }));
  h5.write("/poincare/index", section.count(), store::Hdf5File::Column<std::int64_t>([&](std::size_t row) {
             return static_cast<std::int64_t>(section.at(row).second);
           }));
  h5.set_units("/poincare/point", "1");
  h5.set_attribute("/poincare/point", "meaning", "number of the point in /points");
  h5.set_units("/poincare/index", "1");
  h5.set_attribute("/poincare/index", "meaning", "number of the Poincare point of this point, from 0");
  const std::size_t columns = output.poincare_columns.size();
  PointResult current;
  write_section_h5(
      h5, "/poincare", output.poincare_columns, section.count(), [&](std::size_t row, std::span<double> values) {
        const auto [point, k] = section.at(row);
        if (k == 0) current = points.read(point);
        std::copy_n(current.poincare.begin() + static_cast<std::ptrdiff_t>(k * columns), columns, values.begin());
      });
  write_spectra(h5, points);
  h5.close();
}

std::optional<DrawnFigure> write_sweep_figure(const std::filesystem::path& folder, const SweepOutput& output,
                                              const studies::PointSource& points, SweepFigure figure) {
  const auto stem = stem_of(output, figure);
  if (!stem) return std::nullopt;
  if ((figure == SweepFigure::delta_rp || figure == SweepFigure::response_rp) && is_pair(points)) return std::nullopt;
  const figures::FigureText text = text_of(output, points, figure);
  const ResponseInput response{output.sweep, points, text};
  figures::FigureOutcome outcome;
  switch (figure) {
    case SweepFigure::regimes_first:
    case SweepFigure::regimes_second:
      outcome = figures::class_bifurcation_figure(
          folder, *stem, text, "exponent", "Exponent  λ_1 / ω_{sn}", classes(), points_per_direction(output, points),
          section(output, points, *direction_of(figure), figure), figures::Pictures::none);
      break;
    case SweepFigure::delta_sp:
    case SweepFigure::delta_rp: {
      std::vector<figures::BifurcationSeries> series;
      for (std::size_t d = 0; d < output.sweep.directions.size(); ++d)
        series.push_back({store::direction_word(output.sweep.directions[d]), points_per_direction(output, points),
                          section(output, points, d, figure)});
      outcome =
          figures::bifurcation_figure(folder, *stem, text, series, {}, figures::Pictures::none, not_converged_words);
      break;
    }
    case SweepFigure::response_sp:
    case SweepFigure::response_rp:
      outcome = write_response_figure(folder, *stem, response, figure == SweepFigure::response_sp);
      break;
    case SweepFigure::dynamic_factor:
      outcome = write_largest_force_figure(folder, *stem, response);
      break;
    case SweepFigure::kv:
      if (!has_quasi_static(points)) return std::nullopt;
      outcome = write_kv_figure(folder, *stem, response);
      break;
    case SweepFigure::load_sharing:
    case SweepFigure::load_sharing_max:
      if (!loads_differ(points)) return std::nullopt;
      outcome = write_load_sharing_figure(folder, *stem, response, figure == SweepFigure::load_sharing_max);
      break;
    case SweepFigure::waterfall_first:
    case SweepFigure::waterfall_second:
      outcome = write_waterfall_figure(folder, *stem, response, *direction_of(figure));
      break;
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
