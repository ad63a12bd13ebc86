// Hard points of the clearance oscillator by classify(), as a sweep asks it, beside their truth.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "analysis/regime.hpp"
#include "analysis/regime_flows.hpp"
#include "integrate/options.hpp"
#include "problems/clearance_hard_points.hpp"
#include "problems/known_systems.hpp"

namespace epicyclic::problems {

struct ToldRegime {
  analysis::Classification result;
  long work = 0;  ///< right-hand sides
};

/// By the three flows at a tolerance, from the start on.
inline ToldRegime told_regime(const ClearancePoint& p, std::span<const double> start, double tolerance) {
  integrate::IntegratorOptions o;
  o.relative_tolerance = o.absolute_tolerance = tolerance;
  o.max_steps_per_period = 1000000;
  const auto flows = analysis::make_regime_flows(clearance_oscillator(p.w, 0.0, {p.z, p.mean, p.e}), o);
  analysis::RegimeOptions options = flows.options();
  options.residual = std::max(options.residual, 3.0 * tolerance);
  std::array<double, 2> y = {start[0], start[1]};
  ToldRegime told{analysis::classify(*flows.windows, y, options, [] { return true; }), 0};
  told.work = flows.right_hand_side_calls();
  return told;
}

enum class Verdict { right, wrong, undecided };

/// Is what was told of a point its truth?
inline Verdict verdict(const HardPoint& h, const analysis::Classification& c) {
  using analysis::Regime;
  using hard_points::Draft;
  const ExactTruth& truth = h.truth;
  const bool can_be_told = truth.period <= analysis::RegimeOptions{}.longest_period;
  if (c.regime == Regime::undecided) return can_be_told ? Verdict::undecided : Verdict::right;
  if (c.regime == Regime::chaotic)
    return truth.period == 0 || (truth.sensitive && truth.may_be_chaos) ? Verdict::right : Verdict::wrong;
  if (c.regime != Regime::periodic || !c.orbit) return Verdict::wrong;
  if (c.period != truth.period && !truth.sensitive) return Verdict::wrong;
  // The orbit that was told is one of the exact solver's, attracts, and has that least period.
  const Draft exact = hard_points::draft(h.at);
  const hard_points::State y = {c.orbit->state[0], c.orbit->state[1]};
  const double near = std::max(1e-4, 10.0 * c.evidence.orbit_error);
  const auto orbit = attracting_orbit_at(exact, y, c.period, near);
  if (!orbit || orbit->period != c.period) return Verdict::wrong;
  ExactTruth told;
  told.period = orbit->period;
  told.state = orbit->state;
  return truth.sensitive || hard_points::same_attractor(h.at, told, truth) ? Verdict::right : Verdict::wrong;
}

}  // namespace epicyclic::problems
