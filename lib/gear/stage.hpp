// The planetary stage, or a lone gear pair, in SI units, as lumped values: what the model needs and nothing else.
//
// Catalogue data (module, modification, bores ...) are converted to this form; users with measured or finite-element
// data give it directly. Members are named as in Tang et al. 2020, section 2: sun s, planets p_i, ring r, carrier c.
//
// Rotations are measured as displacements on a radius of reference, u = r theta: the base circle for gears, the centre
// distance for the carrier (Eq. (16), where r_bc is the centre distance). So an inertia enters as I / r^2 [kg] and a
// torsional support as a stiffness on that radius [N/m] (the paper's k_cu [N m/rad] divided by r_c^2).
//
// Smoothness: all numbers are constants in time; what moves with the mesh phase is given by Fourier coefficients
// (smooth) or by friction tables with breakpoints (jumps at the breakpoints, smooth between).
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/interpolation.hpp"
#include "core/interval_grid.hpp"
#include "gear/catalogue.hpp"

namespace epicyclic::gear {

inline constexpr int planets_min = 2;
inline constexpr int planets_max = 6;
inline constexpr std::size_t harmonics_max = 64;

/// Longest common period of shafts' errors that is integrated.
inline constexpr int mesh_periods_max = 4096;

/// The stiffness of a support that does not yield.
inline constexpr double rigid = std::numeric_limits<double>::infinity();

/// Who is held, who drives, who is driven (docs/theory/model.md, section 4).
enum class Boundary {
  as_printed,  ///< the paper as printed: ring free and without torque, carrier grounded through k_cu, T_c on the
               ///< carrier
  fixed_ring,  ///< ring grounded through k_ru, carrier is the free output
  star,        ///< carrier grounded through k_cu, ring is the free output
  fixed_sun,   ///< sun grounded through k_su, carrier and ring are in and out
  free,        ///< nothing grounded: a differential, whose speeds are in a given ratio
  pair,        ///< no stage but a lone pair: gear 1 in the place of the sun, gear 2 in that of the only planet
};

/// By their names in the input.
inline constexpr std::array<std::pair<std::string_view, Boundary>, 6> boundary_names = {
    {{"as_printed", Boundary::as_printed},
     {"fixed_ring", Boundary::fixed_ring},
     {"star", Boundary::star},
     {"fixed_sun", Boundary::fixed_sun},
     {"free", Boundary::free},
     {"pair", Boundary::pair}}};

/// The member through which power enters the stage.
enum class Driver { sun, carrier, ring };

/// Viscous damping of a support: a ratio, c = 2 zeta sqrt(k m), or a coefficient.
struct SupportDamping {
  std::optional<double> ratio;                 ///< zeta [-]
  std::optional<double> coefficient_Ns_per_m;  ///< c [N s/m]

  /// c of a support of stiffness k [N/m] under mass m [kg]; 0 for a rigid support, where nothing moves. [N s/m]
  [[nodiscard]] double of(double stiffness, double mass) const {
    if (!std::isfinite(stiffness)) return 0.0;
    if (coefficient_Ns_per_m) return *coefficient_Ns_per_m;
    return ratio ? 2.0 * *ratio * std::sqrt(stiffness * mass) : 0.0;
  }
};

/// A number of planets: one for all of them, or one for each. In place of a number it is the mean.
class PerPlanet {
 public:
  PerPlanet() = default;
  PerPlanet(double of_all) : values_{of_all} {}  // NOLINT(google-explicit-constructor): the usual case
  PerPlanet(std::vector<double> values) : values_(std::move(values)) {}  // NOLINT(google-explicit-constructor)

  [[nodiscard]] double operator[](std::size_t planet) const {
    return values_.size() == 1 ? values_[0] : values_[planet];
  }
  [[nodiscard]] const std::vector<double>& values() const { return values_; }
  operator double() const {  // NOLINT(google-explicit-constructor)
    double apart = 0.0;
    for (std::size_t i = 1; i < values_.size(); ++i) apart += values_[i] - values_[0];
    return values_[0] + apart / static_cast<double>(values_.size());
  }

 private:
  std::vector<double> values_ = {0.0};
};

/// Errors of a member that repeat with its rotation relative to the carrier [M-shaft].
struct ShaftErrors {
  std::optional<double> eccentricity_um{};         ///< centre of the teeth beside the axis of rotation [um]
  std::optional<double> eccentricity_phase_deg{};  ///< its direction at s = 0, as planet angles are measured [deg]
  /// Cumulative pitch error of each tooth, in the order of rising angles: what it takes from the deflection [um].
  std::optional<std::vector<double>> pitch_error_um{};

