// The right-hand side of the paper's stage with tables of lubricated contact, at phases all over the mesh period: what
// tables cost, beside those of a constant coefficient.

#include <algorithm>
#include <cstddef>
#include <memory>
#include <new>
#include <utility>
#include <vector>

#include <benchmark/benchmark.h>

#include "bench/orbit.hpp"
#include "gear/gear_set.hpp"
#include "integrate/lanes/step_loops.hpp"
#include "model/lane_field.hpp"
#include "problems/table1.hpp"

namespace {

using namespace epicyclic::bench;
namespace gear = epicyclic::gear;

epicyclic::model::DynamicModel model_of(bool lubricated, double omega = 1.2) {
  gear::Stage stage = epicyclic::problems::tang2020();
  if (lubricated) {
    const gear::GearSet set = gear::make_gear_set(epicyclic::problems::table1());
    for (const auto& [mesh, pair] :
         {std::pair(&stage.sun_planet_mesh, &set.sun_planet), std::pair(&stage.ring_planet_mesh, &set.ring_planet)}) {
      mesh->friction = {};
      mesh->friction.ehl = gear::ehl_of(*pair, gear::Lubrication{5, 0.6});
    }
  }
  return epicyclic::model::make_dynamic_model(stage, epicyclic::model::scales_of(stage), omega, {});
}

struct PhaseInSegment {
  double s;
  std::size_t segment;
};

/// In the order of an integration.
std::vector<PhaseInSegment> phases_of(const epicyclic::model::DynamicModel& model) {
  std::vector<PhaseInSegment> phases;
  constexpr int count = 600;
  for (int k = 0; k < count; ++k) {
    const double s = period * k / count;
    phases.push_back({s, epicyclic::model::segment_at(model.breakpoints, s)});
  }
  return phases;
}

void right_hand_side_over_period(benchmark::State& state) {
  const auto model = model_of(state.range(0) != 0);
  const State y = model.default_start;
  State f(y.size());
  const std::vector<PhaseInSegment> phases = phases_of(model);
  for (auto _ : state)
    for (const PhaseInSegment& at : phases) {
      model.right_hand_side(at.segment, at.s, y.data(), f.data());
      benchmark::DoNotOptimize(f.data());
    }
  state.counters["evaluations"] = static_cast<double>(phases.size());
}
BENCHMARK(right_hand_side_over_period)->ArgName("lubricated")->Arg(1)->Arg(0);

void lane_kernel_over_period(benchmark::State& state) {
  constexpr std::size_t alignment = 64;
  struct Release {
    void operator()(double* p) const { ::operator delete[](p, std::align_val_t(alignment)); }
  };
  const auto model = model_of(state.range(0) != 0);
  const auto lanes = epicyclic::model::make_lane_field(model, epicyclic::integrate::step_loops().name);
  // Each lane at an operating point of its own, as in a sweep: with tables of its own.
  std::vector<epicyclic::model::DynamicModel> models;
  for (std::size_t w = 0; w < lanes.width; ++w) {
    models.push_back(model_of(state.range(0) != 0, 1.2 + 0.005 * static_cast<double>(w)));
    lanes.load(w, models.back());
  }
  const auto numbers = [](std::size_t n) {
    return std::unique_ptr<double[], Release>(new (std::align_val_t(alignment)) double[n]());
  };
  const State& y = model.default_start;
  const auto s = numbers(lanes.width);
  const auto in = numbers(lanes.width * y.size());
  const auto out = numbers(lanes.width * y.size());
  for (std::size_t i = 0; i < y.size(); ++i) std::fill_n(in.get() + i * lanes.width, lanes.width, y[i]);
  const std::vector<PhaseInSegment> phases = phases_of(model);
  for (auto _ : state) {
    std::size_t segment = model.breakpoints.size();
    for (const PhaseInSegment& at : phases) {
      for (std::size_t w = 0; w < lanes.width; ++w) {
        s[w] = at.s;
        if (at.segment != segment) lanes.set_segment(w, at.segment);
      }
      segment = at.segment;
      lanes.set_places(1, s.get());
      lanes.right_hand_side(0, in.get(), out.get());
      benchmark::DoNotOptimize(out.get());
    }
  }
  state.counters["evaluations"] = static_cast<double>(lanes.width * phases.size());
}
BENCHMARK(lane_kernel_over_period)->ArgName("lubricated")->Arg(1)->Arg(0);

}  // namespace
