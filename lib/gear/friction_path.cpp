#include "gear/friction_path.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/errors.hpp"
#include "gear/kinematics.hpp"

namespace epicyclic::gear {

namespace {

LineOfAction line_of(double r_1, double r_2, int teeth_1, double alpha, bool internal) {
  const double tangent = std::tan(alpha);
  return {
      r_1,     r_2, (internal ? r_2 - r_1 : r_1 + r_2) * tangent, r_1 * tangent, 2.0 * std::numbers::pi * r_1 / teeth_1,
      internal};
}

void require_geometry(const Stage& s) {
  if (!s.sun.base_radius_mm || !s.planet.base_radius_mm || !(s.is_pair() || s.ring.base_radius_mm) || !s.sun.teeth ||
      !s.planet.teeth)
    throw DomainError("a line of action needs base radii and teeth of sun, planet and ring");
}

}  // namespace

LineOfAction sun_planet_line(const Stage& s) {
  require_geometry(s);
  return line_of(*s.sun.base_radius_mm, *s.planet.base_radius_mm, *s.sun.teeth, pressure_angles(s).sun_planet, false);
}

LineOfAction ring_planet_line(const Stage& s) {
  require_geometry(s);
  return line_of(*s.planet.base_radius_mm, *s.ring.base_radius_mm, *s.planet.teeth, pressure_angles(s).ring_planet,
                 true);
}

double path_start_mm(const CoulombFriction& friction, const LineOfAction& line) {
  return friction.path_start_mm.value_or(line.pitch_arm_mm - 0.5 * friction.contact_ratio * line.base_pitch_mm);
}

PathBreakpoints path_breakpoints(double contact_ratio, double path_start_mm, const LineOfAction& line,
                                 std::span<const double> kinks) {
  PathBreakpoints breakpoints = {0.0};
  for (const double position : kinks) breakpoints.push_back(position - std::floor(position));
  for (int j = 0; j < static_cast<int>(std::ceil(contact_ratio)); ++j) {
    breakpoints.push_back(contact_ratio - j);
    breakpoints.push_back((line.pitch_arm_mm - path_start_mm) / line.base_pitch_mm - j);
  }
  // A part shorter than this is within the rounding of the input.
  constexpr double phase_resolution = 1e-9;
  std::erase_if(breakpoints, [](double p) { return p < 0.0 || p > 1.0 - phase_resolution; });
  std::sort(breakpoints.begin(), breakpoints.end());
  breakpoints.erase(
      std::unique(breakpoints.begin(), breakpoints.end(), [](double a, double b) { return b - a < phase_resolution; }),
      breakpoints.end());
  return breakpoints;
}

FrictionTable friction_table(const CoulombFriction& friction, const LineOfAction& line) {
  const double start = path_start_mm(friction, line);
  return tabulate(path_breakpoints(friction.contact_ratio, start, line), [&](double from, double to) {
    const double inside = 0.5 * (from + to);
    // Between breakpoints A is constant and B straight.
    return rows_on<3>(IntervalGrid::even(1), [&](double fraction) {
      const double phase = fraction == 1.0 ? to : from + (to - from) * fraction;
      std::array<double, 3> row{};
      int pairs = 0;
      for (int j = 0; inside + j < friction.contact_ratio; ++j) {
        const double arm = start + line.base_pitch_mm * (phase + j);
        const double sliding = line.sliding(start + line.base_pitch_mm * (inside + j));
        const double f = sliding > 0.0 ? -friction.coefficient : friction.coefficient;
        row[0] += f;
        row[1] += f * arm;
        row[2] += f * line.arm_2(arm);
        ++pairs;
      }
      const double share = 1.0 / std::max(pairs, 1);
      for (double& x : row) x *= share;
      return row;
    });
  });
}

}  // namespace epicyclic::gear
