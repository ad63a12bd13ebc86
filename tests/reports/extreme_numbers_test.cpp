// Numbers out of all reason are refused, or what is written is finite: no output holds nan or inf.
#include <array>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/errors.hpp"
#include "gnuplot_guard.hpp"
#include "input/study_model.hpp"
#include "reports/gear_output.hpp"
#include "temporary_folder.hpp"

namespace epicyclic::reports::extreme_numbers_test {
namespace {

namespace fs = std::filesystem;
using test::TemporaryFolder;

constexpr std::array<const char*, 8> extremes = {"5e-324", "1e-300", "1e-30",  "1e-12",
                                                 "1e30",   "1e300",  "-1e300", "1e6"};

/// Is "nan" or "inf", or "infinity", in the text as a word of its own?
bool has_no_number(const std::string& text) {
  std::string word;
  for (const char c : text + " ") {
    if (std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_') {
      word += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
      continue;
    }
    if (word == "nan" || word == "inf" || word == "infinity") return true;
    word.clear();
  }
  return false;
}

struct Tally {
  int refused = 0, written = 0;
};

/// Each `stride`-th of all numbers of the input times all extremes.
Tally gear_on_extremes(const fs::path& file, const std::vector<std::string>& base, std::size_t stride) {
  const test::WithoutGnuplot guard;
  Tally tally;
  const std::vector<std::string> pointers = input::load_input(file, input::parse_assignments(base)).number_pointers();
  std::size_t count = 0;
  for (const std::string& pointer : pointers)
    for (const char* value : extremes) {
      if (++count % stride != 0) continue;
      std::vector<std::string> sets = base;
      sets.push_back(pointer + "=" + value);
      try {
        const input::LoadedInput input = input::load_input(file, input::parse_assignments(sets));
        require_finite_numbers(input);
        const TemporaryFolder folder;
        const GearOutput out = reports::write_gear_output(folder.path(), input);
        ++tally.written;
        for (const std::string& line : out.warnings) EXPECT_FALSE(has_no_number(line)) << sets.back() << ": " << line;
        for (const auto& entry : fs::recursive_directory_iterator(folder.path())) {
          if (!entry.is_regular_file()) continue;
          std::ifstream stream(entry.path());
          const std::string text{std::istreambuf_iterator<char>(stream), {}};
          EXPECT_FALSE(has_no_number(text)) << sets.back() << ": " << entry.path().filename();
        }
      } catch (const InputError&) {
        ++tally.refused;
      }
    }
  return tally;
}

/// Likewise of a study: the model and its cost, which integrates four periods, as `check` does.
Tally models_on_extremes(const fs::path& file, std::size_t stride) {
  Tally tally;
  const std::vector<std::string> pointers = input::load_input(file).number_pointers();
  std::size_t count = 0;
  for (const std::string& pointer : pointers)
    for (const char* value : extremes) {
      if (++count % stride != 0) continue;
      try {
        const input::LoadedInput input =
            input::load_input(file, input::parse_assignments(std::vector{pointer + "=" + value}));
        const model::DynamicModel model = input::model_at(input)(input.study.mesh_frequency_ratio);
        ++tally.written;
        for (const std::string& line : input::warnings(input))
          EXPECT_FALSE(has_no_number(line)) << pointer << ": " << line;
        model::StageForces forces;
        model.forces(0.0, model.default_start.data(), forces);
        EXPECT_TRUE(std::isfinite(forces.sun_planet[0]) && std::isfinite(forces.ring_planet[0])) << pointer << value;
        EXPECT_TRUE(std::isfinite(forces.sun_planet[0] / model.static_mesh_force)) << pointer << value;
      } catch (const InputError&) {
        ++tally.refused;
      }
    }
  return tally;
}

TEST(ExtremeNumbers, AWordIsToldFromANumber) {
  EXPECT_TRUE(has_no_number("a,-nan,b"));
  EXPECT_TRUE(has_no_number("| F/k_0 | inf |"));
  EXPECT_FALSE(has_no_number("information, infinite, nano, inf_x"));
}

TEST(ExtremeNumbers, GearRefusesThemOrWritesFiniteNumbers) {
  const Tally t = gear_on_extremes("inputs/tang2020.json", {}, 23);
  EXPECT_GT(t.refused, 5);
  EXPECT_GT(t.written, 1);
  const Tally lumped = gear_on_extremes("inputs/lin_parker_1999_n3.json", {}, 7);
  EXPECT_GT(lumped.refused, 5);
}

TEST(ExtremeNumbers, AModelIsRefusedOrFinite) {
  const Tally t = models_on_extremes("inputs/tang2020_run.json", 17);
  EXPECT_GT(t.refused, 10);
  EXPECT_GT(t.written, 1);
}

TEST(ExtremeNumbersLong, GearRefusesThemOrWritesFiniteNumbers) {
  EXPECT_GT(gear_on_extremes("inputs/tang2020.json", {}, 1).refused, 100);
  EXPECT_GT(gear_on_extremes("inputs/lin_parker_1999_n3.json", {}, 1).refused, 50);
  EXPECT_GT(gear_on_extremes("inputs/tang2020_run.json", {}, 1).refused, 100);
}

TEST(ExtremeNumbersLong, AModelIsRefusedOrFinite) {
  EXPECT_GT(models_on_extremes("inputs/tang2020_run.json", 1).refused, 100);
  EXPECT_GT(models_on_extremes("inputs/tang2020_speed_fixed_ring.json", 1).refused, 100);
}

}  // namespace
}  // namespace epicyclic::reports::extreme_numbers_test
