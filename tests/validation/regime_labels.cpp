// regime_labels
//
// How often does analysis/regime.hpp tell a regime wrongly? Operating points whose regime is known by theory, or by a
// computation that shares nothing with the classification but the equations: 3000 periods by CVODE's Adams method at
// 1e-11, recurrence over the last 256, and the growth of a finite distance. Prints the confusion matrix and each point
// that is wrong or undecided; exit code 1 if more than 1 % are wrong or more than 3 % undecided.

#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include "analysis/regime.hpp"
#include "core/largest_difference.hpp"
#include "input/study_model.hpp"
#include "integrate/make_field.hpp"
#include "integrate/make_flow.hpp"
#include "problems/known_systems.hpp"

namespace {

using namespace epicyclic;
using analysis::Regime;

struct Case {
  std::string system;
  double parameter = 0;
  VectorField field;
  std::vector<double> start;
  std::string label;  ///< a regime, or "escape"
};

integrate::IntegratorOptions with(const char* method, double tolerance) {
  integrate::IntegratorOptions o;
  o.method = method;
  o.relative_tolerance = o.absolute_tolerance = tolerance;
  o.max_steps_per_period = 1000000;
  return o;
}

/// The label of a dissipative forced system by brute force: what recurs is periodic; what does not is chaotic if two
/// motions a hair apart part exponentially, ten times in a row.
std::string by_brute_force(const VectorField& field, std::vector<double> y) {
  const auto flow = integrate::make_flow(field, with("cvode-adams", 1e-11));
  const auto carry = [&](std::vector<double>& state, int periods) {
    for (int k = 0; k < periods; ++k) {
      if (!flow->evolve(state, 0.0, field.period).reached()) return false;
    }
    return true;
  };
  if (!carry(y, 3000)) return "escape";
  analysis::PoincareSection section;
  section.dimension = y.size();
  for (int k = 0; k < 256; ++k) {
    if (!carry(y, 1)) return "escape";
    section.states.insert(section.states.end(), y.begin(), y.end());
  }
  if (analysis::recurrence(section, 64, 1e-6).period > 0) return "periodic";
  int parted = 0;
  constexpr int trials = 10;
  for (int k = 0; k < trials; ++k) {
    std::vector<double> other = y;
    constexpr double hair = 1e-7;
    other[0] += hair;
    constexpr int periods = 240;  // an exponent of 0.012 parts them by e^15
    if (!carry(y, periods) || !carry(other, periods)) return "escape";
    parted += largest_difference(y, other) > 1e3 * hair ? 1 : 0;
  }
  return parted > trials / 2 ? "chaotic" : "quasiperiodic";
}

std::vector<double> grid(double from, double to, int count) {
  std::vector<double> values;
  for (int k = 0; k < count; ++k) values.push_back(from + (to - from) * k / (count - 1));
  return values;
}

std::vector<Case> cases() {
  std::vector<Case> all;
  // Duffing's two wells, from period 1 through the cascade to chaos and its windows: by brute force.
  for (const double g : grid(0.15, 0.70, 80)) {
    const auto field = problems::duffing(0.3, -1.0, g, 1.2);
    all.push_back({"duffing", g, field, {1.0, 0.0}, by_brute_force(field, {1.0, 0.0})});
  }
  // Period 1 over this range (docs/theory/published_results.md, section 4).
  for (const double w : grid(0.2, 2.2, 60))
    all.push_back({"clearance", w, problems::clearance_oscillator(w), {1.1, 0.0}, "periodic"});
  // Mathieu, q = 1, undamped: bounded and never repeating between its characteristic values, else growing.
  constexpr std::array<double, 5> characteristic = {-0.45513860, -0.11024882, 1.85910807, 3.91702477, 4.37130098};
  for (const double a : grid(-0.7, 5.0, 60)) {
    const auto field = integrate::make_field(2, std::numbers::pi, [a](std::size_t, double s, const auto* y, auto* d) {
      d[0] = y[1];
      d[1] = (2.0 * std::cos(2.0 * s) - a) * y[0];
    });
    const bool stable = (a > characteristic[0] && a < characteristic[1]) ||
                        (a > characteristic[2] && a < characteristic[3]) || a > characteristic[4];
    all.push_back({"mathieu", a, field, {1.0, 0.0}, stable ? "quasiperiodic" : "escape"});
  }
  // Van der Pol forced weakly and away from its own frequency: tori; forced hard near it: locked.
  for (const double w : grid(1.45, 1.95, 25))
    all.push_back({"van_der_pol_weak", w, problems::van_der_pol(0.3, 0.3, w), {1.0, 0.0}, "quasiperiodic"});
  for (const double w : grid(0.8, 1.2, 25))
    all.push_back({"van_der_pol_hard", w, problems::van_der_pol(0.3, 3.0, w), {1.0, 0.0}, "periodic"});
  // Lorenz in r, seen once per unit of time: fixed points below the homoclinic orbit at 13.926, chaos above 24.74.
  for (const double r : grid(2.0, 13.0, 20)) {
    VectorField field = problems::lorenz(r);
    field.period = 1.0;
    all.push_back({"lorenz_rest", r, field, {1.0, 1.0, 5.0}, "periodic"});
  }
  for (const double r : grid(26.0, 45.0, 20)) {
    VectorField field = problems::lorenz(r);
    field.period = 1.0;
    all.push_back({"lorenz_chaos", r, field, {1.0, 1.0, 20.0}, "chaotic"});
  }
  // The linear gear train: one harmonic.
  static const auto input = input::load_input(EPICYCLIC_SOURCE_DIR "/validation/r1_linear_response/input.json");
  static const auto model_at = input::smoothed_model_at(input);
  for (const double omega : grid(0.4, 3.0, 40)) {
    const model::DynamicModel m = model_at(omega, 0.0);
    all.push_back({"linear_gear_train", omega, m, m.default_start, "periodic"});
  }
  return all;
}

}  // namespace

