// Planes of points, computed as sweeps are [studies/sweep.hpp].
//
// A map varies two parameters. Basins vary two components of the initial state at one operating point;
// analysis/attractors.hpp identifies the attractors that the trajectories reach.
#pragma once

#include <cstddef>
#include <vector>

#include "analysis/attractors.hpp"
#include "model/dynamic_model.hpp"
#include "studies/plane_options.hpp"
#include "studies/sweep.hpp"

namespace epicyclic::studies {

/// The initial state of a cell of basins: the model's default start, the base, then both axes.
/// @throws InputError for a component that the state does not have
[[nodiscard]] std::vector<double> start_in_plane(const model::DynamicModel& model, const BasinsOptions& basins,
                                                 const GridPoint& point);

/// A rotation that takes each planet to the place of another.
struct PlanetRotation {
  int planets = 0;  ///< that each moves on by
  analysis::Symmetry map;
};

/// All of them, for equally spaced planets, as maps of the section s = 0. If planets mesh out of phase, each passes the
/// same mesh phase at another instant. With planet k ahead by t_k revolutions of the mesh phase, a trajectory y(s) has
/// the image T y(s + 2 pi t_k), T the rotation. So y(0) is first integrated over that part of a mesh period. If a
/// rotated orbit is one of another attractor, the rotation is a symmetry of these attractors, if not of the stage. A
/// clearance with a law along x and y has preferred directions, but only for trajectories that reach its edge.
/// @param integrator  for planets out of phase
[[nodiscard]] std::vector<PlanetRotation> planet_rotations(const model::DynamicModel& model,
                                                           const integrate::IntegratorOptions& integrator = {});

/// The attractors of the cells, with their images by rotations of the planets.
/// @param results  of all cells, in order; their records are moved out
[[nodiscard]] analysis::Attractors attractors_of(std::vector<PointSummary>& results,
                                                 const std::vector<PlanetRotation>& rotations);

}  // namespace epicyclic::studies
