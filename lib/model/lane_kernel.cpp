#include "model/lane_kernel.hpp"

#include <string_view>

#include "core/instruction_set.hpp"

namespace epicyclic::model {

#define EPICYCLIC_DECLARE_KERNELS                   \
  template <Layout L, std::size_t N, std::size_t W> \
  void evaluate_lanes(const LaneParameters<N, W>&, const double*, const double*, double*);
#define EPICYCLIC_DECLARE(L, N, W) \
  extern template void evaluate_lanes<L, N, W>(const LaneParameters<N, W>&, const double*, const double*, double*);
#define EPICYCLIC_DECLARE_TWO(L, N) EPICYCLIC_DECLARE(L, N, 2)
#define EPICYCLIC_DECLARE_FOUR(L, N) EPICYCLIC_DECLARE(L, N, 4)
#define EPICYCLIC_DECLARE_EIGHT(L, N) EPICYCLIC_DECLARE(L, N, 8)
namespace baseline {
EPICYCLIC_DECLARE_KERNELS
EPICYCLIC_FOR_TANGENT_KERNELS(EPICYCLIC_DECLARE_TWO)
}  // namespace baseline
#ifdef EPICYCLIC_X86_KERNELS
namespace avx2 {
EPICYCLIC_DECLARE_KERNELS
EPICYCLIC_FOR_TANGENT_KERNELS(EPICYCLIC_DECLARE_FOUR)
}  // namespace avx2
namespace avx512 {
EPICYCLIC_DECLARE_KERNELS
EPICYCLIC_FOR_TANGENT_KERNELS(EPICYCLIC_DECLARE_EIGHT)
}  // namespace avx512
#endif

template <Layout L, std::size_t N, std::size_t W>
LaneKernel<N, W> lane_kernel(const char* name) {
  const std::string_view wanted(name);
  if constexpr (W == 2) {
    if (wanted == "baseline") return &baseline::evaluate_lanes<L, N, W>;
  }
#ifdef EPICYCLIC_X86_KERNELS
  if constexpr (W == 4) {
    if (wanted == "avx2" && machine_runs(wanted)) return &avx2::evaluate_lanes<L, N, W>;
  }
  if constexpr (W == 8) {
    if (wanted == "avx512" && machine_runs(wanted)) return &avx512::evaluate_lanes<L, N, W>;
  }
#endif
  return nullptr;
}

#define EPICYCLIC_DEFINE(L, N)                                      \
  template LaneKernel<N, 2> lane_kernel<L, N, 2>(const char* name); \
  template LaneKernel<N, 4> lane_kernel<L, N, 4>(const char* name); \
  template LaneKernel<N, 8> lane_kernel<L, N, 8>(const char* name);
EPICYCLIC_FOR_TANGENT_KERNELS(EPICYCLIC_DEFINE)
#undef EPICYCLIC_DEFINE
#undef EPICYCLIC_DECLARE
#undef EPICYCLIC_DECLARE_TWO
#undef EPICYCLIC_DECLARE_FOUR
#undef EPICYCLIC_DECLARE_EIGHT
#undef EPICYCLIC_DECLARE_KERNELS

}  // namespace epicyclic::model
