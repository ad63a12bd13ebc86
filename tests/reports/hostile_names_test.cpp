// Names as somebody may type them reach gnuplot through every kind of drawing: each is drawn, nothing is executed, and
// the title reads as it was typed.

#include <algorithm>
#include <array>
#include <filesystem>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "figures/bifurcation_figure.hpp"
#include "figures/cell_figure.hpp"
#include "figures/gnuplot.hpp"
#include "figures/line_figure.hpp"
#include "figures/sketch.hpp"
#include "figures/track_figure.hpp"
#include "gnuplot_guard.hpp"
#include "problems/lin_parker.hpp"
#include "reports/gear_figures.hpp"
#include "temporary_folder.hpp"

namespace epicyclic::reports::hostile_names_test {
namespace {

using test::contents;
using test::TemporaryFolder;

/// As typed, and as the title reads where it cannot be the same: what has no picture is a blank.
struct Name {
  std::string typed;
  std::string shown;
};

Name same(const std::string& name) { return {name, name}; }

const std::vector<Name>& names() {
  static const std::vector<Name> all = {
      same("'"),
      same("''"),
      same("'quoted'"),
      same("it''s"),
      same("'''"),
      same("a'"),
      same("\""),
      same("\"; system(\"touch touched\"); \""),
      same("'; system('touch touched'); '"),
      same("'.system('touch touched').'"),
      same("`touch touched`"),
      same("it's `touch touched`"),
      same("$(touch touched)"),
      same("|touch touched"),
      same("!touch touched"),
      same("; set output 'touched'; plot x"),
      same("\\"),
      same("ends in \\"),
      same("\\\\server\\n\\U+0041\\101"),
      same("'\\U+0041\\101\\'"),
      same("%s %d %h %% 10^{%T}"),
      same("@ARG1 @GPVAL_TERM"),
      same("{"),
      same("}"),
      same("a}b{c"),
      same("x^2_i {/Symbol W} {/:Bold b} {/=80 c} ~a{.8-} &{space}"),
      same("# no comment"),
      same("-persist"),
      same("<b>&amp;]]></svg>"),
      same("$data << EOD"),
      {"two\nlines\r\nplot", "two lines  plot"},
      {"tab\tand\x01 control\x7f\xc2\x85 characters", "tab and  control   characters"},
      {"\xe2\x80\xa8 separators \xef\xbf\xbf", "  separators  "},
      {"   ", "   "},
      {"\xe2\x80\xae"
       "overridden\xe2\x81\xa6 isolated \xe2\x80\x8f",
       "overridden isolated "},
      {"שלום", "\u200eשלום\u200e"},
      same("é Ω 行星齿轮 😀"),
      {std::string(5000, 'n'), std::string(49, 'n') + "…" + std::string(23, 'n')},
      same(""),
  };
  return all;
}

/// Text of an SVG file in the order in which it stands, without what it is made of.
std::string text_of_svg(const std::string& svg) {
  std::string text;
  bool tag = false;
  for (std::size_t i = svg.find("<g "); i < svg.size(); ++i) {
    if (svg[i] == '<') tag = true;
    if (!tag && static_cast<unsigned char>(svg[i]) >= ' ') text += svg[i];
    // Only marks begin tags: the file writes a text's own < as an entity.
    if (svg[i] == '>' && tag) tag = false;
  }
  for (const auto& [entity, character] :
       std::array<std::array<std::string, 2>, 3>{{{"&lt;", "<"}, {"&gt;", ">"}, {"&amp;", "&"}}})
    for (std::size_t at = text.find(entity); at != std::string::npos; at = text.find(entity, at + 1))
      text.replace(at, entity.size(), character);
  return text;
}

const std::vector<double> values{1.0, 2.0, 3.0};

std::optional<figures::ClassPoint> class_point(std::size_t i) {
  return figures::ClassPoint{{values[i], {0.5, values[i]}}, 0, -0.1, 0.01};
}

figures::BifurcationSeries series(const std::string& label) {
  return {label, values.size(), [](std::size_t i) { return std::optional<figures::SectionPoint>(class_point(i)); }};
}

/// Each kind of drawing with a text that somebody has typed wherever one can stand.
struct Drawing {
  const char* kind;
  std::function<figures::FigureOutcome(const std::filesystem::path& folder, const std::string& name)> draw;
};

figures::FigureText text_of(const std::string& name) {
  return {figures::verbatim_text(name), figures::verbatim_text(name), figures::verbatim_text(name)};
}

const std::vector<Drawing>& drawings() {
  static const std::vector<Drawing> all = {
      {"line",
       [](const std::filesystem::path& folder, const std::string& name) {
         return figures::line_figure(folder, "a", text_of(name),
                                     {{figures::verbatim_text(name), values, values, false}}, {},
                                     {{2.0, figures::verbatim_text(name)}});
       }},
      {"bifurcation",
       [](const std::filesystem::path& folder, const std::string& name) {
         return figures::bifurcation_figure(folder, "a", text_of(name),
                                            {series(figures::verbatim_text(name)), series("down")});
       }},
      {"regimes",
       [](const std::filesystem::path& folder, const std::string& name) {
         return figures::class_bifurcation_figure(folder, "a", text_of(name), name, figures::verbatim_text(name),
                                                  {{figures::verbatim_text(name), "#12285c"}}, values.size(),
                                                  class_point);
       }},
      {"classes",
       [](const std::filesystem::path& folder, const std::string& name) {
         return figures::class_figure(folder, "a", text_of(name), {values, values},
                                      {{figures::verbatim_text(name), "#12285c"}}, std::vector<std::size_t>(9, 0));
       }},
      {"values",
       [](const std::filesystem::path& folder, const std::string& name) {
         return figures::value_figure(folder, "a", text_of(name), {values, values}, figures::verbatim_text(name),
                                      figures::verbatim_text(name),
                                      {1, 2, 3, 4, 5, 6, 7, 8, std::numeric_limits<double>::quiet_NaN()});
       }},
      {"decades",
       [](const std::filesystem::path& folder, const std::string& name) {
         return figures::decade_figure(folder, "a", text_of(name), {values, values}, figures::verbatim_text(name),
                                       {1, 2, 3, 4, 5, 6, 7, 8, 9}, 0.1);
       }},
      {"tracks",
       [](const std::filesystem::path& folder, const std::string& name) {
         const auto at = [](std::size_t i) {
           return figures::TrackRow{static_cast<double>(i), true, {static_cast<double>(i)}};
         };
         return figures::track_figure(folder, "a", text_of(name),
                                      {{figures::verbatim_text(name), 3, at}, {figures::verbatim_text(name), 3, at}},
                                      {{figures::verbatim_text(name), {0}}}, {figures::verbatim_text(name)});
       }},
      {"panels",
       [](const std::filesystem::path& folder, const std::string& name) {
         figures::Sketch sketch("a");
         for (int panel = 0; panel < 2; ++panel) {
           sketch.panel(figures::verbatim_text(name), {0.0, 4.0});
           sketch.add(std::vector<std::array<double, 2>>{{1.0, 1.0}, {3.0, 3.0}}, "lines",
                      panel == 0 ? figures::verbatim_text(name) : "");
         }
         return sketch.draw(folder, text_of(name), {0.0, 4.0}, {});
       }},
      {"gear",
       [](const std::filesystem::path& folder, const std::string& name) {
         gear::Stage stage = problems::lin_parker(3);
         stage.name = name;
         for (const GearFigure& figure : reports::draw_mode_figures(folder, stage))
           if (!figure.outcome.drawn()) return figure.outcome;
         for (const char* suffix : {".svg", ".png"})
           std::filesystem::copy_file(folder / (std::string("campbell") + suffix),
                                      folder / (std::string("a") + suffix));
         return figures::FigureOutcome{};
       }},
  };
  return all;
}

void expect_drawn(const Drawing& drawing, const Name& name) {
  const TemporaryFolder folder;
  const figures::FigureOutcome outcome = drawing.draw(folder / "figures", name.typed);
  const std::string what = fmt::format("{} of [{}]", drawing.kind, name.typed.substr(0, 80));
  EXPECT_TRUE(outcome.drawn()) << what << ": " << outcome.message;
  if (!outcome.drawn()) return;
  EXPECT_NE(text_of_svg(contents(folder / "figures/a.svg")).find(name.shown), std::string::npos) << what;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder.path()))
    EXPECT_NE(entry.path().filename(), "touched") << what;
  EXPECT_FALSE(std::filesystem::exists("touched")) << what;
}

