#include "kinds/continue/output.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "core/counted.hpp"
#include "core/csv.hpp"
#include "core/text.hpp"
#include "gear/kinematics.hpp"
#include "reports/section_output.hpp"
#include "reports/table_output.hpp"
#include "store/branch_columns.hpp"

namespace epicyclic::kinds {

using namespace reports;

namespace {

using analysis::Branch;
using analysis::BranchEnd;
using analysis::BranchLimit;
using analysis::SpecialKind;
using studies::BranchRow;
using studies::SpecialRow;
using studies::TracedBranches;

/// An orbit's place in all branches, one behind the other.
struct Flat {
  std::vector<std::pair<std::size_t, std::size_t>> places;  ///< branch, index
  explicit Flat(const TracedBranches& traced) {
    for (std::size_t b = 0; b < traced.rows.size(); ++b)
      for (std::size_t k = 0; k < traced.rows[b].size(); ++k) places.emplace_back(b, k);
  }
};

store::BranchPlace place_of(const TracedBranches& traced, std::pair<std::size_t, std::size_t> at) {
  return {at.first, at.second, traced.rows[at.first][at.second]};
}

const char* end_word(const BranchLimit& limit) {
  if (limit.born) return "birth";
  switch (limit.end) {
    case BranchEnd::range:
      return "range";
    case BranchEnd::closed:
      return "closed";
    case BranchEnd::many:
      return "orbits";
    case BranchEnd::min_step:
      return "min_step";
    case BranchEnd::none:
      break;
  }
  return "";
}

std::string place_text(const std::optional<analysis::SpecialPlace>& place) {
  return place ? fmt::format("{}:{}", place->branch, place->point) : std::string();
}

void write_branches_csv(const std::filesystem::path& file, const TracedBranches& traced) {
  CsvWriter csv(file, {"branch", "period", "symmetric", "orbits", "special_points", "value_first", "value_last",
                       "end_first", "end_last", "birth", "death", "message"});
  for (std::size_t b = 0; b < traced.branches.size(); ++b) {
    const Branch& branch = traced.branches[b];
    const bool symmetric = branch.family.keeps_symmetry && branch.family.symmetry.map.size() != 0;
    csv.cell(b).cell(branch.family.period).cell(symmetric ? 1 : 0).cell(branch.orbits.size());
    csv.cell(std::ranges::count_if(traced.special, [&](const SpecialRow& r) { return r.branch == b; }));
    csv.cell(branch.orbits.front().at.value).cell(branch.orbits.back().at.value);
    csv.cell(end_word(branch.first)).cell(end_word(branch.last));
    csv.cell(place_text(branch.first.place)).cell(place_text(branch.last.place));
    csv.cell(branch.first.message.empty() ? branch.last.message : branch.first.message);
    csv.end_row();
  }
  csv.commit();
}

void write_section_csv(const std::filesystem::path& file, const ContinueOutput& output, const TracedBranches& traced) {
  std::vector<std::string> names = {"branch", "index", "crossing"};
  names.insert(names.end(), output.poincare_columns.begin(), output.poincare_columns.end());
  const std::size_t columns = output.poincare_columns.size();
  CsvWriter csv(file, names);
  for (std::size_t b = 0; b < traced.rows.size(); ++b)
    for (std::size_t k = 0; k < traced.rows[b].size(); ++k) {
      const std::vector<double>& section = traced.rows[b][k].section;
      for (std::size_t n = 0; n * columns < section.size(); ++n) {
        csv.cell(b).cell(k).cell(n);
        for (std::size_t j = 0; j < columns; ++j) csv.cell(section[n * columns + j]);
        csv.end_row();
      }
    }
  csv.commit();
}

/// Points of all loci, one behind the other.
std::vector<store::LocusPlace> locus_places(const std::vector<studies::TracedLocus>& loci) {
  std::vector<store::LocusPlace> places;
  for (std::size_t l = 0; l < loci.size(); ++l)
    for (std::size_t k = 0; k < loci[l].rows.size(); ++k) places.push_back({l, k, loci[l], loci[l].rows[k]});
  return places;
}

/// Bearings whose lives the orbits have.
store::KnownLives lives_on(const TracedBranches& traced, const Flat& flat) {
  for (const auto& place : flat.places)
    if (const studies::BranchRow& row = place_of(traced, place).row; row.evaluated)
      return store::known_lives(row.meshes);
  return {};
}

void write_h5(const std::filesystem::path& file, const ContinueOutput& output, const TracedBranches& traced,
              const std::vector<studies::TracedLocus>& loci) {
  const Flat flat(traced);
  store::Hdf5File h5(file);
  h5.set_attribute("/", "input_resolved", output.resolved_input);
  h5.set_attribute("/", "parameter", output.options.parameter);
  write_table_h5(h5, "/branches", store::branch_columns(output.planets, lives_on(traced, flat)), flat.places.size(),
                 [&](std::size_t i) { return place_of(traced, flat.places[i]); });
  write_table_h5(h5, "/special", store::special_columns(), traced.special.size(),
                 [&](std::size_t i) -> const SpecialRow& { return traced.special[i]; });

  if (output.options.loci) {
    const auto places = locus_places(loci);
    write_table_h5(h5, "/loci", store::locus_columns(), places.size(),
                   [&](std::size_t i) -> const store::LocusPlace& { return places[i]; });
  }

  std::size_t dimension = 0;
  std::vector<std::array<std::size_t, 3>> crossings;
  const std::size_t columns = output.poincare_columns.size();
  for (const auto& [b, k] : flat.places) {
    const BranchRow& row = traced.rows[b][k];
    dimension = std::max(dimension, row.multipliers.size());
    for (std::size_t n = 0; n * columns < row.section.size(); ++n) crossings.push_back({b, k, n});
  }
  h5.create_group("/multipliers");
  for (const bool real : {true, false})
    h5.write(real ? "/multipliers/real" : "/multipliers/imaginary", flat.places.size(), dimension,
             [&](std::size_t i, std::span<double> values) {
               const BranchRow& row = traced.rows[flat.places[i].first][flat.places[i].second];
               for (std::size_t j = 0; j < dimension; ++j)
                 values[j] = j >= row.multipliers.size() ? std::numeric_limits<double>::quiet_NaN()
                             : real                      ? row.multipliers[j].real()
                                                         : row.multipliers[j].imag();
             });
  for (const char* name : {"/multipliers/real", "/multipliers/imaginary"}) {
    h5.set_units(name, "1");
    h5.name_axes(name, {"row", "multiplier"});
  }
  h5.set_attribute("/multipliers", "meaning", "Floquet multipliers by falling modulus, a row for each of /branches");

  for (const auto& [name, part] : {std::pair("branch", 0U), std::pair("index", 1U), std::pair("crossing", 2U)})
    h5.write(std::string("/poincare/") + name, crossings.size(),
             store::Hdf5File::Column<std::int64_t>(
                 [&, part = part](std::size_t i) { return static_cast<std::int64_t>(crossings[i][part]); }));
  for (const auto& [name, meaning] : {std::pair("/poincare/branch", "number of the branch"),
                                      std::pair("/poincare/index", "number of the orbit on its branch"),
                                      std::pair("/poincare/crossing", "number of the Poincare point of this orbit")}) {
    h5.set_units(name, "1");
    h5.set_attribute(name, "meaning", meaning);
  }
  write_section_h5(h5, "/poincare", output.poincare_columns, crossings.size(),
                   [&](std::size_t i, std::span<double> values) {
                     const auto& [b, k, n] = crossings[i];
                     const auto from = traced.rows[b][k].section.begin() + static_cast<std::ptrdiff_t>(n * columns);
                     std::copy_n(from, columns, values.begin());
                   });
  h5.close();
}

/// A stretch of a branch that is stable, by values of the parameter along it.
struct Stretch {
  double from = 0, to = 0;
};

std::vector<Stretch> stable_stretches(const TracedBranches& traced, std::size_t b) {
  const std::vector<BranchRow>& rows = traced.rows[b];
  // Between a stable and an unstable orbit: the point of the change, if it is known.
  const auto change = [&](std::size_t before) {
    const auto at = traced.change_behind(b, before);
    return at ? traced.special[*at].value : 0.5 * (rows[before].value + rows[before + 1].value);
  };
  std::vector<Stretch> all;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    if (!rows[k].stable) continue;
    if (k == 0 || !rows[k - 1].stable) all.push_back({k == 0 ? rows[k].value : change(k - 1), 0.0});
    if (k + 1 == rows.size())
      all.back().to = rows[k].value;
    else if (!rows[k + 1].stable)
      all.back().to = change(k);
  }
  return all;
}

std::string end_text(const ContinueOutput& output, const BranchLimit& limit, double value) {
  const std::string at = output.words().text(value, 6);
  if (limit.born)
    return limit.place
               ? fmt::format("at {} on branch {}", at, limit.place->branch)
               : fmt::format("at {}, at a period doubling or branch point of a branch that was not continued", at);
  switch (limit.end) {
    case BranchEnd::range:
      return fmt::format("at {}, an end of the range", at);
    case BranchEnd::closed:
      return fmt::format("at {}, where it began: the branch is closed", at);
    case BranchEnd::many:
      return fmt::format("at {} after `orbits` = {} orbits", at, output.options.orbits);
    case BranchEnd::min_step:
      return fmt::format("**at {}, where the continuation stopped: {}**", at, limit.message);
    case BranchEnd::none:
      break;
  }
  return "at " + at;
}

std::string what_text(const ContinueOutput& output, const SpecialRow& r) {
  std::string text = r.contact;
  if (!r.broken_symmetry.empty()) text = "breaks the planets' symmetry: " + r.broken_symmetry;
  if (r.same_as)
    text += fmt::format("{}point {} of branch {}", text.empty() ? "" : ", ", r.same_as->point, r.same_as->branch);
  if (r.exact)
    text += fmt::format("{}with the exact clearance {}", text.empty() ? "" : ", ",
                        output.words().with_error(r.exact->value, r.exact->bound));
  if (!r.note.empty()) text += (text.empty() ? "" : ", ") + r.note;
  return text;
}

std::string branch_text(const ContinueOutput& output, const TracedBranches& traced, std::size_t b) {
  const Branch& branch = traced.branches[b];
  const bool alike = branch.family.symmetry.map.size() != 0;
  std::string text = fmt::format("\n## Branch {}: period {}{}\n\n", b, branch.family.period,
                                 !alike                         ? ""
                                 : branch.family.keeps_symmetry ? ", planets in step"
                                                                : ", planets not in step");
  text += fmt::format("{}; the branch begins {} and ends {}.\n", counted(branch.orbits.size(), "orbits"),
                      end_text(output, branch.first, branch.orbits.front().at.value),
                      end_text(output, branch.last, branch.orbits.back().at.value));
  const AxisWords words = output.words();
  const std::vector<Stretch> stable = stable_stretches(traced, b);
  if (stable.empty()) text += "No orbit of the branch is stable.\n";
  for (std::size_t k = 0; k < stable.size(); ++k)
    text += fmt::format("{}{} to {}{}", k == 0 ? "Stable from " : ", from ", words.text(stable[k].from, 9),
                        words.text(stable[k].to, 9), k + 1 == stable.size() ? ".\n" : "");
  const bool of_speed = words.name == studies::speed_parameter;
  bool any = false;
  for (const SpecialRow& r : traced.special) {
    if (r.branch != b) continue;
    if (!any)
      text += fmt::format("\n| kind | value |{} multipliers there | |\n|---|---|{}---|---|\n",
                          of_speed ? " sun [rpm] |" : "", of_speed ? "---|" : "");
    any = true;
    std::string multipliers;
    for (const auto& m : r.multipliers)
      multipliers += fmt::format("{}{:.4g}{:+.4g}i", multipliers.empty() ? "" : ", ", m.real(), m.imag());
    const std::string speed = r.mesh_frequency > 0.0 ? short_text(gear::rpm * r.speeds.sun, 6) : std::string();
    text += fmt::format("| {} | {} |{} {} | {} |\n", letters_of(r.kind).words, words.with_error(r.value, r.error_bound),
                        of_speed ? " " + speed + " |" : "", multipliers, what_text(output, r));
  }
  return text;
}

std::string loci_text(const ContinueOutput& output, const TracedBranches& traced,
                      const std::vector<studies::TracedLocus>& loci) {
  const studies::LociOptions& options = *output.options.loci;
  const AxisWords words = output.words();
  const AxisWords locus_words = axis_words(options.parameter, output.speed);
  std::string text = fmt::format("\n## Loci over {} and {}\n\n", words.name, locus_words.name);
  if (loci.empty()) text += "No special point of the kinds in /study/loci/kinds has a locus.\n";
  for (std::size_t l = 0; l < loci.size(); ++l) {
    const studies::TracedLocus& locus = loci[l];
    const double value = traced.branches[locus.branch].special[locus.point].value;
    text += fmt::format("- Locus {}: {} of period {}, from the point of branch {} at {}", l,
                        letters_of(locus.kind).words, locus.period, locus.branch, words.text(value, 9));
    if (locus.rows.empty()) {
      text += fmt::format(": **not begun: {}**\n", locus.message);
      continue;
    }
    text += fmt::format("; {}, {} at ({}, {}) to {} at ({}, {})", counted(locus.rows.size(), "points"), locus.first_end,
                        words.text(locus.rows.front().first, 6), locus_words.text(locus.rows.front().second, 6),
                        locus.last_end, words.text(locus.rows.back().first, 6),
                        locus_words.text(locus.rows.back().second, 6));
    if (!locus.message.empty()) text += fmt::format(": **{}**", locus.message);
    for (const studies::LocusRow& row : locus.rows)
      if (!row.marked.empty())
        text += fmt::format("\n  - {} at {}, {}", row.marked, words.with_error(row.first, row.first_bound),
                            locus_words.with_error(row.second, row.second_bound));
    text += "\n";
  }
  return text;
}

const char* mesh_column(MeshKind mesh) { return mesh == MeshKind::sun_planet ? "delta_sp_1" : "delta_rp_1"; }

/// How points of a kind are drawn.
struct KindStyle {
  SpecialKind kind;
  std::string_view colour;
  double size;
  int type;
};
constexpr std::array<KindStyle, 6> kind_styles = {{{SpecialKind::grazing, figures::ink::light_grey, 1.0, 6},
                                                   {SpecialKind::fold, figures::ink::dark_grey, 1.3, 7},
                                                   {SpecialKind::period_doubling, figures::ink::green, 1.4, 9},
                                                   {SpecialKind::neimark_sacker, figures::ink::ochre, 1.4, 13},
                                                   {SpecialKind::branch_point, figures::ink::purple, 1.3, 5},
                                                   {SpecialKind::unresolved, figures::ink::red, 1.8, 2}}};

using Place = std::array<double, 2>;
constexpr double gap = std::numeric_limits<double>::quiet_NaN();

}  // namespace

