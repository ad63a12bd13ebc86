// The kernels of lanes that this machine runs.
#pragma once

#include <vector>

#include "core/instruction_set.hpp"
#include "integrate/lanes/step_loops.hpp"

namespace epicyclic::problems {

/// Every copy for every instruction set, the baseline first.
inline std::vector<const integrate::StepLoops*> lane_sets() {
  std::vector<const integrate::StepLoops*> all{integrate::step_loops("baseline")};
  for (const char* name : {"avx2", "avx512"})
    for (std::size_t copy = 0; copy < kernel_copies; ++copy)
      if (const integrate::StepLoops* kernels = integrate::step_loops(name, copy)) all.push_back(kernels);
  return all;
}

}  // namespace epicyclic::problems
