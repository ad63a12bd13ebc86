// What the tables of friction and stiffness move orbits by: against the same equations with both evaluated from their
// laws at every instant, by the teeth's own stiffness and load sharing.

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "analysis/periodic_orbit.hpp"
#include "core/largest_difference.hpp"
#include "gear/ehl_friction.hpp"
#include "gear/gear_set.hpp"
#include "input/study_model.hpp"
#include "integrate/make_flow.hpp"
#include "model/folded_constants.hpp"
#include "model/right_hand_side.hpp"

namespace epicyclic::reports::table_error_test {
namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;
using Parameters = model::Parameters<double, 3>;

/// One mesh by its laws, at its own phase, on the side of a jump where `inside` is.
struct MeshLaws {
  const gear::MeshedPair& pair;
  gear::EhlFriction ehl;
  gear::LineOfAction line;
  gear::MeshLoad load;

  /// A, B_1 / r_b1, B_2 / r_b2.
  [[nodiscard]] std::array<double, 3> friction(double phase, double inside) const {
    std::array<double, 3> sum{};
    for (int j = 0; inside + j < ehl.contact_ratio; ++j) {
      const double position = phase + j;
      const gear::LubricatedContact c =
          gear::lubricated_contact(ehl, line, load, position, pair.load_share(position, inside + j));
      const double f =
          std::copysign(gear::xu_friction_coefficient(c), -c.slide_to_roll) * pair.load_share(position, inside + j);
      const double arm = ehl.path_start_mm + line.base_pitch_mm * position;
      sum[0] += f;
      sum[1] += f * arm / line.base_radius_1_mm;
      sum[2] += f * line.arm_2(arm) / line.base_radius_2_mm;
    }
    return sum;
  }
};

/// The model's field with the tables' values replaced by those of the laws. Planets mesh in phase.
VectorField continuous(const model::DynamicModel& m, const gear::Stage& stage, const gear::GearSet& set,
                       const model::Scales& scales) {
  EXPECT_EQ(m.layout, model::Layout::relative_to_ring);
  const auto p = model::constants_of<3>(m, m.layout);
  const gear::MeshLoad load = gear::mean_mesh_load(stage, m.omega * scales.omega_sn);
  const auto sun = std::make_shared<MeshLaws>(
      MeshLaws{set.sun_planet, *stage.sun_planet_mesh.friction.ehl, gear::sun_planet_line(stage), load});
  const auto ring = std::make_shared<MeshLaws>(
      MeshLaws{set.ring_planet, *stage.ring_planet_mesh.friction.ehl, gear::ring_planet_line(stage), load});
  const bool curve = stage.sun_planet_mesh.stiffness_curve.has_value();
  VectorField field = m;
  field.tangents = nullptr;
  field.parameter_derivative = nullptr;
  field.right_hand_side = [=, breakpoints = m.breakpoints](std::size_t segment, double s, const double* y,
                                                           double* dyds) {
    const double from = breakpoints[segment];
    const double to = segment + 1 < breakpoints.size() ? breakpoints[segment + 1] : breakpoints[0] + two_pi;
    const double middle = 0.5 * (from + to);
    model::PhaseCoefficients<double, 3> now(*p, segment, s);
    const auto set_mesh = [&](const MeshLaws& laws, double turns, model::MeshCoefficients<double, 3>& mesh) {
      const double own = middle / two_pi + turns;
      const double inside = own - std::floor(own);
      // Stages of a step that ends on a breakpoint may lie on it by rounding: they are of this piece.
      const double phase = std::clamp(inside + std::remainder(s - middle, two_pi) / two_pi, 0.0, 1.0);
      const auto f = laws.friction(phase, inside);
      mesh.friction = f[0];
      mesh.moment_driving = f[1];
      mesh.moment_driven = f[2];
      if (curve) mesh.stiffness = scales.stiffness(laws.pair.stiffness(phase, inside));
    };
    set_mesh(*sun, p->sun_planet.phase_cycles[0], now.sun_planet);
    set_mesh(*ring, p->ring_planet.phase_cycles[0], now.ring_planet);
    model::right_hand_side(model::Layout::relative_to_ring, *p, now, y, dyds);
  };
  return field;
}

struct Displacement {
  int period = 0;
  double by_the_tables = 0;     ///< of the orbit, from that of the laws
  double by_halved_tables = 0;  ///< of the orbit, from that of tables half as fine
  double friction_error = 0;    ///< told by the model
};

/// Of the orbit that the motion from rest settles to.
Displacement displacement(const std::vector<std::string>& changes, double omega) {
  const input::LoadedInput input = input::load_input("inputs/tang2020_run.json", input::parse_assignments(changes));
  const gear::Stage& stage = input.study.stage;
  const gear::GearSet set = gear::make_gear_set(stage);
  const model::Scales scales = model::scales_of(stage);
  const model::DynamicModel m = input::model_at(input)(omega);
  integrate::IntegratorOptions tight;
  constexpr double tolerance = 1e-13;
  tight.relative_tolerance = tight.absolute_tolerance = tolerance;
  tight.max_steps_per_period = 1000000;
  std::vector<double> y = m.default_start;
  integrate::IntegratorOptions coarse;
  coarse.relative_tolerance = coarse.absolute_tolerance = 1e-8;
  const auto settling = integrate::make_flow(m, coarse);
  for (int k = 0; k < 150; ++k) EXPECT_TRUE(settling->evolve(y, 0.0, two_pi).reached());
  const auto flow = integrate::make_flow(m, tight);
  Displacement d;
  analysis::PeriodicOrbit orbit;
  for (const int n : {1, 2}) {
    orbit = analysis::find_periodic_orbit(*flow, y, n);
    if (!orbit.found()) continue;
    d.period = n;
    break;
  }
  EXPECT_GT(d.period, 0) << omega;
  if (d.period == 0) return d;
  d.friction_error = m.friction_table_error;
  constexpr int iterations = 3;
  const auto moved = [&](const VectorField& field) {
    const auto other = integrate::make_flow(field, tight);
    const std::vector<double> state = analysis::displaced_orbit(*other, orbit, d.period, iterations);
    return state.empty() ? std::nan("") : largest_difference(state, orbit.state);
  };
  d.by_the_tables = moved(continuous(m, stage, set, scales));
  d.by_halved_tables = moved(m.with_halved_tables());
  return d;
}

TEST(TableError, OrbitsAreThoseOfTheLawsToWhatIsTold) {
  constexpr double of_the_tables = 1e-9;  // the tables' tolerance; measured: nine tenths of it
  for (const double omega : {0.3, 0.42, 2.8}) {
    const Displacement d = displacement({}, omega);
    EXPECT_LT(d.by_the_tables, d.by_halved_tables) << omega;
    EXPECT_LT(d.by_the_tables, of_the_tables) << omega;
  }
}

TEST(TableError, OrbitsOnTheWholeStiffnessCurveToo) {
  constexpr double of_the_tables = 1e-8;  // ten tolerances of the tables
  for (const double omega : {0.3, 2.8}) {
    const Displacement d = displacement({"/stage/catalogue/mesh_stiffness/form=curve"}, omega);
    EXPECT_LT(d.by_the_tables, d.by_halved_tables) << omega;
    EXPECT_LT(d.by_the_tables, of_the_tables) << omega;
  }
}

}  // namespace
}  // namespace epicyclic::reports::table_error_test
