#include "model/kernels/stage_kernel.hpp"

#include <string_view>

#include "core/instruction_set.hpp"
#include "model/dispatch.hpp"

namespace epicyclic::model {

#define EPICYCLIC_DECLARE_TANGENTS                                                                     \
  template <std::size_t N, std::size_t M>                                                              \
  void evaluate_tangents(Layout layout, const Parameters<double, N>& p, std::size_t segment, double s, \
                         const Dual<M>* y, Dual<M>* dyds);
namespace baseline {
template <std::size_t N>
void evaluate(Layout layout, const Parameters<double, N>& p, std::size_t segment, double s, const double* y,
              double* dyds);
EPICYCLIC_DECLARE_TANGENTS
}  // namespace baseline
#ifdef EPICYCLIC_X86_KERNELS
namespace avx2 {
template <Layout L, std::size_t N>
void evaluate(Layout layout, const Parameters<double, N>& p, std::size_t segment, double s, const double* y,
              double* dyds);
EPICYCLIC_DECLARE_TANGENTS
}  // namespace avx2
#endif
#undef EPICYCLIC_DECLARE_TANGENTS

template <std::size_t N>
StageKernel<N> stage_kernel([[maybe_unused]] Layout layout, const char* name) {
  const std::string_view wanted(name);
  if (wanted == "baseline") return &baseline::evaluate<N>;
#ifdef EPICYCLIC_X86_KERNELS
  if (wanted == "avx2" && machine_runs(wanted))
    return with_layout<N>(layout, []<Layout L>() -> StageKernel<N> { return &avx2::evaluate<L, N>; });
#endif
  return nullptr;
}

template <std::size_t N>
StageKernel<N> stage_kernel(Layout layout) {
  if (const StageKernel<N> kernel = stage_kernel<N>(layout, "avx2")) return kernel;
  return stage_kernel<N>(layout, "baseline");
}

template <std::size_t N, std::size_t M>
TangentKernel<N, M> tangent_kernel(const char* name) {
  const std::string_view wanted(name);
  if constexpr (M == 1) {
    if (wanted == "baseline") return &baseline::evaluate_tangents<N, M>;
  }
#ifdef EPICYCLIC_X86_KERNELS
  if (wanted == "avx2" && machine_runs(wanted)) return &avx2::evaluate_tangents<N, M>;
#endif
  return nullptr;
}

template <std::size_t N, std::size_t M>
TangentKernel<N, M> tangent_kernel() {
  if (const TangentKernel<N, M> kernel = tangent_kernel<N, M>("avx2")) return kernel;
  return tangent_kernel<N, M>("baseline");
}

#define EPICYCLIC_INSTANTIATE(N)                                  \
  template StageKernel<N> stage_kernel<N>(Layout);                \
  template StageKernel<N> stage_kernel<N>(Layout, const char*);   \
  template TangentKernel<N, 1> tangent_kernel<N, 1>();            \
  template TangentKernel<N, 1> tangent_kernel<N, 1>(const char*); \
  template TangentKernel<N, 4> tangent_kernel<N, 4>();            \
  template TangentKernel<N, 4> tangent_kernel<N, 4>(const char*);
EPICYCLIC_FOR_PLANETS(EPICYCLIC_INSTANTIATE)
#undef EPICYCLIC_INSTANTIATE

}  // namespace epicyclic::model
