#include "figures/track_figure.hpp"

#include <array>
#include <utility>

#include <fmt/format.h>

#include "core/csv.hpp"
#include "figures/sketch.hpp"

namespace epicyclic::figures {

namespace {

constexpr std::array colours{ink::blue, ink::red, ink::green, ink::ochre, ink::purple, ink::dark_grey};

std::string line_of(std::string_view colour, bool second) {
  return second ? dashed(colour, 0.8, "(8,6)") : solid(colour, 0.8);
}

/// A data set for each series: x, 1 or NaN (joined or not), the numbers; then, where there are some, one of the rows of
/// all series that are drawn apart.
void write_rows(AtomicFile& file, const std::vector<TrackSeries>& series, bool has_apart) {
  constexpr std::size_t block = std::size_t{1} << 20;
  std::string data;
  const auto write = [&](const TrackSeries& each, bool apart) {
    bool empty = true;
    for (std::size_t i = 0; i < each.count; ++i) {
      const auto row = each.at(i);
      // A blank line would begin another curve for dots too: what is not there is written as such.
      if (!row || (apart && !row->apart)) continue;
      append_number(data, row->x);
      data += row->joined && !row->apart ? " 1" : " NaN";
      for (const double y : row->y) {
        data += ' ';
        if (std::isfinite(y) && row->apart == apart) {
          append_number(data, y);
        } else {
          data += "NaN";
        }
      }
      data += '\n';
      empty = false;
      if (data.size() < block) continue;
      file.write(data);
      data.clear();
    }
    return !empty;
  };
  for (const TrackSeries& each : series) {
    data += fmt::format("# {}: x, joined, values\n", gnuplot_quoted(each.label));
    data += write(each, false) ? "\n\n" : "NaN NaN NaN\n\n\n";
  }
  if (has_apart) {
    data += "# drawn apart: x, joined, values\n";
    for (const TrackSeries& each : series) (void)write(each, true);
  }
  file.write(data);
}

}  // namespace

FigureOutcome track_figure(const std::filesystem::path& folder, std::string_view stem, const FigureText& text,
                           const std::vector<TrackSeries>& series, const std::vector<TrackPanel>& panels,
                           const std::vector<std::string>& names, Pictures which, const std::string& apart) {
  bool has_apart = false;
  FigureRange x;
  std::vector<FigureRange> y(panels.size());
  std::size_t most = 0;
  for (const TrackSeries& each : series) {
    most = std::max(most, each.count);
    for (std::size_t i = 0; i < each.count; ++i) {
      const auto row = each.at(i);
      if (!row) continue;
      x.include(row->x);
      has_apart = has_apart || row->apart;
      for (std::size_t p = 0; p < panels.size(); ++p)
        for (const std::size_t column : panels[p].columns) y[p].include(row->y.at(column));
    }
  }
  constexpr std::size_t many = 300;
  const double size = most > many ? 0.3 : 0.6;
  std::vector<FigurePanel> frames;
  std::vector<std::string> legend;
  for (std::size_t p = 0; p < panels.size(); ++p) {
    if (y[p].empty()) continue;
    std::string plot;
    const auto add = [&plot](const std::string& clause) { plot += (plot.empty() ? "" : ", \\\n  ") + clause; };
    for (std::size_t s = series.size(); s-- > 0;)
      for (std::size_t c = 0; c < panels[p].columns.size(); ++c) {
        const std::string_view colour = names.empty() ? colours[s] : colours[c % colours.size()];
        const std::size_t column = panels[p].columns[c] + 3;
        add(fmt::format("'{}.dat' index {} using 1:(${} * $2) with {} notitle", stem, s, column,
                        line_of(colour, !names.empty() && s > 0)));
        add(fmt::format("'{}.dat' index {} using 1:{} with {} notitle", stem, s, column,
                        dots(colour, size, s > 0 ? 6 : 7)));
      }
    for (std::size_t c = 0; has_apart && c < panels[p].columns.size(); ++c)
      add(fmt::format("'{}.dat' index {} using 1:{} with {} notitle", stem, series.size(), panels[p].columns[c] + 3,
                      apart_dots(size)));
    const auto entry = [&](const std::string& style, const std::string& title) {
      add(fmt::format("keyentry with {} title {}", style, gnuplot_quoted(portable_text(title))));
      legend.push_back(title);
    };
    if (frames.empty()) {
      for (std::size_t c = 0; c < names.size(); ++c) entry(solid(colours[c % colours.size()], 2.5), names[c]);
      for (std::size_t s = 0; series.size() > 1 && s < series.size(); ++s)
        entry(names.empty() ? solid(colours[s], 2.5) : line_of(ink::dark_grey, s > 0), series[s].label);
      if (has_apart) entry(apart_dots(1.0), apart);
    }
    frames.push_back({panels[p].y_label, y[p].widened(figure_margin), std::move(plot)});
  }
  if (x.empty() || frames.empty()) return nothing_to_draw("there is no finite point to draw");
  return draw_figure(
      folder, stem, [&](AtomicFile& file) { write_rows(file, series, has_apart); },
      panel_script(stem, text, x.widened(0.0), frames, legend, ""), which);
}

}  // namespace epicyclic::figures
