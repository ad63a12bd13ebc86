#define EPICYCLIC_KERNELS avx2
#define EPICYCLIC_LANES 4
#include "model/lane_kernel.inc"
