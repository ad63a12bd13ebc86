#include "kinds/ramp/output.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <numbers>
#include <utility>

#include <fmt/format.h>

#include "core/atomic_file.hpp"
#include "core/csv.hpp"
#include "core/text.hpp"
#include "figures/cell_figure.hpp"
#include "figures/line_figure.hpp"
#include "reports/markdown.hpp"
#include "reports/table_output.hpp"
#include "store/hdf5_file.hpp"
#include "store/point_columns.hpp"

namespace epicyclic::kinds {

namespace {

using reports::DrawnFigure;
using studies::Direction;
using studies::RampResult;
using studies::RampWindow;

using Column = store::Column<RampWindow>;

std::vector<Column> ramp_columns(const RampOutput& output) {
  using Integer = Column::Getter<std::int64_t>;
  using Number = Column::Getter<double>;
  using Words = Column::Getter<std::string>;
  std::vector<Column> all = {{"direction", "", "up or down: direction of the speed",
                              Words([](const RampWindow& w) { return store::direction_word(w.direction); })},
                             {"window", "1", "number of the window along its direction, from 0",
                              Integer([](const RampWindow& w) { return std::int64_t{w.number}; })}};
  const auto add = [&all](std::string name, const char* unit, std::string meaning, Number value) {
    all.push_back({std::move(name), unit, std::move(meaning), std::move(value)});
  };
  add("time_s", "s", "time in the middle of the window, from the beginning of the first ramp",
      [omega_sn = output.omega_sn](const RampWindow& w) { return w.tau / omega_sn; });
  add("tau", "1", "dimensionless time there", [](const RampWindow& w) { return w.tau; });
  add("mesh_frequency_ratio", "1", "Omega there", [](const RampWindow& w) { return w.omega; });
  add("mesh_frequency_Hz", "Hz", "mesh frequency there",
      [omega_sn = output.omega_sn](const RampWindow& w) { return w.omega * omega_sn / (2.0 * std::numbers::pi); });
  add("sun_speed_rpm", "rpm", "speed of the sun there",
      [rpm = gear::rpm * output.speeds.sun](const RampWindow& w) { return w.omega * rpm; });
  add("torque_Nm", "N m", "torque on the sun there", [](const RampWindow& w) { return w.torque_Nm; });
  const auto add_number = [&](const char* name, const char* unit, const char* meaning, double RampWindow::*member) {
    add(name, unit, meaning, [member](const RampWindow& w) { return w.*member; });
  };
  add_number("delta_sp_mean", "b_c", "time mean of the deflection of sun-planet mesh 1", &RampWindow::delta_mean);
  add_number("delta_sp_rms", "b_c", "root mean square of it about its mean", &RampWindow::delta_rms);
  add_number("delta_sp_min", "b_c", "least of it", &RampWindow::delta_min);
  add_number("delta_sp_max", "b_c", "largest of it", &RampWindow::delta_max);
  add_number("force_sp_max_N", "N", "largest force of any sun mesh", &RampWindow::force_max);
  if (output.has_ring) add_number("force_rp_max_N", "N", "largest force of any ring mesh", &RampWindow::ring_force_max);
  add_number("force_bearing_max_N", "N", "largest force of any planet's bearing", &RampWindow::bearing_max);
  add_number("loss_time", "part of the time", "time out of contact of the mesh that is out of contact longest",
             &RampWindow::loss_time);
  for (int order = 1; order <= output.options.orders; ++order)
    add(fmt::format("delta_sp_order_{}", order), "b_c",
        fmt::format("amplitude of the deflection of sun-planet mesh 1 at {} times the mesh frequency", order),
        [at = static_cast<std::size_t>(order * output.options.window_periods)](const RampWindow& w) {
          return w.orders[at];
        });
  return all;
}

std::vector<const RampWindow*> windows_of(const RampResult& result, Direction direction) {
  std::vector<const RampWindow*> all;
  for (const RampWindow& w : result.windows)
    if (w.direction == direction) all.push_back(&w);
  std::ranges::sort(all, {}, [](const RampWindow* w) { return w->omega; });
  return all;
}

const char* speed_label() { return "Mesh frequency ratio  Ω"; }

figures::FigureText text_of(const RampOutput& output, const std::string& what, const char* y_label) {
  return {figures::verbatim_text(output.title) + ", " + what, speed_label(), y_label};
}

template <class Value>
DrawnFigure draw_curves(const std::filesystem::path& folder, std::string_view stem, const figures::FigureText& text,
                        const RampResult& result, const std::vector<std::pair<std::string, Value>>& curves,
                        bool log_y) {
  std::vector<figures::FigureCurve> drawn;
  for (const Direction direction : {Direction::up, Direction::down}) {
    const auto windows = windows_of(result, direction);
    if (windows.empty()) continue;
    for (const auto& [label, value] : curves) {
      figures::FigureCurve curve{label + (label.empty() ? "" : ", ") + store::direction_word(direction), {}, {}};
      for (const RampWindow* w : windows) {
        curve.x.push_back(w->omega);
        curve.y.push_back(value(*w));
      }
      drawn.push_back(std::move(curve));
    }
  }
  return {folder / (std::string(stem) + ".png"),
          figures::line_figure(folder, stem, text, drawn, {.log_x = false, .log_y = log_y})};
}

/// Amplitude over speed and frequency: the order of a cell is its frequency over the mesh frequency of its window, and
/// a cell shows the largest amplitude of the orders within it, or that of the nearest one.
DrawnFigure draw_campbell(const std::filesystem::path& folder, const RampOutput& output, const RampResult& result,
                          Direction direction) {
  const std::string word = store::direction_word(direction);
  const std::string stem = "campbell_" + word;
  constexpr double floor_part = 1e-3;  // of the largest amplitude
  constexpr std::size_t rows = 240;
  constexpr std::size_t most_columns = 400;
  auto windows = windows_of(result, direction);
  const std::size_t step = std::max<std::size_t>(1, (windows.size() + most_columns - 1) / most_columns);
  figures::CellGrid grid;
  std::vector<const RampWindow*> shown;
  for (std::size_t k = 0; k < windows.size(); k += step) {
    shown.push_back(windows[k]);
    grid.x.push_back(windows[k]->omega);
  }
  if (shown.size() < 2) return {folder / (stem + ".png"), figures::nothing_to_draw("fewer than two windows")};
  const double most = output.options.orders * grid.x.back();
  for (std::size_t row = 0; row < rows; ++row) grid.y.push_back(most * (static_cast<double>(row) + 0.5) / rows);
  const double height = most / rows;
  std::vector<double> cells;
  double largest = 0.0;
  for (const double frequency : grid.y)
    for (const RampWindow* w : shown) {
      const double bins = output.options.window_periods / w->omega;
      const auto last = static_cast<double>(w->orders.size() - 1);
      // The largest of the bins within the cell, or the nearest one.
      double low = std::ceil((frequency - 0.5 * height) * bins);
      double high = std::floor((frequency + 0.5 * height) * bins);
      if (low > high) low = high = std::round(frequency * bins);
      double amplitude = 0.0;
      for (double k = std::max(1.0, low); k <= std::min(last, high); ++k)
        amplitude = std::max(amplitude, w->orders[static_cast<std::size_t>(k)]);
      cells.push_back(amplitude);
      largest = std::max(largest, amplitude);
    }
  figures::FigureText text = text_of(output, "run " + word, "Frequency  ω / ω_{sn}");
  return {folder / (stem + ".png"),
          figures::decade_figure(folder, stem, text, grid, "Amplitude of δ_{sp,1} / b_c", cells, floor_part * largest)};
}

}  // namespace

void write_ramp_tables(const std::filesystem::path& folder, const RampOutput& output, const RampResult& result) {
  const std::vector<Column> columns = ramp_columns(output);
  reports::write_table_csv(folder / "ramp.csv", columns, result.windows.size(),
                           [&](std::size_t i) -> const RampWindow& { return result.windows[i]; });
  CsvWriter csv(folder / "orders.csv", {"direction", "window", "mesh_frequency_ratio", "order", "delta_sp_1"});
  for (const RampWindow& w : result.windows)
    for (std::size_t k = 1; k < w.orders.size(); ++k)
      csv.row(store::direction_word(w.direction), w.number, w.omega,
              static_cast<double>(k) / output.options.window_periods, w.orders[k]);
  csv.commit();
  store::Hdf5File h5(folder / "results.h5");
  h5.set_attribute("/", "input_resolved", output.resolved_input);
  reports::write_table_h5(h5, "/ramp", columns, result.windows.size(),
                          [&](std::size_t i) -> const RampWindow& { return result.windows[i]; });
  h5.close();
}

std::string ramp_summary(const RampOutput& output, const RampResult& result) {
  constexpr int digits = 5;
  const auto number = [](double x) { return short_text(x, digits); };
  const studies::RampCourse& c = result.course;
  const bool sun_rotates = output.speeds.sun != 0.0;
  const char* rotating = sun_rotates ? "sun" : "carrier";
  const double rpm = gear::rpm * (sun_rotates ? output.speeds.sun : output.speeds.carrier);
  std::string text = "# " + reports::markdown_cell(output.title) + "\n\n";
  text += reports::wrapped(fmt::format(
      "The mesh frequency ratio changes by {} per unit of the dimensionless time, between {} and {}. The {}'s "
      "speed changes by {} rpm/s, between {} and {} rpm. A ramp has {} windows of {} mesh periods.",
      number(c.rate), number(c.from), number(c.to), rotating, number(c.rate * rpm * output.omega_sn),
      number(c.from * rpm), number(c.to * rpm), c.windows, c.window_periods));
  text += "\n" + reports::wrapped("Regimes are not claimed: a response at a changing speed does not repeat.");
  if (result.outcome != integrate::Outcome::reached)
    text += "\n" + reports::wrapped("**The integration ended early**: " + result.message + ".");
  std::vector<std::vector<std::string>> rows{
      {"direction", "largest amplitude [b_c]", "at Omega", "largest force [N]", "at Omega", "longest contact loss"}};
  for (const Direction direction : {Direction::up, Direction::down}) {
    const auto windows = windows_of(result, direction);
    if (windows.empty()) continue;
    const auto most = [&](double RampWindow::*member) {
      return **std::ranges::max_element(windows, {}, [&](const RampWindow* w) { return w->*member; });
    };
    const RampWindow range =
        **std::ranges::max_element(windows, {}, [](const RampWindow* w) { return w->delta_max - w->delta_min; });
    const RampWindow force = most(&RampWindow::force_max);
    rows.push_back({store::direction_word(direction), number(0.5 * (range.delta_max - range.delta_min)),
                    number(range.omega), number(force.force_max), number(force.omega),
                    number(most(&RampWindow::loss_time).loss_time)});
  }
  text += "\n" + reports::aligned(rows) + "\n";
  text += reports::wrapped(
              "Amplitude: half of the range of the deflection of sun-planet mesh 1 over a window. Force: of "
              "any sun mesh. Contact loss: part of the samples of a window.") +
          "\n## What the equations contain\n\n";
  const auto bullet = [&](const std::string& item) { text += reports::wrapped("- " + item, "  "); };
  bullet(
      "The mesh phase is the integral of the mesh frequency. Errors, speed of the carrier and centrifugal force "
      "follow the speed.");
  double least = std::numeric_limits<double>::infinity();
  double largest = -least;
  for (const RampWindow& w : result.windows) {
    const double torque_Nm = sun_rotates ? w.torque_Nm : output.carrier_torque * w.torque_Nm;
    least = std::min(least, torque_Nm);
    largest = std::max(largest, torque_Nm);
  }
  bullet(
      fmt::format("The inertia torques of the acceleration are left out. That of the whole train, about the {}, is "
                  "{} N m; that of the load is from {} to {} N m.",
                  rotating, number(result.inertia_torque_Nm), number(least), number(largest)));
  if (!output.options.torque_time_s.empty())
    bullet("Both torques follow the given torque over time in one proportion.");
  if (output.lubricated) bullet("Friction coefficients are those of the speed in the middle of each window.");
  return text;
}

std::vector<DrawnFigure> draw_ramp_figures(const std::filesystem::path& folder, const RampOutput& output,
                                           const RampResult& result) {
  using Value = std::function<double(const RampWindow&)>;
  std::vector<DrawnFigure> all;
  all.push_back(
      draw_curves<Value>(folder, "response", text_of(output, "response", "Half of the range of δ_{sp,1} / b_c"), result,
                         {{"", [](const RampWindow& w) { return 0.5 * (w.delta_max - w.delta_min); }}}, false));
  std::vector<std::pair<std::string, Value>> orders;
  constexpr int most = 3;
  for (int order = 1; order <= std::min(most, output.options.orders); ++order)
    orders.emplace_back(fmt::format("order {}", order),
                        [at = static_cast<std::size_t>(order * output.options.window_periods)](const RampWindow& w) {
                          return w.orders[at];
                        });
  all.push_back(draw_curves<Value>(
      folder, "orders", text_of(output, "orders of the mesh", "Amplitude of δ_{sp,1} / b_c"), result, orders, true));
  for (const Direction direction : output.options.directions)
    all.push_back(draw_campbell(folder, output, result, direction));
  return all;
}

}  // namespace epicyclic::kinds
