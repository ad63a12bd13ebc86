// Roots of one equation in one unknown, by Brent's method (GSL).
#pragma once

#include <functional>

namespace epicyclic {

/// x in [low, high] with f(x) = 0.
///
/// @param width  of what the root is known to lie in at the end; 0: to the resolution of double
/// @throws DomainError unless low < high; when f has the same sign at both ends, or is not finite
[[nodiscard]] double find_root(const std::function<double(double)>& f, double low, double high, double width = 0.0);

}  // namespace epicyclic
