// A VectorField as SUNDIALS' C callbacks see it: what ARKODE and CVODE have in common.
//
// The state vector's first column is the state, further columns are tangent vectors. No exception crosses a C frame:
// it is kept here, the callback returns a failure, and the caller of the solver throws it again. Nothing is printed:
// the solver's messages are kept, too.
#pragma once

#include <cstddef>
#include <exception>
#include <memory>
#include <string>
#include <type_traits>

#include <sundials/sundials_context.h>
#include <sundials/sundials_matrix.h>
#include <sundials/sundials_nvector.h>

#include "integrate/flow.hpp"
#include "integrate/options.hpp"

namespace epicyclic::integrate {

struct ContextDeleter {
  void operator()(SUNContext c) const { SUNContext_Free(&c); }
};
using Context = std::unique_ptr<std::remove_pointer_t<SUNContext>, ContextDeleter>;

/// @throws SolverError when there is no memory
[[nodiscard]] Context make_context();

struct SundialsSystem {
  const VectorField* field = nullptr;
  const IntegratorOptions* options = nullptr;
  bool parameter = false;   ///< the last column is the derivative with respect to the parameter
  std::size_t segment = 0;  ///< of the breakpoints
  double phase = 0;         ///< of the last accepted step, for messages
  Work work{};              ///< steps are counted by the caller
  std::string message;      ///< the solver's last one
  std::exception_ptr thrown;

  /// @throws SolverError for a negative flag
  void check(const char* call, int flag) const;
  /// Throws again what a callback has caught.
  void rethrow();

  // The callbacks; `user` is the system.
  static int right_hand_side(realtype s, N_Vector y, N_Vector dyds, void* user);
  static int jacobian(realtype s, N_Vector y, N_Vector dyds, SUNMatrix j, void* user, N_Vector, N_Vector, N_Vector);
  static int error_weights(N_Vector y, N_Vector weights, void* user);
  static void keep_message(int code, const char* module, const char* function, char* text, void* user);
};

}  // namespace epicyclic::integrate
