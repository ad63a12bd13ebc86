// Compliance of one tooth under a force on its flank: the tooth as a cantilever on an elastic body (energy method).
//
// External tooth, contact at pressure angle a_c: alpha_1 = tan a_c - alpha_2, D(a) = sin a + (alpha_2 - a) cos a:
//   1/k_b = int 3 {1 + cos alpha_1 [(alpha_2 - a) sin a - cos a]}^2 (alpha_2 - a) cos a / (2 E L D^3) da         [G-kb]
//   1/k_s = int 1.2 (1 + nu) (alpha_2 - a) cos a cos^2 alpha_1 / (E L D) da                                     [G-ks]
//   1/k_a = int (alpha_2 - a) cos a sin^2 alpha_1 / (2 E L D) da                                                [G-ka]
// from -alpha_1 to the root circle, alpha_2 - sqrt((r_f / r_b)^2 - 1) if it lies outside the base circle; else to
// alpha_2 and on along a straight flank of half thickness r_b sin alpha_2 (closed forms); or to the end of the involute
// and on along the rack-cut fillet of gear/tooth.hpp.
// Internal tooth, b = tan a + alpha_2, force angle b_c, D_r(b) = sin b - (b - alpha_2) cos b, from b_c to the root:
// [G-kr]
//   1/k_b = int 3 {cos b_c [cos b + (b - alpha_2) sin b] - 1}^2 (b - alpha_2) cos b / (2 E L D_r^3) db ; k_s, k_a alike
// Body, external:  1/k_f = cos^2 alpha_1 / (E L) [L* (u/S)^2 + M* (u/S) + P* (1 + Q* tan^2 alpha_1)] [G-kf]
//   S = 2 r_f theta_f ,  u = r_b / cos alpha_1 - r_f ,  X* = A/theta^2 + B h^2 + C h/theta + D/theta + E h + F ,
//   h = r_f / r_int  (Sainsot, Velex, Duverger, J. Mech. Des. 126 (2004) 748)
// Body, ring:  half plane,  1/k_f = cos^2 b_c (1 - nu^2) / (E L) [5.306 (l/h)^2 + 2 (1 - nu - 2 nu^2)/(1 - nu^2) (l/h)
//   + 1.534 (1 + 0.4167 tan^2 b_c / (1 + nu))]  (Cornell, J. Mech. Des. 103 (1981) 447), or rigid               [G-kfr]
//
// h is not that of the bore unless somebody says so: Sainsot's annulus is held fast along its inner circle, and what P*
// gains with h^2 (B = 0.1855) is its wind-up about that circle, (1 + nu)/(2 pi) (h^2 - 1) by the theory of the annulus
// (0.207 for nu = 0.3). A shaft gear takes its torque along its axis and a planet takes none at its bore: neither winds
// up, and the formula would make a solid gear (h -> infinity) infinitely soft. A solid disc of plane stress under the
// same tangential load, referred to its own rigid-body displacement, has [G-disc]
//   P = (1 + nu)/(6 pi) + (3 + nu)/(2 pi) + 1/(2 pi) sum_{n >= 2} (sin n theta / n theta)^2 [(3-nu)/(n+1) +
//   (1+nu)/(n-1)]
// which is 2.70, 2.38, 2.17, 2.01 at theta 0.03, 0.05, 0.07, 0.09, where Sainsot's P* at h = 1.4, the lower end of its
// fit, is 2.90, 2.55, 2.35, 2.22 and without the wind-up left there 2.70, 2.36, 2.15, 2.02. So h = 1.4 is the default
// for every gear. With it the mean stiffness of 13 pairs of 17 to 100 teeth is 0.92 to 1.14 of c_gamma of [G-iso],
// which holds for solid discs; with h = 7 it is 0.43 to 0.49, with Cornell's half plane a fifth to a third more (near
// 1 / 0.8: the theory that ISO takes 0.8 of).
//
// Source: docs/theory/gears.md, sections 3 to 5, derived there; Yang and Lin 1987, Tian 2004, Liang et al. 2014, Ma et
// al. 2014 use the same energies. Limits: spur teeth, plane stress cantilever; Sainsot's fit holds for 1.4 <= h <= 7
// and 0.01 <= theta_f <= 0.12 rad; expect +-30 % between models of this kind and plane-strain finite elements.
// Smoothness: analytic in the contact radius.
#pragma once

#include <optional>

#include "gear/material.hpp"
#include "gear/tooth.hpp"

namespace epicyclic::gear {

/// Shape between involute and root circle of an external tooth.
enum class Fillet {
  none,      ///< the involute goes on to the root circle, inside the base circle a straight flank
  trochoid,  ///< the fillet that the rack cuts
};

/// Elastic body under a ring's tooth.
enum class RingFoundation { half_plane, rigid };

/// The point on the tooth's centre line from which the lever of the force on the tooth's body is measured, to the root
/// circle.
enum class FoundationLever {
  centreline,      ///< crossing of the line of action and the centre line (Sainsot)
  contact_height,  ///< height of the contact point (used by some codes)
};

struct ComplianceOptions {
  bool bending = true, shear = true, axial = true, hertz = true, foundation = true;
  Fillet fillet = Fillet::none;
  RingFoundation ring_foundation = RingFoundation::half_plane;
  FoundationLever lever = FoundationLever::centreline;
  int panels = 4;  ///< of 16 Gauss points, on each smooth part of the profile

  /// @throws InputError for less than one panel
  void validate() const;
};

/// h_f of a gear that does not wind up about its bore: solid, on a shaft of its own, or idling on a bearing [-].
inline constexpr double solid_body_ratio = 1.4;

/// A tooth with what its compliance needs besides its flank.
struct ToothBody {
  Tooth tooth;
  Material material;
  double radius_ratio = solid_body_ratio;  ///< h_f = r_f / r_int of Sainsot's annulus; external only [-]
  std::optional<double> root_half_angle;   ///< theta_f, if not that of the profile [rad]
};

/// Compliances along the line of action [m/N]; zero where switched off.
struct ToothCompliance {
  double bending = 0, shear = 0, axial = 0, foundation = 0;
  [[nodiscard]] double sum() const { return bending + shear + axial + foundation; }
};

/// @throws DomainError if the contact is not on the flank, or if the fillet of an undercut tooth is requested;
/// InputError for options out of range
[[nodiscard]] ToothCompliance tooth_compliance(const ToothBody& body, double contact_radius_mm,
                                               const ComplianceOptions& options);

/// Half of the angle that the tooth takes at its root circle, theta_f [rad].
[[nodiscard]] double root_half_angle(const Tooth& tooth, Fillet fillet);

/// Sainsot's four coefficients at theta_f [rad] and h_f.
struct SainsotCoefficients {
  double l, m, p, q;
  bool in_range;  ///< 1.4 <= h_f <= 7 and 0.01 <= theta_f <= 0.12
};
[[nodiscard]] SainsotCoefficients sainsot_coefficients(double theta_f, double radius_ratio);

/// Hertz's line contact: 4 (1 - nu^2) / (pi E L) [m/N].                                                        [G-kh]
[[nodiscard]] double hertz_compliance(const Material& material, double width_mm);

}  // namespace epicyclic::gear
