// The results of one point as a record of the journal, and back; exact [record_archive.hpp].
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "studies/sweep.hpp"
#include "studies/tolerance.hpp"

namespace epicyclic::store {

[[nodiscard]] std::vector<std::byte> encode_point(const studies::PointResult& result);

/// @throws DamagedData when the record is not one of encode_point()
[[nodiscard]] studies::PointResult decode_point(std::span<const std::byte> record);

/// From the first bytes of a record: the Poincare section comes last.
/// @returns nothing if the bytes are too few
[[nodiscard]] std::optional<studies::PointSummary> decode_point_beginning(std::span<const std::byte> beginning);

/// All of a point of a tolerance study.
[[nodiscard]] std::vector<std::byte> encode_tolerance_point(const studies::TolerancePoint& point);

/// @throws DamagedData when the record is not one of encode_tolerance_point()
[[nodiscard]] studies::TolerancePoint decode_tolerance_point(std::span<const std::byte> record);

/// A list of numbers; the caller gives them a meaning.
[[nodiscard]] std::vector<std::byte> encode_numbers(std::span<const double> numbers);

/// @throws DamagedData when the record is not one of encode_numbers() of so many
[[nodiscard]] std::vector<double> decode_numbers(std::span<const std::byte> record, std::size_t count);

}  // namespace epicyclic::store
