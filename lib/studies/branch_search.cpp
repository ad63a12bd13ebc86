#include "studies/branch_search.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include "core/errors.hpp"
#include "core/require.hpp"

namespace epicyclic::studies {

void BranchSearchOptions::validate() const {
  if (values.empty()) throw InputError("values is empty, must have one at least");
  require(starts >= 1, "starts", starts, ">= 1");
  require(spread >= 0.0, "spread", spread, ">= 0");
  require(period_max >= 1, "period_max", period_max, ">= 1");
}

CoexistingOrbits search_coexisting_orbits(const BranchSystem& system, const model::DynamicModel& model, double value,
                                          const BranchSearchOptions& options, int transient_periods) {
  options.validate();
  std::vector<std::vector<double>> starts;
  std::vector<double> state = model.default_start;
  const auto flow = system.system.flows(value);
  const auto on_trajectory = static_cast<std::size_t>((options.starts + 1) / 2);
  for (int k = 0; starts.size() < on_trajectory; ++k) {
    if (k >= transient_periods) starts.push_back(state);
    if (!flow->evolve(state, 0.0, model.period).reached()) break;
  }
  const std::vector<double> centre = starts.empty() ? model.default_start : starts.front();
  const std::vector<double> half_widths(centre.size(), options.spread);
  std::vector<std::vector<double>> in_box =
      analysis::starts_in_box(centre, half_widths, static_cast<std::size_t>(options.starts) - starts.size() + 1);
  // The centre is there already.
  starts.insert(starts.end(), in_box.begin() + 1, in_box.end());

  analysis::OrbitFamily family = system.system;
  family.keeps_symmetry = false;
  analysis::SearchOptions search;
  search.largest_period = options.period_max;
  constexpr int periods_that_come_back = 200;
  search.return_periods = periods_that_come_back;
  const analysis::OrbitSearch found = search_orbits(family, value, starts, search);

  CoexistingOrbits result{value, starts.size(), 0};
  std::set<std::size_t> led;
  for (const analysis::FoundOrbit& f : found.orbits) led.insert(f.starts.begin(), f.starts.end());
  result.missed = starts.size() - led.size();
  for (const analysis::FoundOrbit& f : found.orbits)
    result.orbits.push_back({f.orbit, f.family.period, f.family.shooting_intervals, f.keeps_symmetry(), f.images,
                             f.unstable, f.multiplier_max, f.starts.size()});
  return result;
}

}  // namespace epicyclic::studies
