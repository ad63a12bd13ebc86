// The kind of study "claims", as the input knows it.
#pragma once

#include "claims/options.hpp"
#include "input/study_kind.hpp"

namespace epicyclic::claims {

/// To be added by whoever reads such studies [input::add_kind()]; without `cost`, which is the command's.
[[nodiscard]] const input::StudyKind& claims_kind();

/// Its table: keys, units, bounds, meaning.
[[nodiscard]] const input::Table<input::Study>& claims_table();

/// @throws std::bad_any_cast of a study of another kind
[[nodiscard]] const ClaimsOptions& claims_in(const input::Study& study);
[[nodiscard]] ClaimsOptions& claims_in(input::Study& study);

}  // namespace epicyclic::claims
