#define EPICYCLIC_KERNELS avx2
#define EPICYCLIC_KERNELS_NAME "avx2"
#include "integrate/vector_kernels.inc"