  [[nodiscard]] bool repeat() const { return eccentricity_um || pitch_error_um; }
};

/// A central member: sun, ring or carrier.
struct CentralMember {
  double mass_kg = 0;
  double inertia_over_r2_kg = 0;         ///< I / r^2, r the member's radius of reference [kg]
  double support_N_per_m = 0;            ///< k_x = k_y; `rigid` in modes only [N/m]
  double torsional_support_N_per_m = 0;  ///< k_u on the radius of reference; `rigid` in modes and for the ring [N/m]
  SupportDamping damping;
  std::optional<int> teeth;              ///< none for the carrier
  std::optional<double> base_radius_mm;  ///< none for the carrier
  ShaftErrors errors{};
};

/// Decides the exponent of the life of a rolling bearing [G-life].
enum class RollingElements { balls, rollers };

/// What the life of a rolling bearing needs. Without a load rating there is no life.
struct BearingRating {
  std::optional<double> dynamic_load_rating_kN{};     ///< C of ISO 281 [kN]
  std::optional<RollingElements> rolling_elements{};  ///< default: balls of the sun's bearing, rollers of planets'
};

/// How the sun's bearing answers the sun's displacement (docs/theory/model.md, section 2).
enum class BearingLaw {
  linear_xy,        ///< k f(x, b), k f(y, b): the paper's, constant k; a square clearance
  palmgren_xy,      ///< k(d) d with k from Eq. (11) at the approach d = f(x, b), and likewise in y; over-counts by 3/2
  linear_radial,    ///< k max(r - b, 0) along the radius r = hypot(x, y)
  palmgren_radial,  ///< (2/3) k(d) d with k from Eq. (11) at d = max(r - b, 0), along the radius
};

/// Is the clearance a circle?
[[nodiscard]] constexpr bool is_radial(BearingLaw law) {
  return law == BearingLaw::linear_radial || law == BearingLaw::palmgren_radial;
}

/// The sun's bearing: clearance and law. Rolling-element data are needed by the Palmgren laws only (Table 3).
struct SunBearing {
  double clearance_half_um = 0;  ///< half gap b_s [um]
  BearingLaw law = BearingLaw::linear_xy;
  std::optional<int> balls;                ///< Z
  std::optional<double> ball_diameter_mm;  ///< D_w [mm]
  double contact_angle_deg = 0;            ///< alpha [deg]
  BearingRating rating{};
};

struct Planet {
  PerPlanet mass_kg;
  PerPlanet inertia_over_r2_kg;
  PerPlanet bearing_N_per_m;  ///< k_pix = k_piy = k_picu; `rigid` in modes and of a pair
  SupportDamping damping;
  std::optional<int> teeth;
  std::optional<double> base_radius_mm;
  /// Position errors of the pins in the carrier: one number, or one per planet [um]. Tangential: towards rising angle;
  /// radial: outward.
  std::optional<std::vector<double>> pin_error_tangential_um{}, pin_error_radial_um{};
  std::optional<double> torsional_support_N_per_m{};  ///< of gear 2 of a pair, on its base radius [N/m]
  /// As those of ShaftErrors, one number or one per planet; the direction is relative to the planet's own radius.
  std::optional<std::vector<double>> eccentricity_um{}, eccentricity_phase_deg{};
  /// Cumulative pitch errors of the flanks in mesh with the sun and with the ring, in the order of rising angles from
  /// the tooth in contact at s = 0: of all planets, or of one planet after the other [um].
  std::optional<std::vector<double>> pitch_error_um{}, pitch_error_ring_um{};
  std::optional<double> bearing_clearance_half_um{};  ///< half the radial clearance of the bearing, b_p [um]
  BearingRating rating{};                             ///< of the bearing

