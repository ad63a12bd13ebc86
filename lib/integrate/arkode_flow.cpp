#include "integrate/arkode_flow.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <string>
#include <utility>

#include <arkode/arkode_butcher_erk.h>
#include <arkode/arkode_erkstep.h>
#include <sundials/sundials_context.h>
#include <sundials/sundials_version.h>

#include "core/errors.hpp"
#include "integrate/methods.hpp"
#include "integrate/state_vector.hpp"

namespace epicyclic::integrate {

static_assert(SUNDIALS_VERSION_MAJOR == 6, "restart and stop rules of ARKODE were checked for SUNDIALS 6");

namespace {

struct ContextDeleter {
  void operator()(SUNContext c) const { SUNContext_Free(&c); }
};
struct StepperDeleter {
  void operator()(void* memory) const { ERKStepFree(&memory); }
};
struct TableDeleter {
  void operator()(ARKodeButcherTable t) const { ARKodeButcherTable_Free(t); }
};
using Context = std::unique_ptr<std::remove_pointer_t<SUNContext>, ContextDeleter>;
using Stepper = std::unique_ptr<void, StepperDeleter>;
using Table = std::unique_ptr<std::remove_pointer_t<ARKodeButcherTable>, TableDeleter>;

Context make_context() {
  SUNContext c = nullptr;
  if (SUNContext_Create(nullptr, &c) != 0) throw SolverError("SUNContext_Create", -1, 0.0, "no context");
  return Context(c);
}

/// The pair's table, with its first-same-as-last stage written out where it must be.
///
/// SUNDIALS before 6.6.2 takes any method with c_s = 1 for first-same-as-last and starts the next step from the last
/// stage's slope, although a_sj != b_j: the order falls to 2 or 3. With one more stage of weight 0, whose row of A is
/// b, the property holds, and a step costs the s right-hand sides that it costs anyway.
Table make_table(const ErkMethod& method) {
  const Table given(ARKodeButcherTable_LoadERKByName(std::string(method.table).c_str()));
  if (!given) throw SolverError("ARKodeButcherTable_LoadERKByName", -1, 0.0, std::string(method.table));
  const int s = given->stages;
  const bool same_as_last = std::equal(given->b, given->b + s, given->A[s - 1]);
  const bool extended = given->c[s - 1] == 1.0 && !same_as_last;
  Table table(ARKodeButcherTable_Alloc(extended ? s + 1 : s, SUNTRUE));
  if (!table) throw SolverError("ARKodeButcherTable_Alloc", -1, 0.0, "no memory");
  table->q = given->q;
  table->p = given->p;
  std::copy(given->b, given->b + s, table->b);
  std::copy(given->d, given->d + s, table->d);
  std::copy(given->c, given->c + s, table->c);
  for (int i = 0; i < s; ++i) std::copy(given->A[i], given->A[i] + s, table->A[i]);
  if (extended) {
    std::copy(given->b, given->b + s, table->A[s]);
    table->c[s] = 1.0;
  }
  return table;
}

class ArkodeFlow final : public Flow {
 public:
  ArkodeFlow(VectorField field, const IntegratorOptions& options, double fixed_step)
      : field_(std::move(field)),
        options_(options),
        fixed_step_(fixed_step),
        context_(make_context()),
        y_(make_state_vector(field_.dimension, context_.get())),
        sample_(make_state_vector(field_.dimension, context_.get())) {
    const ErkMethod* method = find_erk_method(options.method);
    if (method == nullptr) throw InputError("integrator method '" + options.method + "' is not known");
    stepper_.reset(ERKStepCreate(&ArkodeFlow::call_right_hand_side, 0.0, y_.get(), context_.get()));
    if (!stepper_) throw SolverError("ERKStepCreate", -1, 0.0, "no memory");
    check("ERKStepSetErrHandlerFn", ERKStepSetErrHandlerFn(stepper_.get(), &ArkodeFlow::keep_message, this));
    check("ERKStepSetUserData", ERKStepSetUserData(stepper_.get(), this));
    const Table table = make_table(*method);
    check("ERKStepSetTable", ERKStepSetTable(stepper_.get(), table.get()));
    check("ERKStepSetInterpolantDegree", ERKStepSetInterpolantDegree(stepper_.get(), std::min(3, method->order - 1)));
    // Steps are counted here, per evolution; ARKODE counts per call and is called for one step at a time.
    check("ERKStepSetMaxNumSteps", ERKStepSetMaxNumSteps(stepper_.get(), -1));
    check("ERKStepSetMaxHnilWarns", ERKStepSetMaxHnilWarns(stepper_.get(), -1));
    if (fixed_step_ > 0.0) {
      check("ERKStepSetFixedStep", ERKStepSetFixedStep(stepper_.get(), fixed_step_));
      return;
    }
    check("ERKStepWFtolerances", ERKStepWFtolerances(stepper_.get(), &ArkodeFlow::error_weights));
    constexpr int i_controller = 2;
    constexpr double max_growth = 20.0;
    check("ERKStepSetAdaptivityMethod", ERKStepSetAdaptivityMethod(stepper_.get(), i_controller, 1, 0, nullptr));
    check("ERKStepSetMaxGrowth", ERKStepSetMaxGrowth(stepper_.get(), max_growth));
    check("ERKStepSetMaxFirstGrowth", ERKStepSetMaxFirstGrowth(stepper_.get(), max_growth));
  }

