// Cost of the right-hand side and of a mesh period, with Boost.odeint's dopri5 on the same right-hand side as a peer.
//
// Both integrators advance the paper's stage by mesh periods from the same settled state at the same tolerances;
// compare the ratio of their times in one run, not the times. Arguments of a benchmark: Omega x 100, -log10 of the
// tolerance. Counters: right-hand sides per mesh period. A period is stepped onto by both.

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <arkode/arkode_erkstep.h>
#include <benchmark/benchmark.h>
#include <boost/numeric/odeint.hpp>
#include <nvector/nvector_serial.h>

#include "integrate/arkode_flow.hpp"
#include "io/study_model.hpp"
#include "studies/operating_point.hpp"

namespace {

using State = std::vector<double>;
constexpr double period = 2.0 * std::numbers::pi;

const epicyclic::io::LoadedInput& paper() {
  static const auto input = epicyclic::io::load_input(EPICYCLIC_SOURCE_DIR "/inputs/tang2020_speed.json");
  return input;
}

epicyclic::model::DynamicModel model_at(double omega, bool friction = true) {
  epicyclic::gear::Stage stage = paper().study.stage;
  for (auto* mesh : {&stage.sun_planet_mesh, &stage.ring_planet_mesh}) {
    if (friction) break;
    mesh->friction = {};
  }
  return epicyclic::model::make_dynamic_model(stage, epicyclic::model::scales_of(paper().study.stage), omega, {});
}

epicyclic::integrate::IntegratorOptions options(double tolerance) {
  epicyclic::integrate::IntegratorOptions o;
  o.relative_tolerance = tolerance;
  o.absolute_tolerance = 1e-2 * tolerance;
  return o;
}

State settled(const epicyclic::model::DynamicModel& model) {
  const auto flow = epicyclic::integrate::make_arkode_flow(epicyclic::studies::vector_field(model), options(1e-8));
  State y = model.default_start;
  for (int k = 0; k < 100; ++k) flow->evolve(y, 0.0, period);
  return y;
}

void right_hand_side(benchmark::State& state) {
  const auto model = model_at(1.2, state.range(0) != 0);
  const State y = settled(model);
  State f(y.size());
  double s = 0.0;
  for (auto _ : state) {
    model.right_hand_side(0, s, y.data(), f.data());
    benchmark::DoNotOptimize(f.data());
    s += 1e-9;
  }
}
BENCHMARK(right_hand_side)->ArgName("friction")->Arg(1)->Arg(0);

void mesh_period_arkode(benchmark::State& state) {
  const auto model = model_at(static_cast<double>(state.range(0)) / 100.0);
  const State start = settled(model);
  const auto flow = epicyclic::integrate::make_arkode_flow(
      epicyclic::studies::vector_field(model), options(std::pow(10.0, -static_cast<double>(state.range(1)))));
  State y = start;
  for (auto _ : state) flow->evolve(y, 0.0, period);
  state.counters["rhs_per_period"] =
      benchmark::Counter(static_cast<double>(flow->right_hand_side_calls()), benchmark::Counter::kAvgIterations);
}

/// ARKODE as its manual has it: the serial vector as it comes (fused operations off), scalar tolerances, called once
/// for each smooth piece.
class StockArkode {
 public:
  StockArkode(const epicyclic::model::DynamicModel& model, double tolerance, const State& start)
      : model_(model), field_(epicyclic::studies::vector_field(model)) {
    SUNContext_Create(nullptr, &context_);
    y_ = N_VNew_Serial(static_cast<sunindextype>(start.size()), context_);
    std::copy(start.begin(), start.end(), N_VGetArrayPointer(y_));
    memory_ = ERKStepCreate(&StockArkode::right_hand_side, 0.0, y_, context_);
    ERKStepSetUserData(memory_, this);
    ERKStepSetTableNum(memory_, ARKODE_DORMAND_PRINCE_7_4_5);
    ERKStepSStolerances(memory_, options(tolerance).relative_tolerance, options(tolerance).absolute_tolerance);
    ERKStepSetMaxNumSteps(memory_, -1);
    constexpr int i_controller = 2;
    ERKStepSetAdaptivityMethod(memory_, i_controller, 1, 0, nullptr);
  }
  StockArkode(const StockArkode&) = delete;
  StockArkode& operator=(const StockArkode&) = delete;
  ~StockArkode() {
    ERKStepFree(&memory_);
    N_VDestroy(y_);
    SUNContext_Free(&context_);
  }

