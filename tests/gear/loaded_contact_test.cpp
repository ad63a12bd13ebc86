// Contact of modified flanks under load: its gaps by the geometry of the involutes, its load by closed forms.
#include "gear/loaded_contact.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "core/errors.hpp"
#include "gear/gear_set.hpp"
#include "problems/table1.hpp"

namespace epicyclic::gear::loaded_contact_test {
namespace {

using problems::table1;
using problems::yi_pair;

constexpr double force_N = 2000;
constexpr double rounding = 1e-9;  // of the phases where pairs touch, found by halving
const GearData unmodified{};

/// A pair whose teeth yield at their contact alone: the same stiffness everywhere.
MeshedPair constant_pair() {
  MeshedPair mesh = yi_pair();
  mesh.options = {.bending = false, .shear = false, .axial = false, .hertz = true, .foundation = false};
  return mesh;
}

/// Long linear reliefs at the tips of both gears of a mesh: 0 at positions q_b (driving) and q_a (driven), with the
/// deflection of one pair under the force where the other pair is at its end of the single contact.
std::pair<GearData, GearData> long_reliefs(const MeshedPair& mesh, double q_a, double q_b, double deflection_um) {
  const Pair& p = mesh.pair;
  const double per_pitch = deflection_um / (q_a + 1.0 - q_b);  // [um per base pitch]
  GearData first, second;
  first.tip_relief = Relief{.amount_um = per_pitch * (p.contact_ratio() - q_b), .start_roll_mm = mesh.arm_mm(q_b)};
  second.tip_relief = Relief{.amount_um = per_pitch * q_a, .start_roll_mm = p.arm_2_mm(mesh.arm_mm(q_a))};
  return {first, second};
}

// The rotation of a gear until its flank meets a point, found by search along the flank.
struct Point {
  double x, y;
};
double angle_to_flank(const Tooth& tooth, const Point& point) {
  // The polar angle of the involute from its foot, at the radius of the point, by its parametric form.
  const double radius = std::hypot(point.x, point.y);
  double low = 0.0;
  double high = 3.0;
  for (int k = 0; k < 200; ++k) {
    const double t = 0.5 * (low + high);
    (std::hypot(std::cos(t) + t * std::sin(t), std::sin(t) - t * std::cos(t)) * tooth.base_radius_mm < radius ? low
                                                                                                              : high) =
        t;
  }
  const double t = 0.5 * (low + high);
  return std::atan2(std::sin(t) - t * std::cos(t), std::cos(t) + t * std::sin(t));
}

TEST(LoadedContact, GapsBeyondThePathAreThoseOfTheInvolutes) {
  const GearSet set = make_gear_set(table1());
  for (const MeshedPair* mesh : {&set.sun_planet, &set.ring_planet}) {
    const Pair& p = mesh->pair;
    const LoadedContact contact(*mesh, unmodified, unmodified, force_N);
    const double sign = p.internal() ? 1.0 : -1.0;
    for (const double u : {0.02, 0.1, 0.25}) {
      // Axis of gear 1 at 0, that of gear 2 at (0, centre distance), of a ring below. Gear 1 turns clockwise.
      const double alpha = p.pressure_angle;
      const Point axis_2{0.0, -sign * p.centre_distance_mm};
      const auto turned = [](double r, double angle) { return Point{r * std::sin(angle), r * std::cos(angle)}; };
      // Angles clockwise from the y-axis, of the tangent points and of the feet of the flanks on the base circles.
      const double n_2 = p.internal() ? -alpha : std::numbers::pi - alpha;
      const auto foot_1 = [&](double l) { return -alpha + l / p.driving.base_radius_mm; };
      const auto foot_2 = [&](double l) { return n_2 + p.arm_2_mm(l) / p.driven.base_radius_mm; };
      const auto inv = [](const Tooth& t, double r) {
        const double a = std::acos(t.base_radius_mm / r);
        return std::tan(a) - a;
      };
      {  // the tip of gear 2 before the start of contact
        const double l = p.start_mm - u * p.base_pitch_mm;
        const double at = foot_2(l) - inv(p.driven, p.driven.tip_radius_mm);
        const Point from_2 = turned(p.driven.tip_radius_mm, at);
        const Point from_1{from_2.x + axis_2.x, from_2.y + axis_2.y};
        const double flank = foot_1(l) - angle_to_flank(p.driving, from_1);
        const double gap = std::remainder(std::atan2(from_1.x, from_1.y) - flank, 2.0 * std::numbers::pi);
        EXPECT_NEAR(contact.gap_um(-u), 1e3 * gap * p.driving.base_radius_mm, 1e-6) << u;
        EXPECT_GT(contact.gap_um(-u), 0.0);
      }
      {  // the tip of gear 1 after the end of contact
        const double l = p.end_mm + u * p.base_pitch_mm;
        const double at = foot_1(l) - inv(p.driving, p.driving.tip_radius_mm);
        const Point from_1 = turned(p.driving.tip_radius_mm, at);
        const Point from_2{from_1.x - axis_2.x, from_1.y - axis_2.y};
        const double flank = foot_2(l) - angle_to_flank(p.driven, from_2);
        const double gap = sign * std::remainder(flank - std::atan2(from_2.x, from_2.y), 2.0 * std::numbers::pi);
        EXPECT_NEAR(contact.gap_um(p.contact_ratio() + u), 1e3 * gap * p.driven.base_radius_mm, 1e-6) << u;
        EXPECT_GT(contact.gap_um(p.contact_ratio() + u), 0.0);
      }
    }
  }
}

TEST(LoadedContact, ReliefHasItsShapeAndItsAmount) {
  const MeshedPair mesh = yi_pair();
  const Pair& p = mesh.pair;
  const double q_0 = 1.1;
  const double arm = mesh.arm_mm(q_0);
  for (const auto& [shape, power] :
       {std::pair(ReliefShape::linear, 1.0), {ReliefShape::parabolic, 2.0}, {ReliefShape::circular, 2.0}}) {
    GearData first;
    first.tip_relief =
        Relief{.amount_um = 30, .shape = shape, .start_diameter_mm = 2.0 * std::hypot(arm, p.driving.base_radius_mm)};
    const LoadedContact contact(mesh, first, unmodified, force_N);
    EXPECT_EQ(contact.gap_um(0.5 * q_0), 0.0);
    EXPECT_NEAR(contact.gap_um(p.contact_ratio()), 30.0, 1e-9);
    const double x = 0.4;
    // An arc of 30 um over 12 mm is a parabola but for its square of the slope.
    const double off = shape == ReliefShape::circular ? 1e-4 : 1e-12;
    EXPECT_NEAR(contact.gap_um(q_0 + x * (p.contact_ratio() - q_0)), 30.0 * std::pow(x, power), 30.0 * off);
  }
}

TEST(LoadedContact, PairsBalanceTheForceAndShareOneDeflection) {
  const MeshedPair mesh = yi_pair();
  const auto [first, second] = long_reliefs(mesh, 0.5, 1.0, 20.0);
  const LoadedContact contact(mesh, first, second, force_N);
  for (const double phase : {0.0, 0.1, 0.31, 0.56, 0.7, 0.99}) {
    const double delta = contact.transmission_error_um(phase, force_N);
    double sum = 0.0;
    for (const PairLoad& load : contact.pair_loads(phase, force_N)) {
      sum += load.force_N;
      EXPECT_NEAR(load.force_N,
                  1e-6 * mesh.pair_stiffness(std::clamp(load.position, 0.0, mesh.contact_ratio())) *
                      (delta - contact.gap_um(load.position)),
                  1e-9 * force_N);
    }
    EXPECT_NEAR(sum, force_N, 1e-9 * force_N);
    EXPECT_NEAR(contact.no_load_error_um(phase) + 1e6 * force_N / contact.stiffness(phase), delta, 1e-9 * delta)
        << "the linear force of the model at the design load";
  }
}

TEST(LoadedContact, WithoutModificationTheNominalPathHasTheStiffnessOfItsPairs) {
  const MeshedPair mesh = yi_pair();
  constexpr double light_N = 1e-6;
  const LoadedContact contact(mesh, unmodified, unmodified, light_N);
  for (const double phase : {0.01, 0.2, 0.5, 0.6, 0.8})
    EXPECT_NEAR(contact.stiffness(phase) / mesh.stiffness(phase), 1.0, 1e-6) << phase;
}

// Harris, Proc. IMechE 172 (1958) 87: with pairs of one stiffness and long linear relief the transmission error is
// constant at the load for which the relief is made.
TEST(LoadedContact, LongReliefMakesTheTransmissionErrorConstantAtTheDesignLoad) {
  const MeshedPair mesh = constant_pair();
  const double deflection_um = 1e6 * force_N / mesh.pair_stiffness(0.5);
  const auto [first, second] = long_reliefs(mesh, 0.45, 1.05, deflection_um);
  const LoadedContact contact(mesh, first, second, force_N);
  const TransmissionError design = transmission_error(contact, force_N);
  EXPECT_NEAR(design.mean_um, deflection_um, 1e-9 * deflection_um);
  EXPECT_LT(design.peak_to_peak_um, 1e-9 * deflection_um);
  // At the force f F the error is, with the relief r = 1 - 0 of both pairs together: between the single contact, f, and
  // the middle of the double contact, (f + 1)/2, there is |1 - f|/2 of the deflection, below f = 1 until pairs part.
  for (const double f : {0.9, 1.1}) {
    const TransmissionError off = transmission_error(contact, f * force_N);
    EXPECT_NEAR(off.peak_to_peak_um, 0.5 * std::abs(1.0 - f) * deflection_um, 1e-9 * deflection_um) << f;
  }
  // Without load one pair touches: the error rises to half of the relief where both pairs have the same.
  EXPECT_NEAR(transmission_error(contact, 0.0).peak_to_peak_um, 0.5 * deflection_um, 1e-9 * deflection_um);
}

TEST(LoadedContact, UnmodifiedTransmissionErrorIsThatOfOneAndTwoPairs) {
  const MeshedPair mesh = constant_pair();
  const LoadedContact contact(mesh, unmodified, unmodified, force_N);
  const double deflection_um = 1e6 * force_N / mesh.pair_stiffness(0.5);
  const TransmissionError error = transmission_error(contact, force_N);
  EXPECT_NEAR(error.peak_to_peak_um, 0.5 * deflection_um, rounding * deflection_um);
  // Pairs touch earlier and leave later than on the path: by the place where the gap is what one pair yields.
  EXPECT_GT(error.contact_ratio, mesh.contact_ratio());
  double before = 0.0;
  for (double step = 0.1; step > 1e-12; step /= 2.0)
    if (contact.gap_um(-before - step) < deflection_um) before += step;
  EXPECT_NEAR(error.contact_ratio, mesh.contact_ratio() + 2.0 * before, 1e-9);
}

TEST(LoadedContact, CrowningBearsOnPartOfTheWidthUnderLittleLoad) {
  const MeshedPair mesh = constant_pair();
  GearData first;
  first.crowning_um = 12.0;
  GearData second;
  second.crowning_um = 8.0;
  const LoadedContact contact(mesh, first, second, force_N);
  const double k = 1e-6 * mesh.pair_stiffness(0.5);  // [N/um]
  const double single = 0.8;                         // one pair
  // (2/3) k d sqrt(d/C) = F below d = C, k (d - C/3) above.
  const double little = 2.0 / 3.0 * k * 5.0 * std::sqrt(5.0 / 20.0);
  EXPECT_NEAR(contact.transmission_error_um(single, little), 5.0, 1e-9);
  EXPECT_NEAR(contact.transmission_error_um(single, k * (30.0 - 20.0 / 3.0)), 30.0, 1e-9);
  EXPECT_NEAR(contact.transmission_error_um(single, 2.0 / 3.0 * k * 20.0), 20.0, 1e-9);
}

TEST(LoadedContact, KinksAreWhereTheStiffnessHasThem) {
  const MeshedPair mesh = yi_pair();
  const auto [first, second] = long_reliefs(mesh, 0.5, 1.0, 20.0);
  const LoadedContact contact(mesh, first, second, force_N);
  const std::vector<double>& breaks = contact.breakpoints();
  ASSERT_GE(breaks.size(), 4U);
  EXPECT_EQ(breaks.front(), 0.0);
  EXPECT_TRUE(std::is_sorted(breaks.begin(), breaks.end()));
  // Between two of them a curve of few rows is accurate to the order of smooth functions.
  const StiffnessCurve curve = stiffness_curve(
      [&] {
        MeshedPair loaded = mesh;
        loaded.loaded = std::make_shared<LoadedContact>(contact);
        return loaded;
      }(),
      1e-9);
  EXPECT_LT(*curve.error, 1e-9);
  EXPECT_LT(curve.phase.size(), 2000U);
  EXPECT_LT(*error_curve(contact, 1e-9).error, 1e-9);
}

TEST(LoadedContact, RefusesAReliefThatStartsBehindItsEnd) {
  const MeshedPair mesh = yi_pair();
  GearData first;
  first.tip_relief = Relief{.amount_um = 20, .start_roll_mm = mesh.pair.end_mm + 1.0};
  EXPECT_THROW(LoadedContact(mesh, first, unmodified, force_N), DomainError);
  first.tip_relief = Relief{.amount_um = 20, .start_diameter_mm = mesh.pair.driving.base_radius_mm};
  EXPECT_THROW(LoadedContact(mesh, first, unmodified, force_N), DomainError);
}

}  // namespace
}  // namespace epicyclic::gear::loaded_contact_test
