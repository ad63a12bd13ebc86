#include "integrate/sundials/sundials_system.hpp"

#include <algorithm>
#include <new>
#include <utility>

#include <sundials/sundials_version.h>

#include "core/errors.hpp"
#include "integrate/sundials/linear_solver.hpp"
#include "integrate/sundials/state_vector.hpp"

namespace epicyclic::integrate {

static_assert(SUNDIALS_VERSION_MAJOR == 6, "restart and stop rules of ARKODE and CVODE were checked for SUNDIALS 6");

Context make_context() {
  SUNContext c = nullptr;
  if (SUNContext_Create(nullptr, &c) != 0) throw std::bad_alloc();
  return Context(c);
}

void SundialsSystem::check(const char* call, int flag) const {
  constexpr int no_memory = -20;  // ARK_MEM_FAIL and CV_MEM_FAIL
  if (flag == no_memory) throw std::bad_alloc();
  if (flag < 0) throw SolverError(call, flag, phase, message);
}

void SundialsSystem::rethrow() {
  if (thrown) std::rethrow_exception(std::exchange(thrown, nullptr));
}

int SundialsSystem::right_hand_side(realtype s, N_Vector y, N_Vector dyds, void* user) {
  auto* self = static_cast<SundialsSystem*>(user);
  try {
    const VectorField& f = *self->field;
    double* out = data_of(dyds);
    const double* in = data_of(y);
    const VectorShape shape = shape_of(y);
    if (shape.columns == 1) {
      ++self->work.right_hand_sides;
      f.right_hand_side(self->segment, s, in, out);
    } else {
      ++self->work.tangent_right_hand_sides;
      const std::size_t stride = column_stride(y);
      const std::size_t m = shape.columns - 1;
      f.tangents(self->segment, s, in, {in + stride, m, stride}, out, {out + stride, m, stride});
      if (self->parameter) {
        thread_local std::vector<double> dgdp;
        dgdp.resize(shape.length);
        f.parameter_derivative(self->segment, s, in, dgdp.data());
        double* last = out + m * stride;
        for (std::size_t i = 0; i < shape.length; ++i) last[i] += dgdp[i];
      }
    }
    return finite(dyds) ? 0 : 1;
  } catch (...) {
    self->thrown = std::current_exception();
    return -1;
  }
}

int SundialsSystem::jacobian(realtype s, N_Vector y, N_Vector /*dyds*/, SUNMatrix j, void* user, N_Vector /*t1*/,
                             N_Vector /*t2*/, N_Vector /*t3*/) {
  auto* self = static_cast<SundialsSystem*>(user);
  ++self->work.jacobians;
  try {
    const std::size_t n = self->field->dimension;
    integrate::jacobian(*self->field, self->segment, s, data_of(y), {data_of(j), n * n});
    return 0;
  } catch (...) {
    self->thrown = std::current_exception();
    return -1;
  }
}

int SundialsSystem::error_weights(N_Vector y, N_Vector weights, void* user) {
  const auto* self = static_cast<SundialsSystem*>(user);
  const IntegratorOptions& o = *self->options;
  const VectorKernels& kernels = kernels_of(y);
  const VectorShape shape = shape_of(y);
  const std::size_t stride = column_stride(y);
  double* w = data_of(weights);
  kernels.error_weights(data_of(y), o.relative_tolerance, o.absolute_tolerance, w, shape.length);
  // A tangent vector is known up to a factor: its absolute tolerance is in parts of its largest component. The
  // derivative with respect to a parameter has a size, and begins at nothing: in parts of 1 until it is longer.
  for (std::size_t j = 1; j < shape.columns; ++j) {
    const double* column = data_of(y) + j * stride;
    double* w_column = w + j * stride;
    if (j < shape.measured_columns) {
      double size = kernels.absolute_max(column, stride);
      if (self->parameter && j + 1 == shape.columns) size = std::max(size, 1.0);
      kernels.error_weights(column, o.relative_tolerance, o.absolute_tolerance * (size > 0.0 ? size : 1.0), w_column,
                            shape.length);
    } else {
      // Not measured; a weight of almost nothing, because the solvers also take maxima over the whole vector.
      constexpr double nothing = 1e-200;
      std::fill(w_column, w_column + shape.length, nothing);
    }
  }
  return 0;
}

void SundialsSystem::keep_message(int /*code*/, const char* /*module*/, const char* function, char* text, void* user) {
  auto* self = static_cast<SundialsSystem*>(user);
  try {
    self->message = std::string(function) + ": " + text;
  } catch (...) {
    self->thrown = std::current_exception();
  }
}

}  // namespace epicyclic::integrate
