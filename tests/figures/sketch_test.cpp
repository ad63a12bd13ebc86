// Figures put together piece by piece: what stands in the data is what the plot command asks for.

#include "figures/sketch.hpp"

#include <array>
#include <fstream>
#include <iterator>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "temporary_folder.hpp"

namespace epicyclic::figures::sketch_test {
namespace {

using Rows = std::vector<std::array<double, 2>>;
constexpr double gap = std::numeric_limits<double>::quiet_NaN();

std::string text_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// Data sets of a file as gnuplot counts them: two blank lines or more end one.
std::size_t data_sets(const std::string& text) {
  std::size_t sets = 0, blank = 2;
  std::size_t from = 0;
  while (from < text.size()) {
    const std::size_t end = text.find('\n', from);
    if (end == from) {
      ++blank;
    } else {
      sets += blank >= 2 ? 1 : 0;
      blank = 0;
    }
    from = end + 1;
  }
  return sets;
}

TEST(Sketch, GapsOfLinesDoNotEndADataSet) {
  const test::TemporaryFolder folder;
  Sketch sketch("gaps");
  sketch.add(Rows{{gap, gap}, {0, 0}, {1, 1}, {gap, gap}, {gap, gap}, {gap, gap}, {2, 1}, {3, 0}, {gap, gap}},
             solid(ink::blue), "first");
  sketch.add(Rows{{gap, gap}, {gap, gap}}, solid(ink::red), "nothing");
  sketch.letters(Rows{{0.5, 0.5}}, "PD");
  sketch.add(Rows{{0, 1}, {3, 1}}, solid(ink::green), "last");
  (void)sketch.draw(folder.path(), {"", "x", "y"}, {0, 3}, {0, 1});
  const std::string data = text_of(folder / "gaps.dat");
  const std::string script = text_of(folder / "gaps.gp");
  EXPECT_EQ(data_sets(data), 3U) << data;
  EXPECT_NE(script.find("index 2 using 1:2"), std::string::npos) << script;
  EXPECT_EQ(script.find("index 3"), std::string::npos) << script;
  EXPECT_NE(script.find("index 1 using 1:2:("), std::string::npos) << script;
  EXPECT_EQ(script.find("nothing"), std::string::npos) << script;
}

TEST(Sketch, PanelsHaveNamesAndScalesOfTheirOwn) {
  const test::TemporaryFolder folder;
  Sketch sketch("panels");
  sketch.panel("above", {0, 1});
  sketch.add(Rows{{0, 0}, {1, 1}}, solid(ink::blue), "line");
  FigurePanel named{"named", {0, 3}, {}};
  named.names = {{1.0, "one"}, {2.0, "two"}};
  sketch.panel(named);
  sketch.add(Rows{{0, 1}, {1, 2}}, solid(ink::blue));
  FigurePanel logarithmic{"log", {0.1, 10}, {}};
  logarithmic.logarithmic = true;
  sketch.panel(logarithmic);
  sketch.add(Rows{{0, 1}, {1, 2}}, solid(ink::blue));
  const FigureOutcome outcome = sketch.draw(folder.path(), {"", "x", ""}, {0, 1}, {});
  EXPECT_EQ(outcome.drawn(), gnuplot_is_installed()) << outcome.message;
  const std::string script = text_of(folder / "panels.gp");
  const std::size_t names = script.find("set ytics (");
  ASSERT_NE(names, std::string::npos) << script;
  EXPECT_LT(script.find("plot", names), script.find("set ytics autofreq", names));
  EXPECT_LT(script.find("set logscale y"), script.find("unset logscale y"));
}

}  // namespace
}  // namespace epicyclic::figures::sketch_test
