// epicyclic basins: the attractors that trajectories from a plane of initial states reach.

#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include "commands.hpp"
#include "expected_time.hpp"
#include "input/study_model.hpp"
#include "kind_commands.hpp"
#include "kinds/basins/output.hpp"
#include "points.hpp"
#include "reports/transient_chaos.hpp"
#include "studies/plane.hpp"

namespace epicyclic::app {

namespace {

WrittenPoints write_basins(const ComputedPoints& plane) {
  std::vector<studies::PointSummary> results = studies::all_summaries(plane.points);
  const input::Study& study = plane.input.study;
  const kinds::BasinsOutput output{study.plan.as<studies::BasinsOptions>().plane, plane.first_model.state_names,
                                   studies::planet_rotations(plane.first_model, study.integrator), plane.resolved,
                                   reports::figure_title(study)};
  const analysis::Attractors attractors = studies::attractors_of(results, output.rotations);
  kinds::write_basins_csv(plane.folder / "points.csv", results, attractors);
  kinds::write_attractors_csv(plane.folder / "attractors.csv", output, results, attractors);
  kinds::write_basins_h5(plane.folder / "results.h5", output, results, attractors);
  WrittenPoints written;
  written.figures = kinds::draw_basins_figure(plane.folder / "figures", output, results, attractors);
  written.summary["attractors"] = nlohmann::json::array();
  std::size_t classified = 0;
  for (std::size_t k = 0; k < attractors.all.size(); ++k) {
    const analysis::Attractor& a = attractors.all[k];
    classified += a.members.size();
    nlohmann::json one = {{"attractor", k + 1},
                          {"regime", to_string(a.record.regime)},
                          {"period", a.record.period()},
                          {"cells", a.members.size()}};
    std::string line =
        fmt::format("attractor {}: {}, {} cells", k + 1, kinds::attractor_word(a.record), a.members.size());
    if (a.image_of > 0) {
      one["image_of"] = a.image_of;
      line += fmt::format(", attractor {} with the planets permuted by {}", a.image_of,
                          output.rotations[a.image_by].planets);
    }
    written.summary["attractors"].push_back(std::move(one));
    written.lines.push_back(std::move(line));
  }
  const auto is_chaotic = [](const analysis::Attractor& a) { return a.record.regime == analysis::Regime::chaotic; };
  if (std::ranges::any_of(attractors.all, is_chaotic) && attractors.all.size() > 1)
    written.lines.emplace_back(reports::transient_chaos);
  if (classified < results.size())
    written.lines.push_back(fmt::format("no attractor known: {} cells", results.size() - classified));
  return written;
}

int run_basins(const Arguments& arguments) { return points_command(arguments, "basins", "cells", {{write_basins}}); }

}  // namespace

const Command& basins_command() {
  static const Command command = {
      .name = "basins",
      .meaning = "find coexisting attractors over a plane of initial states",
      .run = &run_basins,
      .takes = Takes::output,
      .options = &add_points_options,
      .shares_work = true,
      .expected = &time_of_points,
  };
  return command;
}

}  // namespace epicyclic::app
