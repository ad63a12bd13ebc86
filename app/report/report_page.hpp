// The page of a report: template, style and program of app/browser, built into this program, and the data. A content
// security policy allows just the scripts and the style of the page, by their SHA-256; no request leaves it.
#pragma once

#include <string>
#include <string_view>

namespace epicyclic::app {

/// Files of app/browser as they stand in a report; app/browser/embed.cmake makes them.
namespace browser {
extern const std::string_view page;     ///< template, with @NAME@ in place of what differs
extern const std::string_view style;    ///< of page and axes
extern const std::string_view plot;     ///< uPlot, with its licence
extern const std::string_view program;  ///< all modules as one script
}  // namespace browser

/// Text in place of markup.
[[nodiscard]] std::string html_text(std::string_view text);

/// A file that makes no request, or a page of `serve`, which sends requests to the program that it came from.
enum class PageUse { file, served };

/// @param title  text of any kind
/// @param data   by ReportData::encoded()
[[nodiscard]] std::string report_page(std::string_view title, std::string_view version, std::string_view data,
                                      PageUse use = PageUse::file);

}  // namespace epicyclic::app
