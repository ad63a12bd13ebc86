// One operating point of a stage as a system of first-order equations, its type of N and layout forgotten.
//
// Everything is dimensionless and periodic in the mesh phase s with 2 pi. `studies` hands it to an integrator; the
// kernel itself is model/right_hand_side.hpp.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <memory>
#include <numbers>
#include <span>
#include <string>
#include <vector>

#include "core/vector_field.hpp"
#include "gear/bearing_life.hpp"
#include "gear/kinematics.hpp"
#include "gear/stage.hpp"
#include "model/layout.hpp"
#include "model/options.hpp"
#include "model/scales.hpp"
#include "model/stage_outputs.hpp"

namespace epicyclic::model {

/// Which side of its teeth a mesh is on.
enum class Contact { drive, loss, back };

/// Deflections of all meshes at one instant [b_c] and their rates [b_c per tau], with the errors; N entries each, of
/// the ring's mesh 0 in a pair.
struct MeshDeflections {
  std::vector<double> sun_planet, ring_planet;
  std::vector<double> sun_planet_rate, ring_planet_rate;
};

/// Forces in all meshes and bearings at one instant [m_0 omega_sn^2 b_c]; N entries each, of the ring's mesh 0 in a
/// pair.
struct StageForces {
  std::vector<double> sun_planet, ring_planet;                  ///< F of [M-27], damping included
  std::vector<double> sun_planet_elastic, ring_planet_elastic;  ///< k f(delta), the part of it that is no damping
  std::vector<double> planet_bearing;  ///< magnitude of spring and damper between planet and carrier
  double sun_bearing = 0;              ///< magnitude of bearing and support damping
};

/// A member whose errors repeat with its rotation relative to the carrier, in as many mesh periods as it has teeth.
struct Shaft {
  std::string member;  ///< "sun", "planets", "ring"
  int teeth = 1;
};

/// The equations of motion, s the mesh phase, and what else can be said of a state. Switching surfaces are the
/// contacts, how far each is from being made or lost: contact_distances() of model/right_hand_side.hpp, 4 N + 4 of
/// them, or 4 N + 1 with a radial bearing law; of a pair 6 or 3; N more with a clearance of the planets' bearings. The
/// field jumps there with damping that ends where contact does. A field is made of its folded constants
/// (model/folded_constants.hpp).
struct DynamicModel : VectorField {
  DynamicModel() { period = 2.0 * std::numbers::pi; }

  int planets = 0;            ///< 1: a pair of gears
  int mesh_periods = 1;       ///< in the period of the field: more than 1 with errors of shafts [M-shaft]
  std::vector<Shaft> shafts;  ///< with errors [M-shaft]
  Layout layout = Layout::relative_to_ring;
  std::vector<std::string> state_names;  ///< x_s, ..., then x_s_rate, ...
  double sun_planet_half_gap = 0;        ///< b_sp [b_c]
  double ring_planet_half_gap = 0;       ///< b_rp [b_c]
  bool planet_bearing_gap = false;       ///< is a clearance of the planets' bearings given?
  double omega = 0;                      ///< Omega
  Scales scales;                         ///< that the stage was made dimensionless with
  gear::Speeds speeds{};                 ///< of its members
  gear::BearingLoads bearings{};         ///< what the lives of its bearings need

  /// Allocation-free when `out` has been used before. Rates included.
  std::function<void(double s, const double* y, MeshDeflections& out)> deflections;

  /// Forces of meshes and bearings at a state; allocation-free when `out` has been used before.
  std::function<void(double s, const double* y, StageForces& out)> forces;

  /// The same and the transmission error, for many instants [model/stage_outputs.hpp]. Empty in a model of one's own:
  /// then only deflections of its meshes are known.
  StageOutputsAt outputs_at;

  /// This model with tables that are half as fine, where rows of something known make them: how far an orbit moves is
  /// more than what their interpolation moves it, some 16 times. Empty without such tables.
  std::function<DynamicModel()> with_halved_tables;
  double friction_table_error = 0;  ///< greatest error of the friction's ratios between the rows [-]

  double static_mesh_force = 0;  ///< T_D / (N r_bs), of a sun that is held T_r / (N r_br) [m_0 omega_sn^2 b_c]

  /// Mesh phase of each planet ahead of that of planet 1, in mesh periods [M-phase]; empty in a model of one's own.
  std::vector<double> planet_phases;

  /// Removes the synchronous part from a state's deviation: equal displacements of all planets in their own directions
  /// and rotations of the central members. The rest breaks the symmetry, and the flow linearised about a synchronous
  /// trajectory keeps it so. Empty unless planets are alike: equally spaced, all meshing in phase, equal errors.
  std::function<void(std::span<double> deviation)> remove_synchronous;

