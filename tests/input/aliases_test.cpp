#include "input/aliases.hpp"

#include <algorithm>
#include <set>

#include <gtest/gtest.h>

#include "input/recorded_study.hpp"
#include "input/study_input.hpp"
#include "old_names.hpp"
#include "temporary_folder.hpp"

namespace epicyclic::input::aliases_test {
namespace {

using nlohmann::json;
using test::put_file;

std::vector<Assignment> sets(const std::vector<std::string>& texts) { return parse_assignments(texts); }

json resolved(const std::string& file, const std::vector<std::string>& texts) {
  return load_input(file, sets(texts)).resolved;
}

/// Messages of what is wrong with an input; empty if it is sound.
std::string wrong(const std::filesystem::path& file, const std::vector<std::string>& texts = {}) {
  try {
    (void)load_input(file, sets(texts));
  } catch (const InputProblems& problems) {
    return problems.what();
  }
  return {};
}

TEST(Aliases, EachOldNameOfAKeyOrAValueWorks) {
  const std::set<const Alias*> used = test::expect_old_names_to_work(
      {resolved("inputs/tang2020_speed.json", {"/model/gyroscopic=as_printed", "/study/points=3"}),
       resolved("tests/input/bad_inputs/study.json",
                {"/stage/lumped/ring_planet_mesh/friction/interpolation=linear",
                 "/stage/lumped/sun_planet_mesh/stiffness_cos_N_per_m=null",
                 "/stage/lumped/sun_planet_mesh/stiffness_sin_N_per_m=null",
                 "/stage/lumped/sun_planet_mesh/stiffness_curve="
                 R"({"phase": [0, 0.5], "stiffness_N_per_m": [1.2089e9, 1.3089e9], "interpolation": "linear"})",
                 R"(/stage/lumped/sun_planet_mesh/friction={"lubricated": {"equivalent_modulus_GPa": 226,
                    "width_mm": 60, "contact_ratio": 1.2, "path_start_mm": 5}})"}),
       resolved("inputs/tang2020_branches.json",
                {R"(/study/search={"values": [3.3], "starts": 4})",
                 R"(/study/seeds=[{"value": 3.3, "state": [0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,)"
                 R"(0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0], "max_distance": 0.1}])"}),
       resolved("inputs/tang2020_basins.json", {R"(/study/other_components={"y_s": 0.5})"})});
  for (const Alias& alias : aliases())
    EXPECT_TRUE(alias.kind == Alias::Kind::column || alias.study == "claims" || used.contains(&alias))
        << "no input above has it: " << alias.warning();
}

TEST(Aliases, NamesAreOldOrNew) {
  for (const Alias& a : aliases()) {
    EXPECT_NE(a.old_name, a.new_name);
    for (const Alias& b : aliases())
      EXPECT_FALSE(a.kind == b.kind && a.place == b.place &&
                   (a.study.empty() || b.study.empty() || a.study == b.study) &&
                   (a.old_name == b.new_name || (&a != &b && a.old_name == b.old_name)))
          << a.warning();
  }
}

TEST(Aliases, OldNamesInAssignmentsAndInTheirValues) {
  const auto expected = resolved("inputs/tang2020_branches.json", {"/study/max_step=0.05", "/study/starts=[3.2]"});
  const LoadedInput by_key =
      load_input("inputs/tang2020_branches.json", sets({"/study/largest_step=0.05", "/study/starts=[3.2]"}));
  EXPECT_EQ(by_key.resolved, expected);
  ASSERT_FALSE(by_key.notes.empty());
  EXPECT_EQ(by_key.notes.front(), "'/study/largest_step' is now '/study/max_step'; the old name works until 0.4.0");
  const LoadedInput further = by_key.with_further(sets({"/study/starts=[3.2]"}));
  EXPECT_EQ(further.resolved, expected);
  EXPECT_EQ(further.notes, by_key.notes);

  const LoadedInput by_value = load_input("inputs/tang2020_speed.json", sets({"/study/start=carried"}));
  EXPECT_EQ(by_value.resolved["study"]["start"], "continued");
  ASSERT_FALSE(by_value.notes.empty());
  EXPECT_EQ(by_value.notes.front(),
            "the value 'carried' of '/study/start' is now 'continued'; the old name works until 0.4.0");

  const LoadedInput whole = load_input(
      "inputs/tang2020_branches.json",
      sets(
          {R"(/study={"kind": "continue", "from": 3, "to": 3.5, "starts": [3.2], "largest_period": 4, "pieces": 2})"}));
  EXPECT_EQ(whole.resolved["study"]["period_max"], 4);
  EXPECT_EQ(whole.resolved["study"]["shooting_intervals"], 2);

  const LoadedInput patched =
      load_input("inputs/tang2020_branches.json", sets({R"(/stage_patch={"boundary": "literal"})"}));
  EXPECT_EQ(patched.resolved["stage"]["boundary"], "as_printed");
  Renaming renaming;
  EXPECT_EQ(new_pointer("/stage/~2", "", renaming), "/stage/~2");
}

TEST(Aliases, OfAStageAlone) {
  const std::string old = "catalogue/carrier/body/cheeks=3";
  for (const std::string& set : {"/stage/" + old, "/" + old}) {
    const LoadedInput stage = load_input("inputs/tang2020.json", sets({set}));
    EXPECT_EQ(stage.resolved["catalogue"]["carrier"]["body"]["plates"], 3);
    EXPECT_NE(std::find(stage.notes.begin(), stage.notes.end(),
                        "'/stage/catalogue/carrier/body/cheeks' is now '/stage/catalogue/carrier/body/plates'; the old "
                        "name works until 0.4.0"),
              stage.notes.end());
  }
}

TEST(Aliases, AnAxisMayNameAKeyByItsOldName) {
  const std::string old_axis = "/study/parameter=/stage/catalogue/carrier/body/cheek_thickness_mm";
  const LoadedInput input =
      load_input("inputs/tang2020_speed.json", sets({old_axis, "/study/from=10", "/study/to=12", "/study/points=2"}));
  EXPECT_EQ(input.resolved["study"]["parameter"], "/stage/catalogue/carrier/body/plate_thickness_mm");
}

TEST(Aliases, BothNamesAreRefused) {
  const test::TemporaryFolder folder;
  json study = json::parse(test::contents("inputs/tang2020_branches.json"));
  study["stage"] = json::parse(test::contents("inputs/tang2020.json"));
  study["study"]["largest_period"] = 2;
  put_file(folder / "both.json", study.dump(1));
  const std::string in_file = wrong(folder / "both.json");
  EXPECT_NE(in_file.find("/study/period_max: is given as 'largest_period' too, its old name; give 'period_max' alone"),
            std::string::npos)
      << in_file;
  const std::string by_set =
      wrong("inputs/tang2020_branches.json", {"/study/max_step=0.05", "/study/largest_step=0.04"});
  EXPECT_NE(by_set.find("--set /study/largest_step=0.04: /study/max_step: is given by its old name and, in "
                        "--set /study/max_step=0.05, by its new one"),
            std::string::npos)
      << by_set;
}

TEST(Aliases, AnOldNameOfAnotherKindIsUnknown) {
  const std::string text = wrong("inputs/tang2020_speed.json", {"/study/largest_period=2"});
  EXPECT_NE(text.find("unknown key 'largest_period'"), std::string::npos) << text;
}

TEST(Aliases, ProblemsStandOnTheLineOfTheOldName) {
  const test::TemporaryFolder folder;
  json study = json::parse(test::contents("inputs/tang2020_branches.json"));
  study["stage"] = json::parse(test::contents("inputs/tang2020.json"));
  std::string text = study.dump(1);
  const std::string name = "\"period_max\": 2";
  text.replace(text.find(name), name.size(), "\"largest_period\": true");
  put_file(folder / "old.json", text);
  const auto line =
      1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(text.find("largest_period")), '\n');
  const std::string message = wrong(folder / "old.json");
  EXPECT_NE(message.find("old.json:" + std::to_string(line) + ": /study/period_max: is true"), std::string::npos)
      << message;
}

