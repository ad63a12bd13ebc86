// Cost of the right-hand side and of a mesh period, with Boost.odeint's dopri5 on the same right-hand side as a peer.
//
// Both integrators advance the paper's stage by mesh periods from the same settled state at the same tolerances;
// compare the ratio of their times in one run, not the times. Arguments of a benchmark: Omega x 100, -log10 of the
// tolerance. Counters: right-hand sides per mesh period. A period is stepped onto by both.
//
// Equal tolerances are not equal errors: the norms and the controllers differ. mesh_period_at_equal_error finds for
// each integrator the tolerance that gives one global error after 20 periods of a periodic orbit (found by Newton's
// method), against a reference at 1e-13, and times that; second argument: -log10 of the error.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <numeric>
#include <utility>
#include <vector>

#include <arkode/arkode_erkstep.h>
#include <benchmark/benchmark.h>
#include <nvector/nvector_serial.h>

#include "bench/odeint.hpp"
#include "bench/orbit.hpp"
#include "core/fit.hpp"
#include "integrate/lanes/lane_ensemble.hpp"
#include "integrate/lanes/lane_pool.hpp"
#include "integrate/make_flow.hpp"
#include "studies/stage_lanes.hpp"

namespace {

using namespace epicyclic::bench;

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
  const auto flow =
      epicyclic::integrate::make_flow(model, options(std::pow(10.0, -static_cast<double>(state.range(1)))));
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
      : model_(model), field_(model) {
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
  [[nodiscard]] State state() const {
    const double* y = N_VGetArrayPointer(y_);
    return {y, y + N_VGetLength(y_)};
  }

 private:
  static int right_hand_side(realtype s, N_Vector y, N_Vector f, void* user) {
    auto* self = static_cast<StockArkode*>(user);
    self->model_.right_hand_side(self->segment_, s, N_VGetArrayPointer(y), N_VGetArrayPointer(f));
    self->calls_ += 1.0;
    return 0;
  }

  const epicyclic::model::DynamicModel& model_;
  epicyclic::VectorField field_;
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
  const auto model = model_at(static_cast<double>(state.range(0)) / 100.0);
  Odeint odeint(model, std::pow(10.0, -static_cast<double>(state.range(1))), settled(model));
  for (auto _ : state) odeint.mesh_period();
  state.counters["rhs_per_period"] = benchmark::Counter(odeint.calls(), benchmark::Counter::kAvgIterations);
}

/// A flow of this project with the interface of its peers.
class Ours {
 public:
  Ours(const epicyclic::model::DynamicModel& model, double tolerance, State start, const char* method)
      : flow_(epicyclic::integrate::make_flow(model, options(tolerance, method))), y_(std::move(start)) {}

  void mesh_period() { flow_->evolve(y_, 0.0, period); }
  [[nodiscard]] double calls() const { return static_cast<double>(flow_->right_hand_side_calls()); }
  [[nodiscard]] State state() const { return y_; }

 private:
  std::unique_ptr<epicyclic::integrate::Flow> flow_;
  State y_;
};

template <const auto& method>
class OursBy : public Ours {
 public:
  OursBy(const epicyclic::model::DynamicModel& model, double tolerance, State start)
      : Ours(model, tolerance, std::move(start), method) {}
};
constexpr char dopri5[] = "arkode-dopri5";
constexpr char cash_karp[] = "arkode-cash-karp";
constexpr char adams[] = "cvode-adams";
using OurArkode = OursBy<dopri5>;
using OurCashKarp = OursBy<cash_karp>;
using Adams = OursBy<adams>;

constexpr char lanes_dopri5[] = "lanes-dopri5";
constexpr char lanes_cash_karp[] = "lanes-cash-karp";

/// One lane of the lane ensemble, the others idle.
template <const auto& method>
class OneLane {
 public:
  OneLane(const epicyclic::model::DynamicModel& model, double tolerance, const State& start)
      : field_(model),
        lanes_(epicyclic::studies::stage_lanes(model, epicyclic::integrate::step_loops()), options(tolerance, method)),
        y_(start) {
    lanes_.load(0, field_);
  }
  void mesh_period() {
    lanes_.begin(0, y_, 0.0, period);
    lanes_.run();
    lanes_.copy_state(0, y_);
  }
  [[nodiscard]] State state() const { return y_; }

