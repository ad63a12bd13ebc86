#define EPICYCLIC_KERNELS avx512
#define EPICYCLIC_KERNELS_NAME "avx512"
#define EPICYCLIC_KERNELS_COPY 0
#define EPICYCLIC_LANES 8
#include "integrate/lane_kernels.inc"
