#include "studies/point_source.hpp"

namespace epicyclic::studies {

PointSource points_in_memory(std::span<const PointResult> results) {
  const auto read = [results](std::size_t point) { return results[point]; };
  return {results.size(), read, read};
}

PointSource points_in_memory(std::span<const PointSummary> results) {
  return {results.size(), nullptr, [results](std::size_t point) { return results[point]; }};
}

std::vector<PointSummary> all_summaries(const PointSource& points) {
  std::vector<PointSummary> all;
  all.reserve(points.count);
  for (std::size_t i = 0; i < points.count; ++i) all.push_back(points.read_summary(i));
  return all;
}

}  // namespace epicyclic::studies
