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
  if (!s.sun.base_radius_mm || !s.planet.base_radius_mm || !s.ring.base_radius_mm || !s.sun.teeth || !s.planet.teeth)
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

double path_start_mm(const Friction::Coefficient& friction, const LineOfAction& line) {
  return friction.path_start_mm.value_or(line.pitch_arm_mm - 0.5 * friction.contact_ratio * line.base_pitch_mm);
}

Friction::Table friction_table(const Friction::Coefficient& friction, const LineOfAction& line) {
  const double start = path_start_mm(friction, line);
  const int pairs_most = static_cast<int>(std::ceil(friction.contact_ratio));

  // Phases where a pair enters, leaves or passes the pitch point.
  std::vector<double> jumps = {0.0};
  for (int j = 0; j < pairs_most; ++j) {
    jumps.push_back(friction.contact_ratio - j);
    jumps.push_back((line.pitch_arm_mm - start) / line.base_pitch_mm - j);
  }
  // A piece shorter than this cannot be told from rounding of the input.
  constexpr double phase_resolution = 1e-9;
  std::erase_if(jumps, [](double p) { return p < 0.0 || p > 1.0 - phase_resolution; });
  std::sort(jumps.begin(), jumps.end());
  jumps.erase(std::unique(jumps.begin(), jumps.end(), [](double a, double b) { return b - a < phase_resolution; }),
              jumps.end());

  Friction::Table table;
  table.breakpoints = jumps;
  const auto row = [&](double phase, double inside) {
    // `inside` is a phase within the piece: it decides which pairs are in contact and on which side of the pitch point.
    double force = 0.0;
    double moment_1 = 0.0;
    double moment_2 = 0.0;
    int pairs = 0;
    for (int j = 0; j < pairs_most; ++j) {
      if (inside + j >= friction.contact_ratio) continue;
      const double arm = start + line.base_pitch_mm * (phase + j);
      const double sliding = line.sliding(start + line.base_pitch_mm * (inside + j));
      const double f = sliding > 0.0 ? -friction.coefficient : friction.coefficient;
      force += f;
      moment_1 += f * arm;
      moment_2 += f * line.arm_2(arm);
      ++pairs;
    }
    const double share = 1.0 / std::max(pairs, 1);
    table.phase.push_back(phase);
    table.force_ratio.push_back(share * force);
    table.moment_driving_mm.push_back(share * moment_1);
    table.moment_driven_mm.push_back(share * moment_2);
  };
  // The left side of the first jump, phase 0, is the end of the period.
  for (std::size_t k = 0; k < jumps.size(); ++k) {
    const double next = k + 1 < jumps.size() ? jumps[k + 1] : 1.0;
    const double middle = 0.5 * (jumps[k] + next);
    if (k == 0) {
      const double last_middle = 0.5 * (jumps.back() + 1.0);
      row(1.0, last_middle);
      table.phase.back() = 0.0;
    }
    row(jumps[k], middle);
    if (k + 1 < jumps.size()) row(next, middle);
  }
  return table;
}

}  // namespace epicyclic::gear