SpecialLetters letters_of(SpecialKind kind) {
  switch (kind) {
    case SpecialKind::fold:
      return {"LP", "fold"};
    case SpecialKind::period_doubling:
      return {"PD", "period doubling (flip)"};
    case SpecialKind::neimark_sacker:
      return {"NS", "Neimark-Sacker"};
    case SpecialKind::branch_point:
      return {"BP", "branch point"};
    case SpecialKind::grazing:
      return {"GR", "grazing"};
    case SpecialKind::unresolved:
      break;
  }
  return {"??", "unresolved"};
}

void write_branch_tables(const std::filesystem::path& folder, const ContinueOutput& output,
                         const TracedBranches& traced) {
  const Flat flat(traced);
  write_table_csv(folder / "branch.csv", store::branch_columns(output.planets, lives_on(traced, flat)),
                  flat.places.size(), [&](std::size_t i) { return place_of(traced, flat.places[i]); });
  write_table_csv(folder / "special.csv", store::special_columns(), traced.special.size(),
                  [&](std::size_t i) -> const SpecialRow& { return traced.special[i]; });
  write_branches_csv(folder / "branches.csv", traced);
}

void write_continue_tables(const std::filesystem::path& folder, const ContinueOutput& output,
                           const TracedBranches& traced, const std::vector<studies::TracedLocus>& loci) {
  write_branch_tables(folder, output, traced);
  write_section_csv(folder / "poincare.csv", output, traced);
  if (output.options.loci) {
    const auto places = locus_places(loci);
    write_table_csv(folder / "loci.csv", store::locus_columns(), places.size(),
                    [&](std::size_t i) -> const store::LocusPlace& { return places[i]; });
  }
  write_h5(folder / "results.h5", output, traced, loci);
}

