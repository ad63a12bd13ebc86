#include "binding.hpp"
#include "command/claims/claims_commands.hpp"
#include "command/commands.hpp"
#include "core/version.hpp"
#include "input/study_input.hpp"

PYBIND11_MODULE(_core, module) {
  namespace binding = epicyclic::binding;
  module.doc() = "The program epicyclic as a module; the package's classes are made of it.";
  epicyclic::app::add_claims_kind();
  binding::add_errors();
  binding::add_inputs(module);
  binding::add_jobs(module);
  binding::add_systems(module);
  module.attr("__version__") = EPICYCLIC_VERSION;
  module.def("version_text", &epicyclic::app::version_text);
  module.def("schema_text", &epicyclic::input::schema_text);
}
