// Looks at many instants side by side: what forces and deflections say of each, the same bits from each
// instruction set.

#include "model/stage_outputs.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "model/dynamic_model.hpp"
#include "model/kernels/lane_kernel.hpp"
#include "problems/r1.hpp"

namespace epicyclic::model::stage_look_test {
namespace {

constexpr double rounding = 1e-13;  // of some ten operations on lanes' own sine and places in tables

std::vector<double> even_phases(std::size_t count) {
  std::vector<double> s;
  for (std::size_t j = 1; j <= count; ++j)
    s.push_back(2.0 * std::numbers::pi * static_cast<double>(j) / static_cast<double>(count));
  return s;
}

std::vector<gear::Stage> stages() {
  const gear::Stage base = problems::with_friction(problems::with_moving_stiffness(problems::with_gap(problems::r1())));
  gear::Stage radial = problems::as_printed(base);
  radial.sun_bearing.law = gear::BearingLaw::linear_radial;
  radial.sun_bearing.clearance_half_um = 3.0;
  const gear::Stage curve = problems::with_stiffness_curve(problems::star(base));
  return {base,
          problems::rigid_ring(base),
          radial,
          curve,
          problems::with_teeth(base, 28, 26, 80, 3),
          problems::with_error_curve(problems::with_teeth(base, 28, 26, 80, 3)),
          problems::with_error_curve(curve)};
}

TEST(StageOutputsAt, AreTheForcesAndDeflectionsOfEachInstant) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> component(-6.0, 6.0);  // on all three sides of the gaps
  for (const std::size_t count : {64U, 20U, 3U})
    for (const gear::Stage& stage : stages())
      for (const CoordinateChoice choice : {CoordinateChoice::relative, CoordinateChoice::full})
        for (const GapDamping damping : {GapDamping::always, GapDamping::contact_slope}) {
          ModelOptions options{damping, Gyroscopic::automatic, 0.05};
          const DynamicModel m = make_dynamic_model(stage, scales_of(stage), 0.9, options, choice);
          const std::vector<double> phases = even_phases(count);
          const StageOutputs evaluate_outputs = m.outputs_at(phases);
          const OutputRows at{3};
          alignas(64) std::array<double, 2 * 18 * phases_together> states{};
          alignas(64) std::array<double, OutputRows{3}.count() * phases_together> rows{};
          ASSERT_LE(m.dimension, 36U);
          for (double& x : states) x = component(random);
          for (std::size_t k = 0; k < count; ++k) {
            const std::size_t lane = k % phases_together;
            if (lane == 0) evaluate_outputs(k / phases_together, states.data(), rows.data());
            std::vector<double> y;
            for (std::size_t i = 0; i < m.dimension; ++i) y.push_back(states[i * phases_together + lane]);
            StageForces f;
            MeshDeflections d;
            m.forces(phases[k], y.data(), f);
            m.deflections(phases[k], y.data(), d);
            const auto expect = [&](std::size_t row, double x) {
              EXPECT_NEAR(rows[row * phases_together + lane], x, rounding * (1.0 + std::abs(x)))
                  << row << " at " << k << " of " << count;
            };
            for (std::size_t i = 0; i < 3; ++i) {
              expect(at.sun_planet(i).delta(), d.sun_planet[i]);
              expect(at.sun_planet(i).force(), f.sun_planet[i]);
              expect(at.sun_planet(i).elastic(), f.sun_planet_elastic[i]);
              expect(at.ring_planet(i).delta(), d.ring_planet[i]);
              expect(at.ring_planet(i).force(), f.ring_planet[i]);
              expect(at.ring_planet(i).elastic(), f.ring_planet_elastic[i]);
              expect(at.planet_bearing(i), f.planet_bearing[i]);
            }
            expect(at.sun_bearing(), f.sun_bearing);
          }
        }
}

TEST(StageOutputsAt, TransmissionErrorIsThatOfTheTurnsAlone) {
  // Both deflections along a planet, plus its errors, are the transmission error once nothing is displaced but by
  // turns; a train that turns as one has none.
  gear::Stage stage = problems::r1();
  for (gear::Mesh* mesh : {&stage.sun_planet_mesh, &stage.ring_planet_mesh}) mesh->error_amplitude_um = {0.0};
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> component(-6.0, 6.0);
  for (const gear::Stage& s : {stage, problems::as_printed(stage), problems::rigid_ring(stage)})
    for (const CoordinateChoice choice : {CoordinateChoice::relative, CoordinateChoice::full}) {
      const DynamicModel m = make_dynamic_model(s, scales_of(s), 0.9, {}, choice);
      const std::array phase = {1.0};
      const StageOutputs evaluate_outputs = m.outputs_at(phase);
      alignas(64) std::array<double, 36 * phases_together> states{};
      alignas(64) std::array<double, OutputRows{3}.count() * phases_together> rows{};
      const auto set = [&](std::size_t slot, double x) { states[slot * phases_together] = x; };
      set(Slots::w_s, 3.0);
      for (std::size_t i = 0; i < 3; ++i) set(Slots::w_p(i), component(random));
      if (has_ring_rotation(m.layout)) set(Slots::u_r(3), -1.0);
      evaluate_outputs(0, states.data(), rows.data());
      const OutputRows at{3};
      const double error = rows[at.transmission_error() * phases_together];
      EXPECT_NEAR(error, has_ring_rotation(m.layout) ? 2.0 : 3.0, rounding * 20.0);
      for (std::size_t i = 0; i < 3; ++i)
        EXPECT_NEAR(
            rows[at.sun_planet(i).delta() * phases_together] + rows[at.ring_planet(i).delta() * phases_together], error,
            rounding * 20.0);
      if (choice != CoordinateChoice::full) continue;
      // Radii: the ring's turn and the carrier's that go with the sun's, in the directions of [M-13] to [M-15].
      const double alpha_sp = std::acos((32.17853 + 29.79493) / 71.72084);
      const double alpha_rp = std::acos((96.53557 - 29.79493) / 71.72084);
      states.fill(0.0);
      const double u_c = 2.5;
      set(Slots::u_c(Layout::full, 3), u_c);
      set(Slots::w_s, u_c * (std::cos(alpha_sp) + std::cos(alpha_rp)) - 0.75);
      set(Slots::u_r(3), 0.75);
      evaluate_outputs(0, states.data(), rows.data());
      EXPECT_NEAR(rows[at.transmission_error() * phases_together], 0.0, rounding * 20.0);
    }
}

template <std::size_t N, std::size_t W>
std::vector<double> looked_at(const char* name) {
  gear::Stage stage = problems::with_friction(problems::with_moving_stiffness(problems::with_gap(problems::r1())));
  stage.planet_count = static_cast<int>(N);
  const auto p = std::make_shared<const Parameters<double, N>>(make_parameters<N>(stage, scales_of(stage), 0.9, {}));
  const OutputKernel<N, W> kernel = output_kernel<N, W>(name);
  if (kernel.evaluate_outputs == nullptr) return {};
  LaneParameters<N, W> lanes(p);
  const Layout layout = Layout::relative_to_carrier;
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> component(-6.0, 6.0);
  alignas(64) std::array<double, 2 * degrees_of_freedom(Layout::full, N) * phases_together> states{};
  alignas(64) std::array<double, OutputRows{N}.count() * phases_together> rows{};
  for (double& x : states) x = component(random);
  for (std::size_t first = 0; first < phases_together; first += W) {
    alignas(64) std::array<double, W> s{};
    for (std::size_t lane = 0; lane < W; ++lane) {
      s[lane] = 0.7 * static_cast<double>(first + lane + 1);
      lanes.set_segment(lane, segment_at(p->breakpoints, s[lane]));
    }
    std::vector<PhaseCoefficients<Lanes<W>, N>> phase_coefficients(1);
    kernel.prepare(lanes, 1, s.data(), phase_coefficients.data());
    kernel.evaluate_outputs(layout, lanes, phase_coefficients[0], states.data() + first, rows.data() + first);
  }
  return {rows.begin(), rows.end()};
}

template <std::size_t N>
void expect_same_bits() {
  const std::vector<double> expected = looked_at<N, 2>("baseline");
  ASSERT_FALSE(expected.empty());
  for (const std::vector<double>& wide : {looked_at<N, 4>("avx2"), looked_at<N, 8>("avx512")}) {
    if (wide.empty()) continue;
    EXPECT_EQ(wide, expected) << N;
  }
}

TEST(StageOutputsAt, BitsDoNotDependOnTheInstructionSet) {
  expect_same_bits<2>();
  expect_same_bits<3>();
  expect_same_bits<6>();
}

}  // namespace
}  // namespace epicyclic::model::stage_look_test
