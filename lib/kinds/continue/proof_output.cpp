#include "kinds/continue/proof_output.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <unordered_set>
#include <utility>

#include <fmt/format.h>

#include "core/counted.hpp"
#include "core/csv.hpp"
#include "core/text.hpp"
#include "store/branch_columns.hpp"

namespace epicyclic::kinds {

using namespace reports;

namespace {

using studies::Cause;
using studies::SweepChange;
using studies::SweepPlace;

std::string side_text(const SweepPlace& place) {
  std::string text = place.motion;
  if (place.branch) text += fmt::format(" (branch {})", *place.branch);
  return text;
}

using Places = std::vector<std::array<double, 2>>;

/// The sweep's points of a column, up and down, each cell of a grid finer than the picture once.
std::array<Places, 2> section_points(const ProvedSweep& sweep, const studies::BranchesOptions& range,
                                     const char* column) {
  const auto at = static_cast<std::size_t>(
      std::find(sweep.poincare_columns.begin(), sweep.poincare_columns.end(), column) - sweep.poincare_columns.begin());
  constexpr double cells_x = 3000;
  constexpr double cells_per_length = 400;  // of b_c
  std::array<Places, 2> points;
  std::array<std::unordered_set<std::int64_t>, 2> taken;
  for (std::size_t i = 0; i < sweep.points.count; ++i) {
    const studies::PointResult r = sweep.points.read(i);
    const double x = r.point.value;
    if (x < range.from || x > range.to) continue;
    const std::size_t way = r.point.direction == studies::Direction::up ? 0 : 1;
    for (std::size_t k = at; k < r.poincare.size(); k += r.poincare_columns) {
      const double y = r.poincare[k];
      if (!std::isfinite(y)) continue;
      const auto cell = static_cast<std::int64_t>((x - range.from) / (range.to - range.from) * cells_x) * 100000000 +
                        std::llround(y * cells_per_length);
      if (taken[way].insert(cell).second) points[way].push_back({x, y});
    }
  }
  return points;
}

/// Dots in rings where both directions have the same motion; of chaos a pale ground.
void add_sweep(BranchSketch& sketch, const std::array<Places, 2>& points) {
  constexpr std::size_t many = 6000;
  const bool ground = points[0].size() + points[1].size() > many;
  for (const bool up : {false, true}) {
    const Places& places = points[up ? 0 : 1];
    if (places.empty()) continue;
    const std::string_view colour = ground ? (up ? "#b4b4b4" : "#a9cbe3") : (up ? "#9a9a9a" : "#4fa3d1");
    const std::string key = ground || up ? figures::dots(colour, 1.0) : figures::dots(colour, 1.5, 6);
    sketch.add_points(places, ground ? figures::dots(colour, 0.25) : key, key, up ? "sweep up" : "sweep down");
  }
}

}  // namespace

void write_proof_csv(const std::filesystem::path& file, const studies::TracedBranches& traced,
                     const studies::BranchProof& proof) {
  CsvWriter csv(file, {"change", "direction", "point_before", "point_after", "value_before", "value_after",
                       "regime_before", "regime_after", "branch_before", "branch_after", "counted", "cause",
                       "special_branch", "special_point", "kind", "value", "error_bound", "grid_steps", "explanation"});
  const auto branch_cell = [&](const SweepPlace& place) {
    csv.cell(place.branch ? std::to_string(*place.branch) : std::string());
  };
  for (std::size_t k = 0; k < proof.changes.size(); ++k) {
    const SweepChange& c = proof.changes[k];
    csv.cell(k).cell(store::direction_word(c.direction)).cell(c.before.point).cell(c.behind.point);
    csv.cell(c.before.value).cell(c.behind.value).cell(c.before.motion).cell(c.behind.motion);
    branch_cell(c.before);
    branch_cell(c.behind);
    csv.cell(c.counted ? 1 : 0).cell(c.counted ? to_string(c.cause) : std::string());
    if (c.special) {
      const studies::SpecialRow& r = traced.special[*c.special];
      csv.cell(std::to_string(r.branch)).cell(std::to_string(r.point)).cell(kind_word(r));
      csv.cell(r.value).cell(r.error_bound).cell(c.beside);
    } else {
      for (int i = 0; i < 3; ++i) csv.cell("");
      for (int i = 0; i < 3; ++i) csv.cell(std::numeric_limits<double>::quiet_NaN());
    }
    csv.cell(c.words);
    csv.end_row();
  }
  csv.commit();
}

std::string proof_summary(const ContinueOutput& output, const ProvedSweep& sweep, const studies::TracedBranches& traced,
                          const studies::BranchProof& proof) {
  const AxisWords words = output.words();
  std::map<std::string, std::size_t> causes;
  for (const SweepChange& c : proof.changes)
    if (c.counted) ++causes[to_string(c.cause)];
  std::string text = fmt::format("# The sweep {} compared with the branches\n\n", sweep.name);
  text += fmt::format("Sweep of identity {}, {} points along {}.\n\n", sweep.identity, sweep.points.count, words.name);
  text += fmt::format("{} periodic; {} of them lie on {} branch{}, at most {} b_c from the orbit, and {} on none.\n\n",
                      counted(proof.periodic, "points are", "point is"), proof.periodic - proof.off.size(),
                      traced.branches.size(), traced.branches.size() == 1 ? "" : "es",
                      short_text(proof.largest_distance, 2), proof.off.size());
  text += fmt::format("{} of period, regime or orbit beside a periodic point. Explained by: ",
                      counted(proof.counted(), "changes"));
  std::string list;
  for (const auto& [cause, count] : causes) list += fmt::format("{}{} {}", list.empty() ? "" : ", ", count, cause);
  text += fmt::format("{}. **{} unexplained.** Changes between regimes that are not periodic: {}, listed separately.\n",
                      list.empty() ? "none" : list, proof.unexplained(), proof.changes.size() - proof.counted());
  for (const bool counted : {true, false}) {
    bool any = false;
    for (const SweepChange& c : proof.changes) {
      if (c.counted != counted) continue;
      if (!any) {
        text += counted ? "\n## Changes to be explained\n\n| direction | between | from | to | cause | "
                          "|\n|---|---|---|---|---|---|\n"
                        : "\n## Other changes\n\n| direction | between | from | to |\n|---|---|---|---|\n";
        any = true;
      }
      text +=
          fmt::format("| {} | {} and {} | {} | {} |", store::direction_word(c.direction), words.text(c.before.value, 6),
                      words.text(c.behind.value, 6), side_text(c.before), side_text(c.behind));
      if (counted)
        text += fmt::format(" {} | {}{} |", c.cause == Cause::unexplained ? "**unexplained**" : to_string(c.cause),
                            c.words, c.beside > 0.0 ? fmt::format(", {:.2g} steps of the grid beside", c.beside) : "");
      text += "\n";
    }
  }
  if (!proof.off.empty()) {
    text += "\n## Periodic points on no branch\n\n";
    for (const SweepPlace& p : proof.off)
      text += fmt::format(
          "- point {} at {}: {}{}\n", p.point, words.text(p.value, 6), p.motion,
          std::isfinite(p.distance) ? fmt::format(", {:.2g} b_c from the nearest branch", p.distance) : std::string());
  }
  return text;
}

std::vector<DrawnFigure> draw_proof_figures(const std::filesystem::path& folder, const ContinueOutput& output,
                                            const ProvedSweep& sweep, const studies::TracedBranches& traced) {
  std::vector<DrawnFigure> drawn;
  const std::array<std::pair<MeshKind, const char*>, 2> kinds = {
      {{MeshKind::sun_planet, "sp"}, {MeshKind::ring_planet, "rp"}}};
  for (const auto& [mesh, word] : kinds) {
    BranchSketch sketch(fmt::format("proof_delta_{}", word), output, traced, mesh);
    add_sweep(sketch,
              section_points(sweep, output.options, mesh == MeshKind::sun_planet ? "delta_sp_1" : "delta_rp_1"));
    drawn.push_back(sketch.draw(folder));
  }
  return drawn;
}

}  // namespace epicyclic::kinds