std::string attempt_text(const AxisWords& words, const studies::BranchAttempt& a) {
  const std::string at = fmt::format("{} at {}: ", a.seed ? "seed" : "start", words.text(a.value, 9));
  if (!a.found) return at + a.message;
  if (!a.seed || a.distance <= studies::far_from_its_start) return {};
  return at + fmt::format("the orbit of period {} that was found is {} b_c away from it, and may be another one",
                          a.period, short_text(a.distance, 2));
}

void write_found_csv(const std::filesystem::path& file, const std::vector<studies::CoexistingOrbits>& found) {
  CsvWriter csv(file,
                {"value", "orbit", "period", "symmetric", "stable", "unstable", "multiplier_max", "images", "starts"});
  for (const studies::CoexistingOrbits& at : found)
    for (std::size_t k = 0; k < at.orbits.size(); ++k) {
      const studies::CoexistingOrbit& m = at.orbits[k];
      csv.row(at.value, k, m.period, m.keeps_symmetry ? 1 : 0, m.unstable == 0 ? 1 : 0, m.unstable, m.multiplier_max,
              m.images, m.starts);
    }
  csv.commit();
}

std::string found_text(const ContinueOutput& output, const std::vector<studies::CoexistingOrbits>& found) {
  std::string text;
  for (const studies::CoexistingOrbits& at : found) {
    const auto stable = std::ranges::count_if(at.orbits, [](const auto& m) { return m.unstable == 0; });
    text += fmt::format(
        "\n## Coexisting orbits at {} = {}\n\n{} up to period {} from {} starts; {} of them stable. "
        "{} starts found none. No number of starts proves that there are no others.\n",
        output.words().name, output.words().text(at.value, 9), counted(at.orbits.size(), "periodic orbits"),
        output.options.search ? output.options.search->period_max : 1, at.starts, stable, at.missed);
    if (at.orbits.empty()) continue;
    text +=
        "\n| period | symmetric | multipliers beyond 1 | largest | images | starts "
        "|\n|---|---|---|---|---|---|\n";
    for (const studies::CoexistingOrbit& m : at.orbits)
      text += fmt::format("| {} | {} | {} | {:.4g} | {} | {} |\n", m.period, m.keeps_symmetry ? "yes" : "no",
                          m.unstable, m.multiplier_max, m.images, m.starts);
  }
  return text;
}

