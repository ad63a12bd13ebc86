#include "integrate/lane_kernels.hpp"

#include <string_view>

namespace epicyclic::integrate {

namespace baseline {
extern const LaneKernels lanes;
}
#ifdef EPICYCLIC_X86_KERNELS
namespace avx2 {
extern const LaneKernels lanes;
}
namespace avx512 {
extern const LaneKernels lanes;
}
#endif

const LaneKernels* lane_kernels(const char* name) {
  const std::string_view wanted(name);
  if (wanted == "baseline") return &baseline::lanes;
#ifdef EPICYCLIC_X86_KERNELS
  if (wanted == "avx2" && __builtin_cpu_supports("avx2") != 0) return &avx2::lanes;
  if (wanted == "avx512" && __builtin_cpu_supports("avx512f") != 0 && __builtin_cpu_supports("avx512dq") != 0)
    return &avx512::lanes;
#endif
  return nullptr;
}

const LaneKernels& lane_kernels() {
  static const LaneKernels& best = []() -> const LaneKernels& {
    for (const char* name : {"avx512", "avx2"})
      if (const LaneKernels* kernels = lane_kernels(name)) return *kernels;
    return baseline::lanes;
  }();
  return best;
}

}  // namespace epicyclic::integrate
