#define EPICYCLIC_KERNELS baseline
#define EPICYCLIC_LANES 2
#include "model/lane_kernel.inc"
