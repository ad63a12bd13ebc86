// Periodic friction ratios of one mesh, A(s), B_1(s), B_2(s), ready to evaluate.                             [M-AB]
//
// Source: rows from a table or from gear/friction_path, gear/ehl_friction; interpolation and smoothness as in
// model/periodic_track.hpp.
#pragma once

#include <array>
#include <vector>

#include "gear/stage.hpp"
#include "model/periodic_track.hpp"

namespace epicyclic::model {

/// A, B_1 and B_2 at one phase; the moments as ratios to the members' base radii.
template <class T>
struct FrictionRatios {
  T force;           ///< A [-]
  T moment_driving;  ///< B_1 / r_b1 [-]
  T moment_driven;   ///< B_2 / r_b2 [-]
};

class FrictionTrack {
 public:
  using Place = TrackPlace;

  FrictionTrack() = default;

  /// @param table  rows on the mesh's own phase after `lead` is added to its phases [-]
  /// @throws InputError when the rows are not as documented at gear::FrictionTable
  FrictionTrack(const gear::FrictionTable& table, double lead, double driving_radius_mm, double driven_radius_mm);

  /// Breakpoints on the mesh's own phase, rising, in [0, 1).
  [[nodiscard]] const std::vector<double>& breakpoints() const { return track_.breakpoints(); }
  [[nodiscard]] Place place(double phase) const { return track_.place(phase); }

  /// As PeriodicTrack::with_parameter_derivative().
  [[nodiscard]] FrictionTrack with_parameter_derivative(const std::array<const FrictionTrack*, 4>& near,
                                                        double h) const {
    FrictionTrack track;
    track.error_ = error_;
    track.track_ =
        track_.with_parameter_derivative({&near[0]->track_, &near[1]->track_, &near[2]->track_, &near[3]->track_}, h);
    return track;
  }

  /// Ratios at a phase within half a period of the place.
  template <class T>
  [[nodiscard]] FrictionRatios<T> at(const Place& place, const T& phase) const {
    const auto values = track_.at(place, phase);
    return {values[0], values[1], values[2]};
  }

  /// force, moment_driving and moment_driven, for callers that find the interval: PeriodicTrack::at().
  [[nodiscard]] const PeriodicTrack<3>& track() const { return track_; }

  [[nodiscard]] const RowSpacing& spacing() const { return track_.spacing(); }

  /// The grids of the rows between breakpoints, if the rows are computed.
  [[nodiscard]] const std::vector<IntervalGrid>& grids() const { return grids_; }
  /// Greatest error of a ratio between the rows, where they are those of something known [-].
  [[nodiscard]] double error() const { return error_; }

 private:
  PeriodicTrack<3> track_;
  std::vector<IntervalGrid> grids_;
  double error_ = 0;
};

/// Mesh stiffness as a curve over the mesh's own phase, in units of `unit` [N/m].
[[nodiscard]] PeriodicTrack<1> stiffness_track(const gear::StiffnessCurve& curve, double unit);

/// e and de/ds of a curve over the mesh's own phase s / 2 pi, in units of `unit_um`; de/ds is that of the cubics of e.
///                                                                                                       [M-e-curve]
[[nodiscard]] PeriodicTrack<3> error_track(const gear::ErrorCurve& curve, double unit_um);

/// Mean of a stiffness curve, exactly that of its interpolation [N/m].
[[nodiscard]] double mean_stiffness(const gear::StiffnessCurve& curve);

}  // namespace epicyclic::model
