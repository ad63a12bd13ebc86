#include "integrate/vector_kernels.hpp"

#include <string_view>

namespace epicyclic::integrate {

namespace baseline {
extern const VectorKernels kernels;
}
#ifdef EPICYCLIC_X86_KERNELS
namespace avx2 {
extern const VectorKernels kernels;
}
namespace avx512 {
extern const VectorKernels kernels;
}
#endif

const VectorKernels* vector_kernels(const char* name) {
  const std::string_view wanted(name);
  if (wanted == "baseline") return &baseline::kernels;
#ifdef EPICYCLIC_X86_KERNELS
  if (wanted == "avx2" && __builtin_cpu_supports("avx2") != 0) return &avx2::kernels;
  if (wanted == "avx512" && __builtin_cpu_supports("avx512f") != 0 && __builtin_cpu_supports("avx512dq") != 0)
    return &avx512::kernels;
#endif
  return nullptr;
}

const VectorKernels& vector_kernels() {
  static const VectorKernels& best = []() -> const VectorKernels& {
    for (const char* name : {"avx512", "avx2"})
      if (const VectorKernels* kernels = vector_kernels(name)) return *kernels;
    return baseline::kernels;
  }();
  return best;
}

}  // namespace epicyclic::integrate
