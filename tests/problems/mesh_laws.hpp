// Mesh stiffness, error and friction as functions of the common mesh phase s, in SI and written apart from lib/model:
// no folding of phases into coefficients, no addition theorem, no tables.
//
//   s_spi = s - z_s (phi_i - phi_1) ,  s_rpi = s + z_r (phi_i - phi_1) + 2 pi lambda_sr
//   k = k_0 + sum A_h cos h s_i + B_h sin h s_i ,  e = E_i sin(s_i + phi_0i)
#pragma once

#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "gear/friction_path.hpp"
#include "gear/kinematics.hpp"
#include "gear/stage.hpp"

namespace epicyclic::problems {

enum class Which { sun_planet, ring_planet };

class MeshLaw {
 public:
  MeshLaw(const gear::Stage& stage, Which which)
      : mesh_(which == Which::sun_planet ? stage.sun_planet_mesh : stage.ring_planet_mesh), which_(which) {
    const std::vector<double> angles = stage.planet_angles_deg();
    for (std::size_t i = 0; i < angles.size(); ++i) {
      const double turn = (angles[i] - angles[0]) / 360.0;
      turns_.push_back(which == Which::sun_planet ? -*stage.sun.teeth * turn
                                                  : *stage.ring.teeth * turn + stage.ring_mesh_lead_1);
    }
    if (mesh_.friction.coefficient)
      line_ = which == Which::sun_planet ? gear::sun_planet_line(stage) : gear::ring_planet_line(stage);
  }

  template <class T>
  [[nodiscard]] T own_phase(std::size_t i, T s) const {
    return s + 2 * std::numbers::pi_v<T> * static_cast<T>(turns_[i]);
  }

  /// k_i [N/m].
  template <class T>
  [[nodiscard]] T stiffness(std::size_t i, T s) const {
    const T own = own_phase(i, s);
    T k = static_cast<T>(mesh_.stiffness_N_per_m);
    for (std::size_t h = 0; h < mesh_.stiffness_cos_N_per_m.size(); ++h)
      k += static_cast<T>(mesh_.stiffness_cos_N_per_m[h]) * std::cos(static_cast<T>(h + 1) * own) +
           static_cast<T>(mesh_.stiffness_sin_N_per_m[h]) * std::sin(static_cast<T>(h + 1) * own);
    return k;
  }

  /// dk_i/ds [N/m].
  [[nodiscard]] double stiffness_slope(std::size_t i, double s) const {
    const double own = own_phase(i, s);
    double slope = 0.0;
    for (std::size_t h = 0; h < mesh_.stiffness_cos_N_per_m.size(); ++h) {
      const double order = static_cast<double>(h + 1);
      slope += order * (mesh_.stiffness_sin_N_per_m[h] * std::cos(order * own) -
                        mesh_.stiffness_cos_N_per_m[h] * std::sin(order * own));
    }
    return slope;
  }

  /// d^n e_i / ds^n [m].
  template <class T>
  [[nodiscard]] T error(std::size_t i, T s, int derivative = 0) const {
    const auto of_planet = [&](const std::vector<double>& v) { return static_cast<T>(v.size() == 1 ? v[0] : v[i]); };
    const T pi = std::numbers::pi_v<T>;
    const T angle = own_phase(i, s) + of_planet(mesh_.error_phase_deg) * pi / 180 + static_cast<T>(derivative) * pi / 2;
    return of_planet(mesh_.error_amplitude_um) * static_cast<T>(1e-6L) * std::sin(angle);
  }

  /// A, and B about the driving and the driven member's axis [m].
  struct Friction {
    double force = 0, driving_m = 0, driven_m = 0;
  };

  /// Friction at s in the segment whose middle is given: it decides which pairs are in contact and how they slide.
  [[nodiscard]] Friction friction(std::size_t i, double s, double middle) const {
    Friction r;
    if (!mesh_.friction.coefficient) return r;
    const auto& f = *mesh_.friction.coefficient;
    const double two_pi = 2.0 * std::numbers::pi;
    const double own_middle = own_phase(i, middle) / two_pi;
    const double t_middle = own_middle - std::floor(own_middle);
    const double t = t_middle + std::remainder(s - middle, two_pi) / two_pi;
    int pairs = 0;
    for (int j = 0; t_middle + j < f.contact_ratio; ++j) ++pairs;
    for (int j = 0; j < pairs; ++j) {
      const double start = gear::path_start_mm(f, line_);
      const auto arm_1 = [&](double x) { return start + line_.base_pitch_mm * (x + j); };
      const auto arm_2 = [&](double x) {
        return which_ == Which::sun_planet ? line_.theoretical_length_mm - arm_1(x)
                                           : line_.theoretical_length_mm + arm_1(x);
      };
      // Speeds relative to the carrier are as the inverse base radii.
      const double sliding = arm_1(t_middle) / line_.base_radius_1_mm - arm_2(t_middle) / line_.base_radius_2_mm;
      const double ratio = (sliding > 0.0 ? -f.coefficient : f.coefficient) / pairs;
      r.force += ratio;
      r.driving_m += ratio * arm_1(t) * 1e-3;
      r.driven_m += ratio * arm_2(t) * 1e-3;
    }
    return r;
  }

 private:
  gear::Mesh mesh_;
  Which which_;
  std::vector<double> turns_;
  gear::LineOfAction line_{};
};

}  // namespace epicyclic::problems