 private:
  epicyclic::VectorField field_;
  epicyclic::integrate::LaneEnsemble lanes_;
  State y_;
};

/// All lanes at work, at neighbouring speeds, as in a sweep: a mesh period is one of any lane.
template <const auto& method>
class AllLanes {
 public:
  AllLanes(const epicyclic::model::DynamicModel& model, double tolerance, const State& start,
           const epicyclic::integrate::StepLoops& kernels = epicyclic::integrate::step_loops())
      : lanes_(epicyclic::studies::stage_lanes(model, kernels), options(tolerance, method), kernels), y_(start) {
    constexpr double apart = 0.002;
    for (std::size_t lane = 0; lane < lanes_.width(); ++lane) {
      models_.push_back(
          std::make_unique<epicyclic::model::DynamicModel>(model_at(model.omega + apart * static_cast<double>(lane))));
      fields_.push_back(std::make_unique<epicyclic::VectorField>(*models_.back()));
      lanes_.load(lane, *fields_.back());
      lanes_.begin(lane, start, 0.0, period);
    }
    constexpr int out_of_step = 40;  // periods after which lanes are wherever they are
    for (int k = 0; k < out_of_step; ++k) mesh_period();
    before_ = all_calls();
  }
  void mesh_period() {
    const std::size_t lane = lanes_.run();
    lanes_.copy_state(lane, y_);
    lanes_.begin(lane, y_, 0.0, period);
  }
  [[nodiscard]] double calls() const { return static_cast<double>(all_calls() - before_); }

 private:
  [[nodiscard]] long all_calls() const {
    long sum = 0;
    for (std::size_t lane = 0; lane < lanes_.width(); ++lane) sum += lanes_.work(lane).right_hand_sides;
    return sum;
  }

