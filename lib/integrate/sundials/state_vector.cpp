#include "integrate/sundials/state_vector.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <new>

namespace epicyclic::integrate {

namespace {

constexpr std::align_val_t alignment{64};

/// The numbers that weighted norms read: with padding, and how many of them are values.
std::size_t measured_size(N_Vector v) { return content_of(v).stride * content_of(v).shape.measured_columns; }
double measured_count(N_Vector v) {
  const VectorShape& s = content_of(v).shape;
  return static_cast<double>(s.length * s.measured_columns);
}

/// For operations that would fill the padding: f(offset) for each column.
template <class F>
void for_columns(N_Vector v, const F& f) {
  const StateVectorContent& c = content_of(v);
  for (std::size_t j = 0; j < c.shape.columns; ++j) f(j * c.stride);
}

/// f(index) for each true number of the vector, or of its measured columns.
template <class F>
void for_numbers(N_Vector v, std::size_t columns, const F& f) {
  const StateVectorContent& c = content_of(v);
  for (std::size_t j = 0; j < columns; ++j)
    for (std::size_t i = 0; i < c.shape.length; ++i) f(j * c.stride + i);
}
template <class F>
void for_numbers(N_Vector v, const F& f) {
  for_numbers(v, content_of(v).shape.columns, f);
}

// ---- memory -------------------------------------------------------------------------------------------------------

double* allocate(std::size_t count) {
  auto* memory = static_cast<double*>(::operator new(count * sizeof(double), alignment, std::nothrow));
  if (memory != nullptr) std::fill(memory, memory + count, 0.0);
  return memory;
}

void destroy(N_Vector v) {
  if (v == nullptr) return;
  if (auto* content = static_cast<StateVectorContent*>(v->content)) {
    if (content->owns) ::operator delete(content->data, alignment);
    delete content;
    v->content = nullptr;
  }
  N_VFreeEmpty(v);
}

N_Vector clone_empty(N_Vector like) {
  N_Vector v = N_VNewEmpty(like->sunctx);
  if (v == nullptr) return nullptr;
  if (N_VCopyOps(like, v) != 0) {
    N_VFreeEmpty(v);
    return nullptr;
  }
  auto* content = new (std::nothrow)
      StateVectorContent{content_of(like).shape, content_of(like).stride, &kernels_of(like), nullptr, false};
  if (content == nullptr) {
    N_VFreeEmpty(v);
    return nullptr;
  }
  v->content = content;
  return v;
}

N_Vector clone(N_Vector like) {
  N_Vector v = clone_empty(like);
  if (v == nullptr) return nullptr;
  auto& content = *static_cast<StateVectorContent*>(v->content);
  content.data = allocate(padded_size(v));
  content.owns = true;
  if (content.data != nullptr) return v;
  destroy(v);
  return nullptr;
}

[[noreturn]] void throw_bad_alloc() { throw std::bad_alloc(); }

/// SUNDIALS 6 uses the clone before it checks whether there is one [N_VClone()]: a lack of memory ends the program
/// here, by std::terminate() with std::bad_alloc, and not by a null pointer.
template <N_Vector (*make)(N_Vector)>
N_Vector whole(N_Vector like) noexcept {
  N_Vector v = make(like);
  if (v == nullptr) throw_bad_alloc();
  return v;
}

N_Vector_ID identity(N_Vector /*v*/) { return SUNDIALS_NVEC_CUSTOM; }
sunindextype length_of(N_Vector v) {
  return static_cast<sunindextype>(shape_of(v).length * content_of(v).shape.columns);
}
void space(N_Vector v, sunindextype* reals, sunindextype* integers) {
  *reals = static_cast<sunindextype>(padded_size(v));
  *integers = 4;
}
realtype* array_pointer(N_Vector v) { return data_of(v); }

// ---- standard operations ------------------------------------------------------------------------------------------

void linear_sum(realtype a, N_Vector x, realtype b, N_Vector y, N_Vector z) {
  kernels_of(z).linear_sum(a, data_of(x), b, data_of(y), data_of(z), padded_size(z));
}
void constant(realtype c, N_Vector z) {
  for_columns(z, [&](std::size_t at) { kernels_of(z).constant(c, data_of(z) + at, shape_of(z).length); });
}
void product(N_Vector x, N_Vector y, N_Vector z) {
  kernels_of(z).product(data_of(x), data_of(y), data_of(z), padded_size(z));
}
void quotient(N_Vector x, N_Vector y, N_Vector z) {
  for_columns(z, [&](std::size_t at) {
    kernels_of(z).quotient(data_of(x) + at, data_of(y) + at, data_of(z) + at, shape_of(z).length);
  });
}
void scale(realtype c, N_Vector x, N_Vector z) {
  if (c == 1.0) {
    if (x != z) std::copy(data_of(x), data_of(x) + padded_size(x), data_of(z));
    return;
  }
  kernels_of(z).scale(c, data_of(x), data_of(z), padded_size(z));
}
void absolute(N_Vector x, N_Vector z) { kernels_of(z).absolute(data_of(x), data_of(z), padded_size(z)); }
void inverse(N_Vector x, N_Vector z) {
  for_columns(z, [&](std::size_t at) { kernels_of(z).inverse(data_of(x) + at, data_of(z) + at, shape_of(z).length); });
}
void add_constant(N_Vector x, realtype b, N_Vector z) {
  for_columns(
      z, [&](std::size_t at) { kernels_of(z).add_constant(data_of(x) + at, b, data_of(z) + at, shape_of(z).length); });
}
realtype dot(N_Vector x, N_Vector y) { return kernels_of(x).dot(data_of(x), data_of(y), padded_size(x)); }
realtype max_norm(N_Vector x) { return kernels_of(x).absolute_max(data_of(x), padded_size(x)); }
realtype l1_norm(N_Vector x) { return kernels_of(x).absolute_sum(data_of(x), padded_size(x)); }
realtype weighted_square_sum(N_Vector x, N_Vector w) {
  return kernels_of(x).weighted_square_sum(data_of(x), data_of(w), measured_size(x));
}
realtype wrms_norm(N_Vector x, N_Vector w) { return std::sqrt(weighted_square_sum(x, w) / measured_count(x)); }
realtype wl2_norm(N_Vector x, N_Vector w) { return std::sqrt(weighted_square_sum(x, w)); }

// Only constraints and preconditioners need the operations below: plain loops.

realtype masked_square_sum(N_Vector x, N_Vector w, N_Vector id) {
  double sum = 0.0;
  for_numbers(x, content_of(x).shape.measured_columns, [&](std::size_t i) {
    if (data_of(id)[i] > 0.0) sum += (data_of(x)[i] * data_of(w)[i]) * (data_of(x)[i] * data_of(w)[i]);
  });
  return sum;
}
realtype wrms_norm_mask(N_Vector x, N_Vector w, N_Vector id) {
  return std::sqrt(masked_square_sum(x, w, id) / measured_count(x));
}
realtype minimum(N_Vector x) {
  double least = data_of(x)[0];
  for_numbers(x, [&](std::size_t i) { least = std::min(least, data_of(x)[i]); });
  return least;
}
void compare(realtype c, N_Vector x, N_Vector z) {
  for_numbers(x, [&](std::size_t i) { data_of(z)[i] = std::abs(data_of(x)[i]) >= c ? 1.0 : 0.0; });
}
booleantype inverse_test(N_Vector x, N_Vector z) {
  bool all = true;
  for_numbers(x, [&](std::size_t i) {
    if (data_of(x)[i] == 0.0)
      all = false;
    else
      data_of(z)[i] = 1.0 / data_of(x)[i];
  });
  return all ? SUNTRUE : SUNFALSE;
}
booleantype constraint_mask(N_Vector c, N_Vector x, N_Vector m) {
  bool all = true;
  for_numbers(x, [&](std::size_t i) {
    const double kind = data_of(c)[i];
    const double value = data_of(x)[i] * kind;
    const bool strict = std::abs(kind) > 1.5;
    const bool broken = kind != 0.0 && (strict ? value <= 0.0 : value < 0.0);
    data_of(m)[i] = broken ? 1.0 : 0.0;
    all = all && !broken;
  });
  return all ? SUNTRUE : SUNFALSE;
}
realtype min_quotient(N_Vector numerator, N_Vector denominator) {
  double least = std::numeric_limits<double>::max();
  for_numbers(numerator, [&](std::size_t i) {
    if (data_of(denominator)[i] != 0.0) least = std::min(least, data_of(numerator)[i] / data_of(denominator)[i]);
  });
  return least;
}

// ---- fused operations ---------------------------------------------------------------------------------------------

/// More than the stages of any pair, and than the order of any multistep method.
constexpr int fused_most = 32;

int linear_combination(int count, realtype* c, N_Vector* x, N_Vector z) {
  if (count < 1 || count > fused_most) return -1;
  std::array<const double*, fused_most> from;
  for (int j = 0; j < count; ++j) from[static_cast<std::size_t>(j)] = data_of(x[j]);
  kernels_of(z).linear_combination(count, c, from.data(), data_of(z), padded_size(z));
  return 0;
}

int scale_add_multi(int count, realtype* a, N_Vector x, N_Vector* y, N_Vector* z) {
  for (int j = 0; j < count; ++j) linear_sum(a[j], x, 1.0, y[j], z[j]);
  return 0;
}

int dot_multi(int count, N_Vector x, N_Vector* y, realtype* products) {
  for (int j = 0; j < count; ++j) products[j] = dot(x, y[j]);
  return 0;
}

int linear_sum_array(int count, realtype a, N_Vector* x, realtype b, N_Vector* y, N_Vector* z) {
  for (int j = 0; j < count; ++j) linear_sum(a, x[j], b, y[j], z[j]);
  return 0;
}

int scale_array(int count, realtype* c, N_Vector* x, N_Vector* z) {
  for (int j = 0; j < count; ++j) scale(c[j], x[j], z[j]);
  return 0;
}

int constant_array(int count, realtype c, N_Vector* z) {
  for (int j = 0; j < count; ++j) constant(c, z[j]);
  return 0;
}

void set_operations(N_Vector_Ops ops) {
  ops->nvgetvectorid = &identity;
  ops->nvclone = &whole<clone>;
  ops->nvcloneempty = &whole<clone_empty>;
  ops->nvdestroy = &destroy;
  ops->nvspace = &space;
  ops->nvgetarraypointer = &array_pointer;
  ops->nvgetlength = &length_of;
  ops->nvlinearsum = &linear_sum;
  ops->nvconst = &constant;
  ops->nvprod = &product;
  ops->nvdiv = &quotient;
  ops->nvscale = &scale;
  ops->nvabs = &absolute;
  ops->nvinv = &inverse;
  ops->nvaddconst = &add_constant;
  ops->nvdotprod = &dot;
  ops->nvmaxnorm = &max_norm;
  ops->nvwrmsnorm = &wrms_norm;
  ops->nvwrmsnormmask = &wrms_norm_mask;
  ops->nvmin = &minimum;
  ops->nvwl2norm = &wl2_norm;
  ops->nvl1norm = &l1_norm;
  ops->nvcompare = &compare;
  ops->nvinvtest = &inverse_test;
  ops->nvconstrmask = &constraint_mask;
  ops->nvminquotient = &min_quotient;
  ops->nvlinearcombination = &linear_combination;
  ops->nvscaleaddmulti = &scale_add_multi;
  ops->nvdotprodmulti = &dot_multi;
  ops->nvlinearsumvectorarray = &linear_sum_array;
  ops->nvscalevectorarray = &scale_array;
  ops->nvconstvectorarray = &constant_array;
  // Reductions of one process are its local ones.
  ops->nvdotprodlocal = &dot;
  ops->nvmaxnormlocal = &max_norm;
  ops->nvminlocal = &minimum;
  ops->nvl1normlocal = &l1_norm;
  ops->nvinvtestlocal = &inverse_test;
  ops->nvconstrmasklocal = &constraint_mask;
  ops->nvminquotientlocal = &min_quotient;
  ops->nvwsqrsumlocal = &weighted_square_sum;
  ops->nvwsqrsummasklocal = &masked_square_sum;
}

}  // namespace

Vector make_state_vector(const VectorShape& shape, SUNContext context, const VectorKernels& kernels_to_use) {
  Vector v(N_VNewEmpty(context));
  if (!v) throw std::bad_alloc();
  set_operations(v->ops);
  const std::size_t stride = (shape.length + vector_block - 1) / vector_block * vector_block;
  auto content =
      std::make_unique<StateVectorContent>(StateVectorContent{shape, stride, &kernels_to_use, nullptr, true});
  content->data = allocate(stride * shape.columns);
  v->content = content.release();
  if (content_of(v.get()).data == nullptr) throw std::bad_alloc();
  return v;
}

}  // namespace epicyclic::integrate
