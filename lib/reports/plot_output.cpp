#include "reports/plot_output.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <set>
#include <string_view>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>

#include "core/atomic_file.hpp"
#include "core/counted.hpp"
#include "core/csv.hpp"
#include "core/errors.hpp"
#include "figures/cell_figure.hpp"
#include "figures/sketch.hpp"
#include "input/aliases.hpp"
#include "input/field_table.hpp"
#include "input/speed_aliases.hpp"
#include "input/study_kind.hpp"
#include "model/scales.hpp"
#include "reports/quantity_words.hpp"
#include "store/branch_columns.hpp"
#include "store/point_columns.hpp"
#include "studies/plane_options.hpp"

namespace epicyclic::reports {

namespace {

using input::PlotForm;

const input::PlotSource& plot_source(const input::Study& study) {
  if (!study.has_dynamics() || study.plan.kind()->plot.form == PlotForm::none)
    throw InputError(fmt::format("plot draws sweeps, maps, branches and runs, not a study of kind {}", study.kind()));
  return study.plan.kind()->plot;
}

bool draws_curves(const PlottedStudy& s) { return plot_source(*s.study).form == PlotForm::curves; }

using figures::FigureRange;
using Place = std::array<double, 2>;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr Place gap{nan, nan};

// ---- tables -----------------------------------------------------------------------------------------------------

/// Nothing for a missing file.
/// @throws OutputError when it cannot be read
std::string text_of_file(const std::filesystem::path& file) {
  const FileDescriptor descriptor = open_descriptor(file, O_RDONLY);
  if (!descriptor.is_open() && errno == ENOENT) return {};
  if (!descriptor.is_open()) throw_output_error(file, "open the file", errno);
  return read_all(descriptor.get(), file);
}

/// Gives the columns of a table of an earlier program their names of today.
void use_new_names(std::vector<std::string>& columns, const std::filesystem::path& file) {
  for (std::string& name : columns) name = input::new_column(file.filename().string(), name);
}

/// Some columns of a table that may have more than fit into memory.
class Columns {
 public:
  /// @throws InputError if it does not have all of them
  Columns(const std::filesystem::path& file, std::vector<std::string> names) : names_(std::move(names)) {
    std::vector<std::size_t> at;
    columns_.resize(names_.size());
    const bool is_table = scan_csv(text_of_file(file), [&](std::vector<std::string>& cells) {
      if (at.empty()) {
        use_new_names(cells, file);
        for (const std::string& name : names_) {
          const auto found = std::ranges::find(cells, name);
          if (found == cells.end()) throw InputError(file.string() + ": has no column '" + name + "'");
          at.push_back(static_cast<std::size_t>(found - cells.begin()));
        }
        return;
      }
      for (std::size_t k = 0; k < at.size(); ++k) columns_[k].push_back(cells[at[k]]);
    });
    if (!is_table) throw InputError(file.string() + ": is not a table that this program writes");
  }

  [[nodiscard]] std::size_t rows() const { return columns_.empty() ? 0 : columns_.front().size(); }
  [[nodiscard]] const std::string& word(std::string_view name, std::size_t row) const { return column(name)[row]; }
  /// Not a number of an empty cell.
  [[nodiscard]] double number(std::string_view name, std::size_t row) const {
    const std::string& cell = column(name)[row];
    double value = nan;
    std::from_chars(cell.data(), cell.data() + cell.size(), value);
    return value;
  }

 private:
  [[nodiscard]] const std::vector<std::string>& column(std::string_view name) const {
    return columns_[static_cast<std::size_t>(std::ranges::find(names_, name) - names_.begin())];
  }

