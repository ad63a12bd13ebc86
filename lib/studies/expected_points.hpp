// Special points of branches compared with those of an earlier computation: the regression test of bifurcation points.
//
// A found point is an expected one if kind, period, contact and broken symmetry are the same and the values are
// nearest, within `reach`. Then
//
//   | value - expected | <= bound of the expected one       agrees
//   bound of the found one > 10 bounds of the expected one  too uncertain for a comparison: a failure
//
// An expected point that is not found is missing, a found point that is not expected is additional. Both are failures.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace epicyclic::studies {

/// A special point, by the properties that distinguish it from others.
struct LocatedPoint {
  std::string kind;  ///< as in special.csv
  int period = 1;    ///< of the branch [mesh periods]
  double value = 0;  ///< of the parameter
  double bound = 0;  ///< of its error; positive of an expected one, not a number where it is not known
  std::string contact;
  std::string broken_symmetry;
};

enum class PointVerdict { agrees, differs, too_uncertain, missing, additional };
[[nodiscard]] std::string to_string(PointVerdict verdict);

/// A computed bound beyond so many expected ones is too large for a comparison.
inline constexpr double uncertain_from = 10.0;

struct PointComparison {
  std::optional<LocatedPoint> expected;  ///< nothing of an additional point
  std::optional<LocatedPoint> found;     ///< nothing of a missing one
  PointVerdict verdict = PointVerdict::agrees;

  [[nodiscard]] double value() const { return expected ? expected->value : found->value; }
};

/// In the order of their values, expected ones where there are some.
/// @param reach  farther apart two points are not one, in the parameter's unit
[[nodiscard]] std::vector<PointComparison> compare_points(std::span<const LocatedPoint> expected,
                                                          std::span<const LocatedPoint> found, double reach);

}  // namespace epicyclic::studies
