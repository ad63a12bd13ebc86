#include "reports/transmission_error_report.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "core/csv.hpp"

namespace epicyclic::reports {

namespace {

constexpr int steps_to_design_torque = 20;

std::string name_of(const TransmissionErrorTable& table) { return table.mesh == "sp" ? "sun-planet" : "ring-planet"; }

/// A stage has two meshes.
bool of_pair(const std::vector<TransmissionErrorTable>& tables) { return tables.size() == 1; }

}  // namespace

const TransmissionErrorRow& TransmissionErrorTable::at_design_torque() const { return rows[steps_to_design_torque]; }

const TransmissionErrorRow& TransmissionErrorTable::least() const {
  return *std::min_element(rows.begin() + 1, rows.end(), [](const auto& a, const auto& b) {
    return a.error.peak_to_peak_um < b.error.peak_to_peak_um;
  });
}

std::vector<TransmissionErrorTable> transmission_errors(const gear::GearSet& set, double torque_Nm) {
  gear::LoadedContacts contacts = gear::loaded_contacts(set, torque_Nm);
  std::vector<TransmissionErrorTable> tables;
  const auto add = [&](const char* name, const gear::MeshedPair& mesh, gear::LoadedContact& contact) {
    TransmissionErrorTable table{name, std::move(contact), torque_Nm, {}};
    for (int k = 0; k <= 2 * steps_to_design_torque; ++k) {
      const double share = static_cast<double>(k) / steps_to_design_torque;
      const double force_N = share * table.contact.force_N();
      table.rows.push_back({share * torque_Nm, force_N, gear::transmission_error(table.contact, force_N),
                            gear::linear_transmission_error(mesh, force_N)});
    }
    tables.push_back(std::move(table));
  };
  add("sp", set.sun_planet, contacts.sun_planet);
  if (contacts.ring_planet) add("rp", set.ring_planet, *contacts.ring_planet);
  return tables;
}

std::string transmission_error_csv(const std::vector<TransmissionErrorTable>& tables) {
  CsvWriter csv({"mesh", "torque_Nm", "force_N", "mean_um", "peak_to_peak_um", "harmonic_1_um", "harmonic_2_um",
                 "harmonic_3_um", "contact_ratio", "model_peak_to_peak_um", "model_harmonic_1_um"});
  for (const TransmissionErrorTable& table : tables)
    for (const TransmissionErrorRow& row : table.rows) {
      const auto& [h_1, h_2, h_3] = row.error.harmonic_um;
      csv.row(table.mesh, row.torque_Nm, row.force_N, row.error.mean_um, row.error.peak_to_peak_um, h_1, h_2, h_3,
              row.error.contact_ratio, row.model.peak_to_peak_um, row.model.harmonic_um[0]);
    }
  return csv.text();
}

std::string transmission_error_section(const std::vector<TransmissionErrorTable>& tables, bool modified) {
  std::string text = fmt::format(
      "\n## Static transmission error\n\nDisplacement along the line of action by the loads of the tooth pairs "
      "[G-load], over a mesh period, at the torque of {:.6g} N m on {}. Table: "
      "`static_transmission_error.csv`.\n\n"
      "| mesh | mean um | peak to peak um | harmonics 1, 2, 3 um | contact ratio | least peak to peak um | at N m |\n"
      "|---|---|---|---|---|---|---|\n",
      tables.front().design_torque_Nm, of_pair(tables) ? "gear 1" : "the sun");
  for (const TransmissionErrorTable& table : tables) {
    const gear::TransmissionError& e = table.at_design_torque().error;
    text += fmt::format("| {} | {:.4g} | {:.4g} | {:.4g}, {:.4g}, {:.4g} | {:.4f} | {:.4g} | {:.6g} |\n",
                        of_pair(tables) ? "gear 1, gear 2" : name_of(table), e.mean_um, e.peak_to_peak_um,
                        e.harmonic_um[0], e.harmonic_um[1], e.harmonic_um[2], e.contact_ratio,
                        table.least().error.peak_to_peak_um, table.least().torque_Nm);
  }
  text += modified ? "\nThe model has this error at this torque, and the error without load at none. At other torques "
                     "it has e + F/k, the dashed curve.\n"
                   : "\nThe flanks are not modified. The model has F/k of the pairs on the path of contact. Under load "
                     "pairs touch beyond the path, which the model leaves out.\n";
  return text;
}

}  // namespace epicyclic::reports
