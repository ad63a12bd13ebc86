#include "model/kernels/stage_kernel.hpp"

#include <string_view>

#include "core/instruction_set.hpp"

namespace epicyclic::model {

#define EPICYCLIC_DECLARE_KERNELS                                                                              \
  template <Layout L, std::size_t N>                                                                           \
  void evaluate(const Parameters<double, N>& p, std::size_t segment, double s, const double* y, double* dyds); \
  template <Layout L, std::size_t N, std::size_t M>                                                            \
  void evaluate_tangents(const Parameters<double, N>& p, std::size_t segment, double s, const Dual<M>* y,      \
                         Dual<M>* dyds);
#define EPICYCLIC_DECLARE(L, N)                                                                                      \
  extern template void evaluate<L, N>(const Parameters<double, N>&, std::size_t, double, const double*, double*);    \
  extern template void evaluate_tangents<L, N, 1>(const Parameters<double, N>&, std::size_t, double, const Dual<1>*, \
                                                  Dual<1>*);
#define EPICYCLIC_DECLARE_FOUR(L, N)                                                                                 \
  extern template void evaluate_tangents<L, N, 4>(const Parameters<double, N>&, std::size_t, double, const Dual<4>*, \
                                                  Dual<4>*);
namespace baseline {
EPICYCLIC_DECLARE_KERNELS
EPICYCLIC_FOR_KERNELS(EPICYCLIC_DECLARE)
}  // namespace baseline
#ifdef EPICYCLIC_X86_KERNELS
namespace avx2 {
EPICYCLIC_DECLARE_KERNELS
EPICYCLIC_FOR_KERNELS(EPICYCLIC_DECLARE)
EPICYCLIC_FOR_KERNELS(EPICYCLIC_DECLARE_FOUR)
}  // namespace avx2
#endif
/// Of full coordinates [full_coordinates.cpp].
namespace plain {
template <std::size_t N>
void evaluate(const Parameters<double, N>& p, std::size_t segment, double s, const double* y, double* dyds);
template <std::size_t N>
void evaluate_tangents(const Parameters<double, N>& p, std::size_t segment, double s, const Dual<1>* y, Dual<1>* dyds);
}  // namespace plain
#undef EPICYCLIC_DECLARE
#undef EPICYCLIC_DECLARE_FOUR
#undef EPICYCLIC_DECLARE_KERNELS

template <Layout L, std::size_t N>
StageKernel<N> stage_kernel(const char* name) {
  const std::string_view wanted(name);
  if constexpr (L == Layout::full) {
    if (wanted == "baseline") return &plain::evaluate<N>;
  } else {
    if (wanted == "baseline") return &baseline::evaluate<L, N>;
#ifdef EPICYCLIC_X86_KERNELS
    if (wanted == "avx2" && machine_runs(wanted)) return &avx2::evaluate<L, N>;
#endif
  }
  return nullptr;
}

template <Layout L, std::size_t N>
StageKernel<N> stage_kernel() {
  if (const StageKernel<N> kernel = stage_kernel<L, N>("avx2")) return kernel;
  return stage_kernel<L, N>("baseline");
}

template <Layout L, std::size_t N, std::size_t M>
TangentKernel<N, M> tangent_kernel(const char* name) {
  const std::string_view wanted(name);
  if constexpr (L == Layout::full) {
    if constexpr (M == 1) {
      if (wanted == "baseline") return &plain::evaluate_tangents<N>;
    }
  } else {
    if constexpr (M == 1) {
      if (wanted == "baseline") return &baseline::evaluate_tangents<L, N, M>;
    }
#ifdef EPICYCLIC_X86_KERNELS
    if (wanted == "avx2" && machine_runs(wanted)) return &avx2::evaluate_tangents<L, N, M>;
#endif
  }
  return nullptr;
}

template <Layout L, std::size_t N, std::size_t M>
TangentKernel<N, M> tangent_kernel() {
  if (const TangentKernel<N, M> kernel = tangent_kernel<L, N, M>("avx2")) return kernel;
  return tangent_kernel<L, N, M>("baseline");
}

#define EPICYCLIC_INSTANTIATE(L, N)                                  \
  template StageKernel<N> stage_kernel<L, N>();                      \
  template StageKernel<N> stage_kernel<L, N>(const char*);           \
  template TangentKernel<N, 1> tangent_kernel<L, N, 1>();            \
  template TangentKernel<N, 1> tangent_kernel<L, N, 1>(const char*); \
  template TangentKernel<N, 4> tangent_kernel<L, N, 4>();            \
  template TangentKernel<N, 4> tangent_kernel<L, N, 4>(const char*);
EPICYCLIC_FOR_ALL_LAYOUTS(EPICYCLIC_INSTANTIATE)
#undef EPICYCLIC_INSTANTIATE

}  // namespace epicyclic::model
