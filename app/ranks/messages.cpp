#include "messages.hpp"

#include <fmt/core.h>
#include <unistd.h>

namespace epicyclic::app {

using nlohmann::json;

namespace {

std::string host_name() {
  std::string name(256, '\0');
  if (::gethostname(name.data(), name.size() - 1) != 0) return "unknown";
  return name.c_str();
}

}  // namespace

std::string text_of(const json& message) { return message.dump(-1, ' ', false, json::error_handler_t::replace); }

json report_of(const Ranks& ranks, const std::exception_ptr& error) {
  if (!error) return {{"exit_code", static_cast<int>(done)}};
  const Failure failure = failure_of(error);
  return {{"exit_code", failure.exit_code()},
          {"message", fmt::format("rank {} on {}: {}", ranks.rank(), host_name(), failure.what())}};
}

std::optional<Failure> failure_in(const json& report) {
  const int code = report.at("exit_code").get<int>();
  if (code == done) return std::nullopt;
  return Failure(code, report.at("message").get<std::string>());
}

void say_hello(const Arguments& arguments, const std::string& identity, const std::exception_ptr& error) {
  Ranks& ranks = *arguments.ranks;
  json hello = report_of(ranks, error);
  hello["host"] = host_name();
  hello["program"] = version_text();
  hello["identity"] = identity;
  hello["threads"] = arguments.threads;
  ranks.send(0, Topic::hello, text_of(hello));
}

std::vector<int> muster(const Arguments& arguments, const std::string& identity) {
  Ranks& ranks = *arguments.ranks;
  std::vector<int> threads(static_cast<std::size_t>(ranks.size()), arguments.threads);
  for (int missing = ranks.size() - 1; missing > 0;) {
    const auto message = ranks.receive();
    if (!message) {
      std::this_thread::sleep_for(poll_interval);
      continue;
    }
    if (message->topic != Topic::hello) continue;
    --missing;
    const json hello = json::parse(message->bytes);
    if (const auto failure = failure_in(hello)) throw *failure;
    const std::string who = fmt::format("rank {} on {}", message->from, hello.at("host").get<std::string>());
    if (hello.at("program") != version_text())
      throw Failure(bad_input,
                    fmt::format("{} runs another program:\n{}", who, hello.at("program").get<std::string>()));
    if (hello.at("identity") != identity) throw Failure(bad_input, who + " reads another input from the same path");
    threads[static_cast<std::size_t>(message->from)] = hello.at("threads").get<int>();
  }
  return threads;
}

void let_go(Ranks& ranks, int exit_code) {
  for (int rank = 1; rank < ranks.size(); ++rank)
    ranks.send(rank, Topic::leave, bytes_of(std::vector<Index>{static_cast<Index>(exit_code)}));
}

}  // namespace epicyclic::app
