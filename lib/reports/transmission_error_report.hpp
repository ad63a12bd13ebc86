// The static transmission error of both meshes over the torque: the plot by which reliefs are chosen.
#pragma once

#include <string>
#include <vector>

#include "gear/gear_set.hpp"

namespace epicyclic::reports {

/// At one torque.
struct TransmissionErrorRow {
  double torque_Nm, force_N;
  gear::TransmissionError error;  ///< of the contact of the pairs [G-load]
  gear::TransmissionError model;  ///< of the linear force of the model [G-secant]
};

/// Of one mesh, at rising torques from 0 to twice the design torque.
struct TransmissionErrorTable {
  std::string mesh;  ///< "sp", "rp"
  gear::LoadedContact contact;
  double design_torque_Nm;
  std::vector<TransmissionErrorRow> rows;

  [[nodiscard]] const TransmissionErrorRow& at_design_torque() const;
  /// The loaded one whose error varies least from peak to peak.
  [[nodiscard]] const TransmissionErrorRow& least() const;
};

/// @param torque_Nm  on the sun: the design torque
[[nodiscard]] std::vector<TransmissionErrorTable> transmission_errors(const gear::GearSet& set, double torque_Nm);

[[nodiscard]] std::string transmission_error_csv(const std::vector<TransmissionErrorTable>& tables);

/// The section of the page gear.md.
[[nodiscard]] std::string transmission_error_section(const std::vector<TransmissionErrorTable>& tables, bool modified);

}  // namespace epicyclic::reports
