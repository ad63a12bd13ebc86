// What to say of chaos that coexists with another attractor.
#pragma once

#include <string_view>

namespace epicyclic::reports {

/// A transient may be chaotic for thousands of periods before it reaches a periodic orbit. Nothing distinguishes it
/// from a chaotic attractor until it ends.
inline constexpr std::string_view transient_chaos =
    "chaos beside another attractor may be a long transient; /study/classification_periods sets how long it is "
    "computed";

}  // namespace epicyclic::reports