std::string continue_summary(const ContinueOutput& output, const TracedBranches& traced,
                             const std::vector<studies::TracedLocus>& loci) {
  std::size_t orbits = 0;
  for (const Branch& branch : traced.branches) orbits += branch.orbits.size();
  std::string text = fmt::format("# Branches of periodic orbits along {}\n\n", output.words().name);
  text += fmt::format(
      "{}, {}, {} between {} and {}; tolerance {}. Each value has an error bound, from "
      "other tolerances and subdivisions. An orbit is stable if no Floquet multiplier is outside the unit circle.\n",
      counted(traced.branches.size(), "branches", "branch"), counted(orbits, "orbits"),
      counted(traced.special.size(), "special points"), output.words().text(output.options.from, 9),
      output.words().text(output.options.to, 9), short_text(output.options.tolerance));
  if (traced.full)
    text += fmt::format("\n**There are more branches than `branches` = {}; the others were not continued.**\n",
                        output.options.branches);
  if (const std::size_t broken = traced.broken_off(); broken > 0)
    text += fmt::format("\n**{} {} before an end of the range.**\n", broken,
                        broken == 1 ? "continuation stopped" : "continuations stopped");
  for (const studies::BranchAttempt& a : traced.attempts)
    if (const std::string words = attempt_text(output.words(), a); !words.empty())
      text += fmt::format("\n- {}.\n", words);
  for (std::size_t b = 0; b < traced.branches.size(); ++b) text += branch_text(output, traced, b);
  if (output.options.loci) text += loci_text(output, traced, loci);
  return text;
}

