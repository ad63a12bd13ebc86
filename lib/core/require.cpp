#include "core/require.hpp"

#include <fmt/format.h>

#include "core/errors.hpp"

namespace epicyclic {

void require(bool holds, std::string_view name, double value, std::string_view bound) {
  if (!holds) throw InputError(fmt::format("{} = {}, must be {}", name, value, bound));
}

}  // namespace epicyclic
