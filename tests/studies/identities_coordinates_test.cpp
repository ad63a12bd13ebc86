// The same motion in the coordinates of the program, in all 3N + 9, and in the paper's own variables (22).

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "gear/kinematics.hpp"
#include "problems/gear_flow.hpp"
#include "problems/mesh_laws.hpp"
#include "problems/r1.hpp"

namespace epicyclic::identities_coordinates_test {
namespace {

using model::CoordinateChoice;
using model::DynamicModel;
using model::Layout;
using model::Slots;
using problems::MeshLaw;
using problems::Which;

constexpr double omega = 0.9;
constexpr int periods = 5;
constexpr int per_period = 16;
// Integrator tolerance times condition: two systems that differ by one step's tolerance in each component at the start
// are as far apart, after contacts that opened and closed, as the stretching of the motion makes them. Errors of the
// many steps add up to some tens of the one at the start. The differences fall with the integrator's tolerance.
constexpr double integrator_tolerance = 1e-13;
constexpr double errors_of_all_steps = 30.0;
// A comparison that allows for more than this would show nothing [b_c].
constexpr double tolerance_most = 1e-6;
// A ring of 1e13 kg still yields this much.
constexpr double heavy_ring = 1e-8;

double worst_difference(const std::vector<std::vector<double>>& a, const std::vector<std::vector<double>>& b);

/// How far a start that is off by the integrator's tolerance comes to be from the right one, in deflections [b_c].
double stretched_tolerance(const DynamicModel& m, const std::vector<double>& start, const std::vector<double>& at) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> sign(-1.0, 1.0);
  std::vector<double> off = start;
  for (double& x : off) x += std::copysign(integrator_tolerance * (1.0 + std::abs(x)), sign(random));
  const double apart =
      worst_difference(problems::deflections_along(m, start, at), problems::deflections_along(m, off, at));
  return errors_of_all_steps * apart;
}

/// A start in full coordinates, out of rest and out of symmetry, about the closed drive flanks.
std::vector<double> full_start(const DynamicModel& full) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> disturbance(-0.3, 0.3);
  std::vector<double> y = full.default_start;
  for (double& x : y) x += disturbance(random);
  return y;
}

/// [M-rel] of a full state.
std::vector<double> relative(const gear::Stage& s, const DynamicModel& to, const std::vector<double>& full) {
  const auto n = static_cast<std::size_t>(to.planets);
  const std::size_t full_dof = full.size() / 2;
  const std::size_t dof = to.dimension / 2;
  const gear::PressureAngles alpha = gear::pressure_angles(s);
  const std::vector<double> angles = s.planet_angles_deg();
  const bool to_ring = to.layout == Layout::relative_to_ring;
  std::vector<double> y(to.dimension);
  for (std::size_t half = 0; half < 2; ++half) {
    const double* q = full.data() + half * full_dof;
    double* r = y.data() + half * dof;
    const double u_r = q[Slots::u_r(n)];
    const double u_c = q[Slots::u_c(Layout::full, n)];
    std::copy(q, q + Slots::u_r(n), r);
    r[Slots::w_s] += to_ring ? u_r : -u_c * (std::cos(alpha.sun_planet) + std::cos(alpha.ring_planet));
    for (std::size_t i = 0; i < n; ++i) {
      const double phi = angles[i] * std::numbers::pi / 180.0;
      r[Slots::w_p(i)] += to_ring ? -u_r : u_c * std::cos(alpha.ring_planet);
      if (to_ring) continue;
      r[Slots::x_p(i)] += u_c * std::sin(phi);
      r[Slots::y_p(i)] -= u_c * std::cos(phi);
    }
    r[dof - 1] = to_ring ? u_c : u_r;
  }
  return y;
}

double worst_difference(const std::vector<std::vector<double>>& a, const std::vector<std::vector<double>>& b) {
  double worst = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k)
    for (std::size_t j = 0; j < a[k].size(); ++j) worst = std::max(worst, std::abs(a[k][j] - b[k][j]));
  return worst;
}

/// Contacts seen: the comparison must go through loss of contact to mean something.
void expect_loss_and_drive(const std::vector<std::vector<double>>& deflections, double half_gap) {
  bool loss = false;
  bool drive = false;
  for (const auto& row : deflections)
    for (const double d : row) {
      loss = loss || DynamicModel::contact(d, half_gap) == model::Contact::loss;
      drive = drive || DynamicModel::contact(d, half_gap) == model::Contact::drive;
    }
  EXPECT_TRUE(loss);
  EXPECT_TRUE(drive);
}

