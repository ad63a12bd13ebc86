#include "kinds/basins/output.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "core/csv.hpp"
#include "figures/cell_figure.hpp"
#include "reports/plane_output.hpp"
#include "store/hdf5_file.hpp"

namespace epicyclic::kinds {

using namespace reports;

namespace {

using analysis::Attractor;
using analysis::Attractors;
using studies::PointSummary;

store::PointColumn attractor_column(const Attractors& attractors) {
  return {"attractor", "1", "number of the attractor that the cell reaches, from 1; 0: none is known",
          store::PointColumn::Getter<std::int64_t>([&attractors](const PointSummary& r) {
            return static_cast<std::int64_t>(attractors.number[r.point.index]);
          })};
}

/// An attractor with data of its cells.
struct Row {
  std::int64_t number = 0;
  std::string regime;
  std::int64_t period = 0;
  std::int64_t cells = 0;
  double share = 0;  ///< of all cells
  analysis::Estimate exponent;
  const PointSummary* first = nullptr;  ///< its first cell
  figures::FigureRange sp, rp;          ///< of planet 1's deflections over all its cells
  double spread = 0;
  double orbit_error = std::numeric_limits<double>::quiet_NaN();
  std::int64_t image_of = 0;
  std::int64_t rotation = 0;
  std::vector<double> state;  ///< a Poincare point
};

std::vector<Row> rows_of(const BasinsOutput& output, const std::vector<PointSummary>& results,
                         const Attractors& attractors) {
  std::vector<Row> rows;
  for (const Attractor& a : attractors.all) {
    Row row;
    row.number = static_cast<std::int64_t>(rows.size() + 1);
    row.regime = to_string(a.record.regime);
    row.period = static_cast<std::int64_t>(a.record.period());
    row.cells = static_cast<std::int64_t>(a.members.size());
    row.share = static_cast<double>(a.members.size()) / static_cast<double>(results.size());
    row.first = &results[a.members.front()];
    const bool periodic = a.record.regime == analysis::Regime::periodic;
    row.exponent = periodic ? row.first->lyapunov_max() : a.record.exponent;
    if (periodic) row.orbit_error = a.record.orbit_error;
    for (const std::size_t k : a.members) {
      const PointSummary& r = results[k];
      row.sp.include(r.meshes.sun_planet.front().delta.least);
      row.sp.include(r.meshes.sun_planet.front().delta.largest);
      row.rp.include(r.meshes.ring_planet.front().delta.least);
      row.rp.include(r.meshes.ring_planet.front().delta.largest);
      row.spread = std::max(row.spread, r.meshes.planet_spread);
    }
    row.image_of = static_cast<std::int64_t>(a.image_of);
    if (a.image_of > 0) row.rotation = output.rotations[a.image_by].planets;
    row.state = row.first->end_state;
    if (periodic)
      row.state.assign(a.record.orbit.begin(),
                       a.record.orbit.begin() + static_cast<std::ptrdiff_t>(a.record.dimension));
    rows.push_back(std::move(row));
  }
  return rows;
}

/// After Okabe and Ito, with brighter and darker ones between.
constexpr std::array<const char*, 12> attractor_colours = {"#12285c", "#c8553d", "#1b8a6b", "#e8b12a",
                                                           "#3f8fd0", "#7a4a8c", "#9bd7f2", "#d98cb3",
                                                           "#6b4f2a", "#a5c96a", "#f3dcb0", "#404a52"};

std::string share_text(double share) {
  const double percent = 100.0 * share;
  if (percent < 1.0) return "< 1 %";
  return fmt::format("{:.0f} %", percent);
}

}  // namespace

std::string attractor_word(const analysis::AttractorRecord& record) {
  return record.regime == analysis::Regime::periodic ? "period " + std::to_string(record.period())
                                                     : to_string(record.regime);
}

std::string component_label(const std::string& component) {
  constexpr std::string_view rate = "_rate";
  const bool is_rate = component.ends_with(rate);
  const std::string name = is_rate ? component.substr(0, component.size() - rate.size()) : component;
  const auto line = name.find('_');
  const std::string symbol = name.substr(0, line) + "_{" + name.substr(line + 1) + "}";
  return is_rate ? "Start  (d" + symbol + "/dτ) / b_c" : "Start  " + symbol + " / b_c";
}

void write_basins_csv(const std::filesystem::path& file, const std::vector<PointSummary>& results,
                      const Attractors& attractors) {
  write_points_csv(file, studies::points_in_memory(results), {second_value_column(), attractor_column(attractors)});
}

/// An extreme of no values, as of the ring's mesh of a pair of gears, is not known.
double known(double extreme) { return std::isfinite(extreme) ? extreme : std::numeric_limits<double>::quiet_NaN(); }

void write_attractors_csv(const std::filesystem::path& file, const BasinsOutput& output,
                          const std::vector<PointSummary>& results, const Attractors& attractors) {
  std::vector<std::string> columns = {
      "attractor",          "regime",       "period",        "cells",        "share",        "lyapunov_max",
      "lyapunov_max_error", "point",        "value",         "second_value", "delta_sp_min", "delta_sp_max",
      "delta_rp_min",       "delta_rp_max", "planet_spread", "orbit_error",  "image_of",     "image_rotation"};
  columns.insert(columns.end(), output.state_names.begin(), output.state_names.end());
  CsvWriter csv(file, columns);
  for (const Row& r : rows_of(output, results, attractors)) {
    csv.cell(r.number).cell(r.regime).cell(r.period).cell(r.cells).cell(r.share);
    csv.cell(r.exponent.value).cell(r.exponent.half_width);
    csv.cell(r.first->point.index).cell(r.first->point.value).cell(r.first->point.second_value);
    csv.cell(r.sp.low).cell(r.sp.high).cell(known(r.rp.low)).cell(known(r.rp.high)).cell(r.spread).cell(r.orbit_error);
    csv.cell(r.image_of).cell(r.rotation);
    for (const double x : r.state) csv.cell(x);
    csv.end_row();
  }
  csv.commit();
}

void write_basins_h5(const std::filesystem::path& file, const BasinsOutput& output,
                     const std::vector<PointSummary>& results, const Attractors& attractors) {
  store::Hdf5File h5(file);
  // The matrix: rows along the second component, columns along the first, both ascending.
  write_plane(h5, "/basins", "component", output.plane, output.resolved_input, studies::points_in_memory(results),
              {attractor_column(attractors)});
  const std::vector<std::int64_t> numbers(attractors.number.begin(), attractors.number.end());
  h5.write("/basins/attractor", std::span<const std::int64_t>(numbers),
           static_cast<std::size_t>(output.plane.second.points), static_cast<std::size_t>(output.plane.first.points));
  h5.name_axes("/basins/attractor", {second_value_column().name, "value"});

  const std::vector<Row> rows = rows_of(output, results, attractors);
  h5.create_group("/attractors");
  const auto column = [&](const std::string& name, auto value, const char* units) {
    using Value = std::decay_t<decltype(value(std::declval<const Row&>()))>;
    std::vector<Value> values;
    for (const Row& r : rows) values.push_back(value(r));
    h5.write("/attractors/" + name, std::span<const Value>(values));
    h5.name_axes("/attractors/" + name, {"attractor"});
    if (units != nullptr) h5.set_units("/attractors/" + name, units);
  };
  column(
      "attractor", [](const Row& r) { return r.number; }, nullptr);
  column(
      "regime", [](const Row& r) { return r.regime; }, nullptr);
  column(
      "period", [](const Row& r) { return r.period; }, "mesh periods");
  column(
      "cells", [](const Row& r) { return r.cells; }, "1");
  column(
      "share", [](const Row& r) { return r.share; }, "1");
  column(
      "lyapunov_max", [](const Row& r) { return r.exponent.value; }, "1 per tau");
  column(
      "lyapunov_max_error", [](const Row& r) { return r.exponent.half_width; }, "1 per tau");
  column(
      "orbit_error", [](const Row& r) { return r.orbit_error; }, "b_c, b_c per tau");
  column(
      "image_of", [](const Row& r) { return r.image_of; }, nullptr);
  column(
      "image_rotation", [](const Row& r) { return r.rotation; }, "1");
  h5.write("/attractors/state_names", std::span<const std::string>(output.state_names));
  h5.name_axes("/attractors/state_names", {"component"});
  std::vector<double> states;
  for (const Row& r : rows) states.insert(states.end(), r.state.begin(), r.state.end());
  h5.write("/attractors/state", std::span<const double>(states), rows.size(), output.state_names.size());
  h5.set_units("/attractors/state", "b_c, b_c per tau");
  h5.name_axes("/attractors/state", {"attractor", "component"});
  for (std::size_t k = 0; k < attractors.all.size(); ++k) {
    const analysis::AttractorRecord& record = attractors.all[k].record;
    if (record.period() == 0) continue;
    const std::string name = "/attractors/orbit_" + std::to_string(k + 1);
    h5.write(name, std::span<const double>(record.orbit), record.period(), record.dimension);
    h5.set_units(name, "b_c, b_c per tau");
    h5.name_axes(name, {"crossing", "component"});
  }
  h5.close();
}

std::vector<DrawnFigure> draw_basins_figure(const std::filesystem::path& folder, const BasinsOutput& output,
                                            const std::vector<PointSummary>& results, const Attractors& attractors) {
  // The largest ones have colours, in the order of their numbers.
  std::vector<std::size_t> coloured(attractors.all.size());
  std::iota(coloured.begin(), coloured.end(), 0U);
  std::stable_sort(coloured.begin(), coloured.end(), [&](std::size_t a, std::size_t b) {
    return attractors.all[a].members.size() > attractors.all[b].members.size();
  });
  coloured.resize(std::min(coloured.size(), attractor_colours.size()));
  std::sort(coloured.begin(), coloured.end());

  const auto total = static_cast<double>(results.size());
  std::vector<figures::CellClass> classes;
  std::vector<std::size_t> class_of(attractors.all.size(), coloured.size());
  std::size_t rest = 0;
  for (const Attractor& a : attractors.all) rest += a.members.size();
  for (const std::size_t k : coloured) {
    const Attractor& a = attractors.all[k];
    class_of[k] = classes.size();
    rest -= a.members.size();
    classes.push_back({fmt::format("{}: {}, {}", k + 1, attractor_word(a.record),
                                   share_text(static_cast<double>(a.members.size()) / total)),
                       attractor_colours[classes.size()]});
  }
  classes.push_back({fmt::format("{} others, {}", attractors.all.size() - coloured.size(),
                                 share_text(static_cast<double>(rest) / total)),
                     "#dedede"});
  classes.push_back({"undecided", "#9a9a9a"});
  classes.push_back({"failed", "#000000"});
  std::vector<std::size_t> cells;
  for (const PointSummary& r : results) {
    const std::size_t number = attractors.number[r.point.index];
    const bool failed = r.outcome != integrate::Outcome::reached;
    cells.push_back(number > 0 ? class_of[number - 1] : classes.size() - (failed ? 1 : 2));
  }
  const std::size_t undecided = classes.size() - 2;
  classes[undecided].label +=
      ", " + share_text(static_cast<double>(std::count(cells.begin(), cells.end(), undecided)) / total);
  const figures::FigureText text{figures::verbatim_text(output.title), component_label(output.plane.first.name),
                                 component_label(output.plane.second.name)};
  return {{folder / "basins.png",
           figures::class_figure(folder, "basins", text,
                                 {axis_values(output.plane.first), axis_values(output.plane.second)}, classes, cells)}};
}

}  // namespace epicyclic::kinds
