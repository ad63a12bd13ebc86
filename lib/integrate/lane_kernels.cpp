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
namespace avx2_again {
extern const LaneKernels lanes;
}
namespace avx512 {
extern const LaneKernels lanes;
}
namespace avx512_again {
extern const LaneKernels lanes;
}
#endif

const LaneKernels* lane_kernels(const char* name, [[maybe_unused]] std::size_t copy) {
  const std::string_view wanted(name);
  if (wanted == "baseline") return &baseline::lanes;
#ifdef EPICYCLIC_X86_KERNELS
  static_assert(kernel_copies == 2);
  const bool again = copy % kernel_copies == 1;
  if (wanted == "avx2" && machine_runs(wanted)) return again ? &avx2_again::lanes : &avx2::lanes;
  if (wanted == "avx512" && machine_runs(wanted)) return again ? &avx512_again::lanes : &avx512::lanes;
#endif
  return nullptr;
}

const LaneKernels& lane_kernels(std::size_t copy) {
  static const char* const best = [] {
    for (const char* name : {"avx512", "avx2"})
      if (lane_kernels(name) != nullptr) return name;
    return "baseline";
  }();
  return *lane_kernels(best, copy);
}

}  // namespace epicyclic::integrate
