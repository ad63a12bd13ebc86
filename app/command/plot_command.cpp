// epicyclic plot: figures of what finished studies left in their folders, without computing.

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "commands.hpp"
#include "core/errors.hpp"
#include "finished_study.hpp"
#include "folder.hpp"
#include "input/aliases.hpp"
#include "reports/plot_output.hpp"
#include "stop.hpp"
#include "streams.hpp"

namespace epicyclic::app {

namespace {

/// "A:B".
figures::FigureRange parse_range(const std::string& option, const std::string& text) {
  figures::FigureRange range;
  const std::size_t colon = text.find(':');
  const char* const end = text.data() + text.size();
  const char* const middle = text.data() + std::min(colon, text.size());
  const auto low = std::from_chars(text.data(), middle, range.low);
  if (colon == std::string::npos || low.ec != std::errc() || low.ptr != middle)
    throw InputError(option + " " + text + ": must be FROM:TO");
  const auto high = std::from_chars(middle + 1, end, range.high);
  if (high.ec != std::errc() || high.ptr != end || !std::isfinite(range.low) || !std::isfinite(range.high))
    throw InputError(option + " " + text + ": must be FROM:TO");
  if (!(range.low < range.high)) throw InputError(option + " " + text + ": FROM must be < TO");
  return range;
}

/// "WIDTHxHEIGHT" in pixels.
figures::FigureCanvas parse_canvas(const PlotArguments& plot) {
  figures::FigureCanvas canvas;
  constexpr int least = 200;
  constexpr int most = 10000;
  if (!plot.size.empty()) {
    const std::size_t x = plot.size.find('x');
    const char* const end = plot.size.data() + plot.size.size();
    const char* const middle = plot.size.data() + std::min(x, plot.size.size());
    const auto width = std::from_chars(plot.size.data(), middle, canvas.width);
    const bool wide = x != std::string::npos && width.ec == std::errc() && width.ptr == middle;
    const auto height = wide ? std::from_chars(middle + 1, end, canvas.height) : width;
    if (!wide || height.ec != std::errc() || height.ptr != end)
      throw InputError("--size " + plot.size + ": must be WIDTHxHEIGHT in pixels, as 1800x1100");
    for (const int length : {canvas.width, canvas.height})
      if (length < least || length > most)
        throw InputError(fmt::format("--size {}: must be from {} to {} pixels", plot.size, least, most));
  }
  constexpr double usual_font = 24;
  canvas.scale = plot.font / usual_font;
  // What is left for the layout, in pixels of the usual font.
  canvas.width = static_cast<int>(std::lround(canvas.width / canvas.scale));
  canvas.height = static_cast<int>(std::lround(canvas.height / canvas.scale));
  if (canvas.width < 2 * least || canvas.height < 2 * least)
    throw InputError(fmt::format("--font {}: is too large for a picture of that size", plot.font));
  return canvas;
}

std::vector<figures::Pictures> parse_formats(const std::vector<std::string>& formats) {
  std::vector<figures::Pictures> all;
  for (const std::string& format : formats) {
    const auto picture = format == "png"   ? figures::Pictures::png
                         : format == "svg" ? figures::Pictures::svg
                                           : figures::Pictures::pdf;
    if (std::ranges::find(all, picture) == all.end()) all.push_back(picture);
  }
  return all.empty() ? std::vector{figures::Pictures::png, figures::Pictures::svg} : all;
}

/// The name of today of a column that is given by an old one, with a warning.
std::string column_of_today(const std::string& name) {
  const input::Alias* alias = input::find_column_alias(name);
  if (alias == nullptr) return name;
  tell("warning: {}\n", alias->warning());
  return std::string(alias->new_name);
}

/// The folder for the figures; not one that a study lives in, nor one in such a one.
void make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  for (auto of = std::filesystem::weakly_canonical(folder, error); !of.empty(); of = of.parent_path()) {
    if (std::filesystem::exists(of / "run.json", error) && std::filesystem::exists(of / ".lock", error))
      throw InputError(folder.string() + ": belongs to the study in " + of.string() +
                       "; give --output another folder for the figures");
    if (of == of.parent_path()) break;
  }
  std::filesystem::create_directories(folder, error);
  if (error) throw OutputError(folder.string() + ": " + error.message());
}

}  // namespace

int plot_command(const Arguments& arguments) {
  const PlotArguments& given = arguments.plot;
  reports::PlotOptions options;
  options.abscissa = column_of_today(given.abscissa);
  if (!given.x_range.empty()) options.x = parse_range("--x-range", given.x_range);
  if (!given.y_range.empty()) options.y = parse_range("--y-range", given.y_range);
  if (given.logarithmic && options.y && !(options.y->low > 0.0))
    throw InputError("--y-range " + given.y_range + ": must be above 0 with --log");
  options.micrometres = given.micrometres;
  options.logarithmic = given.logarithmic;
  options.title = given.title;
  options.canvas = parse_canvas(given);
  options.pictures = parse_formats(given.formats);
  options.canvas.pdf = std::ranges::find(options.pictures, figures::Pictures::pdf) != options.pictures.end();
  if (given.labels.size() > given.folders.size())
    throw InputError(
        fmt::format("--label: is given {} times for {} folders", given.labels.size(), given.folders.size()));

  std::vector<FinishedTables> tables;
  for (const auto& folder : given.folders) tables.push_back(finished_tables(folder, reports::plotted_tables));
  std::vector<reports::PlottedStudy> studies;
  for (std::size_t k = 0; k < tables.size(); ++k)
    studies.push_back(
        {tables[k].folder, &tables[k].input.study,
         k < given.labels.size() && !given.labels[k].empty() ? given.labels[k] : tables[k].folder.string()});
  std::vector<std::string> quantities = given.quantities;
  if (quantities.empty()) quantities.emplace_back();
  std::vector<reports::PlotOptions> plots;
  for (const std::string& quantity : quantities) {
    options.quantity = column_of_today(quantity);
    plots.push_back(reports::sound_options(studies, options));
  }
  make_folder(arguments.output);
  std::vector<reports::DrawnFigure> figures;
  std::vector<std::string> notes;
  for (const reports::PlotOptions& plot : plots) {
    std::ranges::move(reports::draw_plot(arguments.output, studies, plot, notes), std::back_inserter(figures));
    give_up_if_stopped();
  }
  for (const std::string& note : notes) tell("{}\n", note);
  (void)report_undrawn(figures);
  nlohmann::json told = {{"figures", nlohmann::json::array()}};
  for (const reports::DrawnFigure& figure : figures)
    if (figure.outcome.drawn()) told["figures"].push_back(figure.file.string());
  if (arguments.json)
    print("{}\n", told.dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
  else
    for (const auto& figure : told["figures"]) print("figure: {}\n", figure.get<std::string>());
  // A figure that is asked for by name is missed, too, where there is nothing to draw.
  return std::ranges::all_of(figures, [](const auto& figure) { return figure.outcome.drawn(); }) ? done
                                                                                                 : done_with_failures;
}

}  // namespace epicyclic::app
