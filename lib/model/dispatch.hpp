// Conversion of a number of planets and of a layout at run time to those of a template.
#pragma once

#include <cstddef>
#include <string>

#include "core/errors.hpp"
#include "model/layout.hpp"

namespace epicyclic::model {

/// f.template operator()<N>() for the number of planets at run time.
/// @throws InputError when there is no code for so many
template <class F>
auto with_planets(int planets, const F& f) {
  switch (planets) {
    case 1:
      return f.template operator()<1>();
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
      throw InputError("planets: " + std::to_string(planets) + " is not in 1 to 6");
  }
}

/// f.template operator()<L>() for the layout at run time of N planets; a value made by default for full coordinates.
template <std::size_t N, class F>
auto with_layout(Layout layout, const F& f) {
  switch (layout) {
    case Layout::relative_to_ring:
      if constexpr (N > 1) return f.template operator()<Layout::relative_to_ring>();
      break;
    case Layout::relative_to_carrier:
      if constexpr (N > 1) return f.template operator()<Layout::relative_to_carrier>();
      break;
    case Layout::relative_to_carrier_rigid_ring:
      if constexpr (N > 1) return f.template operator()<Layout::relative_to_carrier_rigid_ring>();
      break;
    case Layout::pair:
      if constexpr (N == 1) return f.template operator()<Layout::pair>();
      break;
    case Layout::pair_supported:
      if constexpr (N == 1) return f.template operator()<Layout::pair_supported>();
      break;
    case Layout::pair_torsional:
      if constexpr (N == 1) return f.template operator()<Layout::pair_torsional>();
      break;
    case Layout::pair_torsional_supported:
      if constexpr (N == 1) return f.template operator()<Layout::pair_torsional_supported>();
      break;
    case Layout::full:
      break;
  }
  constexpr Layout any = N == 1 ? Layout::pair : Layout::relative_to_ring;
  return decltype(f.template operator()<any>()){};
}

}  // namespace epicyclic::model