TEST(Coordinates, RelativeOnesGiveTheDeflectionsOfAll3NPlus9) {
  const gear::Stage base = problems::r1_nonlinear();
  struct Case {
    const char* name;
    gear::Stage stage;
    model::ModelOptions options;
  };
  const Case cases[] = {
      {"as_printed", problems::as_printed(base), {}},
      {"star", problems::star(base), {}},
      {"fixed_ring", base, {}},
      {"fixed_ring, unequal angles", problems::with_unequal_angles(base), {}},
      {"literal, unequal angles", problems::as_printed(problems::with_unequal_angles(base)), {}},
      {"fixed_ring, smooth", base, {model::GapDamping::contact_slope, model::Gyroscopic::automatic, 0.05}},
      {"fixed_ring, no frame terms", base, {model::GapDamping::always, model::Gyroscopic::off, 0.0}},
  };
  double all = 0.0;
  for (const Case& c : cases) {
    const model::Scales scales = model::scales_of(c.stage);
    const DynamicModel full = make_dynamic_model(c.stage, scales, omega, c.options, CoordinateChoice::full);
    const DynamicModel reduced = make_dynamic_model(c.stage, scales, omega, c.options, CoordinateChoice::relative);
    const std::vector<double> start = full_start(full);
    const std::vector<double> at = problems::phases(periods, per_period);
    const auto a = problems::deflections_along(full, start, at);
    const auto b = problems::deflections_along(reduced, relative(c.stage, reduced, start), at);
    expect_loss_and_drive(a, 4.0);
    const double worst = worst_difference(a, b);
    const double tolerance = stretched_tolerance(reduced, relative(c.stage, reduced, start), at);
    EXPECT_LT(worst, tolerance) << c.name;
    EXPECT_LT(tolerance, tolerance_most) << c.name;
    all = std::max(all, worst);
  }
  RecordProperty("worst", std::to_string(all * 1e12) + "e-12");
}

TEST(Coordinates, ARigidRingIsTheLimitOfAHeavyOne) {
  gear::Stage s = problems::r1_nonlinear();
  s.ring.inertia_over_r2_kg = 1e13;
  s.ring.damping = {std::nullopt, 0.0};
  const gear::Stage rigid = problems::rigid_ring(s);
  const model::Scales scales = model::scales_of(s);
  const DynamicModel a = make_dynamic_model(s, scales, omega, {});
  const DynamicModel b = make_dynamic_model(rigid, scales, omega, {});
  ASSERT_EQ(a.dimension, b.dimension + 2);
  std::vector<double> start_b = b.default_start;
  std::vector<double> start_a(a.dimension, 0.0);
  const std::size_t dof = b.dimension / 2;
  std::copy_n(start_b.begin(), dof, start_a.begin());
  const std::vector<double> at = problems::phases(periods, per_period);
  EXPECT_LT(worst_difference(problems::deflections_along(a, start_a, at), problems::deflections_along(b, start_b, at)),
            std::max(stretched_tolerance(b, start_b, at), heavy_ring));
}

// ---- the paper's own variables ----------------------------------------------------------------------------------

/// System (26) in its consistent form, in SI from Eqs. (13)-(20), (21), (27); written apart from lib/model.
///
/// z = { x_s, y_s, x_pi, y_pi, x_r, y_r, x_c, y_c, delta_spi, delta_prN, u_c } [1e-5 m] and dz/ds.
class PaperSystem {
 public:
  PaperSystem(const gear::Stage& stage, double mesh_frequency, std::vector<double> breakpoints)
      : s_(stage),
        w_m_(mesh_frequency),
        n_(static_cast<std::size_t>(stage.planet_count)),
        sp_(stage, Which::sun_planet),
        rp_(stage, Which::ring_planet),
        breakpoints_(std::move(breakpoints)) {
    const gear::PressureAngles alpha = gear::pressure_angles(stage);
    for (const double angle : stage.planet_angles_deg()) {
      const double phi = angle * std::numbers::pi / 180.0;
      phi_.push_back(phi);
      phi_sp_.push_back(alpha.sun_planet - phi);
      phi_rp_.push_back(alpha.ring_planet + phi);
    }
  }

  [[nodiscard]] std::size_t dof() const { return 3 * n_ + 8; }
  [[nodiscard]] std::size_t x_p(std::size_t i) const { return 2 + 2 * i; }
  [[nodiscard]] std::size_t x_r() const { return 2 + 2 * n_; }
  [[nodiscard]] std::size_t x_c() const { return 4 + 2 * n_; }
  [[nodiscard]] std::size_t delta_sp(std::size_t i) const { return 6 + 2 * n_ + i; }
  [[nodiscard]] std::size_t delta_rn() const { return 6 + 3 * n_; }
  [[nodiscard]] std::size_t u_c() const { return 7 + 3 * n_; }