  void mesh_period() {
    std::vector<double> stops = epicyclic::integrate::breakpoints_between(field_, 0.0, period);
    stops.push_back(period);
    double s = 0.0;
    for (const double stop : stops) {
      segment_ = epicyclic::integrate::segment_after(field_, s);
      ERKStepReInit(memory_, &StockArkode::right_hand_side, s, y_);
      ERKStepSetInitStep(memory_, step_);
      ERKStepSetStopTime(memory_, stop);
      double reached = s;
      ERKStepEvolve(memory_, stop, y_, &reached, ARK_NORMAL);
      double proposed = 0.0;
      ERKStepGetCurrentStep(memory_, &proposed);
      step_ = std::max(step_, proposed);
      s = stop;
    }
  }
  [[nodiscard]] double calls() const { return calls_; }

 private:
  static int right_hand_side(realtype s, N_Vector y, N_Vector f, void* user) {
    auto* self = static_cast<StockArkode*>(user);
    self->model_.right_hand_side(self->segment_, s, N_VGetArrayPointer(y), N_VGetArrayPointer(f));
    self->calls_ += 1.0;
    return 0;
  }

  const epicyclic::model::DynamicModel& model_;
  epicyclic::integrate::VectorField field_;
  SUNContext context_ = nullptr;
  N_Vector y_ = nullptr;
  void* memory_ = nullptr;
  std::size_t segment_ = 0;
  double step_ = 0.0;
  double calls_ = 0.0;
};

void mesh_period_arkode_stock(benchmark::State& state) {
  const auto model = model_at(static_cast<double>(state.range(0)) / 100.0);
  StockArkode stock(model, std::pow(10.0, -static_cast<double>(state.range(1))), settled(model));
  for (auto _ : state) stock.mesh_period();
  state.counters["rhs_per_period"] = benchmark::Counter(stock.calls(), benchmark::Counter::kAvgIterations);
}

void mesh_period_odeint(benchmark::State& state) {
  namespace odeint = boost::numeric::odeint;
  const auto model = model_at(static_cast<double>(state.range(0)) / 100.0);
  const auto o = options(std::pow(10.0, -static_cast<double>(state.range(1))));
  const auto field = epicyclic::studies::vector_field(model);
  State y = settled(model);
  double calls = 0.0;
  double step = 1e-2;
  for (auto _ : state) {
    std::vector<double> stops = epicyclic::integrate::breakpoints_between(field, 0.0, period);
    stops.push_back(period);
    double s = 0.0;
    for (const double stop : stops) {
      const std::size_t segment = epicyclic::integrate::segment_after(field, s);
      const auto rhs = [&](const State& x, State& f, double t) {
        model.right_hand_side(segment, t, x.data(), f.data());
        calls += 1.0;
      };
      auto stepper =
          odeint::make_controlled(o.absolute_tolerance, o.relative_tolerance, odeint::runge_kutta_dopri5<State>());
      while (s < stop) {
        double h = std::min(step, stop - s);
        const bool cut = h < step;
        if (stepper.try_step(rhs, y, s, h) == odeint::success) {
          if (cut && stop - s < 1e-12) s = stop;
          step = cut ? std::max(step, h) : h;
        } else {
          step = h;
        }
      }
    }
  }
  state.counters["rhs_per_period"] = benchmark::Counter(calls, benchmark::Counter::kAvgIterations);
}

void speeds_and_tolerances(benchmark::internal::Benchmark* b) {
  b->ArgNames({"omega_percent", "digits"});
  for (const int omega : {280, 120})  // periodic and not
    for (const int digits : {7, 9}) b->Args({omega, digits});
  b->Unit(benchmark::kMicrosecond);
}
BENCHMARK(mesh_period_arkode)->Apply(speeds_and_tolerances);
BENCHMARK(mesh_period_arkode_stock)->Apply(speeds_and_tolerances);
BENCHMARK(mesh_period_odeint)->Apply(speeds_and_tolerances);

}  // namespace
