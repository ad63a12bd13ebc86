#define EPICYCLIC_KERNELS avx512
#define EPICYCLIC_LANES 8
#include "model/lane_kernel.inc"
