#include "studies/branches.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "core/errors.hpp"
#include "core/require.hpp"
#include "integrate/make_flow.hpp"
#include "integrate/methods.hpp"
#include "studies/axis.hpp"
#include "studies/motion.hpp"
#include "studies/plane.hpp"

namespace epicyclic::studies {

integrate::IntegratorOptions branch_integrator(const std::string& method, double tolerance, bool contacts) {
  integrate::IntegratorOptions o;
  o.method = method;
  o.relative_tolerance = o.absolute_tolerance = tolerance;
  o.tangent_error_control = true;
  o.locate_contacts = contacts && integrate::method_named(method).locates_contacts();
  o.max_steps_per_period = 1000000;
  return o;
}

namespace {

integrate::FlowFamily flows_of(const ModelAt& models, const integrate::IntegratorOptions& integrator) {
  return integrate::make_flow_family([models](double value) -> VectorField { return models(value); }, integrator);
}

}  // namespace

void BranchesOptions::validate() const {
  require(from < to, "to", to, "> from");
  (void)integrate::method_named(method);
  for (const double at : starts) require(at >= from && at <= to, "starts", at, "within from and to");
  for (const BranchSeed& seed : seeds) {
    seed.validate();
    require(seed.value >= from && seed.value <= to, "seeds", seed.value, "within from and to");
  }
  require(transient_periods >= 0, "transient_periods", transient_periods, ">= 0");
  require(period >= 1, "period", period, ">= 1");
  require(period_max >= period, "period_max", period_max, ">= period");
  require(shooting_intervals >= 1, "shooting_intervals", shooting_intervals, ">= 1");
  require(orbits >= 1, "orbits", orbits, ">= 1");
  require(branches >= 1, "branches", branches, ">= 1");
  require(tolerance >= 1e-13 && tolerance <= 1e-6, "tolerance", tolerance, "1e-13 to 1e-6");
  require(max_step > 0.0, "max_step", max_step, "> 0");
  require(output_phases >= 1, "output_phases", output_phases, ">= 1");
  if (loci) loci->validate();
  if (search) search->validate();
}

std::vector<double> BranchesOptions::all_starts() const {
  if (!starts.empty() || !seeds.empty() || search) return starts;
  return {from, grid_value(from, to, 0.5), to};
}

void BranchSeed::validate() const {
  require(std::isfinite(value), "value", value, "finite");
  require(period >= 1, "period", period, ">= 1");
  require(!max_distance || *max_distance > 0.0, "max_distance", max_distance.value_or(0.0), "> 0");
  if (state.empty()) throw InputError("state is empty, must have a number for each component");
  for (const double x : state) require(std::isfinite(x), "state", x, "finite");
}

BranchSystem branch_system(const ModelAt& models, const BranchesOptions& options,
                           const model::DynamicModel& first_model) {
  options.validate();
  if (!has_classification(first_model))
    throw InputError("forces jump at contact: there are no tangents to follow branches by");
  const auto at = [&, contacts = first_model.surfaces.count > 0](double tolerance) {
    return flows_of(models, branch_integrator(options.method, tolerance, contacts));
  };
  BranchSystem s;
  s.system.flows = at(options.tolerance);
  s.system.period = options.period;
  s.system.shooting_intervals = options.shooting_intervals;
  s.system.residual = 10.0 * options.tolerance;
  // Whatever its unit, the parameter counts as the states do: over the range by some three b_c.
  constexpr double part_of_range = 0.3;
  s.system.value_scale = part_of_range * (options.to - options.from);
  if (first_model.remove_synchronous && first_model.planets > 1)
    s.system.symmetry =
        analysis::cyclic_symmetry(first_model.dimension, first_model.planets, planet_turns(first_model).front().map);
  analysis::ContinuationOptions& c = s.options.continuation;
  c.from = options.from;
  c.to = options.to;
  c.values = options.values;
  c.max_step = options.max_step;
  c.first_step = std::min(c.first_step, options.max_step);
  c.orbits = static_cast<std::size_t>(options.orbits);
  // Of the branch's own tolerance a multiplier is off by a thousand times as much, and a place with it; below the last
  // one there is rounding alone.
  constexpr double finest = 3e-14;
  const double finer = std::max(0.1 * options.tolerance, finest);
  const auto fine_flows = at(finer);
  s.options.special.others = {{fine_flows, 1}, {fine_flows, 2}, {at(std::max(0.1 * finer, finest)), 1}};
  s.options.special.branch_counts = false;
  s.options.largest_period = options.period_max;
  s.options.branch_points = options.branch_points;
  s.options.branches = static_cast<std::size_t>(options.branches);
  return s;
}

namespace {

/// The orbit of the family near a state, with its least period.
BranchOrigin origin_near(const BranchSystem& system, analysis::OrbitFamily family, double value,
                         const std::vector<double>& state) {
  BranchOrigin result;
  if (family.symmetry.map.size() != 0) {
    const Eigen::Map<const Eigen::VectorXd> y(state.data(), static_cast<Eigen::Index>(state.size()));
    // The motion is still settling: what differs by less is on its way to be alike.
    constexpr double alike = 1e-3;
    family.keeps_symmetry = (family.symmetry.map * y - y).lpNorm<Eigen::Infinity>() <= alike;
    result.keeps_symmetry = family.keeps_symmetry;
  }
  analysis::Correction c = analysis::first_orbit(family, value, state);
  if (c.found && family.symmetry.map.size() != 0 && !family.keeps_symmetry) {
    // The motion had not settled, but its orbit is one of those that move alike.
    const Eigen::VectorXd y = c.orbit.at.states.col(0);
    if ((family.symmetry.map * y - y).lpNorm<Eigen::Infinity>() <= system.options.same * family.state_scale) {
      family.keeps_symmetry = result.keeps_symmetry = true;
      c = analysis::first_orbit(family, value, {y.data(), static_cast<std::size_t>(y.size())});
    }
  }
  result.period = family.period;
  result.shooting_intervals = family.shooting_intervals;
  if (c.found) {
    const Eigen::MatrixXd states = analysis::period_states(family, c.orbit.at);
    const int least = analysis::least_period(states, system.options.same * family.state_scale);
    if (least < family.period) {
      // As one of the longer period its flips would be taken for branch points.
      family.shooting_intervals = std::max(1, family.shooting_intervals * least / family.period);
      family.period = result.period = least;
      result.shooting_intervals = family.shooting_intervals;
      const Eigen::VectorXd first = states.col(0);
      c = analysis::first_orbit(family, value, {first.data(), static_cast<std::size_t>(first.size())});
    }
  }
  if (c.found) {
    const Eigen::Map<const Eigen::VectorXd> y(state.data(), static_cast<Eigen::Index>(state.size()));
    result.distance = (c.orbit.at.states.col(0) - y).lpNorm<Eigen::Infinity>();
    result.orbit = std::move(c.orbit);
  } else {
    result.message = c.message;
  }
  return result;
}

}  // namespace

BranchOrigin settled_start(const BranchSystem& system, const model::DynamicModel& model, double value,
                           int transient_periods) {
  std::vector<double> state = model.default_start;
  const auto flow = system.system.flows(value);
  for (int k = 0; k < transient_periods; ++k) {
    const integrate::Evolution e = flow->evolve(state, 0.0, model.period);
    if (e.reached()) continue;
    BranchOrigin none;
    none.message = e.message;
    return none;
  }
  BranchOrigin origin = origin_near(system, system.system, value, state);
  if (!origin.orbit)
    origin.message = "no orbit of period " + std::to_string(system.system.period) + " near the state after " +
                     std::to_string(transient_periods) + " mesh periods: " + origin.message;
  return origin;
}

BranchOrigin seed_start(const BranchSystem& system, const BranchSeed& seed) {
  seed.validate();
  analysis::OrbitFamily family = system.system;
  family.shooting_intervals = std::max(1, family.shooting_intervals * seed.period / family.period);
  family.period = seed.period;
  BranchOrigin origin = origin_near(system, family, seed.value, seed.state);
  if (!origin.orbit)
    origin.message = "no orbit of period " + std::to_string(seed.period) + " near the seed: " + origin.message;
  return origin;
}

BranchRow branch_row(const analysis::OrbitFamily& family, const analysis::BranchOrbit& orbit,
                     const model::DynamicModel& model, int phases) {
  BranchRow row;
  row.value = orbit.at.value;
  row.omega = model.omega;
  row.period = family.period;
  row.residual = orbit.residual;
  row.multipliers = analysis::multipliers_of(family, orbit.monodromy);
  for (const auto& x : row.multipliers) row.unstable += std::abs(x) > 1.0 ? 1 : 0;
  row.stable = row.unstable == 0;
  const Eigen::MatrixXd states = analysis::period_states(family, orbit.at);
  if (states.cols() == 0) return row;
  const auto flow = family.flows(orbit.at.value);
  ResponseStatistics watch(model, phases);
  for (Eigen::Index n = 0; n < states.cols(); ++n) {
    std::vector<double> y(states.col(n).begin(), states.col(n).end());
    flow->forget();
    const auto see = [&](std::size_t, double, std::span<const double> state) { watch.see(state); };
    if (!flow->evolve(y, 0.0, model.period, watch.phases(), see).reached()) return row;
  }
  model::MeshDeflections d;
  for (Eigen::Index n = 0; n < states.cols(); ++n)
    append_poincare_row(model, {states.col(n).data(), static_cast<std::size_t>(states.rows())}, d, row.section);
  row.meshes = watch.finish();
  row.carried = true;
  return row;
}

void settle_stability(const analysis::Branch& branch, std::vector<BranchRow>& rows) {
  if (rows.size() < 2) return;
  const auto take = [](BranchRow& row, const BranchRow& neighbour) {
    row.stable = neighbour.stable;
    row.unstable = neighbour.unstable;
  };
  if (branch.first.born) take(rows.front(), rows[1]);
  if (branch.last.born) take(rows.back(), rows[rows.size() - 2]);
}

namespace {

/// What first happens at a contact where an extremum of its distance crosses 0.
std::string contact_event(const model::ContactSurface& surface, bool least) {
  if (!surface.mesh) return least == surface.upper ? "release" : "touch";
  if (surface.upper) return least ? "loss" : "drive";
  return least ? "back" : "back_loss";
}

/// Puts a part among those before the colon, in their order: "sp_1+sp_3:loss" and "sp_2".
void add_part(std::string& contact, const std::string& part) {
  const std::size_t colon = contact.find(':');
  std::size_t at = 0;
  while (at < colon) {
    const std::size_t end = std::min(contact.find('+', at), colon);
    if (contact.substr(at, end - at) > part) break;
    at = end + 1;
  }
  if (at > colon) {
    contact.insert(colon, "+" + part);
  } else {
    contact.insert(at, part + "+");
  }
}

/// Multipliers of the whole monodromy that a point is about.
std::vector<std::complex<double>> critical_multipliers(const analysis::SpecialPoint& point, int order) {
  using analysis::SpecialKind;
  if (point.kind == SpecialKind::grazing || point.kind == SpecialKind::unresolved) return {};
  std::vector<std::complex<double>> all = {point.multiplier};
  const bool pair = point.kind == SpecialKind::neimark_sacker;
  // A block other than the first and the middle one stands for two.
  const bool double_block = point.symmetry_index != 0 && 2 * point.symmetry_index != order;
  if (pair || double_block) all.push_back(std::conj(point.multiplier));
  return all;
}

}  // namespace

std::string kind_word(const SpecialRow& row) {
  return row.resonance > 0 ? "resonance_1_" + std::to_string(row.resonance) : to_string(row.kind);
}

std::optional<std::size_t> TracedBranches::change_behind(std::size_t branch, std::size_t before) const {
  using analysis::SpecialKind;
  const BranchRow& a = rows[branch][before];
  const BranchRow& b = rows[branch][before + 1];
  if (a.stable == b.stable) return std::nullopt;
  const auto distance = [&](std::size_t i) { return std::abs(special[i].value - (a.stable ? a : b).value); };
  std::optional<std::size_t> nearest;
  for (std::size_t i = 0; i < special.size(); ++i) {
    const SpecialRow& r = special[i];
    if (r.branch != branch || r.after != before || r.kind == SpecialKind::grazing || r.kind == SpecialKind::unresolved)
      continue;
    if (!nearest || distance(i) < distance(*nearest)) nearest = i;
  }
  return nearest;
}

std::size_t TracedBranches::broken_off() const {
  std::size_t count = 0;
  for (const analysis::Branch& branch : branches)
    for (const analysis::BranchLimit* limit : {&branch.first, &branch.last})
      count += limit->end == analysis::BranchEnd::min_step ? 1 : 0;
  return count;
}

std::vector<SpecialRow> special_rows(const std::vector<analysis::Branch>& branches,
                                     const std::vector<model::ContactSurface>& contacts) {
  using analysis::SpecialKind;
  std::vector<SpecialRow> rows;
  for (std::size_t b = 0; b < branches.size(); ++b) {
    const analysis::Branch& branch = branches[b];
    for (std::size_t k = 0; k < branch.special.size(); ++k) {
      const analysis::SpecialPoint& point = branch.special[k];
      SpecialRow row;
      row.branch = b;
      row.point = k;
      row.after = branch.after[k];
      row.kind = point.kind;
      row.value = point.value;
      row.error_bound = point.error_bound;
      row.period = branch.family.period;
      row.multipliers = critical_multipliers(point, branch.family.symmetry.order);
      if (point.symmetry_index != 0)
        row.broken_symmetry = analysis::block_name({point.symmetry_index, false, {}}, branch.family.symmetry.order);
      row.same_as = branch.same_as[k];
      row.note = point.note;
      row.resonance = point.kind == SpecialKind::neimark_sacker ? point.resonance : 0;
      if (point.kind == SpecialKind::grazing) {
        const model::ContactSurface& surface = contacts.at(point.surface);
        std::string event(1, ':');
        event += contact_event(surface, point.least);
        // Planets that move alike graze at once: one event, and no more than one value.
        if (!rows.empty() && branch.family.keeps_symmetry && branch.family.symmetry.map.size() != 0) {
          SpecialRow& last = rows.back();
          const bool alike = last.branch == b && last.kind == point.kind && last.contact.ends_with(event) &&
                             last.contact.compare(0, 2, surface.part, 0, 2) == 0 && surface.mesh &&
                             std::abs(last.value - point.value) <= last.error_bound + point.error_bound;
          if (alike) {
            add_part(last.contact, surface.part);
            last.error_bound = std::max(last.error_bound, point.error_bound);
            continue;
          }
        }
        row.contact = surface.part + event;
      }
      rows.push_back(std::move(row));
    }
  }
  return rows;
}

}  // namespace epicyclic::studies