TEST(Aliases, ResolvedInputsOfOldFoldersGetNewNames) {
  for (const char* file :
       {"inputs/tang2020_speed.json", "inputs/tang2020_branches.json", "inputs/tang2020_basins.json"}) {
    const json now = resolved(file, {});
    json old = now;
    int count = 0;
    for (const Alias& alias : aliases())
      if (alias.kind != Alias::Kind::column && (alias.study.empty() || alias.study == study_of(now)))
        count += test::use_old_name(old, alias);
    ASSERT_GT(count, 0) << file;
    use_new_names(old);
    EXPECT_EQ(old, now) << file;
  }
}

TEST(Aliases, Columns) {
  EXPECT_EQ(new_column("points.csv", "pull_sp"), "tensile_force_sp");
  EXPECT_EQ(new_column("points.csv", "marked"), "marked");
  EXPECT_EQ(new_column("loci.csv", "marked"), "codimension_two");
  ASSERT_NE(find_column_alias("settled"), nullptr);
  EXPECT_EQ(find_column_alias("settled")->warning(),
            "the column 'settled' is now 'converged'; the old name works until 0.4.0");
  EXPECT_EQ(find_column_alias("converged"), nullptr);
  EXPECT_EQ(new_value("/study/starts/N", "carried"), "continued");
  EXPECT_EQ(new_value("/study/starts/N", "cold"), "cold");
}

}  // namespace
}  // namespace epicyclic::input::aliases_test
