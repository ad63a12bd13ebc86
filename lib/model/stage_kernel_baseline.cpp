#define EPICYCLIC_KERNELS baseline
#include "model/stage_kernel.inc"
