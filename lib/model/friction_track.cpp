#include "model/friction_track.hpp"

#include <cmath>
#include <numbers>

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

namespace {

template <class Curve>
double rows_per_feature_of(const Curve& curve) {
  const bool known = curve.interpolation == Interpolation::smooth && curve.error.has_value();
  return known ? rows_per_feature(*curve.error) : 1.0;
}

}  // namespace

PeriodicTrack<1> stiffness_track(const gear::StiffnessCurve& curve, double unit) {
  std::vector<TrackRow<1>> rows;
  for (std::size_t k = 0; k < curve.phase.size(); ++k)
    rows.push_back({curve.phase[k], {curve.stiffness_N_per_m[k] / unit}});
  return {rows, curve.breakpoints, 0.0, curve.interpolation, {}, rows_per_feature_of(curve)};
}

PeriodicTrack<3> error_track(const gear::ErrorCurve& curve, double unit_um) {
  constexpr double phase_per_radian = 0.5 * std::numbers::inv_pi;
  std::vector<TrackRow<3>> rows;
  for (std::size_t k = 0; k < curve.phase.size(); ++k)
    rows.push_back({curve.phase[k], {curve.error_um[k] / unit_um, 0.0, 0.0}});
  return with_slope({rows, curve.breakpoints, 0.0, curve.interpolation, {}, rows_per_feature_of(curve)},
                    phase_per_radian);
}

double mean_stiffness(const gear::StiffnessCurve& curve) {
  const PeriodicTrack<1> track = stiffness_track(curve, 1.0);
  double mean = 0.0;
  for (std::size_t k = 0; k < curve.phase.size(); ++k) {
    const double from = curve.phase[k];
    const double to = k + 1 < curve.phase.size() ? curve.phase[k + 1] : curve.phase.front() + 1.0;
    if (to == from) continue;  // a jump
    const double middle = 0.5 * (from + to);
    const TrackPlace place = track.place(middle - std::floor(middle));
    // Simpson's rule is exact for cubics.
    mean += (to - from) / 6.0 * (track.at(place, from)[0] + 4.0 * track.at(place, middle)[0] + track.at(place, to)[0]);
  }
  return mean;
}

}  // namespace epicyclic::model