  [[nodiscard]] bool repeat() const { return eccentricity_um || pitch_error_um || pitch_error_ring_um; }
};

/// Friction over phase = s / 2 pi on the common s of planet 1, in [0, 1), rising; smooth between breakpoints.
/// A jump at a breakpoint is given by its two sides: the phase stands twice, left value first.
struct FrictionTable {
  std::vector<double> phase;                              ///< [-]
  std::vector<double> force_ratio;                        ///< A [-]
  std::vector<double> moment_driving_mm;                  ///< B about the axis of the driving member [mm]
  std::vector<double> moment_driven_mm;                   ///< B about the axis of the driven member [mm]
  std::vector<double> breakpoints;                        ///< phases where the table jumps or kinks [-]
  Interpolation interpolation = Interpolation::monotone;  ///< between the rows
  std::vector<IntervalGrid> grids{};  ///< of a computed one: the grid of the rows between two breakpoints
  double error = 0;                   ///< of a computed one: greatest error between the rows [-]
};

/// Coulomb coefficient mu on a path of contact with equal load sharing among the pairs in contact.
struct CoulombFriction {
  double coefficient = 0;               ///< mu [-]
  double contact_ratio = 1;             ///< epsilon, pairs in contact: below 1 no rotation is transmitted; up to 3
  std::optional<double> path_start_mm;  ///< friction arm of the driving member where contact starts; default: the
                                        ///< path is symmetric about the pitch point
};

/// Lubricated contact, gear/ehl_friction.hpp: a coefficient that depends on place, load and speed.
struct EhlFriction {
  double viscosity_mPas = 5;          ///< nu_0
  double roughness_um = 0.6;          ///< S, RMS
  double equivalent_modulus_GPa = 0;  ///< E' of Eq. (8)
  double width_mm = 0;                ///< face width in contact
  double contact_ratio = 1;           ///< epsilon
  double path_start_mm = 0;           ///< friction arm of the driving member where contact starts
  /// Share of the load on a pair, against its position in base pitches from the start of contact, 0 .. epsilon, rising;
  /// a jump stands twice. Empty: equal sharing.
  std::vector<double> share_position;
  std::vector<double> share;
  Interpolation share_interpolation = Interpolation::linear;  ///< between the rows
  std::optional<double> share_error{};  ///< known greatest error of the share between its rows [-]
  /// Error that the rows of the friction table are made fine enough for, of the ratios to the normal force [-].
  double table_tolerance = Lubrication{}.table_tolerance;
};

/// Tooth friction of one mesh: F_f = A(s) F and, about the members' axes, B(s) F.
/// A table over the mesh phase, a coefficient on an idealised contact path, or a law of lubricated contact.
struct Friction {
  std::optional<FrictionTable> table;
  std::optional<CoulombFriction> coefficient;
  std::optional<EhlFriction> ehl{};

  [[nodiscard]] bool any() const { return table.has_value() || coefficient.has_value() || ehl.has_value(); }
};

/// Mesh stiffness as a curve over the mesh's own phase, in [0, 1); rows and breakpoints as in FrictionTable.
struct StiffnessCurve {
  std::vector<double> phase;                              ///< [-]
  std::vector<double> stiffness_N_per_m;                  ///< k [N/m]
  std::vector<double> breakpoints;                        ///< phases where the curve jumps or kinks [-]
  Interpolation interpolation = Interpolation::monotone;  ///< between the rows
  std::optional<double> error{};  ///< known greatest error between the rows, relative to the mean [-]
};

/// Transmission error as a curve over the mesh's own phase, in [0, 1); rows as in FrictionTable, but without jumps.
struct ErrorCurve {
  std::vector<double> phase;                              ///< [-]
  std::vector<double> error_um;                           ///< e [um]
  std::vector<double> breakpoints;                        ///< phases where the curve has a kink [-]
  Interpolation interpolation = Interpolation::monotone;  ///< between the rows
  std::optional<double> error{};  ///< known greatest error between the rows, relative to the largest row [-]
};

/// One kind of mesh: sun-planet or ring-planet, the same for all planets but for the errors.
struct Mesh {
  double stiffness_N_per_m = 0;                        ///< mean k_0 [N/m]
  std::vector<double> stiffness_cos_N_per_m;           ///< A_h of Eq. (4), h = 1, 2, ... on the mesh's own phase [N/m]
  std::vector<double> stiffness_sin_N_per_m;           ///< B_h of Eq. (4) [N/m]
  std::optional<StiffnessCurve> stiffness_curve{};     ///< the whole curve instead of harmonics; k_0 is its mean
  std::optional<double> operating_pressure_angle_deg;  ///< [deg]; if base radii are given they decide
  std::optional<double> damping_ratio;                 ///< zeta of c = 2 zeta sqrt(k_0 m_e) [-]
  double backlash_half_um = 0;                         ///< half gap b [um]
  std::vector<double> error_amplitude_um = {0.0};      ///< E: one number, or one per planet [um]
  std::vector<double> error_phase_deg = {0.0};         ///< phi_0: one number, or one per planet [deg]
  /// Harmonics h = 1, 2, ... of the transmission error on the mesh's own phase, the same for all planets [um].
  std::optional<std::vector<double>> error_cos_um{}, error_sin_um{};
  std::optional<ErrorCurve> error_curve{};  ///< added to them
  /// Constant part of the transmission error, of tooth thickness or spacing: one number, or one per planet [um].
  std::optional<std::vector<double>> error_mean_um{};
  Friction friction;
};

/// Load of the stage: exactly one of power and torque.
struct Load {
  std::optional<double> power_kW;   ///< T_D = P / omega_s: falls with speed
  std::optional<double> torque_Nm;  ///< T_D on the sun, the same at every speed; its sign decides the loaded flanks
  /// Of a pair: harmonics h = 1, 2, ... of the mesh frequency in the torques on gear 1 and gear 2, over their means,
  /// on the phase s of the mesh [-].
  std::optional<std::vector<double>> input_cos{}, input_sin{}, output_cos{}, output_sin{};
};

struct Stage {
  std::string name;
  Boundary boundary = Boundary::fixed_ring;
  Driver driver = Driver::sun;
  std::optional<double> carrier_to_sun_speed{};  ///< omega_c / omega_s of Boundary::free [-]
  int planet_count = 3;
  std::vector<double> angles_deg;            ///< phi_i; empty: equally spaced from 0
  std::optional<double> centre_distance_mm;  ///< r_c
  CentralMember sun, ring, carrier;
  SunBearing sun_bearing;
  Planet planet;
  Mesh sun_planet_mesh, ring_planet_mesh;
  std::optional<Catalogue> catalogue{};  ///< what the lumped values were computed from, if they were
  double ring_mesh_lead_1 = 0;           ///< lambda_sr: share of a mesh period by which the ring mesh leads [-]
  Load load;

