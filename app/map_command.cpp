// epicyclic map: regimes over two parameters.

#include <vector>

#include "commands.hpp"
#include "input/study_model.hpp"
#include "points.hpp"
#include "reports/map_output.hpp"

namespace epicyclic::app {

namespace {

WrittenPoints write_results(const ComputedPoints& plane) {
  const input::Study& study = plane.input.study;
  const reports::MapOutput output{std::get<studies::MapOptions>(study.plan), plane.resolved,
                                  reports::figure_title(study), study.axis_speed};
  reports::write_map_csv(plane.folder / "points.csv", plane.points);
  reports::write_map_h5(plane.folder / "results.h5", output, plane.points);
  WrittenPoints written;
  written.figures = reports::draw_map_figures(plane.folder / "figures", output, plane.points);
  return written;
}

}  // namespace

int map_command(const Arguments& arguments) { return points_command(arguments, "map", "cells", {{write_results}}); }

}  // namespace epicyclic::app
