// Energy balance of docs/theory/model.md, section 2: what the vibration gains is the work done on it.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "model/parameters.hpp"
#include "model/right_hand_side.hpp"
#include "problems/gear_flow.hpp"
#include "problems/mesh_laws.hpp"
#include "problems/r1.hpp"

namespace epicyclic::identities_energy_test {
namespace {

using model::Layout;
using problems::MeshLaw;
using problems::Which;

constexpr std::size_t planets = 3;
constexpr double omega = 0.9;
constexpr Layout layout = Layout::full;

/// Closed part of a gap: the potential over k.
double gap_energy(double d, double b) {
  const double closed = std::max(std::abs(d) - b, 0.0);
  return 0.5 * closed * closed;
}

class Ledger {
 public:
  Ledger(const gear::Stage& stage, const model::ModelOptions& options)
      : scales_(model::scales_of(stage)),
        p_(model::make_parameters<planets>(stage, scales_, omega, options)),
        sp_(stage, Which::sun_planet),
        rp_(stage, Which::ring_planet) {}

  /// Kinetic and elastic energy, with the centrifugal potential of the turning frame.
  [[nodiscard]] double energy(double s, const double* y) const {
    const auto g = model::stage_state(layout, p_, 0, s, y);
    const auto& q = g.q;
    const auto& v = g.v;
    const auto square = [](double a, double b) { return a * a + b * b; };
    const double wc2 = p_.carrier_speed * p_.carrier_speed;
    const auto moving = [&](double mass, double x, double y_, double x_rate, double y_rate) {
      return 0.5 * mass * (square(x_rate, y_rate) - wc2 * square(x, y_));
    };
    double e = moving(p_.mass_s, q.x_s, q.y_s, v.x_s, v.y_s) + moving(p_.mass_r, q.x_r, q.y_r, v.x_r, v.y_r) +
               moving(p_.mass_c, q.x_c, q.y_c, v.x_c, v.y_c);
    e += 0.5 * (p_.inertia_s * v.w_s * v.w_s + p_.inertia_r * v.u_r * v.u_r + p_.inertia_c * v.u_c * v.u_c);
    e += 0.5 * p_.support_s * 2.0 * (gap_energy(q.x_s, p_.sun_half_gap) + gap_energy(q.y_s, p_.sun_half_gap));
    e += 0.5 * p_.support_r * square(q.x_r, q.y_r) + 0.5 * p_.support_c * square(q.x_c, q.y_c);
    e += 0.5 * p_.torsion_s * q.w_s * q.w_s + 0.5 * p_.torsion_r * q.u_r * q.u_r + 0.5 * p_.torsion_c * q.u_c * q.u_c;
    for (std::size_t i = 0; i < planets; ++i) {
      e += 0.5 * p_.mass_p[i] * square(v.x_p[i], v.y_p[i]) + 0.5 * p_.inertia_p[i] * v.w_p[i] * v.w_p[i];
      double x = q.x_p[i];
      double y_ = q.y_p[i];
      if (p_.gyroscopic_relative) {
        x += q.u_c * p_.sin_phi[i];
        y_ -= q.u_c * p_.cos_phi[i];
      }
      e -= 0.5 * p_.mass_p[i] * wc2 * square(x, y_);
      // (r_c + r)^2 / 2 along each planet's radius, the part that is linear in the displacement r.
      e -= p_.centrifugal[i] * (q.x_p[i] * p_.cos_phi[i] + q.y_p[i] * p_.sin_phi[i]);
      e += 0.5 * p_.bearing_p[i] * square(g.d.carrier_x[i], g.d.carrier_y[i]);
      e += scales_.stiffness(sp_.stiffness(i, s)) * gap_energy(g.sun_planet.delta[i], p_.sun_planet.half_gap);
      e += scales_.stiffness(rp_.stiffness(i, s)) * gap_energy(g.ring_planet.delta[i], p_.ring_planet.half_gap);
    }
    return e;
  }

  /// Work per s, by cause.
  struct Power {
    double torques = 0, moving_mesh = 0, mesh_damping = 0, support_damping = 0, friction = 0;
    [[nodiscard]] double sum() const { return torques + moving_mesh + mesh_damping + support_damping + friction; }
  };

