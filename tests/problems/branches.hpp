// Branches of periodic orbits of systems with known answers, and how tests follow them.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "analysis/continuation.hpp"
#include "analysis/special_points.hpp"
#include "integrate/make_flow.hpp"
#include "problems/known_systems.hpp"

namespace epicyclic::problems {

/// Steps held by state and tangents alike.
inline integrate::IntegratorOptions exactly(double tolerance) {
  integrate::IntegratorOptions o;
  o.relative_tolerance = o.absolute_tolerance = tolerance;
  o.max_steps_per_period = 1000000;
  o.tangent_error_control = true;
  return o;
}

inline integrate::FlowFamily flows(const FieldFamily& fields, double tolerance) {
  return integrate::make_flow_family(fields, exactly(tolerance));
}

/// One way along a branch.
struct Traced {
  std::vector<analysis::BranchOrbit> orbits;
  std::vector<analysis::SpecialPoint> special;
  analysis::BranchEnd end = analysis::BranchEnd::none;
};

inline Traced trace(const analysis::OrbitFamily& family, const analysis::ContinuationOptions& options,
                    const analysis::SpecialOptions& special, analysis::BranchOrbit start) {
  Traced t;
  analysis::Continuation branch(family, options, std::move(start));
  t.orbits.push_back(branch.current());
  while (branch.advance()) {
    t.orbits.push_back(branch.current());
    for (analysis::SpecialPoint& p : special_points_between(family, branch.previous(), branch.current(), special))
      t.special.push_back(std::move(p));
  }
  t.end = branch.end();
  return t;
}

/// Where a motion from `start` is after some periods; where it was if it could not be carried.
inline std::vector<double> settled(const integrate::FlowFamily& family, double value, std::vector<double> start,
                                   int periods) {
  const auto flow = family(value);
  for (int k = 0; k < periods; ++k)
    if (!flow->evolve(start, 0.0, flow->field().period).reached()) break;
  return start;
}

/// By a tenth of the tolerance and twice the pieces.
inline analysis::SpecialOptions with_bounds(const std::function<integrate::FlowFamily(double)>& flows_at,
                                            double tolerance) {
  return {{{flows_at(0.1 * tolerance), 1}, {flows_at(0.1 * tolerance), 2}}};
}

/// N parts moved on by one.
inline analysis::CyclicSymmetry moved_on(std::size_t n) {
  return analysis::cyclic_symmetry(n, static_cast<int>(n), [n](std::span<const double> y) {
    std::vector<double> next(n);
    for (std::size_t i = 0; i < n; ++i) next[(i + 1) % n] = y[i];
    return next;
  });
}

/// The clearance oscillator over its speed; exact, its contacts stepped onto, or of a width.
inline integrate::FlowFamily clearance_flows(double e, double tolerance, double width = 0.0) {
  integrate::IntegratorOptions o = exactly(tolerance);
  o.locate_contacts = width == 0.0;
  ClearanceConstants constants;
  constants.e = e;
  return integrate::make_flow_family([constants, width](double w) { return clearance_oscillator(w, width, constants); },
                                     o);
}

/// A branch from an orbit that a motion settles to, the way of a rising parameter or the other.
struct BranchProblem {
  std::string name;
  std::function<integrate::FlowFamily(double tolerance)> flows;
  double start = 0;  ///< value of the parameter
  std::vector<double> state;
  int settle = 0;  ///< periods
  analysis::ContinuationOptions options{};
  int period = 1;
  bool rising = true;
  analysis::CyclicSymmetry symmetry{};

  [[nodiscard]] Traced trace(double tolerance, int shooting_intervals) const {
    analysis::OrbitFamily family{flows(tolerance)};
    family.period = period;
    family.shooting_intervals = shooting_intervals;
    family.symmetry = symmetry;
    family.residual = std::max(10.0 * tolerance, 1e-12);
    const analysis::Correction first = first_orbit(family, start, settled(flows(1e-10), start, state, settle));
    if (!first.found) return {};
    analysis::BranchOrbit from = first.orbit;
    if (!rising) from.direction = -1.0 * from.direction;
    return problems::trace(family, options, with_bounds(flows, tolerance), from);
  }
};

inline std::vector<BranchProblem> branch_problems() {
  const auto of = [](const FieldFamily& fields) {
    return [fields](double tolerance) { return problems::flows(fields, tolerance); };
  };
  std::vector<BranchProblem> all;
  all.push_back(
      {"Duffing over g, period 1", of(duffing(0.3, -1.0, 1.2)), 0.2, {1.0, 0.0}, 100, {.from = 0.2, .to = 1.0}});
  all.push_back(
      {"Duffing over g, period 2", of(duffing(0.3, -1.0, 1.2)), 0.28, {1.0, 0.0}, 300, {.from = 0.275, .to = 1.0}, 2});
  for (const double g : {0.3, 3.0, 12.0})
    all.push_back({"Duffing over W, g = " + std::to_string(g),
                   of(duffing_in_frequency(0.1, 1.0, g)),
                   0.9,
                   {1.0, 0.0},
                   300,
                   {.from = 0.4, .to = 3.5, .max_step = 0.05}});
  for (const double e : {0.05, 0.1, 0.2, 0.3})
    all.push_back({"clearance over W, E = " + std::to_string(e),
                   [e](double tolerance) { return clearance_flows(e, tolerance); },
                   0.3,
                   {1.1, 0.0},
                   100,
                   {.from = 0.2, .to = 2.2}});
  for (const double w : {0.17, 0.3, 0.41})
    all.push_back({"forced normal form, w = " + std::to_string(w),
                   of(forced_hopf(w)),
                   -0.1,
                   {1.0, 0.0},
                   0,
                   {.from = -0.1, .to = 0.1}});
  all.push_back({"three parts", of(alike_parts<3>()), -0.1, {1.0, 1.0, 1.0}, 0, {.from = -0.1, .to = 0.1}});
  all.back().symmetry = moved_on(3);
  all.push_back({"four parts", of(alike_parts<4>()), -0.1, {1.0, 1.0, 1.0, 1.0}, 0, {.from = -0.1, .to = 0.1}});
  all.back().symmetry = moved_on(4);
  for (const double f : {0.3, 0.6, 1.2})
    all.push_back(
        {"van der Pol over W, F = " + std::to_string(f),
         [f](double tolerance) { return problems::flows([f](double w) { return van_der_pol(0.5, f, w); }, tolerance); },
         1.0,
         {2.0, 0.0},
         200,
         {.from = 0.4, .to = 2.0}});
  for (const double f : {0.3, 0.6, 1.2})
    all.push_back(
        {"van der Pol over falling W, F = " + std::to_string(f),
         [f](double tolerance) { return problems::flows([f](double w) { return van_der_pol(0.5, f, w); }, tolerance); },
         1.0,
         {2.0, 0.0},
         200,
         {.from = 0.4, .to = 2.0},
         1,
         false});
  return all;
}

}  // namespace epicyclic::problems
