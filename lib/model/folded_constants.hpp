// The source of a stage's vector field, for lanes, which know the number of planets.
#pragma once

#include <cstddef>
#include <memory>
#include <utility>

#include "core/vector_field.hpp"
#include "model/layout.hpp"
#include "model/parameters.hpp"

namespace epicyclic::model {

template <std::size_t N>
struct FoldedConstants : Origin {
  FoldedConstants(Layout l, Parameters<double, N> p) : layout(l), parameters(std::move(p)) {}
  Layout layout;
  Parameters<double, N> parameters;
};

/// Those of a field of a stage in that layout with N planets; null of any other.
template <std::size_t N>
[[nodiscard]] std::shared_ptr<const Parameters<double, N>> constants_of(const VectorField& field, Layout layout) {
  const auto constants = std::dynamic_pointer_cast<const FoldedConstants<N>>(field.origin);
  if (!constants || constants->layout != layout) return nullptr;
  return {constants, &constants->parameters};
}

}  // namespace epicyclic::model
