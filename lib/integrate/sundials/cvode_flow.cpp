#include "integrate/sundials/cvode_flow.hpp"

#include <cmath>
#include <memory>
#include <new>
#include <string>
#include <type_traits>
#include <utility>

#include <cvode/cvode.h>
#include <cvode/cvode_ls.h>
#include <sundials/sundials_nonlinearsolver.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include "core/errors.hpp"
#include "integrate/methods.hpp"
#include "integrate/sundials/linear_solver.hpp"
#include "integrate/sundials/sundials_flow.hpp"

namespace epicyclic::integrate {

namespace {

struct IterationDeleter {
  void operator()(SUNNonlinearSolver s) const { SUNNonlinSolFree(s); }
};
using Iteration = std::unique_ptr<std::remove_pointer_t<SUNNonlinearSolver>, IterationDeleter>;

class CvodeStepper {
 public:
  CvodeStepper(SundialsSystem& system, N_Vector y, SUNContext context, const Method& method,
               const IntegratorOptions& options, double /*fixed_step*/)
      : system_(system) {
    const bool bdf = method.family == Family::bdf;
    if (bdf) {
      matrix_ = make_dense_matrix(system.field->dimension, context);
      solver_ = make_dense_solver(system.field->dimension, context);
    } else {
      iteration_.reset(SUNNonlinSol_FixedPoint(y, 0, context));
      if (!iteration_) throw std::bad_alloc();
    }
    memory_.reset(CVodeCreate(bdf ? CV_BDF : CV_ADAMS, context));
    if (!memory_) throw std::bad_alloc();
    void* const m = memory_.get();
    system.check("CVodeSetErrHandlerFn", CVodeSetErrHandlerFn(m, &SundialsSystem::keep_message, &system));
    system.check("CVodeInit", CVodeInit(m, &SundialsSystem::right_hand_side, 0.0, y));
    system.check("CVodeSetUserData", CVodeSetUserData(m, &system));
    system.check("CVodeWFtolerances", CVodeWFtolerances(m, &SundialsSystem::error_weights));
    if (bdf) {
      system.check("CVodeSetLinearSolver", CVodeSetLinearSolver(m, solver_.get(), matrix_.get()));
      system.check("CVodeSetJacFn", CVodeSetJacFn(m, &SundialsSystem::jacobian));
    } else {
      system.check("CVodeSetNonlinearSolver", CVodeSetNonlinearSolver(m, iteration_.get()));
    }
    if (options.max_order > 0)
      system.check("CVodeSetMaxOrd", CVodeSetMaxOrd(m, std::min(options.max_order, method.order)));
    system.check("CVodeSetMaxNumSteps", CVodeSetMaxNumSteps(m, -1));
    system.check("CVodeSetMaxHnilWarns", CVodeSetMaxHnilWarns(m, -1));
  }

  /// The first step is CVODE's choice: one that was right for a high order is far too long for order 1.
  void start(double s, N_Vector y, double /*first_step*/) {
    system_.check("CVodeReInit", CVodeReInit(memory_.get(), s, y));
  }
  void limit_step(double longest) {
    system_.check("CVodeSetMaxStep", CVodeSetMaxStep(memory_.get(), std::isfinite(longest) ? longest : 0.0));
  }
  [[nodiscard]] static double gap() { return 1.0; }
  void stop_at(double s) { system_.check("CVodeSetStopTime", CVodeSetStopTime(memory_.get(), s)); }

  Step step(double to, N_Vector y, double& reached) {
    const int flag = CVode(memory_.get(), to, y, &reached, CV_ONE_STEP);
    switch (flag) {
      case CV_ERR_FAILURE:
      case CV_CONV_FAILURE:
      case CV_LSETUP_FAIL:
      case CV_LSOLVE_FAIL:
      case CV_RHSFUNC_FAIL:
      case CV_FIRST_RHSFUNC_ERR:
      case CV_REPTD_RHSFUNC_ERR:
      case CV_UNREC_RHSFUNC_ERR:
      case CV_TOO_MUCH_ACC:
      case CV_TOO_CLOSE:
        return Step::refused;
      case CV_TSTOP_RETURN:
        return Step::at_stop;
      default:
        if (!system_.thrown) system_.check("CVode", flag);
        return flag < 0 ? Step::refused : Step::accepted;
    }
  }
  void dense(double s, N_Vector y) { system_.check("CVodeGetDky", CVodeGetDky(memory_.get(), s, 0, y)); }
  double proposed_step() { return 0.0; }
  long attempts() {
    long steps = 0;
    long rejected = 0;
    long unsolved = 0;
    system_.check("CVodeGetNumSteps", CVodeGetNumSteps(memory_.get(), &steps));
    system_.check("CVodeGetNumErrTestFails", CVodeGetNumErrTestFails(memory_.get(), &rejected));
    system_.check("CVodeGetNumNonlinSolvConvFails", CVodeGetNumNonlinSolvConvFails(memory_.get(), &unsolved));
    return steps + rejected + unsolved;
  }

 private:
  struct Deleter {
    void operator()(void* memory) const { CVodeFree(&memory); }
  };
  SundialsSystem& system_;
  Matrix matrix_;
  LinearSolver solver_;
  Iteration iteration_;
  std::unique_ptr<void, Deleter> memory_;
};

}  // namespace

std::unique_ptr<Flow> make_cvode_flow(VectorField field, const IntegratorOptions& options) {
  const Method& method = method_named(options.method);
  if (!method.multistep()) throw InputError("method = '" + options.method + "', must be one of CVODE's");
  return std::make_unique<SundialsFlow<CvodeStepper>>(std::move(field), options, method, 0.0);
}

}  // namespace epicyclic::integrate