/// Points of lines, by whether the orbits are stable; a line extends to the first orbit of the other kind.
struct BranchSketch::Lines {
  std::vector<Place> stable, unstable;

  /// @param y_of  ordinate of an orbit; not a number interrupts
  template <class F>
  void add(const TracedBranches& traced, std::size_t branch, F y_of) {
    const std::vector<BranchRow>& rows = traced.rows[branch];
    for (std::size_t k = 0; k < rows.size(); ++k) {
      std::vector<Place>& line = rows[k].stable ? stable : unstable;
      const Place here = {rows[k].value, y_of(rows[k])};
      if (k > 0 && rows[k].stable != rows[k - 1].stable) {
        std::vector<Place>& before = rows[k].stable ? unstable : stable;
        const auto change = traced.change_behind(branch, k - 1);
        const Place there = change ? Place{traced.special[*change].value, y_of(traced.at_special[*change])} : here;
        before.push_back(there);
        before.push_back({gap, gap});
        if (change) line.push_back(there);
      }
      line.push_back(here);
    }
    stable.push_back({gap, gap});
    unstable.push_back({gap, gap});
  }
};

BranchSketch::BranchSketch(std::string_view stem, const ContinueOutput& output, const TracedBranches& traced,
                           MeshKind mesh)
    : output_(output), traced_(traced), mesh_(mesh), sketch_(stem) {
  const auto& columns = output.poincare_columns;
  column_ = static_cast<std::size_t>(std::find(columns.begin(), columns.end(), mesh_column(mesh)) - columns.begin());
  for (const auto& rows : traced.rows)
    for (const BranchRow& row : rows)
      for (std::size_t k = column_; k < row.section.size(); k += columns.size()) y_.include(row.section[k]);
}

