// A study's identity: equal exactly where the values that decide its results are, whatever is done to an input.
//
// Each place of each input in inputs/, and of its resolved form, is changed in each way. The model is judged by its
// right-hand side, which knows nothing of identities.
#include "store/identity.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <deque>
#include <filesystem>
#include <map>
#include <optional>
#include <random>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "input/recorded_study.hpp"
#include "input/stage_completion.hpp"
#include "input/study_input.hpp"
#include "input/study_model.hpp"
#include "store/digest.hpp"
#include "temporary_folder.hpp"

namespace epicyclic::reports::identity_test {
namespace {

namespace fs = std::filesystem;

std::string identity_of(const input::LoadedInput& input, const std::string& command) {
  return store::identity({input.resolved, input.computed}, command);
}

std::vector<std::string> differences_from(nlohmann::json other, const input::LoadedInput& input) {
  const nlohmann::json computed = input::computed_values(other);
  return store::differences({other, computed}, {input.resolved, input.computed});
}
using nlohmann::json;
using test::put_file;

enum class Change { value, last_digit, computed, empty_object, empty_array, null, text, erased };
constexpr Change changes[] = {Change::value,       Change::last_digit, Change::computed, Change::empty_object,
                              Change::empty_array, Change::null,       Change::text,     Change::erased};
constexpr const char* names[] = {"value", "last digit", "computed", "{}", "[]", "null", "text", "erased"};

struct Case {
  const json* input;  ///< unchanged
  std::string pointer;
  Change change;
  [[nodiscard]] std::string text() const { return pointer + " " + names[static_cast<std::size_t>(change)]; }
};

/// Pointers of all values below, objects and the ends of arrays too.
void collect(const json& value, const std::string& pointer, std::vector<std::string>& pointers) {
  if (!pointer.empty()) pointers.push_back(pointer);
  if (value.is_object())
    for (const auto& [key, child] : value.items()) collect(child, pointer + input::pointer_step(key), pointers);
  if (value.is_array() && !value.empty())
    for (const std::size_t k : std::set<std::size_t>{0, value.size() - 1})
      collect(value[k], pointer + "/" + std::to_string(k), pointers);
}

json without_bookkeeping(json value) {
  if (!value.is_object()) return value;
  value.erase("origin");
  value.erase("note");
  for (auto& [key, child] : value.items()) child = without_bookkeeping(std::move(child));
  return value;
}

/// Is the pointer that of an origin, a note, or of something in them?
bool in_bookkeeping(const std::string& pointer) {
  return (pointer + "/").find("/origin/") != std::string::npos || pointer.ends_with("/note");
}

/// Another value of the same kind, one that is a name from those that the schema lists.
json another(const json& value, const std::string& pointer) {
  if (value.is_boolean()) return !value.get<bool>();
  if (value.is_number_integer()) return value.get<int>() + 1;
  if (value.is_number()) return value.get<double>() == 0.0 ? 0.25 : value.get<double>() * 1.001;
  if (value.is_array()) {
    json changed = value;
    if (changed.empty()) return json::array({0.5});
    changed[0] = another(changed[0], pointer);
    return changed;
  }
  static const std::map<std::string, std::string> other_names = {{"arkode-dopri5", "arkode-cash-karp"},
                                                                 {"lanes-dopri5", "lanes-cash-karp"},
                                                                 {"always", "contact_slope"},
                                                                 {"automatic", "off"},
                                                                 {"up", "down"},
                                                                 {"continued", "cold"},
                                                                 {"fixed", "adaptive"},
                                                                 {"as_printed", "star"},
                                                                 {"linear_xy", "linear_radial"},
                                                                 {"full", "shortened"},
                                                                 {"shortened", "full"},
                                                                 {"harmonics", "curve"},
                                                                 {"none", "trochoid"},
                                                                 {"half_plane", "rigid"},
                                                                 {"centreline", "contact_height"},
                                                                 {"6213", "6020"},
                                                                 {"damping_ratio", "sun_planet_backlash"}};
  const std::string text = value.get<std::string>();
  const auto it = other_names.find(text);
  return it == other_names.end() ? text + ": another" : it->second;
}

/// @returns nothing if there is no such change of that value
std::optional<json> changed(const Case& c) {
  json whole = *c.input;
  const json::json_pointer at(c.pointer);
  json& value = whole.at(at);
  json& parent = whole.at(at.parent_pointer());
  switch (c.change) {
    case Change::value:
      if (value.is_object()) return std::nullopt;
      value = another(value, c.pointer);
      break;
    case Change::last_digit:
      if (!value.is_number_float()) return std::nullopt;
      value = std::nextafter(value.get<double>(), 1e300);
      break;
    case Change::computed: {
      if (value.is_object() || c.pointer.ends_with("/note")) return std::nullopt;
      if (in_bookkeeping(c.pointer)) {
        value = "computed: x";
      } else if (parent.is_object()) {
        if (!parent.contains("origin") || !parent["origin"].is_object()) parent["origin"] = json::object();
        parent["origin"][at.back()] = "computed: x";
      } else {
        return std::nullopt;
      }
      break;
    }
    case Change::empty_object:
      value = json::object();
      break;
    case Change::empty_array:
      value = json::array();
      break;
    case Change::null:
      value = nullptr;
      break;
    case Change::text:
      value = "oops";
      break;
    case Change::erased:
      if (!parent.is_object()) return std::nullopt;
      if (parent.contains("origin") && parent["origin"].is_object()) parent["origin"].erase(at.back());
      parent.erase(at.back());
      break;
  }
  return whole;
}

/// Must the change be refused, as a value of the wrong type?
bool is_wrong_type(const Case& c) {
  const json& value = c.input->at(json::json_pointer(c.pointer));
  const bool patch = c.pointer.starts_with("/stage_patch");
  switch (c.change) {
    case Change::empty_object:
      return !value.is_object() && !c.pointer.ends_with("/origin");
    case Change::empty_array:
      return !value.is_array();
    case Change::null:
      return !patch || in_bookkeeping(c.pointer);  // in a patch it removes what is there
    case Change::text:
      return !value.is_string() || in_bookkeeping(c.pointer + "/");
    default:
      return false;
  }
}

/// Numbers that depend on everything in the model: its right-hand side at a few states, on and off the teeth.
std::string fingerprint(const input::LoadedInput& input) {
  const input::Study& study = input.study;
  if (!study.has_points()) return {};
  const studies::GridPoint first = input::plan_of(study).points.front();
  const model::DynamicModel model = input::model_at_point(input)(first);
  std::string bytes;
  const auto append = [&](double number) { bytes.append(reinterpret_cast<const char*>(&number), sizeof number); };
  std::vector<double> state = model.default_start, rate(model.dimension);
  for (std::size_t k = 0; k < 6; ++k) {
    const double s = 0.1 + static_cast<double>(k);
    model.right_hand_side(model::segment_at(model.breakpoints, s), s, state.data(), rate.data());
    for (const double r : rate) append(r);
    for (std::size_t i = 0; i < state.size(); ++i) state[i] += std::sin(1.0 + static_cast<double>(i * (k + 3)));
  }
  for (const double x : model.default_start) append(x);
  return bytes;
}

class Property {
 public:
  Property() {
    std::set<fs::path> files;
    for (const auto& entry : fs::directory_iterator("inputs"))
      if (entry.path().extension() == ".json") files.insert(entry.path());
    for (const fs::path& file : files) {
      fs::copy_file(file, folder_ / file.filename().string());
      inputs_.push_back(json::parse(test::contents(file)));
      inputs_.push_back(input::load_input(file).resolved);
    }
    for (const json& input : inputs_) {
      std::vector<std::string> pointers;
      collect(input, "", pointers);
      // An origin is one kind of text at all places: what it says, and that it is gone, is tried at each.
      for (const std::string& pointer : pointers)
        for (const Change change : changes)
          if (pointer.find("/origin/") == std::string::npos || change == Change::computed || change == Change::text ||
              change == Change::erased)
            cases_.push_back({&input, pointer, change});
    }
  }

