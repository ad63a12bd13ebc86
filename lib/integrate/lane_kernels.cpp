#include "integrate/lane_kernels.hpp"

#include <string_view>

#include "core/instruction_set.hpp"

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
  if (wanted == "avx2" && machine_runs(wanted)) return &avx2::lanes;
  if (wanted == "avx512" && machine_runs(wanted)) return &avx512::lanes;
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
