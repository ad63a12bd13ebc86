// The derivative of a smooth function from its values near by.
#pragma once

#include <array>

namespace epicyclic {

/// f'(x) from f(x - 2 h), f(x - h), f(x + h), f(x + 2 h): error h^4 f^(5)(x) / 30.
[[nodiscard]] constexpr double central_derivative(const std::array<double, 4>& f, double h) {
  return (8.0 * (f[2] - f[1]) - (f[3] - f[0])) / (12.0 * h);
}

}  // namespace epicyclic
