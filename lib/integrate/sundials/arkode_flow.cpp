#include "integrate/sundials/arkode_flow.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <new>
#include <string>
#include <utility>

#include <arkode/arkode_arkstep.h>
#include <arkode/arkode_butcher_dirk.h>
#include <arkode/arkode_butcher_erk.h>
#include <arkode/arkode_erkstep.h>
#include <sundials/sundials_version.h>

#include "core/errors.hpp"
#include "core/require.hpp"
#include "integrate/methods.hpp"
#include "integrate/sundials/linear_solver.hpp"
#include "integrate/sundials/sundials_flow.hpp"

namespace epicyclic::integrate {

namespace {

struct TableDeleter {
  void operator()(ARKodeButcherTable t) const { ARKodeButcherTable_Free(t); }
};
using Table = std::unique_ptr<std::remove_pointer_t<ARKodeButcherTable>, TableDeleter>;

constexpr int i_controller = 2;
constexpr double max_growth = 20.0;
/// Error tests in a row that a step may fail. Tangents jump in slope at a kink: a step over it shrinks from its usual
/// length to that of the tolerance, by a factor of about 3 each time; ARKODE's own limit of 7 is not enough.
constexpr int most_refusals = 60;
/// Tolerance of Newton's method for a stage, in parts of the step's own error: with the default of a tenth the sum over
/// stages and steps is as large as the error of the method.
constexpr double newton_tolerance = 1e-2;
/// How much the estimated rate of convergence may fall from one iteration to the next. ARKODE multiplies a correction
/// by that rate before it compares it with the tolerance, and keeps it from step to step. On a side of a kink, where
/// the equations are linear, the rate falls to nothing; past the kink, with the Jacobian of the other side, any first
/// iterate is then accepted (measured: errors of 1e-4 at a tolerance of 1e-10). 1 keeps the estimate at its start, 1.
constexpr double rate_memory = 1.0;
constexpr int newton_iterations = 8;
/// Degree of the dense output, a Hermite polynomial through both ends of a step: not above the order of the method.
int interpolant_degree(const Method& method) { return std::min(3, method.order - 1); }

/// The pair's table, with its first-same-as-last stage written out where it must be.
///
/// SUNDIALS before 6.6.2 takes any method with c_s = 1 for first-same-as-last and starts the next step from the last
/// stage's slope, although a_sj != b_j: the order falls to 2 or 3. With one more stage of weight 0, whose row of A is
/// b, the property holds, and a step costs the s right-hand sides that it costs anyway.
Table make_explicit_table(const Method& method) {
  const Table given(ARKodeButcherTable_LoadERKByName(std::string(method.table).c_str()));
  if (!given) throw SolverError("ARKodeButcherTable_LoadERKByName", -1, 0.0, std::string(method.table));
  const int s = given->stages;
  const bool same_as_last = std::equal(given->b, given->b + s, given->A[s - 1]);
  const bool extended = given->c[s - 1] == 1.0 && !same_as_last;
  Table table(ARKodeButcherTable_Alloc(extended ? s + 1 : s, SUNTRUE));
  if (!table) throw std::bad_alloc();
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

double gap_of(const Table& table) { return widest_gap({table->c, static_cast<std::size_t>(table->stages)}); }

/// As SUNDIALS takes it: 0 for no limit.
double limit_of(double longest_step) { return std::isfinite(longest_step) ? longest_step : 0.0; }

/// What a flag of ARKODE's evolve means; negative flags that are not about the problem itself are thrown.
Step step_of(const SundialsSystem& system, const char* call, int flag) {
  switch (flag) {
    case ARK_ERR_FAILURE:
    case ARK_CONV_FAILURE:
    case ARK_LSETUP_FAIL:
    case ARK_LSOLVE_FAIL:
    case ARK_RHSFUNC_FAIL:
    case ARK_FIRST_RHSFUNC_ERR:
    case ARK_REPTD_RHSFUNC_ERR:
    case ARK_UNREC_RHSFUNC_ERR:
    case ARK_TOO_MUCH_ACC:
    case ARK_TOO_CLOSE:
      return Step::refused;
    case ARK_TSTOP_RETURN:
      return Step::at_stop;
    default:
      if (!system.thrown) system.check(call, flag);
      return flag < 0 ? Step::refused : Step::accepted;
  }
}

class ErkStepper {
 public:
  ErkStepper(SundialsSystem& system, N_Vector y, SUNContext context, const Method& method,
             const IntegratorOptions& /*options*/, double fixed_step)
      : system_(system), memory_(ERKStepCreate(&SundialsSystem::right_hand_side, 0.0, y, context)) {
    if (!memory_) throw std::bad_alloc();
    void* const m = memory_.get();
    system.check("ERKStepSetErrHandlerFn", ERKStepSetErrHandlerFn(m, &SundialsSystem::keep_message, &system));
    system.check("ERKStepSetUserData", ERKStepSetUserData(m, &system));
    const Table table = make_explicit_table(method);
    gap_ = gap_of(table);
    system.check("ERKStepSetTable", ERKStepSetTable(m, table.get()));
    system.check("ERKStepSetInterpolantDegree", ERKStepSetInterpolantDegree(m, interpolant_degree(method)));
    // Steps are counted by the flow, per evolution; ARKODE counts per call and is called for one step at a time.
    system.check("ERKStepSetMaxNumSteps", ERKStepSetMaxNumSteps(m, -1));
    system.check("ERKStepSetMaxErrTestFails", ERKStepSetMaxErrTestFails(m, most_refusals));
    system.check("ERKStepSetMaxHnilWarns", ERKStepSetMaxHnilWarns(m, -1));
    if (fixed_step > 0.0) {
      system.check("ERKStepSetFixedStep", ERKStepSetFixedStep(m, fixed_step));
      return;
    }
    adaptive_ = true;
    system.check("ERKStepWFtolerances", ERKStepWFtolerances(m, &SundialsSystem::error_weights));
    system.check("ERKStepSetAdaptivityMethod", ERKStepSetAdaptivityMethod(m, i_controller, 1, 0, nullptr));
    system.check("ERKStepSetMaxGrowth", ERKStepSetMaxGrowth(m, max_growth));
    system.check("ERKStepSetMaxFirstGrowth", ERKStepSetMaxFirstGrowth(m, max_growth));
  }

  void start(double s, N_Vector y, double first_step) {
    void* const m = memory_.get();
    system_.check("ERKStepReInit", ERKStepReInit(m, &SundialsSystem::right_hand_side, s, y));
    if (adaptive_) system_.check("ERKStepSetInitStep", ERKStepSetInitStep(m, first_step));
  }
  void limit_step(double longest) {
    system_.check("ERKStepSetMaxStep", ERKStepSetMaxStep(memory_.get(), limit_of(longest)));
  }
  [[nodiscard]] double gap() const { return gap_; }
  void stop_at(double s) { system_.check("ERKStepSetStopTime", ERKStepSetStopTime(memory_.get(), s)); }
  Step step(double to, N_Vector y, double& reached) {
    return step_of(system_, "ERKStepEvolve", ERKStepEvolve(memory_.get(), to, y, &reached, ARK_ONE_STEP));
  }
  void dense(double s, N_Vector y) { system_.check("ERKStepGetDky", ERKStepGetDky(memory_.get(), s, 0, y)); }
  double proposed_step() {
    double h = 0.0;
    system_.check("ERKStepGetCurrentStep", ERKStepGetCurrentStep(memory_.get(), &h));
    return h;
  }
  long attempts() {
    long count = 0;
    system_.check("ERKStepGetNumStepAttempts", ERKStepGetNumStepAttempts(memory_.get(), &count));
    return count;
  }

 private:
  struct Deleter {
    void operator()(void* memory) const { ERKStepFree(&memory); }
  };
  SundialsSystem& system_;
  std::unique_ptr<void, Deleter> memory_;
  double gap_ = 1.0;
  bool adaptive_ = false;
};

class DirkStepper {
 public:
  DirkStepper(SundialsSystem& system, N_Vector y, SUNContext context, const Method& method,
              const IntegratorOptions& /*options*/, double fixed_step)
      : system_(system),
        matrix_(make_dense_matrix(system.field->dimension, context)),
        solver_(make_dense_solver(system.field->dimension, context)),
        memory_(ARKStepCreate(nullptr, &SundialsSystem::right_hand_side, 0.0, y, context)) {
    if (!memory_) throw std::bad_alloc();
    void* const m = memory_.get();
    system.check("ARKStepSetErrHandlerFn", ARKStepSetErrHandlerFn(m, &SundialsSystem::keep_message, &system));
    system.check("ARKStepSetUserData", ARKStepSetUserData(m, &system));
    const Table table(ARKodeButcherTable_LoadDIRKByName(std::string(method.table).c_str()));
    if (!table) throw SolverError("ARKodeButcherTable_LoadDIRKByName", -1, 0.0, std::string(method.table));
    gap_ = gap_of(table);
    system.check("ARKStepSetTables", ARKStepSetTables(m, table->q, table->p, table.get(), nullptr));
    system.check("ARKStepSetInterpolantDegree", ARKStepSetInterpolantDegree(m, interpolant_degree(method)));
    system.check("ARKStepSetLinearSolver", ARKStepSetLinearSolver(m, solver_.get(), matrix_.get()));
    system.check("ARKStepSetJacFn", ARKStepSetJacFn(m, &SundialsSystem::jacobian));
    system.check("ARKStepSetNonlinConvCoef", ARKStepSetNonlinConvCoef(m, newton_tolerance));
    system.check("ARKStepSetNonlinCRDown", ARKStepSetNonlinCRDown(m, rate_memory));
    system.check("ARKStepSetMaxNonlinIters", ARKStepSetMaxNonlinIters(m, newton_iterations));
    system.check("ARKStepSetMaxNumSteps", ARKStepSetMaxNumSteps(m, -1));
    system.check("ARKStepSetMaxErrTestFails", ARKStepSetMaxErrTestFails(m, most_refusals));
    system.check("ARKStepSetMaxHnilWarns", ARKStepSetMaxHnilWarns(m, -1));
    system.check("ARKStepWFtolerances", ARKStepWFtolerances(m, &SundialsSystem::error_weights));
    if (fixed_step > 0.0) {
      system.check("ARKStepSetFixedStep", ARKStepSetFixedStep(m, fixed_step));
      return;
    }
    adaptive_ = true;
    system.check("ARKStepSetAdaptivityMethod", ARKStepSetAdaptivityMethod(m, i_controller, 1, 0, nullptr));
    system.check("ARKStepSetMaxGrowth", ARKStepSetMaxGrowth(m, max_growth));
    system.check("ARKStepSetMaxFirstGrowth", ARKStepSetMaxFirstGrowth(m, max_growth));
  }

  void start(double s, N_Vector y, double first_step) {
    void* const m = memory_.get();
    system_.check("ARKStepReInit", ARKStepReInit(m, nullptr, &SundialsSystem::right_hand_side, s, y));
    if (adaptive_) system_.check("ARKStepSetInitStep", ARKStepSetInitStep(m, first_step));
  }
  void limit_step(double longest) {
    system_.check("ARKStepSetMaxStep", ARKStepSetMaxStep(memory_.get(), limit_of(longest)));
  }
  [[nodiscard]] double gap() const { return gap_; }
  void stop_at(double s) { system_.check("ARKStepSetStopTime", ARKStepSetStopTime(memory_.get(), s)); }
  Step step(double to, N_Vector y, double& reached) {
    return step_of(system_, "ARKStepEvolve", ARKStepEvolve(memory_.get(), to, y, &reached, ARK_ONE_STEP));
  }
  void dense(double s, N_Vector y) { system_.check("ARKStepGetDky", ARKStepGetDky(memory_.get(), s, 0, y)); }
  double proposed_step() {
    double h = 0.0;
    system_.check("ARKStepGetCurrentStep", ARKStepGetCurrentStep(memory_.get(), &h));
    return h;
  }
  long attempts() {
    long count = 0;
    system_.check("ARKStepGetNumStepAttempts", ARKStepGetNumStepAttempts(memory_.get(), &count));
    return count;
  }

 private:
  struct Deleter {
    void operator()(void* memory) const { ARKStepFree(&memory); }
  };
  SundialsSystem& system_;
  Matrix matrix_;
  LinearSolver solver_;
  std::unique_ptr<void, Deleter> memory_;
  double gap_ = 1.0;
  bool adaptive_ = false;
};

std::unique_ptr<Flow> make(VectorField field, const IntegratorOptions& options, double fixed_step) {
  const Method& method = method_named(options.method);
  if (method.family == Family::dirk)
    return std::make_unique<SundialsFlow<DirkStepper>>(std::move(field), options, method, fixed_step);
  if (method.family == Family::erk)
    return std::make_unique<SundialsFlow<ErkStepper>>(std::move(field), options, method, fixed_step);
  throw InputError("method = '" + options.method + "', must be one of ARKODE's");
}

}  // namespace

std::unique_ptr<Flow> make_arkode_flow(VectorField field, const IntegratorOptions& options) {
  return make(std::move(field), options, 0.0);
}

std::unique_ptr<Flow> make_arkode_fixed_step_flow(VectorField field, const IntegratorOptions& options, double step) {
  require(step > 0.0, "step", step, "> 0");
  return make(std::move(field), options, step);
}

std::string arkode_version() { return SUNDIALS_VERSION; }

}  // namespace epicyclic::integrate
