// Stiffness of a mesh over its period, load sharing among the pairs in contact, and its Fourier series.
//
//   1/k_pair = 1/k_h + sum over both teeth (1/k_b + 1/k_s + 1/k_a + 1/k_f)                              [G-pairk]
//   with L the smaller face width of the two gears, as b of ISO 6336-1: the end of the wider one bears nothing
//   k(phase) = sum over pairs j with phase + j < epsilon of k_pair(phase + j)                           [G-k]
//   L_j = k_pair,j / k : equal total deformation of the pairs in contact                                [G-L]
//   k = k_0 + sum_h [ A_h cos 2 pi h phase + B_h sin 2 pi h phase ]                                     [G-4]
//   ISO 6336-1:2006, 9.3, method B, c'_th from the teeth and shifts:                                     [G-iso]
//   c' = 0.8 c'_th C_B E / E_St ,  c_gamma = c' (0.75 eps + 0.25) ,  E = 2 E_1 E_2 / (E_1 + E_2) ,  E_St = 206 GPa ,
//   C_B = mean of both gears' (1 + 0.5 (1.2 - h_fP/m)) (1 - 0.02 (20 - alpha_0/deg))
//
// phase = s / 2 pi of the mesh's own period, 0 where a pair enters; position = phase + j of a pair in base pitches from
// the start of contact. Source: Tang et al. 2020, section 1.3 and Eq. (4) (with the time shift inside the angle);
// docs/theory/gears.md, section 6. Limits: two pairs in contact are added as if each had a body of its own, which
// over-estimates the stiffness in double contact (Xie et al. 2018). Smoothness: k jumps at phase 0 and at the
// fractional part of epsilon, and is analytic between: every integral here is the sum over the smooth parts.
#pragma once

#include <algorithm>
#include <memory>
#include <vector>

#include "gear/pair.hpp"
#include "gear/tooth_compliance.hpp"

namespace epicyclic::gear {

class LoadedContact;

/// Both teeth of a pair in mesh, and how their compliance is counted.
struct MeshedPair {
  Pair pair;
  ToothBody driving, driven;
  ComplianceOptions options;
  double factor = 1;  ///< on the stiffness [-]
  /// Of modified flanks, at the load of the stage: its stiffness [G-secant] and shares are those of the mesh.
  std::shared_ptr<const LoadedContact> loaded{};

  [[nodiscard]] double contact_ratio() const { return pair.contact_ratio(); }
  /// L of both gears: the smaller face width. The part of a tooth beyond the other one does not count [mm].
  [[nodiscard]] double face_width_mm() const { return std::min(driving.tooth.width_mm, driven.tooth.width_mm); }
  /// Compliance of a tooth of either gear, over the common face width.
  /// @param body  `driving` or `driven`
  /// @throws as tooth_compliance() does
  [[nodiscard]] ToothCompliance compliance(const ToothBody& body, double contact_radius_mm) const;
  /// Distance of the contact from N_1 at a position [base pitches from the start of contact] [mm].
  [[nodiscard]] double arm_mm(double position) const { return pair.start_mm + position * pair.base_pitch_mm; }

  /// k_pair at a position in [0, epsilon] [N/m].
  [[nodiscard]] double pair_stiffness(double position) const;

  /// Pairs in contact at a phase.
  [[nodiscard]] int pairs_in_contact(double phase) const;

  /// Phases in [0, 1) where a pair enters or leaves, or where loaded flanks have kinks, rising; the first is 0.
  [[nodiscard]] std::vector<double> breakpoints() const;

  /// k at a phase [N/m].
  [[nodiscard]] double stiffness(double phase) const;
  /// k at a phase in [0, 1], as it is within the smooth part that holds `inside` in (0, 1) [N/m].
  [[nodiscard]] double stiffness(double phase, double inside) const;

  /// Share of the load on the pair at a position; at a jump, `inside` selects the side [-].
  [[nodiscard]] double load_share(double position, double inside) const;
  [[nodiscard]] double load_share(double position) const { return load_share(position, position); }
};

/// k_0 and the harmonics of a mesh stiffness [N/m].
struct FourierSeries {
  double mean = 0;
  std::vector<double> cosine, sine;  ///< A_h, B_h, h = 1, 2, ...

  /// @param phase  in periods
  [[nodiscard]] double at(double phase) const;
};

/// By quadrature over each smooth part.
[[nodiscard]] FourierSeries fourier_series(const MeshedPair& mesh, int harmonics);

/// Least and greatest stiffness over a period, by dense sampling of each smooth part, its ends included [N/m].
struct StiffnessRange {
  double least, greatest;
};
[[nodiscard]] StiffnessRange stiffness_range(const MeshedPair& mesh);
[[nodiscard]] StiffnessRange stiffness_range(const FourierSeries& series);

/// The estimate of ISO 6336-1:2006, 9.3, method B, for solid discs under 100 N per mm of face width and more (under
/// less it has softer teeth; this model's do not depend on the load). The pinion is the gear of fewer teeth, whichever
/// drives; an internal gear counts as one of infinitely many teeth, without shift. Fitted by the standard for
/// x_1 >= x_2 and -0.5 <= x_1 + x_2 <= 2.
struct IsoStiffness {
  double single;  ///< c' b [N/m]
  double mesh;    ///< c_gamma-alpha b [N/m]
};
[[nodiscard]] IsoStiffness iso_stiffness(const MeshedPair& mesh);

}  // namespace epicyclic::gear
