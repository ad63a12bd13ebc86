// epicyclic sweep: bifurcation diagram along one parameter.

#include <cstddef>

#include <fmt/format.h>

#include "commands.hpp"
#include "io/study_model.hpp"
#include "io/sweep_output.hpp"
#include "points.hpp"

namespace epicyclic::app {

namespace {

io::SweepOutput output_of(const ComputedPoints& all) {
  return {*all.input.study.sweep, studies::poincare_columns(all.first_model), all.resolved,
          io::figure_title(all.input.study)};
}

WrittenPoints write_section(const ComputedPoints& all) {
  io::write_poincare_csv(all.folder / "poincare.csv", output_of(all), all.points);
  return {};
}

WrittenPoints write_h5(const ComputedPoints& all) {
  io::write_results_h5(all.folder / "results.h5", output_of(all), all.points);
  return {};
}

template <io::DrawnMesh mesh>
WrittenPoints draw(const ComputedPoints& all) {
  WrittenPoints written;
  written.figures.push_back(io::draw_bifurcation(all.folder / "figures", output_of(all), all.points, mesh));
  return written;
}

WrittenPoints draw_regimes(const ComputedPoints& all) {
  WrittenPoints written;
  written.figures = io::draw_regimes(all.folder / "figures", output_of(all), all.points);
  return written;
}

WrittenPoints write_points(const ComputedPoints& all) {
  io::write_points_csv(all.folder / "points.csv", all.points);
  std::size_t settling = 0;
  for (std::size_t i = 0; i < all.points.count; ++i)
    settling += studies::still_settling(all.points.read_brief(i), *all.input.study.sweep) ? 1 : 0;
  WrittenPoints written;
  if (settling > 0)
    written.notes.push_back(
        fmt::format("{} undecided points were still settling (recurrence_error_late below recurrence_error): "
                    "/study/classification_periods > 0, or a larger /study/transient_periods, decides them",
                    settling));
  return written;
}

}  // namespace

int sweep_command(const Arguments& arguments) {
  // The longest first, in which order they are handed out. Regimes follow a classification, which takes far longer.
  return points_command(arguments, "sweep", "points",
                        {write_h5, draw<io::DrawnMesh::sun_planet>, draw<io::DrawnMesh::ring_planet>, write_section,
                         draw_regimes, write_points});
}

}  // namespace epicyclic::app
