// A flow whose results are kept, so that a computation that was stopped goes on with the same bits.
//
// The computation is begun anew and makes the same calls in the same order. Those whose results an earlier session kept
// are answered from there; the first one that is not known is computed, and all after it. A Flow remembers nothing but
// the state and the length of its next step [integrate/flow.hpp], which a kept result holds.
//
// Limits: explicit Runge-Kutta methods, as of Flow::next_step(). Evolutions with samples are always computed.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "integrate/flow.hpp"

namespace epicyclic::studies {

/// Where the results of one flow are kept.
struct FlowMemory {
  /// The next result of an earlier session, of `numbers` numbers; nothing if it has no more.
  std::function<std::optional<std::vector<double>>(std::size_t numbers)> recall;
  std::function<void(std::span<const double> result)> keep;
};

/// @param memory  without functions: the flow as it is
[[nodiscard]] std::unique_ptr<integrate::Flow> remembered(std::unique_ptr<integrate::Flow> flow, FlowMemory memory);

}  // namespace epicyclic::studies
