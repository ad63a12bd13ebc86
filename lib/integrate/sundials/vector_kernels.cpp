#include "integrate/sundials/vector_kernels.hpp"

#include <string_view>

#include "core/instruction_set.hpp"

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
  if (wanted == "avx2" && machine_runs(wanted)) return &avx2::kernels;
  if (wanted == "avx512" && machine_runs(wanted)) return &avx512::kernels;
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
