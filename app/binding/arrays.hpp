// Arrays of numbers from Python, checked, and to it.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include "core/errors.hpp"

namespace epicyclic::binding {

/// In the order of C.
using Array = pybind11::array_t<double, pybind11::array::c_style | pybind11::array::forcecast>;

inline std::string shape_text(const pybind11::array& array) {
  return pybind11::str(array.attr("shape")).cast<std::string>();
}

/// @throws InputError for what is no array of real numbers, or has one that is not finite
inline Array finite_array(const pybind11::object& given, const std::string& name) {
  const pybind11::array any = pybind11::array::ensure(given);
  if (!any) {
    PyErr_Clear();
    throw InputError(name + " is no array of numbers");
  }
  if (const char kind = any.dtype().kind(); kind != 'f' && kind != 'i' && kind != 'u')
    throw InputError(name + " has elements of type " + pybind11::str(any.dtype()).cast<std::string>() +
                     ", not real numbers");
  Array numbers = Array::ensure(any);  // which clears the error of Python
  if (!numbers) throw InputError(name + " has the shape " + shape_text(any) + ", which cannot be copied");
  for (pybind11::ssize_t i = 0; i < numbers.size(); ++i)
    if (!std::isfinite(numbers.data()[i])) throw InputError(name + " has numbers that are not finite");
  return numbers;
}

/// Of shape (size,).
inline std::vector<double> finite_vector(const pybind11::object& given, const std::string& name, std::size_t size) {
  const Array numbers = finite_array(given, name);
  if (numbers.ndim() != 1 || numbers.size() != static_cast<pybind11::ssize_t>(size))
    throw InputError(name + " has the shape " + shape_text(numbers) + ", not (" + std::to_string(size) + ",)");
  return {numbers.data(), numbers.data() + numbers.size()};
}

inline Array array_of(const std::vector<double>& values) {
  return Array(static_cast<pybind11::ssize_t>(values.size()), values.data());
}

/// @param columns  0 of no values is allowed
inline Array matrix_of(const std::vector<double>& values, std::size_t columns) {
  const auto rows = columns == 0 ? 0 : static_cast<pybind11::ssize_t>(values.size() / columns);
  return Array({rows, static_cast<pybind11::ssize_t>(columns)}, values.data());
}

}  // namespace epicyclic::binding
