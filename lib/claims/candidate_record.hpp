// An evaluated candidate of a search for parameters as a record of the journal, and back; exact [record_archive.hpp].
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "claims/calibration.hpp"

namespace epicyclic::claims {

[[nodiscard]] std::vector<std::byte> encode_candidate(const EvaluatedCandidate& candidate);

/// @throws DamagedData when the record is not one of encode_candidate()
[[nodiscard]] EvaluatedCandidate decode_candidate(std::span<const std::byte> record);

}  // namespace epicyclic::claims
