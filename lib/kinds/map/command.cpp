// epicyclic map: regimes over two parameters.

#include <vector>

#include "commands.hpp"
#include "expected_time.hpp"
#include "input/study_model.hpp"
#include "kind_commands.hpp"
#include "kinds/map/output.hpp"
#include "points.hpp"

namespace epicyclic::app {

namespace {

WrittenPoints write_map(const ComputedPoints& plane) {
  const input::Study& study = plane.input.study;
  const kinds::MapOutput output{study.plan.as<studies::MapOptions>(), plane.resolved, reports::figure_title(study),
                                study.axis_speed};
  kinds::write_map_csv(plane.folder / "points.csv", plane.points);
  kinds::write_map_h5(plane.folder / "results.h5", output, plane.points);
  WrittenPoints written;
  written.figures = kinds::draw_map_figures(plane.folder / "figures", output, plane.points);
  return written;
}

int run_map(const Arguments& arguments) { return points_command(arguments, "map", "cells", {{write_map}}); }

}  // namespace

const Command& map_command() {
  static const Command command = {
      .name = "map",
      .meaning = "classify regimes over two parameters",
      .run = &run_map,
      .takes = Takes::output,
      .options = &add_points_options,
      .shares_work = true,
      .expected = &time_of_points,
  };
  return command;
}

}  // namespace epicyclic::app
