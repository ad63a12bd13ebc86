#define EPICYCLIC_KERNELS baseline
#define EPICYCLIC_KERNELS_NAME "baseline"
#define EPICYCLIC_KERNELS_COPY 0
#define EPICYCLIC_LANES 2
#include "integrate/lane_kernels.inc"