  /// At rest, each mesh on its drive flank at delta = b + F / k of the static load, errors as at s = 0: the equilibrium
  /// of the linear stage with mean stiffness (of its relative coordinates for `as_printed`, where the whole train
  /// accelerates).
  std::vector<double> default_start;

  /// Equilibria at mesh phases in [0, period], a state for each [model/static_equilibrium.hpp]; none where one was not
  /// found. Their elastic forces are the quasi-static ones. Empty in a model of one's own.
  std::function<std::vector<std::vector<double>>(std::span<const double> phases)> quasi_static_states;

  [[nodiscard]] bool has_ring() const { return !is_pair(layout); }

  /// Side of the teeth that a deflection is on.
  [[nodiscard]] static Contact contact(double delta, double half_gap) {
    if (delta > half_gap) return Contact::drive;
    return delta < -half_gap ? Contact::back : Contact::loss;
  }
};

/// Which contact a switching surface of a DynamicModel is of.
struct ContactSurface {
  std::string part;   ///< "sp_1", "rp_2", "sun_bearing_x", "sun_bearing_y"; "sun_bearing" of a radial law;
                      ///< "planet_bearing_1" with a clearance there
  bool mesh = true;   ///< of a mesh, else of a bearing
  bool upper = true;  ///< the distance is x - b, else x + b
};

/// In the order of the surfaces.
[[nodiscard]] std::vector<ContactSurface> contact_surfaces(const DynamicModel& model);

/// The segment of right_hand_side that a phase in [0, period) lies in.
[[nodiscard]] std::size_t segment_at(const std::vector<double>& breakpoints, double s);

/// Rotations relative to the boundary's reference member, or all 3N + 9 with the rigid rotation (for comparisons).
enum class CoordinateChoice { relative, full };

/// The layout that a stage is integrated in.
[[nodiscard]] Layout layout_of(const gear::Stage& stage, CoordinateChoice choice);

/// @param stage  passes gear::problems_for_dynamics()
/// @throws InputError for options that do not fit the boundary: printed gyroscopic terms with a free carrier do not
///         close in relative coordinates
[[nodiscard]] DynamicModel make_dynamic_model(const gear::Stage& stage, const Scales& scales,
                                              double mesh_frequency_ratio, const ModelOptions& options,
                                              CoordinateChoice choice = CoordinateChoice::relative);

/// A speed that changes at a constant rate, from the beginning of a mesh period on [M-ramp]:
///
///   Omega(tau) = Omega_0 + a (tau - tau_0) ,  s = int Omega d tau ,  so that  Omega(s) = sqrt(Omega_0^2 + 2 a s)
struct SpeedRamp {
  double omega = 1;  ///< Omega_0, at s = 0
  double rate = 0;   ///< a = d Omega / d tau; 0: the speed is constant
  double tau = 0;    ///< tau_0

  [[nodiscard]] double omega_at(double s) const { return std::sqrt(omega * omega + 2.0 * rate * s); }
  /// Without cancellation for a small rate.
  [[nodiscard]] double tau_at(double s) const { return tau + 2.0 * s / (omega_at(s) + omega); }
};

/// The model of a stage whose speed changes. Its functions take the speed at s from the ramp, which the caller sets for
/// each mesh period before it is integrated. All that depends on the speed follows: e', the speed of the carrier, the
/// centrifugal force, torques at constant power. Friction of lubricated teeth is that of the speed of reference. The
/// inertia torques of the acceleration are left out. One trajectory at a time; without tangents and outputs_at.
/// @param reference  Omega at which friction tables are made
/// @param torque     torque at a time tau over that of the stage; null: 1
[[nodiscard]] DynamicModel make_ramped_model(const gear::Stage& stage, const Scales& scales,
                                             const ModelOptions& options, std::shared_ptr<const SpeedRamp> ramp,
                                             double reference, std::function<double(double tau)> torque = {});

/// Data of a model that a parameter may change.
struct OperatingPoint {
  gear::Stage stage;
  double mesh_frequency_ratio = 1;  ///< Omega [-]
  ModelOptions options;
};

/// Gives a model the derivative of its right-hand side with respect to a parameter.
///
/// @param model  made of at(value) by make_dynamic_model()
/// @param value  of the parameter
/// @param step   h of the difference of folded constants; value +- 2 h must be valid. 1e-3 of the range over which the
///               constants change is right: they are smooth, and rounding is divided by h
/// @throws InputError when the parameter moves a breakpoint, or changes the planets or the layout
void set_parameter_derivative(DynamicModel& model, const std::function<OperatingPoint(double value)>& at,
                              const Scales& scales, double value, double step);

}  // namespace epicyclic::model
