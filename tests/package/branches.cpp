// A program outside the project: where Duffing's branch of periodic motions folds and flips, x'' + 0.1 x' + x + x^3 =
// 0.3 cos W t over W, each place with its bound.
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>

#include <epicyclic/analysis/bifurcation_diagram.hpp>
#include <epicyclic/integrate/make_field.hpp>
#include <epicyclic/integrate/make_flow.hpp>

int main() {
  using namespace epicyclic;
  // In the phase s = W t, so that the period is the same for all W.
  const FieldFamily duffing = integrate::make_field_family(
      2, 2 * std::numbers::pi, [](const auto& w, std::size_t, double s, const auto* y, auto* f) {
        f[0] = y[1] / w;
        f[1] = (0.3 * std::cos(s) - 0.1 * y[1] - y[0] - y[0] * y[0] * y[0]) / w;
      });
  const auto flows = [&](double tolerance) {
    integrate::IntegratorOptions options;
    options.relative_tolerance = options.absolute_tolerance = tolerance;
    options.tangent_error_control = true;
    return integrate::make_flow_family(duffing, options);
  };
  const analysis::OrbitFamily family{flows(1e-11)};
  const auto first = analysis::first_orbit(family, 0.6, std::array{0.5, 0.0});
  if (!first.found) return 1;
  // The bounds are from a tenth of the tolerance and twice the pieces.
  analysis::BifurcationDiagram tree(family, {.continuation = {.from = 0.5, .to = 2.5},
                                             .special = {.others = {{flows(1e-12), 1}, {flows(1e-12), 2}}}});
  tree.start(first.orbit);
  while (tree.advance()) {
  }
  for (const auto& branch : tree.branches())
    for (const auto& p : branch.special)
      std::printf("%s of period %d at W = %.9f, known to %.0e\n", to_string(p.kind).c_str(), branch.family.period,
                  p.value, p.error_bound);
  return tree.branches().size() == 1 && tree.branches()[0].special.size() == 2 ? 0 : 1;
}
