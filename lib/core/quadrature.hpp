// Composite Gauss-Legendre quadrature.
//
//   integral_a^b f dx = sum over panels of (h / 2) sum_k w_k f(x_k) ,  h = (b - a) / panels
//
// Order: the error of a smooth f falls as h^(2n) with n points a panel (a test measures it). Nodes and weights are
// GSL's (gsl_integration_glfixed). Limits: f must be smooth within [a, b]; integrate each smooth part by itself.
#pragma once

#include <cstddef>
#include <type_traits>
#include <vector>

namespace epicyclic {

class GaussLegendre {
 public:
  /// @param points  nodes a panel, n >= 1
  /// @throws std::invalid_argument for n < 1
  explicit GaussLegendre(int points);

  /// @param f  R (double), R a number or an Eigen array of fixed size
  template <class F>
  [[nodiscard]] auto integrate(F f, double a, double b, int panels = 1) const {
    using R = std::decay_t<std::invoke_result_t<F, double>>;
    const double half = 0.5 * (b - a) / panels;
    R sum = 0.0 * f(a + half);
    for (int panel = 0; panel < panels; ++panel) {
      const double middle = a + (2 * panel + 1) * half;
      for (std::size_t k = 0; k < nodes_.size(); ++k) sum += weights_[k] * f(middle + half * nodes_[k]);
    }
    return R(half * sum);
  }

 private:
  std::vector<double> nodes_, weights_;
};

/// 16 points: rounding error on every smooth part in this project with a few panels.
[[nodiscard]] const GaussLegendre& gauss_legendre_16();

}  // namespace epicyclic
