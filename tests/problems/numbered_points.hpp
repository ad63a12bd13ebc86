// Results of points that no motion has: each number in them is another one.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "studies/sweep.hpp"

namespace epicyclic::test {

/// Points with a number of its own in each place: what is written of one column cannot pass for another.
inline std::vector<studies::PointResult> numbered_points(std::size_t planets) {
  double next = 0.5;
  const auto number = [&next] { return next += 1.0; };
  const auto course = [&number](studies::Course& c) {
    c.least = -number();
    c.largest = number();
    c.mean = number();
    c.rms = number();
  };
  const auto fill = [&](std::vector<studies::MeshRecord>& meshes) {
    for (studies::MeshRecord& m : meshes) {
      course(m.delta);
      course(m.force);
      m.drive = number();
      m.back = number();
      m.tension = number();
      m.tension_time = number();
      course(m.quasi_static);
      m.quasi_static.largest *= 3.0;
    }
  };
  const auto fill_stage = [&](studies::StageRecord& stage) {
    stage.sun_planet.resize(planets);
    stage.ring_planet.resize(planets);
    stage.planet_bearing.resize(planets);
    fill(stage.sun_planet);
    fill(stage.ring_planet);
    for (studies::Course& bearing : stage.planet_bearing) course(bearing);
    course(stage.sun_bearing);
    course(stage.transmission_error);
    for (auto* harmonics :
         {&stage.sun_planet_harmonics, &stage.ring_planet_harmonics, &stage.transmission_error_harmonics})
      for (double& x : *harmonics) x = number();
    stage.planet_spread = number();
    stage.force_error = number();
    stage.static_force = number();
    stage.mesh_frequency = number();
    stage.speeds = {number(), number()};
  };
  std::vector<studies::PointResult> all(3);
  for (std::size_t i = 0; i < all.size(); ++i) {
    studies::PointResult& r = all[i];
    r.point.index = i;
    r.point.value = number();
    fill_stage(r.meshes);
    r.period = static_cast<int>(number());
    r.rhs_evaluations = static_cast<long>(number());
    r.recurrence.error = number();
    r.recurrence.late_error = number();
    r.omega = number();
    r.classified = true;
    r.regime = i == 0 ? analysis::Regime::periodic : analysis::Regime::chaotic;
    analysis::Evidence& e = r.evidence;
    e.periods = static_cast<int>(number());
    e.residual = number();
    e.orbit_error = number();
    e.largest_multiplier = number();
    e.multiplier_error = number();
    e.exponent = {number(), number()};
    e.note = "note " + std::to_string(i);
    if (i > 0) e.zero_one = number();
  }
  all[2].outcome = integrate::Outcome::diverged;
  all[2].message = "message";
  return all;
}

}  // namespace epicyclic::test
