#include "kinds/map/output.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>

#include "figures/cell_figure.hpp"
#include "reports/plane_output.hpp"
#include "store/hdf5_file.hpp"
#include "studies/plane.hpp"

namespace epicyclic::kinds {

using namespace reports;

namespace {

using studies::Direction;
using studies::PointSummary;

/// The values of the cells in a figure or a matrix, row by row with both axes ascending.
template <class T>
std::vector<T> matrix(const MapOutput& output, const studies::PointSource& points, Direction direction,
                      const std::function<T(const PointSummary&)>& value) {
  const auto columns = static_cast<std::size_t>(output.map.plane.first.points);
  const auto& directions = output.map.directions;
  const std::size_t count = points.count / directions.size();
  const auto which = static_cast<std::size_t>(std::ranges::find(directions, direction) - directions.begin());
  std::vector<T> cells(count);
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t column = k % columns;
    const std::size_t at = direction == Direction::up ? k : k - column + (columns - 1 - column);
    cells[at] = value(points.read_summary(which * count + k));
  }
  return cells;
}

/// Periods in blues and purples, by rising brightness; after Okabe and Ito otherwise, as in the figures of sweeps.
const std::vector<figures::CellClass>& classes() {
  static const std::vector<figures::CellClass> all = {
      {"period 1", "#12285c"},      {"period 2", "#3f8fd0"},   {"period 3", "#9bd7f2"},      {"period 4", "#6b3f8f"},
      {"period 5 to 8", "#b08fd0"}, {"period > 8", "#e3d3f0"}, {"quasiperiodic", "#1b8a6b"}, {"chaotic", "#c8553d"},
      {"undecided", "#b8b8b8"},     {"failed", "#000000"}};
  return all;
}

std::size_t class_of(const PointSummary& r) {
  if (r.outcome != integrate::Outcome::reached) return 9;
  switch (r.regime) {
    case analysis::Regime::periodic:
      return r.period <= 4 ? static_cast<std::size_t>(r.period - 1) : r.period <= 8 ? 4 : 5;
    case analysis::Regime::quasiperiodic:
      return 6;
    case analysis::Regime::chaotic:
      return 7;
    case analysis::Regime::undecided:
      break;
  }
  return 8;
}

}  // namespace

void write_map_csv(const std::filesystem::path& file, const studies::PointSource& points) {
  write_points_csv(file, points, {second_value_column()});
}

void write_map_h5(const std::filesystem::path& file, const MapOutput& output, const studies::PointSource& points) {
  store::Hdf5File h5(file);
  // Matrices: rows along the second parameter, columns along the first, both ascending.
  write_plane(h5, "/map", "parameter", output.map.plane, output.resolved_input, points);
  const auto columns = static_cast<std::size_t>(output.map.plane.first.points);
  const auto rows = static_cast<std::size_t>(output.map.plane.second.points);
  for (const Direction direction : output.map.directions) {
    const std::string group = "/map/" + store::direction_word(direction);
    h5.create_group(group);
    const std::vector<std::string> axes = {second_value_column().name, "value"};
    const auto integers = [&](const char* name, const std::function<std::int64_t(const PointSummary&)>& value) {
      h5.write(group + "/" + name, std::span<const std::int64_t>(matrix(output, points, direction, value)), rows,
               columns);
      h5.name_axes(group + "/" + name, axes);
    };
    const auto numbers = [&](const char* name, const std::function<double(const PointSummary&)>& value) {
      h5.write(group + "/" + name, std::span<const double>(matrix(output, points, direction, value)), rows, columns);
      h5.name_axes(group + "/" + name, axes);
      h5.set_units(group + "/" + name, "1 per tau");
    };
    integers("regime", [](const PointSummary& r) {
      return r.outcome == integrate::Outcome::reached ? static_cast<std::int64_t>(r.regime) : -1;
    });
    h5.set_attribute(group + "/regime", "codes", "-1 failed, 0 periodic, 1 quasiperiodic, 2 chaotic, 3 undecided");
    integers("period", [](const PointSummary& r) {
      return r.outcome == integrate::Outcome::reached ? static_cast<std::int64_t>(r.period) : 0;
    });
    h5.set_units(group + "/period", "mesh periods");
    numbers("lyapunov_max", [](const PointSummary& r) { return r.lyapunov_max().value; });
    numbers("lyapunov_max_error", [](const PointSummary& r) { return r.lyapunov_max().half_width; });
  }
  h5.close();
}

std::vector<DrawnFigure> draw_map_figures(const std::filesystem::path& folder, const MapOutput& output,
                                          const studies::PointSource& points) {
  std::vector<DrawnFigure> figures;
  const figures::CellGrid grid{axis_values(output.map.plane.first), axis_values(output.map.plane.second)};
  for (const Direction direction : output.map.directions) {
    const std::string word = store::direction_word(direction);
    const figures::FigureText text{
        figures::verbatim_text(output.title) + (output.map.directions.size() > 1 ? ", " + word : ""),
        parameter_label(output.map.plane.first.name), parameter_label(output.map.plane.second.name),
        speed_above(output.map.plane.first.name, output.speed, points)};
    const std::string regimes = "regimes_" + word;
    figures.push_back(
        {folder / (regimes + ".png"), figures::class_figure(folder, regimes, text, grid, classes(),
                                                            matrix<std::size_t>(output, points, direction, class_of))});
    if (output.map.recording.classification_periods == 0) continue;
    const auto exponents =
        matrix<double>(output, points, direction, [](const PointSummary& r) { return r.lyapunov_max().value; });
    if (std::ranges::none_of(exponents, [](double x) { return std::isfinite(x); })) continue;
    const std::string stem = "lyapunov_max_" + word;
    figures.push_back(
        {folder / (stem + ".png"),
         figures::value_figure(folder, stem, text, grid, "Largest exponent  λ_1 / ω_{sn}", "not known", exponents)});
  }
  return figures;
}

}  // namespace epicyclic::kinds