  [[nodiscard]] std::vector<Case>& cases() { return cases_; }
  [[nodiscard]] int tried() const { return tried_; }
  [[nodiscard]] int refused() const { return refused_; }
  [[nodiscard]] int same() const { return same_; }

  void check(const Case& c) {
    const std::optional<json> text = changed(c);
    if (!text) return;
    ++tried_;
    SCOPED_TRACE(c.input->value("name", "") + " " + c.text());
    const std::optional<input::LoadedInput> input = loaded(*text);
    if (!input) {
      ++refused_;
      if (is_wrong_type(c) && !c.pointer.ends_with("/stage")) {
        EXPECT_EQ(problems_, 1U) << message_;
      }
      return;
    }
    EXPECT_FALSE(is_wrong_type(c)) << "accepted";
    check_identity(*input);
    if (c.change == Change::empty_object) {
      const std::optional<json> without = changed({c.input, c.pointer, Change::erased});
      const std::optional<input::LoadedInput> erased = without ? loaded(*without) : std::nullopt;
      EXPECT_TRUE(erased && identity_of(*erased, "x") == identity_of(*input, "x") &&
                  without_bookkeeping(erased->resolved) == without_bookkeeping(input->resolved))
          << "{} is not what erased is";
    }
    const std::string bytes = input->resolved.dump(2);
    if (!resolved_.insert(store::sha256_hex(bytes)).second) return;  // has been tried
    const std::optional<input::LoadedInput> again = loaded(input->resolved);
    ASSERT_TRUE(again) << message_;
    EXPECT_TRUE(again->resolved.dump(2) == bytes) << json::diff(input->resolved, again->resolved).dump(1);
    EXPECT_EQ(identity_of(*again, "x"), identity_of(*input, "x"));
  }

