// Branches of periodic orbits beside AUTO-07p: N oscillators in a row over smooth clearances.
//
//   branches_beside_auto N [TOLERANCE [FROM TO [START [FINER]]]]  its special points, found again by the tolerance
//   FINER
//                                                                 if that is told, and processor seconds per orbit of
//                                                                 the branch, from the orbit at W = START on
//   branches_beside_auto N --orbit [START]                        that orbit over a period, for AUTO to start from
//
// tests/bench/auto07p/compare runs both.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <numbers>
#include <string>
#include <vector>

#include "analysis/bifurcation_diagram.hpp"
#include "problems/branches.hpp"

namespace {

using namespace epicyclic;

/// x_i'' + 0.1 x_i' + f(x_i) + k (coupling) = 0.1 + E (1 + 0.1 (i - 1) / N) W^2 sin s in s = W t; its parameter is W.
FieldFamily chain(std::size_t n) {
  return integrate::make_field_family(
      2 * n, 2.0 * std::numbers::pi, [n](const auto& w, std::size_t, double s, const auto* y, auto* d) {
        using std::sqrt;
        using T = std::remove_cvref_t<decltype(d[0])>;
        constexpr double width = 0.05;
        constexpr double k = 0.5;
        for (std::size_t i = 0; i < n; ++i) {
          const T& x = y[i];
          const T below = x - 1.0;
          const T above = x + 1.0;
          T force = x + 0.5 * (sqrt(below * below + width * width) - sqrt(above * above + width * width));
          if (i > 0) force = force + k * (x - y[i - 1]);
          if (i + 1 < n) force = force + k * (x - y[i + 1]);
          const double e = 0.1 * (1.0 + 0.1 * static_cast<double>(i) / static_cast<double>(n));
          d[i] = y[n + i] / w;
          d[n + i] = (0.1 + e * w * w * std::sin(s) - 0.1 * y[n + i] - force) / w;
        }
      });
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) return 2;
  const auto n = static_cast<std::size_t>(std::atoi(argv[1]));
  const FieldFamily fields = chain(n);
  const bool orbit_alone = argc > 2 && std::string(argv[2]) == "--orbit";
  const int start_at = orbit_alone ? 3 : 5;
  const double start = argc > start_at ? std::atof(argv[start_at]) : 0.3;
  std::vector<double> state(2 * n, 0.0);
  for (std::size_t i = 0; i < n; ++i) state[i] = 1.1;
  state = problems::settled(problems::flows(fields, 1e-10), start, state, 300);
  if (orbit_alone) {
    const auto flow = problems::flows(fields, 1e-12)(start);
    constexpr int outputs_at = 400;
    const double period = 2.0 * std::numbers::pi;
    for (int k = 0; k <= outputs_at; ++k) {
      std::printf("%.15g", period * k / outputs_at / start);
      for (const double x : state) std::printf(" %.15g", x);
      std::printf(" %.15g %.15g\n", std::sin(period * k / outputs_at), std::cos(period * k / outputs_at));
      if (k < outputs_at && !flow->evolve(state, period * k / outputs_at, period * (k + 1) / outputs_at).reached())
        return 1;
    }
    return 0;
  }
  const double tolerance = argc > 2 ? std::atof(argv[2]) : 1e-9;
  analysis::OrbitFamily family{problems::flows(fields, tolerance)};
  family.residual = 10.0 * tolerance;
  const auto first = analysis::first_orbit(family, start, state);
  if (!first.found) return 1;
  analysis::ContinuationOptions options{.from = 0.2, .to = 2.2};
  if (argc > 4) options.from = std::atof(argv[3]);
  if (argc > 4) options.to = std::atof(argv[4]);
  analysis::SpecialOptions special;
  if (argc > 6) special.others = {{problems::flows(fields, std::atof(argv[6])), 1}};
  // The machine may be busy: time of the processor, not of the clock.
  const std::clock_t begun = std::clock();
  analysis::Continuation branch(family, options, first.orbit);
  std::size_t orbits = 0;
  while (branch.advance()) {
    ++orbits;
    for (const auto& p : special_points_between(family, branch.previous(), branch.current(), special))
      std::printf("%s %.10f\n", to_string(p.kind).c_str(), p.value);
  }
  const double took = static_cast<double>(std::clock() - begun) / CLOCKS_PER_SEC;
  std::printf("%zu orbits to %.4f (end %d), %.4g s per orbit, %d evaluations\n", orbits, branch.current().at.value,
              static_cast<int>(branch.end()), took / static_cast<double>(orbits), branch.state().evaluations);
  return 0;
}
