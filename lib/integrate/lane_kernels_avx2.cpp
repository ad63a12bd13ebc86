#define EPICYCLIC_KERNELS avx2
#define EPICYCLIC_KERNELS_NAME "avx2"
#define EPICYCLIC_KERNELS_COPY 0
#define EPICYCLIC_LANES 4
#include "integrate/lane_kernels.inc"
