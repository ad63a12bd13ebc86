#define EPICYCLIC_KERNELS avx512
#define EPICYCLIC_KERNELS_NAME "avx512"
#include "integrate/vector_kernels.inc"
