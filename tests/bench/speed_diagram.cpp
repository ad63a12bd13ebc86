// The paper's speed diagram, 661 speeds in both directions, each carried from the one before, at a tolerance of 1e-7:
// 300 + 128 mesh periods a point. Boost.odeint's dopri5 advances the states and does nothing else; ours record the last
// periods, at 64 phases each, and tell regimes by recurrence, or by evidence where it says classified. One thread.
// Minutes; asked for by name:
//   bench --benchmark_filter=speed_diagram
// EPICYCLIC_INPUT names a sweep over the speed whose stage is taken instead of the paper's default one.

#include <cstdlib>
#include <utility>

#include <benchmark/benchmark.h>

#include "bench/odeint.hpp"
#include "bench/orbit.hpp"
#include "input/study_model.hpp"
#include "studies/sweep.hpp"

namespace {

using namespace epicyclic::bench;
using epicyclic::studies::Direction;

constexpr double tolerance = 1e-7;

epicyclic::studies::SweepOptions diagram(bool classified = false) {
  epicyclic::studies::SweepOptions sweep;
  sweep.directions = {Direction::up, Direction::down};
  if (!classified) sweep.recording = epicyclic::studies::by_recurrence_alone(sweep.recording);
  return sweep;
}

/// The stage at each speed.
epicyclic::studies::ModelAt models() {
  const char* const path = std::getenv("EPICYCLIC_INPUT");
  if (path == nullptr) return [](double omega) { return model_at(omega); };
  static const auto input = epicyclic::input::load_input(path);
  return epicyclic::input::model_at(input);
}

void by_odeint(benchmark::State& state) {
  const auto sweep = diagram();
  const auto at = models();
  double calls = 0.0;
  for (auto _ : state) {
    for (const Direction direction : sweep.directions) {
      State y;
      for (const auto& point : plan_sweep(sweep).points) {
        if (point.direction != direction) continue;
        const auto model = at(point.value);
        if (y.empty()) y = model.default_start;
        Odeint odeint(model, tolerance, std::move(y));
        for (int k = 0; k < sweep.recording.transient_periods + sweep.recording.recorded_periods; ++k)
          odeint.mesh_period();
        y = odeint.state();
        calls += odeint.calls();
      }
    }
  }
  state.counters["rhs"] = calls;
}

void by_us(benchmark::State& state, const char* method, int segments, bool classified) {
  auto sweep = diagram(classified);
  sweep.segments = segments;
  const auto at = models();
  double calls = 0.0;
  for (auto _ : state) {
    const auto points =
        epicyclic::studies::run_sweep_in_memory(plan_sweep(sweep), sweep.recording, options(tolerance, method), at, {});
    for (const auto& point : points) calls += static_cast<double>(point.rhs_evaluations);
  }
  state.counters["rhs"] = calls;
}

void once(benchmark::internal::Benchmark* b) { b->Iterations(1)->Unit(benchmark::kSecond); }
BENCHMARK(by_odeint)->Name("speed_diagram/odeint-dopri5")->Apply(once);
constexpr int automatic = 0;
BENCHMARK_CAPTURE(by_us, cash_karp, "lanes-cash-karp", automatic, false)
    ->Name("speed_diagram/lanes-cash-karp")
    ->Apply(once);
BENCHMARK_CAPTURE(by_us, cash_karp_classified, "lanes-cash-karp", automatic, true)
    ->Name("speed_diagram/lanes-cash-karp/classified")
    ->Apply(once);
BENCHMARK_CAPTURE(by_us, dopri5, "lanes-dopri5", automatic, false)->Name("speed_diagram/lanes-dopri5")->Apply(once);
BENCHMARK_CAPTURE(by_us, arkode_dopri5, "arkode-dopri5", 1, false)->Name("speed_diagram/arkode-dopri5")->Apply(once);

}  // namespace
