// Conversion of a number of planets at run time to that of a template.
#pragma once

#include <cstddef>
#include <string>

#include "core/errors.hpp"

namespace epicyclic::model {

/// f.template operator()<N>() for the number of planets at run time.
/// @throws InputError when there is no code for so many
template <class F>
auto with_planets(int planets, const F& f) {
  switch (planets) {
    case 2:
      return f.template operator()<2>();
    case 3:
      return f.template operator()<3>();
    case 4:
      return f.template operator()<4>();
    case 5:
      return f.template operator()<5>();
    case 6:
      return f.template operator()<6>();
    default:
      throw InputError("planets: " + std::to_string(planets) + " is not in 2 to 6");
  }
}

}  // namespace epicyclic::model