  [[nodiscard]] const VectorField& field() const override { return field_; }
  [[nodiscard]] long right_hand_side_calls() const override { return calls_; }
  void forget() override { next_step_ = 0.0; }

  Evolution evolve(std::span<double> state, double from, double to, std::span<const double> samples,
                   const Observer& observer) override {
    if (state.size() != field_.dimension)
      throw InputError("a state of " + std::to_string(state.size()) + " numbers for a field of dimension " +
                       std::to_string(field_.dimension));
    const std::vector<double> stops = [&] {
      std::vector<double> s = breakpoints_between(field_, from, to);
      s.push_back(to);
      return s;
    }();
    const double periods = field_.period > 0.0 ? std::ceil((to - from) / field_.period - 1e-9) : 1.0;
    long steps_left = options_.max_steps_per_period * static_cast<long>(std::max(1.0, periods));
    std::size_t next_sample = 0;
    double s = from;
    for (const double stop : stops) {
      const Evolution part = evolve_segment(state, s, stop, samples, next_sample, observer, steps_left);
      if (!part.reached()) return part;
      s = stop;
    }
    return {Outcome::reached, to, {}};
  }

 private:
  Evolution evolve_segment(std::span<double> state, double from, double to, std::span<const double> samples,
                           std::size_t& next_sample, const Observer& observer, long& steps_left) {
    segment_ = segment_after(field_, from);
    std::copy(state.begin(), state.end(), data_of(y_.get()));
    phase_ = from;
    message_.clear();
    check("ERKStepReInit", ERKStepReInit(stepper_.get(), &ArkodeFlow::call_right_hand_side, from, y_.get()));
    if (fixed_step_ <= 0.0) check("ERKStepSetInitStep", ERKStepSetInitStep(stepper_.get(), next_step_));
    check("ERKStepSetStopTime", ERKStepSetStopTime(stepper_.get(), to));

    double s = from;
    double proposed = next_step_;
    const double* y = data_of(y_.get());
    while (s < to) {
      const double before = proposed;
      double reached = s;
      const int flag = ERKStepEvolve(stepper_.get(), to, y_.get(), &reached, ARK_ONE_STEP);
      if (thrown_) std::rethrow_exception(std::exchange(thrown_, nullptr));
      if (flag < 0) return failure(flag, s);
      const bool at_end = flag == ARK_TSTOP_RETURN || reached >= to;
      if (!kernels_of(y_.get()).finite(y, padded_size(y_.get())))
        return {Outcome::failed, s, "the state is not finite after a step"};
      s = at_end ? to : reached;
      std::copy(y, y + field_.dimension, state.begin());
      phase_ = s;
      while (next_sample < samples.size() && samples[next_sample] <= s) {
        if (samples[next_sample] == s) {
          observer(next_sample, s, {y, field_.dimension});
        } else {
          check("ERKStepGetDky", ERKStepGetDky(stepper_.get(), samples[next_sample], 0, sample_.get()));
          observer(next_sample, samples[next_sample], {data_of(sample_.get()), field_.dimension});
        }
        ++next_sample;
      }
      check("ERKStepGetCurrentStep", ERKStepGetCurrentStep(stepper_.get(), &proposed));
      // A step cut short by the stop says nothing against the longer one that was proposed before it.
      if (at_end) proposed = std::max(proposed, before);
      long attempts = 0;
      check("ERKStepGetNumStepAttempts", ERKStepGetNumStepAttempts(stepper_.get(), &attempts));
      const double largest = kernels_of(y_.get()).absolute_max(y, padded_size(y_.get()));
      if (largest > options_.escape_bound) {
        return {Outcome::diverged, s,
                "a component of the state left the bound " + std::to_string(options_.escape_bound)};
      }
      if (attempts >= steps_left && !at_end) {
        return {Outcome::step_limit, s,
                "more than " + std::to_string(options_.max_steps_per_period) + " steps in a period"};
      }
      if (at_end) steps_left -= attempts;
    }
    if (fixed_step_ <= 0.0) next_step_ = proposed;
    return {Outcome::reached, to, {}};
  }

