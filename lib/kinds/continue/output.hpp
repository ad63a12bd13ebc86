// The files of branches.
//
//   branch.csv      a row per orbit      special.csv   a row per special point      branches.csv  a row per branch
//   poincare.csv    a row per Poincare point of an orbit: branch, index, crossing, columns as of a sweep
//   results.h5      all of it, and all multipliers
//   orbits.csv      a row per orbit that a search has found, if a search is requested
//   loci.csv        a row per point of a locus in two parameters, if loci are requested
//   continue.md     in words: branches, where they are stable, where they change
//   figures/        branches over the parameter, their contacts and largest multipliers
//
// All of it follows from the branches alone and is the same, byte for byte, for the same study.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "figures/sketch.hpp"
#include "reports/axis_words.hpp"
#include "reports/sweep_output.hpp"
#include "studies/branch_search.hpp"
#include "studies/branches.hpp"
#include "studies/loci.hpp"

namespace epicyclic::kinds {

struct ContinueOutput {
  studies::BranchesOptions options;
  std::vector<std::string> poincare_columns;
  std::size_t planets = 0;
  std::string resolved_input;                 ///< text of input.resolved.json, kept in results.h5 too
  std::string title;                          ///< of the figures
  std::optional<studies::SpeedUnit> speed{};  ///< what the study gives speeds along the axis in; none: Omega

  /// The parameter of the branches, in words.
  [[nodiscard]] reports::AxisWords words() const { return reports::axis_words(options.parameter, speed); }
};

/// The tables and results.h5.
/// @throws OutputError
void write_continue_tables(const std::filesystem::path& folder, const ContinueOutput& output,
                           const studies::TracedBranches& traced, const std::vector<studies::TracedLocus>& loci);

/// branch.csv, special.csv and branches.csv alone, of branches that are still being followed, say.
/// @throws OutputError
void write_branch_tables(const std::filesystem::path& folder, const ContinueOutput& output,
                         const studies::TracedBranches& traced);

/// Unexpected results of a start: there is no orbit near it, or only a distant one. Empty: none.
[[nodiscard]] std::string attempt_text(const reports::AxisWords& words, const studies::BranchAttempt& attempt);

/// orbits.csv.
/// @throws OutputError
void write_found_csv(const std::filesystem::path& file, const std::vector<studies::CoexistingOrbits>& found);

/// Found orbits in words, for continue.md.
[[nodiscard]] std::string found_text(const ContinueOutput& output, const std::vector<studies::CoexistingOrbits>& found);

/// Text of continue.md.
[[nodiscard]] std::string continue_summary(const ContinueOutput& output, const studies::TracedBranches& traced,
                                           const std::vector<studies::TracedLocus>& loci);

/// "LP", "PD", "NS", "BP", "GR": the usual letters of a kind, and its words.
struct SpecialLetters {
  const char* letters;
  const char* words;
};
[[nodiscard]] SpecialLetters letters_of(analysis::SpecialKind kind);

/// The deflection in a figure.
enum class MeshKind { sun_planet, ring_planet };

/// Branches in a figure's first frame, their contacts and largest multipliers in those below.
class BranchSketch {
 public:
  BranchSketch(std::string_view stem, const ContinueOutput& output, const studies::TracedBranches& traced,
               MeshKind mesh);

  /// Points under the branches: x and y.
  /// @param key  their text in the legend
  void add_points(const std::vector<std::array<double, 2>>& points, std::string_view recording, std::string_view key,
                  std::string_view title);

  /// @returns the outcome of drawing
  [[nodiscard]] reports::DrawnFigure draw(const std::filesystem::path& folder, const std::string& title_more = {});

 private:
  struct Lines;
  void add_branches();
  void add_special_points();
  void add_contacts();
  void add_multipliers();

  const ContinueOutput& output_;
  const studies::TracedBranches& traced_;
  MeshKind mesh_;
  std::size_t column_ = 0;
  figures::Sketch sketch_;
  figures::FigureRange y_;
  struct Points {
    std::vector<std::array<double, 2>> places;
    std::string recording, key, title;
  };
  std::vector<Points> points_;
};

/// The loci in the plane of both parameters.
[[nodiscard]] reports::DrawnFigure draw_loci(const std::filesystem::path& folder, const ContinueOutput& output,
                                             const std::vector<studies::TracedLocus>& loci);

[[nodiscard]] std::vector<reports::DrawnFigure> draw_continue_figures(const std::filesystem::path& folder,
                                                                      const ContinueOutput& output,
                                                                      const studies::TracedBranches& traced);

}  // namespace epicyclic::kinds
