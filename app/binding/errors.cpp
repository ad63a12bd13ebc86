#include "core/errors.hpp"

#include <exception>
#include <new>
#include <system_error>

#include "binding.hpp"
#include "command/failure.hpp"
#include "input/json_source.hpp"
#include "store/journal.hpp"

namespace epicyclic::binding {

namespace py = pybind11;

namespace {

template <class... Arguments>
void raise(const char* name, Arguments&&... arguments) {
  const py::object type = py::module_::import("epicyclic._errors").attr(name);
  const py::object error = type(std::forward<Arguments>(arguments)...);
  PyErr_SetObject(type.ptr(), error.ptr());
}

py::list problems_of(const input::InputProblems& error) {
  py::list problems;
  for (const input::Problem& p : error.problems())
    problems.append(py::make_tuple(p.file, p.line, p.pointer, p.message));
  return problems;
}

void translate(std::exception_ptr error) {
  if (!error) return;
  try {
    std::rethrow_exception(error);
  } catch (const input::InputProblems& e) {
    raise("InputError", e.what(), problems_of(e));
  } catch (const InputError& e) {
    raise("InputError", e.what());
  } catch (const OutputError& e) {
    raise("OutputError", e.what());
  } catch (const store::DamagedData& e) {
    raise("OutputError", e.what());
  } catch (const store::JournalInUse& e) {
    raise("OutputError", e.what());
  } catch (const SolverError& e) {
    raise("NumericalError", e.what());
  } catch (const DomainError& e) {
    raise("NumericalError", e.what());
  } catch (const std::bad_alloc&) {
    PyErr_SetString(PyExc_MemoryError, app::out_of_memory);
  } catch (const std::system_error& e) {
    raise("OutputError", e.what());
  }
}

}  // namespace

void add_errors() { py::register_local_exception_translator(&translate); }

}  // namespace epicyclic::binding