  std::vector<std::string> names_;
  std::vector<std::vector<std::string>> columns_;
};

std::vector<std::string> header_of(const std::filesystem::path& file) {
  const std::string text = text_of_file(file);
  const std::string line = text.substr(0, text.find('\n'));
  std::vector<std::string> names;
  (void)scan_csv(line + "\n", [&names](std::vector<std::string>& cells) { names = cells; });
  use_new_names(names, file);
  return names;
}

bool has(const std::vector<std::string>& names, const std::string& name) {
  return std::ranges::find(names, name) != names.end();
}

// ---- words ------------------------------------------------------------------------------------------------------

/// Statistics of columns: endings of names, in words.
constexpr std::array<std::pair<std::string_view, std::string_view>, 8> statistics = {{{"_mean", "Mean of "},
                                                                                      {"_rms", "RMS of "},
                                                                                      {"_range", "Peak to peak of "},
                                                                                      {"_min", "Least "},
                                                                                      {"_max", "Largest "},
                                                                                      {"_h1", "Harmonic 1 of "},
                                                                                      {"_h2", "Harmonic 2 of "},
                                                                                      {"_h3", "Harmonic 3 of "}}};

/// The symbol of a signal, "δ_{sp,1}" of delta_sp and delta_sp_1; its words if it has none; or nothing.
std::string symbol_of(std::string_view signal) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 3> words = {
      {{"transmission_error", "the transmission error"},
       {"force_sun_bearing", "the sun bearing's force"},
       {"planet_spread", "the spread of the planets' deflections"}}};
  for (const auto& [name, text] : words)
    if (signal == name) return std::string(text);
  // "dynamic_factor_" and others of all planets' meshes have no planet's number.
  struct Symbol {
    std::string_view name, symbol, before;
    bool of_all;
  };
  constexpr std::array<Symbol, 6> symbols = {{{"delta_", "δ", "", false},
                                              {"force_", "F", "", false},
                                              {"dynamic_factor_", "K", "", true},
                                              {"kv_", "K", "v,", true},
                                              {"k_gamma_", "K", "γ,", true},
                                              {"load_sharing_", "L", "", false}}};
  for (const auto& [name, symbol, before, of_all] : symbols) {
    if (!signal.starts_with(name)) continue;
    std::string index(signal.substr(name.size()));
    const bool planet = index.size() == 4 && index[2] == '_' && index[3] >= '1' && index[3] <= '9';
    const std::string mesh = index.substr(0, 2);
    if ((mesh != "sp" && mesh != "rp") || !(index.size() == 2 || planet)) continue;
    if (planet)
      index[2] = ',';
    else if (!of_all)
      index += ",1";
    return fmt::format("{}_{{{}{}}}", symbol, before, index);
  }
  return {};
}

struct Described {
  std::string words;
  std::string unit;
};

/// By the lists of columns; of states and histories by their names.
Described described(const std::string& column) {
  static const auto listed_columns = [] {
    std::vector<std::pair<std::string, Described>> all;
    for (const auto& c : store::point_columns(gear::planets_max, {}, {true, true}))
      all.push_back({c.name, {c.meaning, c.unit}});
    for (const auto& c : store::branch_columns(gear::planets_max, {true, true}))
      all.push_back({c.name, {c.meaning, c.unit}});
    return all;
  }();
  const auto found = std::ranges::find(listed_columns, column, &std::pair<std::string, Described>::first);
  if (found != listed_columns.end()) return found->second;
  if (column == "periods") return {"Mesh periods", "1"};
  if (column == "tau") return {"τ", "1"};
  if (column == "time_s") return {"Time", "s"};
  for (const auto& [ending, unit] : {std::pair("_um", "um"), std::pair("_m_per_s", "m/s")})
    if (column.ends_with(ending)) return {column.substr(0, column.size() - std::string_view(ending).size()), unit};
  if (column.ends_with("_rate")) return {"Rate of " + column.substr(0, column.size() - 5), "b_c per tau"};
  if (column.starts_with("force_") || column.starts_with("bearing_")) return {column, "N"};
  if (column.starts_with("load_sharing_")) return {column, "1"};
  return {column, "b_c"};
}

double factor_of(const std::string& column, bool micrometres) {
  return micrometres && described(column).unit == "b_c" ? 1e6 * model::length_scale_m : 1.0;
}

std::string unit_text(const std::string& unit, bool micrometres) {
  if (unit.empty() || unit == "1") return {};
  if (unit == "b_c") return micrometres ? "  [µm]" : " / b_c";
  return "  [" + figures::verbatim_text(unit) + "]";
}

/// The parameter of a study, if it has one.
std::string parameter_of(const input::Study& study) {
  const auto varied = input::varied_parameters(study);
  return varied.empty() ? std::string() : varied.front().axis.name;
}

// ---- figures ----------------------------------------------------------------------------------------------------

constexpr std::array<std::string_view, 10> study_colours{
    figures::ink::blue,      figures::ink::red, figures::ink::green, figures::ink::ochre, figures::ink::purple,
    figures::ink::dark_grey, "#3f8fd0",         "#e08fb0",           "#6fb25a",           "#8a5a2b"};

std::string_view colour_of(std::size_t k) { return study_colours[k % study_colours.size()]; }

/// One figure, put together study by study.
class Plot {
 public:
  Plot(const std::vector<PlottedStudy>& studies, PlotOptions options, std::vector<std::string>& notes)
      : studies_(studies),
        options_(std::move(options)),
        notes_(notes),
        factor_(factor_of(options_.quantity, options_.micrometres)),
        x_factor_(options_.abscissa.empty() ? 1.0 : factor_of(options_.abscissa, options_.micrometres)) {}

