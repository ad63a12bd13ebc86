#include "core/errors.hpp"

#include <exception>
#include <new>
#include <string>
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

/// Of bytes that need not be UTF-8: texts have parts of files, and may end within a character.
py::str decoded(const std::string& bytes) {
  PyObject* text = PyUnicode_DecodeUTF8(bytes.data(), static_cast<py::ssize_t>(bytes.size()), "replace");
  if (text == nullptr) throw py::error_already_set();
  return py::reinterpret_steal<py::str>(text);
}

py::list problems_of(const input::InputProblems& error) {
  py::list problems;
  for (const input::Problem& p : error.problems())
    problems.append(py::make_tuple(decoded(p.file), p.line, decoded(p.pointer), decoded(p.message)));
  return problems;
}

void translate(std::exception_ptr error) {
  if (!error) return;
  try {
    std::rethrow_exception(error);
  } catch (const input::InputProblems& e) {
    raise("InputError", decoded(e.what()), problems_of(e));
  } catch (const InputError& e) {
    raise("InputError", decoded(e.what()));
  } catch (const OutputError& e) {
    raise("OutputError", decoded(e.what()));
  } catch (const store::DamagedData& e) {
    raise("OutputError", decoded(e.what()));
  } catch (const store::JournalInUse& e) {
    raise("OutputError", decoded(e.what()));
  } catch (const SolverError& e) {
    raise("NumericalError", decoded(e.what()));
  } catch (const DomainError& e) {
    raise("NumericalError", decoded(e.what()));
  } catch (const std::bad_alloc&) {
    PyErr_SetString(PyExc_MemoryError, app::out_of_memory);
  } catch (const std::system_error& e) {
    raise("OutputError", decoded(e.what()));
  }
}

}  // namespace

void add_errors() { py::register_local_exception_translator(&translate); }

}  // namespace epicyclic::binding
