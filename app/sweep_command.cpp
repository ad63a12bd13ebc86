// epicyclic sweep: bifurcation diagram along one parameter.

#include <array>
#include <cstddef>
#include <functional>

#include <fmt/core.h>

#include "commands.hpp"
#include "io/study_model.hpp"
#include "io/sweep_output.hpp"
#include "points.hpp"
#include "studies/units.hpp"

namespace epicyclic::app {

int sweep_command(const Arguments& arguments) {
  return points_command(arguments, "sweep", "points", [&](const ComputedPoints& all) {
    const studies::SweepOptions& sweep = *all.input.study.sweep;
    const io::SweepOutput output{sweep, studies::poincare_columns(all.first_model), all.resolved,
                                 io::figure_title(all.input.study)};
    WrittenPoints written;
    // Side by side, the longest first: each of them reads the journal and writes files of its own.
    const std::array<std::function<void()>, 4> parts = {
        [&] { io::write_poincare_csv(all.folder.file("poincare.csv"), output, all.points); },
        [&] { io::write_results_h5(all.folder.file("results.h5"), output, all.points); },
        [&] { written.figures = io::draw_sweep_figures(all.folder.file("figures"), output, all.points); },
        [&] { io::write_points_csv(all.folder.file("points.csv"), all.points); }};
    studies::for_units(parts.size(), arguments.threads, nullptr, [&](std::size_t part) { parts[part](); });
    std::size_t settling = 0;
    for (std::size_t i = 0; i < all.points.count; ++i)
      settling += studies::still_settling(all.points.read_brief(i), sweep) ? 1 : 0;
    if (settling > 0)
      fmt::print(stderr,
                 "{} undecided points were still settling (recurrence_error_late below recurrence_error): "
                 "/study/classification_periods > 0, or a larger /study/transient_periods, decides them\n",
                 settling);
    return written;
  });
}

}  // namespace epicyclic::app
