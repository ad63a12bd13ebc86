#include "reports/plane_output.hpp"

#include <span>

#include "studies/plane.hpp"

namespace epicyclic::reports {

using studies::PointResult;

PointColumn second_value_column() {
  return {"second_value", [](const PointResult& r) { return r.point.second_value; }};
}

void write_plane(store::Hdf5File& h5, const std::string& group, const std::string& axis,
                 const studies::PlaneOptions& plane, const std::string& resolved_input,
                 const studies::PointSource& points) {
  h5.set_attribute("/", "input_resolved", resolved_input);
  h5.set_attribute("/", axis, plane.first.name);
  h5.set_attribute("/", "second_" + axis, plane.second.name);
  write_point_columns(h5, points);
  const PointColumn column = second_value_column();
  h5.write("/points/" + column.name, points.count,
           store::Hdf5File::Column<double>([&](std::size_t row) { return column.value(points.read_brief(row)); }));
  h5.create_group(group);
  h5.write(group + "/value", std::span<const double>(axis_values(plane.first)));
  h5.write(group + "/" + column.name, std::span<const double>(axis_values(plane.second)));
}

}  // namespace epicyclic::reports
