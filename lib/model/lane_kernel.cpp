#include "model/lane_kernel.hpp"

#include <string_view>

#include "core/instruction_set.hpp"

namespace epicyclic::model {

#define EPICYCLIC_DECLARE_KERNELS                                                                        \
  template <std::size_t N, std::size_t W>                                                                \
  void prepare_lanes(const LaneParameters<N, W>&, std::size_t, const double*, Instant<Lanes<W>, N>*);    \
  template <Layout L, std::size_t N, std::size_t W>                                                      \
  void evaluate_lanes(const LaneParameters<N, W>&, const Instant<Lanes<W>, N>&, const double*, double*); \
  template <Layout L, std::size_t N, std::size_t W>                                                      \
  void measure_contacts(const LaneParameters<N, W>&, const Instant<Lanes<W>, N>&, const double*, double*, double*);
namespace baseline {
EPICYCLIC_DECLARE_KERNELS
}  // namespace baseline
#ifdef EPICYCLIC_X86_KERNELS
namespace avx2 {
EPICYCLIC_DECLARE_KERNELS
}  // namespace avx2
namespace avx512 {
EPICYCLIC_DECLARE_KERNELS
}  // namespace avx512
#endif

template <Layout L, std::size_t N, std::size_t W>
LaneKernel<N, W> lane_kernel(const char* name) {
  const std::string_view wanted(name);
  if constexpr (W == 2) {
    if (wanted == "baseline")
      return {&baseline::prepare_lanes<N, W>, &baseline::evaluate_lanes<L, N, W>, &baseline::measure_contacts<L, N, W>};
  }
#ifdef EPICYCLIC_X86_KERNELS
  if constexpr (W == 4) {
    if (wanted == "avx2" && machine_runs(wanted))
      return {&avx2::prepare_lanes<N, W>, &avx2::evaluate_lanes<L, N, W>, &avx2::measure_contacts<L, N, W>};
  }
  if constexpr (W == 8) {
    if (wanted == "avx512" && machine_runs(wanted))
      return {&avx512::prepare_lanes<N, W>, &avx512::evaluate_lanes<L, N, W>, &avx512::measure_contacts<L, N, W>};
  }
#endif
  return {};
}

#define EPICYCLIC_DEFINE(L, N)                                      \
  template LaneKernel<N, 2> lane_kernel<L, N, 2>(const char* name); \
  template LaneKernel<N, 4> lane_kernel<L, N, 4>(const char* name); \
  template LaneKernel<N, 8> lane_kernel<L, N, 8>(const char* name);
EPICYCLIC_FOR_TANGENT_KERNELS(EPICYCLIC_DEFINE)
#undef EPICYCLIC_DEFINE
#undef EPICYCLIC_DECLARE_KERNELS

}  // namespace epicyclic::model
