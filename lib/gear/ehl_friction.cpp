#include "gear/ehl_friction.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <string>

#include "core/errors.hpp"
#include "core/fitted_rows.hpp"
#include "gear/kinematics.hpp"

namespace epicyclic::gear {

namespace {

/// The load of a pair along its path, as a share of the load of the mesh.
class LoadShare {
 public:
  explicit LoadShare(const EhlFriction& e) : e_(e) {
    const auto& p = e.share_position;
    for (std::size_t first = 0, k = 1; k < p.size(); ++k) {
      if (k + 1 < p.size() && p[k + 1] != p[k]) continue;
      const std::size_t rows = k + 1 - first;
      smooth_parts_.push_back(
          {first, k, cubics_through(e.share_interpolation, {&p[first], rows}, {&e.share[first], rows})});
      first = ++k;
    }
  }

  /// At a position; `inside` is one on the side that is meant.
  [[nodiscard]] double at(double position, double inside) const {
    if (smooth_parts_.empty()) {
      const double phase = inside - std::floor(inside);
      return 1.0 / std::max(1.0, std::ceil(e_.contact_ratio - phase));
    }
    const auto& p = e_.share_position;
    std::size_t k = 0;
    while (k + 1 < smooth_parts_.size() && inside >= p[smooth_parts_[k + 1].first]) ++k;
    const SmoothPart& part = smooth_parts_[k];
    const auto row = [&](std::size_t i) { return p.begin() + static_cast<std::ptrdiff_t>(i); };
    const auto above = std::upper_bound(row(part.first + 1), row(part.last), position);
    const auto i = static_cast<std::size_t>(above - p.begin()) - 1;
    return epicyclic::at(part.cubics[i - part.first], position - p[i]);
  }