int main() {
  const std::array<std::string, 4> labels = {"periodic", "quasiperiodic", "chaotic", "escape"};
  const std::array<std::string, 5> answers = {"periodic", "quasiperiodic", "chaotic", "undecided", "escape"};
  std::map<std::pair<std::string, std::string>, int> count;
  int wrong = 0;
  int undecided = 0;
  int total = 0;
  for (const Case& c : cases()) {
    const auto flow = integrate::make_flow(c.field, with("arkode-dopri5", 1e-9));
    std::vector<double> y = c.start;
    // As a sweep does it: orbits by flows that control tangents, at the tolerance and at ten times it.
    integrate::IntegratorOptions controlled = with("arkode-dopri5", 1e-9);
    controlled.tangent_error_control = true;
    const auto exact = integrate::make_flow(c.field, controlled);
    controlled.relative_tolerance *= 10.0;
    controlled.absolute_tolerance *= 10.0;
    const auto coarser = integrate::make_flow(c.field, controlled);
    analysis::RegimeOptions options;
    options.exact = exact.get();
    options.coarser = coarser.get();
    options.residual = 3e-9;
    const analysis::Classification r = analysis::classify(*flow, y, options, [] { return true; });
    const std::string answer = r.evolution.reached() ? analysis::to_string(r.regime) : "escape";
    ++count[{c.label, answer}];
    ++total;
    if (answer == c.label) continue;
    (answer == "undecided" ? undecided : wrong) += 1;
    fmt::print("{} {:.6f}: {} told {} (period {}, exponent {:.2g} +- {:.2g}, growth {:.2g}, K {:.3f}: {})\n", c.system,
               c.parameter, c.label, answer, r.period, r.evidence.exponent.value, r.evidence.exponent.half_width,
               r.evidence.late_growth, r.evidence.zero_one.value_or(std::nan("")), r.evidence.note);
  }
  fmt::print("\n| known \\ told |");
  for (const std::string& a : answers) fmt::print(" {} |", a);
  fmt::print("\n|---|---|---|---|---|---|\n");
  for (const std::string& label : labels) {
    fmt::print("| {} |", label);
    for (const std::string& a : answers) fmt::print(" {} |", count[{label, a}]);
    fmt::print("\n");
  }
  fmt::print("\n{} points, {} wrong ({:.1f} %), {} undecided ({:.1f} %)\n", total, wrong, 100.0 * wrong / total,
             undecided, 100.0 * undecided / total);
  return 100 * wrong <= total && 100 * undecided <= 3 * total ? 0 : 1;
}
