// Friction of a mesh with a constant coefficient, from the path of contact to the periodic ratios A(s) and B(s).
//
//   h_1j = h_start + p_b (s / 2 pi + j) ,  pair j in contact while s / 2 pi + j < epsilon                [G-2]
//   external  h_2 = N_1 N_2 - h_1 ,  N_1 N_2 = (r_b1 + r_b2) tan alpha
//   internal  h_2 = N_1 N_2 + h_1 ,  N_1 N_2 = (r_b2 - r_b1) tan alpha                                   [G-3]
//   f_j = -mu sgn(omega_1 h_1j - omega_2 h_2j) ,  omega_1 r_b1 = omega_2 r_b2                            [M-mu]
//   A = sum_j L_j f_j ,  B = sum_j L_j f_j h_j ,  L_j = 1 / (pairs in contact)
//
// Member 1 drives: the sun of the external mesh, the planet of the internal one. Source: Tang et al. 2020, Eqs. (2),
// (3) with the corrections of model.md section 6; the signs are those of dissipation (model.md section 2), which the
// paper leaves out. Limits: equal load sharing and a constant mu are idealisations; 1 <= epsilon <= 3. Smoothness: A
// jumps and B jumps where a pair enters (s = 0), leaves (s/2pi = epsilon - j) or passes the pitch point; between, A is
// constant and B linear in s.
#pragma once

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

/// Phases in [0, 1), rising, where a pair enters, leaves or passes the pitch point; the first is 0.
using PathPieces = std::vector<double>;
[[nodiscard]] PathPieces path_pieces(double contact_ratio, double path_start_mm, const LineOfAction& line);

/// One row of a friction table.
struct FrictionRow {
  double force = 0, moment_1 = 0, moment_2 = 0;
};

/// Table with `intervals` equal intervals on each piece, both sides of each breakpoint.
///
/// @param row  FrictionRow (double phase, double inside): the row at a phase as the piece that holds `inside` has it
template <class F>
[[nodiscard]] Friction::Table tabulate(const PathPieces& pieces, int intervals, F row) {
  Friction::Table table;
  table.breakpoints = pieces;
  const auto append = [&](double phase, const FrictionRow& r) {
    table.phase.push_back(phase);
    table.force_ratio.push_back(r.force);
    table.moment_driving_mm.push_back(r.moment_1);
    table.moment_driven_mm.push_back(r.moment_2);
  };
  // The left side of the first breakpoint, phase 0, is the end of the period.
  append(0.0, row(1.0, 0.5 * (pieces.back() + 1.0)));
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    const bool last = k + 1 == pieces.size();
    const double from = pieces[k];
    const double to = last ? 1.0 : pieces[k + 1];
    for (int i = 0; i <= intervals - (last ? 1 : 0); ++i) {
      const double phase = i == intervals ? to : from + (to - from) * i / intervals;
      append(phase, row(phase, 0.5 * (from + to)));
    }
  }
  return table;
}

/// Friction arm h_1 where contact starts: as given, or so that the path is symmetric about the pitch point [mm].
[[nodiscard]] double path_start_mm(const Friction::Coefficient& friction, const LineOfAction& line);

/// A(s), B_1(s), B_2(s) on the mesh's own phase, exact: two rows at each jump, straight between.
[[nodiscard]] Friction::Table friction_table(const Friction::Coefficient& friction, const LineOfAction& line);

}  // namespace epicyclic::gear
