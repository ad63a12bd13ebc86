// Why an input with a helix angle is refused.
#pragma once

namespace epicyclic::input {

inline constexpr const char* no_helix =
    "the model is of spur gears that move in their plane; a helix adds axial forces and tilting, which it does not "
    "have. Leave the helix angle out for spur gears; helical gears need a three-dimensional model";

}  // namespace epicyclic::input