  std::vector<DrawnFigure> draw(const std::filesystem::path& folder) {
    std::string stem = options_.quantity;
    if (!options_.abscissa.empty()) stem += "_over_" + options_.abscissa;
    figures::Sketch sketch(stem);
    read_all();
    const bool of_sections = std::ranges::any_of(series_, [](const Series& s) { return s.section; });
    // If both directions are chaotic, one would hide the other: each has a frame of its own.
    std::set<std::string> directions;
    for (const Series& s : series_)
      if (!s.rows.empty() && !s.lines) directions.insert(s.direction);
    const bool apart = of_sections && directions.size() > 1;
    const std::string label =
        (of_sections && !apart ? "Poincaré points of  " : "") + quantity_label(options_.quantity, options_.micrometres);
    const FigureRange x = options_.x ? *options_.x : x_.widened(0.0);
    if (x_.empty() || y_.empty())
      return {{folder / (stem + ".png"),
               {options_.x ? "there is no finite point to draw in that range" : "there is no finite point to draw"}}};
    const FigureRange y = options_.y ? *options_.y : widened_ordinate();
    shown_ = {x, y};
    if (apart) sketch.command("set style textbox opaque noborder fillcolor '#ffffff' margins 0.4,0.4");
    const std::vector<std::string> frames =
        apart ? std::vector<std::string>{"up", "down"} : std::vector<std::string>{{}};
    for (const std::string& frame : frames) {
      figures::FigurePanel panel{label, y, {}};
      panel.logarithmic = options_.logarithmic;
      sketch.panel(std::move(panel));
      for (auto s = series_.rbegin(); s != series_.rend(); ++s)
        if (!apart || s->direction == frame || s->lines) add(sketch, *s);
      if (apart) sketch.letters(std::vector<Place>{{x.high, y.high}}, frame, "right offset character -0.8,-0.9 boxed");
      if (frame == frames.front()) add_legend(sketch, directions.size() > 1 && !apart);
    }
    const figures::FigureText text{title(), abscissa_label(), "", above()};
    std::vector<DrawnFigure> all =
        drawn(folder, stem, sketch.draw(folder, text, x, y, {}, canvas_of(text), figures::Pictures::none));
    if (not_positive_ > 0)
      notes_.push_back(fmt::format("{}: {} not positive, which a logarithmic scale cannot show", stem,
                                   counted(not_positive_, "values are", "value is")));
    note_points(stem);
    return all;
  }

  std::vector<DrawnFigure> draw_map(const std::filesystem::path& folder) {
    const PlottedStudy& of = studies_.front();
    const auto& map = of.study->plan.as<studies::MapOptions>();
    std::vector<std::string> wanted{"direction", "status", options_.quantity};
    const bool has_converged = has(header_of(of.folder / "points.csv"), "converged");
    if (has_converged) wanted.emplace_back("converged");
    const Columns table(of.folder / "points.csv", wanted);
    const figures::CellGrid grid{axis_values(map.plane.first), axis_values(map.plane.second)};
    const std::size_t cells = grid.x.size() * grid.y.size();
    std::vector<DrawnFigure> all;
    for (std::size_t d = 0; d < map.directions.size(); ++d) {
      // Rows are in the order of computing; cells from below, each row from the left.
      const std::size_t columns = grid.x.size();
      std::vector<double> values(cells, nan);
      for (std::size_t k = 0; k < cells && d * cells + k < table.rows(); ++k) {
        const std::size_t step = k % columns;
        const std::size_t column = map.directions[d] == studies::Direction::up ? step : columns - 1 - step;
        const std::size_t row = d * cells + k;
        if (table.word("status", row) != "ok") {
          ++failed_;
          continue;
        }
        if (has_converged && table.number("converged", row) != 1.0) ++not_converged_;
        values[k - step + column] = factor_ * table.number(options_.quantity, row);
      }
      const std::string direction = store::direction_word(map.directions[d]);
      figures::FigureText text{title(), parameter_label(map.plane.first.name), parameter_label(map.plane.second.name),
                               above()};
      if (map.directions.size() > 1) text.title += ", " + direction;
      const std::string stem = options_.quantity + "_" + direction;
      const std::string label = quantity_label(options_.quantity, options_.micrometres);
      std::ranges::move(drawn(folder, stem,
                              figures::scale_figure(folder, stem, text, grid, label, values, canvas_of(text),
                                                    figures::Pictures::none)),
                        std::back_inserter(all));
    }
    note_points(options_.quantity);
    return all;
  }

