// The right-hand side in full coordinates, as the template is: it is there to be compared with.

#include <cstddef>

#include "model/kernels/stage_kernel.hpp"
#include "model/right_hand_side.hpp"

namespace epicyclic::model::plain {

template <std::size_t N>
void evaluate(const Parameters<double, N>& p, std::size_t segment, double s, const double* y, double* dyds) {
  right_hand_side<Layout::full>(p, segment, s, y, dyds);
}

template <std::size_t N>
void evaluate_tangents(const Parameters<double, N>& p, std::size_t segment, double s, const Dual<1>* y, Dual<1>* dyds) {
  right_hand_side<Layout::full>(p, segment, s, y, dyds);
}

#define EPICYCLIC_INSTANTIATE(N)                                                                        \
  template void evaluate<N>(const Parameters<double, N>&, std::size_t, double, const double*, double*); \
  template void evaluate_tangents<N>(const Parameters<double, N>&, std::size_t, double, const Dual<1>*, Dual<1>*);
EPICYCLIC_FOR_PLANETS(EPICYCLIC_INSTANTIATE)
#undef EPICYCLIC_INSTANTIATE

}  // namespace epicyclic::model::plain