TEST(HostileNames, AreAsManyAsTheyShould) {
  EXPECT_GE(names().size(), 37U);
  EXPECT_GE(drawings().size(), 7U);
}

TEST(HostileNames, EachIsDrawnAndReadsAsTyped) {
  EPICYCLIC_NEEDS_GNUPLOT();
  // One kind for each name, in turn: drawing all with all takes long and adds nothing, since all quote alike.
  std::size_t k = 0;
  for (const Name& name : names()) expect_drawn(drawings()[k++ % drawings().size()], name);
}

TEST(HostileNames, EachKindOfDrawingStandsTheWorst) {
  EPICYCLIC_NEEDS_GNUPLOT();
  for (const Drawing& drawing : drawings())
    expect_drawn(drawing, same("'it''s` \"a}b{ \\ @x &y ~z ^_ $(touch touched) `touch touched` %s"));
}

TEST(HostileNames, ShowTheirEndsWhereTheyAreTooLong) {
  EXPECT_EQ(figures::verbatim_text(std::string(30, 'n')), std::string(30, 'n'));
  const std::string shown = figures::verbatim_text("begin" + std::string(5000, 'n') + "end");
  EXPECT_TRUE(shown.starts_with("beginnn")) << shown;
  EXPECT_TRUE(shown.ends_with("nnend")) << shown;
  EXPECT_LT(figures::text_width(shown), 50.0);
}

TEST(HostileNames, AreUtf8OrAreMadeSo) {
  EXPECT_EQ(figures::verbatim_text("a\xff\xc3(b"), "a\xef\xbf\xbd\xef\xbf\xbd(b");
  EXPECT_EQ(figures::verbatim_text("\xe4\xb8"), "\xef\xbf\xbd\xef\xbf\xbd");
}

TEST(HostileNames, WithoutAFontAreBoxesThatDoNotCoverTheFigure) {
  EPICYCLIC_NEEDS_GNUPLOT();
  // No font has a noncharacter's neighbour, a place of a plane for private use: both files are then told apart.
  const TemporaryFolder folder;
  const auto draw = [&](const char* stem, const std::string& name) {
    return figures::line_figure(folder.path(), stem, {figures::verbatim_text(name), "x", "y"},
                                {{"", values, values, false}});
  };
  ASSERT_TRUE(draw("rare", "a \U000ffffd b").drawn());
  ASSERT_TRUE(draw("plain", "a \ufffd b").drawn());
  EXPECT_EQ(contents(folder / "rare.png"), contents(folder / "plain.png"));
  EXPECT_NE(contents(folder / "rare.svg").find("a \U000ffffd b"), std::string::npos);
}

}  // namespace
}  // namespace epicyclic::reports::hostile_names_test
