// What the meshes of a motion do over some periods: extrema, contact, tension, differences between planets.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "model/dynamic_model.hpp"

namespace epicyclic::studies {

/// What was seen of one mesh over some periods.
struct MeshRecord {
  double delta_min = 0, delta_max = 0;  ///< extrema at the dense output phases [b_c]
  bool drive = false, loss = false, back = false;
  double pull = 0;       ///< greatest tension [model::DynamicModel::pull()], over the static force of a sun mesh [-]
  double pull_time = 0;  ///< part of the time that there is tension [-]

  /// "drive+loss" and so on.
  [[nodiscard]] std::string contact() const;
};

struct MeshRecords {
  std::vector<MeshRecord> sun_planet;   ///< one per planet
  std::vector<MeshRecord> ring_planet;  ///< one per planet
  double planet_spread = 0;             ///< largest difference between planets' deflections of one kind of mesh [b_c]
};

/// Sees a motion at phases of its dense output.
class MeshWatch {
 public:
  /// @param model  must live longer
  explicit MeshWatch(const model::DynamicModel& model);

  void see(double s, std::span<const double> y);

  /// What was seen.
  [[nodiscard]] MeshRecords finished() const;

 private:
  void see_meshes(const std::vector<double>& delta, const std::vector<double>& pulls, double half_gap,
                  std::vector<MeshRecord>& records);

  const model::DynamicModel& model_;
  MeshRecords records_;
  model::MeshDeflections now_;
  model::MeshPulls pulls_;
  long seen_ = 0;
};

}  // namespace epicyclic::studies
