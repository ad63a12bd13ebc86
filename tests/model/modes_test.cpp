// Natural frequencies against published tables and closed forms.

#include "model/modes.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "problems/lin_parker.hpp"

namespace epicyclic::model::modes_test {
namespace {

using problems::lin_parker;
using problems::undamped_member;
using problems::undamped_planet;

struct Published {
  ModeType type;
  int multiplicity;
  double hertz;
  double tolerance;  // the source's digits
};

constexpr double to_tenths = 0.1;  // docs/theory/published_results.md, section 1
constexpr double to_hertz = 0.5;   // printed to the hertz

void expect_published(int planets, const std::vector<Published>& published) {
  const gear::Stage stage = lin_parker(planets);
  const Scales scales = scales_of(stage);
  const std::vector<Mode> found = modes(stage, scales);
  ASSERT_EQ(found.size(), published.size());
  for (const Published& p : published) {
    int hits = 0;
    for (const Mode& m : found) {
      const double hertz = m.frequency_ratio * scales.omega_sn / (2.0 * std::numbers::pi);
      if (std::abs(hertz - p.hertz) > p.tolerance) continue;
      ++hits;
      EXPECT_EQ(to_string(m.type), to_string(p.type)) << p.hertz;
      EXPECT_EQ(m.multiplicity, p.multiplicity) << p.hertz;
    }
    EXPECT_EQ(hits, 1) << p.hertz << " Hz";
  }
}

TEST(LinParker, ThreePlanetsHaveThePublishedFrequenciesAndTypes) {
  using enum ModeType;
  std::vector<Published> p;
  for (const double f : {0.0, 1475.7, 1930.3, 2658.3, 7462.8, 11775.3}) p.push_back({rotational, 1, f, to_tenths});
  for (const double f : {743.2, 1102.4, 1896.0, 2276.4, 6986.3, 9647.9}) p.push_back({translational, 2, f, to_tenths});
  expect_published(3, p);
}

TEST(LinParker, FourPlanetsHaveThePublishedFrequenciesAndTypes) {
  using enum ModeType;
  std::vector<Published> p;
  for (const double f : {0.0, 1536.6, 1970.6, 2625.7, 7773.6, 13071.1}) p.push_back({rotational, 1, f, to_tenths});
  for (const double f : {1892.8, 2342.5, 7189.9, 10437.6}) p.push_back({translational, 2, f, to_tenths});
  for (const double f : {727.0, 1091.0}) p.push_back({translational, 2, f, to_hertz});
  for (const double f : {1808.2, 5963.8, 6981.7}) p.push_back({planet, 1, f, to_tenths});
  expect_published(4, p);
}

TEST(LinParker, CountsOfTypesFollowTheirTheorem) {
  // 6 rotational (1), 6 translational (2), and with N > 3 planets 3 planet modes (N - 3).
  for (int n = 3; n <= 6; ++n) {
    const gear::Stage stage = lin_parker(n);
    std::array<int, 4> rows{};
    int motions = 0;
    for (const Mode& m : modes(stage, scales_of(stage))) {
      ++rows[static_cast<std::size_t>(m.type)];
      motions += m.multiplicity;
      const int multiplicity = m.type == ModeType::rotational ? 1 : m.type == ModeType::translational ? 2 : n - 3;
      EXPECT_EQ(m.multiplicity, multiplicity) << n << " planets, " << to_string(m.type);
    }
    EXPECT_EQ(rows, (std::array<int, 4>{6, 6, n > 3 ? 3 : 0, 0})) << n;
    EXPECT_EQ(motions, 3 * n + 9);
  }
}

TEST(Modes, UnequalSpacingMixesTypesAndKeepsTheRigidRotation) {
  gear::Stage stage = lin_parker(3);
  stage.angles_deg = {0.0, 110.0, 250.0};
  const std::vector<Mode> found = modes(stage, scales_of(stage));
  EXPECT_EQ(found.front().frequency_ratio, 0.0);
  int mixed = 0;
  for (const Mode& m : found) mixed += m.type == ModeType::other ? 1 : 0;
  EXPECT_GT(mixed, 8);
}

/// Closed form of Kahraman 1994: torsion only, rigid pins, ring fixed, m_c with the planets' masses.
struct Torsion {
  int planets;
  double m_s, m_p, m_c, k_s, k_r, alpha_s, alpha_r;
};

gear::Stage torsional(const Torsion& t) {
  gear::Stage s;
  s.planet_count = t.planets;
  // With angles alpha the coordinates here are on base circles and r_c, so the carrier's part of the mesh deflection is
  // u_c cos alpha; a planet's own mass rides on the carrier.
  constexpr double planet_mass = 0.1;
  s.sun = undamped_member(1.0, t.m_s, gear::rigid);
  s.ring = undamped_member(1.0, 1.0, gear::rigid, gear::rigid);
  s.carrier = undamped_member(1.0, t.m_c - t.planets * planet_mass, gear::rigid);
  s.planet = undamped_planet(planet_mass, t.m_p, gear::rigid);
  s.sun_planet_mesh.stiffness_N_per_m = t.k_s;
  s.ring_planet_mesh.stiffness_N_per_m = t.k_r;
  s.sun_planet_mesh.operating_pressure_angle_deg = t.alpha_s;
  s.ring_planet_mesh.operating_pressure_angle_deg = t.alpha_r;
  return s;
}

std::vector<double> kahraman(const Torsion& t) {
  const double n = t.planets;
  const double c_s = std::cos(t.alpha_s * std::numbers::pi / 180.0);
  const double c_r = std::cos(t.alpha_r * std::numbers::pi / 180.0);
  const double l1 = t.m_p * t.m_c * t.m_s;
  const double l2 = -(n * t.k_s * t.m_p * t.m_c + (t.k_r + t.k_s) * t.m_c * t.m_s +
                      n * (t.k_s * c_s * c_s + t.k_r * c_r * c_r) * t.m_p * t.m_s);
  const double l3 = n * t.k_r * t.k_s * (t.m_c + n * t.m_p * c_r * c_r + (c_s + c_r) * (c_s + c_r) * t.m_s);
  const double root = std::sqrt(l2 * l2 - 4.0 * l1 * l3);
  return {std::sqrt((-l2 - root) / (2.0 * l1)), std::sqrt((-l2 + root) / (2.0 * l1)),
          std::sqrt((t.k_s + t.k_r) / t.m_p)};
}

TEST(Kahraman, TorsionalFrequenciesAreTheClosedForm) {
  // Rounding of an eigenvalue problem of a few unknowns, with the rigid constraints' basis.
  constexpr double rounding = 1e-10;
  for (const Torsion& t :
       {Torsion{3, 0.5, 0.75, 4.0, 7.0, 11.0, 0.0, 0.0}, Torsion{4, 0.5, 0.75, 4.0, 7.0, 11.0, 24.6, 20.0},
        Torsion{6, 1.5, 0.3, 9.0, 5.0, 2.0, 30.0, 21.5}, Torsion{2, 0.8, 0.4, 3.0, 3.0, 4.0, 14.5, 25.0},
        Torsion{5, 0.7, 0.5, 6.0, 4.0, 9.0, 22.0, 18.0}}) {
    const gear::Stage stage = torsional(t);
    const Scales scales = scales_of(stage);
    const std::vector<Mode> found = modes(stage, scales);
    ASSERT_EQ(found.size(), 4U);
    EXPECT_EQ(found[0].frequency_ratio, 0.0);
    const std::vector<double> closed = kahraman(t);
    for (std::size_t k = 0; k < closed.size(); ++k) {
      int hits = 0;
      for (const Mode& m : found) {
        if (std::abs(m.frequency_ratio * scales.omega_sn / closed[k] - 1.0) > rounding) continue;
        ++hits;
        EXPECT_EQ(m.multiplicity, k == 2 ? t.planets - 1 : 1);
        EXPECT_EQ(to_string(m.type), k == 2 ? "planet" : "rotational");
      }
      EXPECT_EQ(hits, 1) << closed[k];
    }
  }
}

TEST(Kahraman, PrintedExampleIsMetToItsDigits) {
  const Torsion example{3, 0.5, 0.75, 4.0, 7.0, 11.0, 0.0, 0.0};
  const std::vector<double> closed = kahraman(example);
  constexpr double digits = 5e-7;  // printed to six decimals
  EXPECT_NEAR(closed[0], 4.706975, digits);
  EXPECT_NEAR(closed[1], 7.572608, digits);
  EXPECT_NEAR(closed[2], 4.898979, digits);
}

// Rayleigh: d ln omega^2 / d ln k of an element is its share of the elastic energy, for every mode, type and number of
// planets; shares of a multiple mode are means over its shapes.
TEST(ModalEnergies, ElasticSharesAreTheSensitivitiesToTheStiffnesses) {
  constexpr double change = 1e-4;
  constexpr double tolerance = 1e-6;  // central difference
  for (const int planets : {2, 3, 4, 5, 6}) {
    const gear::Stage stage = lin_parker(planets);
    const Scales scales = scales_of(stage);
    const LinearStage linear = linear_stage(stage, scales);
    const std::vector<Mode> found = modes(stage, scales);
    const auto scaled = [&](Element element, double factor) {
      gear::Stage s = stage;
      double bearing = s.planet.bearing_N_per_m;
      double* const stiffness[] = {&s.sun_planet_mesh.stiffness_N_per_m,
                                   &s.ring_planet_mesh.stiffness_N_per_m,
                                   &bearing,
                                   &s.sun.support_N_per_m,
                                   &s.sun.torsional_support_N_per_m,
                                   &s.ring.support_N_per_m,
                                   &s.ring.torsional_support_N_per_m,
                                   &s.carrier.support_N_per_m,
                                   &s.carrier.torsional_support_N_per_m};
      *stiffness[static_cast<std::size_t>(element)] *= factor;
      s.planet.bearing_N_per_m = bearing;
      return modes(s, scales);
    };
    for (std::size_t k = 0; k < element_count; ++k) {
      const auto up = scaled(static_cast<Element>(k), 1.0 + change);
      const auto down = scaled(static_cast<Element>(k), 1.0 - change);
      ASSERT_EQ(up.size(), found.size());
      ASSERT_EQ(down.size(), found.size());
      for (std::size_t i = 0; i < found.size(); ++i) {
        if (found[i].frequency_ratio == 0.0) continue;
        const double slope =
            2.0 * std::log(up[i].frequency_ratio / down[i].frequency_ratio) / std::log((1.0 + change) / (1.0 - change));
        EXPECT_NEAR(modal_energies(linear, found[i], planets).elastic[k], slope, tolerance)
            << planets << " planets, mode " << i << ", " << to_string(static_cast<Element>(k));
      }
    }
  }
}

TEST(Modes, ShapesAreOrthonormalAndSolveTheEigenproblem) {
  constexpr double rounding = 1e-9;
  const gear::Stage stage = lin_parker(5);
  const Scales scales = scales_of(stage);
  const LinearStage linear = linear_stage(stage, scales);
  for (const Mode& m : modes(stage, scales)) {
    const Eigen::MatrixXd gram = m.shapes.transpose() * linear.mass.asDiagonal() * m.shapes;
    EXPECT_LT((gram - Eigen::MatrixXd::Identity(m.multiplicity, m.multiplicity)).norm(), rounding);
    const Eigen::MatrixXd residual =
        linear.stiffness * m.shapes - m.frequency_ratio * m.frequency_ratio * (linear.mass.asDiagonal() * m.shapes);
    EXPECT_LT(residual.norm(), rounding * linear.stiffness.norm());
  }
}

}  // namespace
}  // namespace epicyclic::model::modes_test
