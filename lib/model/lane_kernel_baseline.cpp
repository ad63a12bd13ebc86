#define EPICYCLIC_KERNELS baseline
#define EPICYCLIC_LANES 4
#include "model/lane_kernel.inc"