 private:
  /// Notes on points that are not drawn, or that need care.
  void note_points(const std::string& stem) const {
    if (failed_ > 0)
      notes_.push_back(
          fmt::format("{}: {} not reached and left out", stem, counted(failed_, "points were", "point was")));
    if (not_converged_ > 0)
      notes_.push_back(fmt::format(
          "{}: the record of {} has not converged to the orbit (`converged` in points.csv); their values are "
          "not those of the orbit, and sweeps draw them separately",
          stem, counted(not_converged_, "points")));
  }

  struct Series {
    std::size_t study = 0;
    std::string direction;       ///< "up", "down"; empty: neither
    bool lines = false;          ///< alone, without dots
    bool section = false;        ///< many values over each abscissa
    std::vector<Place> rows;     ///< dots, or stable orbits
    std::vector<Place> joined;   ///< a line through those that belong together, or unstable orbits
    std::vector<Place> apart{};  ///< dots of records that have not converged
  };

  void read_all() {
    for (std::size_t k = 0; k < studies_.size(); ++k) {
      const PlotForm form = plot_source(*studies_[k].study).form;
      if (form == PlotForm::histories)
        read_run(k);
      else if (form == PlotForm::curves)
        read_branches(k);
      else
        read_sweep(k);
    }
    for (const Series& s : series_)
      for (const auto* rows : {&s.rows, &s.joined, &s.apart})
        for (const auto& [x, y] : *rows) {
          if (!std::isfinite(x) || !std::isfinite(y) || (options_.x && (x < options_.x->low || x > options_.x->high)))
            continue;
          x_.include(x);
          y_.include(y);
        }
  }

  /// With a margin, on a logarithmic scale one of a share of its decades.
  [[nodiscard]] FigureRange widened_ordinate() const {
    if (!options_.logarithmic) return y_.widened(figures::figure_margin);
    const FigureRange decades = FigureRange{std::log10(y_.low), std::log10(y_.high)}.widened(figures::figure_margin);
    return {std::pow(10.0, decades.low), std::pow(10.0, decades.high)};
  }

  [[nodiscard]] Place place(double x, double y) {
    if (!std::isfinite(x) || !std::isfinite(y)) return gap;
    if (!options_.x) x_.include(x_factor_ * x);
    if (options_.logarithmic && !(y > 0.0)) {
      ++not_positive_;
      return gap;
    }
    return {x_factor_ * x, factor_ * y};
  }

  [[nodiscard]] std::string abscissa_or(const char* otherwise) const {
    return options_.abscissa.empty() ? otherwise : options_.abscissa;
  }

  void read_sweep(std::size_t k) {
    const std::filesystem::path& folder = studies_[k].folder;
    const std::string x = abscissa_or("value");
    const std::vector<std::string> names = header_of(folder / "points.csv");
    const bool section = !has(names, options_.quantity);
    const bool has_converged = has(names, "converged");  // later than some folders
    std::vector<std::string> wanted{"direction", "status", "regime", x};
    if (has_converged) wanted.emplace_back("converged");
    if (!section) wanted.push_back(options_.quantity);
    const Columns points(folder / "points.csv", wanted);
    // First the abscissas of the points, then the values of the section at each.
    std::vector<Series> by_direction;
    const auto series_at = [&](std::size_t row) -> Series& {
      const std::string& direction = points.word("direction", row);
      auto found = std::ranges::find(by_direction, direction, &Series::direction);
      if (found == by_direction.end())
        found = by_direction.insert(by_direction.end(), Series{k, direction, false, section, {}, {}});
      return *found;
    };
    for (std::size_t row = 0; row < points.rows(); ++row) {
      Series& s = series_at(row);
      const bool reached = points.word("status", row) == "ok";
      if (!reached) ++failed_;
      if (section) {
        if (reached && has_converged && points.number("converged", row) != 1.0) ++not_converged_;
        continue;
      }
      const Place at = reached ? place(points.number(x, row), points.number(options_.quantity, row)) : gap;
      // No line goes through chaos, where such numbers are random, or through a record that has not converged.
      const std::string& regime = points.word("regime", row);
      const bool converged = !has_converged || points.number("converged", row) == 1.0;
      if (reached && !converged) ++not_converged_;
      (converged ? s.rows : s.apart).push_back(at);
      s.joined.push_back(converged && (regime == "periodic" || regime == "quasiperiodic") ? at : gap);
    }
    if (section) {
      const Columns rows(folder / "poincare.csv", {"point", options_.quantity});
      for (std::size_t row = 0; row < rows.rows(); ++row) {
        const auto point = static_cast<std::size_t>(rows.number("point", row));
        if (point >= points.rows() || points.word("status", point) != "ok") continue;
        Series& s = series_at(point);
        const bool converged = !has_converged || points.number("converged", point) == 1.0;
        (converged ? s.rows : s.apart).push_back(place(points.number(x, point), rows.number(options_.quantity, row)));
      }
    }
    std::ranges::move(by_direction, std::back_inserter(series_));
  }

