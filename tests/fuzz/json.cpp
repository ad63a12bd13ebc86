// The strict JSON reader: what it takes without a word, nlohmann-json takes for the same value, and it reads back what
// is written of it; each place that it tells is there.

#include <algorithm>
#include <cstdint>
#include <string>

#include "fuzz.hpp"
#include "input/json_source.hpp"

namespace epicyclic::fuzz {
namespace {

using fuzz::require;
using nlohmann::json;

void look_at(const std::string& text) {
  const input::JsonSource source = input::parse_json(text, "fuzz");
  require(source.bytes == text, "the bytes are kept");
  const int lines = 1 + static_cast<int>(std::ranges::count(text, '\n'));
  for (const input::Problem& problem : source.problems) {
    require(problem.line >= 0 && problem.line <= lines, "a problem stands on a line of the text");
    require(!problem.text().empty(), "a problem has words");
  }
  for (const auto& [pointer, line] : source.line) {
    require(line >= 1 && line <= lines, "a key stands on a line of the text");
    require(source.line_of(pointer) == line, "a key stands where it stands");
    require(source.line_of(pointer + "/none") >= 1, "what is not there stands where its parent does");
  }
  const bool keys_once = std::ranges::none_of(
      source.problems, [](const input::Problem& problem) { return problem.message.starts_with("duplicate key"); });
  if (source.complete && keys_once)
    for (const std::string& pointer : source.unreadable)
      require(source.value.contains(json::json_pointer(pointer)), "what was replaced is there");
  const json peer = json::parse(text, nullptr, false);
  if (peer.is_discarded()) require(!source.problems.empty(), "what is no JSON is told");
  if (!source.problems.empty()) return;
  require(source.complete, "a text without problems is complete");
  require(source.value == peer, "the value is that of another reader");
  for (const auto& [pointer, line] : source.line)
    require(source.value.contains(json::json_pointer(pointer)), "a key that has a line is there");
  const input::JsonSource again = input::parse_json(source.value.dump(), "again");
  require(again.complete && again.problems.empty() && again.value == source.value, "it reads what is written of it");
}

}  // namespace
}  // namespace epicyclic::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  epicyclic::fuzz::look_at(std::string(data, data + size));
  return 0;
}
