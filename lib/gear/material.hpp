// Elastic material of a gear. Defaults: steel.
#pragma once

namespace epicyclic::gear {

struct Material {
  double youngs_modulus_GPa = 206;  ///< E
  double poisson_ratio = 0.3;       ///< nu
  double density_kg_per_m3 = 7850;  ///< rho

  /// E [Pa].
  [[nodiscard]] double youngs_modulus() const { return youngs_modulus_GPa * 1e9; }
  /// G = E / (2 (1 + nu)) [Pa].
  [[nodiscard]] double shear_modulus() const { return youngs_modulus() / (2.0 * (1.0 + poisson_ratio)); }
};

/// E' of Tang et al. 2020, Eq. (8): 2 / ((1 - nu_1^2) / E_1 + (1 - nu_2^2) / E_2) [GPa].                        [G-8]
[[nodiscard]] inline double equivalent_modulus(const Material& first, const Material& second) {
  const auto part = [](const Material& m) { return (1.0 - m.poisson_ratio * m.poisson_ratio) / m.youngs_modulus_GPa; };
  return 2.0 / (part(first) + part(second));
}

}  // namespace epicyclic::gear