  /// Changes of stability of branches: the orbit before the change (branch, index), and the value.
  static std::map<std::pair<std::string, std::string>, double> stability_changes(const std::filesystem::path& folder) {
    std::map<std::pair<std::string, std::string>, double> changes;
    const Columns special(folder / "special.csv", {"branch", "kind", "after", "value"});
    for (std::size_t row = 0; row < special.rows(); ++row)
      if (std::ranges::count(std::array{"fold", "flip", "neimark_sacker", "branch_point"}, special.word("kind", row)) >
          0)
        changes.emplace(std::pair(special.word("branch", row), special.word("after", row)),
                        special.number("value", row));
    return changes;
  }

  /// A column of poincare.csv: for each crossing its values at the rows of branch.csv, not a number where there is
  /// none.
  static std::vector<std::vector<double>> crossing_values(const std::filesystem::path& folder, const Columns& branches,
                                                          const std::string& quantity) {
    std::map<std::pair<std::string, std::string>, std::size_t> row_of;
    for (std::size_t row = 0; row < branches.rows(); ++row)
      row_of[{branches.word("branch", row), branches.word("index", row)}] = row;
    std::vector<std::vector<double>> all;
    const Columns section(folder / "poincare.csv", {"branch", "index", quantity});
    std::vector<std::size_t> crossings(branches.rows(), 0);  // read of each row
    for (std::size_t k = 0; k < section.rows(); ++k) {
      const auto row = row_of.find({section.word("branch", k), section.word("index", k)});
      if (row == row_of.end()) continue;
      const std::size_t crossing = crossings[row->second]++;
      if (crossing == all.size()) all.emplace_back(branches.rows(), nan);
      all[crossing][row->second] = section.number(quantity, k);
    }
    return all;
  }

  void read_branches(std::size_t k) {
    const std::string x = abscissa_or("value");
    const std::filesystem::path& folder = studies_[k].folder;
    const bool section = !has(header_of(folder / "branch.csv"), options_.quantity);
    std::vector<std::string> wanted{"branch", "index", "stable", "value"};
    if (!section) wanted.push_back(options_.quantity);
    if (x != "value") wanted.push_back(x);
    const Columns table(folder / "branch.csv", wanted);
    const auto changes = stability_changes(folder);
    std::vector<std::vector<double>> curves;
    if (section) {
      curves = crossing_values(folder, table, options_.quantity);
    } else {
      curves.emplace_back();
      for (std::size_t row = 0; row < table.rows(); ++row)
        curves.back().push_back(table.number(options_.quantity, row));
    }
    Series s{k, {}, true, false, {}, {}};
    for (const std::vector<double>& curve : curves) add_branches(s, table, x, curve, changes);
    series_.push_back(std::move(s));
  }

  using StabilityChanges = std::map<std::pair<std::string, std::string>, double>;

