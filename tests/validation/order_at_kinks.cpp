// order_at_kinks DIR
//
// What kinks do to the order of a method, drawn: error of one forcing period in n equal steps, on a smooth problem, on
// the clearance oscillator (against its closed form), and on the gear train of inputs/tang2020.json at a periodic speed
// (against a reference orbit at 1e-13). Each error is the geometric mean over some neighbouring n, because it depends
// on where in a step the kink falls. Prints the slopes.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include <fmt/core.h>

#include "analysis/periodic_orbit.hpp"
#include "core/fit.hpp"
#include "core/largest_difference.hpp"
#include "figures/line_figure.hpp"
#include "input/study_model.hpp"
#include "integrate/make_flow.hpp"
#include "integrate/sundials/arkode_flow.hpp"
#include "problems/clearance_exact.hpp"
#include "problems/known_systems.hpp"

namespace {

using namespace epicyclic;

constexpr double two_pi = 2.0 * std::numbers::pi;
constexpr std::array<const char*, 5> names = {"arkode-heun-euler", "arkode-bogacki-shampine", "arkode-zonneveld",
                                              "arkode-dopri5", "arkode-fehlberg78"};

struct Problem {
  std::string stem, title;
  VectorField field;
  std::vector<double> start, end;
  double length = two_pi;
  std::vector<int> steps;
};

double error_of(const Problem& p, const char* method, int n) {
  integrate::IntegratorOptions o;
  o.method = method;
  o.max_steps_per_period = 100000000;
  const auto flow = integrate::make_arkode_fixed_step_flow(p.field, o, p.length / n);
  std::vector<double> y = p.start;
  if (!flow->evolve(y, 0.0, p.length).reached()) return std::nan("");
  return largest_difference(y, p.end);
}

void draw(const std::string& folder, const Problem& p) {
  std::vector<figures::FigureCurve> curves;
  fmt::print("{}\n", p.title);
  for (const char* name : names) {
    figures::FigureCurve curve{name + 7, {}, {}, false};
    std::vector<double> x;
    std::vector<double> y;
    for (const int n : p.steps) {
      double sum = 0.0;
      constexpr int neighbours = 12;
      for (int k = 0; k < neighbours; ++k) sum += std::log(error_of(p, name, n + k * std::max(1, n / 37)));
      const double error = std::exp(sum / neighbours);
      curve.x.push_back(n);
      curve.y.push_back(error);
      constexpr double above_rounding = 1e-10;  // of the reference orbit too
      constexpr double resolved = 1e-2;
      if (!(error > above_rounding && error < resolved)) continue;
      x.push_back(-std::log(n));
      y.push_back(std::log(error));
    }
    if (x.size() > 2) fmt::print("  {:26} order {:.2f} over {} step lengths\n", name, fitted_slope(x, y), x.size());
    curves.push_back(std::move(curve));
  }
  const auto outcome =
      figures::line_figure(folder, p.stem, {p.title, "Steps per forcing period", "Error after one period"}, curves,
                           {.log_x = true, .log_y = true});
  if (!outcome.drawn()) fmt::print("  not drawn: {}\n", outcome.message);
}

std::vector<int> doublings(int first, int count) {
  std::vector<int> n;
  for (int k = 0; k < count; ++k) n.push_back(first << k);
  return n;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    fmt::print(stderr, "usage: order_at_kinks DIR\n");
    return 2;
  }
  const std::string folder = argv[1];

  const double end = 1.3;
  const auto first = problems::smooth_nonlinear_solution(0.0);
  const auto last = problems::smooth_nonlinear_solution(end);
  draw(folder, {"order_smooth",
                "Smooth nonlinear problem",
                problems::smooth_nonlinear(),
                {first.begin(), first.end()},
                {last.begin(), last.end()},
                end,
                doublings(25, 8)});

  constexpr double w = 0.85;
  const auto orbit = problems::ClearanceExact(w).periods({1.1, 0.0}, 300);
  draw(folder, {"order_clearance_oscillator",
                "Clearance oscillator, Ω = 0.85, exact clearance",
                problems::clearance_oscillator(w),
                {orbit.begin(), orbit.end()},
                {orbit.begin(), orbit.end()},
                two_pi,
                doublings(50, 8)});

  const input::LoadedInput input = input::load_input(EPICYCLIC_SOURCE_DIR "/inputs/tang2020_speed.json");
  for (const auto& [width, stem, title] :
       {std::tuple(0.0, "order_gear_train", "Gear train of Tang et al. 2020, Ω = 2.8, exact clearance"),
        std::tuple(0.5, "order_gear_train_smooth",
                   "Gear train of Tang et al. 2020, Ω = 2.8, clearance smoothed by 0.5 b_c")}) {
    const model::DynamicModel model = input::smoothed_model_at(input)(2.8, width);
    integrate::IntegratorOptions o;
    o.relative_tolerance = o.absolute_tolerance = 1e-13;
    o.method = "arkode-verner65";
    o.max_steps_per_period = 1000000;
    const auto field = model;
    const auto flow = integrate::make_flow(field, o);
    std::vector<double> y = model.default_start;
    for (int k = 0; k < 300; ++k) (void)flow->evolve(y, 0.0, two_pi);
    const std::vector<double> start = y;
    (void)flow->evolve(y, 0.0, two_pi);
    draw(folder, {stem, title, field, start, y, two_pi, width > 0.0 ? doublings(20, 8) : doublings(100, 7)});
  }
  return 0;
}
