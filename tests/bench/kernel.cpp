// The lane kernel alone, for the slopes of a step, and what the machine's adders and multipliers do at most: the share
// of the peak.
//
// Counters: operations of one right-hand side in one lane, as counted by model/counted_lanes.hpp; evaluations, lanes
// times slopes; and, of the peak, operations per second. Contraction is off in the kernels, so the peak is that of
// separate additions and multiplications, half that of fused ones.

#include <algorithm>
#include <cstddef>
#include <memory>
#include <new>
#include <string_view>
#include <vector>

#include <benchmark/benchmark.h>

#include "bench/orbit.hpp"
#include "integrate/lanes/step_loops.hpp"
#include "model/counted_lanes.hpp"
#include "model/lane_field.hpp"

namespace {

using namespace epicyclic::bench;

constexpr std::size_t alignment = 64;
struct Release {
  void operator()(double* p) const { ::operator delete[](p, std::align_val_t(alignment)); }
};
using Numbers = std::unique_ptr<double[], Release>;

void lane_kernel(benchmark::State& state) {
  const auto model = model_at(2.8);
  const State y = settled(model);
  const auto& kernels = epicyclic::integrate::step_loops();
  const auto lanes = epicyclic::model::make_lane_field(model, kernels.name);
  const auto numbers = [](std::size_t n) { return Numbers(new (std::align_val_t(alignment)) double[n]()); };
  constexpr std::size_t slopes = 6;  // of a step
  const auto s = numbers(slopes * lanes.width);
  const auto in = numbers(lanes.width * y.size());
  const auto out = numbers(lanes.width * y.size());
  for (std::size_t i = 0; i < y.size(); ++i) std::fill_n(in.get() + i * lanes.width, lanes.width, y[i]);
  for (auto _ : state) {
    lanes.set_places(slopes, s.get());
    for (std::size_t k = 0; k < slopes; ++k) {
      lanes.right_hand_side(k, in.get(), out.get());
      benchmark::DoNotOptimize(out.get());
      benchmark::ClobberMemory();
    }
    for (std::size_t w = 0; w < slopes * lanes.width; ++w) s[w] += 1e-9;
  }
  State f(y.size());
  const auto operations = epicyclic::model::operations_of_lane(model, 0, 0.3, y.data(), f.data());
  state.counters["evaluations"] = static_cast<double>(slopes * lanes.width);
  state.counters["operations"] = static_cast<double>(operations.arithmetic());
}

/// Chains of additions and of multiplications, as many as registers allow beside the two constants: enough to hide the
/// latency of 3 to 4 cycles of two units of each kind.
template <std::size_t W>
[[gnu::always_inline]] inline double chains() {
  using Pack = typename epicyclic::detail::LanePack<W>::Values;
  constexpr std::size_t count = 7;
  Pack sum[count];
  Pack product[count];
  volatile double small = 1e-9;  // or sums and products would be made at compile time
  const Pack a = small - Pack{};
  const Pack b = (1.0 - small) - Pack{};
  for (std::size_t k = 0; k < count; ++k) sum[k] = product[k] = static_cast<double>(k + 1) - Pack{};
  constexpr int rounds = 1000;
  for (int i = 0; i < rounds; ++i) {
#pragma GCC unroll 8
    for (std::size_t k = 0; k < count; ++k) {
      sum[k] += a;
      product[k] *= b;
    }
  }
  double all = 0.0;
  for (std::size_t k = 0; k < count; ++k) all += sum[k][0] + product[k][0];
  benchmark::DoNotOptimize(all);
  return static_cast<double>(2 * count * W * rounds);
}
double baseline() { return chains<2>(); }
#ifdef __x86_64__
[[gnu::target("avx2")]] double avx2() { return chains<4>(); }
[[gnu::target("avx512f,avx512dq")]] double avx512() { return chains<8>(); }
#else
double avx2() { return baseline(); }
double avx512() { return baseline(); }
#endif

/// With the registers that the kernel has.
void peak(benchmark::State& state) {
  const std::string_view set = epicyclic::integrate::step_loops().name;
  double operations = 0.0;
  for (auto _ : state) operations = set == "avx512" ? avx512() : set == "avx2" ? avx2() : baseline();
  state.counters["operations"] = operations;
}

void with_least(benchmark::internal::Benchmark* b) {
  b->ComputeStatistics("least", [](const std::vector<double>& v) { return *std::min_element(v.begin(), v.end()); });
}
BENCHMARK(lane_kernel)->Apply(with_least);
BENCHMARK(peak)->Apply(with_least);

}  // namespace