 private:
  std::optional<input::LoadedInput> loaded(const json& text) {
    put_file(folder_ / "case.json", text.dump());
    try {
      return input::load_input(folder_ / "case.json");
    } catch (const input::InputProblems& error) {
      problems_ = error.problems().size();
      message_ = error.what();
      return std::nullopt;
    }
  }

  void check_identity(const input::LoadedInput& input) {
    const std::string id = identity_of(input, "x");
    const Seen now{store::sha256_hex(without_bookkeeping(input.resolved).dump()),
                   store::sha256_hex(fingerprint(input))};
    const auto [seen, fresh] = by_identity_.emplace(id, now);
    same_ += fresh ? 0 : 1;
    EXPECT_EQ(seen->second.values, now.values) << "one identity, other values";
    EXPECT_EQ(seen->second.model, now.model) << "one identity, another model";
    EXPECT_EQ(by_values_.emplace(now.values, id).first->second, id) << "the same values, another identity";
  }

  struct Seen {
    std::string values, model;  ///< digests
  };
  test::TemporaryFolder folder_;
  std::deque<json> inputs_;
  std::vector<Case> cases_;
  std::set<std::string> resolved_;  ///< digests
  std::map<std::string, Seen> by_identity_;
  std::map<std::string, std::string> by_values_;
  int tried_ = 0, refused_ = 0, same_ = 0;
  std::size_t problems_ = 0;
  std::string message_;
};

// Equal identity exactly where the resolved values are equal, and then the model is; what resolves, resolves to itself;
// a wrong type is refused with one message; {} is refused or is what nothing there is.
TEST(Identity, IsThatOfTheValuesWhateverIsDoneToAnInput) {
  Property property;
  std::mt19937 random(28);
  std::shuffle(property.cases().begin(), property.cases().end(), random);
  for (const Case& c : property.cases()) {
    property.check(c);
    if (property.tried() == 500) break;
  }
  EXPECT_EQ(property.tried(), 500);
  EXPECT_GT(property.refused(), 100);
  EXPECT_GT(property.same(), 100);
}

TEST(IdentityLong, IsThatOfTheValuesWhateverIsDoneToAnInput) {
  Property property;
  for (const Case& c : property.cases()) property.check(c);
  EXPECT_GE(property.tried(), 15000);
  std::printf("%d cases, %d refused, %d of an identity seen before\n", property.tried(), property.refused(),
              property.same());
}

// ---- what was wrong once

class IdentityOf : public ::testing::Test {
 protected:
  [[nodiscard]] input::LoadedInput load(const json& text, const std::vector<std::string>& sets = {}) const {
    put_file(folder / "study.json", text.dump());
    return input::load_input(folder / "study.json", input::parse_assignments(sets));
  }
  json resolved = input::load_input("inputs/tang2020_speed.json").resolved;
  test::TemporaryFolder folder;
};

TEST_F(IdentityOf, AStudyDependsOnValuesThatOnlySayThatTheyWereComputed) {
  const std::string before = identity_of(load(resolved), "sweep");
  for (const char* change :
       {R"({"integrator": {"relative_tolerance": 1e-3, "origin": {"relative_tolerance": "computed: x"}}})",
        R"({"operation": {"mesh_frequency_ratio": 2, "origin": {"mesh_frequency_ratio": "computed"}}})",
        R"({"study": {"to": 3, "origin": {"to": "computed: x"}}})",
        R"({"stage": {"lumped": {"planet": {"support_damping_ratio": 0.07,
                                            "origin": {"support_damping_ratio": "computed: x"}}}}})"}) {
    json changed = resolved;
    changed.merge_patch(json::parse(change));
    EXPECT_NE(identity_of(load(changed), "sweep"), before) << change;
  }
}

