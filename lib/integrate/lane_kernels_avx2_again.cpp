#define EPICYCLIC_KERNELS avx2_again
#define EPICYCLIC_KERNELS_NAME "avx2"
#define EPICYCLIC_KERNELS_COPY 1
#define EPICYCLIC_LANES 4
#include "integrate/lane_kernels.inc"
