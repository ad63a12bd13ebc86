// Every mode of drive, on random stages: power and torque of all members balance, the loaded flank carries, and a stage
// that runs backward is the mirror image in time.
//
//   power    sum v (m a) = torques + errors' rates and springs + damping + friction      at any state, full coordinates
//   torque   r_bs sum F_sp = T_s ,  r_br sum F_rp = T_r ,  T_s + T_r = T_c ,  F_spi = F_rpi      at rest
//
// Limits: the balance of power is that of the linear geometry of docs/theory/model.md; frame terms do no work together.

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/dense.hpp"
#include "gear/kinematics.hpp"
#include "gear/reversal.hpp"
#include "model/dispatch.hpp"
#include "model/dynamic_model.hpp"
#include "model/kernels/stage_kernel.hpp"
#include "model/parameters.hpp"
#include "model/right_hand_side.hpp"
#include "problems/r1.hpp"

namespace epicyclic::model::drive_modes_test {
namespace {

using gear::Boundary;
using gear::Driver;

constexpr double two_pi = 2.0 * std::numbers::pi;
constexpr double omega = 0.9;
constexpr std::size_t stages = 200;

struct Mode {
  const char* name;
  Boundary boundary;
  Driver driver;
};
constexpr std::array<Mode, 9> modes = {{{"sun in, carrier out", Boundary::fixed_ring, Driver::sun},
                                        {"carrier in, sun out", Boundary::fixed_ring, Driver::carrier},
                                        {"sun in, ring out", Boundary::star, Driver::sun},
                                        {"ring in, sun out", Boundary::star, Driver::ring},
                                        {"carrier in, ring out", Boundary::fixed_sun, Driver::carrier},
                                        {"ring in, carrier out", Boundary::fixed_sun, Driver::ring},
                                        {"differential, sun ahead", Boundary::free, Driver::sun},
                                        {"differential, sun behind", Boundary::free, Driver::carrier},
                                        {"as printed", Boundary::as_printed, Driver::sun}}};

class Draw {
 public:
  explicit Draw(std::uint64_t seed) : random_(seed) {}
  double between(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  int whole(int low, int high) { return std::uniform_int_distribution<int>(low, high)(random_); }
  bool coin() { return whole(0, 1) == 1; }
  std::vector<double> list(int count, double low, double high) {
    std::vector<double> all;
    for (int i = 0; i < count; ++i) all.push_back(between(low, high));
    return all;
  }
  /// One number, or one per planet.
  std::vector<double> planets(int count, double low, double high) { return list(coin() ? count : 1, low, high); }

 private:
  std::mt19937_64 random_;
};

/// With everything that a stage may have, but for EHL friction.
gear::Stage random_stage(std::size_t number) {
  Draw draw(1000 + number);
  const int n = draw.whole(2, 6);
  const int z_s = draw.whole(15, 40);
  const int z_p = draw.whole(15, 50);
  gear::Stage s = problems::with_moving_stiffness(problems::with_gap(problems::r1(), draw.between(5.0, 60.0)));
  if (draw.coin()) s = problems::with_friction(s, draw.between(0.01, 0.1));
  s = problems::with_teeth(s, z_s, z_p, z_s + 2 * z_p, n);
  const Mode& mode = modes[number % modes.size()];
  s.name = mode.name;
  s.boundary = mode.boundary;
  s.driver = mode.driver;
  const auto torsion = [&](gear::CentralMember& m, bool held) {
    m.torsional_support_N_per_m = held ? draw.between(1e8, 2e9) : 0.0;
  };
  torsion(s.sun, mode.boundary == Boundary::fixed_sun);
  torsion(s.ring, mode.boundary == Boundary::fixed_ring);
  torsion(s.carrier, mode.boundary == Boundary::star || mode.boundary == Boundary::as_printed);
  if (mode.boundary == Boundary::free) s.carrier_to_sun_speed = draw.between(-2.0, 0.9);
  for (gear::CentralMember* m : {&s.sun, &s.ring, &s.carrier}) {
    m->mass_kg = draw.between(0.5, 8.0);
    m->inertia_over_r2_kg = draw.between(0.5, 8.0);
    m->support_N_per_m = draw.between(1e7, 4e8);
  }
  s.planet.mass_kg = draw.planets(n, 0.3, 2.0);
  s.planet.inertia_over_r2_kg = draw.planets(n, 0.3, 2.0);
  s.planet.bearing_N_per_m = draw.planets(n, 5e7, 5e8);
  s.planet.pin_error_tangential_um = draw.planets(n, -5.0, 5.0);
  s.planet.pin_error_radial_um = draw.planets(n, -5.0, 5.0);
  s.angles_deg.clear();
  if (draw.coin())
    for (int i = 0; i < n; ++i) s.angles_deg.push_back(360.0 / n * (i + draw.between(-0.2, 0.2)));
  for (gear::Mesh* mesh : {&s.sun_planet_mesh, &s.ring_planet_mesh}) {
    mesh->error_amplitude_um = draw.planets(n, 0.0, 8.0);
    mesh->error_phase_deg = draw.planets(n, -180.0, 180.0);
    mesh->error_mean_um = draw.planets(n, -3.0, 3.0);
  }
  s.load = {std::nullopt, draw.between(100.0, 800.0) * (draw.coin() ? 1.0 : -1.0)};
  return s;
}

/// Sum of terms and their size.
struct Sum {
  double value = 0, size = 0;
  Sum& operator+=(double x) {
    value += x;
    size += std::abs(x);
    return *this;
  }
};

/// Power that the members gain, less what acts on them, over the size of all terms.
template <std::size_t N>
double power_off_balance(const gear::Stage& stage, Draw& draw) {
  const auto p = make_parameters<N>(stage, scales_of(stage), omega, {});
  const std::size_t n = degrees_of_freedom(Layout::full, N);
  const double s = draw.between(0.0, two_pi);
  std::vector<double> y;
  for (std::size_t i = 0; i < 2 * n; ++i) y.push_back(draw.between(-6.0, 6.0));
  const std::size_t segment = segment_at(p.breakpoints, s);
  const auto g = stage_state(Layout::full, p, segment, s, y.data());
  const PhaseCoefficients<double, N> now(p, segment, s);
  const auto a = accelerations(p, g);
  const auto& q = g.q;
  const auto& v = g.v;
  Sum sum;
  const auto of_member = [&](double mass, double inertia, double x_rate, double y_rate, double u_rate, double a_x,
                             double a_y, double a_u) {
    sum += mass * x_rate * a_x;
    sum += mass * y_rate * a_y;
    sum += inertia * u_rate * a_u;
  };
  of_member(p.mass_s, p.inertia_s, v.x_s, v.y_s, v.w_s, a.x_s, a.y_s, a.w_s);
  of_member(p.mass_r, p.inertia_r, v.x_r, v.y_r, v.u_r, a.x_r, a.y_r, a.u_r);
  of_member(p.mass_c, p.inertia_c, v.x_c, v.y_c, v.u_c, a.x_c, a.y_c, a.u_c);
  // The potential of the turning frame; Coriolis forces do no work.
  const double wc2 = p.carrier_speed * p.carrier_speed;
  const auto frame = [&](double mass, double x, double x_rate) { sum += -mass * wc2 * x * x_rate; };
  frame(p.mass_s, q.x_s, v.x_s), frame(p.mass_s, q.y_s, v.y_s);
  frame(p.mass_r, q.x_r, v.x_r), frame(p.mass_r, q.y_r, v.y_r);
  frame(p.mass_c, q.x_c, v.x_c), frame(p.mass_c, q.y_c, v.y_c);
  // Torques and supports.
  sum += -p.drive * v.w_s;
  sum += -p.ring_drive * v.u_r;
  sum += p.carrier_load * v.u_c;
  const auto support = [&](double k, double c, double x, double x_rate) { sum += (k * x + c * x_rate) * x_rate; };
  support(p.support_s, p.damping_s, q.x_s, v.x_s), support(p.support_s, p.damping_s, q.y_s, v.y_s);
  support(p.support_r, p.damping_r, q.x_r, v.x_r), support(p.support_r, p.damping_r, q.y_r, v.y_r);
  support(p.support_c, p.damping_c, q.x_c, v.x_c), support(p.support_c, p.damping_c, q.y_c, v.y_c);
  support(p.torsion_s, p.torsion_damping_s, q.w_s, v.w_s);
  support(p.torsion_r, p.torsion_damping_r, q.u_r, v.u_r);
  support(p.torsion_c, p.torsion_damping_c, q.u_c, v.u_c);
  for (std::size_t i = 0; i < N; ++i) {
    of_member(p.mass_p[i], p.inertia_p[i], v.x_p[i], v.y_p[i], v.w_p[i], a.x_p[i], a.y_p[i], a.w_p[i]);
    const bool invariant = p.gyroscopic_relative;
    const double u = invariant ? q.u_c : 0.0;
    const double u_rate = invariant ? v.u_c : 0.0;
    frame(p.mass_p[i], q.x_p[i] + u * p.sin_phi[i], v.x_p[i] + u_rate * p.sin_phi[i]);
    frame(p.mass_p[i], q.y_p[i] - u * p.cos_phi[i], v.y_p[i] - u_rate * p.cos_phi[i]);
    support(p.bearing_p[i], p.bearing_damping_p[i], g.d.carrier_x[i], g.d_rate.carrier_x[i]);
    support(p.bearing_p[i], p.bearing_damping_p[i], g.d.carrier_y[i], g.d_rate.carrier_y[i]);
    const auto& sun = p.sun_planet;
    const auto& ring = p.ring_planet;
    // A mesh takes power by the rate of its members' displacements, which is that of its deflection and its error.
    sum += g.sun_planet.force[i] * (g.sun_planet.rate[i] + now.sun_planet.error_rate[i]);
    sum += g.ring_planet.force[i] * (g.ring_planet.rate[i] + now.ring_planet.error_rate[i]);
    sum += g.sun_planet.friction[i] * ((v.x_s - v.x_p[i]) * sun.cosine[i] - (v.y_s - v.y_p[i]) * sun.sine[i]);
    sum += -g.sun_planet.moment_driving[i] * v.w_s;
    sum += -g.sun_planet.moment_driven[i] * v.w_p[i];
    sum += g.ring_planet.friction[i] * ((v.x_p[i] - v.x_r) * ring.cosine[i] + (v.y_p[i] - v.y_r) * ring.sine[i]);
    sum += g.ring_planet.moment_driving[i] * v.w_p[i];
    sum += -g.ring_planet.moment_driven[i] * v.u_r;
  }
  return std::abs(sum.value) / sum.size;
}

TEST(DriveModes, PowerBalancesOnAllMembers) {
  double worst = 0.0;
  for (std::size_t k = 0; k < stages; ++k) {
    const gear::Stage stage = random_stage(k);
    ASSERT_TRUE(gear::problems_for_dynamics(stage).empty()) << gear::problems_for_dynamics(stage)[0];
    Draw draw(77 + k);
    const double off = with_planets(stage.planet_count, [&]<std::size_t N>() {
      if constexpr (N == 1)
        return std::numeric_limits<double>::quiet_NaN();  // a pair
      else
        return power_off_balance<N>(stage, draw);
    });
    EXPECT_LT(off, 1e-13) << k << ' ' << stage.name;
    worst = std::max(worst, off);
  }
  EXPECT_GT(worst, 0.0);
}

/// The train accelerates as printed, and has no torque balance.
bool is_driven(const gear::Stage& stage) { return stage.boundary != Boundary::as_printed; }

/// Newton's method for a = 0 at rest, by differences of one, from an equilibrium that is known to the tolerance of the
/// solver. The accelerations are linear while no contact changes.
template <std::size_t N>
std::vector<double> to_rounding(const gear::Stage& stage, double s, std::vector<double> state) {
  const Layout layout = layout_of(stage, CoordinateChoice::relative);
  auto p = make_parameters<N>(stage, scales_of(stage), omega, {});
  p.carrier_speed = 0.0;
  p.centrifugal.fill(0.0);
  p.sun_planet.damping = p.ring_planet.damping = 0.0;
  const std::size_t n = degrees_of_freedom(layout, N);
  const StageKernel<N> right_hand_side = stage_kernel<N>(layout);
  const auto acceleration = [&] {
    std::vector<double> slope(2 * n);
    right_hand_side(layout, p, segment_at(p.breakpoints, s), s, state.data(), slope.data());
    return Eigen::VectorXd(Eigen::Map<const Eigen::VectorXd>(slope.data() + n, static_cast<Eigen::Index>(n)));
  };
  for (int step = 0; step < 3; ++step) {
    constexpr double small = 1e-7;
    const Eigen::VectorXd here = acceleration();
    Eigen::MatrixXd stiffness(n, n);
    for (std::size_t c = 0; c < n; ++c) {
      const double from = state[c];
      state[c] = from + small;
      stiffness.col(static_cast<Eigen::Index>(c)) = (acceleration() - here) / (state[c] - from);
      state[c] = from;
    }
    const Eigen::VectorXd move = least_norm_solution(stiffness, -here);
    for (std::size_t c = 0; c < n; ++c) state[c] += move(static_cast<Eigen::Index>(c));
  }
  return state;
}

TEST(DriveModes, TorquesBalanceOnAllMembers) {
  for (std::size_t k = 0; k < stages; ++k) {
    gear::Stage stage = random_stage(k);
    if (!is_driven(stage)) continue;
    stage.sun_planet_mesh.friction = stage.ring_planet_mesh.friction = {};
    const Scales scales = scales_of(stage);
    const DynamicModel m = make_dynamic_model(stage, scales, omega, {});
    const std::vector<double> phases = {0.3, 2.0, 4.4};
    auto states = m.quasi_static_states(phases);
    ASSERT_EQ(states.size(), phases.size()) << k;
    constexpr double rounding = 1e-12;
    for (std::size_t j = 0; j < phases.size(); ++j) {
      states[j] = with_planets(stage.planet_count,
                               [&]<std::size_t N>() { return to_rounding<N>(stage, phases[j], states[j]); });
      StageForces f;
      MeshDeflections d;
      m.forces(phases[j], states[j].data(), f);
      m.deflections(phases[j], states[j].data(), d);
      const double torque = std::abs(*stage.load.torque_Nm);
      const double r_s = *stage.sun.base_radius_mm * 1e-3;
      const double r_r = *stage.ring.base_radius_mm * 1e-3;
      double on_sun = 0.0;
      double on_ring = 0.0;
      for (std::size_t i = 0; i < f.sun_planet_elastic.size(); ++i) {
        on_sun += r_s * scales.force_newton(f.sun_planet_elastic[i]);
        on_ring += r_r * scales.force_newton(f.ring_planet_elastic[i]);
        // No torque is left on a planet.
        EXPECT_NEAR(f.sun_planet_elastic[i], f.ring_planet_elastic[i], rounding * m.static_mesh_force) << k;
        EXPECT_GE(f.sun_planet_elastic[i], -1e-9) << k << " the back flank carries";
        EXPECT_NE(DynamicModel::contact(d.sun_planet[i], m.sun_planet_half_gap), Contact::back) << k;
      }
      const gear::Torques t = gear::torques(stage, omega * scales.omega_sn);
      EXPECT_NEAR(on_sun, torque, rounding * torque) << k << ' ' << stage.name;
      EXPECT_NEAR(on_ring / on_sun, r_r / r_s, rounding * r_r / r_s) << k << ' ' << stage.name;
      // What is on the carrier is the sum of both, by the bearings.
      if (t.carrier > 0.0) {
        EXPECT_NEAR(on_sun + on_ring, t.carrier, rounding * t.carrier) << k;
      }
      if (t.ring > 0.0) {
        EXPECT_NEAR(on_ring, t.ring, rounding * t.ring) << k;
      }
    }
  }
}

/// Speeds of sun, carrier and ring along the torque on the sun, as multiples of omega_m.
std::array<double, 3> speeds_of(const gear::Stage& s) {
  const double direction = s.runs_backward() ? -1.0 : 1.0;
  const double sign = s.boundary == Boundary::fixed_sun ? -1.0 : 1.0;
  const gear::Speeds w = gear::speeds(s, 1.0);
  const double carrier = direction * sign * w.carrier;
  return {direction * w.sun, carrier, carrier - direction / *s.ring.teeth};
}

TEST(DriveModes, WhatGoesInComesOut) {
  for (std::size_t k = 0; k < stages; ++k) {
    const gear::Stage s = random_stage(k);
    if (!is_driven(s)) continue;
    const auto [sun, carrier, ring] = speeds_of(s);
    const double ratio = static_cast<double>(*s.ring.teeth) / *s.sun.teeth;
    const double in_sun = sun;
    const double in_ring = ratio * ring;
    const double in_carrier = -(1.0 + ratio) * carrier;
    EXPECT_NEAR(in_sun + in_ring + in_carrier, 0.0, 1e-15) << k << ' ' << s.name;
    EXPECT_NEAR((sun - carrier) * *s.sun.teeth, s.runs_backward() ? -1.0 : 1.0, 1e-13) << k;
    // Who drives puts power in.
    if (s.boundary == Boundary::free) {
      EXPECT_GT((s.runs_backward() ? -1.0 : 1.0) * in_sun, 0.0) << k;
      continue;
    }
    EXPECT_GT(s.driver == Driver::sun ? in_sun : s.driver == Driver::ring ? in_ring : in_carrier, 0.0) << s.name;
  }
}

/// Full displacements or velocities in the coordinates of the stage: docs/theory/model.md, section 4.
template <std::size_t N>
std::vector<double> in_relative_coordinates(const gear::Stage& stage, Layout layout, const double* full) {
  const gear::PressureAngles alpha = gear::pressure_angles(stage);
  const double sun = std::cos(alpha.sun_planet);
  const double both = sun + std::cos(alpha.ring_planet);
  Coordinates<double, N> q = unpack<N>(Layout::full, full);
  const std::vector<double> angles = stage.angles_along_torque_deg();
  const double u_c = q.u_c;
  const double u_r = q.u_r;
  const auto planets = [&](double turned) {
    for (std::size_t i = 0; i < N; ++i) {
      q.w_p[i] += turned;
      if (!stage.has_free_carrier()) continue;
      q.x_p[i] += u_c * std::sin(angles[i] * std::numbers::pi / 180.0);
      q.y_p[i] -= u_c * std::cos(angles[i] * std::numbers::pi / 180.0);
    }
  };
  switch (stage.boundary) {
    case Boundary::fixed_ring:
      q.w_s -= u_c * both;
      planets(u_c * (both - sun));
      break;
    case Boundary::fixed_sun:
      q.u_r -= u_c * both;
      planets(-u_c * sun);
      break;
    case Boundary::free:
      q.w_s += u_r - u_c * both;
      planets(u_c * (both - sun) - u_r);
      break;
    default:
      q.w_s += u_r;
      planets(-u_r);
  }
  std::vector<double> relative(degrees_of_freedom(layout, N));
  pack<N>(layout, q, relative.data());
  return relative;
}

TEST(DriveModes, RelativeCoordinatesMoveAsTheFullOnesDo) {
  for (std::size_t k = 0; k < stages; ++k) {
    const gear::Stage stage = random_stage(k);
    Draw draw(900 + k);
    ModelOptions options;
    if (stage.boundary == Boundary::as_printed) options.gyroscopic = Gyroscopic::off;
    const Scales scales = scales_of(stage);
    const DynamicModel full = make_dynamic_model(stage, scales, omega, options, CoordinateChoice::full);
    const DynamicModel relative = make_dynamic_model(stage, scales, omega, options);
    const std::size_t n = full.dimension / 2;
    const std::size_t m = relative.dimension / 2;
    std::vector<double> y;
    for (std::size_t i = 0; i < 2 * n; ++i) y.push_back(draw.between(-6.0, 6.0));
    const double s = draw.between(0.1, two_pi);
    const std::size_t segment = segment_at(full.breakpoints, s);
    std::vector<double> slope(2 * n);
    full.right_hand_side(segment, s, y.data(), slope.data());
    const auto reduced = [&](const double* list) {
      return with_planets(stage.planet_count,
                          [&]<std::size_t N>() { return in_relative_coordinates<N>(stage, relative.layout, list); });
    };
    std::vector<double> z = reduced(y.data());
    const std::vector<double> rates = reduced(y.data() + n);
    z.insert(z.end(), rates.begin(), rates.end());
    std::vector<double> of_relative(2 * m);
    relative.right_hand_side(segment, s, z.data(), of_relative.data());
    const std::vector<double> expected = reduced(slope.data() + n);
    double size = 0.0;
    for (const double x : slope) size = std::max(size, std::abs(x));
    for (std::size_t i = 0; i < m; ++i)
      EXPECT_NEAR(of_relative[m + i], expected[i], 1e-12 * size) << k << ' ' << stage.name << ' ' << i;
  }
}

/// The stage that does what another does while time runs backward: dissipation then gives energy.
gear::Stage in_reverse(gear::Stage s) {
  const auto opposite = [](std::optional<double>& x) {
    if (x) *x = -*x;
  };
  for (gear::Mesh* mesh : {&s.sun_planet_mesh, &s.ring_planet_mesh}) {
    opposite(mesh->damping_ratio);
    if (mesh->friction.coefficient) mesh->friction.coefficient->coefficient *= -1.0;
  }
  for (gear::SupportDamping* d : {&s.sun.damping, &s.ring.damping, &s.carrier.damping, &s.planet.damping})
    opposite(d->ratio);
  return s;
}

Driver other(const gear::Stage& s) {
  if (s.boundary == Boundary::fixed_sun) return s.driver == Driver::ring ? Driver::carrier : Driver::ring;
  if (s.driver != Driver::sun) return Driver::sun;
  return s.boundary == Boundary::star ? Driver::ring : Driver::carrier;
}

/// The other member drives, the torque has the other sign: this is the mirror image, with time running backward.
TEST(DriveModes, TheOtherMemberDrivesWithTheOtherTorque) {
  for (std::size_t k = 0; k < stages; ++k) {
    const gear::Stage given = random_stage(k);
    if (!is_driven(given)) continue;
    gear::Stage turned = given;
    turned.driver = other(given);
    turned.load.torque_Nm = -*given.load.torque_Nm;
    gear::Stage image = in_reverse(given);
    image.angles_deg = given.planet_angles_deg();
    for (double& angle : image.angles_deg) angle = -angle;
    for (auto* errors : {&turned.planet.pin_error_tangential_um, &turned.planet.eccentricity_phase_deg})
      if (*errors)
        for (double& x : **errors) x = -x;
    const DynamicModel a = make_dynamic_model(turned, scales_of(turned), omega, {});
    const DynamicModel b = make_dynamic_model(image, scales_of(image), omega, {});
    // The image as it is given, not as its torque mirrors it.
    Draw draw(5 + k);
    const std::size_t n = a.dimension / 2;
    const double s = draw.between(0.1, two_pi - 0.1);
    std::vector<double> y;
    for (std::size_t i = 0; i < 2 * n; ++i) y.push_back(draw.between(-6.0, 6.0));
    std::vector<double> back = y;
    for (std::size_t i = n; i < 2 * n; ++i) back[i] = -back[i];
    std::vector<double> of_a(2 * n);
    std::vector<double> of_b(2 * n);
    a.right_hand_side(segment_at(a.breakpoints, s), s, y.data(), of_a.data());
    b.right_hand_side(segment_at(b.breakpoints, two_pi - s), two_pi - s, back.data(), of_b.data());
    double size = 0.0;
    for (const double x : of_a) size = std::max(size, std::abs(x));
    for (std::size_t i = n; i < 2 * n; ++i) EXPECT_NEAR(of_a[i], of_b[i], 1e-12 * size) << k << ' ' << given.name;
  }
}

}  // namespace
}  // namespace epicyclic::model::drive_modes_test
