// The kernel's forces against a potential, an identity and the balance laws, all written here from
// docs/theory/model.md.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/dual.hpp"
#include "gear/bearing.hpp"
#include "gear/kinematics.hpp"
#include "model/dynamic_model.hpp"
#include "model/parameters.hpp"
#include "model/right_hand_side.hpp"
#include "problems/mesh_laws.hpp"
#include "problems/r1.hpp"

namespace epicyclic::model::forces_test {
namespace {

using problems::MeshLaw;
using problems::Which;
using Real = long double;

constexpr std::size_t planets = 3;
constexpr std::size_t dof = degrees_of_freedom(Layout::full, planets);
using Vector = std::array<Real, dof>;
using State = std::array<Real, 2 * dof>;

/// Half of the square of the closure, or its smooth form: the potential over k.
Real gap_potential(Real d, Real b, Real w) {
  if (w == 0.0L) {
    const Real closed = std::max(std::abs(d) - b, 0.0L);
    return closed * closed / 2;
  }
  const auto g = [&](Real x) { return (x * std::sqrt(x * x + w * w) + w * w * std::asinh(x / w)) / 2; };
  return (d * d / 2) + (g(d - b) - g(d + b)) / 2;
}

/// Elastic potential of the stage from Eqs. (13)-(15), dimensionless.
Real potential(const gear::Stage& stage, const Scales& scales, Real w, Real s, const Vector& q) {
  const Real pi = std::numbers::pi_v<Real>;
  const gear::PressureAngles alpha = gear::pressure_angles(stage);
  const std::vector<double> angles = stage.planet_angles_deg();
  const MeshLaw sp(stage, Which::sun_planet);
  const MeshLaw rp(stage, Which::ring_planet);
  const auto k = [&](double newton_per_m) { return static_cast<Real>(scales.stiffness(newton_per_m)); };
  const Real k_unit = k(1.0);
  const Real b_sp = scales.displacement(stage.sun_planet_mesh.backlash_half_um * 1e-6);
  const Real b_rp = scales.displacement(stage.ring_planet_mesh.backlash_half_um * 1e-6);
  const Real b_s = scales.displacement(stage.sun_bearing.clearance_half_um * 1e-6);
  const Real b_c = length_scale_m;

  const Real x_s = q[0];
  const Real y_s = q[1];
  const Real u_s = q[2];
  const Real x_r = q[3 + 3 * planets];
  const Real y_r = q[4 + 3 * planets];
  const Real x_c = q[5 + 3 * planets];
  const Real y_c = q[6 + 3 * planets];
  const Real u_r = q[7 + 3 * planets];
  const Real u_c = q[8 + 3 * planets];

  Real v = 0;
  switch (stage.sun_bearing.law) {
    case gear::BearingLaw::linear_xy:
      v += k(stage.sun.support_N_per_m) * (gap_potential(x_s, b_s, w) + gap_potential(y_s, b_s, w));
      break;
    case gear::BearingLaw::linear_radial:
      v += k(stage.sun.support_N_per_m) * gap_potential(std::hypot(x_s, y_s), b_s, w);
      break;
    case gear::BearingLaw::palmgren_xy: {
      const Real hertz = scales.hertz(gear::palmgren_coefficient(stage.sun_bearing));
      for (const Real d : {x_s, y_s}) v += hertz * std::pow(std::max(std::abs(d) - b_s, 0.0L), 2.5L) / 2.5L;
      break;
    }
    case gear::BearingLaw::palmgren_radial: {
      const Real hertz = scales.hertz(gear::palmgren_coefficient(stage.sun_bearing));
      v += 4 * hertz * std::pow(std::max(std::hypot(x_s, y_s) - b_s, 0.0L), 2.5L) / 15;
      break;
    }
  }
  v += k(stage.ring.support_N_per_m) * (x_r * x_r + y_r * y_r) / 2;
  v += k(stage.carrier.support_N_per_m) * (x_c * x_c + y_c * y_c) / 2;
  v += k(stage.ring.torsional_support_N_per_m) * u_r * u_r / 2;
  v += k(stage.carrier.torsional_support_N_per_m) * u_c * u_c / 2;
  for (std::size_t i = 0; i < planets; ++i) {
    const Real x = q[3 + 3 * i];
    const Real y = q[4 + 3 * i];
    const Real u = q[5 + 3 * i];
    const Real phi = static_cast<Real>(angles[i]) * pi / 180;
    const Real phi_sp = static_cast<Real>(alpha.sun_planet) - phi;
    const Real phi_rp = static_cast<Real>(alpha.ring_planet) + phi;
    const Real d_sp = (x_s - x) * std::sin(phi_sp) + (y_s - y) * std::cos(phi_sp) + u_s + u - sp.error(i, s) / b_c;
    const Real d_rp = (x - x_r) * std::sin(phi_rp) - (y - y_r) * std::cos(phi_rp) + u_r - u - rp.error(i, s) / b_c;
    v += k_unit * sp.stiffness(i, s) * gap_potential(d_sp, b_sp, w);
    v += k_unit * rp.stiffness(i, s) * gap_potential(d_rp, b_rp, w);
    const Real d_x = x - x_c + u_c * std::sin(phi);
    const Real d_y = y - y_c - u_c * std::cos(phi);
    const Real b_p = scales.displacement(stage.planet.bearing_clearance_half_um.value_or(0.0) * 1e-6);
    v += k(stage.planet.bearing_N_per_m[i]) * gap_potential(std::hypot(d_x, d_y), b_p, b_p > 0.0L ? w : 0.0L);
  }
  return v;
}

/// Generalised force of each coordinate: mass times acceleration.
template <class T>
std::array<T, dof> forces(const Parameters<T, planets>& p, std::size_t segment, const T& s,
                          const std::array<T, 2 * dof>& y) {
  const StageState<T, planets> g = stage_state(Layout::full, p, segment, s, y.data());
  Coordinates<T, planets> a = accelerations(p, g);
  a.x_s *= p.mass_s;
  a.y_s *= p.mass_s;
  a.w_s *= p.inertia_s;
  for (std::size_t i = 0; i < planets; ++i) {
    a.x_p[i] *= p.mass_p[i];
    a.y_p[i] *= p.mass_p[i];
    a.w_p[i] *= p.inertia_p[i];
  }
  a.x_r *= p.mass_r;
  a.y_r *= p.mass_r;
  a.u_r *= p.inertia_r;
  a.x_c *= p.mass_c;
  a.y_c *= p.mass_c;
  a.u_c *= p.inertia_c;
  std::array<T, dof> f;
  pack(Layout::full, a, f.data());
  return f;
}

void without_damping_and_loads(Parameters<double, planets>& p) {
  p.damping_s = p.damping_r = p.damping_c = p.torsion_damping_r = p.torsion_damping_c = 0.0;
  p.bearing_damping_p.fill(0.0);
  p.sun_planet.damping = p.ring_planet.damping = 0.0;
  p.drive = p.ring_drive = p.carrier_load = 0.0;
}

gear::Stage with_bearing(gear::Stage s, gear::BearingLaw law, double half_gap_um) {
  s.sun_bearing = {half_gap_um, law, 10, 16.67, 0.0};
  return s;
}

gear::Stage with_planet_clearance(gear::Stage s, double half_gap_um) {
  s.planet.bearing_clearance_half_um = half_gap_um;
  return s;
}

/// Worst difference of force and -grad V over random states, relative to the largest force.
double worst_potential_error(const gear::Stage& stage, double w) {
  const Scales scales = scales_of(stage);
  Parameters<double, planets> folded =
      make_parameters<planets>(stage, scales, 0.9, {GapDamping::always, Gyroscopic::off, w});
  without_damping_and_loads(folded);
  folded.sun_planet.friction = folded.ring_planet.friction = nullptr;
  folded.breakpoints.clear();
  const auto p = convert<Real>(folded);
  std::mt19937_64 random(20);
  // Mesh deflections of some 10 b_c against a half gap of 4: all three sides occur.
  std::uniform_real_distribution<double> displacement(-4.0, 4.0);
  std::uniform_real_distribution<double> phase(0.0, 2.0 * std::numbers::pi);
  double worst = 0.0;
  for (int trial = 0; trial < 20; ++trial) {
    State y{};
    for (std::size_t k = 0; k < dof; ++k) y[k] = displacement(random);
    const Real s = phase(random);
    const std::array<Real, dof> f = forces(p, 0, s, y);
    Real largest = 0;
    for (const Real x : f) largest = std::max(largest, std::abs(x));
    for (std::size_t k = 0; k < dof; ++k) {
      // Fourth-order differences in long double: truncation (h/w)^4, rounding 1e-19 V / h.
      const Real h = 1e-5L;
      const auto v = [&](Real step) {
        Vector q;
        std::copy(y.begin(), y.begin() + dof, q.begin());
        q[k] += step;
        return potential(stage, scales, w, s, q);
      };
      const Real slope = (8 * (v(h) - v(-h)) - (v(2 * h) - v(-2 * h))) / (12 * h);
      worst = std::max(worst, static_cast<double>(std::abs(f[k] + slope) / largest));
    }
  }
  return worst;
}

// Truncation and rounding of the differences, and of the folded constants, which are double.
constexpr double potential_tolerance = 1e-10;

TEST(Forces, ElasticPartIsMinusTheGradientOfThePotential) {
  using gear::BearingLaw;
  const gear::Stage base =
      problems::with_unequal_errors(problems::with_moving_stiffness(problems::with_gap(problems::r1())));
  struct Case {
    const char* name;
    gear::Stage stage;
    double w;
  };
  const Case cases[] = {
      {"linear_xy", with_bearing(base, BearingLaw::linear_xy, 10), 0.0},
      {"linear_xy smooth", with_bearing(base, BearingLaw::linear_xy, 10), 0.05},
      {"linear_radial", with_bearing(base, BearingLaw::linear_radial, 10), 0.0},
      {"linear_radial smooth", with_bearing(base, BearingLaw::linear_radial, 10), 0.05},
      {"palmgren_xy", with_bearing(base, BearingLaw::palmgren_xy, 10), 0.0},
      {"palmgren_radial", with_bearing(base, BearingLaw::palmgren_radial, 10), 0.0},
      {"no gap", with_bearing(problems::with_gap(base, 0.0), BearingLaw::linear_xy, 0), 0.0},
      {"as_printed", with_bearing(problems::as_printed(base), BearingLaw::linear_xy, 10), 0.0},
      {"planet bearings", with_planet_clearance(base, 25), 0.0},
      {"planet bearings smooth", with_planet_clearance(base, 25), 0.05},
      {"planet bearings without gap", with_planet_clearance(base, 0), 0.0},
      {"unequal angles", with_bearing(problems::with_unequal_angles(base), BearingLaw::linear_radial, 10), 0.0},
  };
  double worst = 0.0;
  for (const Case& c : cases) {
    const double error = worst_potential_error(c.stage, c.w);
    EXPECT_LT(error, potential_tolerance) << c.name;
    worst = std::max(worst, error);
  }
  RecordProperty("worst_relative_error", std::to_string(worst * 1e15) + "e-15");
}

TEST(Forces, PlanetBearingsArePressedAlongTheirRadiusBeyondTheClearance) {
  const gear::Stage stage = with_planet_clearance(problems::r1(), 20);
  const Scales scales = scales_of(stage);
  const auto model = make_dynamic_model(stage, scales, 0.9, {});
  const double k = scales.stiffness(stage.planet.bearing_N_per_m);
  const double c = scales.damping(stage.planet.damping.of(stage.planet.bearing_N_per_m, stage.planet.mass_kg));
  StageForces f;
  constexpr double rounding = 1e-12;
  const auto at = [&](const std::string& name) {
    return static_cast<std::size_t>(std::ranges::find(model.state_names, name) - model.state_names.begin());
  };
  for (const double r : {0.0, 1.0, 1.9, 2.5, 7.0}) {  // half gap 2 b_c
    std::vector<double> y(model.dimension, 0.0);
    y[at("x_p1")] = 0.6 * r;
    y[at("y_p1")] = 0.8 * r;
    model.forces(0.3, y.data(), f);
    EXPECT_NEAR(f.planet_bearing[0], k * std::max(0.0, r - 2.0), rounding * k * 7.0) << r;
    EXPECT_EQ(f.planet_bearing[1], 0.0);
    // The damping acts through the gap.
    y[at("x_p1_rate")] = 0.3;
    model.forces(0.3, y.data(), f);
    EXPECT_NEAR(f.planet_bearing[0],
                std::hypot(k * 0.6 * std::max(0.0, r - 2.0) + c * 0.3, k * 0.8 * std::max(0.0, r - 2.0)),
                rounding * k * 7.0)
        << r;
  }
}

TEST(Forces, APlanetRestsByTheClearanceFurtherOut) {
  // Statically the clearance only turns the carrier: all forces are those of the stage without it.
  const gear::Stage without = problems::r1();
  const gear::Stage with = with_planet_clearance(without, 20);
  const Scales scales = scales_of(without);
  const auto rest = [&](const gear::Stage& stage) {
    const DynamicModel model = make_dynamic_model(stage, scales, 0.9, {});
    const std::vector<double> phase{0.7};
    const auto states = model.quasi_static_states(phase);
    StageForces f;
    if (!states.empty()) model.forces(phase[0], states[0].data(), f);
    return f;
  };
  const StageForces a = rest(without);
  const StageForces b = rest(with);
  ASSERT_EQ(a.planet_bearing.size(), planets);
  ASSERT_EQ(b.planet_bearing.size(), planets);
  for (std::size_t i = 0; i < planets; ++i) {
    constexpr double solver = 1e-5;  // load that Newton's method leaves, over the stage's softest support
    EXPECT_NEAR(b.planet_bearing[i] / a.planet_bearing[i], 1.0, solver) << i;
    EXPECT_NEAR(b.sun_planet_elastic[i] / a.sun_planet_elastic[i], 1.0, solver) << i;
  }
}

// ---- deflections ------------------------------------------------------------------------------------------------

/// Deflections of a displacement of the full coordinates, without errors.
Deflections<double, planets> deflections_of(const gear::Stage& stage, const std::array<double, dof>& q) {
  const auto p = make_parameters<planets>(stage, scales_of(stage), 1.0, {});
  return deflections(p, unpack<planets>(Layout::full, q.data()));
}

double largest_deflection(const Deflections<double, planets>& d, bool carrier = true) {
  double largest = 0.0;
  for (std::size_t i = 0; i < planets; ++i) {
    largest = std::max({largest, std::abs(d.sun_planet[i]), std::abs(d.ring_planet[i])});
    if (carrier) largest = std::max({largest, std::abs(d.carrier_x[i]), std::abs(d.carrier_y[i])});
    if (carrier) largest = std::max(largest, std::abs(d.carrier_u[i]));
  }
  return largest;
}

/// The whole train turned by theta, in units where r_c theta is given.
std::array<double, dof> whole_rotation(const gear::Stage& s, double turn) {
  std::array<double, dof> q{};
  const std::vector<double> angles = s.planet_angles_deg();
  q[Slots::w_s] = *s.sun.base_radius_mm * turn;
  for (std::size_t i = 0; i < planets; ++i) {
    const double phi = angles[i] * std::numbers::pi / 180.0;
    q[Slots::x_p(i)] = -*s.centre_distance_mm * std::sin(phi) * turn;
    q[Slots::y_p(i)] = *s.centre_distance_mm * std::cos(phi) * turn;
    q[Slots::w_p(i)] = *s.planet.base_radius_mm * turn;
  }
  q[Slots::u_r(planets)] = *s.ring.base_radius_mm * turn;
  q[Slots::u_c(Layout::full, planets)] = *s.centre_distance_mm * turn;
  return q;
}

/// The carrier held: the sun turns the planets and the ring back.
std::array<double, dof> fixed_carrier_rotation(double u) {
  std::array<double, dof> q{};
  q[Slots::w_s] = u;
  for (std::size_t i = 0; i < planets; ++i) q[Slots::w_p(i)] = -u;
  q[Slots::u_r(planets)] = -u;
  return q;
}

/// The rotation that the boundary leaves free, in any amount.
std::array<double, dof> free_rotation(const gear::Stage& s) {
  if (s.boundary != gear::Boundary::fixed_ring) return fixed_carrier_rotation(30.0);
  std::array<double, dof> q = whole_rotation(s, 1.0);
  const std::array<double, dof> back = fixed_carrier_rotation(q[Slots::u_r(planets)]);
  for (std::size_t k = 0; k < dof; ++k) q[k] += back[k];
  return q;
}

// Roundings of coordinates of order 100.
constexpr double rounding_100 = 1e-12;

TEST(Deflections, RigidMotionsOfTheWholeTrainGiveNone) {
  for (const gear::Stage& s : {problems::r1(), problems::with_unequal_angles(problems::r1())}) {
    EXPECT_LT(largest_deflection(deflections_of(s, whole_rotation(s, 1.0))), rounding_100);
    std::array<double, dof> shifted{};
    for (std::size_t i = 0; i < planets; ++i) shifted[Slots::x_p(i)] = shifted[Slots::y_p(i)] = 7.0;
    for (const std::size_t k :
         {Slots::x_s, Slots::y_s, Slots::x_r(planets), Slots::y_r(planets), Slots::x_c(planets), Slots::y_c(planets)})
      shifted[k] = 7.0;
    EXPECT_LT(largest_deflection(deflections_of(s, shifted)), rounding_100);
  }
}

TEST(Deflections, TheMechanismOfEachBoundaryGivesNone) {
  for (const gear::Stage& s : {problems::r1(), problems::with_unequal_angles(problems::r1())}) {
    // literal, star: the carrier held
    EXPECT_LT(largest_deflection(deflections_of(s, fixed_carrier_rotation(30.0))), rounding_100);
    // fixed_ring: the whole train forward, and back with the carrier held until the ring is where it was
    const std::array<double, dof> q = free_rotation(s);
    EXPECT_EQ(q[Slots::u_r(planets)], 0.0);
    EXPECT_GT(q[Slots::w_s], 0.0);
    EXPECT_LT(largest_deflection(deflections_of(s, q)), rounding_100);
  }
}

TEST(Deflections, AnyOtherRotationGivesSome) {
  std::array<double, dof> q = fixed_carrier_rotation(30.0);
  q[Slots::u_r(planets)] = 30.0;
  EXPECT_GT(largest_deflection(deflections_of(problems::r1(), q)), 1.0);
}

TEST(Deflections, Equation21IsAnIdentity) {
  const gear::Stage s = problems::with_unequal_errors(problems::with_unequal_angles(problems::r1()));
  const Scales scales = scales_of(s);
  const auto p = make_parameters<planets>(s, scales, 1.0, {});
  const MeshLaw sp(s, Which::sun_planet);
  const MeshLaw rp(s, Which::ring_planet);
  const gear::PressureAngles alpha = gear::pressure_angles(s);
  const std::vector<double> angles = s.planet_angles_deg();
  std::mt19937_64 random(21);
  std::uniform_real_distribution<double> displacement(-10.0, 10.0);
  constexpr std::size_t last = planets - 1;
  for (int trial = 0; trial < 100; ++trial) {
    std::array<double, 2 * dof> y;
    for (double& x : y) x = displacement(random);
    const double phase = 0.06 * trial;
    const StageState<double, planets> g = stage_state(Layout::full, p, 0, phase, y.data());
    const auto& d_sp = g.sun_planet.delta;
    const auto& d_rp = g.ring_planet.delta;
    const auto phi_sp = [&](std::size_t i) { return alpha.sun_planet - angles[i] * std::numbers::pi / 180.0; };
    const auto phi_rp = [&](std::size_t i) { return alpha.ring_planet + angles[i] * std::numbers::pi / 180.0; };
    const auto e_sp = [&](std::size_t i) { return sp.error(i, phase) / length_scale_m; };
    const auto e_rp = [&](std::size_t i) { return rp.error(i, phase) / length_scale_m; };
    const auto& q = g.q;
    const auto sun_part = [&](std::size_t i) {
      return (q.x_s - q.x_p[i]) * std::sin(phi_sp(i)) + (q.y_s - q.y_p[i]) * std::cos(phi_sp(i));
    };
    const auto ring_part = [&](std::size_t i) {
      return (q.x_p[i] - q.x_r) * std::sin(phi_rp(i)) - (q.y_p[i] - q.y_r) * std::cos(phi_rp(i));
    };
    for (std::size_t i = 0; i < planets; ++i) {
      const double by_21 = ring_part(i) + d_rp[last] - ring_part(last) + e_rp(last) + d_sp[last] - sun_part(last) +
                           e_sp(last) - (d_sp[i] - sun_part(i) + e_sp(i)) - e_rp(i);
      EXPECT_NEAR(d_rp[i], by_21, rounding_100);
    }
  }
}

// ---- action equals reaction -------------------------------------------------------------------------------------

TEST(Forces, MeshForcesAndFrictionNeitherPushNorTurnTheWholeTrain) {
  // Without supports, loads and frame terms all that is left is internal: forces and moments balance.
  gear::Stage s = problems::with_unequal_angles(problems::r1_nonlinear());
  s.sun.support_N_per_m = s.ring.support_N_per_m = s.carrier.support_N_per_m = 0.0;
  const Scales scales = scales_of(s);
  auto p = make_parameters<planets>(s, scales, 0.9, {GapDamping::always, Gyroscopic::off, 0.0});
  p.torsion_r = p.torsion_damping_r = 0.0;
  p.drive = p.ring_drive = p.carrier_load = 0.0;
  ASSERT_GT(p.segments.size(), 10U);
  std::mt19937_64 random(22);
  std::uniform_real_distribution<double> displacement(-4.0, 4.0);
  const std::array<double, dof> rotation = whole_rotation(s, 0.01);
  for (std::size_t segment = 0; segment < p.segments.size(); ++segment) {
    std::array<double, 2 * dof> y;
    for (double& x : y) x = displacement(random);
    const bool wraps = segment + 1 == p.segments.size();
    const double next = wraps ? p.breakpoints[0] + 2.0 * std::numbers::pi : p.breakpoints[segment + 1];
    const std::array<double, dof> f = forces(p, segment, 0.5 * (p.breakpoints[segment] + next), y);
    double x = f[Slots::x_s] + f[Slots::x_r(planets)] + f[Slots::x_c(planets)];
    double y_sum = f[Slots::y_s] + f[Slots::y_r(planets)] + f[Slots::y_c(planets)];
    double moment = 0.0;
    double friction = 0.0;
    for (std::size_t i = 0; i < planets; ++i) {
      x += f[Slots::x_p(i)];
      y_sum += f[Slots::y_p(i)];
      const auto g = stage_state(Layout::full, p, segment, 0.5 * (p.breakpoints[segment] + next), y.data());
      friction = std::max(friction, std::abs(g.sun_planet.friction[i]));
    }
    for (std::size_t k = 0; k < dof; ++k) moment += f[k] * rotation[k];
    EXPECT_GT(friction, 1e9 * rounding_100);  // else nothing is tested
    EXPECT_NEAR(x, 0.0, rounding_100);
    EXPECT_NEAR(y_sum, 0.0, rounding_100);
    EXPECT_NEAR(moment, 0.0, rounding_100);
  }
}

// ---- the free rotation ------------------------------------------------------------------------------------------

// The relative state leaves the reference member's rotation out, so no force may depend on it: a drag on an absolute
// rotation would, and would still be a number.
TEST(Forces, RelativeRatesAreThoseOfTheFullCoordinatesAtAnyPlaceAndSpeedOfTheFreeRotation) {
  const gear::Stage base = problems::with_unequal_angles(problems::r1_nonlinear());
  for (const gear::Stage& s : {base, problems::as_printed(base), problems::star(base), problems::rigid_ring(base)}) {
    const Layout layout = make_dynamic_model(s, scales_of(s), 0.9, {}, CoordinateChoice::relative).layout;
    const std::size_t n = degrees_of_freedom(layout, planets);
    const auto given = make_parameters<planets>(s, scales_of(s), 0.9, {});
    auto p = given;
    // A term whose constant is 0 in this stage would not be tried.
    for_each_constant(p, [](double& x) { x = x == 0.0 ? 0.1 : x; });
    p.sin_phi = given.sin_phi;
    p.cos_phi = given.cos_phi;
    p.sun_planet = given.sun_planet;
    p.ring_planet = given.ring_planet;
    // What the boundary leaves free has no support.
    if (s.boundary == gear::Boundary::fixed_ring) {
      p.torsion_c = p.torsion_damping_c = 0.0;
    } else {
      p.torsion_r = p.torsion_damping_r = 0.0;
    }
    const std::array<double, dof> free = free_rotation(s);
    std::mt19937_64 random(23);
    std::uniform_real_distribution<double> displacement(-4.0, 4.0);
    for (std::size_t segment = 0; segment < p.segments.size(); ++segment) {
      std::vector<double> relative(2 * n);
      for (double& x : relative) x = displacement(random);
      std::vector<double> rates(2 * n);
      right_hand_side(layout, p, PhaseCoefficients<double, planets>(p, segment, p.breakpoints[segment]),
                      relative.data(), rates.data());

      std::array<double, 2 * dof> y;
      pack(Layout::full, unpack<planets>(layout, relative.data()), y.data());
      pack(Layout::full, unpack<planets>(layout, relative.data() + n), y.data() + dof);
      for (std::size_t k = 0; k < dof; ++k) {
        y[k] += 0.1 * free[k];
        y[dof + k] += 0.3 * free[k];
      }
      Coordinates<double, planets> a =
          accelerations(p, stage_state(Layout::full, p, segment, p.breakpoints[segment], y.data()));
      make_relative(layout, p, a);
      std::vector<double> expected(n);
      pack(layout, a, expected.data());
      double largest = 0.0;
      for (const double x : expected) largest = std::max(largest, std::abs(x));
      for (std::size_t k = 0; k < n; ++k)
        EXPECT_NEAR(rates[n + k] * p.omega, expected[k], rounding_100 * largest)
            << "acceleration " << k << ", boundary " << static_cast<int>(s.boundary);
    }
  }
}

TEST(Forces, FrictionIsThatOfThePathInEverySegmentOfEveryPeriod) {
  const gear::Stage both = problems::with_unequal_angles(problems::r1_nonlinear());
  gear::Stage ring_only = problems::r1_nonlinear();  // its first breakpoint is not 0: the last segment wraps
  ring_only.sun_planet_mesh.friction.coefficient.reset();
  gear::Stage one_breakpoint = ring_only;
  one_breakpoint.ring_planet_mesh.friction.coefficient->contact_ratio = 1.0;
  for (const gear::Stage& s : {both, ring_only, one_breakpoint}) {
    const Scales scales = scales_of(s);
    const auto p = make_parameters<planets>(s, scales, 0.9, {GapDamping::always, Gyroscopic::off, 0.0});
    const MeshLaw sp(s, Which::sun_planet);
    const MeshLaw rp(s, Which::ring_planet);
    std::mt19937_64 random(23);
    std::uniform_real_distribution<double> displacement(-4.0, 4.0);
    std::array<double, 2 * dof> y;
    for (double& x : y) x = displacement(random);
    // Roundings of phases of some hundred turns.
    constexpr double rounding = 1e-11;
    for (std::size_t segment = 0; segment < p.segments.size(); ++segment) {
      const bool wraps = segment + 1 == p.segments.size();
      const double from = p.breakpoints[segment];
      const double next = wraps ? p.breakpoints[0] + 2.0 * std::numbers::pi : p.breakpoints[segment + 1];
      const double middle = 0.5 * (from + next);
      for (const double turns : {0.0, -1.0, 1.0, 100.0})
        for (const double phase : {from, middle, next}) {
          const double there = phase + 2.0 * std::numbers::pi * turns;
          const auto g = stage_state(Layout::full, p, segment, there, y.data());
          for (std::size_t i = 0; i < planets; ++i) {
            const auto sun = sp.friction(i, phase, middle);
            const auto ring = rp.friction(i, phase, middle);
            const double f_sp = g.sun_planet.force[i];
            const double f_rp = g.ring_planet.force[i];
            const double mm = 1e3;
            EXPECT_NEAR(g.sun_planet.friction[i], sun.force * f_sp, rounding);
            EXPECT_NEAR(g.sun_planet.moment_driving[i], sun.driving_m * mm / *s.sun.base_radius_mm * f_sp, rounding);
            EXPECT_NEAR(g.sun_planet.moment_driven[i], sun.driven_m * mm / *s.planet.base_radius_mm * f_sp, rounding);
            EXPECT_NEAR(g.ring_planet.friction[i], ring.force * f_rp, rounding);
            EXPECT_NEAR(g.ring_planet.moment_driving[i], ring.driving_m * mm / *s.planet.base_radius_mm * f_rp,
                        rounding);
            EXPECT_NEAR(g.ring_planet.moment_driven[i], ring.driven_m * mm / *s.ring.base_radius_mm * f_rp, rounding);
          }
        }
    }
  }
}

TEST(Forces, SmoothFrictionTablesFollowEachPlanetsPhase) {
  // A smooth table has no breakpoints, so that one segment must serve every planet's phase and every period.
  gear::Stage s = problems::with_teeth(problems::r1(), 28, 26, 80, 3);
  gear::FrictionTable table;
  constexpr std::size_t rows = 200;
  for (std::size_t k = 0; k < rows; ++k) {
    const double phase = static_cast<double>(k) / rows;
    table.phase.push_back(phase);
    table.force_ratio.push_back(0.05 * std::sin(2.0 * std::numbers::pi * phase));
    table.moment_driving_mm.push_back(3.0);
    table.moment_driven_mm.push_back(0.0);
  }
  s.sun_planet_mesh.friction.table = table;
  const auto p = make_parameters<planets>(s, scales_of(s), 0.9, {});
  std::array<double, 2 * dof> y{};
  y[Slots::w_s] = 5.0;
  // Steffen's cubic through 200 rows of a sine of 0.05, second order at the extrema: measured 2.5e-8.
  constexpr double table_error = 1e-6;
  for (double phase = 0.0; phase < 12.5; phase += 0.1) {
    const auto g = stage_state(Layout::full, p, 0, phase, y.data());
    for (std::size_t i = 0; i < planets; ++i) {
      const double own = phase + 2.0 * std::numbers::pi * 2.0 / 3.0 * static_cast<double>(i);
      EXPECT_NEAR(g.sun_planet.friction[i] / g.sun_planet.force[i], 0.05 * std::sin(own), table_error) << i;
      EXPECT_NEAR(g.sun_planet.moment_driving[i] / g.sun_planet.force[i], 3.0 / *s.sun.base_radius_mm, table_error);
    }
  }
}

TEST(Forces, GapDampingActsThroughTheGapOrByTheSlopeOfTheClearance) {
  const gear::Stage s = problems::with_gap(problems::r1());
  const Scales scales = scales_of(s);
  std::array<double, 2 * dof> y{};
  y[dof + Slots::w_s] = 0.5;  // all sun meshes approach, in the middle of their gaps
  const auto force = [&](GapDamping damping, double w) {
    const auto p = make_parameters<planets>(s, scales, 0.9, {damping, Gyroscopic::off, w});
    return stage_state(Layout::full, p, 0, 0.0, y.data()).sun_planet;
  };
  constexpr double rounding = 1e-14;
  const auto always = force(GapDamping::always, 0.0);
  const double c = make_parameters<planets>(s, scales, 0.9, {}).sun_planet.damping;
  EXPECT_NEAR(always.force[0], c * always.rate[0], rounding);
  EXPECT_EQ(force(GapDamping::contact_slope, 0.0).force[0], 0.0);
  const auto smooth = force(GapDamping::contact_slope, 0.5);
  const Closure<double> closed = closure_smooth(smooth.delta[0], 4.0, 0.5);
  EXPECT_NEAR(smooth.force[0], closed.value + c * closed.slope * smooth.rate[0], rounding);
}

// ---- sun bearing ------------------------------------------------------------------------------------------------

Parameters<double, planets> bearing_parameters(gear::BearingLaw law, double half_gap_um, double w) {
  const gear::Stage s = with_bearing(problems::r1(), law, half_gap_um);
  return make_parameters<planets>(s, scales_of(s), 1.0, {GapDamping::always, Gyroscopic::off, w});
}

TEST(SunBearing, IntegralOfTheTangentStiffnessIsThePalmgrenForce) {
  // docs/theory/parameters.md, section 5: k of 6213 at 10 um is 1.343e8 N/m, F is 895.5 N; radial law (2/3) k d,
  // literal law k d.
  constexpr double um = 1e-6;
  constexpr double digit_N = 0.06;
  const Scales scales = scales_of(problems::r1());
  const auto radial = bearing_parameters(gear::BearingLaw::palmgren_radial, 10.0, 0.0);
  const auto force = [&](double approach_um) {
    const double r = scales.displacement((10.0 + approach_um) * um);
    return scales.force_newton(sun_bearing_force(radial, 0.6 * r, 0.8 * r).x) / 0.6;
  };
  EXPECT_NEAR(force(1.0), 28.3, digit_N);
  EXPECT_NEAR(force(5.0), 316.6, digit_N);
  EXPECT_NEAR(force(10.0), 895.5, digit_N);
  EXPECT_NEAR(force(20.0), 2532.9, digit_N);

  // Gauss-Legendre in sqrt(d) is exact here: integral of K sqrt(d) dd = integral of 2 K t^2 dt, t = sqrt(d).
  const double coefficient = gear::palmgren_coefficient({10.0, gear::BearingLaw::palmgren_radial, 10, 16.67, 0.0});
  const double top = std::sqrt(10.0 * um);
  const double node = 1.0 / std::sqrt(3.0);
  double integral = 0.0;
  for (const double x : {-node, node}) {
    const double t = 0.5 * top * (1.0 + x);
    integral += 0.5 * top * 2.0 * coefficient * t * t;
  }
  constexpr double rounding = 1e-12;
  EXPECT_NEAR(force(10.0) / integral, 1.0, rounding);

  const auto as_printed = bearing_parameters(gear::BearingLaw::palmgren_xy, 10.0, 0.0);
  const double x = scales.displacement(20.0 * um);
  EXPECT_NEAR(scales.force_newton(sun_bearing_force(as_printed, x, 0.0).x) / (1.5 * integral), 1.0, rounding);
  EXPECT_EQ(sun_bearing_force(as_printed, x, 0.0).y, 0.0);
}

TEST(SunBearing, RadialLawsPushAlongTheRadiusAndSmoothFormsFollowTheirClosure) {
  constexpr double rounding = 1e-13;
  for (const double w : {0.0, 0.2})
    for (const auto law : {gear::BearingLaw::linear_radial, gear::BearingLaw::palmgren_radial}) {
      const auto p = bearing_parameters(law, 10.0, w);
      for (const double r : {0.3, 0.99, 1.7, 6.0})
        for (double angle = 0.1; angle < 6.0; angle += 0.7) {
          const auto f = sun_bearing_force(p, r * std::cos(angle), r * std::sin(angle));
          const double closed = closure(r, 1.0, w, w > 0.0).value;
          const double expected = law == gear::BearingLaw::linear_radial
                                      ? p.support_s * closed
                                      : 2.0 / 3.0 * p.sun_hertz * std::pow(closed, 1.5);
          EXPECT_NEAR(f.x, expected * std::cos(angle), rounding);
          EXPECT_NEAR(f.y, expected * std::sin(angle), rounding);
        }
    }
  for (const double w : {0.0, 0.2})
    for (const auto law : {gear::BearingLaw::linear_xy, gear::BearingLaw::palmgren_xy}) {
      const auto p = bearing_parameters(law, 10.0, w);
      for (const double x : {-6.0, -0.5, 0.4, 1.7}) {
        const double closed = closure(x, 1.0, w, w > 0.0).value;
        const double expected = law == gear::BearingLaw::linear_xy
                                    ? p.support_s * closed
                                    : std::copysign(p.sun_hertz * std::pow(std::abs(closed), 1.5), closed);
        EXPECT_NEAR(sun_bearing_force(p, x, 0.3).x, expected, rounding);
        EXPECT_NEAR(sun_bearing_force(p, 0.3, x).y, expected, rounding);
      }
    }
}

TEST(SunBearing, TangentsAtTheCentreAreFiniteAndRight) {
  using D = Dual<2>;
  for (const double half_gap_um : {0.0, 10.0})
    for (const double w : {0.0, 0.2})
      for (const auto law : {gear::BearingLaw::linear_xy, gear::BearingLaw::palmgren_xy,
                             gear::BearingLaw::linear_radial, gear::BearingLaw::palmgren_radial}) {
        const auto p = bearing_parameters(law, half_gap_um, w);
        const auto f = sun_bearing_force(convert<D>(p), D::variable(0.0, 0), D::variable(0.0, 1));
        // Linear laws: k times the slope of the closure at 0. Hertz: the tangent stiffness is 0 where the closure is.
        const double b = p.sun_half_gap;
        const double slope = w > 0.0 ? 1.0 - b / std::hypot(b, w) : (b > 0.0 ? 0.0 : 1.0);
        const bool linear = law == gear::BearingLaw::linear_xy || law == gear::BearingLaw::linear_radial;
        const double expected = linear ? p.support_s * slope : 0.0;
        constexpr double rounding = 1e-14;
        const int number = static_cast<int>(law);
        EXPECT_EQ(f.x.value, 0.0) << number;
        EXPECT_EQ(f.y.value, 0.0) << number;
        EXPECT_NEAR(f.x.derivative[0], expected, rounding) << number << " b " << b << " w " << w;
        EXPECT_NEAR(f.y.derivative[1], expected, rounding) << number << " b " << b << " w " << w;
        EXPECT_NEAR(f.x.derivative[1], 0.0, rounding) << number << " b " << b << " w " << w;
        EXPECT_NEAR(f.y.derivative[0], 0.0, rounding) << number << " b " << b << " w " << w;
      }
}

}  // namespace
}  // namespace epicyclic::model::forces_test
