// One step of a tree of branches as a record of the journal, and back; exact [record_archive.hpp].
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "analysis/bifurcation_diagram.hpp"
#include "studies/branch_search.hpp"
#include "studies/loci.hpp"

namespace epicyclic::store {

[[nodiscard]] std::vector<std::byte> encode_step(const analysis::TreeStep& step);

/// @throws DamagedData when the record is not one of encode_step()
[[nodiscard]] analysis::TreeStep decode_step(std::span<const std::byte> record);

/// A locus, whole.
[[nodiscard]] std::vector<std::byte> encode_locus(const studies::TracedLocus& locus);

/// @throws DamagedData when the record is not one of encode_locus()
[[nodiscard]] studies::TracedLocus decode_locus(std::span<const std::byte> record);

/// What a search has found at one value.
[[nodiscard]] std::vector<std::byte> encode_found(const studies::CoexistingOrbits& found);

/// @throws DamagedData when the record is not one of encode_found()
[[nodiscard]] studies::CoexistingOrbits decode_found(std::span<const std::byte> record);

/// A value with the exact clearance, if there is one, and the note on its point.
[[nodiscard]] std::vector<std::byte> encode_exact(const std::optional<analysis::ExactValue>& exact,
                                                  const std::string& note);

/// @throws DamagedData when the record is not one of encode_exact()
[[nodiscard]] std::optional<analysis::ExactValue> decode_exact(std::span<const std::byte> record, std::string& note);

}  // namespace epicyclic::store
