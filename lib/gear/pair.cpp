#include "gear/pair.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "core/errors.hpp"

namespace epicyclic::gear {

namespace {

constexpr double pi = std::numbers::pi;

double tangent_length(const Tooth& t, double radius_mm) {
  return std::sqrt(radius_mm * radius_mm - t.base_radius_mm * t.base_radius_mm);
}

}  // namespace

Pair make_pair(const Tooth& driving, const Tooth& driven, double centre_distance_mm) {
  if (driving.internal) throw DomainError("the driving member of a pair must have external teeth");
  const double base =
      driven.internal ? driven.base_radius_mm - driving.base_radius_mm : driven.base_radius_mm + driving.base_radius_mm;
  const double cosine = base / centre_distance_mm;
  if (!(cosine > 0.0) || !(cosine < 1.0))
    throw DomainError("base circles of " + std::to_string(driving.base_radius_mm) + " and " +
                      std::to_string(driven.base_radius_mm) + " mm at a centre distance of " +
                      std::to_string(centre_distance_mm) + " mm leave no line of action");
  Pair p;
  p.driving = driving;
  p.driven = driven;
  p.centre_distance_mm = centre_distance_mm;
  p.pressure_angle = std::acos(cosine);
  p.base_pitch_mm = driving.base_pitch_mm();
  p.theoretical_length_mm = base * std::tan(p.pressure_angle);
  p.pitch_arm_mm = driving.base_radius_mm * std::tan(p.pressure_angle);
  const double reach_2 = tangent_length(driven, driven.tip_radius_mm);
  p.start_mm = driven.internal ? reach_2 - p.theoretical_length_mm : p.theoretical_length_mm - reach_2;
  p.end_mm = tangent_length(driving, driving.tip_radius_mm);
  return p;
}

double tight_centre_distance_mm(const Tooth& driving, const Tooth& driven) {
  const double angles = driving.teeth * driving.base_half_angle + driven.teeth * driven.base_half_angle;
  const double inv =
      driven.internal ? (pi - angles) / (driven.teeth - driving.teeth) : (angles - pi) / (driving.teeth + driven.teeth);
  const double base =
      driven.internal ? driven.base_radius_mm - driving.base_radius_mm : driven.base_radius_mm + driving.base_radius_mm;
  if (!(inv >= 0.0) || !(base > 0.0))
    throw DomainError(
        "the teeth are too thin or too thick to mesh without backlash at any centre distance (inv alpha " +
        std::to_string(inv) + ")");
  return base / std::cos(inverse_involute(inv));
}

double Pair::radius_1_mm(double l_mm) const { return std::hypot(driving.base_radius_mm, l_mm); }
double Pair::radius_2_mm(double l_mm) const { return std::hypot(driven.base_radius_mm, arm_2_mm(l_mm)); }

double Pair::curvature_radius_mm(double l_mm) const {
  const double h_2 = arm_2_mm(l_mm);
  return internal() ? l_mm * h_2 / (h_2 - l_mm) : l_mm * h_2 / (h_2 + l_mm);
}

PitchSide Pair::side() const {
  if (start_mm >= pitch_arm_mm) return PitchSide::beyond;
  return end_mm <= pitch_arm_mm ? PitchSide::before : PitchSide::across;
}

double Pair::pitch_radius_1_mm() const { return driving.base_radius_mm / std::cos(pressure_angle); }
double Pair::pitch_radius_2_mm() const { return driven.base_radius_mm / std::cos(pressure_angle); }

double Pair::backlash_mm() const {
  const double r_1 = pitch_radius_1_mm();
  const double r_2 = pitch_radius_2_mm();
  const double pitch = 2.0 * pi * r_1 / driving.teeth;
  const double backlash = pitch - driving.thickness_at(r_1) - driven.thickness_at(r_2);
  // For a mesh without backlash the sum of the terms is rounding: the result is then 0.
  constexpr double rounding = 64.0 * std::numeric_limits<double>::epsilon();
  return std::abs(backlash) <= rounding * pitch ? 0.0 : backlash;
}

double Pair::normal_backlash_mm() const { return backlash_mm() * std::cos(pressure_angle); }

double Pair::tip_clearance_1_mm() const {
  return internal() ? driven.root_radius_mm - centre_distance_mm - driving.tip_radius_mm
                    : centre_distance_mm - driving.tip_radius_mm - driven.root_radius_mm;
}

double Pair::tip_clearance_2_mm() const {
  return internal() ? driven.tip_radius_mm - centre_distance_mm - driving.root_radius_mm
                    : centre_distance_mm - driven.tip_radius_mm - driving.root_radius_mm;
}

double Pair::tip_passing_angle() const {
  constexpr double never = std::numeric_limits<double>::infinity();
  if (!internal()) return never;
  const double r_1 = driving.tip_radius_mm;
  const double r_2 = driven.tip_radius_mm;
  const double a = centre_distance_mm;
  if (a + r_1 <= r_2) return never;  // the tip circles do not meet
  // Angles from the line of centres to the crossing of the tip circles, then those by which the two tips reach it.
  const double at_1 = std::acos((r_2 * r_2 - r_1 * r_1 - a * a) / (2.0 * a * r_1));
  const double at_2 = std::acos((r_2 * r_2 + a * a - r_1 * r_1) / (2.0 * a * r_2));
  const double inv = involute(pressure_angle);
  const double rotation_1 = at_1 + involute(driving.pressure_angle_at(r_1)) - inv;
  return rotation_1 * driving.teeth / driven.teeth + inv - involute(driven.pressure_angle_at(r_2)) - at_2;
}

ContactSpeeds contact_speeds(const Pair& pair, double l_mm, double base_speed) {
  return {base_speed * l_mm / pair.driving.base_radius_mm,
          base_speed * pair.arm_2_mm(l_mm) / pair.driven.base_radius_mm};
}

}  // namespace epicyclic::gear
