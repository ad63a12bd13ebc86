// The constants that a model's right-hand side was made with, for those who know the number of planets.
#pragma once

#include <cstddef>
#include <memory>
#include <utility>

#include "model/dynamic_model.hpp"
#include "model/parameters.hpp"

namespace epicyclic::model {

template <std::size_t N>
struct FoldedConstants : StageConstants {
  explicit FoldedConstants(Parameters<double, N> p) : parameters(std::move(p)) {}
  Parameters<double, N> parameters;
};

/// Those of a model of N planets; null of one that has others, or none.
template <std::size_t N>
[[nodiscard]] std::shared_ptr<const Parameters<double, N>> constants_of(const DynamicModel& model) {
  const auto constants = std::dynamic_pointer_cast<const FoldedConstants<N>>(model.constants);
  return constants ? std::shared_ptr<const Parameters<double, N>>(constants, &constants->parameters) : nullptr;
}

}  // namespace epicyclic::model
