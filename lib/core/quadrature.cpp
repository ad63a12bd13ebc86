#include "core/quadrature.hpp"

#include <memory>
#include <stdexcept>

#include <gsl/gsl_integration.h>

namespace epicyclic {

GaussLegendre::GaussLegendre(int points) {
  if (points < 1) throw std::invalid_argument("GaussLegendre: points must be at least 1");
  const auto count = static_cast<std::size_t>(points);
  const std::unique_ptr<gsl_integration_glfixed_table, decltype(&gsl_integration_glfixed_table_free)> table(
      gsl_integration_glfixed_table_alloc(count), &gsl_integration_glfixed_table_free);
  nodes_.resize(count);
  weights_.resize(count);
  for (std::size_t k = 0; k < count; ++k)
    gsl_integration_glfixed_point(-1.0, 1.0, k, &nodes_[k], &weights_[k], table.get());
}

const GaussLegendre& gauss_legendre_16() {
  static const GaussLegendre rule(16);
  return rule;
}

}  // namespace epicyclic
