// Roots of one equation in one unknown, by Brent's method (GSL).
#pragma once

#include <functional>
#include <optional>

namespace epicyclic {

/// x in [low, high] with f(x) = 0.
///
/// @param width  of what the root is known to lie in at the end; 0: to the resolution of double
/// @throws DomainError unless low < high; when f has the same sign at both ends, or is not finite
[[nodiscard]] double find_root(const std::function<double(double)>& f, double low, double high, double width = 0.0);

/// The root of a smooth function near 0 by secants, to what the function resolves.
///
/// @param f       nothing where it has no value
/// @param beside  a second place to begin with
/// @param span    of places: the root is nearer than it, and is resolved to 1e-11 of it
/// @returns the place of the last value of f; nothing if there was no value, or the root is not near
[[nodiscard]] std::optional<double> secant_root(const std::function<std::optional<double>(double)>& f, double beside,
                                                double span);

}  // namespace epicyclic