  [[nodiscard]] double sun_part(std::size_t i, const double* z) const {
    return (z[0] - z[x_p(i)]) * std::sin(phi_sp_[i]) + (z[1] - z[x_p(i) + 1]) * std::cos(phi_sp_[i]);
  }
  [[nodiscard]] double ring_part(std::size_t i, const double* z) const {
    return (z[x_p(i)] - z[x_r()]) * std::sin(phi_rp_[i]) - (z[x_p(i) + 1] - z[x_r() + 1]) * std::cos(phi_rp_[i]);
  }
  /// n-th derivative by s of the errors [1e-5 m].
  [[nodiscard]] double e_sp(std::size_t i, double s, int n = 0) const { return sp_.error(i, s, n) / unit; }
  [[nodiscard]] double e_rp(std::size_t i, double s, int n = 0) const { return rp_.error(i, s, n) / unit; }

  /// Eq. (21), or its derivative by s (n = 1).
  [[nodiscard]] double delta_rp(std::size_t i, double s, const double* z, int n) const {
    const std::size_t last = n_ - 1;
    return ring_part(i, z) + z[delta_rn()] - ring_part(last, z) + e_rp(last, s, n) + z[delta_sp(last)] -
           sun_part(last, z) + e_sp(last, s, n) - (z[delta_sp(i)] - sun_part(i, z) + e_sp(i, s, n)) - e_rp(i, s, n);
  }

