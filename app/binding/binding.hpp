// The parts of the Python module epicyclic._core. What they give is plain: texts of JSON, arrays, lists and dicts. The
// package's Python files make the classes of users of it.
#pragma once

#include <pybind11/pybind11.h>

namespace epicyclic::binding {

/// Exceptions of the library as those of epicyclic/_errors.py.
void add_errors();

void add_inputs(pybind11::module_& module);
void add_jobs(pybind11::module_& module);
void add_systems(pybind11::module_& module);

}  // namespace epicyclic::binding