 private:
  struct SmoothPart {
    std::size_t first, last;  ///< rows
    std::vector<CubicCoefficients> cubics;
  };
  const EhlFriction& e_;
  std::vector<SmoothPart> smooth_parts_;
};

/// Positions of rows where the share jumps or its slope changes.
std::vector<double> kinks_of_share(const EhlFriction& e) {
  std::vector<double> kinks;
  if (e.share_interpolation != Interpolation::linear) {
    // Kinks stand twice, besides those where pairs enter and leave, which are breakpoints of the path.
    const auto of_path = [&](double position) {
      constexpr double resolution = 1e-9;
      const auto whole = [](double x) { return std::abs(x - std::round(x)) < resolution; };
      return whole(position) || whole(e.contact_ratio - position);
    };
    for (std::size_t k = 1; k < e.share_position.size(); ++k)
      if (e.share_position[k] == e.share_position[k - 1] && !of_path(e.share_position[k]))
        kinks.push_back(e.share_position[k]);
    return kinks;
  }
  constexpr double rounding = 1e-12;
  const auto& x = e.share_position;
  const auto& y = e.share;
  for (std::size_t k = 1; k + 1 < x.size(); ++k) {
    const double fraction = (x[k] - x[k - 1]) / (x[k + 1] - x[k - 1]);
    if (x[k] == x[k - 1] || x[k] == x[k + 1] || std::abs(y[k - 1] + fraction * (y[k + 1] - y[k - 1]) - y[k]) > rounding)
      kinks.push_back(x[k]);
  }
  return kinks;
}

/// Narrowest interval of the share's rows of unknown origin; infinite without such rows [base pitches].
double narrowest_share_interval(const EhlFriction& e) {
  double narrowest = std::numeric_limits<double>::infinity();
  if (e.share_interpolation == Interpolation::linear || e.share_error) return narrowest;
  for (std::size_t k = 1; k < e.share_position.size(); ++k)
    if (const double width = e.share_position[k] - e.share_position[k - 1]; width > 0.0)
      narrowest = std::min(narrowest, width);
  return narrowest;
}

}  // namespace

double xu_friction_coefficient(const LubricatedContact& c) {
  constexpr double b1 = -8.916465;
  constexpr double b2 = 1.03303;
  constexpr double b3 = 1.036077;
  constexpr double b4 = -0.354068;
  constexpr double b5 = 2.812084;
  constexpr double b6 = -0.100601;
  constexpr double b7 = 0.752755;
  constexpr double b8 = -0.390958;
  constexpr double b9 = 0.620305;
  const double slip = std::abs(c.slide_to_roll);
  if (slip == 0.0 || c.pressure_GPa == 0.0) return 0.0;
  const double viscosity = std::max(c.viscosity_mPas, 1.0);
  const double heat = slip * c.pressure_GPa * std::log10(viscosity);
  const double f = b1 + b4 * heat + b5 * std::exp(-heat) + b9 * std::exp(c.roughness_um);
  return std::exp(f) * std::pow(c.pressure_GPa, b2) * std::pow(slip, b3) * std::pow(c.rolling_m_per_s, b6) *
         std::pow(viscosity, b7) * std::pow(c.radius_m, b8);
}

bool within_xu_range(const LubricatedContact& c) {
  const auto in = [](double x, double low, double high) { return x >= low && x <= high; };
  return in(c.pressure_GPa, 0.5, 2.5) && in(c.rolling_m_per_s, 1.0, 20.0) && in(c.viscosity_mPas, 5.0, 100.0) &&
         in(c.roughness_um, 0.1, 0.8);
}

double hertz_pressure(double load_N_per_mm, double equivalent_modulus_GPa, double radius_mm) {
  const double load_GN_per_m = load_N_per_mm * 1e3 * 1e-9;
  return std::sqrt(load_GN_per_m * equivalent_modulus_GPa / (2.0 * std::numbers::pi * radius_mm * 1e-3));
}

MeshLoad mean_mesh_load(const Stage& stage, double mesh_frequency) {
  const double base_radius_m = *stage.sun.base_radius_mm * 1e-3;
  return {torques(stage, mesh_frequency).sun / (stage.planet_count * base_radius_m),
          mesh_frequency / *stage.sun.teeth * base_radius_m};
}

double static_deflection_um(const Mesh& mesh, const MeshLoad& load) {
  return 1e6 * load.force_N / mesh.stiffness_N_per_m;
}

double mean_planet_load(const Stage& stage, double mesh_frequency) {
  if (stage.is_pair()) return mean_mesh_load(stage, mesh_frequency).force_N;
  const PressureAngles alpha = pressure_angles(stage);
  return mean_mesh_load(stage, mesh_frequency).force_N *
         std::hypot(std::cos(alpha.sun_planet) + std::cos(alpha.ring_planet),
                    std::sin(alpha.sun_planet) - std::sin(alpha.ring_planet));
}

LubricatedContact lubricated_contact(const EhlFriction& e, const LineOfAction& line, const MeshLoad& load,
                                     double position, double share) {
  const double h_1 = e.path_start_mm + line.base_pitch_mm * position;
  const double h_2 = line.arm_2(h_1);
  const double radius_mm = line.internal ? h_1 * h_2 / (h_2 - h_1) : h_1 * h_2 / (h_2 + h_1);
  const double v_1 = load.base_speed_m_per_s * h_1 / line.base_radius_1_mm;
  const double v_2 = load.base_speed_m_per_s * h_2 / line.base_radius_2_mm;
  LubricatedContact c;
  c.rolling_m_per_s = 0.5 * (v_1 + v_2);
  c.slide_to_roll = (v_1 - v_2) / c.rolling_m_per_s;
  c.viscosity_mPas = e.viscosity_mPas;
  c.roughness_um = e.roughness_um;
  c.radius_m = radius_mm * 1e-3;
  c.pressure_GPa = hertz_pressure(share * load.force_N / e.width_mm, e.equivalent_modulus_GPa, radius_mm);
  return c;
}

LubricationRange lubrication_range(const EhlFriction& e, const LineOfAction& line, const MeshLoad& load) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  LubricationRange range{infinite, 0.0, infinite, 0.0, true};
  for (std::size_t k = 0; k < e.share_position.size(); ++k) {
    const LubricatedContact c = lubricated_contact(e, line, load, e.share_position[k], e.share[k]);
    range.least_pressure_GPa = std::min(range.least_pressure_GPa, c.pressure_GPa);
    range.greatest_pressure_GPa = std::max(range.greatest_pressure_GPa, c.pressure_GPa);
    range.least_rolling_m_per_s = std::min(range.least_rolling_m_per_s, c.rolling_m_per_s);
    range.greatest_rolling_m_per_s = std::max(range.greatest_rolling_m_per_s, c.rolling_m_per_s);
    range.within = range.within && within_xu_range(c);
  }
  return range;
}