  void operator()(std::size_t segment, double s, const double* z, double* out) const {
    const double* v = z + dof();
    double* a = out + dof();
    std::copy(v, v + dof(), out);
    const bool wraps = segment + 1 == breakpoints_.size();
    const double next = wraps ? breakpoints_[0] + 2.0 * std::numbers::pi : breakpoints_[segment + 1];
    const double middle = 0.5 * (breakpoints_[segment] + next);

    const auto reduced = [](double m_1, double m_2) { return m_1 * m_2 / (m_1 + m_2); };
    const double m_es = s_.sun.inertia_over_r2_kg;
    const double m_ep = s_.planet.inertia_over_r2_kg;
    const double m_er = s_.ring.inertia_over_r2_kg;
    const double m_ec = s_.carrier.inertia_over_r2_kg;
    const double c_sp =
        2.0 * *s_.sun_planet_mesh.damping_ratio * std::sqrt(s_.sun_planet_mesh.stiffness_N_per_m * reduced(m_es, m_ep));
    const double c_rp = 2.0 * *s_.ring_planet_mesh.damping_ratio *
                        std::sqrt(s_.ring_planet_mesh.stiffness_N_per_m * reduced(m_ep, m_er));
    const double w_c = gear::speeds(s_, w_m_).carrier;
    const gear::Torques torque = gear::torques(s_, w_m_);
    const double r_bs = *s_.sun.base_radius_mm * 1e-3;
    const double r_bp = *s_.planet.base_radius_mm * 1e-3;
    const double r_br = *s_.ring.base_radius_mm * 1e-3;
    const double r_c = *s_.centre_distance_mm * 1e-3;
    const auto clearance = [](double d, double b) { return d > b ? d - b : d < -b ? d + b : 0.0; };

    // Forces [N]
    const double speed = unit * w_m_;
    std::vector<double> f_sp(n_), f_rp(n_);
    std::vector<MeshLaw::Friction> mu_sp(n_), mu_rp(n_);
    for (std::size_t i = 0; i < n_; ++i) {
      f_sp[i] = sp_.stiffness(i, s) * clearance(unit * z[delta_sp(i)], s_.sun_planet_mesh.backlash_half_um * 1e-6) +
                c_sp * speed * v[delta_sp(i)];
      f_rp[i] =
          rp_.stiffness(i, s) * clearance(unit * delta_rp(i, s, z, 0), s_.ring_planet_mesh.backlash_half_um * 1e-6) +
          c_rp * speed * delta_rp(i, s, v, 1);
      mu_sp[i] = sp_.friction(i, s, middle);
      mu_rp[i] = rp_.friction(i, s, middle);
    }

    // Accelerations d^2/dt^2 [m/s^2]; supports act on displacements unit z and velocities speed v
    const auto support = [&](const gear::CentralMember& m, std::size_t k) {
      const double c = 2.0 * *m.damping.ratio * std::sqrt(m.support_N_per_m * m.mass_kg);
      return m.support_N_per_m * unit * z[k] + c * speed * v[k];
    };
    const auto frame_x = [&](std::size_t k) { return 2.0 * w_c * speed * v[k + 1] + w_c * w_c * unit * z[k]; };
    const auto frame_y = [&](std::size_t k) { return -2.0 * w_c * speed * v[k] + w_c * w_c * unit * z[k + 1]; };
    double sun_x = -support(s_.sun, 0);
    double sun_y = -support(s_.sun, 1);
    double sun_u = torque.sun / r_bs;
    double ring_x = -support(s_.ring, x_r());
    double ring_y = -support(s_.ring, x_r() + 1);
    double ring_u = torque.ring / r_br;
    double carrier_x = -support(s_.carrier, x_c());
    double carrier_y = -support(s_.carrier, x_c() + 1);
    const double k_cu = s_.carrier.torsional_support_N_per_m;
    const double c_cu = 2.0 * *s_.carrier.damping.ratio * std::sqrt(k_cu * m_ec);
    double carrier_u = -k_cu * unit * z[u_c()] - c_cu * speed * v[u_c()] - torque.carrier / r_c;
    const double k_p = s_.planet.bearing_N_per_m;
    const double c_p = 2.0 * *s_.planet.damping.ratio * std::sqrt(k_p * s_.planet.mass_kg);
    std::vector<double> a_xp(n_), a_yp(n_), a_up(n_);
    for (std::size_t i = 0; i < n_; ++i) {
      const double sin_sp = std::sin(phi_sp_[i]);
      const double cos_sp = std::cos(phi_sp_[i]);
      const double sin_rp = std::sin(phi_rp_[i]);
      const double cos_rp = std::cos(phi_rp_[i]);
      const double ff_sp = mu_sp[i].force * f_sp[i];
      const double ff_rp = mu_rp[i].force * f_rp[i];
      const auto bearing = [&](auto deflection) { return k_p * unit * deflection(z) + c_p * speed * deflection(v); };
      const double b_x = bearing([&](const double* q) { return q[x_p(i)] - q[x_c()] + q[u_c()] * std::sin(phi_[i]); });
      const double b_y =
          bearing([&](const double* q) { return q[x_p(i) + 1] - q[x_c() + 1] - q[u_c()] * std::cos(phi_[i]); });
      const double b_u = bearing([&](const double* q) {
        return -(q[x_p(i)] - q[x_c()]) * std::sin(phi_[i]) + (q[x_p(i) + 1] - q[x_c() + 1]) * std::cos(phi_[i]) -
               q[u_c()];
      });
      sun_x += -f_sp[i] * sin_sp - ff_sp * cos_sp;
      sun_y += -f_sp[i] * cos_sp + ff_sp * sin_sp;
      sun_u += -f_sp[i] + mu_sp[i].driving_m * f_sp[i] / r_bs;
      ring_x += f_rp[i] * sin_rp + ff_rp * cos_rp;
      ring_y += -f_rp[i] * cos_rp + ff_rp * sin_rp;
      ring_u += -f_rp[i] + mu_rp[i].driven_m * f_rp[i] / r_br;
      carrier_x += b_x;
      carrier_y += b_y;
      carrier_u += b_u;
      const double m_p = s_.planet.mass_kg;
      a_xp[i] = (-b_x + f_sp[i] * sin_sp + ff_sp * cos_sp - f_rp[i] * sin_rp - ff_rp * cos_rp) / m_p + frame_x(x_p(i));
      a_yp[i] = (-b_y + f_sp[i] * cos_sp - ff_sp * sin_sp + f_rp[i] * cos_rp - ff_rp * sin_rp) / m_p + frame_y(x_p(i));
      a_up[i] = (-f_sp[i] + mu_sp[i].driven_m * f_sp[i] / r_bp + f_rp[i] - mu_rp[i].driving_m * f_rp[i] / r_bp) / m_ep;
    }

    // Rows of (26), in 1e-5 m per s^2
    const double scale = 1.0 / (unit * w_m_ * w_m_);
    a[0] = scale * (sun_x / s_.sun.mass_kg + frame_x(0));
    a[1] = scale * (sun_y / s_.sun.mass_kg + frame_y(0));
    a[x_r()] = scale * (ring_x / s_.ring.mass_kg + frame_x(x_r()));
    a[x_r() + 1] = scale * (ring_y / s_.ring.mass_kg + frame_y(x_r()));
    a[x_c()] = scale * (carrier_x / s_.carrier.mass_kg + frame_x(x_c()));
    a[x_c() + 1] = scale * (carrier_y / s_.carrier.mass_kg + frame_y(x_c()));
    a[u_c()] = scale * carrier_u / m_ec;
    for (std::size_t i = 0; i < n_; ++i) {
      a[x_p(i)] = scale * a_xp[i];
      a[x_p(i) + 1] = scale * a_yp[i];
    }
    for (std::size_t i = 0; i < n_; ++i)
      a[delta_sp(i)] = sun_part(i, a) + scale * (sun_u / m_es + a_up[i]) - e_sp(i, s, 2);
    const std::size_t last = n_ - 1;
    a[delta_rn()] = ring_part(last, a) + scale * (ring_u / m_er - a_up[last]) - e_rp(last, s, 2);
  }

