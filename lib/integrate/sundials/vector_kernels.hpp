// Loops over the numbers of a state vector, compiled once per instruction set and chosen at run time.
//
// Numbers lie in memory aligned to 64 bytes, padded with zeros to blocks of 8. Element-wise operations give the same
// bits on every instruction set; sums are taken in 8 interleaved partial sums that are added in one fixed order, so
// that reductions do so as well. No fused multiply-add (-ffp-contract=off).
#pragma once

#include <cstddef>

namespace epicyclic::integrate {

/// Numbers in a block: the padding of state vectors, and the number of partial sums.
inline constexpr std::size_t vector_block = 8;

/// `size` counts whole blocks' numbers, padding included; `length` the true numbers.
struct VectorKernels {
  const char* name;  ///< "baseline", "avx2", "avx512"

  /// z = sum_j c_j x_j, in the order of j; z may be one of the x_j.
  void (*linear_combination)(int count, const double* c, const double* const* x, double* z, std::size_t size);
  /// z = a x + b y
  void (*linear_sum)(double a, const double* x, double b, const double* y, double* z, std::size_t size);
  /// z = a x
  void (*scale)(double a, const double* x, double* z, std::size_t size);
  /// z = x y, element by element
  void (*product)(const double* x, const double* y, double* z, std::size_t size);
  /// z = |x|
  void (*absolute)(const double* x, double* z, std::size_t size);
  /// z = x / y, 1 / x, x + b and c: they would fill the padding, and stop before it.
  void (*quotient)(const double* x, const double* y, double* z, std::size_t length);
  void (*inverse)(const double* x, double* z, std::size_t length);
  void (*add_constant)(const double* x, double b, double* z, std::size_t length);
  void (*constant)(double c, double* z, std::size_t length);
  /// w = 1 / (rtol |y| + atol)
  void (*error_weights)(const double* y, double relative, double absolute, double* w, std::size_t length);
  /// sum x y ,  sum (x w)^2 ,  sum |x| ,  max |x|
  double (*dot)(const double* x, const double* y, std::size_t size);
  double (*weighted_square_sum)(const double* x, const double* w, std::size_t size);
  double (*absolute_sum)(const double* x, std::size_t size);
  double (*absolute_max)(const double* x, std::size_t size);
  /// Is each |x| <= bound? No for NaN. Padding included.
  bool (*within)(const double* x, double bound, std::size_t size);
};

/// The best that this machine runs.
[[nodiscard]] const VectorKernels& vector_kernels();

/// Those of one instruction set, or nullptr if it was not compiled or this machine does not run it.
/// @param name "baseline", "avx2" or "avx512"
[[nodiscard]] const VectorKernels* vector_kernels(const char* name);

}  // namespace epicyclic::integrate
