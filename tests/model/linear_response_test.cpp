// The linear stage R1 (constant mean stiffness, no gap): its response and the stability of its rigid rotation, from the
// right-hand side alone.

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>
#include <string>
#include <vector>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "core/dense.hpp"
#include "core/errors.hpp"
#include "model/dynamic_model.hpp"
#include "model/parameters.hpp"
#include "problems/r1.hpp"

namespace epicyclic::model::linear_response_test {
namespace {

constexpr double pi = std::numbers::pi;

/// dy/ds = A y + g(s), A by columns.
Eigen::MatrixXd matrix_of(const DynamicModel& m) {
  const auto n = static_cast<Eigen::Index>(m.dimension);
  Eigen::VectorXd at_zero(n);
  Eigen::VectorXd column(n);
  Eigen::VectorXd y = Eigen::VectorXd::Zero(n);
  m.right_hand_side(0, 0.0, y.data(), at_zero.data());
  Eigen::MatrixXd a(n, n);
  for (Eigen::Index k = 0; k < n; ++k) {
    y(k) = 1.0;
    m.right_hand_side(0, 0.0, y.data(), column.data());
    y(k) = 0.0;
    a.col(k) = column - at_zero;
  }
  return a;
}

Eigen::VectorXd forcing(const DynamicModel& m, double s) {
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(m.dimension));
  Eigen::VectorXd g(zero.size());
  m.right_hand_side(0, s, zero.data(), g.data());
  return g;
}

/// mean + C cos s + S sin s
struct Harmonic {
  double mean, cosine, sine;
};

struct Response {
  Harmonic sun_planet, ring_planet;
};

/// The periodic motion of the linear stage [um], planet 1.
Response response(const DynamicModel& m, const Scales& scales) {
  const Eigen::MatrixXd a = matrix_of(m);
  // The forcing has one harmonic: three phases give it.
  const Eigen::VectorXd g_0 = forcing(m, 0.0);
  const Eigen::VectorXd g_1 = forcing(m, 0.5 * pi);
  const Eigen::VectorXd g_2 = forcing(m, pi);
  const Eigen::VectorXd mean = 0.5 * (g_0 + g_2);
  const Eigen::VectorXcd amplitude = (g_0 - mean).cast<std::complex<double>>() -
                                     std::complex<double>(0, 1) * (g_1 - mean).cast<std::complex<double>>();
  const Eigen::VectorXd y_mean = -a.partialPivLu().solve(mean);
  const auto n = a.rows();
  const Eigen::MatrixXcd dynamic =
      std::complex<double>(0, 1) * Eigen::MatrixXcd::Identity(n, n) - a.cast<std::complex<double>>();
  const Eigen::VectorXcd y_1 = dynamic.partialPivLu().solve(amplitude);
  const auto delta = [&](double s) {
    const Eigen::VectorXd y = y_mean + (y_1 * std::polar(1.0, s)).real();
    MeshDeflections d;
    m.deflections(s, y.data(), d);
    return std::array<double, 2>{d.sun_planet[0], d.ring_planet[0]};
  };
  const auto d_0 = delta(0.0);
  const auto d_1 = delta(0.5 * pi);
  const auto d_2 = delta(pi);
  const auto harmonic = [&](std::size_t k) {
    const double centre = 0.5 * (d_0[k] + d_2[k]);
    return Harmonic{scales.displacement_um(centre), scales.displacement_um(d_0[k] - centre),
                    scales.displacement_um(d_1[k] - centre)};
  };
  return {harmonic(0), harmonic(1)};
}

/// Mean deflections under the balanced part of the loads [um]. R1's radii have five decimals, so that T_c = 4 T_D
/// misses balance by 1.6e-7 and the train accelerates a little; the table's means are those of the equilibrium nearest
/// in force.
std::array<double, 2> balanced_means(const gear::Stage& s, const Scales& scales, double omega) {
  constexpr std::size_t planets = 3;
  const ModelOptions options{GapDamping::always, Gyroscopic::off, 0.0};
  const DynamicModel m = make_dynamic_model(s, scales, omega, options, CoordinateChoice::full);
  const auto p = make_parameters<planets>(s, scales, omega, options);
  Coordinates<double, planets> mass;
  mass.x_s = mass.y_s = p.mass_s;
  mass.w_s = p.inertia_s;
  mass.x_p = mass.y_p = p.mass_p;
  mass.w_p = p.inertia_p;
  mass.x_r = mass.y_r = p.mass_r;
  mass.u_r = p.inertia_r;
  mass.x_c = mass.y_c = p.mass_c;
  mass.u_c = p.inertia_c;
  const auto n = static_cast<Eigen::Index>(m.dimension / 2);
  Eigen::VectorXd masses(n);
  pack(Layout::full, mass, masses.data());
  const Eigen::MatrixXd stiffness = masses.asDiagonal() * matrix_of(m).bottomLeftCorner(n, n);
  const Eigen::VectorXd load = masses.asDiagonal() * (0.5 * (forcing(m, 0.0) + forcing(m, pi))).tail(n);
  Eigen::VectorXd y = Eigen::VectorXd::Zero(2 * n);
  y.head(n) = -epicyclic::least_norm_solution(stiffness, load);
  // Half a period apart the errors cancel.
  MeshDeflections d_0;
  MeshDeflections d_1;
  m.deflections(0.0, y.data(), d_0);
  m.deflections(pi, y.data(), d_1);
  return {scales.displacement_um(0.5 * (d_0.sun_planet[0] + d_1.sun_planet[0])),
          scales.displacement_um(0.5 * (d_0.ring_planet[0] + d_1.ring_planet[0]))};
}

TEST(LinearResponse, IsThatOfTheTableToAllItsDigits) {
  // docs/theory/published_results.md, section 5, printed to 1e-8 um.
  constexpr double digits_um = 0.5e-8 * 1.01;
  // What 1.6e-7 of unbalanced load moves the means of the accelerating train by, relative.
  constexpr double unbalance = 1.6e-7;
  struct Row {
    double omega;
    Harmonic sun_planet, ring_planet;
  };
  const Row rows[] = {
      {0.5, {2.78404509, -0.10179115, 1.05255299}, {2.66134422, -0.21608184, 1.60329271}},
      {1.0, {1.39202254, -2.70177587, 8.58513546}, {1.33067211, -8.75255687, 18.33913100}},
      {2.0, {0.69601127, -5.00189629, -18.08142261}, {0.66533606, -0.86502129, -11.59579120}},
  };
  const gear::Stage s = problems::r1();
  const Scales scales = scales_of(s);
  for (const Row& row : rows) {
    const ModelOptions options{GapDamping::always, Gyroscopic::off, 0.0};
    const Response r = response(make_dynamic_model(s, scales, row.omega, options), scales);
    EXPECT_NEAR(r.sun_planet.cosine, row.sun_planet.cosine, digits_um) << row.omega;
    EXPECT_NEAR(r.sun_planet.sine, row.sun_planet.sine, digits_um) << row.omega;
    EXPECT_NEAR(r.ring_planet.cosine, row.ring_planet.cosine, digits_um) << row.omega;
    EXPECT_NEAR(r.ring_planet.sine, row.ring_planet.sine, digits_um) << row.omega;
    const auto [sun_planet, ring_planet] = balanced_means(s, scales, row.omega);
    EXPECT_NEAR(sun_planet, row.sun_planet.mean, digits_um) << row.omega;
    EXPECT_NEAR(ring_planet, row.ring_planet.mean, digits_um) << row.omega;
    EXPECT_NEAR(r.sun_planet.mean, row.sun_planet.mean, unbalance * row.sun_planet.mean) << row.omega;
    EXPECT_NEAR(r.ring_planet.mean, row.ring_planet.mean, unbalance * row.ring_planet.mean) << row.omega;
  }
}

TEST(LinearResponse, DoesNotDependOnASweptScale) {
  // Scales are those of the stage as given: the same motion in um at the same mesh frequency.
  const gear::Stage s = problems::r1();
  const Scales scales = scales_of(s);
  Scales other = scales;
  other.omega_sn *= 1.25;
  const ModelOptions options{GapDamping::always, Gyroscopic::off, 0.0};
  const Response a = response(make_dynamic_model(s, scales, 1.25, options), scales);
  const Response b = response(make_dynamic_model(s, other, 1.0, options), other);
  // Rounding times the condition of the dynamic stiffness near resonance.
  constexpr double tolerance = 1e-10;
  EXPECT_NEAR(a.sun_planet.cosine, b.sun_planet.cosine, tolerance);
  EXPECT_NEAR(a.ring_planet.sine, b.ring_planet.sine, tolerance);
  EXPECT_NEAR(a.ring_planet.mean, b.ring_planet.mean, tolerance);
}

/// Growth of the fastest motion over one mesh period.
double growth(Gyroscopic terms, double omega) {
  const gear::Stage s = problems::r1();
  const DynamicModel m =
      make_dynamic_model(s, scales_of(s), omega, {GapDamping::always, terms, 0.0}, CoordinateChoice::full);
  const Eigen::VectorXcd eigenvalues = epicyclic::eigenvalues(matrix_of(m));
  return std::exp(2.0 * pi * eigenvalues.real().maxCoeff());
}

// Growth rates of docs/theory/model.md, section 3, have four decimals.
constexpr double growth_digits = 0.5e-4;

TEST(Gyroscopic, PrintedTermsMakeTheFreeTrainDiverge) {
  EXPECT_NEAR(growth(Gyroscopic::as_printed, 1.0), 1.0333, growth_digits);
}

TEST(Gyroscopic, TheObviousRepairIsNotExact) {
  EXPECT_NEAR(growth(Gyroscopic::carrier_row, 1.0), 1.0020, growth_digits);
  EXPECT_NEAR(growth(Gyroscopic::carrier_row, 3.0), 1.0059, growth_digits);
}

TEST(Gyroscopic, TheInvariantFormIsNeutralAsIsNone) {
  // A double eigenvalue 0 (place and speed of the rigid rotation) moves by the square root of rounding.
  constexpr double neutral = 1e-5;
  for (const double omega : {0.3, 1.0, 3.0}) {
    EXPECT_NEAR(growth(Gyroscopic::invariant, omega), 1.0, neutral) << omega;
    EXPECT_NEAR(growth(Gyroscopic::automatic, omega), 1.0, neutral) << omega;
    EXPECT_NEAR(growth(Gyroscopic::off, omega), 1.0, neutral) << omega;
  }
}

TEST(Gyroscopic, AutomaticIsPrintedForLiteralAndInvariantElsewhere) {
  const auto matrix = [](const gear::Stage& s, Gyroscopic terms) {
    return matrix_of(make_dynamic_model(s, scales_of(s), 1.3, {GapDamping::always, terms, 0.0}));
  };
  const gear::Stage as_printed = problems::as_printed(problems::r1());
  EXPECT_EQ(matrix(as_printed, Gyroscopic::automatic), matrix(as_printed, Gyroscopic::as_printed));
  EXPECT_NE(matrix(as_printed, Gyroscopic::automatic), matrix(as_printed, Gyroscopic::off));
  const gear::Stage fixed = problems::r1();
  EXPECT_EQ(matrix(fixed, Gyroscopic::automatic), matrix(fixed, Gyroscopic::invariant));
  EXPECT_NE(matrix(fixed, Gyroscopic::automatic), matrix(fixed, Gyroscopic::off));
  // A carrier at rest has no such terms.
  const gear::Stage star = problems::star(problems::r1());
  EXPECT_EQ(matrix(star, Gyroscopic::automatic), matrix(star, Gyroscopic::off));
}

TEST(Gyroscopic, PrintedTermsWithAFreeCarrierAreRefusedInRelativeCoordinates) {
  const gear::Stage s = problems::r1();
  for (const Gyroscopic terms : {Gyroscopic::as_printed, Gyroscopic::carrier_row}) {
    const ModelOptions options{GapDamping::always, terms, 0.0};
    EXPECT_THROW((void)make_dynamic_model(s, scales_of(s), 1.0, options), InputError);
    EXPECT_NO_THROW((void)make_dynamic_model(s, scales_of(s), 1.0, options, CoordinateChoice::full));
  }
}

TEST(Gyroscopic, RelativeCoordinatesHaveTheSpectrumOfTheFullOnesWithoutTheRigidRotation) {
  for (const gear::Stage& s : {problems::r1(), problems::as_printed(problems::r1()), problems::star(problems::r1())}) {
    const auto spectrum = [&](CoordinateChoice choice) {
      const Eigen::VectorXcd e =
          epicyclic::eigenvalues(matrix_of(make_dynamic_model(s, scales_of(s), 1.0, {}, choice)));
      return std::vector<std::complex<double>>(e.begin(), e.end());
    };
    const auto full = spectrum(CoordinateChoice::full);
    const auto relative = spectrum(CoordinateChoice::relative);
    ASSERT_EQ(full.size(), relative.size() + 2);
    // Rounding times the condition of eigenvalues that come in pairs.
    constexpr double tolerance = 1e-9;
    for (const auto& lambda : relative) {
      double nearest = 1e300;
      for (const auto& other : full) nearest = std::min(nearest, std::abs(lambda - other));
      EXPECT_LT(nearest, tolerance) << static_cast<int>(s.boundary);
    }
    // Only the full coordinates have the rigid rotation, the eigenvalue 0.
    constexpr double rigid = 1e-5;
    const auto near_zero = [&](const std::complex<double>& x) { return std::abs(x) < rigid; };
    EXPECT_EQ(std::count_if(full.begin(), full.end(), near_zero), 2);
    EXPECT_EQ(std::count_if(relative.begin(), relative.end(), near_zero), 0);
  }
}

}  // namespace
}  // namespace epicyclic::model::linear_response_test
