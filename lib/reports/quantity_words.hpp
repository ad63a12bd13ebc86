// Words of an axis for a number of the input, from its place, so that a new key has words, too.
#pragma once

#include <string>
#include <string_view>

namespace epicyclic::reports {

struct QuantityWords {
  std::string words;  ///< "Planet: bearing stiffness"
  std::string unit;   ///< "N/m"; empty of pure numbers
};

/// @param pointer  JSON pointer to a number of the resolved input
[[nodiscard]] QuantityWords quantity_words(std::string_view pointer);

}  // namespace epicyclic::reports
