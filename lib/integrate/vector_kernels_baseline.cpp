#define EPICYCLIC_KERNELS baseline
#define EPICYCLIC_KERNELS_NAME "baseline"
#include "integrate/vector_kernels.inc"
