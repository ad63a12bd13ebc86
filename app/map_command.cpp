// epicyclic map: regimes over two parameters.

#include <vector>

#include "commands.hpp"
#include "io/map_output.hpp"
#include "io/study_model.hpp"
#include "points.hpp"

namespace epicyclic::app {

int map_command(const Arguments& arguments) {
  return points_command(arguments, "map", "cells", [](const ComputedPoints& plane) {
    std::vector<studies::PointResult> results = io::all_brief(plane.points);
    const io::Study& study = plane.input.study;
    const io::MapOutput output{*study.sweep, study.plane, plane.resolved, io::figure_title(study)};
    io::write_map_csv(plane.folder.file("points.csv"), results);
    io::write_map_h5(plane.folder.file("results.h5"), output, results);
    WrittenPoints written;
    written.figures = io::draw_map_figures(plane.folder.file("figures"), output, results);
    return written;
  });
}

}  // namespace epicyclic::app
