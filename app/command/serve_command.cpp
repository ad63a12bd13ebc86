// epicyclic serve: the page of a report, live, for a browser on this machine.

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <thread>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "commands.hpp"
#include "core/version.hpp"
#include "report/report_data.hpp"
#include "report/report_page.hpp"
#include "report/study_report.hpp"
#include "serve/gate.hpp"
#include "serve/http.hpp"
#include "serve/served_studies.hpp"
#include "stop.hpp"
#include "streams.hpp"

namespace epicyclic::app {

namespace {

/// The page without studies, which it requests.
std::string page_of(const ServedStudies& studies) {
  return report_page(studies.title(), EPICYCLIC_VERSION,
                     ReportData().encoded({{"format", 1},
                                           {"program", {{"version", EPICYCLIC_VERSION}, {"commit", EPICYCLIC_COMMIT}}},
                                           {"um_per_b_c", micrometres_per_length_scale()},
                                           {"live", true},
                                           {"studies", nlohmann::json::array()}}),
                     PageUse::served);
}

}  // namespace

int serve_command(const Arguments& arguments) {
  ServedStudies studies(arguments);
  const std::string page = page_of(studies);
  std::optional<Gate> gate;
  // After what its threads use.
  const std::unique_ptr<HttpServer> server = HttpServer::on_loopback(arguments.port);
  gate.emplace(random_token(), server->port(), ServedStudies::actions());
  server->start({.refuse = [&](const HttpRequest& request) { return gate->refuse(request); },
                 .answer = [&](const HttpRequest& request) -> HttpAnswer {
                   const std::string action = gate->action_of(request);
                   if (action.empty()) return {200, "text/html; charset=utf-8", page};
                   auto [status, text] = studies.answer(action, request.body);
                   const bool is_data = action == "data" && status == 200;
                   return {status, is_data ? "application/octet-stream" : "application/json", std::move(text)};
                 }});
  print("open http://127.0.0.1:{}{}\n", server->port(), gate->page());
  while (!stop_requested()) std::this_thread::sleep_for(std::chrono::milliseconds(20));
  const bool stopped = studies.end();
  server->stop();
  return stopped ? stopped_early : done;
}

}  // namespace epicyclic::app
