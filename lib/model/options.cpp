#include "model/options.hpp"

#include "core/require.hpp"

namespace epicyclic::model {

void ModelOptions::validate() const {
  require(clearance_smoothing >= 0.0, "clearance_smoothing", clearance_smoothing, ">= 0");
}

}  // namespace epicyclic::model
