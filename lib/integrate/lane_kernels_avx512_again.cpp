#define EPICYCLIC_KERNELS avx512_again
#define EPICYCLIC_KERNELS_NAME "avx512"
#define EPICYCLIC_KERNELS_COPY 1
#define EPICYCLIC_LANES 8
#include "integrate/lane_kernels.inc"
