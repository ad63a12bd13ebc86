// epicyclic map: regimes over two parameters.

#include <vector>

#include "commands.hpp"
#include "input/study_model.hpp"
#include "io/map_output.hpp"
#include "points.hpp"

namespace epicyclic::app {

namespace {

WrittenPoints write_results(const ComputedPoints& plane) {
  const input::Study& study = plane.input.study;
  const io::MapOutput output{*study.sweep, study.plane, plane.resolved, io::figure_title(study)};
  io::write_map_csv(plane.folder / "points.csv", plane.points);
  io::write_map_h5(plane.folder / "results.h5", output, plane.points);
  WrittenPoints written;
  written.figures = io::draw_map_figures(plane.folder / "figures", output, plane.points);
  return written;
}

}  // namespace

int map_command(const Arguments& arguments) { return points_command(arguments, "map", "cells", {{write_results}}); }

}  // namespace epicyclic::app
