// Rules that options keep, for their validate(): one rule a line.
#pragma once

#include <string_view>

namespace epicyclic {

/// @throws InputError "<name> = <value>, must be <bound>" unless the rule holds
void require(bool holds, std::string_view name, double value, std::string_view bound);

}  // namespace epicyclic
