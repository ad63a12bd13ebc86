#define EPICYCLIC_KERNELS avx2_again
#define EPICYCLIC_LANES 4
#include "model/lane_kernel.inc"
