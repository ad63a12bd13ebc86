// Tangents and parameter derivatives of the gear train itself.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/errors.hpp"
#include "core/largest_difference.hpp"
#include "integrate/make_flow.hpp"
#include "integrate/methods.hpp"
#include "problems/gear_flow.hpp"
#include "problems/r1.hpp"
#include "studies/named_parameters.hpp"

namespace epicyclic::studies::gear_tangents_test {
namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;

/// R1 with gaps, at a speed where teeth separate.
model::OperatingPoint point(double w = 0.0) {
  model::OperatingPoint p;
  p.stage = problems::r1_nonlinear();
  p.mesh_frequency_ratio = 1.1;
  p.options.clearance_smoothing = w;
  return p;
}

model::DynamicModel model_of(const model::OperatingPoint& p) {
  return model::make_dynamic_model(p.stage, model::scales_of(point().stage), p.mesh_frequency_ratio, p.options);
}

std::vector<double> some_tangents(std::size_t n, std::size_t m) {
  std::vector<double> v(n * m);
  for (std::size_t i = 0; i < v.size(); ++i) v[i] = std::sin(1.0 + 0.7 * static_cast<double>(i));
  return v;
}

TEST(GearTangents, UncontrolledTheyLeaveTheStateToTheLastBit) {
  for (const auto& method : integrate::methods()) {
    if (method.order <= 2) continue;  // as the others, in ten thousand steps
    const model::DynamicModel model = model_of(point());
    integrate::IntegratorOptions o;
    o.method = method.name;
    o.relative_tolerance = 1e-6;
    o.max_steps_per_period = 1000000;
    const auto plain = integrate::make_flow(model, o);
    const auto tangent = integrate::make_flow(model, o);
    std::vector<double> y = model.default_start;
    std::vector<double> z = y;
    std::vector<double> v = some_tangents(model.dimension, 3);
    ASSERT_TRUE(plain->evolve(y, 0.0, two_pi).reached()) << method.name;
    ASSERT_TRUE(tangent->evolve_tangents(z, v, 0.0, two_pi).reached()) << method.name;
    if (method.family == integrate::Family::lanes) {  // but for the steps over kinks
      constexpr double rest = 1e-4;                   // errors of some hundred steps at the tolerance
      EXPECT_LT(largest_difference(y, z), rest) << method.name;
    } else {
      EXPECT_EQ(y, z) << method.name;
    }
  }
}

TEST(GearTangents, AreDifferencesOfNeighbouringMotions) {
  for (const double w : {0.0, 0.05}) {
    const model::DynamicModel model = model_of(point(w));
    integrate::IntegratorOptions o = problems::tight(1e-12);
    o.tangent_error_control = true;
    const auto flow = integrate::make_flow(model, o);
    std::vector<double> y = model.default_start;
    for (int k = 0; k < 3; ++k) ASSERT_TRUE(flow->evolve(y, 0.0, two_pi).reached());
    const std::size_t n = model.dimension;
    std::vector<double> v = some_tangents(n, 2);
    const std::vector<double> direction(v.begin(), v.begin() + static_cast<std::ptrdiff_t>(n));
    std::vector<double> base = y;
    ASSERT_TRUE(flow->evolve_tangents(base, v, 0.0, two_pi).reached());
    constexpr double h = 1e-6;
    std::vector<double> up = y;
    std::vector<double> down = y;
    for (std::size_t i = 0; i < n; ++i) {
      up[i] += h * direction[i];
      down[i] -= h * direction[i];
    }
    ASSERT_TRUE(flow->evolve(up, 0.0, two_pi).reached());
    ASSERT_TRUE(flow->evolve(down, 0.0, two_pi).reached());
    double size = 0.0;
    for (std::size_t i = 0; i < n; ++i) size = std::max(size, std::abs(v[i]));
    // Differences: h times the curvature (kinks: of order 1 per crossing), integrator tolerance over h.
    constexpr double accuracy = 2e-5;
    for (std::size_t i = 0; i < n; ++i)
      EXPECT_NEAR(v[i], (up[i] - down[i]) / (2.0 * h), accuracy * size) << model.state_names[i] << " w " << w;
  }
}

TEST(GearTangents, TheParameterDerivativeIsThatOfEachNamedParameter) {
  struct Row {
    const char* name;
    double value;
  };
  for (const Row& row : {Row{"mesh_frequency_ratio", 1.1}, Row{"damping_ratio", 0.05}, Row{"sun_planet_backlash", 3.0},
                         Row{"ring_planet_backlash", 3.0}, Row{"sun_bearing_clearance", 0.5}}) {
    const auto at = [&](double value) {
      model::OperatingPoint p = point();
      find_parameter(row.name)->set(p, value);
      return p;
    };
    const model::Scales scales = model::scales_of(point().stage);
    model::DynamicModel model = model_of(at(row.value));
    model::set_parameter_derivative(model, at, scales, row.value, 1e-3 * row.value);
    integrate::IntegratorOptions o = problems::tight(1e-12);
    o.tangent_error_control = true;
    const auto flow = integrate::make_flow(model, o);
    const std::vector<double> start = model.default_start;
    std::vector<double> y = start;
    std::vector<double> v(model.dimension, 0.0);
    for (int k = 0; k < 2; ++k)
      ASSERT_TRUE(flow->evolve_tangents(y, v, 0.0, two_pi, integrate::LastTangent::parameter).reached());
    // Kinks leave some 1e-10 of the state between neighbouring values: over a smaller h that is more than the kinks do
    // over this one.
    const double h = 1e-4 * row.value;
    const auto end = [&](double value) {
      const model::DynamicModel m = model_of(at(value));
      const auto f = integrate::make_flow(m, problems::tight(1e-13));
      std::vector<double> z = start;
      for (int k = 0; k < 2; ++k) EXPECT_TRUE(f->evolve(z, 0.0, two_pi).reached());
      return z;
    };
    const std::vector<double> up = end(row.value + h);
    const std::vector<double> down = end(row.value - h);
    double size = 1e-3;
    for (const double x : v) size = std::max(size, std::abs(x));
    // Integrator tolerance over h, and h times the kinks.
    constexpr double accuracy = 1e-4;
    for (std::size_t i = 0; i < model.dimension; ++i)
      EXPECT_NEAR(v[i], (up[i] - down[i]) / (2.0 * h), accuracy * size) << row.name << ' ' << model.state_names[i];
  }
}

TEST(GearTangents, FullCoordinatesHaveTheParameterDerivativeToo) {
  const model::Scales scales = model::scales_of(point().stage);
  const auto at = [&](double omega) {
    model::OperatingPoint p = point();
    p.mesh_frequency_ratio = omega;
    return p;
  };
  const auto full_at = [&](double omega) {
    const model::OperatingPoint p = at(omega);
    return model::make_dynamic_model(p.stage, scales, p.mesh_frequency_ratio, p.options, model::CoordinateChoice::full);
  };
  constexpr double omega = 1.1;
  constexpr double step = 1e-3;
  model::DynamicModel full = full_at(omega);
  model::set_parameter_derivative(full, at, scales, omega, step);
  std::vector<double> y = full.default_start;
  for (std::size_t i = 0; i < y.size(); ++i) y[i] += 0.3 * std::sin(1.0 + static_cast<double>(i));
  const auto slope = [&](double value) {
    std::vector<double> d(full.dimension);
    full_at(value).right_hand_side(0, 0.7, y.data(), d.data());
    return d;
  };
  const std::vector<double> up = slope(omega + step);
  const std::vector<double> down = slope(omega - step);
  std::vector<double> derivative(full.dimension);
  full.parameter_derivative(0, 0.7, y.data(), derivative.data());
  double size = 0.0;
  for (const double d : derivative) size = std::max(size, std::abs(d));
  EXPECT_GT(size, 0.0);
  constexpr double of_second_order = 1e-5;  // of a central difference over 1e-3
  for (std::size_t i = 0; i < full.dimension; ++i)
    EXPECT_NEAR(derivative[i], (up[i] - down[i]) / (2.0 * step), of_second_order * size) << full.state_names[i];
}

TEST(GearTangents, AParameterThatChangesTheStateHasNoDerivative) {
  model::DynamicModel model = model_of(point());
  const auto at = [&](double planets) {
    model::OperatingPoint p = point();
    p.stage.planet_count = static_cast<int>(planets);
    return p;
  };
  EXPECT_THROW(model::set_parameter_derivative(model, at, model::scales_of(point().stage), model.planets, 1.0),
               InputError);
}

TEST(GearTangents, AParameterThatMovesBreakpointsHasNoDerivative) {
  model::OperatingPoint p = point();
  p.stage.sun_planet_mesh.friction.coefficient = {0.05, 1.4, {}};
  model::DynamicModel model = model_of(p);
  const auto at = [&](double contact_ratio) {
    model::OperatingPoint q = p;
    q.stage.sun_planet_mesh.friction.coefficient->contact_ratio = contact_ratio;
    return q;
  };
  EXPECT_THROW(model::set_parameter_derivative(model, at, model::scales_of(p.stage), 1.4, 1e-3), InputError);
}

}  // namespace
}  // namespace epicyclic::studies::gear_tangents_test
