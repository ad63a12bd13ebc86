// Common parts of the files of maps and basins.
#pragma once

#include <string>
#include <vector>

#include "reports/sweep_output.hpp"
#include "store/hdf5_file.hpp"
#include "studies/plane_options.hpp"
#include "studies/sweep.hpp"

namespace epicyclic::reports {

/// Of points.csv.
[[nodiscard]] store::PointColumn second_value_column();

/// The input, what the axes are, the group /points, and `group` with the values along both axes, ascending.
/// @param axis  "parameter" or "component": of the attributes
/// @param more  columns of the points besides
void write_plane(store::Hdf5File& h5, const std::string& group, const std::string& axis, const studies::Plane& plane,
                 const std::string& resolved_input, const studies::PointSource& points,
                 const std::vector<store::PointColumn>& more = {});

}  // namespace epicyclic::reports