  /// @param curve  ordinate of each row of the table
  void add_branches(Series& s, const Columns& table, const std::string& x, const std::vector<double>& curve,
                    const StabilityChanges& changes) {
    for (std::size_t row = 0; row < table.rows(); ++row) {
      const bool begins = row == 0 || table.word("branch", row) != table.word("branch", row - 1);
      const bool stable = table.number("stable", row) == 1.0;
      const Place at = place(table.number(x, row), curve[row]);
      if (begins) {
        s.rows.push_back(gap);
        s.joined.push_back(gap);
      } else if (stable != (table.number("stable", row - 1) == 1.0)) {
        // Lines change with the branch, between the two orbits; at a fold, which is beyond both, halfway.
        const double last = table.number("value", row - 1);
        const auto change = changes.find({table.word("branch", row), table.word("index", row - 1)});
        double part = change == changes.end() ? 1.0 : (change->second - last) / (table.number("value", row) - last);
        const bool is_between = part > 0.0 && part <= 1.0;
        if (!is_between) part = 0.5;
        const auto between = [&](double first, double second) { return (1.0 - part) * first + part * second; };
        const double abscissa =
            is_between || x != "value" ? between(table.number(x, row - 1), table.number(x, row)) : change->second;
        const Place there = place(abscissa, between(curve[row - 1], curve[row]));
        auto& before = stable ? s.joined : s.rows;
        before.push_back(there);
        before.push_back(gap);
        (stable ? s.rows : s.joined).push_back(there);
      }
      (stable ? s.rows : s.joined).push_back(at);
    }
  }

  void read_run(std::size_t k) {
    const std::string x = abscissa_or("periods");
    const Columns table(studies_[k].folder / "history.csv", {x, options_.quantity});
    Series s{k, {}, true, false, {}, {}};
    for (std::size_t row = 0; row < table.rows(); ++row)
      s.rows.push_back(place(table.number(x, row), table.number(options_.quantity, row)));
    series_.push_back(std::move(s));
  }

  [[nodiscard]] bool alone() const { return studies_.size() == 1; }

  void add(figures::Sketch& sketch, const Series& s) const {
    const bool down = s.direction == "down";
    const std::string_view colour = colour_of(alone() && down ? 1 : s.study);
    if (s.lines) {
      sketch.add(s.joined, figures::dashed(colour, 1.6, "(8,6)"));
      sketch.add(s.rows, figures::solid(colour, 2.2));
      return;
    }
    if (s.section) {
      const std::vector<Place> dots = thinned(s.rows);
      constexpr std::size_t many = 2000;
      const double size = dots.size() > many ? 0.15 : 0.4;
      sketch.add(dots, figures::dots(colour, size));
      sketch.add(thinned(s.apart), figures::apart_dots(size));
      return;
    }
    sketch.add(s.joined, down ? figures::dashed(colour, 0.8, "(8,6)") : figures::solid(colour, 0.8));
    constexpr std::size_t many = 300;
    const double size = s.rows.size() > many ? 0.3 : 0.6;
    sketch.add(dots_of(s.rows), figures::dots(colour, size, down ? 6 : 7));
    sketch.add(dots_of(s.apart), figures::apart_dots(size));
  }

  /// Without the gaps, which would part them.
  static std::vector<Place> dots_of(const std::vector<Place>& rows) {
    std::vector<Place> dots;
    std::ranges::copy_if(rows, std::back_inserter(dots), [](const Place& p) { return std::isfinite(p[0]); });
    return dots;
  }

  /// One dot of those that no picture shows apart, the first.
  [[nodiscard]] std::vector<Place> thinned(const std::vector<Place>& rows) const {
    constexpr double columns = 4000;
    constexpr double lines = 3000;
    const auto cell = [](double v, FigureRange r, double n, bool logarithmic) {
      if (logarithmic) {
        r = {std::log10(r.low), std::log10(r.high)};
        v = std::log10(v);
      }
      return r.high > r.low ? static_cast<std::int64_t>(std::floor(n * (v - r.low) / (r.high - r.low))) : 0;
    };
    const auto& [x, y] = shown_;
    std::set<std::pair<std::int64_t, std::int64_t>> taken;
    std::vector<Place> dots;
    for (const Place& p : rows)
      if (std::isfinite(p[0]) &&
          taken.emplace(cell(p[0], x, columns, false), cell(p[1], y, lines, options_.logarithmic)).second)
        dots.push_back(p);
    return dots;
  }

