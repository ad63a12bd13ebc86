// The table of catalogue data of a stage (gear/catalogue.hpp): keys, units, bounds, meaning.
#pragma once

#include "gear/catalogue.hpp"
#include "input/field_table.hpp"

namespace epicyclic::input {

/// Bounds far beyond any gear, on both sides. They detect a wrong unit and keep sums, squares and quotients finite.
inline constexpr double length_min_mm = 1e-6;
inline constexpr double length_max_mm = 1e6;

/// Of computed tables. No number of rows meets a tolerance below rounding.
inline const Bounds table_tolerance = between(1e-13, 1e-2);

[[nodiscard]] const Table<gear::Catalogue>& catalogue_table();

}  // namespace epicyclic::input