  std::vector<std::unique_ptr<epicyclic::model::DynamicModel>> models_;
  std::vector<std::unique_ptr<epicyclic::VectorField>> fields_;
  epicyclic::integrate::LaneEnsemble lanes_;
  State y_;
  long before_ = 0;
};

using LanesDopri5 = AllLanes<lanes_dopri5>;
using LanesCashKarp = AllLanes<lanes_cash_karp>;

/// Largest difference of a component, relative to the largest component, after `orbit_periods` from one state.
template <class Integrator>
double global_error(const epicyclic::model::DynamicModel& model, double tolerance, const State& start,
                    const State& reference) {
  Integrator integrator(model, tolerance, start);
  for (int k = 0; k < orbit_periods; ++k) integrator.mesh_period();
  const State y = integrator.state();
  double difference = 0.0;
  double largest = 0.0;
  for (std::size_t i = 0; i < y.size(); ++i) {
    difference = std::max(difference, std::abs(y[i] - reference[i]));
    largest = std::max(largest, std::abs(reference[i]));
  }
  return difference / largest;
}

/// A periodic orbit's state, empty without one, and where it leads: the same for all integrators and repetitions.
struct Motion {
  explicit Motion(double omega) : model(model_at(omega)), start(on_orbit(model)) {
    if (!start.empty()) reference = reference_from(model, start);
  }
  epicyclic::model::DynamicModel model;
  State start, reference;
};
const Motion& motion_at(int omega_percent) {
  static std::map<int, Motion> motions;
  return motions.try_emplace(omega_percent, static_cast<double>(omega_percent) / 100.0).first->second;
}

/// The tolerance that gives a global error of 10^-digits; 0 if there is none. The error grows with the tolerance but
/// not smoothly (steps come and go): the tolerance is read from the straight line through the errors of all
/// tolerances, in twentieths of a decade, whose error is within a factor of 10 of the wanted one.
template <class Integrator>
double tolerance_for(const Motion& motion, double digits) {
  std::vector<double> tolerances;
  std::vector<double> errors;
  for (int k = 0; k <= 160; ++k) {
    const double tolerance = -12.0 + k / 20.0;
    const double error =
        std::log10(global_error<Integrator>(motion.model, std::pow(10.0, tolerance), motion.start, motion.reference));
    if (std::abs(error + digits) > 1.0) continue;
    tolerances.push_back(tolerance);
    errors.push_back(error);
  }
  if (errors.size() < 10) return 0.0;
  const double slope = epicyclic::fitted_slope(errors, tolerances);
  const auto mean = [](const std::vector<double>& x) {
    return std::accumulate(x.begin(), x.end(), 0.0) / static_cast<double>(x.size());
  };
  return std::pow(10.0, mean(tolerances) - slope * (digits + mean(errors)));
}

/// Cost of a mesh period of a periodic orbit at equal global error.
/// @tparam Alone  tells the error where Integrator carries other motions too
template <class Integrator, class Alone = Integrator>
void mesh_period_at_equal_error(benchmark::State& state) {
  const Motion& motion = motion_at(static_cast<int>(state.range(0)));
  if (motion.start.empty()) return state.SkipWithError("no attracting periodic orbit here");
  static std::map<std::pair<std::int64_t, std::int64_t>, double> known;  // repetitions have the same
  const auto [found, is_new] = known.try_emplace({state.range(0), state.range(1)});
  if (is_new) found->second = tolerance_for<Alone>(motion, static_cast<double>(state.range(1)));
  const double tolerance = found->second;
  if (tolerance == 0.0) return state.SkipWithError("too few tolerances give an error near the wanted one");
  Integrator integrator(motion.model, tolerance, motion.start);
  for (auto _ : state) integrator.mesh_period();
  state.counters["rhs_per_period"] = benchmark::Counter(integrator.calls(), benchmark::Counter::kAvgIterations);
  state.counters["tolerance"] = tolerance;
}

/// A mesh period in the lane ensemble, all lanes at work; last argument: with which copy of its kernels.
void mesh_period_lanes(benchmark::State& state) {
  const auto model = model_at(static_cast<double>(state.range(0)) / 100.0);
  LanesCashKarp lanes(model, std::pow(10.0, -static_cast<double>(state.range(1))), settled(model),
                      epicyclic::integrate::step_loops(static_cast<std::size_t>(state.range(2))));
  for (auto _ : state) lanes.mesh_period();
  state.counters["rhs_per_period"] = benchmark::Counter(lanes.calls(), benchmark::Counter::kAvgIterations);
}

/// A mesh period with tangent vectors in the steps of the state alone; first argument: how many, 0 for the bare period.
void with_tangents(benchmark::State& state, const epicyclic::model::DynamicModel& model,
                   const std::unique_ptr<epicyclic::integrate::Flow>& flow) {
  State y = settled(model);
  const auto vectors = static_cast<std::size_t>(state.range(0));
  State v(vectors * y.size());
  for (auto _ : state) {
    if (vectors == 0) {
      flow->evolve(y, 0.0, period);
      continue;
    }
    for (std::size_t i = 0; i < vectors; ++i) {  // unit vectors, which do not overflow
      std::fill_n(v.begin() + static_cast<std::ptrdiff_t>(i * y.size()), y.size(), 0.0);
      v[i * y.size() + i] = 1.0;
    }
    flow->evolve_tangents(y, v, 0.0, period);
  }
}
void mesh_period_with_tangents(benchmark::State& state) {
  const auto model = model_at(1.2);
  with_tangents(state, model, epicyclic::integrate::make_flow(model, options(1e-7)));
}
/// One motion alone in lanes: a tangent vector beside it, or all of them over the lanes.
void mesh_period_with_tangents_in_lanes(benchmark::State& state) {
  const auto model = model_at(1.2);
  const epicyclic::integrate::StepLoops& kernels = epicyclic::integrate::step_loops();
  const auto o = options(1e-7, "lanes-cash-karp");
  epicyclic::integrate::LanePool pool(
      [&](std::size_t vectors) { return epicyclic::studies::stage_lanes(model, kernels, vectors); }, o, kernels);
  with_tangents(state, model, pool.make_flow(model, o));
}

/// What the machine's other work has disturbed least.
void with_least(benchmark::internal::Benchmark* b) {
  b->ComputeStatistics("least", [](const std::vector<double>& v) { return *std::min_element(v.begin(), v.end()); });
  b->Unit(benchmark::kMicrosecond);
}

void speeds_and_tolerances(benchmark::internal::Benchmark* b) {
  b->ArgNames({"omega_percent", "digits"});
  for (const int omega : {280, 120})  // periodic and not
    for (const int digits : {7, 9}) b->Args({omega, digits});
  with_least(b);
}

void speeds_tolerances_and_copies(benchmark::internal::Benchmark* b) {
  b->ArgNames({"omega_percent", "digits", "copy"});
  for (const int omega : {280, 120})
    for (const int digits : {7, 9})
      for (const int copy : {0, 1}) b->Args({omega, digits, copy});
  with_least(b);
}
BENCHMARK(mesh_period_arkode)->Apply(speeds_and_tolerances);
BENCHMARK(mesh_period_arkode_stock)->Apply(speeds_and_tolerances);
BENCHMARK(mesh_period_odeint)->Apply(speeds_and_tolerances);
BENCHMARK(mesh_period_lanes)->Apply(speeds_tolerances_and_copies);

BENCHMARK(mesh_period_with_tangents)->ArgName("vectors")->Arg(0)->Arg(1)->Arg(34)->Apply(with_least);
BENCHMARK(mesh_period_with_tangents_in_lanes)->ArgName("vectors")->Arg(0)->Arg(1)->Arg(34)->Apply(with_least);

void orbits_and_errors(benchmark::internal::Benchmark* b) {
  b->ArgNames({"omega_percent", "error_digits"});
  for (const int omega : {280, 340})
    for (const int digits : {6, 8}) b->Args({omega, digits});
  with_least(b);
}
BENCHMARK_TEMPLATE(mesh_period_at_equal_error, OurArkode)->Apply(orbits_and_errors);
BENCHMARK_TEMPLATE(mesh_period_at_equal_error, OurCashKarp)->Apply(orbits_and_errors);
BENCHMARK_TEMPLATE(mesh_period_at_equal_error, StockArkode)->Apply(orbits_and_errors);
BENCHMARK_TEMPLATE(mesh_period_at_equal_error, Odeint)->Apply(orbits_and_errors);
BENCHMARK_TEMPLATE(mesh_period_at_equal_error, Adams)->Apply(orbits_and_errors);
BENCHMARK_TEMPLATE(mesh_period_at_equal_error, LanesCashKarp, OneLane<lanes_cash_karp>)->Apply(orbits_and_errors);
BENCHMARK_TEMPLATE(mesh_period_at_equal_error, LanesDopri5, OneLane<lanes_dopri5>)->Apply(orbits_and_errors);

}  // namespace
