#include "integrate/lanes/step_loops.hpp"

#include <string_view>

#include "core/instruction_set.hpp"

namespace epicyclic::integrate {

namespace baseline {
extern const StepLoops loops;
}
#ifdef EPICYCLIC_X86_KERNELS
namespace avx2 {
extern const StepLoops loops;
}
namespace avx2_again {
extern const StepLoops loops;
}
namespace avx512 {
extern const StepLoops loops;
}
namespace avx512_again {
extern const StepLoops loops;
}
#endif

const StepLoops* step_loops(const char* name, [[maybe_unused]] std::size_t copy) {
  const std::string_view wanted(name);
  if (wanted == "baseline") return &baseline::loops;
#ifdef EPICYCLIC_X86_KERNELS
  static_assert(kernel_copies == 2);
  const bool again = copy % kernel_copies == 1;
  if (wanted == "avx2" && machine_runs(wanted)) return again ? &avx2_again::loops : &avx2::loops;
  if (wanted == "avx512" && machine_runs(wanted)) return again ? &avx512_again::loops : &avx512::loops;
#endif
  return nullptr;
}

const StepLoops& step_loops(std::size_t copy) {
  static const char* const best = [] {
    for (const char* name : {"avx512", "avx2"})
      if (step_loops(name) != nullptr) return name;
    return "baseline";
  }();
  return *step_loops(best, copy);
}

}  // namespace epicyclic::integrate