void BranchSketch::add_points(const std::vector<Place>& points, std::string_view recording, std::string_view key,
                              std::string_view title) {
  for (const Place& p : points) y_.include(p[1]);
  points_.push_back({points, std::string(recording), std::string(key), std::string(title)});
}

void BranchSketch::add_branches() {
  const std::size_t columns = output_.poincare_columns.size();
  Lines lines;
  for (std::size_t b = 0; b < traced_.rows.size(); ++b) {
    const std::vector<BranchRow>& rows = traced_.rows[b];
    const auto crossings = static_cast<std::size_t>(rows.empty() ? 0 : rows.front().period);
    for (std::size_t n = 0; n < crossings; ++n)
      lines.add(traced_, b, [&, at = n * columns + column_](const BranchRow& row) {
        return at < row.section.size() ? row.section[at] : gap;
      });
  }
  sketch_.add(lines.unstable, figures::dashed(figures::ink::red, 1.6, "(14,10)"), "unstable");
  sketch_.add(lines.stable, figures::solid(figures::ink::blue, 2.4), "stable");
}

void BranchSketch::add_special_points() {
  const double width = output_.options.to - output_.options.from;
  const double height = y_.high - y_.low;
  // Overlapping letters are left out, except the first.
  std::vector<Place> taken;
  const auto is_free = [&](const Place& here) {
    constexpr double apart_x = 0.035, apart_y = 0.055;
    return std::ranges::none_of(taken, [&](const Place& p) {
      return std::abs(p[0] - here[0]) < apart_x * width && std::abs(p[1] - here[1]) < apart_y * height;
    });
  };
  for (const KindStyle& recording : kind_styles) {
    std::vector<Place> places;
    // Letters stand to the upper right of a point, but inside the frame: [below][to the left].
    std::array<std::array<std::vector<Place>, 2>, 2> lettered;
    for (std::size_t i = 0; i < traced_.special.size(); ++i) {
      const SpecialRow& r = traced_.special[i];
      const std::vector<double>& section = traced_.at_special[i].section;
      if (r.kind != recording.kind || column_ >= section.size()) continue;
      const Place here = {r.value, section[column_]};
      places.push_back(here);
      if (recording.kind == SpecialKind::grazing || r.same_as || !is_free(here)) continue;
      constexpr double near_x = 0.05, near_y = 0.07;
      const bool below = y_.high - here[1] < near_y * height;
      const bool left = output_.options.to - here[0] < near_x * width;
      lettered[below ? 1 : 0][left ? 1 : 0].push_back(here);
      taken.push_back(here);
    }
    const SpecialLetters letters = letters_of(recording.kind);
    sketch_.add(
        places, figures::dots(recording.colour, recording.size, recording.type),
        recording.kind == SpecialKind::grazing ? letters.words : fmt::format("{} {}", letters.letters, letters.words));
    for (const bool below : {false, true})
      for (const bool left : {false, true})
        if (const auto& places_there = lettered[below ? 1 : 0][left ? 1 : 0]; !places_there.empty())
          sketch_.letters(places_there, letters.letters,
                          fmt::format("{} offset {},{} textcolor '{}'", left ? "right" : "left", left ? -0.5 : 0.5,
                                      below ? -0.9 : 0.9, recording.colour));
  }
}

