// Checks of every Flow on its field and on the samples of an evolution.
#pragma once

#include <span>

#include "core/vector_field.hpp"

namespace epicyclic::integrate {

/// @throws InputError without a state or a right-hand side, for a period that is no number >= 0, and for breakpoints
/// that do not rise or lie outside [0, period); for sampling intervals that are not positive, one for each segment
void check_field(const VectorField& field);

/// @throws InputError unless the samples rise from the start of the evolution
void check_samples(double from, std::span<const double> samples);

}  // namespace epicyclic::integrate
