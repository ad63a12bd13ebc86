// The study reader: whatever a study says, it is read or refused with InputError; what is read resolves to an input
// that resolves to itself, and takes each of its own numbers.
//
// An input is a study, then, behind a zero byte, assignments as of --set, one a line. It may name the stage stage.json
// or tang2020.json, which is one of lumped values: what catalogue data compute takes milliseconds, so that studies with
// them are read by the tables alone. Ranges of pointers are cut to three values for the same reason.
//
// Mutations are of the JSON value, with the keys and words of the schema, three times of four; else of bytes.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <functional>
#include <optional>
#include <random>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#ifdef EPICYCLIC_HAS_CLAIMS
#include "claims/kind.hpp"
#endif
#include "core/errors.hpp"
#include "fuzz.hpp"
#include "input/study_input.hpp"
#include "input/study_model.hpp"
#include "store/identity.hpp"

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size);

namespace epicyclic::fuzz {
namespace {

using fuzz::require;
using nlohmann::json;

#ifdef EPICYCLIC_HAS_CLAIMS
[[maybe_unused]] const bool has_claims = (input::add_kind(claims::claims_kind()), true);
#endif

const fuzz::Folder& folder() {
  static const fuzz::Folder the_folder;
  static const bool filled = [] {
    std::ifstream stage(EPICYCLIC_SOURCE_DIR "/tests/input/bad_inputs/stage.json", std::ios::binary);
    const std::string text(std::istreambuf_iterator<char>(stage), {});
    require(!text.empty(), "the stage is there");
    for (const char* name : {"stage.json", "tang2020.json"}) fuzz::put_file(the_folder / name, text);
    return true;
  }();
  (void)filled;
  return the_folder;
}

/// The study as it would be in a file, and what it is set to.
struct Input {
  std::string study;
  std::vector<std::string> sets;
};

Input input_in(const std::string& bytes) {
  const auto end = bytes.find('\0');
  Input input{bytes.substr(0, end), {}};
  if (end == std::string::npos) return input;
  std::istringstream lines(bytes.substr(end + 1));
  for (std::string line; std::getline(lines, line);)
    if (line.find("points") == std::string::npos && line.find("parameter") == std::string::npos)
      input.sets.push_back(line);
  return input;
}

/// Three values for each range of a pointer.
void shorten_ranges(const json& study, std::vector<std::string>& sets) {
  const auto plan = study.is_object() ? study.find("study") : study.end();
  if (!study.is_object() || plan == study.end() || !plan->is_object()) return;
  const auto shorten = [&](const json& axis, const std::string& place) {
    if (!axis.is_object()) return;
    const auto parameter = axis.find("parameter");
    if (parameter != axis.end() && parameter->is_string() && parameter->get_ref<const std::string&>().starts_with('/'))
      sets.push_back(place + "/points=3");
  };
  shorten(*plan, "/study");
  for (const char* key : {"first", "second"})
    if (plan->contains(key)) shorten((*plan)[key], std::string("/study/") + key);
}

template <class T>
void look_at_table(const input::Table<T>& table, const json& value) {
  T read;
  input::ReadContext context;
  table.read(value, "", read, context);
  if (!context.findings.empty()) return;
  const json written = table.write(read);
  T again;
  table.read(written, "", again, context);
  require(context.findings.empty(), "what a table writes, it reads");
  require(table.write(again) == written, "what a table reads back is the same");
}

void look_at(const std::string& bytes) {
  Input input = input_in(bytes);
  if (input.study.find("catalogue") != std::string::npos) {
    const input::JsonSource source = input::parse_json(input.study, "study.json");
    look_at_table(input::stage_table(), source.value);
    look_at_table(input::study_table(), source.value);
    return;
  }
  shorten_ranges(json::parse(input.study, nullptr, false), input.sets);
  const auto file = folder() / "study.json";
  fuzz::put_file(file, input.study);
  std::vector<input::Assignment> sets;
  std::optional<input::LoadedInput> loaded;
  try {
    sets = input::parse_assignments(input.sets);
    loaded = input::load_input(file, sets);
  } catch (const InputError& error) {
    require(*error.what() != '\0', "a refusal has words");
    return;
  }
  require(store::identity({loaded->resolved, loaded->computed}, "sweep").size() == 64, "it has an identity");
  // Twice the work for some of them.
  const std::size_t hash = std::hash<std::string>()(bytes);
  if (hash % 8 != 0) return;
  const std::string resolved = loaded->resolved.dump();
  const auto resolved_file = folder() / "resolved.json";
  fuzz::put_file(resolved_file, resolved);
  const input::LoadedInput again = input::load_input(resolved_file);
  require(again.resolved.dump() == resolved, "what is resolved resolves to itself");
  require(store::identity({again.resolved, again.computed}, "sweep") ==
              store::identity({loaded->resolved, loaded->computed}, "sweep"),
          "what is resolved is the same study");
  const auto pointers = loaded->number_pointers();
  if (pointers.empty()) return;
  const std::string& pointer = pointers[hash / 8 % pointers.size()];
  const double value = loaded->resolved.at(json::json_pointer(pointer)).get<double>();
  require(input::stage_table().write(loaded->with_value(pointer, value).stage) ==
              input::stage_table().write(loaded->study.stage),
          "a number in its own place changes nothing");
}

// ---- mutations ----

/// Keys of the input, and the words that it knows.
struct Words {
  std::vector<std::string> keys, texts;
};

const Words& words() {
  static const Words all = [] {
    std::set<std::string> keys;
    std::set<std::string> texts = {"computed",   "computed: x",   "default",   "source: x", "stage_patch",
                                   "stage.json", "tang2020.json", "none.json", "rigid",     "auto",
                                   "1500 rpm",   "NaN",           ""};
    const std::function<void(const json&)> walk = [&](const json& value) {
      if (value.is_object())
        for (const auto& [key, child] : value.items()) {
          if (key == "properties")
            for (const auto& property : child.items()) keys.insert(property.key());
          if (key == "enum")
            for (const auto& text : child) texts.insert(text.get<std::string>());
          if (key == "const") texts.insert(child.get<std::string>());
          walk(child);
        }
      if (value.is_array())
        for (const auto& child : value) walk(child);
    };
    walk(json::parse(input::schema_text()));
    return Words{{keys.begin(), keys.end()}, {texts.begin(), texts.end()}};
  }();
  return all;
}

class Mutator {
 public:
  explicit Mutator(unsigned seed) : random_(seed) {}