void BranchSketch::add_contacts() {
  // Contact of meshes other than drive contact.
  struct Strip {
    double y;
    const char* name;
    bool sun;
    double (*time)(const studies::MeshRecord&);
  };
  using studies::MeshRecord;
  constexpr auto loss = +[](const MeshRecord& m) { return m.loss(); };
  constexpr auto back = +[](const MeshRecord& m) { return m.back; };
  std::vector<Strip> strips = {{4.0, "sp loss", true, loss}, {3.0, "sp back", true, back}};
  const bool ring = output_.planets > 1;
  if (ring) strips.insert(strips.end(), {{2.0, "rp loss", false, loss}, {1.0, "rp back", false, back}});
  figures::FigurePanel panel{"Contact", {ring ? 0.4 : 2.4, 4.6}, {}, ring ? 0.9 : 0.6};
  for (const Strip& s : strips) panel.names.emplace_back(s.y, s.name);
  sketch_.panel(panel);
  Lines lines;
  for (std::size_t b = 0; b < traced_.rows.size(); ++b)
    for (const Strip& s : strips)
      lines.add(traced_, b, [&](const BranchRow& row) {
        if (!row.evaluated) return gap;
        const auto& meshes = s.sun ? row.meshes.sun_planet : row.meshes.ring_planet;
        return std::ranges::any_of(meshes, [&](const MeshRecord& m) { return s.time(m) > 0.0; }) ? s.y : gap;
      });
  for (auto& [x, y] : lines.unstable) y -= 0.18;
  sketch_.add(lines.unstable, figures::solid(figures::ink::red, 3.0));
  for (auto& [x, y] : lines.stable) y += 0.18;
  sketch_.add(lines.stable, figures::solid(figures::ink::blue, 5.0));
}

void BranchSketch::add_multipliers() {
  figures::FigureRange range;
  range.include(1.0);
  for (const auto& rows : traced_.rows)
    for (const BranchRow& row : rows) range.include(std::clamp(row.multiplier_max(), 0.3, 30.0));
  figures::FigurePanel panel{"|μ|_{max}", {range.low / 1.1, range.high * 1.1}, {}, 1.2};
  panel.logarithmic = true;
  sketch_.panel(panel);
  Lines lines;
  for (std::size_t b = 0; b < traced_.rows.size(); ++b)
    lines.add(traced_, b, [&](const BranchRow& row) { return std::max(row.multiplier_max(), range.low); });
  const auto& [from, to] = std::pair(output_.options.from, output_.options.to);
  sketch_.add(std::vector<Place>{{from, 1.0}, {to, 1.0}}, figures::solid(figures::ink::light_grey, 1.2));
  sketch_.add(lines.unstable, figures::dashed(figures::ink::red, 1.6, "(14,10)"));
  sketch_.add(lines.stable, figures::solid(figures::ink::blue, 2.4));
}

