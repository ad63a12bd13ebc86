// Planes of points, computed as sweeps are [studies/sweep.hpp].
//
// A map varies two parameters. Basins vary two components of the start; the system stays, and what the motions end on
// is told by analysis/attractors.hpp.
#pragma once

#include <cstddef>
#include <vector>

#include "analysis/attractors.hpp"
#include "model/dynamic_model.hpp"
#include "studies/plane_options.hpp"
#include "studies/sweep.hpp"

namespace epicyclic::studies {

/// Where the motion of a cell of basins starts: the model's default start, the base, then both axes.
/// @throws InputError for a component that the state has not
[[nodiscard]] std::vector<double> start_in_plane(const model::DynamicModel& model, const BasinsOptions& basins,
                                                 const GridPoint& point);

/// A turn that takes each planet to the place of another.
struct PlanetRotation {
  int planets = 0;  ///< that each moves on by
  analysis::Symmetry map;
};

/// All of them, for equally spaced planets, as maps of the section s = 0. Planets that mesh out of phase see at another
/// instant what those before them saw: with planet k ahead by t_k turns of the mesh phase, a motion y(s) has the image
/// T y(s + 2 pi t_k), T the turn, so that y(0) is carried on by that part of a mesh period first. Where a
/// turned orbit is one of another attractor, the turn is a symmetry of these motions, if not of the stage: a clearance
/// with a law along x and y has directions of its own, but only for motions that reach its edge.
/// @param integrator  for planets out of phase
[[nodiscard]] std::vector<PlanetRotation> planet_rotations(const model::DynamicModel& model,
                                                           const integrate::IntegratorOptions& integrator = {});

/// The attractors that the cells ended on, images by turns of the planets among them.
/// @param results  of all cells, in order; their records are taken out
[[nodiscard]] analysis::Attractors attractors_of(std::vector<PointSummary>& results,
                                                 const std::vector<PlanetRotation>& rotations);

}  // namespace epicyclic::studies
