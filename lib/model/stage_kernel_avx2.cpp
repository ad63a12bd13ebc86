#define EPICYCLIC_KERNELS avx2
#include "model/stage_kernel.inc"