  /// The variables (22) of a state of the model, and dz/ds.
  [[nodiscard]] std::vector<double> start(const DynamicModel& m, double ratio, const std::vector<double>& y) const {
    model::MeshDeflections d;
    m.deflections(0.0, y.data(), d);
    const std::size_t m_dof = m.dimension / 2;
    std::vector<double> z(2 * dof());
    for (std::size_t half = 0; half < 2; ++half) {
      const double factor = half == 0 ? 1.0 : 1.0 / ratio;  // d/d tau = Omega d/ds
      const double* q = y.data() + half * m_dof;
      double* r = z.data() + half * dof();
      r[0] = factor * q[Slots::x_s];
      r[1] = factor * q[Slots::y_s];
      for (std::size_t i = 0; i < n_; ++i) {
        r[x_p(i)] = factor * q[Slots::x_p(i)];
        r[x_p(i) + 1] = factor * q[Slots::y_p(i)];
        r[delta_sp(i)] = factor * (half == 0 ? d.sun_planet[i] : d.sun_planet_rate[i]);
      }
      r[x_r()] = factor * q[Slots::x_r(n_)];
      r[x_r() + 1] = factor * q[Slots::y_r(n_)];
      r[x_c()] = factor * q[Slots::x_c(n_)];
      r[x_c() + 1] = factor * q[Slots::y_c(n_)];
      r[delta_rn()] = factor * (half == 0 ? d.ring_planet[n_ - 1] : d.ring_planet_rate[n_ - 1]);
      r[u_c()] = factor * q[Slots::u_c(m.layout, n_)];
    }
    return z;
  }

 private:
  static constexpr double unit = 1e-5;
  gear::Stage s_;
  double w_m_;
  std::size_t n_;
  MeshLaw sp_, rp_;
  std::vector<double> breakpoints_;
  std::vector<double> phi_, phi_sp_, phi_rp_;
};

TEST(Coordinates, ThePapersOwnVariablesGiveTheSameDeflections) {
  const gear::Stage base = problems::r1_nonlinear();
  double all = 0.0;
  for (const gear::Stage& stage :
       {problems::as_printed(base), problems::star(base), problems::as_printed(problems::with_unequal_angles(base))}) {
    const model::Scales scales = model::scales_of(stage);
    const DynamicModel m = make_dynamic_model(stage, scales, omega, {});
    const DynamicModel full = make_dynamic_model(stage, scales, omega, {}, CoordinateChoice::full);
    const std::vector<double> start = relative(stage, m, full_start(full));
    const PaperSystem paper(stage, omega * scales.omega_sn, m.breakpoints);

    VectorField field;
    field.dimension = 2 * paper.dof();
    field.period = 2.0 * std::numbers::pi;
    field.breakpoints = m.breakpoints;
    field.right_hand_side = paper;
    const auto flow = make_arkode_flow(field, problems::tight());
    std::vector<double> z = paper.start(m, omega, start);
    std::vector<std::vector<double>> rows;
    const std::vector<double> at = problems::phases(periods, per_period);
    double from = 0.0;
    for (const double to : at) {
      ASSERT_TRUE(flow->evolve(z, from, to).reached());
      std::vector<double> row;
      for (std::size_t i = 0; i < 3; ++i) row.push_back(z[paper.delta_sp(i)]);
      for (std::size_t i = 0; i < 3; ++i) row.push_back(paper.delta_rp(i, to, z.data(), 0));
      rows.push_back(row);
      from = to;
    }
    expect_loss_and_drive(rows, 4.0);
    const double worst = worst_difference(rows, problems::deflections_along(m, start, at));
    const double tolerance = stretched_tolerance(m, start, at);
    EXPECT_LT(worst, tolerance) << static_cast<int>(stage.boundary);
    EXPECT_LT(tolerance, tolerance_most) << static_cast<int>(stage.boundary);
    all = std::max(all, worst);
  }
  RecordProperty("worst", std::to_string(all * 1e12) + "e-12");
}

}  // namespace
}  // namespace epicyclic::identities_coordinates_test