  [[nodiscard]] bool is_pair() const { return boundary == Boundary::pair; }

  /// Is the carrier free in rotation, so that rotations are measured from it?
  [[nodiscard]] bool has_free_carrier() const {
    return boundary == Boundary::fixed_ring || boundary == Boundary::fixed_sun || boundary == Boundary::free;
  }

  /// phi_i [deg], i = 0 .. N-1: as given, or equally spaced from 0.
  [[nodiscard]] std::vector<double> planet_angles_deg() const;

  /// The same in the direction of the torque on the sun, in which the model measures all angles and rotations [deg].
  [[nodiscard]] std::vector<double> angles_along_torque_deg() const;

  /// Does the sun rotate against its torque, as seen from the carrier, so that the meshes run backward
  /// [gear/reversal.hpp]? If the sun is held, this is the case with the ring as the driver.
  [[nodiscard]] bool runs_backward() const {
    return boundary == Boundary::fixed_sun ? driver == Driver::ring : driver != Driver::sun;
  }

  /// Mesh periods after which the errors of all shafts repeat; 1 without such errors. At most mesh_periods_max + 1.
  [[nodiscard]] int mesh_periods() const;
};

/// The angle next to `angle_deg` at which a planet fits the teeth of sun and ring, if one fits them at `first_deg`:
/// (z_s + z_r)(phi - phi_1) / 360 deg is whole [deg].
[[nodiscard]] double assembly_angle_deg(int sun_and_ring_teeth, double first_deg, double angle_deg);

/// A planet whose teeth do not fit both meshes.
struct Misfit {
  std::size_t planet;  ///< 0 .. N-1
  double angle_deg;    ///< where it is
  double nearest_deg;  ///< where it could be
};

/// Planets that cannot be assembled by more than a thousandth of a degree; none where teeth are not given.
[[nodiscard]] std::vector<Misfit> assembly_misfits(const Stage& stage);

/// What must hold for the linear model: signs, counts, at least one definition of the pressure angles, ... (any support
/// free, finite or rigid).
/// @returns one line per rule broken, "pointer: message", pointer relative to the stage; empty if all is well
[[nodiscard]] std::vector<std::string> problems_for_modes(const Stage& stage);

/// What must hold, beyond that, for time integration: supports that fit the boundary, compatible radii, a load, ...
[[nodiscard]] std::vector<std::string> problems_for_dynamics(const Stage& stage);

}  // namespace epicyclic::gear
