// Loci of the special points of a gear train's branches over a second parameter: analysis/locus.hpp on its models.
//
// Each point is followed in both directions to the edges of the rectangle of both ranges. If an earlier locus passes a
// point, the point belongs to that locus.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "analysis/locus.hpp"
#include "analysis/smoothing_bias.hpp"
#include "studies/branches.hpp"

namespace epicyclic::studies {

/// The model at values of both parameters, with its derivative by the first; called from one thread.
using ModelOverPlane = std::function<model::DynamicModel(double first, double second)>;

/// A row of a locus.
struct LocusRow {
  double first = 0, second = 0;
  double first_bound = 0, second_bound = 0;  ///< not finite where there was nothing to compare with
  std::string marked;                        ///< "cusp", ...; empty: nothing
  std::vector<double> state;                 ///< at s = 0
};

struct TracedLocus {
  std::size_t branch = 0, point = 0;  ///< of the special point that it was followed from
  analysis::SpecialKind kind = analysis::SpecialKind::fold;
  int period = 1;
  int symmetry_index = 0;           ///< of the symmetry that breaks
  std::vector<LocusRow> rows;       ///< from one end to the other
  std::string first_end, last_end;  ///< "range", "closed", "many", "min_step", "resonance"
  std::string message{};            ///< why it was broken off, or not begun
};

/// The special points whose loci are requested, as indices of TracedBranches::special, in their order.
[[nodiscard]] std::vector<std::size_t> points_of_loci(const TracedBranches& traced, const LociOptions& options);

/// Does one of the loci pass the point?
[[nodiscard]] bool is_on_a_locus(const std::vector<TracedLocus>& loci, const TracedBranches& traced,
                                 const SpecialRow& point, double second, const BranchesOptions& options);

/// The locus of a point, in both directions.
/// @param second  value of the second parameter on the branches
[[nodiscard]] TracedLocus trace_locus(const ModelOverPlane& models, const TracedBranches& traced,
                                      const SpecialRow& point, double second, const BranchesOptions& options);

/// Where a point found with a smooth clearance of width w has it with the exact one [A-smooth]: from w, w/2, w/4 and
/// w/8, along the locus over the width.
/// @param models  at values of the parameter and of the width
/// @param why_not  why there is none
/// @returns nothing for a point that has no locus, or whose locus does not get there
[[nodiscard]] std::optional<analysis::ExactValue> exact_value(const ModelOverPlane& models,
                                                              const TracedBranches& traced, const SpecialRow& point,
                                                              double width, const BranchesOptions& options,
                                                              std::string& why_not);

}  // namespace epicyclic::studies
