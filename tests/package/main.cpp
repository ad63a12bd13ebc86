// A program outside the project, built against the installed package: the library's Poincare section of its own system.
#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

#include <epicyclic/analysis/poincare.hpp>
#include <epicyclic/integrate/sundials/arkode_flow.hpp>

int main() {
  epicyclic::VectorField duffing{
      .dimension = 2, .period = 2 * std::numbers::pi, .breakpoints = {}, .right_hand_side = {}, .surfaces = {}};
  duffing.right_hand_side = [](std::size_t, double t, const double* y, double* f) {
    f[0] = y[1];
    f[1] = -0.25 * y[1] + y[0] - y[0] * y[0] * y[0] + 0.2 * std::cos(t);
  };
  const auto flow = epicyclic::integrate::make_arkode_flow(duffing, {});
  std::vector<double> state = {1, 0};
  const auto s = epicyclic::analysis::strobe(
      *flow, state, {}, [](auto&&...) {}, [] { return true; });
  std::printf("period %d\n", epicyclic::analysis::recurrence(s.section, 8, 1e-6).period);
  return s.evolution.reached() ? 0 : 1;
}