  /// What a negative flag means for the caller.
  Evolution failure(int flag, double s) const {
    switch (flag) {
      case ARK_ERR_FAILURE:
      case ARK_CONV_FAILURE:
      case ARK_RHSFUNC_FAIL:
      case ARK_FIRST_RHSFUNC_ERR:
      case ARK_REPTD_RHSFUNC_ERR:
      case ARK_UNREC_RHSFUNC_ERR:
      case ARK_TOO_MUCH_ACC:
      case ARK_TOO_CLOSE:
        return {Outcome::failed, s, message_.empty() ? "ARKODE flag " + std::to_string(flag) : message_};
      default:
        throw SolverError("ERKStepEvolve", flag, s, message_);
    }
  }

  void check(const char* call, int flag) const {
    if (flag < 0) throw SolverError(call, flag, phase_, message_);
  }

  static int call_right_hand_side(realtype s, N_Vector y, N_Vector dyds, void* user) {
    auto* self = static_cast<ArkodeFlow*>(user);
    ++self->calls_;
    try {
      double* out = data_of(dyds);
      self->field_.right_hand_side(self->segment_, s, data_of(y), out);
      return kernels_of(dyds).finite(out, padded_size(dyds)) ? 0 : 1;
    } catch (...) {
      self->thrown_ = std::current_exception();
      return -1;
    }
  }

  /// One pass: w_i = 1 / (rtol |y_i| + atol).
  static int error_weights(N_Vector y, N_Vector weights, void* user) {
    const auto* self = static_cast<ArkodeFlow*>(user);
    kernels_of(y).error_weights(data_of(y), self->options_.relative_tolerance, self->options_.absolute_tolerance,
                                data_of(weights), self->field_.dimension);
    return 0;
  }

  static void keep_message(int /*code*/, const char* /*module*/, const char* function, char* text, void* user) {
    auto* self = static_cast<ArkodeFlow*>(user);
    try {
      self->message_ = std::string(function) + ": " + text;
    } catch (...) {
      self->thrown_ = std::current_exception();
    }
  }

  VectorField field_;
  IntegratorOptions options_;
  double fixed_step_;
  Context context_;
  Vector y_, sample_;
  Stepper stepper_;
  std::size_t segment_ = 0;
  double phase_ = 0.0;
  double next_step_ = 0.0;
  long calls_ = 0;
  std::string message_;
  std::exception_ptr thrown_;
};

}  // namespace

std::unique_ptr<Flow> make_arkode_flow(VectorField field, const IntegratorOptions& options) {
  return std::make_unique<ArkodeFlow>(std::move(field), options, 0.0);
}

std::unique_ptr<Flow> make_arkode_fixed_step_flow(VectorField field, const IntegratorOptions& options, double step) {
  return std::make_unique<ArkodeFlow>(std::move(field), options, step);
}

std::string arkode_version() { return SUNDIALS_VERSION; }

}  // namespace epicyclic::integrate