TEST_F(IdentityOf, AStageWithoutItsCatalogueDependsOnItsMasses) {
  resolved["stage"].erase("catalogue");
  const input::LoadedInput before = load(resolved);
  ASSERT_EQ(before.notes.size(), 1U);
  EXPECT_NE(before.notes[0].find("nothing computes them here; they stand as given"), std::string::npos)
      << before.notes[0];
  resolved["stage"]["lumped"]["sun"]["mass_kg"] = 1.7;
  const input::LoadedInput after = load(resolved);
  EXPECT_EQ(after.study.stage.sun.mass_kg, 1.7);
  EXPECT_NE(identity_of(before, "sweep"), identity_of(after, "sweep"));
  const std::vector<std::string> lines = differences_from(before.resolved, after);
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_EQ(lines[0].rfind("/stage/lumped/sun/mass_kg: 1.65", 0), 0U) << lines[0];
}

TEST_F(IdentityOf, AStudyIsTheSameWhereLastDigitsOfWhatIsComputedAreOthers) {
  input::LoadedInput input = load(resolved);
  const std::string before = identity_of(input, "sweep");
  // Another machine computes another last digit ...
  const json::json_pointer mass("/stage/lumped/sun/mass_kg");
  const double there = std::nextafter(input.resolved.at(mass).get<double>(), 10.0);
  input.resolved.at(mass) = there;
  input.computed.at(mass) = there;
  EXPECT_EQ(identity_of(input, "sweep"), before);
  // ... but one that is given counts to its last digit, and so does one in a sweep of another width.
  input.computed.at(mass) = std::nextafter(there, 10.0);
  EXPECT_NE(identity_of(input, "sweep"), before);
  EXPECT_NE(identity_of(load(resolved, {"/stage/catalogue/sun/width_mm=61"}), "sweep"), before);
}

TEST_F(IdentityOf, StudiesThatDifferInAFlagDifferInNoNumberThatIsTheSame) {
  const input::LoadedInput here = load(resolved);
  // With the flags, other numbers are computed, or none at all: the numbers there are then given ones.
  json as_given = here.resolved;
  as_given["stage"]["catalogue"]["ring"]["base_pitch"] = "as_given";
  EXPECT_EQ(differences_from(as_given, here),
            std::vector<std::string>{"/stage/catalogue/ring/base_pitch: \"as_given\" there, \"of_planet\" here"});
  json fixed_ring = here.resolved;
  fixed_ring["stage"]["boundary"] = "fixed_ring";
  EXPECT_EQ(differences_from(fixed_ring, here),
            std::vector<std::string>{"/stage/boundary: \"fixed_ring\" there, \"as_printed\" here"});
}

