#include "input/field_table.hpp"

#include <gtest/gtest.h>

namespace epicyclic::input::field_table_test {
namespace {

using nlohmann::json;

enum class Colour { red, green };

struct Inner {
  double width = 2;
};

struct Part {
  double mass_kg = 1.5;
  std::optional<double> power_kW;
  int count = 3;
  std::string label;
  Colour colour = Colour::green;
  std::vector<Colour> colours = {Colour::red};
  double support = 4;
  std::vector<double> list = {1, 2};
  std::vector<double> error = {0.25};
  Inner inner;
  std::optional<Inner> other;
};

const Table<Inner>& inner_table() {
  static const auto table = [] {
    Table<Inner> t("inner", "Something inside.");
    t.number("width_mm", &Inner::width, between(0, 10), "Width [mm].");
    return t;
  }();
  return table;
}

const Table<Part>& part_table() {
  static const auto table = [] {
    const std::vector<std::pair<std::string, Colour>> colours = {{"red", Colour::red}, {"green", Colour::green}};
    Table<Part> t("part", "A part.");
    t.number("mass_kg", &Part::mass_kg, above(0), "Mass [kg].").required();
    t.number("power_kW", &Part::power_kW, at_least(0), "Power [kW].");
    t.integer(
        "count", [](auto& p) -> auto& { return p.count; }, between(2, 6), "How many [-].");
    t.text("label", &Part::label, "Name.");
    t.choice("colour", &Part::colour, colours, "Colour.");
    t.choices("colours", &Part::colours, colours, "Colours.");
    t.number_or_rigid("support", &Part::support, at_least(0), "Support [N/m].");
    t.numbers("list", &Part::list, between(-1, 5), 1, 3, "List.");
    t.number_or_numbers("error_um", &Part::error, from_below(0, 1), 2, "Error [um].");
    t.object("inner", &Part::inner, inner_table());
    t.number("depth_mm", within(&Part::other, &Inner::width), between(0, 10), "Depth [mm].");
    t.rule(KeyRule::Kind::at_most_one, {"power_kW", "depth_mm"});
    t.rule(KeyRule::Kind::needs, {"label", "colour"});
    t.rule(KeyRule::Kind::together, {"list", "colours"});
    return t;
  }();
  return table;
}

std::string findings_of(const std::string& text, Part* into = nullptr) {
  ReadContext context;
  part_table().collect("", context.places);
  Part part;
  part_table().read(json::parse(text), "", into == nullptr ? part : *into, context);
  std::string all;
  for (const auto& finding : context.findings) all += finding.pointer + ": " + finding.message + "\n";
  return all;
}

TEST(FieldTable, ReadsEveryKindOfField) {
  Part part;
  EXPECT_EQ(findings_of(R"({"mass_kg": 7, "count": 4.0, "label": "x", "colour": "red", "colours": ["green", "red"],
                            "support": "rigid", "list": [3], "error_um": [0.5, 0.75], "inner": {"width_mm": 1},
                            "depth_mm": 9, "origin": "choice", "note": "n"})",
                        &part),
            "");
  EXPECT_EQ(part.mass_kg, 7);
  EXPECT_EQ(part.count, 4);
  EXPECT_EQ(part.label, "x");
  EXPECT_EQ(part.colour, Colour::red);
  EXPECT_EQ(part.colours, (std::vector{Colour::green, Colour::red}));
  EXPECT_TRUE(std::isinf(part.support));
  EXPECT_EQ(part.list, std::vector<double>{3});
  EXPECT_EQ(part.error, (std::vector{0.5, 0.75}));
  EXPECT_EQ(part.inner.width, 1);
  ASSERT_TRUE(part.other.has_value());
  EXPECT_EQ(part.other->width, 9);
}

TEST(FieldTable, WritesDefaultsOfTheStruct) {
  EXPECT_EQ(part_table().write(Part{}), json::parse(R"({"mass_kg": 1.5, "count": 3, "colour": "green",
      "colours": ["red"], "support": 4.0, "list": [1.0, 2.0], "error_um": 0.25, "inner": {"width_mm": 2.0}})"));
}

TEST(FieldTable, ReadsWhatItWrites) {
  Part part;
  part.support = std::numeric_limits<double>::infinity();
  part.power_kW = 0.1;
  part.label = "name";
  const json written = part_table().write(part);
  Part again;
  EXPECT_EQ(findings_of(written.dump(), &again), "");
  EXPECT_EQ(part_table().write(again), written);
}

TEST(FieldTable, NamesValueAndBound) {
  EXPECT_EQ(findings_of(R"({"mass_kg": 0})"), "/mass_kg: is 0, must be > 0 [kg]\n");
  EXPECT_EQ(findings_of(R"({"mass_kg": 1, "power_kW": -0.5})"), "/power_kW: is -0.5, must be >= 0 [kW]\n");
  EXPECT_EQ(findings_of(R"({"mass_kg": 1, "count": 7})"), "/count: is 7, must be an integer >= 2 and <= 6\n");
  EXPECT_EQ(findings_of(R"({"mass_kg": 1, "count": 2.5})"), "/count: is 2.5, must be an integer >= 2 and <= 6\n");
  EXPECT_EQ(findings_of(R"({"mass_kg": 1, "error_um": 1})"), "/error_um: is 1, must be >= 0 and < 1 [um]\n");
  EXPECT_EQ(findings_of(R"({"mass_kg": 1, "error_um": [0, 2]})"), "/error_um/1: is 2, must be >= 0 and < 1 [um]\n");
  EXPECT_EQ(findings_of(R"({"mass_kg": 1, "colour": "gren"})"),
            "/colour: is \"gren\", must be one of: red, green; did you mean 'green'?\n");
  EXPECT_EQ(findings_of(R"({"mass_kg": 1, "inner": {"width_mm": 11}})"),
            "/inner/width_mm: is 11, must be >= 0 and <= 10 [mm]\n");
}

