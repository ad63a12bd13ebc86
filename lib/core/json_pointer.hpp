// Places in a JSON text, as RFC 6901 writes them.
#pragma once

#include <string_view>

namespace epicyclic {

/// Is `pointer` the same as `ancestor` or below it?
[[nodiscard]] inline bool pointer_within(std::string_view pointer, std::string_view ancestor) {
  return pointer.starts_with(ancestor) && (pointer.size() == ancestor.size() || pointer[ancestor.size()] == '/');
}

}  // namespace epicyclic