FrictionTable friction_table(const EhlFriction& e, const LineOfAction& line, const MeshLoad& load,
                             std::span<const IntervalGrid> grids) {
  const PathBreakpoints breakpoints = path_breakpoints(e.contact_ratio, e.path_start_mm, line, kinks_of_share(e));
  if (!grids.empty() && grids.size() != breakpoints.size())
    throw DomainError("a friction table of " + std::to_string(breakpoints.size()) + " smooth parts on grids of " +
                      std::to_string(grids.size()));
  const LoadShare shares(e);
  const double pitch = (line.pitch_arm_mm - e.path_start_mm) / line.base_pitch_mm;
  const auto is_pitch_point = [&](double phase) {
    constexpr double resolution = 1e-9;
    const double position = pitch - phase;
    return std::abs(position - std::round(position)) <= resolution && pitch >= -resolution &&
           pitch <= e.contact_ratio + resolution;
  };
  const double narrowest = narrowest_share_interval(e);
  std::size_t part = 0;
  double greatest = 0.0;
  FrictionTable table = tabulate(breakpoints, [&](double from, double to) {
    const double inside = 0.5 * (from + to);
    // The moments as ratios to the base radii, as large as those of the forces.
    const auto ratios = [&](double fraction) {
      const double phase = fraction == 1.0 ? to : from + (to - from) * fraction;
      std::array<double, 3> row{};
      for (int j = 0; inside + j < e.contact_ratio; ++j) {
        const double position = std::min(phase + j, e.contact_ratio);
        // Between its rows a share that ends at 0 may be below it by their error.
        const double share = std::max(0.0, shares.at(position, inside + j));
        const LubricatedContact contact = lubricated_contact(e, line, load, position, share);
        const double arm = e.path_start_mm + line.base_pitch_mm * position;
        const double mu = xu_friction_coefficient(contact);
        greatest = std::max(greatest, mu);
        const double f = contact.slide_to_roll > 0.0 ? -mu : mu;
        row[0] += share * f;
        row[1] += share * f * arm / line.base_radius_1_mm;
        row[2] += share * f * line.arm_2(arm) / line.base_radius_2_mm;
      }
      return row;
    };
    const SingularEnd singular = is_pitch_point(from) ? SingularEnd::start
                                 : is_pitch_point(to) ? SingularEnd::end
                                                      : SingularEnd::none;
    FittedRows<3> fitted = grids.empty() ? fit_rows<3>(ratios, e.table_tolerance, singular, (to - from) / narrowest)
                                         : rows_on<3>(grids[part], ratios);
    ++part;
    for (auto& row : fitted.rows) {
      row[1] *= line.base_radius_1_mm;
      row[2] *= line.base_radius_2_mm;
    }
    return fitted;
  });
  // L mu grows as L^(1 + b2 / 2) at most.
  constexpr double exponent = 1.6;
  table.error += exponent * greatest * e.share_error.value_or(0.0);
  return table;
}

}  // namespace epicyclic::gear
