// From a layout and a number of planets at run time to those of a template.
#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>

#include "core/errors.hpp"
#include "model/layout.hpp"

namespace epicyclic::model {

/// f.template operator()<L, N>() for the layout and number of planets at run time.
template <class F>
auto dispatch(Layout layout, int planets, const F& f) {
  const auto with_layout = [&]<Layout L>() {
    switch (planets) {
      case 2:
        return f.template operator()<L, 2>();
      case 3:
        return f.template operator()<L, 3>();
      case 4:
        return f.template operator()<L, 4>();
      case 5:
        return f.template operator()<L, 5>();
      case 6:
        return f.template operator()<L, 6>();
      default:
        throw InputError("planets: " + std::to_string(planets) + " is not in 2 to 6");
    }
  };
  switch (layout) {
    case Layout::relative_to_ring:
      return with_layout.template operator()<Layout::relative_to_ring>();
    case Layout::relative_to_carrier:
      return with_layout.template operator()<Layout::relative_to_carrier>();
    case Layout::relative_to_carrier_rigid_ring:
      return with_layout.template operator()<Layout::relative_to_carrier_rigid_ring>();
    case Layout::full:
      return with_layout.template operator()<Layout::full>();
  }
  throw std::logic_error("unknown layout");
}

}  // namespace epicyclic::model
