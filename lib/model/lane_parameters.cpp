#include "model/lane_parameters.hpp"

namespace epicyclic::model {

#define EPICYCLIC_INSTANTIATE(N)       \
  template class LaneParameters<N, 2>; \
  template class LaneParameters<N, 4>; \
  template class LaneParameters<N, 8>;
EPICYCLIC_FOR_PLANETS(EPICYCLIC_INSTANTIATE)
#undef EPICYCLIC_INSTANTIATE

}  // namespace epicyclic::model
