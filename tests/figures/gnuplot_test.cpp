#include "figures/gnuplot.hpp"

#include <chrono>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>
#include <stdlib.h>
#include <sys/resource.h>
#include <unistd.h>

#include "core/errors.hpp"
#include "figures/bifurcation_figure.hpp"
#include "figures/line_figure.hpp"
#include "gnuplot_guard.hpp"
#include "temporary_folder.hpp"

namespace epicyclic::figures::gnuplot_test {
namespace {

using test::contents;
using test::TemporaryFolder;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Sets a variable of the environment for a while.
class Environment {
 public:
  Environment(const char* name, const char* value) : name_(name) {
    if (const char* old = ::getenv(name)) old_ = old;
    ::setenv(name, value, 1);
  }
  Environment(const Environment&) = delete;
  Environment& operator=(const Environment&) = delete;
  ~Environment() { old_.empty() ? ::unsetenv(name_) : ::setenv(name_, old_.c_str(), 1); }

 private:
  const char* name_;
  std::string old_;
};

BifurcationSeries series_of(std::string label, std::vector<SectionPoint> points) {
  const std::size_t count = points.size();
  return {std::move(label), count,
          [points = std::move(points)](std::size_t i) { return std::optional<SectionPoint>(points[i]); }};
}

/// The logistic map r x (1 - x): fixed point, period doubling, chaos, windows.
BifurcationSeries logistic(std::size_t columns, std::size_t points, double start) {
  std::vector<SectionPoint> series;
  for (std::size_t i = 0; i < columns; ++i) {
    const double r = 2.8 + 1.2 * static_cast<double>(i) / static_cast<double>(columns - 1);
    double x = start;
    for (int k = 0; k < 200; ++k) x = r * x * (1 - x);
    std::vector<double> values;
    for (std::size_t k = 0; k < points; ++k) values.push_back(x = r * x * (1 - x));
    series.push_back({r, values});
  }
  return series_of("r", std::move(series));
}

std::size_t data_lines(const std::string& data) {
  std::size_t count = 0;
  std::istringstream stream(data);
  for (std::string line; std::getline(stream, line);) count += !line.empty() && line.front() != '#' ? 1U : 0U;
  return count;
}

TEST(Gnuplot, MissingGnuplotIsAResult) {
  const TemporaryFolder folder;
  const Environment no_path("PATH", folder.path().c_str());
  const FigureOutcome outcome = line_figure(folder / "figures", "a", {"", "x", "y"}, {{"", {0, 1}, {0, 1}, false}});
  EXPECT_FALSE(outcome.drawn());
  EXPECT_NE(outcome.message.find("gnuplot is not installed"), std::string::npos) << outcome.message;
  EXPECT_TRUE(std::filesystem::exists(folder / "figures/a.dat"));
  EXPECT_TRUE(std::filesystem::exists(folder / "figures/a.gp"));
}

/// A program in gnuplot's place.
class FakeGnuplot {
 public:
  explicit FakeGnuplot(const std::string& commands)
      : program_(put(folder_ / "gnuplot", "#!/bin/sh\n" + commands)),
        path_("PATH", (folder_.path().string() + ":/usr/bin:/bin").c_str()) {}

  [[nodiscard]] std::filesystem::path file(const char* name) const { return folder_ / name; }

 private:
  static std::filesystem::path put(const std::filesystem::path& file, const std::string& text) {
    test::put_file(file, text);
    std::filesystem::permissions(file, std::filesystem::perms::owner_all);
    return file;
  }

