#include "studies/stage_lanes.hpp"

#include "integrate/lanes/lane_ensemble.hpp"
#include "model/lane_field.hpp"

namespace epicyclic::studies {

LaneField stage_lanes(const model::DynamicModel& like, const integrate::StepLoops& loops, std::size_t vectors) {
  LaneField lanes = model::make_lane_field(like, loops.name, loops.copy, vectors);
  if (lanes.width == loops.width) return lanes;
  if (vectors > 0) return {};
  return integrate::one_by_one(loops.width, like.dimension, like.surfaces.count);
}

integrate::LanePool stage_pool(const model::DynamicModel& like, const integrate::IntegratorOptions& integrator,
                               const integrate::StepLoops& loops) {
  return {[&like, &loops](std::size_t vectors) { return stage_lanes(like, loops, vectors); }, integrator, loops};
}

}  // namespace epicyclic::studies
