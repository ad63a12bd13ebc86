#include "reports/quantity_words.hpp"

#include <gtest/gtest.h>

#include "input/study_input.hpp"

namespace epicyclic::reports::quantity_words_test {
namespace {

std::string text(const std::string& pointer) {
  const auto [words, unit] = quantity_words(pointer);
  return unit.empty() ? words : words + " [" + unit + "]";
}

TEST(QuantityWords, AreThoseOfTheField) {
  EXPECT_EQ(text("/stage/load/torque_Nm"), "Sun torque [N m]");
  EXPECT_EQ(text("/stage/load/power_kW"), "Sun power [kW]");
  EXPECT_EQ(text("/stage/lumped/planet/bearing_N_per_m"), "Planet: bearing stiffness [N/m]");
  EXPECT_EQ(text("/stage/lumped/ring/inertia_over_r2_kg"), "Ring: inertia over r² [kg]");
  EXPECT_EQ(text("/stage/lumped/carrier/torsional_support_N_per_m"), "Carrier: torsional support stiffness [N/m]");
  EXPECT_EQ(text("/stage/lumped/sun/support_damping_ratio"), "Sun: support damping ratio");
  EXPECT_EQ(text("/stage/lumped/sun_planet_mesh/error_amplitude_um/1"),
            "Sun-planet mesh: error amplitude, planet 2 [µm]");
  EXPECT_EQ(text("/stage/lumped/ring_planet_mesh/stiffness_cos_N_per_m/0"),
            "Ring-planet mesh: stiffness, cosine, harmonic 1 [N/m]");
  EXPECT_EQ(text("/stage/lumped/ring_planet_mesh/error_phase_deg"), "Ring-planet mesh: error phase [°]");
  EXPECT_EQ(text("/stage/catalogue/planet/bore_mm"), "Planet: bore diameter [mm]");
  EXPECT_EQ(text("/stage/catalogue/lubrication/viscosity_mPas"), "Lubrication: viscosity [mPa s]");
  EXPECT_EQ(text("/stage/catalogue/material/youngs_modulus_GPa"), "Material: Young's modulus [GPa]");
  EXPECT_EQ(text("/stage/lumped/ring_mesh_lead_1"), "Ring mesh lead 1");
  EXPECT_EQ(text("/operation/mesh_frequency_ratio"), "Mesh frequency ratio");
  EXPECT_EQ(text("/integrator/clearance_smoothing"), "Clearance smoothing [b_c]");
}

TEST(QuantityWords, OfNoNumberOfTheInputsArePointers) {
  for (const char* file : {"inputs/tang2020_speed.json", "inputs/tang2020_calibrated_speed.json"})
    for (const std::string& pointer : input::load_input(file).number_pointers()) {
      const QuantityWords q = quantity_words(pointer);
      EXPECT_FALSE(q.words.empty()) << pointer;
      EXPECT_EQ(q.words.find_first_of("_/"), std::string::npos) << pointer << ": " << q.words;
    }
}

}  // namespace
}  // namespace epicyclic::reports::quantity_words_test