  [[nodiscard]] Power power(std::size_t segment, double s, const double* y) const {
    const auto g = model::stage_state(layout, p_, segment, s, y);
    const auto& v = g.v;
    const auto square = [](double a, double b) { return a * a + b * b; };
    Power w;
    w.torques = p_.drive * v.w_s + p_.ring_drive * v.u_r - p_.carrier_load * v.u_c;
    w.support_damping = -p_.damping_s * square(v.x_s, v.y_s) - p_.damping_r * square(v.x_r, v.y_r) -
                        p_.damping_c * square(v.x_c, v.y_c) - p_.torsion_damping_r * v.u_r * v.u_r -
                        p_.torsion_damping_c * v.u_c * v.u_c - p_.torsion_damping_s * v.w_s * v.w_s;
    const auto mesh = [&](const MeshLaw& law, const auto& at, double half_gap, double damping, std::size_t i) {
      const double k = scales_.stiffness(law.stiffness(i, s));
      const double k_rate = omega * scales_.stiffness(law.stiffness_slope(i, s));
      const double e_rate = omega * law.error(i, s, 1) / model::length_scale_m;
      const double delta = at.delta[i];
      const double closed = delta > half_gap ? delta - half_gap : delta < -half_gap ? delta + half_gap : 0.0;
      w.moving_mesh += 0.5 * k_rate * closed * closed - k * closed * e_rate;
      w.mesh_damping -= damping * at.rate[i] * (at.rate[i] + e_rate);
    };
    for (std::size_t i = 0; i < planets; ++i) {
      mesh(sp_, g.sun_planet, p_.sun_planet.half_gap, p_.sun_planet.damping, i);
      mesh(rp_, g.ring_planet, p_.ring_planet.half_gap, p_.ring_planet.damping, i);
      w.support_damping -= p_.bearing_damping_p[i] * square(g.d_rate.carrier_x[i], g.d_rate.carrier_y[i]);
      const auto& sun = p_.sun_planet;
      const auto& ring = p_.ring_planet;
      w.friction += g.sun_planet.friction[i] * (-(v.x_s - v.x_p[i]) * sun.cosine[i] + (v.y_s - v.y_p[i]) * sun.sine[i]);
      w.friction += g.sun_planet.moment_driving[i] * v.w_s + g.sun_planet.moment_driven[i] * v.w_p[i];
      w.friction +=
          g.ring_planet.friction[i] * (-(v.x_p[i] - v.x_r) * ring.cosine[i] - (v.y_p[i] - v.y_r) * ring.sine[i]);
      w.friction += -g.ring_planet.moment_driving[i] * v.w_p[i] + g.ring_planet.moment_driven[i] * v.u_r;
    }
    const double per_phase = 1.0 / omega;
    w.torques *= per_phase;
    w.moving_mesh *= per_phase;
    w.mesh_damping *= per_phase;
    w.support_damping *= per_phase;
    w.friction *= per_phase;
    return w;
  }