TEST(FieldTable, SaysWhatIsThereAndWhatIsExpected) {
  EXPECT_EQ(findings_of("{}"), "/mass_kg: is missing: Mass [kg].\n");
  EXPECT_EQ(findings_of("[]"), ": is an empty array, must be an object\n");
  EXPECT_EQ(findings_of(R"({"mass_kg": "a"})"), "/mass_kg: is the string \"a\", must be a number, > 0 [kg]\n");
  EXPECT_EQ(findings_of(R"({"mass_kg": true})"), "/mass_kg: is true, must be a number, > 0 [kg]\n");
  EXPECT_EQ(findings_of(R"({"mass_kg": 1, "support": "stiff"})"),
            "/support: is the string \"stiff\", must be a number or the string \"rigid\", >= 0\n");
  EXPECT_EQ(findings_of(R"({"mass_kg": 1, "inner": 3})"), "/inner: is 3, must be an object\n");
  EXPECT_EQ(findings_of(R"({"mass_kg": 1, "list": [1, 2, 3, 4], "colours": ["red"]})"),
            "/list: has 4 elements, must have 1 to 3\n");
}

TEST(FieldTable, TellsAllAtOnce) {
  EXPECT_EQ(findings_of(R"({"mass_kg": -1, "count": "x", "colour": "blue", "wrong": 1})"),
            "/wrong: unknown key 'wrong'; known here: mass_kg, power_kW, count, label, colour, colours, support, list, "
            "error_um, inner, depth_mm\n"
            "/mass_kg: is -1, must be > 0 [kg]\n"
            "/count: is the string \"x\", must be an integer >= 2 and <= 6\n"
            "/colour: is \"blue\", must be one of: red, green\n");
}

TEST(FieldTable, SuggestsTheKeyThatWasMeant) {
  const auto unknown = [](const std::string& key) { return findings_of(R"({"mass_kg": 1, ")" + key + "\": 1}"); };
  EXPECT_EQ(unknown("coutn"), "/coutn: unknown key 'coutn'; did you mean 'count'?\n");
  EXPECT_EQ(unknown("mass_g"), "/mass_g: unknown key 'mass_g'; did you mean 'mass_kg' (unit kg)?\n");
  EXPECT_EQ(unknown("mass"), "/mass: unknown key 'mass'; did you mean 'mass_kg' (unit kg)?\n");
  EXPECT_EQ(unknown("power_W"), "/power_W: unknown key 'power_W'; did you mean 'power_kW' (unit kW)?\n");
  EXPECT_EQ(unknown("Power_hp"), "/Power_hp: unknown key 'Power_hp'; did you mean 'power_kW' (unit kW)?\n");
  EXPECT_EQ(unknown("width_mm"), "/width_mm: unknown key 'width_mm'; 'width_mm' belongs in /inner/width_mm\n");
}

TEST(FieldTable, KnowsRulesBetweenKeys) {
  EXPECT_EQ(findings_of(R"({"mass_kg": 1, "power_kW": 1, "depth_mm": 1})"),
            ": 'power_kW', 'depth_mm' exclude each other: give one of them\n");
  EXPECT_EQ(findings_of(R"({"mass_kg": 1, "label": "x"})"), "/label: needs 'colour' beside it\n");
  EXPECT_EQ(findings_of(R"({"mass_kg": 1, "list": [1]})"), ": 'list' needs 'colours' beside it\n");
}

TEST(FieldTable, StatesItsSchema) {
  const auto schema = json::parse(part_table().schema().dump());
  EXPECT_EQ(schema["required"], json::parse(R"(["mass_kg"])"));
  EXPECT_EQ(schema["additionalProperties"], false);
  const auto& p = schema["properties"];
  EXPECT_EQ(p["mass_kg"], json::parse(R"({"type": "number", "exclusiveMinimum": 0.0, "description": "Mass [kg]."})"));
  EXPECT_EQ(p["count"], json::parse(R"({"type": "integer", "minimum": 2.0, "maximum": 6.0, "description":
      "How many [-].", "default": 3})"));
  EXPECT_EQ(p["support"]["anyOf"], json::parse(R"([{"type": "number", "minimum": 0.0}, {"const": "rigid"}])"));
  EXPECT_EQ(p["colour"]["enum"], json::parse(R"(["red", "green"])"));
  EXPECT_EQ(p["inner"]["properties"]["width_mm"]["maximum"], 10.0);
  EXPECT_EQ(schema["dependentRequired"]["label"], json::parse(R"(["colour"])"));
  EXPECT_EQ(schema["allOf"], json::parse(R"([{"not": {"required": ["power_kW", "depth_mm"]}}])"));
}

TEST(FieldTable, FindsTheNearestWord) {
  EXPECT_EQ(nearest("poitns", {"points", "period"}), "points");
  EXPECT_EQ(nearest("x", {"points", "period"}), "");
  EXPECT_EQ(unit_of("support_damping_Ns_per_m"), "N s/m");
  EXPECT_EQ(unit_of("teeth"), "");
  EXPECT_EQ(number_text(1e18), "1e+18");
  EXPECT_EQ(number_text(0.1), "0.1");
}

}  // namespace
}  // namespace epicyclic::input::field_table_test
