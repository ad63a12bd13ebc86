#include "gear/mesh_stiffness.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <Eigen/Core>

#include "core/quadrature.hpp"
#include "gear/loaded_contact.hpp"

namespace epicyclic::gear {

namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;
// Contact ratios that differ less from a whole number make no smooth part of their own.
constexpr double phase_resolution = 1e-9;
constexpr int panels = 4;

/// The phase of the same contact in [0, 1).
double in_period(double phase) { return phase - std::floor(phase); }

/// Calls f(from, to, inside) for each smooth part of a period.
template <class F>
void for_smooth_parts(const MeshedPair& mesh, F f) {
  const std::vector<double> breaks = mesh.breakpoints();
  for (std::size_t k = 0; k < breaks.size(); ++k) {
    const double to = k + 1 < breaks.size() ? breaks[k + 1] : 1.0;
    f(breaks[k], to, 0.5 * (breaks[k] + to));
  }
}

}  // namespace

ToothCompliance MeshedPair::compliance(const ToothBody& body, double contact_radius_mm) const {
  ToothBody in_contact = body;
  in_contact.tooth.width_mm = face_width_mm();
  return tooth_compliance(in_contact, contact_radius_mm, options);
}

double MeshedPair::pair_stiffness(double position) const {
  const double l = arm_mm(position);
  double sum = options.hertz ? hertz_compliance(driving.material, face_width_mm()) : 0.0;
  sum += compliance(driving, pair.radius_1_mm(l)).sum();
  sum += compliance(driven, pair.radius_2_mm(l)).sum();
  return factor / sum;
}

int MeshedPair::pairs_in_contact(double phase) const {
  return std::max(0, static_cast<int>(std::ceil(contact_ratio() - in_period(phase))));
}

std::vector<double> MeshedPair::breakpoints() const {
  if (loaded) return loaded->breakpoints();
  const double rest = contact_ratio() - std::floor(contact_ratio());
  if (rest < phase_resolution || rest > 1.0 - phase_resolution) return {0.0};
  return {0.0, rest};
}

double MeshedPair::stiffness(double phase) const {
  const double within = in_period(phase);
  return stiffness(within, within);
}

double MeshedPair::stiffness(double phase, double inside) const {
  if (loaded) return loaded->stiffness(phase);
  double sum = 0.0;
  for (int j = 0; j < pairs_in_contact(inside); ++j) sum += pair_stiffness(std::min(phase + j, contact_ratio()));
  return sum;
}

double MeshedPair::load_share(double position, double inside) const {
  if (loaded) return loaded->load_share(position);
  const double phase_inside = inside - std::floor(inside);
  const double phase = position - std::floor(inside);
  const double own = pair_stiffness(position);
  double sum = 0.0;
  for (int j = 0; j < pairs_in_contact(phase_inside); ++j) {
    const double other = std::min(phase + j, contact_ratio());
    sum += other == position ? own : pair_stiffness(other);
  }
  return own / sum;
}

double FourierSeries::at(double phase) const {
  double k = mean;
  for (std::size_t h = 0; h < cosine.size(); ++h) {
    const double angle = two_pi * static_cast<double>(h + 1) * phase;
    k += cosine[h] * std::cos(angle) + sine[h] * std::sin(angle);
  }
  return k;
}

FourierSeries fourier_series(const MeshedPair& mesh, int harmonics) {
  const Eigen::Index size = 2 * static_cast<Eigen::Index>(harmonics) + 1;
  Eigen::ArrayXd sum = Eigen::ArrayXd::Zero(size);
  for_smooth_parts(mesh, [&](double from, double to, double inside) {
    // A harmonic needs nodes of its own; the stiffness itself is smooth.
    const int subintervals = panels * (1 + harmonics / 8);
    sum += gauss_legendre_16().integrate(
        [&](double phase) -> Eigen::ArrayXd {
          Eigen::ArrayXd f(size);
          const double k = mesh.stiffness(phase, inside);
          f[0] = k;
          for (int h = 1; h <= harmonics; ++h) {
            f[2 * h - 1] = 2.0 * k * std::cos(two_pi * h * phase);
            f[2 * h] = 2.0 * k * std::sin(two_pi * h * phase);
          }
          return f;
        },
        from, to, subintervals);
  });
  FourierSeries series;
  series.mean = sum[0];
  for (int h = 1; h <= harmonics; ++h) {
    series.cosine.push_back(sum[2 * h - 1]);
    series.sine.push_back(sum[2 * h]);
  }
  return series;
}

StiffnessRange stiffness_range(const MeshedPair& mesh) {
  constexpr int samples = 200;
  constexpr double infinite = std::numeric_limits<double>::infinity();
  StiffnessRange range{infinite, -infinite};
  for_smooth_parts(mesh, [&](double from, double to, double inside) {
    for (int k = 0; k <= samples; ++k) {
      const double value = mesh.stiffness(from + (to - from) * k / samples, inside);
      range.least = std::min(range.least, value);
      range.greatest = std::max(range.greatest, value);
    }
  });
  return range;
}

StiffnessRange stiffness_range(const FourierSeries& series) {
  const int samples = 64 * static_cast<int>(series.cosine.size() + 1);
  StiffnessRange range{series.mean, series.mean};
  for (int k = 0; k < samples; ++k) {
    const double value = series.at(static_cast<double>(k) / samples);
    range.least = std::min(range.least, value);
    range.greatest = std::max(range.greatest, value);
  }
  return range;
}

IsoStiffness iso_stiffness(const MeshedPair& mesh) {
  // A rack in place of the internal gear: infinitely many teeth, no shift.
  const auto inverse_teeth = [](const Tooth& t) { return t.internal ? 0.0 : 1.0 / t.teeth; };
  // 1 is the pinion, whichever drives.
  const bool driving_is_pinion = inverse_teeth(mesh.driving.tooth) >= inverse_teeth(mesh.driven.tooth);
  const Tooth& pinion = (driving_is_pinion ? mesh.driving : mesh.driven).tooth;
  const Tooth& wheel = (driving_is_pinion ? mesh.driven : mesh.driving).tooth;
  const auto profile = [](const Tooth& t) {
    const double depth = std::abs(t.rack_depth());
    constexpr double degree = std::numbers::pi / 180.0;
    return (1.0 + 0.5 * (1.2 - depth)) * (1.0 - 0.02 * (20.0 - t.pressure_angle / degree));
  };
  const double n_1 = inverse_teeth(pinion);
  const double n_2 = inverse_teeth(wheel);
  const double x_1 = pinion.profile_shift;
  const double x_2 = wheel.internal ? 0.0 : wheel.profile_shift;
  const double q = 0.04723 + 0.15551 * n_1 + 0.25791 * n_2 - 0.00635 * x_1 - 0.11654 * x_1 * n_1 - 0.00193 * x_2 -
                   0.24188 * x_2 * n_2 + 0.00529 * x_1 * x_1 + 0.00182 * x_2 * x_2;
  constexpr double theory_to_measurement = 0.8;
  constexpr double per_mm_um = 1e6;  // N / (mm um) times mm, in N/m
  constexpr double steel_GPa = 206.0;
  const double e_1 = mesh.driving.material.youngs_modulus_GPa;
  const double e_2 = mesh.driven.material.youngs_modulus_GPa;
  const double single = theory_to_measurement * 0.5 * (profile(pinion) + profile(wheel)) / q * mesh.face_width_mm() *
                        per_mm_um * (2.0 * e_1 * e_2 / (e_1 + e_2) / steel_GPa);
  return {single, single * (0.75 * mesh.contact_ratio() + 0.25)};
}

}  // namespace epicyclic::gear