  void add_legend(figures::Sketch& sketch, bool by_direction) const {
    if (!alone())
      for (std::size_t k = 0; k < studies_.size(); ++k)
        sketch.entry(figures::solid(colour_of(k), 2.5), figures::verbatim_text(studies_[k].label));
    if (by_direction)
      for (const bool down : {false, true})
        sketch.entry(figures::dots(alone() ? colour_of(down ? 1 : 0) : figures::ink::dark_grey, 0.8, down ? 6 : 7),
                     down ? "down" : "up");
    if (std::ranges::any_of(series_, [](const Series& s) { return !s.apart.empty(); }))
      sketch.entry(figures::apart_dots(1.0), not_converged_words);
    if (std::ranges::any_of(studies_, draws_curves))
      sketch.entry(figures::dashed(alone() ? colour_of(0) : figures::ink::dark_grey, 1.6, "(8,6)"), "unstable");
  }

  [[nodiscard]] std::string title() const {
    if (!options_.title.empty()) return figures::verbatim_text(options_.title);
    return alone() ? figures::verbatim_text(figure_title(*studies_.front().study)) : std::string();
  }

  [[nodiscard]] std::string abscissa_label() const {
    if (!options_.abscissa.empty()) return quantity_label(options_.abscissa, options_.micrometres);
    const std::string parameter = parameter_of(*studies_.front().study);
    return parameter.empty() ? quantity_label("periods", false) : parameter_label(parameter);
  }

  /// The picture has the requested size, whatever it contains.
  [[nodiscard]] figures::FigureCanvas canvas_of(const figures::FigureText& text) const {
    figures::FigureCanvas canvas = options_.canvas;
    if (text.above) canvas.height -= figures::second_abscissa_height;
    return canvas;
  }

  /// Omega below, and above it the speed that the studies give or the sun's speed, or the reverse; for stages with one
  /// scale of time.
  [[nodiscard]] std::optional<figures::SecondAbscissa> above() const {
    const auto& given = studies_.front().study->axis_speed;
    const std::string key = given ? given->key : "sun_speed_rpm";
    const bool of_speed = options_.abscissa == key;
    if (!(options_.abscissa.empty() || of_speed)) return std::nullopt;
    std::optional<double> per_ratio;
    for (const PlottedStudy& s : studies_) {
      const gear::Stage& stage = s.study->stage;
      if (parameter_of(*s.study) != studies::speed_parameter) return std::nullopt;
      const std::optional<double> ratio = input::ratio_per_unit(*input::find_speed_alias(key), stage);
      if (!ratio) return std::nullopt;
      const double here = 1.0 / *ratio;
      constexpr double rounding = 1e-9;
      if (per_ratio && std::abs(here / *per_ratio - 1.0) > rounding) return std::nullopt;
      per_ratio = here;
    }
    if (of_speed) return figures::SecondAbscissa{parameter_label(studies::speed_parameter), 1.0 / *per_ratio};
    return figures::SecondAbscissa{speed_label(key), *per_ratio};
  }

  [[nodiscard]] std::vector<DrawnFigure> drawn(const std::filesystem::path& folder, const std::string& stem,
                                               figures::FigureOutcome written) const {
    std::vector<DrawnFigure> all;
    for (const figures::Pictures picture : options_.pictures) {
      const char* ending = picture == figures::Pictures::svg   ? ".svg"
                           : picture == figures::Pictures::pdf ? ".pdf"
                                                               : ".png";
      all.push_back(
          {folder / (stem + ending), written.drawn() ? figures::draw_pictures(folder, stem, picture) : written});
    }
    return all;
  }

  const std::vector<PlottedStudy>& studies_;
  PlotOptions options_;
  std::vector<std::string>& notes_;
  double factor_;    ///< of the ordinate's numbers, for their unit
  double x_factor_;  ///< likewise
  std::vector<Series> series_;
  FigureRange x_, y_;
  std::pair<FigureRange, FigureRange> shown_;  ///< of the axes
  std::size_t not_converged_ = 0;              ///< points whose record has not converged
  std::size_t failed_ = 0;                     ///< points that were not reached
  std::size_t not_positive_ = 0;               ///< values that a logarithmic scale has no place for
};

/// "; did you mean ...?" of a column: by its beginning, without case and underscores, else by edit distance.
std::string nearest_column(const std::string& word, const std::vector<std::string>& known) {
  const auto plain = [](const std::string& text) {
    std::string letters;
    for (const char c : text)
      if (std::isalnum(static_cast<unsigned char>(c)) != 0)
        letters += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return letters;
  };
  const auto begins = std::ranges::find_if(
      known, [&](const std::string& name) { return plain(word).size() > 1 && plain(name).starts_with(plain(word)); });
  return begins == known.end() ? input::suggestion(word, known) : "; did you mean '" + *begins + "'?";
}

/// Columns that are words have no place on an axis.
bool is_of_words(const std::string& column) {
  for (const auto& c : store::point_columns(0))
    if (c.name == column) return c.unit.empty();
  return column.starts_with("contact_") || column == "multipliers";
}

}  // namespace

