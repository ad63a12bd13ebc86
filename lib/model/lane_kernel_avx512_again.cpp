#define EPICYCLIC_KERNELS avx512_again
#define EPICYCLIC_LANES 8
#include "model/lane_kernel.inc"
