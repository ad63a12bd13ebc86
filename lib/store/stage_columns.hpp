// Results of meshes and bearings over a record [studies/response_statistics.hpp], as columns of points and of orbits.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "store/column.hpp"
#include "studies/response_statistics.hpp"

namespace epicyclic::store {

using StageColumn = Column<studies::StageRecord>;

/// Extrema and contact of the meshes of planet 1.
[[nodiscard]] std::vector<StageColumn> contact_columns();

/// Columns of the stage, and deflections and forces of planet 1.
[[nodiscard]] std::vector<StageColumn> stage_columns();

/// Of each mesh and bearing of each planet.
[[nodiscard]] std::vector<StageColumn> planet_columns(std::size_t planets);

/// Bearings whose lives are known: there are columns for them.
struct KnownLives {
  bool planets = false, sun = false;
};
[[nodiscard]] KnownLives known_lives(const studies::StageRecord& record);

/// Lives of bearings [G-life].
[[nodiscard]] std::vector<StageColumn> life_columns(std::size_t planets, const KnownLives& known);

/// Does a lone pair of gears have the column? It has no ring, no carrier, and nothing to share loads with.
[[nodiscard]] bool is_of_pair(std::string_view column);

}  // namespace epicyclic::store
