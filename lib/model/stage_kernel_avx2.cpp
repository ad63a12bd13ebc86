#define EPICYCLIC_KERNELS avx2
#define EPICYCLIC_FOUR_DIRECTIONS
#include "model/stage_kernel.inc"