std::vector<std::string> plotted_tables(const input::Study& study) { return plot_source(study).tables; }

std::string quantity_label(const std::string& column, bool micrometres) {
  const Described d = described(column);
  const std::string unit = unit_text(d.unit, micrometres);
  if (std::string label = speed_label(column); !label.empty()) return label;
  if (column == "value") return "Parameter";
  if (const std::string symbol = symbol_of(column); !symbol.empty())
    return (column.starts_with("kv_")        ? "Dynamic factor  "
            : column.starts_with("k_gamma_") ? "Mesh load factor  "
            : symbol.starts_with("K")        ? "Largest force over the static one  "
                                             : "") +
           symbol + unit;
  for (const auto& [ending, words] : statistics)
    if (column.ends_with(ending))
      if (const std::string symbol = symbol_of(std::string_view(column).substr(0, column.size() - ending.size()));
          !symbol.empty())
        return std::string(words) + symbol + unit;
  std::string words = d.words;
  if (!words.empty()) words[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(words[0])));
  return figures::verbatim_text(words) + unit;
}

PlotOptions sound_options(const std::vector<PlottedStudy>& studies, PlotOptions options) {
  const PlottedStudy& first = studies.front();
  const PlotForm form = plot_source(*first.study).form;
  const auto curves = std::ranges::find_if(studies, draws_curves);
  if (options.quantity.empty())
    options.quantity = plot_source(*(curves == studies.end() ? first : *curves).study).quantity;
  for (const PlottedStudy& s : studies) {
    const input::PlotSource& source = plot_source(*s.study);
    const auto over_parameter = [](PlotForm f) { return f == PlotForm::points || f == PlotForm::curves; };
    if (&s != &first && !(source.form == form && form == PlotForm::histories) &&
        !(over_parameter(source.form) && over_parameter(form)))
      throw InputError(fmt::format("plot: {} is a study of kind {}, {} one of kind {}; draw them in separate figures",
                                   first.folder.string(), first.study->kind(), s.folder.string(), s.study->kind()));
    if (options.abscissa.empty() && parameter_of(*s.study) != parameter_of(*first.study))
      throw InputError(fmt::format("plot: {} varies {}, {} varies {}; give --x a column that both have",
                                   first.folder.string(), parameter_of(*first.study), s.folder.string(),
                                   parameter_of(*s.study)));
    std::vector<std::string> known;
    for (const std::string& table : source.tables) {
      std::vector<std::string> names = header_of(s.folder / table);
      if (table == source.tables.front() && !options.abscissa.empty() && !has(names, options.abscissa))
        throw InputError(fmt::format("plot: {} has no column '{}' for the abscissa{}", (s.folder / table).string(),
                                     options.abscissa, input::suggestion(options.abscissa, names)));
      std::ranges::move(names, std::back_inserter(known));
    }
    if (!has(known, options.quantity) && has(known, options.quantity + "_1")) options.quantity += "_1";
    if (!has(known, options.quantity))
      throw InputError(fmt::format("plot: {} has no quantity '{}'{}; docs/reference/columns.md lists them",
                                   s.folder.string(), options.quantity, nearest_column(options.quantity, known)));
  }
  for (const std::string& column : {options.quantity, options.abscissa})
    if (is_of_words(column))
      throw InputError("plot: '" + column + "' is a column of words, which cannot be drawn on an axis");
  if (studies.size() > study_colours.size())
    throw InputError(
        fmt::format("plot: {} studies in one figure; there are colours for {}", studies.size(), study_colours.size()));
  if (form == PlotForm::cells && (options.x || options.y || options.logarithmic || !options.abscissa.empty()))
    throw InputError(
        "plot: a map is drawn over its plane, on a linear scale; it takes no --x, --x-range, --y-range or --log");
  return options;
}

std::vector<DrawnFigure> draw_plot(const std::filesystem::path& folder, const std::vector<PlottedStudy>& studies,
                                   const PlotOptions& options, std::vector<std::string>& notes) {
  Plot plot(studies, options, notes);
  return plot_source(*studies.front().study).form == PlotForm::cells ? plot.draw_map(folder) : plot.draw(folder);
}

}  // namespace epicyclic::reports
