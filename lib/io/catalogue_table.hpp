// The table of catalogue data of a stage (gear/catalogue.hpp): keys, units, bounds, meaning.
#pragma once

#include "gear/catalogue.hpp"
#include "io/field_table.hpp"

namespace epicyclic::io {

[[nodiscard]] const Table<gear::Catalogue>& catalogue_table();

}  // namespace epicyclic::io
