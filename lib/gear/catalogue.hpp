// A planetary stage, or a lone gear pair, as drawings and catalogues give it. gear/gear_set.hpp computes the lumped
// stage from it. Gear 1 of a pair is in the place of the sun, gear 2 in that of the planet.
//
// All gears share one material. Every value that a drawing states is a member; what it rarely states has the default of
// common practice, and the summary of `epicyclic gear` says which defaults were used.
#pragma once

#include <optional>
#include <string>

#include "gear/body.hpp"
#include "gear/material.hpp"
#include "gear/tooth.hpp"
#include "gear/tooth_compliance.hpp"

namespace epicyclic::gear {

/// Sun or planet.
struct ExternalGear {
  GearData data;
  std::optional<int> accuracy_grade;            ///< ISO 1328-1:1995
  double bore_mm = 0;                           ///< diameter
  double body_radius_ratio = solid_body_ratio;  ///< h_f of Sainsot
  std::optional<double> root_half_angle_deg;    ///< theta_f; default that of the profile
};

/// Source of the ring's base pitch if its rounded module does not fit the planet's.
enum class BasePitch {
  as_given,   ///< module and pressure angle of the ring as they stand
  of_planet,  ///< the ring's module is replaced so that both base pitches agree; its pressure angle is kept
};

struct RingGear {
  GearData data;
  std::optional<int> accuracy_grade;
  std::optional<double> outer_diameter_mm;  ///< of the rim
  BasePitch base_pitch = BasePitch::as_given;
  std::optional<double> root_half_angle_deg;
};

/// A bearing by its designation or by its own data, and the approach at which its stiffness is taken.
struct SupportBearing {
  std::string type;                          ///< a designation that find_bearing() knows; empty with data of its own
  double approach_um = 10;                   ///< elastic approach beyond the clearance
  std::optional<int> balls{};                ///< Z
  std::optional<double> ball_diameter_mm{};  ///< D_w
  double contact_angle_deg = 0;              ///< alpha
  std::optional<int> rollers{};              ///< Z of a roller bearing
  std::optional<double> roller_length_mm{};  ///< l: effective length of a roller
};

struct OutputShaft {
  double diameter_mm = 0;
  double inner_diameter_mm = 0;
  double length_mm = 0;
};

struct CarrierData {
  std::optional<CarrierBody> body;
  std::optional<SupportBearing> bearing;
  std::optional<OutputShaft> shaft;  ///< gives the torsional support of a grounded carrier
};

/// Whether the tips of sun and planet are shortened to keep the tip clearance at the working centre distance.
enum class Tips { shortened, full };

/// How the mesh stiffness enters the model.
enum class StiffnessForm {
  harmonics,  ///< mean and Fourier coefficients, smooth
  curve,      ///< the whole curve, with its jumps at the breakpoints
};

struct StiffnessOptions {
  ComplianceOptions compliance;
  StiffnessForm form = StiffnessForm::harmonics;
  int harmonics = 2;                                     ///< Eq. (4) has two; 0: the mean alone
  double sun_planet_factor = 1, ring_planet_factor = 1;  ///< on the computed stiffness, for what its model leaves open
  double table_tolerance = 1e-9;                         ///< of the curve between its rows, relative to the mean [-]
  /// Torque on the sun for the contact of modified flanks; that of the load if it is not given [N m].
  std::optional<double> design_torque_Nm{};

  /// @throws InputError for less than 0 harmonics, or a factor or tolerance that is not positive
  void validate() const;
};

/// Which tolerance of ISO 1328-1 the amplitude of the transmission error at mesh frequency follows from. [G-error]
enum class ErrorAmplitude {
  profile_form,  ///< half of the profile form deviation f_f alpha
  single_pitch,  ///< the single pitch deviation f_pt, a habit of the literature
};

/// What lubricates the teeth; without it there is no tooth friction.
struct Lubrication {
  double viscosity_mPas = 5;      ///< nu_0 at the oil's inlet
  double roughness_um = 0.6;      ///< RMS
  double table_tolerance = 1e-9;  ///< of load shares and of friction over normal force, between the rows [-]
};

struct Catalogue {
  Material material;
  Tips tips = Tips::shortened;
  ExternalGear sun, planet;
  std::optional<SupportBearing> sun_bearing;
  std::optional<SupportBearing> planet_bearing{};
  RingGear ring;  ///< without teeth: there is none
  CarrierData carrier;
  StiffnessOptions stiffness;
  std::optional<Lubrication> lubrication;
  ErrorAmplitude error_amplitude = ErrorAmplitude::profile_form;

  [[nodiscard]] bool has_ring() const { return ring.data.teeth > 0; }

  /// Has any flank a relief or a crowning?
  [[nodiscard]] bool is_modified() const {
    return sun.data.is_modified() || planet.data.is_modified() || ring.data.is_modified();
  }
};

}  // namespace epicyclic::gear