  [[nodiscard]] std::size_t below(std::size_t count) { return random_() % count; }

  void mutate(json& whole) {
    std::vector<json*> nodes;
    std::vector<std::pair<json*, std::string>> members;
    collect(whole, nodes, members);
    json& node = *nodes[below(nodes.size())];
    switch (below(8)) {
      case 0:
        node = any_value();
        break;
      case 1:
        node = json(*nodes[below(nodes.size())]);
        break;
      case 2:
        if (members.empty()) break;
        {
          auto& [object, key] = members[below(members.size())];
          object->erase(std::string(key));
        }
        break;
      case 3:
      case 4:
        if (node.is_object()) node[any_of(words().keys)] = any_value();
        if (node.is_array()) node.push_back(any_value());
        break;
      case 5:
        if (node.is_number()) node = changed(node.get<double>());
        break;
      case 6:
        if (members.empty()) break;
        {
          auto& [object, key] = members[below(members.size())];
          json text = any_of(words().texts);
          json& origin = (*object)["origin"];
          if (below(3) == 0 || !(origin.is_object() || origin.is_null()))
            origin = std::move(text);
          else
            origin[key] = std::move(text);
        }
        break;
      default:
        if (node.is_string()) node = any_of(words().texts);
        break;
    }
  }

 private:
  static void collect(json& value, std::vector<json*>& nodes, std::vector<std::pair<json*, std::string>>& members) {
    nodes.push_back(&value);
    if (value.is_object())
      for (auto& [key, child] : value.items()) {
        members.emplace_back(&value, key);
        collect(child, nodes, members);
      }
    if (value.is_array())
      for (auto& child : value) collect(child, nodes, members);
  }

  [[nodiscard]] const std::string& any_of(const std::vector<std::string>& texts) { return texts[below(texts.size())]; }

  json any_value() {
    static const std::vector<json> values = {json(),
                                             true,
                                             false,
                                             json::object(),
                                             json::array(),
                                             0,
                                             1,
                                             -1,
                                             2,
                                             3,
                                             0.5,
                                             1e-3,
                                             1e3,
                                             1e8,
                                             -0.0,
                                             1e300,
                                             -1e300,
                                             1e-300,
                                             5e-324,
                                             27.5,
                                             1e15,
                                             json::array({1, 2, 3}),
                                             json::array({json()}),
                                             json{{"origin", "computed: x"}}};
    return below(3) == 0 ? json(any_of(words().texts)) : values[below(values.size())];
  }

  double changed(double x) {
    const std::array<double, 8> values = {-x, x + 1, x - 1, x * 1.0001, x * 10, x / 10, x * 1e10, 0};
    const double y = values[below(values.size())];
    return std::isfinite(y) ? y : 1e300;
  }

  std::minstd_rand random_;
};

}  // namespace
}  // namespace epicyclic::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  epicyclic::fuzz::look_at(std::string(data, data + size));
  return 0;
}

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max_size,
                                               unsigned seed) {
  using nlohmann::json;
  epicyclic::fuzz::Mutator mutator(seed);
  if (mutator.below(4) == 0) return LLVMFuzzerMutate(data, size, max_size);
  const std::string bytes(data, data + size);
  const auto end = std::min(bytes.find('\0'), bytes.size());
  json value = json::parse(bytes.substr(0, end), nullptr, false);
  if (value.is_discarded()) return LLVMFuzzerMutate(data, size, max_size);
  for (std::size_t k = 1 + mutator.below(3); k > 0; --k) mutator.mutate(value);
  const std::string text = value.dump(-1, ' ', false, json::error_handler_t::replace) + bytes.substr(end);
  if (text.size() > max_size) return LLVMFuzzerMutate(data, size, max_size);
  std::memcpy(data, text.data(), text.size());
  return text.size();
}
