#include "studies/branches.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "core/errors.hpp"
#include "core/require.hpp"
#include "integrate/make_flow.hpp"
#include "studies/motion.hpp"
#include "studies/plane.hpp"

namespace epicyclic::studies {

namespace {

integrate::FlowFamily flows_of(const ModelAt& models, double tolerance, bool contacts) {
  integrate::IntegratorOptions o;
  o.relative_tolerance = o.absolute_tolerance = tolerance;
  o.tangent_error_control = true;
  o.locate_contacts = contacts;
  o.max_steps_per_period = 1000000;
  return integrate::make_flow_family([models](double value) -> VectorField { return models(value); }, o);
}

}  // namespace

void BranchesOptions::validate() const {
  require(from < to, "to", to, "> from");
  if (starts.empty()) throw InputError("starts: there is none");
  for (const double at : starts) require(at >= from && at <= to, "starts", at, "within from and to");
  require(settle_periods >= 0, "settle_periods", settle_periods, ">= 0");
  require(period >= 1, "period", period, ">= 1");
  require(largest_period >= period, "largest_period", largest_period, ">= period");
  require(pieces >= 1, "pieces", pieces, ">= 1");
  require(orbits >= 1, "orbits", orbits, ">= 1");
  require(branches >= 1, "branches", branches, ">= 1");
  require(tolerance >= 1e-13 && tolerance <= 1e-6, "tolerance", tolerance, "1e-13 to 1e-6");
  require(largest_step > 0.0, "largest_step", largest_step, "> 0");
}

BranchSystem branch_system(const ModelAt& models, const BranchesOptions& options,
                           const model::DynamicModel& first_model) {
  options.validate();
  if (!has_classification(first_model))
    throw InputError("forces jump at contact: there are no tangents to follow branches by");
  const bool contacts = first_model.surfaces.count > 0;
  BranchSystem s;
  s.system.flows = flows_of(models, options.tolerance, contacts);
  s.system.period = options.period;
  s.system.pieces = options.pieces;
  s.system.residual = 10.0 * options.tolerance;
  if (first_model.remove_synchronous && first_model.planets > 1)
    s.system.symmetry =
        analysis::cyclic_symmetry(first_model.dimension, first_model.planets, planet_turns(first_model).front().map);
  analysis::ContinuationOptions& c = s.options.continuation;
  c.from = options.from;
  c.to = options.to;
  c.values = options.values;
  c.largest_step = options.largest_step;
  c.first_step = std::min(c.first_step, options.largest_step);
  c.orbits = static_cast<std::size_t>(options.orbits);
  const double finer = 0.1 * options.tolerance;
  s.options.special.others = {{flows_of(models, finer, contacts), 1}, {flows_of(models, finer, contacts), 2}};
  s.options.largest_period = options.largest_period;
  s.options.branch_points = options.branch_points;
  s.options.branches = static_cast<std::size_t>(options.branches);
  return s;
}

SettledStart settled_start(const BranchSystem& system, const model::DynamicModel& model, double value,
                           int settle_periods) {
  SettledStart result;
  std::vector<double> state = model.default_start;
  const auto flow = system.system.flows(value);
  for (int k = 0; k < settle_periods; ++k) {
    const integrate::Evolution e = flow->evolve(state, 0.0, model.period);
    if (e.reached()) continue;
    result.message = e.message;
    return result;
  }
  analysis::OrbitFamily family = system.system;
  if (family.symmetry.map.size() != 0) {
    const Eigen::Map<const Eigen::VectorXd> y(state.data(), static_cast<Eigen::Index>(state.size()));
    // The motion is still settling: what differs by less is on its way to be alike.
    constexpr double alike = 1e-3;
    family.keeps_symmetry = (family.symmetry.map * y - y).lpNorm<Eigen::Infinity>() <= alike;
    result.keeps_symmetry = family.keeps_symmetry;
  }
  analysis::Correction c = analysis::first_orbit(family, value, state);
  if (c.found) {
    result.orbit = std::move(c.orbit);
  } else {
    result.message = "no orbit of period " + std::to_string(family.period) + " near where the motion is after " +
                     std::to_string(settle_periods) + " mesh periods: " + c.message;
  }
  return result;
}

std::optional<BranchRow> branch_row(const analysis::OrbitFamily& family, const analysis::BranchOrbit& orbit,
                                    const model::DynamicModel& model, int phases) {
  BranchRow row;
  row.value = orbit.at.value;
  for (const auto& x : analysis::multipliers_of(family, orbit.monodromy)) {
    row.multiplier_max = std::max(row.multiplier_max, std::abs(x));
    row.unstable += std::abs(x) > 1.0 ? 1 : 0;
  }
  row.stable = row.unstable == 0;
  const Eigen::MatrixXd states = analysis::period_states(family, orbit.at);
  if (states.cols() == 0) return std::nullopt;
  row.section.assign(states.data(), states.data() + states.size());
  const auto flow = family.flows(orbit.at.value);
  MeshWatch watch(model);
  std::vector<double> at;
  for (int k = 1; k <= phases; ++k) at.push_back(k == phases ? model.period : model.period * k / phases);
  for (Eigen::Index n = 0; n < states.cols(); ++n) {
    std::vector<double> y(states.col(n).begin(), states.col(n).end());
    flow->forget();
    const auto see = [&](std::size_t, double s, std::span<const double> state) { watch.see(s, state); };
    if (!flow->evolve(y, 0.0, model.period, at, see).reached()) return std::nullopt;
  }
  row.meshes = watch.finished();
  return row;
}

}  // namespace epicyclic::studies
