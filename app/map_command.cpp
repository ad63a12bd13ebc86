// epicyclic map: regimes over two parameters.

#include "commands.hpp"
#include "io/map_output.hpp"
#include "io/study_model.hpp"
#include "plane.hpp"

namespace epicyclic::app {

int map_command(const Arguments& arguments) {
  return plane_command(arguments, "map", [](const ComputedPlane& plane) {
    const io::Study& study = plane.input.study;
    const io::MapOutput output{*study.sweep, study.plane, plane.resolved, io::figure_title(study)};
    io::write_map_csv(plane.folder.file("points.csv"), plane.results);
    io::write_map_h5(plane.folder.file("results.h5"), output, plane.results);
    WrittenPlane written;
    written.figures = io::draw_map_figures(plane.folder.file("figures"), output, plane.results);
    return written;
  });
}

}  // namespace epicyclic::app