 private:
  model::Scales scales_;
  model::Parameters<double, planets> p_;
  MeshLaw sp_, rp_;
};

struct Balance {
  double error;  ///< relative to the work that went in and out
  bool loss;     ///< of contact, on the way
  Ledger::Power work;
};

Balance balance(const gear::Stage& stage, const model::ModelOptions& options, int periods) {
  const model::DynamicModel m =
      make_dynamic_model(stage, model::scales_of(stage), omega, options, model::CoordinateChoice::full);
  const Ledger ledger(stage, options);
  constexpr std::size_t works = 6;
  VectorField field;
  field.dimension = m.dimension + works;
  field.period = 2.0 * std::numbers::pi;
  field.breakpoints = m.breakpoints;
  field.right_hand_side = [&](std::size_t segment, double s, const double* y, double* d) {
    m.right_hand_side(segment, s, y, d);
    const Ledger::Power w = ledger.power(segment, s, y);
    double* out = d + m.dimension;
    out[0] = w.torques;
    out[1] = w.moving_mesh;
    out[2] = w.mesh_damping;
    out[3] = w.support_damping;
    out[4] = w.friction;
    out[5] = std::abs(w.torques) + std::abs(w.moving_mesh) + std::abs(w.mesh_damping) + std::abs(w.friction);
  };
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> disturbance(-0.3, 0.3);
  std::vector<double> y = m.default_start;
  for (double& x : y) x += disturbance(random);
  const double before = ledger.energy(0.0, y.data());
  y.resize(field.dimension, 0.0);
  const auto flow = make_arkode_flow(field, problems::tight());
  Balance r{0.0, false, {}};
  double from = 0.0;
  for (const double to : problems::phases(periods, 8)) {
    EXPECT_TRUE(flow->evolve(y, from, to).reached());
    model::MeshDeflections d;
    m.deflections(to, y.data(), d);
    for (const double x : d.sun_planet) r.loss = r.loss || x < m.sun_planet_half_gap;
    const double* w = y.data() + m.dimension;
    const double gain = ledger.energy(to, y.data()) - before;
    r.error = std::max(r.error, std::abs(gain - (w[0] + w[1] + w[2] + w[3] + w[4])) / std::max(before, w[5]));
    r.work = {w[0], w[1], w[2], w[3], w[4]};
    from = to;
  }
  return r;
}

// Integrator tolerance 1e-13 a step, over some thousand steps and the openings of contacts.
constexpr double energy_tolerance = 1e-8;

TEST(Energy, WhatTheVibrationGainsIsTheWorkDoneOnIt) {
  const gear::Stage nonlinear = problems::r1_nonlinear();
  gear::Stage closed = problems::with_gap(nonlinear, 0.0);
  struct Case {
    const char* name;
    gear::Stage stage;
    model::ModelOptions options;
    bool loss;
  };
  model::ModelOptions with_centrifugal;
  with_centrifugal.centrifugal = model::Centrifugal::included;
  const Case cases[] = {
      {"fixed_ring", nonlinear, {}, true},
      {"as_printed", problems::as_printed(nonlinear), {}, true},
      {"star", problems::star(nonlinear), {}, true},
      {"fixed_sun", problems::fixed_sun(problems::with_unlike_planets(nonlinear)), {}, true},
      {"free", problems::differential(problems::with_unlike_planets(nonlinear)), {}, true},
      {"fixed_ring closed", closed, {}, false},
      {"literal closed", problems::as_printed(closed), {}, false},
      {"fixed_ring without frame terms", nonlinear, {model::GapDamping::always, model::Gyroscopic::off, 0.0}, true},
      {"fixed_ring unequal angles", problems::with_unequal_angles(nonlinear), {}, true},
      {"fixed_ring with centrifugal force", problems::with_unequal_angles(nonlinear), with_centrifugal, true},
      {"literal with centrifugal force", problems::as_printed(nonlinear), with_centrifugal, true},
  };
  double worst = 0.0;
  for (const Case& c : cases) {
    const Balance b = balance(c.stage, c.options, 4);
    EXPECT_LT(b.error, energy_tolerance) << c.name;
    if (c.loss) {
      EXPECT_TRUE(b.loss) << c.name;
    }
    // Each kind of work takes part, else it is not tested.
    constexpr double felt = 1e5 * energy_tolerance;
    for (const double w : {b.work.torques, b.work.moving_mesh, b.work.friction}) EXPECT_GT(std::abs(w), felt) << c.name;
    EXPECT_LT(b.work.mesh_damping + b.work.support_damping, -felt) << c.name;
    worst = std::max(worst, b.error);
  }
  RecordProperty("worst", std::to_string(worst * 1e12) + "e-12");
}

TEST(Energy, IsKeptWithoutAnythingThatDoesWork) {
  gear::Stage s = problems::with_gap(problems::r1());
  for (gear::Mesh* mesh : {&s.sun_planet_mesh, &s.ring_planet_mesh}) {
    mesh->error_amplitude_um = {0.0};
    mesh->damping_ratio = 0.0;
  }
  for (gear::SupportDamping* d : {&s.sun.damping, &s.ring.damping, &s.carrier.damping, &s.planet.damping})
    *d = {std::nullopt, 0.0};
  s.load = {std::nullopt, 1e-9};
  const Balance b = balance(s, {}, 10);
  EXPECT_LT(b.error, energy_tolerance);
  for (const double w : {b.work.moving_mesh, b.work.mesh_damping, b.work.support_damping, b.work.friction})
    EXPECT_EQ(w, 0.0);
  EXPECT_TRUE(b.loss);
}

}  // namespace
}  // namespace epicyclic::identities_energy_test