DrawnFigure BranchSketch::draw(const std::filesystem::path& folder, const std::string& title_more) {
  const char* subscript = mesh_ == MeshKind::sun_planet ? "sp" : "rp";
  figures::FigureText text{figures::verbatim_text(output_.title) + title_more,
                           parameter_label(output_.options.parameter), ""};
  for (const auto& rows : traced_.rows)
    for (const studies::BranchRow& row : rows)
      if (!text.above && row.evaluated)
        text.above = speed_above(output_.options.parameter, output_.speed, row.omega, row.meshes);
  const DrawnFigure none{folder / (sketch_.stem() + ".png"), {"there is no orbit to draw"}};
  if (y_.empty()) return none;
  figures::FigurePanel panel{
      fmt::format("Poincaré points of  δ_{{{},1}} / b_c", subscript), y_.widened(figures::figure_margin), {}, 3.0};
  sketch_.panel(panel);
  for (const Points& p : points_) {
    sketch_.add(p.places, p.recording);
    sketch_.entry(p.key, p.title);
  }
  add_branches();
  add_special_points();
  add_contacts();
  add_multipliers();
  figures::FigureRange x;
  x.include(output_.options.from);
  x.include(output_.options.to);
  return {none.file, sketch_.draw(folder, text, x, {}, {}, figures::FigureCanvas{1800, 1500})};
}

DrawnFigure draw_loci(const std::filesystem::path& folder, const ContinueOutput& output,
                      const std::vector<studies::TracedLocus>& loci) {
  const studies::LociOptions& options = output.options.loci.value();
  figures::Sketch sketch("loci");
  std::vector<std::pair<std::string, std::vector<Place>>> marks;
  for (const KindStyle& recording : kind_styles) {
    std::vector<Place> lines;
    for (const studies::TracedLocus& locus : loci) {
      if (locus.kind != recording.kind) continue;
      for (const studies::LocusRow& row : locus.rows) {
        lines.push_back({row.first, row.second});
        if (row.marked.empty()) continue;
        auto found = std::ranges::find(marks, row.marked, &std::pair<std::string, std::vector<Place>>::first);
        if (found == marks.end()) found = marks.insert(marks.end(), {row.marked, {}});
        found->second.push_back(lines.back());
      }
      lines.push_back({gap, gap});
    }
    const SpecialLetters letters = letters_of(recording.kind);
    sketch.add(lines, figures::solid(recording.colour, 2.4), fmt::format("{} {}", letters.letters, letters.words));
  }
  constexpr std::array<std::pair<const char*, const char*>, 10> letters = {{{"cusp", "CP"},
                                                                            {"resonance_1_1", "R1"},
                                                                            {"resonance_1_2", "R2"},
                                                                            {"resonance_1_3", "R3"},
                                                                            {"resonance_1_4", "R4"},
                                                                            {"fold_flip", "LPPD"},
                                                                            {"fold_neimark_sacker", "LPNS"},
                                                                            {"flip_neimark_sacker", "PDNS"},
                                                                            {"double_crossing", "DC"},
                                                                            {"unresolved", "??"}}};
  for (const auto& [word, letter] : letters)
    for (const auto& [marked, places] : marks)
      if (marked == word) {
        sketch.add(places, figures::dots("#000000", 1.4), {});
        sketch.letters(places, letter, "offset 1.2,0.8");
      }
  const figures::FigureText text{figures::verbatim_text(output.title), parameter_label(output.options.parameter),
                                 parameter_label(options.parameter)};
  figures::FigureRange x, y;
  for (const double value : {output.options.from, output.options.to}) x.include(value);
  for (const double value : {options.from, options.to}) y.include(value);
  const bool any = std::ranges::any_of(loci, [](const studies::TracedLocus& l) { return !l.rows.empty(); });
  return {folder / "loci.png",
          any ? sketch.draw(folder, text, x, y) : figures::FigureOutcome{"there is no locus to draw"}};
}

std::vector<DrawnFigure> draw_continue_figures(const std::filesystem::path& folder, const ContinueOutput& output,
                                               const TracedBranches& traced) {
  std::vector<DrawnFigure> figures;
  for (const auto& [mesh, stem] :
       {std::pair(MeshKind::sun_planet, "branches_delta_sp"), std::pair(MeshKind::ring_planet, "branches_delta_rp")})
    if (mesh == MeshKind::sun_planet || output.planets > 1)
      figures.push_back(BranchSketch(stem, output, traced, mesh).draw(folder));
  return figures;
}

}  // namespace epicyclic::kinds
