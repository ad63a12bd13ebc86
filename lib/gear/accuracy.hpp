// Tolerances of tooth flanks by accuracy grade, ISO 1328-1:1995 (= GB/T 10095.1-2008).
//
//   grade 5, from the geometric means of the ranges of m, d, b [mm]; grade Q: times 2^((Q - 5) / 2)      [G-1328]
//   f_pt = 0.3 (m + 0.4 sqrt d) + 4                 single pitch
//   F_p  = 0.3 m + 1.25 sqrt d + 7                  total cumulative pitch
//   F_a  = 3.2 sqrt m + 0.22 sqrt d + 0.7           total profile;  form f_fa, slope f_Ha likewise
//   F_b  = 0.1 sqrt d + 0.63 sqrt b + 4.2           total helix
//   f_i' = K (9 + 0.3 m + 3.2 sqrt m + 0.34 sqrt d) , K = 0.2 (eps + 4) / eps for eps < 4, else 0.4
//
// Rounded as the standard's section 5.2.3 has it: above 10 um to whole, from 5 to 10 to half micrometres, below 5 to
// tenths. Source: the formulas as implemented in published code (docs/theory/parameters.md, section 4); f_i' is from
// memory of the standard and marked so where it is shown. Limits: grades 0 to 12, m 0.5 to 70, d 5 to 10000, b 4 to
// 1000 mm.
#pragma once

namespace epicyclic::gear {

/// Micrometres.
struct Tolerances {
  double single_pitch;      ///< f_pt
  double cumulative_pitch;  ///< F_p
  double profile;           ///< F_alpha
  double profile_form;      ///< f_f alpha
  double profile_slope;     ///< f_H alpha
  double helix;             ///< F_beta
  double single_flank;      ///< f_i'
};

/// @throws DomainError outside the standard's ranges
[[nodiscard]] Tolerances tolerances(int grade, double module_mm, double reference_diameter_mm, double width_mm,
                                    double contact_ratio);

}  // namespace epicyclic::gear
