// Figures of cells: one rectangle for neighbours of one look, every cell covered, legend of what is there.

#include "figures/cell_figure.hpp"

#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "temporary_folder.hpp"

namespace epicyclic::figures::cell_figure_test {
namespace {

using test::contents;
using test::TemporaryFolder;

const CellGrid grid{{1, 2, 3}, {10, 20}};
const FigureText text{"title", "x", "y"};

TEST(CellFigure, DrawsCellsAsTheyAreAndNamesTheClassesThatAreThere) {
  const TemporaryFolder folder;
  const std::vector<CellClass> classes = {{"one", "#111111"}, {"none of these", "#222222"}, {"two", "#333333"}};
  const FigureOutcome outcome = class_figure(folder.path(), "cells", text, grid, classes, {0, 0, 2, 2, 0, 0});
  EXPECT_TRUE(outcome.drawn()) << outcome.message;
  EXPECT_EQ(contents(folder / "cells.dat"),
            "# x from, x to, y from, y to, colour, class\n"
            "0.5 2.5 5 15 0x111111 'one'\n"
            "2.5 3.5 5 15 0x333333 'two'\n"
            "0.5 1.5 15 25 0x333333 'two'\n"
            "1.5 3.5 15 25 0x111111 'one'\n");
  const std::string script = contents(folder / "cells.gp");
  EXPECT_NE(script.find("title 'two'"), std::string::npos);
  EXPECT_EQ(script.find("none of these"), std::string::npos);
  EXPECT_THROW(class_figure(folder.path(), "cells", text, grid, classes, {0, 0}), std::invalid_argument);
  EXPECT_THROW(class_figure(folder.path(), "cells", text, grid, classes, {0, 0, 0, 0, 0, 3}), std::invalid_argument);
}

TEST(CellFigure, WhiteIsZeroAndCellsWithoutAValueAreGrey) {
  const TemporaryFolder folder;
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  const FigureOutcome outcome =
      value_figure(folder.path(), "values", text, grid, "bar", "not told", {-1, 0, 2, none, none, 1});
  EXPECT_TRUE(outcome.drawn()) << outcome.message;
  const std::string data = contents(folder / "values.dat");
  EXPECT_NE(data.find("2.5 3.5 5 15 2\n"), std::string::npos) << data;
  EXPECT_NE(data.find("0.5 2.5 15 25 NaN\n"), std::string::npos) << data;
  const std::string script = contents(folder / "values.gp");
  EXPECT_NE(script.find("0 '#ffffff'"), std::string::npos);
  EXPECT_NE(script.find("set cbrange [-1:2]"), std::string::npos);
  EXPECT_NE(script.find("title 'not told'"), std::string::npos);
  EXPECT_FALSE(value_figure(folder.path(), "values", text, grid, "bar", "grey", std::vector(6, none)).drawn());
}

TEST(CellFigure, DecadesAreStepsOfAQuarterAndWhatIsBelowTheFloorIsWhite) {
  const TemporaryFolder folder;
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  const FigureOutcome outcome =
      decade_figure(folder.path(), "decades", text, grid, "bar", {0.011, 0.012, 1.0, 0.0, none, 0.005}, 0.01);
  EXPECT_TRUE(outcome.drawn()) << outcome.message;
  EXPECT_EQ(contents(folder / "decades.dat"),
            "# x from, x to, y from, y to, decades\n"
            "0.5 2.5 5 15 -1.875\n"
            "2.5 3.5 5 15 0.125\n");
  const std::string script = contents(folder / "decades.gp");
  EXPECT_NE(script.find("set cbrange [-2:0.25]"), std::string::npos) << script;
  EXPECT_NE(script.find("set palette maxcolors 9"), std::string::npos);
  EXPECT_FALSE(decade_figure(folder.path(), "decades", text, grid, "bar", std::vector(6, 0.001), 0.01).drawn());
}

}  // namespace
}  // namespace epicyclic::figures::cell_figure_test
