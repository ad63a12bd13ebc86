#include "reports/response_output.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "figures/cell_figure.hpp"
#include "figures/track_figure.hpp"
#include "reports/sweep_output.hpp"
#include "store/point_columns.hpp"

namespace epicyclic::reports {

namespace {

using studies::Course;
using studies::PointSummary;
using studies::StageRecord;

/// Shares that differ by less are the same.
constexpr double even_share = 1e-6;

bool ok(const PointSummary& r) { return r.outcome == integrate::Outcome::reached; }

std::size_t points_per_direction(const ResponseInput& input) {
  return input.points.count / input.sweep.directions.size();
}

/// Do the numbers of the response not depend on when it is recorded, as far as is known?
bool regular(const PointSummary& r) {
  return !r.is_unconverged() && r.regime != analysis::Regime::chaotic &&
         !(r.regime == analysis::Regime::undecided && r.classified);
}

/// Numbers of each record along each direction. No line goes through chaos, where they are random.
std::vector<figures::TrackSeries> series_of(const ResponseInput& input,
                                            const std::function<std::vector<double>(const StageRecord&)>& values) {
  std::vector<figures::TrackSeries> all;
  const std::size_t count = points_per_direction(input);
  for (std::size_t d = 0; d < input.sweep.directions.size(); ++d)
    all.push_back({store::direction_word(input.sweep.directions[d]), count,
                   [&input, values, first = d * count](std::size_t i) -> std::optional<figures::TrackRow> {
                     const PointSummary r = input.points.read_summary(first + i);
                     figures::TrackRow row{r.point.value, regular(r), values(r.meshes), r.is_unconverged()};
                     if (!ok(r)) std::fill(row.y.begin(), row.y.end(), std::numeric_limits<double>::quiet_NaN());
                     return row;
                   }});
  return all;
}

}  // namespace

figures::FigureOutcome write_response_figure(const std::filesystem::path& folder, const std::string& stem,
                                             const ResponseInput& input, bool sun_planet) {
  const auto meshes = sun_planet ? &StageRecord::sun_planet : &StageRecord::ring_planet;
  const char* symbol = sun_planet ? "δ_{sp,1} / b_c" : "δ_{rp,1} / b_c";
  return figures::track_figure(
      folder, stem, input.text,
      series_of(input,
                [meshes](const StageRecord& r) {
                  const Course& delta = (r.*meshes)[0].delta;
                  return std::vector{delta.rms, delta.range()};
                }),
      {{fmt::format("RMS of {}", symbol), {0}}, {fmt::format("Peak to peak of {}", symbol), {1}}}, {},
      figures::Pictures::none, not_converged_words);
}

namespace {

/// A panel for each kind of mesh that there is.
std::vector<figures::TrackPanel> of_meshes(const studies::PointSource& points, const char* sun, const char* ring) {
  std::vector<figures::TrackPanel> panels = {{sun, {0}}};
  if (points.count == 0 || !points.read_summary(0).meshes.is_pair()) panels.push_back({ring, {1}});
  return panels;
}

}  // namespace

figures::FigureOutcome write_largest_force_figure(const std::filesystem::path& folder, const std::string& stem,
                                                  const ResponseInput& input) {
  return figures::track_figure(
      folder, stem, input.text,
      series_of(input,
                [](const StageRecord& r) {
                  return std::vector{r.dynamic_factor(r.sun_planet), r.dynamic_factor(r.ring_planet)};
                }),
      of_meshes(input.points, "Largest  F_{sp} / F_0", "Largest  F_{rp} / F_0"), {}, figures::Pictures::none,
      not_converged_words);
}

bool has_quasi_static(const studies::PointSource& points) {
  for (std::size_t i = 0; i < points.count; ++i) {
    const PointSummary r = points.read_summary(i);
    if (ok(r) && std::isfinite(StageRecord::kv(r.meshes.sun_planet))) return true;
  }
  return false;
}

figures::FigureOutcome write_kv_figure(const std::filesystem::path& folder, const std::string& stem,
                                       const ResponseInput& input) {
  return figures::track_figure(
      folder, stem, input.text,
      series_of(input,
                [](const StageRecord& r) {
                  return std::vector{StageRecord::kv(r.sun_planet), StageRecord::kv(r.ring_planet)};
                }),
      of_meshes(input.points, "Dynamic factor  K_{v,sp}", "Dynamic factor  K_{v,rp}"), {}, figures::Pictures::none,
      not_converged_words);
}

bool loads_differ(const studies::PointSource& points) {
  for (std::size_t i = 0; i < points.count; ++i) {
    const PointSummary r = points.read_summary(i);
    if (!ok(r)) continue;
    for (const auto* meshes : {&r.meshes.sun_planet, &r.meshes.ring_planet})
      for (std::size_t p = 0; p < meshes->size(); ++p)
        if (std::abs(StageRecord::share(*meshes, &Course::mean, p) - 1.0) > even_share) return true;
  }
  return false;
}

figures::FigureOutcome write_load_sharing_figure(const std::filesystem::path& folder, const std::string& stem,
                                                 const ResponseInput& input, bool largest) {
  const std::size_t planets = input.points.count == 0 ? 0 : input.points.read_summary(0).meshes.sun_planet.size();
  figures::TrackPanel sun{largest ? "Peak load share  L_{sp,max}" : "Load sharing  L_{sp}", {}};
  figures::TrackPanel ring{largest ? "Peak load share  L_{rp,max}" : "Load sharing  L_{rp}", {}};
  std::vector<std::string> names;
  for (std::size_t i = 0; i < planets; ++i) {
    sun.columns.push_back(i);
    ring.columns.push_back(planets + i);
    names.push_back(fmt::format("planet {}", i + 1));
  }
  return figures::track_figure(
      folder, stem, input.text,
      series_of(input,
                [planets, course = largest ? &Course::largest : &Course::mean](const StageRecord& r) {
                  std::vector<double> shares;
                  for (const auto* meshes : {&r.sun_planet, &r.ring_planet})
                    for (std::size_t i = 0; i < planets; ++i) shares.push_back(StageRecord::share(*meshes, course, i));
                  return shares;
                }),
      {sun, ring}, names, figures::Pictures::none, not_converged_words);
}

figures::FigureOutcome write_waterfall_figure(const std::filesystem::path& folder, const std::string& stem,
                                              const ResponseInput& input, std::size_t direction) {
  constexpr double shown_orders = 4.0;
  constexpr double floor = 1e-4;      // [b_c]: a nanometre
  constexpr std::size_t most = 1000;  // columns: the picture has no more
  const std::size_t count = points_per_direction(input);
  struct Column {
    double x;
    std::vector<double> spectrum;
  };
  std::vector<Column> columns;
  double resolution = 0.0;
  std::size_t orders = 0;
  const std::size_t together = (count + most - 1) / most;
  for (std::size_t k = 0; k < count; ++k) {
    studies::PointResult p = input.points.read(direction * count + k);
    if (!p.spectrum.empty()) {
      resolution = p.spectrum_resolution;
      const auto last = static_cast<std::size_t>(shown_orders / resolution) + 1;
      p.spectrum.resize(std::min(p.spectrum.size(), last));
      orders = std::max(orders, p.spectrum.size());
    }
    if (k % together == 0) {
      columns.push_back({p.point.value, std::move(p.spectrum)});
      continue;
    }
    // Of points that share a column, the largest of each order.
    std::vector<double>& shared = columns.back().spectrum;
    shared.resize(std::max(shared.size(), p.spectrum.size()), 0.0);
    for (std::size_t j = 0; j < p.spectrum.size(); ++j) shared[j] = std::max(shared[j], p.spectrum[j]);
  }
  if (orders < 2) return figures::nothing_to_draw("there is no spectrum to draw");
  std::sort(columns.begin(), columns.end(), [](const Column& a, const Column& b) { return a.x < b.x; });
  figures::CellGrid grid;
  for (const Column& column : columns) grid.x.push_back(column.x);
  std::vector<double> cells;
  // Order 0 is the mean, which is not part of the vibration.
  for (std::size_t j = 1; j < orders; ++j) {
    grid.y.push_back(resolution * static_cast<double>(j));
    for (const Column& column : columns) cells.push_back(j < column.spectrum.size() ? column.spectrum[j] : 0.0);
  }
  figures::FigureText text = input.text;
  text.y_label = "Frequency / mesh frequency";
  return figures::decade_figure(folder, stem, text, grid, "Amplitude of δ_{sp,1} / b_c", cells, floor,
                                figures::Pictures::none);
}

}  // namespace epicyclic::reports
