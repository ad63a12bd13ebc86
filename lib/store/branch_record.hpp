// One step of a tree of branches as a record of the journal, and back; exact [record_archive.hpp].
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "analysis/branch_tree.hpp"

namespace epicyclic::store {

[[nodiscard]] std::vector<std::byte> encode_step(const analysis::TreeStep& step);

/// @throws DamagedData when the record is not one of encode_step()
[[nodiscard]] analysis::TreeStep decode_step(std::span<const std::byte> record);

}  // namespace epicyclic::store
