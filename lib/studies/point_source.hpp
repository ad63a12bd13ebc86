// The points of a study, wherever they are kept.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "studies/sweep.hpp"

namespace epicyclic::studies {

/// Points that writers read one by one, as often as they need: a study may be larger than memory.
struct PointSource {
  std::size_t count = 0;
  std::function<PointResult(std::size_t point)> read;
  std::function<PointSummary(std::size_t point)> read_summary;
};

/// Those of a study of few points; `results` must live longer.
[[nodiscard]] PointSource points_in_memory(std::span<const PointResult> results);

/// Summaries alone: read() is empty, so calling it throws.
[[nodiscard]] PointSource points_in_memory(std::span<const PointSummary> results);

/// All summaries, for studies whose points are small: some 1 KB each.
[[nodiscard]] std::vector<PointSummary> all_summaries(const PointSource& points);

}  // namespace epicyclic::studies