  TemporaryFolder folder_;
  std::filesystem::path program_;
  Environment path_;
};

/// Whose number stands in the file; a zombie lives no more.
bool lives(const std::filesystem::path& number) {
  std::string id = contents(number);
  id.erase(id.find_last_not_of('\n') + 1);
  const std::string status = contents("/proc/" + id + "/stat");
  return !id.empty() && !status.empty() && status.find(") Z ") == std::string::npos;
}

/// Processes that were killed need a moment.
bool lives_on(const std::filesystem::path& number) {
  for (int k = 0; k < 500 && lives(number); ++k) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  return lives(number);
}

constexpr const char* hangs = "cd \"$(dirname \"$0\")\"; echo $$ > self; sleep 1000 & echo $! > child; wait\n";

TEST(Gnuplot, OneThatHangsIsEndedWithItsChildren) {
  const TemporaryFolder folder;
  const FakeGnuplot gnuplot(hangs);
  test::put_file(folder / "a.gp", "\n");
  const FigureOutcome outcome = run_gnuplot(folder / "a.gp", Pictures::both, std::chrono::milliseconds(700));
  EXPECT_NE(outcome.message.find("did not come to an end within 0.7 s"), std::string::npos) << outcome.message;
  ASSERT_FALSE(contents(gnuplot.file("child")).empty());
  EXPECT_FALSE(lives_on(gnuplot.file("self")));
  EXPECT_FALSE(lives_on(gnuplot.file("child")));
}

TEST(Gnuplot, OneThatTalksForEverIsEndedToo) {
  const TemporaryFolder folder;
  const FakeGnuplot gnuplot("exec yes 'no end'\n");
  test::put_file(folder / "a.gp", "\n");
  const FigureOutcome outcome = run_gnuplot(folder / "a.gp", Pictures::both, std::chrono::milliseconds(300));
  EXPECT_NE(outcome.message.find("did not come to an end"), std::string::npos) << outcome.message;
}

TEST(Gnuplot, AChildThatOutlivesItIsNotWaitedFor) {
  const TemporaryFolder folder;
  const FakeGnuplot gnuplot("cd \"$(dirname \"$0\")\"; sleep 1000 & echo $! > child; echo said; exit 3\n");
  test::put_file(folder / "a.gp", "\n");
  const FigureOutcome outcome = run_gnuplot(folder / "a.gp");
  EXPECT_NE(outcome.message.find("gnuplot failed on"), std::string::npos) << outcome.message;
  EXPECT_NE(outcome.message.find("said"), std::string::npos) << outcome.message;
  EXPECT_FALSE(lives_on(gnuplot.file("child")));
}

TEST(Gnuplot, HalfAPictureIsNone) {
  const TemporaryFolder folder;
  const FakeGnuplot gnuplot("for kind in png svg; do echo half > a.$kind; done; exit 1\n");
  for (const Pictures which : {Pictures::png, Pictures::svg, Pictures::both}) {
    test::put_file(folder / "a.gp", "\n");
    EXPECT_FALSE(draw_pictures(folder.path(), "a", which).drawn());
    EXPECT_EQ(std::filesystem::exists(folder / "a.png"), which == Pictures::svg);
    EXPECT_EQ(std::filesystem::exists(folder / "a.svg"), which == Pictures::png);
  }
}

TEST(Gnuplot, FailingScriptIsAResultWithGnuplotsWords) {
  EPICYCLIC_NEEDS_GNUPLOT();
  const TemporaryFolder folder;
  test::put_file(folder / "bad.gp", "set no_such_option\n");
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  const FigureOutcome outcome = run_gnuplot(folder / "bad.gp");
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_NE(outcome.message.find("bad.gp"), std::string::npos) << outcome.message;
  EXPECT_NE(outcome.message.find("line 1"), std::string::npos) << outcome.message;
  EXPECT_FALSE(run_gnuplot(folder / "absent.gp").drawn());
  EXPECT_FALSE(run_gnuplot(folder / "no/such/folder.gp").drawn());
}

TEST(Gnuplot, RunsInTheFolderOfTheScriptInTheCLocale) {
  EPICYCLIC_NEEDS_GNUPLOT();
  const TemporaryFolder folder;
  const Environment german("LC_ALL", "de_DE.UTF-8");
  const Environment home("HOME", folder.path().c_str());
  test::put_file(folder / ".gnuplot", "exit status 3\n");
  test::put_file(folder / "-a.gp", "set print 'here.txt'\nprint system('echo $LC_ALL').sprintf(' %.1f', 0.5)\n");
  const FigureOutcome outcome = run_gnuplot(folder / "-a.gp");
  EXPECT_TRUE(outcome.drawn()) << outcome.message;
  EXPECT_EQ(contents(folder / "here.txt"), "C 0.5\n");
}

TEST(Gnuplot, QuotedTextExpandsNothing) {
  EXPECT_EQ(gnuplot_quoted("`date`\n\"x\""), "'`date` \"x\"'");
  EXPECT_EQ(gnuplot_quoted("it's `date` \"x\" \\n"), R"("it's \140date\140 \042x\042 \134n")");
  EPICYCLIC_NEEDS_GNUPLOT();
  const TemporaryFolder folder;
  const std::string evil = "don't `touch touched` @x \" ; system('touch touched')\nexit status 1";
  const FigureOutcome outcome =
      line_figure(folder / "figures", "a", {evil, evil, evil}, {{evil, {0, 1}, {0, 1}, false}}, {}, {{0.5, evil}});
  EXPECT_TRUE(outcome.drawn()) << outcome.message;
  EXPECT_FALSE(std::filesystem::exists(folder / "figures/touched"));
}

TEST(Gnuplot, PortableTextHasGreekLettersAndBars) {
  EXPECT_EQ(portable_text("frequency {/Symbol W} = {/Symbol w}_m"), "frequency {Ω} = {ω}_m");
  EXPECT_EQ(portable_text("~{/Symbol d}{.6-}_{sp}"), "δ\u0304_{sp}");
  EXPECT_EQ(portable_text("~{x}{.6-} ~y{1-}"), "x\u0304 y\u0304");
  EXPECT_EQ(portable_text("{/Symbol ab2}"), "{αβ2}");
  for (const char* same : {"", "plain", "x_{sp}", "{/Symbol ", "{/Symbol W", "{/Symbol {x}}", "~a{b}"}) {
    EXPECT_EQ(portable_text(same), same);
  }
}

TEST(Gnuplot, StemMustBeAPlainFileName) {
  const TemporaryFolder folder;
  for (const char* stem : {"", "../a", "a/b", "a b", "a'b", ".hidden"}) {
    EXPECT_THROW(draw_figure(folder.path(), stem, "", ""), std::invalid_argument) << stem;
  }
}

TEST(Gnuplot, CtrlCDoesNotReachIt) {
  EPICYCLIC_NEEDS_GNUPLOT();
  const TemporaryFolder folder;
  // The process group is the fifth word; "cut" is a name without blanks.
  test::put_file(folder / "a.gp", "set print 'group'\nprint system(\"cut -d' ' -f5 /proc/self/stat\")\n");
  ASSERT_TRUE(run_gnuplot(folder / "a.gp").drawn());
  const std::string group = contents(folder / "group");
  ASSERT_FALSE(group.empty());
  EXPECT_NE(std::stol(group), ::getpgrp());
}

TEST(Gnuplot, OldPictureDoesNotPassForANewOne) {
  EPICYCLIC_NEEDS_GNUPLOT();
  const TemporaryFolder folder;
  test::put_file(folder / "a.png", "old");
  test::put_file(folder / "a.svg", "old");
  EXPECT_THROW(draw_figure(folder.path(), "a", "1 2\n", "# draws nothing\n"), OutputError);
  EXPECT_FALSE(std::filesystem::exists(folder / "a.png"));
  EXPECT_FALSE(std::filesystem::exists(folder / "a.svg"));
}

TEST(Gnuplot, PicturesDrawnApartAreTheSame) {
  EPICYCLIC_NEEDS_GNUPLOT();
  const TemporaryFolder folder;
  const auto figure = [](const std::filesystem::path& to, Pictures which) {
    return bifurcation_figure(to, "a", {"", "x", "y"}, {logistic(20, 4, 0.3)}, {}, which);
  };
  ASSERT_TRUE(figure(folder / "both", Pictures::both).drawn());
  ASSERT_TRUE(figure(folder / "apart", Pictures::none).drawn());
  EXPECT_EQ(test::entries(folder / "apart"), 2U);
  ASSERT_TRUE(draw_pictures(folder / "apart", "a", Pictures::svg).drawn());
  EXPECT_FALSE(std::filesystem::exists(folder / "apart/a.png"));
  ASSERT_TRUE(draw_pictures(folder / "apart", "a", Pictures::png).drawn());
  for (const char* file : {"a.dat", "a.gp", "a.png", "a.svg"})
    EXPECT_EQ(contents(folder / "both" / file), contents(folder / "apart" / file)) << file;
}

TEST(Gnuplot, EachPictureThatIsNotFinishedIsNoticed) {
  EPICYCLIC_NEEDS_GNUPLOT();
  const TemporaryFolder folder;
  test::put_file(folder / "a.gp", "# draws nothing\n");
  EXPECT_THROW((void)draw_pictures(folder.path(), "a", Pictures::png), OutputError);
  EXPECT_THROW((void)draw_pictures(folder.path(), "a", Pictures::svg), OutputError);
}

TEST(Gnuplot, PictureThatEndsEarlyIsNoticed) {
  EPICYCLIC_NEEDS_GNUPLOT();
  const TemporaryFolder folder;
  // Large enough for the script and the data, too small for the picture.
  const test::FileSizeLimit limit(8192);
  const FigureOutcome outcome = bifurcation_figure(folder.path(), "a", {"", "x", "y"}, {logistic(20, 4, 0.3)});
  EXPECT_FALSE(outcome.drawn());
}

/// The number behind `words` in a script.
double number_behind(const std::string& script, const std::string& words) {
  const std::size_t at = script.find(words);
  return at == std::string::npos ? nan : std::stod(script.substr(at + words.size()));
}

TEST(Layout, LegendsStandUnderTitlesOrBesideThem) {
  // Font heights: 32 pixels of a canvas of 1100 for the title, and somewhat less for the legend.
  constexpr double line = 32.0 / 1100.0;
  for (const std::string& title : {std::string("s"), std::string("a title of some length"), std::string(90, 't')})
    for (const std::vector<std::string>& legend : {std::vector<std::string>{"up", "down"},
                                                   {"harmonics of the mesh frequency", "between them"},
                                                   {std::string(60, 'l'), std::string(70, 'l')},
                                                   std::vector<std::string>(9, "an entry of nine")}) {
      const std::string script = figure_script("a", {title, "x", "y"}, {0, 1}, {0, 1}, legend, {}, "", "x");
      const double middle = number_behind(script, "at graph 0, screen ");
      const double top = number_behind(script, "set key at graph 1, screen ");
      const double rows = number_behind(script, "maxrows ");
      const double frame = number_behind(script, "set tmargin screen ");
      const double font = number_behind(script, "left font ',");
      EXPECT_LT(middle + 0.5 * line, 1.0);
      EXPECT_LT(frame, top - rows * line) << "the legend reaches into the frame";
      EXPECT_LT(font * text_width(title), 24.0 * 1600.0 / 32.0) << "the title is wider than the frame";
      double longest = 0.0;
      for (const std::string& entry : legend) longest = std::max(longest, text_width(entry));
      const double together = text_width(title) + static_cast<double>(legend.size()) * (longest + 2.0);
      EXPECT_TRUE(top < middle - 0.5 * line || 32.0 * together < 1600.0) << "the legend is over the title " << title;
    }
}

TEST(Layout, LabelsOfOrdinatesStandBesideTheTics) {
  // The label ends 60 pixels from the left edge of 1800; a digit is 20 pixels wide.
  const auto margin = [](const FigureRange& y) {
    return 1800.0 *
           number_behind(panel_script("a", {"t", "x", ""}, {0, 1}, {{"y", y, "x"}}, {}, ""), "set lmargin screen ");
  };
  EXPECT_GT(margin({0.0, 5.0}), 60.0 + 1.0 * 20.0);
  EXPECT_GT(margin({-0.002, 0.0004}), 60.0 + 7.0 * 20.0);  // -0.0015
  EXPECT_GT(margin({4.2, 4.47}), 60.0 + 4.0 * 20.0);       // 4.45
  EXPECT_LT(margin({0.0, 5.0}), 250.0);
}

TEST(BifurcationFigure, WritesDataScriptAndBothPictures) {
  EPICYCLIC_NEEDS_GNUPLOT();
  const TemporaryFolder folder;
  const auto figures = folder / "figures";
  const FigureOutcome outcome =
      bifurcation_figure(figures, "speed", {"Logistic map", "Parameter {/Symbol W}", "~{x}{.6-}  [-]"},
                         {logistic(100, 20, 0.3), logistic(100, 20, 0.6)}, {{3.0, "flip"}, {99, "outside"}});
  ASSERT_TRUE(outcome.drawn()) << outcome.message;
  EXPECT_TRUE(contents(figures / "speed.png").starts_with("\x89PNG\r\n\x1a\n"));
  const std::string svg = contents(figures / "speed.svg");
  EXPECT_NE(svg.find("Parameter"), std::string::npos);
  EXPECT_NE(svg.find("Ω"), std::string::npos);
  EXPECT_NE(svg.find("flip"), std::string::npos);
  EXPECT_EQ(svg.find("outside"), std::string::npos);
  const std::string script = contents(figures / "speed.gp");
  // From 2.8 to 4 in 99 steps, and half a step on each side.
  EXPECT_NE(script.find("set xrange [2.793939393939394:4.006060606060606]\n"), std::string::npos) << script;
  EXPECT_EQ(script.find(folder.path().string()), std::string::npos) << "the folder must be movable";
  EXPECT_EQ(test::entries(figures), 4U);
}

TEST(BifurcationFigure, SameDataGiveSameFiles) {
  EPICYCLIC_NEEDS_GNUPLOT();
  const TemporaryFolder folder;
  for (const char* name : {"1", "2"}) {
    ASSERT_TRUE(bifurcation_figure(folder / name, "a", {"", "x", "y"}, {logistic(100, 20, 0.3)}).drawn());
  }
  for (const char* file : {"a.dat", "a.gp", "a.svg", "a.png"}) {
    EXPECT_EQ(contents(folder / "1" / file), contents(folder / "2" / file)) << file;
  }
}

TEST(BifurcationFigure, PointsOfOneCellAreDrawnOnce) {
  const TemporaryFolder folder;
  const Environment no_path("PATH", "");
  // 128 times the same period-2 orbit, up to a rounding, at each of 3 values.
  std::vector<SectionPoint> series;
  for (int i = 1; i <= 3; ++i) {
    std::vector<double> values;
    for (int k = 0; k < 64; ++k) values.insert(values.end(), {0.25 + 1e-15 * k, 0.75 - 1e-15 * k});
    series.push_back({static_cast<double>(i), values});
  }
  bifurcation_figure(folder.path(), "a", {"", "x", "y"}, {series_of("r", series)});
  EXPECT_EQ(contents(folder / "a.dat"), "# 'r'\n1 0.25\n1 0.75\n2 0.25\n2 0.75\n3 0.25\n3 0.75\n\n\n");
}

/// Processor time of this process and of those that it waited for [s].
double processor_seconds() {
  double seconds = 0;
  for (const int who : {RUSAGE_SELF, RUSAGE_CHILDREN}) {
    rusage usage{};
    ::getrusage(who, &usage);
    for (const timeval& time : {usage.ru_utime, usage.ru_stime})
      seconds += static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  }
  return seconds;
}

TEST(BifurcationFigure, FullSweepIsDrawnInSeconds) {
  EPICYCLIC_NEEDS_GNUPLOT();
  const TemporaryFolder folder;
  const std::vector<BifurcationSeries> series{logistic(661, 128, 0.3), logistic(661, 128, 0.6)};
  const double start = processor_seconds();
  ASSERT_TRUE(bifurcation_figure(folder.path(), "a", {"", "x", "y"}, series).drawn());
  // About a second, whatever else the machine does; ten with sanitizers.
  EXPECT_LT(processor_seconds() - start, 30.0);
}

TEST(BifurcationFigure, ValuesThatAreNotFiniteAreLeftOut) {
  EPICYCLIC_NEEDS_GNUPLOT();
  const TemporaryFolder folder;
  const double infinity = std::numeric_limits<double>::infinity();
  const BifurcationSeries none = series_of("none", {{1, {nan}}, {2, {}}});
  const BifurcationSeries some = series_of("some", {{1, {0.5, nan, infinity}}, {nan, {0.7}}, {2, {0.6}}});
  // An empty first series must not shift the second.
  const FigureOutcome outcome = bifurcation_figure(folder.path(), "a", {"", "x", "y"}, {none, some});
  EXPECT_TRUE(outcome.drawn()) << outcome.message;
  EXPECT_EQ(contents(folder / "a.dat"), "# 'none'\nNaN NaN\n\n\n# 'some'\n1 0.5\n2 0.6\n\n\n");
  EXPECT_EQ(bifurcation_figure(folder.path(), "b", {"", "x", "y"}, {none}).message, "there is no finite point to draw");
}

TEST(BifurcationFigure, SinglePointIsDrawn) {
  EPICYCLIC_NEEDS_GNUPLOT();
  const TemporaryFolder folder;
  for (const double value : {0.0, 1.0, -1e-9, 1e12}) {
    const FigureOutcome outcome =
        bifurcation_figure(folder.path(), "a", {"", "x", "y"}, {series_of("r", {{value, {value}}})});
    EXPECT_TRUE(outcome.drawn()) << value << ": " << outcome.message;
  }
}

TEST(BifurcationFigure, WrongSeriesAreRefused) {
  const TemporaryFolder folder;
  EXPECT_THROW(bifurcation_figure(folder.path(), "a", {}, {}), std::invalid_argument);
  EXPECT_THROW(bifurcation_figure(folder.path(), "a", {}, std::vector<BifurcationSeries>(3)), std::invalid_argument);
}

TEST(BifurcationFigure, FullDiskOnDataIsAnOutputError) {
  const TemporaryFolder folder;
  const test::FileSizeLimit limit(100);
  EXPECT_THROW(bifurcation_figure(folder.path(), "a", {"", "x", "y"}, {logistic(60, 8, 0.3)}), OutputError);
}

TEST(LineFigure, DrawsCurvesWithGapsAndLegend) {
  EPICYCLIC_NEEDS_GNUPLOT();
  const TemporaryFolder folder;
  const std::vector<FigureCurve> curves{{"empty", {nan, 1}, {1, nan}, false},
                                        {"k_{sp}", {0, 1, 2, nan, nan, 3, 4}, {1, 2, 1, 0, 0, 2, 1}, false},
                                        {"k_{rp}", {0, 4}, {3, -3}, true}};
  const FigureOutcome outcome = line_figure(folder.path(), "a", {"Title", "x", "y"}, curves);
  ASSERT_TRUE(outcome.drawn()) << outcome.message;
  EXPECT_EQ(data_lines(contents(folder / "a.dat")), 1U + 5U + 2U);
  EXPECT_NE(contents(folder / "a.dat").find("2 1\n\n3 2\n"), std::string::npos);
  EXPECT_NE(contents(folder / "a.svg").find("rp"), std::string::npos);
}

TEST(LineFigure, LogarithmicAxesLeaveOutWhatIsNotPositive) {
  EPICYCLIC_NEEDS_GNUPLOT();
  const TemporaryFolder folder;
  const FigureOutcome outcome = line_figure(folder.path(), "a", {"", "tolerance", "error"},
                                            {{"", {1e-8, 1e-6, 0, 1e-4}, {1e-9, -1, 1, 1e-3}, false}}, {true, true});
  ASSERT_TRUE(outcome.drawn()) << outcome.message;
  EXPECT_EQ(data_lines(contents(folder / "a.dat")), 2U);
}

TEST(LineFigure, FramesHideNoPoints) {
  EPICYCLIC_NEEDS_GNUPLOT();
  const TemporaryFolder folder;
  const std::vector<FigureCurve> lines{{"", {1e-8, 1e-4}, {1e-9, 1e-3}, false}};
  ASSERT_TRUE(line_figure(folder.path(), "lines", {"", "x", "y"}, lines, {true, true}).drawn());
  EXPECT_EQ(number_behind(contents(folder / "lines.gp"), "set xrange ["), 1e-8);
  for (const bool points : {true, false}) {
    const std::vector<FigureCurve> marks{{"", {1e-8, 1e-4}, {1e-9, 1e-3}, points, true}};
    ASSERT_TRUE(line_figure(folder.path(), "marks", {"", "x", "y"}, marks, {true, true}).drawn());
    constexpr double clear_of_the_frame = 0.8;  // measured: 0.69
    EXPECT_LT(number_behind(contents(folder / "marks.gp"), "set xrange ["), clear_of_the_frame * 1e-8);
  }
}

TEST(LineFigure, LogarithmicAxesOfLessThanThreeDecadesHaveNamesBetween) {
  EPICYCLIC_NEEDS_GNUPLOT();
  const TemporaryFolder folder;
  const auto script = [&](double low, double high) {
    EXPECT_TRUE(
        line_figure(folder.path(), "a", {"", "x", "y"}, {{"", {low, high}, {1, 2}, false}}, {true, false}).drawn());
    return contents(folder / "a.gp");
  };
  const std::string narrow = script(150, 2200);
  for (const char* tic : {"'200' 200 0", "'500' 500 0", "'1000' 1000 0", "'' 300 1"})
    EXPECT_NE(narrow.find(tic), std::string::npos) << tic;
  EXPECT_NE(script(3e-5, 4e-4).find("'2·10^{-4}' 2"), std::string::npos);
  // Within a decade all digits, within less equal steps.
  EXPECT_NE(script(150, 1200).find("'300' 300 0"), std::string::npos);
  const std::string short_axis = script(0.93, 1.11);
  for (const char* tic : {"'0.95' 0.95", "'1' 1 0", "'1.05' 1.05", "'1.1' 1.1"})
    EXPECT_NE(short_axis.find(tic), std::string::npos) << tic;
  EXPECT_EQ(script(1e-5, 1e-1).find("set xtics ("), std::string::npos);
  // One value alone, at 1, where its logarithm vanishes.
  EXPECT_NE(script(1, 1).find("'1' 1 0"), std::string::npos);
}

TEST(LineFigure, WrongCurvesAreRefused) {
  const TemporaryFolder folder;
  EXPECT_THROW(line_figure(folder.path(), "a", {}, {}), std::invalid_argument);
  EXPECT_THROW(line_figure(folder.path(), "a", {}, {{"", {1, 2}, {1}, false}}), std::invalid_argument);
  EXPECT_EQ(line_figure(folder.path(), "a", {}, {{"", {1}, {nan}, false}}).message, "there is no finite point to draw");
}

}  // namespace
}  // namespace epicyclic::figures::gnuplot_test
