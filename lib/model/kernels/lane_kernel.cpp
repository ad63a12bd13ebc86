#include "model/kernels/lane_kernel.hpp"

#include <string_view>

#include "core/instruction_set.hpp"
#include "model/dispatch.hpp"

namespace epicyclic::model {

#define EPICYCLIC_DECLARE_KERNELS                                                                                   \
  template <std::size_t N, std::size_t W>                                                                           \
  void prepare_lanes(const LaneParameters<N, W>&, std::size_t, const double*, PhaseCoefficients<Lanes<W>, N>*);     \
  template <Layout L, std::size_t N, std::size_t W>                                                                 \
  void evaluate_lanes(const LaneParameters<N, W>&, const PhaseCoefficients<Lanes<W>, N>&, const double*, double*);  \
  template <std::size_t N, std::size_t W>                                                                           \
  void push_lanes(Layout, const LaneParameters<N, W>&, const PhaseCoefficients<Lanes<W>, N>&, const double*,        \
                  const double*, double*, double*);                                                                 \
  template <std::size_t N, std::size_t W>                                                                           \
  void evaluate_output_lanes(Layout, const LaneParameters<N, W>&, const PhaseCoefficients<Lanes<W>, N>&,            \
                             const double*, double*);                                                               \
  template <Layout L, std::size_t N, std::size_t W>                                                                 \
  void measure_contacts(const LaneParameters<N, W>&, const PhaseCoefficients<Lanes<W>, N>&, const double*, double*, \
                        double*);
namespace baseline {
EPICYCLIC_DECLARE_KERNELS
}  // namespace baseline
#ifdef EPICYCLIC_X86_KERNELS
namespace avx2 {
EPICYCLIC_DECLARE_KERNELS
}  // namespace avx2
namespace avx2_again {
EPICYCLIC_DECLARE_KERNELS
}  // namespace avx2_again
namespace avx512 {
EPICYCLIC_DECLARE_KERNELS
}  // namespace avx512
namespace avx512_again {
EPICYCLIC_DECLARE_KERNELS
}  // namespace avx512_again
#endif

namespace {

/// @param first  the set's first copy, which has the tangents of all
#define EPICYCLIC_KERNELS_OF(set, first)                                                \
  {                                                                                     \
    &set::prepare_lanes<N, W>, &set::evaluate_lanes<L, N, W>, &first::push_lanes<N, W>, \
        &set::measure_contacts<L, N, W>                                                 \
  }

template <Layout L, std::size_t N, std::size_t W>
LaneKernel<N, W> kernel_of_layout(const char* name, [[maybe_unused]] std::size_t copy) {
  const std::string_view wanted(name);
  if constexpr (W == 2) {
    if (wanted == "baseline") return EPICYCLIC_KERNELS_OF(baseline, baseline);
  }
#ifdef EPICYCLIC_X86_KERNELS
  static_assert(kernel_copies == 2);
  const bool again = copy % kernel_copies == 1;
  if constexpr (W == 4) {
    if (wanted == "avx2" && machine_runs(wanted)) {
      if (again) return EPICYCLIC_KERNELS_OF(avx2_again, avx2);
      return EPICYCLIC_KERNELS_OF(avx2, avx2);
    }
  }
  if constexpr (W == 8) {
    if (wanted == "avx512" && machine_runs(wanted)) {
      if (again) return EPICYCLIC_KERNELS_OF(avx512_again, avx512);
      return EPICYCLIC_KERNELS_OF(avx512, avx512);
    }
  }
#endif
  return {};
}

}  // namespace

template <std::size_t N, std::size_t W>
LaneKernel<N, W> lane_kernel(Layout layout, const char* name, std::size_t copy) {
  return with_layout<N>(layout, [&]<Layout L>() { return kernel_of_layout<L, N, W>(name, copy); });
}

template <std::size_t N, std::size_t W>
OutputKernel<N, W> output_kernel(const char* name) {
  const std::string_view wanted(name);
  if constexpr (W == 2) {
    if (wanted == "baseline") return {&baseline::prepare_lanes<N, W>, &baseline::evaluate_output_lanes<N, W>};
  }
#ifdef EPICYCLIC_X86_KERNELS
  if constexpr (W == 4) {
    if (wanted == "avx2" && machine_runs(wanted))
      return {&avx2::prepare_lanes<N, W>, &avx2::evaluate_output_lanes<N, W>};
  }
  if constexpr (W == 8) {
    if (wanted == "avx512" && machine_runs(wanted))
      return {&avx512::prepare_lanes<N, W>, &avx512::evaluate_output_lanes<N, W>};
  }
#endif
  return {};
}

#define EPICYCLIC_DEFINE(N)                                                                  \
  template OutputKernel<N, 2> output_kernel<N, 2>(const char* name);                         \
  template OutputKernel<N, 4> output_kernel<N, 4>(const char* name);                         \
  template OutputKernel<N, 8> output_kernel<N, 8>(const char* name);                         \
  template LaneKernel<N, 2> lane_kernel<N, 2>(Layout layout, const char* name, std::size_t); \
  template LaneKernel<N, 4> lane_kernel<N, 4>(Layout layout, const char* name, std::size_t); \
  template LaneKernel<N, 8> lane_kernel<N, 8>(Layout layout, const char* name, std::size_t);
EPICYCLIC_FOR_PLANETS(EPICYCLIC_DEFINE)
#undef EPICYCLIC_DEFINE
#undef EPICYCLIC_KERNELS_OF
#undef EPICYCLIC_DECLARE_KERNELS

}  // namespace epicyclic::model
