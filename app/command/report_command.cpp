// epicyclic report: one page of finished studies, to be read in a browser without a network.

#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "commands.hpp"
#include "core/atomic_file.hpp"
#include "core/errors.hpp"
#include "core/version.hpp"
#include "report/report_data.hpp"
#include "report/report_page.hpp"
#include "report/study_report.hpp"
#include "stop.hpp"
#include "streams.hpp"

namespace epicyclic::app {

namespace {

/// A page, and nothing that a study keeps.
std::filesystem::path output_of(const std::vector<std::filesystem::path>& folders,
                                const std::filesystem::path& output) {
  std::filesystem::path file = output.empty() ? folders.front() / "report.html" : output;
  std::error_code error;
  if (std::filesystem::is_directory(file, error))
    throw InputError("--output " + file.string() + ": is a folder; give a file");
  if (file.extension() != ".html") throw InputError("--output " + file.string() + ": must end with .html");
  const std::filesystem::path folder = file.parent_path();
  if (!folder.empty() && !std::filesystem::is_directory(folder, error))
    throw InputError("--output " + file.string() + ": its folder does not exist");
  return file;
}

}  // namespace

std::filesystem::path write_report(const std::vector<std::filesystem::path>& folders,
                                   const std::filesystem::path& output, int threads) {
  ReportData data;
  nlohmann::json studies = nlohmann::json::array();
  for (const auto& folder : folders) studies.push_back(study_report(folder, data, give_up_if_stopped, threads));
  const std::filesystem::path file = output_of(folders, output);
  std::string title;
  for (const auto& study : studies) title += (title.empty() ? "" : ", ") + study["title"].get<std::string>();
  const std::string page =
      report_page(title.empty() ? "Report" : title, EPICYCLIC_VERSION,
                  data.encoded({{"format", 1},
                                {"program", {{"version", EPICYCLIC_VERSION}, {"commit", EPICYCLIC_COMMIT}}},
                                {"um_per_b_c", micrometres_per_length_scale()},
                                {"studies", std::move(studies)}}));
  give_up_if_stopped();
  write_file_atomically(linked_file(file), page);
  return file;
}

int report_command(const Arguments& arguments) {
  const std::filesystem::path file = write_report(arguments.report_folders, arguments.output, arguments.threads);
  if (arguments.json)
    print("{}\n",
          nlohmann::json{{"report", file.string()}}.dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
  else
    print("report: {}\n", file.string());
  return done;
}

}  // namespace epicyclic::app