TEST_F(IdentityOf, AListThatIsAbsentIsNoDifferenceFromAnEmptyOne) {
  json other = resolved;
  other["study"]["name_of_nothing"] = json::array();
  EXPECT_EQ(differences_from(other, load(resolved)),
            std::vector<std::string>{"/study/name_of_nothing: [] there, absent here"});
  const input::LoadedInput wider = load(resolved, {"/stage/catalogue/sun/width_mm=61"});
  EXPECT_EQ(differences_from(other, wider),
            std::vector<std::string>{"/stage/catalogue/sun/width_mm: 60.0 there, 61.0 here"});
}

TEST_F(IdentityOf, AStudyToldAsAnotherSaysInWhatIsGiven) {
  const input::LoadedInput wider = load(resolved, {"/stage/catalogue/sun/width_mm=61"});
  EXPECT_EQ(differences_from(resolved, wider),
            std::vector<std::string>{"/stage/catalogue/sun/width_mm: 60.0 there, 61.0 here"});
  const input::LoadedInput heavier = load(resolved, {"/stage/lumped/sun/mass_kg=2"});
  const auto lines = differences_from(resolved, heavier);
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_EQ(lines[0].rfind("/stage/lumped/sun/mass_kg: 1.65", 0), 0U) << lines[0];
}

TEST_F(IdentityOf, ARecordOfAnEarlierProgramIsStillOfTheSameStudy) {
  json earlier = resolved;
  ASSERT_EQ(earlier["model"].erase("centrifugal"), 1U);
  input::add_later_keys(earlier);
  EXPECT_EQ(earlier["model"], resolved["model"]);
  const input::LoadedInput left_out = load(resolved, {"/model/centrifugal=\"left_out\""});
  EXPECT_EQ(differences_from(earlier, left_out), std::vector<std::string>{});
  const input::LoadedInput included = load(resolved, {"/model/centrifugal=\"included\""});
  EXPECT_EQ(differences_from(earlier, included),
            std::vector<std::string>{"/model/centrifugal: \"left_out\" there, \"included\" here"});
  // Of a stage with drawings, whose errors were single pitch deviations then.
  ASSERT_EQ(earlier["stage"]["catalogue"].erase("error_amplitude"), 1U);
  input::add_later_keys(earlier);
  EXPECT_EQ(earlier["stage"]["catalogue"]["error_amplitude"], "single_pitch");
  EXPECT_EQ(differences_from(earlier, left_out), std::vector<std::string>{});
  // What is there stays.
  json other = included.resolved;
  input::add_later_keys(other);
  EXPECT_EQ(other, included.resolved);
}

TEST_F(IdentityOf, AnEmptyObjectSwitchesNothing) {
  json study = json::parse(test::contents("inputs/tang2020_speed.json"));
  study["stage"] = json::parse(test::contents("inputs/tang2020.json"));
  const std::string before = identity_of(load(study), "sweep");
  const auto with = [&](const std::string& set) { return identity_of(load(study, {set}), "sweep"); };
  const std::string mesh = "/stage/lumped/sun_planet_mesh/";
  EXPECT_EQ(with(mesh + "stiffness_curve={}"), before);
  const auto message = [&](const std::string& set) {
    return test::message_of<InputError>([&] { (void)load(study, {set}); });
  };
  for (const std::string& set : {mesh + "friction={}", std::string("/stage/catalogue/lubrication={}")})
    EXPECT_NE(message(set).find("is an object with nothing in it"), std::string::npos) << set;
  EXPECT_NE(message(mesh + "friction/lubricated={}").find("/friction/lubricated/width_mm: is missing"),
            std::string::npos);
  EXPECT_NE(message("/stage/lumped/sun=oops").find("is the string \"oops\", must be an object"), std::string::npos);
}

}  // namespace
}  // namespace epicyclic::reports::identity_test
