// Other attractors that a finished study has at one of its points: from the other direction of a sweep, from other
// cells of basins.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "studies/plane.hpp"
#include "studies/point_source.hpp"
#include "studies/sweep.hpp"

namespace epicyclic::studies {

/// A state on the attractor of a point, at the mesh phase 0. It is on its orbit if it is periodic by evidence, else
/// where its trajectory or its record ended. Empty if none was kept.
[[nodiscard]] std::vector<double> state_on(const PointResult& point, std::size_t dimension);

/// An attractor, and a point that is on it.
struct KnownAttractor {
  std::size_t point = 0;
  std::string regime;        ///< "period 2"
  std::size_t points = 0;    ///< that are on it, of those considered
  std::size_t image_of = 0;  ///< it is this one's image under a rotation of the planets, counted from 1; 0: of none
};

struct KnownAttractors {
  std::vector<KnownAttractor> all;  ///< each once [analysis/attractors.hpp], in the order of their first points
  std::size_t here = 0;             ///< which of them the point is on, counted from 1; 0: on none
  std::size_t considered = 0;       ///< points
};

/// At the values of a point: of basins all cells, of a sweep or a map the points of its other directions.
/// @param model  there
/// @param basins the points are cells of one operating point
[[nodiscard]] KnownAttractors attractors_known_at(const SweepPlan& plan, const PointSource& points, std::size_t point,
                                                  bool basins, const model::DynamicModel& model,
                                                  const integrate::IntegratorOptions& integrator);

}  // namespace epicyclic::studies
