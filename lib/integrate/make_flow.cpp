#include "integrate/make_flow.hpp"

#include <utility>

#include "integrate/lanes/lane_flow.hpp"
#include "integrate/methods.hpp"
#include "integrate/sundials/arkode_flow.hpp"
#include "integrate/sundials/cvode_flow.hpp"

namespace epicyclic::integrate {

std::unique_ptr<Flow> make_flow(VectorField field, const IntegratorOptions& options) {
  const Method& method = method_named(options.method);
  if (method.family == Family::lanes) return make_lane_flow(std::move(field), options);
  return method.multistep() ? make_cvode_flow(std::move(field), options) : make_arkode_flow(std::move(field), options);
}

FlowFamily make_flow_family(FieldFamily fields, const IntegratorOptions& options) {
  options.validate();
  return [fields = std::move(fields), options](double value) { return make_flow(fields(value), options); };
}

}  // namespace epicyclic::integrate
