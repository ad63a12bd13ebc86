#include "reports/plane_output.hpp"

#include <span>

#include "studies/plane.hpp"

namespace epicyclic::reports {

using studies::PointSummary;

store::PointColumn second_value_column() {
  return {"second_value", "of the parameter", "of the second one",
          store::PointColumn::Getter<double>([](const PointSummary& r) { return r.point.second_value; })};
}

void write_plane(store::Hdf5File& h5, const std::string& group, const std::string& axis, const studies::Plane& plane,
                 const std::string& resolved_input, const studies::PointSource& points,
                 const std::vector<store::PointColumn>& more) {
  h5.set_attribute("/", "input_resolved", resolved_input);
  h5.set_attribute("/", axis, plane.first.name);
  h5.set_attribute("/", "second_" + axis, plane.second.name);
  const store::PointColumn second = second_value_column();
  std::vector<store::PointColumn> columns = {second};
  columns.insert(columns.end(), more.begin(), more.end());
  write_point_columns(h5, points, columns);
  h5.create_group(group);
  h5.write(group + "/value", std::span<const double>(axis_values(plane.first)));
  h5.write(group + "/" + second.name, std::span<const double>(axis_values(plane.second)));
  h5.set_attribute(group + "/value", axis, plane.first.name);
  h5.set_attribute(group + "/" + second.name, axis, plane.second.name);
  h5.name_axes(group + "/value", {"value"});
  h5.name_axes(group + "/" + second.name, {second.name});
}

}  // namespace epicyclic::reports
