// Friction of a mesh with a constant coefficient, from the path of contact to the periodic ratios A(s) and B(s).
//
//   h_1j = h_start + p_b (s / 2 pi + j) ,  pair j in contact while s / 2 pi + j < epsilon                [G-2]
//   external  h_2 = N_1 N_2 - h_1 ,  N_1 N_2 = (r_b1 + r_b2) tan alpha
//   internal  h_2 = N_1 N_2 + h_1 ,  N_1 N_2 = (r_b2 - r_b1) tan alpha                                   [G-3]
//   f_j = -mu sgn(omega_1 h_1j - omega_2 h_2j) ,  omega_1 r_b1 = omega_2 r_b2                            [M-mu]
//   A = sum_j L_j f_j ,  B = sum_j L_j f_j h_j ,  L_j = 1 / (pairs in contact)
//
// Member 1 drives: the sun of the external mesh, the planet of the internal one. Source: Tang et al. 2020, Eqs. (2),
// (3) with the corrections of docs/theory/model.md, section 6; the signs are those of dissipation
// (docs/theory/model.md, section 2), which the paper leaves out. Limits: equal load sharing and a constant mu are
// idealisations; 1 <= epsilon <= 3. Smoothness: A jumps and B jumps where a pair enters (s = 0), leaves
// (s/2pi = epsilon - j) or passes the pitch point; between, A is constant and B linear in s.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "core/fitted_rows.hpp"
#include "gear/stage.hpp"

namespace epicyclic::gear {

/// Line of action of a pair of involute gears; member 1 drives. Lengths in mm.
struct LineOfAction {
  double base_radius_1_mm, base_radius_2_mm;
  double theoretical_length_mm;  ///< N_1 N_2
  double pitch_arm_mm;           ///< h_1 at the pitch point
  double base_pitch_mm;          ///< p_b
  bool internal;

  /// h_2 of the contact at h_1 [mm].
  [[nodiscard]] double arm_2(double arm_1) const {
    return internal ? theoretical_length_mm + arm_1 : theoretical_length_mm - arm_1;
  }
  /// (omega_1 h_1 - omega_2 h_2) / (omega_1 r_b1): the sliding speed over the speed of the base circles [-].
  [[nodiscard]] double sliding(double arm_1) const {
    return arm_1 / base_radius_1_mm - arm_2(arm_1) / base_radius_2_mm;
  }
};

/// @throws DomainError when radii, teeth or centre distance are missing
[[nodiscard]] LineOfAction sun_planet_line(const Stage& stage);
[[nodiscard]] LineOfAction ring_planet_line(const Stage& stage);

/// Phases in [0, 1), rising, where a pair enters, leaves or passes the pitch point or one of the kinks; the first is 0.
using PathBreakpoints = std::vector<double>;
/// @param kinks  positions along the path [base pitches]
[[nodiscard]] PathBreakpoints path_breakpoints(double contact_ratio, double path_start_mm, const LineOfAction& line,
                                               std::span<const double> kinks = {});

/// Both sides of each breakpoint.
///
/// @param rows  FittedRows<3> (double from, double to): force, moment_1 and moment_2 between two breakpoints
template <class F>
[[nodiscard]] FrictionTable tabulate(const PathBreakpoints& breakpoints, F rows) {
  FrictionTable table;
  table.breakpoints = breakpoints;
  table.interpolation = Interpolation::smooth;
  const auto append = [&](double phase, const std::array<double, 3>& r) {
    table.phase.push_back(phase);
    table.force_ratio.push_back(r[0]);
    table.moment_driving_mm.push_back(r[1]);
    table.moment_driven_mm.push_back(r[2]);
  };
  for (std::size_t p = 0; p < breakpoints.size(); ++p) {
    const bool last = p + 1 == breakpoints.size();
    const double from = breakpoints[p];
    const double to = last ? 1.0 : breakpoints[p + 1];
    const FittedRows<3> fitted = rows(from, to);
    const IntervalGrid& grid = fitted.grid;
    for (std::size_t i = 0; i <= grid.count; ++i) {
      const std::size_t k = grid.from_end ? grid.count - i : i;
      if (i < grid.count) {
        append(i == 0 ? from : from + (to - from) * grid.fraction(k), fitted.rows[k]);
      } else if (!last) {
        append(to, fitted.rows[k]);
      } else {
        // The left side of the first breakpoint, phase 0, is the end of the period.
        table.phase.insert(table.phase.begin(), 0.0);
        table.force_ratio.insert(table.force_ratio.begin(), fitted.rows[k][0]);
        table.moment_driving_mm.insert(table.moment_driving_mm.begin(), fitted.rows[k][1]);
        table.moment_driven_mm.insert(table.moment_driven_mm.begin(), fitted.rows[k][2]);
      }
    }
    table.grids.push_back(grid);
    table.error = std::max(table.error, fitted.error);
  }
  return table;
}

/// Friction arm h_1 where contact starts: as given, or so that the path is symmetric about the pitch point [mm].
[[nodiscard]] double path_start_mm(const CoulombFriction& friction, const LineOfAction& line);

/// A(s), B_1(s), B_2(s) on the mesh's own phase, exact: two rows at each jump, straight between.
[[nodiscard]] FrictionTable friction_table(const CoulombFriction& friction, const LineOfAction& line);

}  // namespace epicyclic::gear
