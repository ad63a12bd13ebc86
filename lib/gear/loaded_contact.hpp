// Static contact of the tooth pairs of a mesh whose flanks have relief and crowning: load sharing and transmission
// error under load.
//
//   relief from y_0 to y_1, lengths of roll, C its amount, x = (y - y_0)/(y_1 - y_0) in [0, 1], L = |y_1 - y_0|
//     linear C x ,  parabolic C x^2                                                                    [G-relief]
//     circular x^2 L^2 / (R + sqrt(R^2 - x^2 L^2)) ,  R = (L^2 + C^2)/(2 C)
//   gap of pair j   c_j = relief of both flanks at its contact; beyond the ends of the path of contact, where the tip
//                   of one gear meets the flank of the other one off the line of action, also the separation
//     before the start  s_a = r_b1 (phi + inv alpha_1(R)) - l                                          [G-corner]
//     after the end     s_b = +-[r_b2 (inv alpha_2(R) -+ beta) - h_2] ,  + external
//   crowning of the pair  C_b = C_1 (b/b_1)^2 + C_2 (b/b_2)^2 ,  closure of its thin slices            [G-crown]
//     g(d) = d - C_b/3  (d >= C_b) ,  (2/3) d sqrt(d/C_b)  (0 < d < C_b) ,  0 else
//   load            sum_j k_j g(delta - c_j) = F                                                       [G-load]
//   without load    e(phase) = min_j c_j ,   model  k(phase) = F/(delta - e)                           [G-secant]
//
// R is the distance of the tip from the axis of the other gear, phi and beta its angles there from the tangent points
// N_1 and N_2, in the direction of rotation. Separations are displacements along the line of action, to first order in
// their ratio to the radii. Beyond the path k_j is that of its end. Source: derived here from the involutes; the law
// of the load is that of Tavakoli and Houser, J. Mech. Trans. Autom. Des. 108 (1986) 86, with the pair stiffness
// [G-pairk]; slices without coupling are those of ISO 6336-1, annex on K_H beta.
//
// The model has the linear force k(phase) (delta - e(phase)): it is exact without load and at the force F, at each
// phase. Limits: at other loads it is the chord of the curve of the force; pairs do not enter earlier under more load.
// The contact ratio is at most 3. The friction of pairs beyond the path is left out. Smoothness: delta, e and k are
// continuous, with kinks where a pair touches or leaves, at the starts of reliefs and the ends of the path, and
// analytic between; with crowning as x^1.5 beside the phase where a pair touches.
#pragma once

#include <array>
#include <vector>

#include "gear/mesh_stiffness.hpp"

namespace epicyclic::gear {

/// Load of one pair of teeth.
struct PairLoad {
  double position;  ///< base pitches from the start of contact [-]
  double force_N;
};

class LoadedContact {
 public:
  /// @param mesh    compliance and path of contact
  /// @param first   flanks of the driving gear; without reliefs and crowning they are those of involutes
  /// @param second  of the driven gear
  /// @param force_N  of the mesh, > 0, that stiffness() and load_share() are for
  /// @throws DomainError if a relief starts outside its flank
  LoadedContact(const MeshedPair& mesh, const GearData& first, const GearData& second, double force_N);

  [[nodiscard]] double force_N() const { return force_N_; }
  /// Does the order of an interpolation fall beside the phases where pairs touch?
  [[nodiscard]] bool is_crowned() const { return crowning_um_ > 0.0; }

  /// c_j at a position [base pitches], without crowning [um]; infinite where the flank has no involute.
  [[nodiscard]] double gap_um(double position) const;
  /// k_j [N/m].
  [[nodiscard]] double pair_stiffness(double position) const;

  /// e without load at a phase [um].
  [[nodiscard]] double no_load_error_um(double phase) const;
  /// delta under a force [um].
  [[nodiscard]] double transmission_error_um(double phase, double force_N) const;
  /// The pairs that bear.
  [[nodiscard]] std::vector<PairLoad> pair_loads(double phase, double force_N) const;
  /// Phases in [0, 1), rising, of the kinks of e and, under a force, of delta and the loads; the first is 0.
  [[nodiscard]] std::vector<double> breakpoints(double force_N) const;

  /// F/(delta - e) [N/m].
  [[nodiscard]] double stiffness(double phase) const;
  /// Share of the pair at a position in the force [-].
  [[nodiscard]] double load_share(double position) const;
  [[nodiscard]] const std::vector<double>& breakpoints() const { return breakpoints_; }

 private:
  /// A relief over the arm of its member [mm].
  struct Profile {
    double from, to, amount_um;
    ReliefShape shape;
    [[nodiscard]] double at(double arm_mm) const;
  };
  using Flank = std::vector<Profile>;

  struct State {
    double position, gap_um, stiffness_N_per_um;
  };

  [[nodiscard]] static Flank flank(const GearData& data, const Tooth& tooth, double tip_arm_mm, double lowest_arm_mm);
  [[nodiscard]] static double relief_um(const Flank& flank, double arm_mm);
  [[nodiscard]] double gap_before_um(double arm_mm) const;
  [[nodiscard]] double gap_behind_um(double arm_mm) const;
  [[nodiscard]] double closure_um(double d_um) const;
  [[nodiscard]] double contact_width_ratio(double d_um) const;
  [[nodiscard]] std::vector<State> pairs(double phase) const;
  [[nodiscard]] double deflection_um(const std::vector<State>& pairs, double force_N) const;

  Pair pair_;
  double crowning_um_ = 0;
  Flank first_, second_;
  std::vector<double> nodes_, values_;  ///< of k_j over the path, at Chebyshev's points
  double force_N_ = 0;
  std::vector<double> breakpoints_;
};

/// The transmission error over a mesh period under a force.
struct TransmissionError {
  double mean_um = 0, peak_to_peak_um = 0;
  std::array<double, 3> harmonic_um{};  ///< amplitudes of the harmonics 1, 2, 3 of the mesh frequency
  double contact_ratio = 0;             ///< mean number of pairs that bear
};

/// @param force_N  0: without load
[[nodiscard]] TransmissionError transmission_error(const LoadedContact& contact, double force_N);

/// The same of the linear force of the model, e + F/k. The contact ratio is that of the path.
/// @param mesh  with the contact of its modified flanks, whose own force e and k are for; else e = 0
[[nodiscard]] TransmissionError linear_transmission_error(const MeshedPair& mesh, double force_N);

}  // namespace epicyclic::gear
