#include "model/friction_track.hpp"

namespace epicyclic::model {

namespace {

std::vector<TrackRow<3>> rows_of(const gear::FrictionTable& table, double driving_radius_mm, double driven_radius_mm) {
  std::vector<TrackRow<3>> rows;
  for (std::size_t k = 0; k < table.phase.size(); ++k)
    rows.push_back({table.phase[k],
                    {table.force_ratio[k], table.moment_driving_mm[k] / driving_radius_mm,
                     table.moment_driven_mm[k] / driven_radius_mm}});
  return rows;
}

}  // namespace

FrictionTrack::FrictionTrack(const gear::FrictionTable& table, double lead, double driving_radius_mm,
                             double driven_radius_mm)
    : track_(rows_of(table, driving_radius_mm, driven_radius_mm), table.breakpoints, lead, table.interpolation,
             table.grids),
      grids_(table.grids),
      error_(table.error) {}

PeriodicTrack<1> stiffness_track(const gear::StiffnessCurve& curve, double unit) {
  std::vector<TrackRow<1>> rows;
  for (std::size_t k = 0; k < curve.phase.size(); ++k)
    rows.push_back({curve.phase[k], {curve.stiffness_N_per_m[k] / unit}});
  const bool known = curve.interpolation == Interpolation::smooth && curve.error.has_value();
  return {rows, curve.breakpoints, 0.0, curve.interpolation, {}, known ? rows_per_feature(*curve.error) : 1.0};
}

}  // namespace epicyclic::model
