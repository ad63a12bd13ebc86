#include "model/stage_kernel.hpp"

#include <string_view>

namespace epicyclic::model {

#define EPICYCLIC_DECLARE(L, N) \
  extern template void evaluate<L, N>(const Parameters<double, N>&, std::size_t, double, const double*, double*);
namespace baseline {
template <Layout L, std::size_t N>
void evaluate(const Parameters<double, N>& p, std::size_t segment, double s, const double* y, double* dyds);
EPICYCLIC_FOR_STAGE_KERNELS(EPICYCLIC_DECLARE)
}  // namespace baseline
#ifdef EPICYCLIC_X86_KERNELS
namespace avx2 {
template <Layout L, std::size_t N>
void evaluate(const Parameters<double, N>& p, std::size_t segment, double s, const double* y, double* dyds);
EPICYCLIC_FOR_STAGE_KERNELS(EPICYCLIC_DECLARE)
}  // namespace avx2
#endif
#undef EPICYCLIC_DECLARE

template <Layout L, std::size_t N>
StageKernel<N> stage_kernel(const char* name) {
  const std::string_view wanted(name);
  if (wanted == "baseline") return &baseline::evaluate<L, N>;
#ifdef EPICYCLIC_X86_KERNELS
  if (wanted == "avx2" && __builtin_cpu_supports("avx2") != 0) return &avx2::evaluate<L, N>;
#endif
  return nullptr;
}

template <Layout L, std::size_t N>
StageKernel<N> stage_kernel() {
  if (const StageKernel<N> kernel = stage_kernel<L, N>("avx2")) return kernel;
  return stage_kernel<L, N>("baseline");
}

#define EPICYCLIC_INSTANTIATE(L, N)             \
  template StageKernel<N> stage_kernel<L, N>(); \
  template StageKernel<N> stage_kernel<L, N>(const char*);
EPICYCLIC_FOR_STAGE_KERNELS(EPICYCLIC_INSTANTIATE)
#undef EPICYCLIC_INSTANTIATE

}  // namespace epicyclic::model
