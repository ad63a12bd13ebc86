// The kind of study "claims", as the input reads it.
#pragma once

#include "claims/options.hpp"
#include "input/study_kind.hpp"

namespace epicyclic::claims {

/// Programs that read such studies add it [input::add_kind()]; without `cost`, which belongs to the command.
[[nodiscard]] const input::StudyKind& claims_kind();

/// Its table: keys, units, bounds, meaning.
[[nodiscard]] const input::Table<input::Study>& claims_table();

/// @throws std::bad_any_cast of a study of another kind
[[nodiscard]] const ClaimsOptions& claims_in(const input::Study& study);
[[nodiscard]] ClaimsOptions& claims_in(input::Study& study);

}  // namespace epicyclic::claims
