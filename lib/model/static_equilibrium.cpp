#include "model/static_equilibrium.hpp"

#include <algorithm>
#include <cmath>

#include "core/dense.hpp"
#include "model/dynamic_model.hpp"
#include "model/kernels/stage_kernel.hpp"
#include "model/tangents.hpp"

namespace epicyclic::model {

namespace {

/// Accelerations at rest and their derivatives with respect to the displacements.
class AtRest {
 public:
  template <std::size_t N>
  AtRest(Layout layout, const Parameters<double, N>& p)
      : n_(degrees_of_freedom(layout, N)),
        tangents_(make_tangents(layout, p)),
        breakpoints_(p.breakpoints),
        unit_(2 * n_ * n_, 0.0),
        pushed_(2 * n_ * n_),
        slope_(2 * n_),
        stiffness_(n_, n_),
        acceleration_(n_) {
    for (std::size_t k = 0; k < n_; ++k) unit_[k * 2 * n_ + k] = 1.0;
  }

  [[nodiscard]] std::size_t size() const { return n_; }

  /// @param state  its velocities are 0
  void evaluate(double s, const std::vector<double>& state) {
    const std::size_t stride = 2 * n_;
    tangents_(segment_at(breakpoints_, s), s, state.data(), {unit_.data(), n_, stride}, slope_.data(),
              {pushed_.data(), n_, stride});
    for (std::size_t r = 0; r < n_; ++r) {
      acceleration_(static_cast<Eigen::Index>(r)) = slope_[n_ + r];
      for (std::size_t c = 0; c < n_; ++c)
        stiffness_(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(c)) = pushed_[c * stride + n_ + r];
    }
  }
  [[nodiscard]] const Eigen::VectorXd& acceleration() const { return acceleration_; }
  [[nodiscard]] const Eigen::MatrixXd& stiffness() const { return stiffness_; }

 private:
  std::size_t n_;
  TangentFunction tangents_;
  std::vector<double> breakpoints_;
  std::vector<double> unit_, pushed_, slope_;
  Eigen::MatrixXd stiffness_;
  Eigen::VectorXd acceleration_;
};

/// Newton's method from a state, which becomes the equilibrium.
/// @param load  accelerations that the load alone makes
/// @returns false where none was found; the state is then the last one
bool converge(AtRest& stage, double s, double load, std::vector<double>& state) {
  constexpr int most_steps = 60;
  constexpr int most_halvings = 12;
  // Part of the load. Radii are given in digits, and a train whose torques do not balance by as much accelerates: a
  // planet that no flank touches has no equilibrium then.
  constexpr double small = 1e-7;
  constexpr double rounding = 1e-14;  // part of the terms that add up to the accelerations
  constexpr double enough = 0.9;      // part of the accelerations that a whole step may leave
  const auto n = static_cast<Eigen::Index>(stage.size());
  stage.evaluate(s, state);
  for (int step = 0; step < most_steps; ++step) {
    const Eigen::VectorXd acceleration = stage.acceleration();
    const Eigen::Map<const Eigen::VectorXd> from(state.data(), n);
    const double terms = (stage.stiffness().cwiseAbs() * from.cwiseAbs()).norm();
    const double size = acceleration.norm();
    if (size <= small * load + rounding * terms) return true;
    Eigen::VectorXd direction = -solution(stage.stiffness(), acceleration);
    // The stiffness of a stage that floats is singular.
    if (!((stage.stiffness() * direction + acceleration).norm() <= enough * size))
      direction = -least_norm_solution(stage.stiffness(), acceleration);
    const Eigen::VectorXd begin = from;
    double part = 1.0;
    bool falls = false;
    for (int k = 0; k < most_halvings && !falls; ++k, part /= 2.0) {
      Eigen::Map<Eigen::VectorXd>(state.data(), n) = begin + part * direction;
      stage.evaluate(s, state);
      falls = stage.acceleration().norm() <= (1.0 - (1.0 - enough) * part) * size;
    }
    if (!falls) return false;
  }
  return false;
}

}  // namespace

template <std::size_t N>
std::vector<double> linear_equilibrium(Layout layout, Parameters<double, N> p) {
  const std::size_t n = degrees_of_freedom(layout, N);
  // delta = b + F/k on the drive flank is the stage without gaps whose errors are larger by b.
  const auto linear = [](MeshParameters<double, N>& mesh) {
    if (mesh.error_curve)
      for (std::size_t i = 0; i < N; ++i) {
        const double phase = mesh.phase_cycles[i];
        mesh.error_cos[i] += mesh.error_curve->at(mesh.error_curve->place(phase), phase)[0];
      }
    mesh.error_curve = nullptr;
    for (const Row<double, N>& harmonic : mesh.further_error_cos) mesh.error_cos += harmonic;
    mesh.further_error_cos.clear();
    mesh.further_error_sin.clear();
    mesh.harmonics = 0;
    mesh.stiffness_curve = nullptr;
    mesh.friction = nullptr;
    for (double& e : mesh.error_cos) e += mesh.half_gap;
    mesh.error_sin.fill(0.0);
    for (auto& shaft : mesh.shafts)
      for (auto& harmonic : shaft.sine) harmonic.fill(0.0);
    mesh.half_gap = 0.0;
  };
  linear(p.sun_planet);
  linear(p.ring_planet);
  p.torque_harmonics = 0;
  p.smooth = false;
  p.sun_law = gear::BearingLaw::linear_xy;
  p.sun_half_gap = 0.0;
  p.planet_gap = false;
  p.carrier_speed = 0.0;
  std::vector<double> state(2 * n);
  std::vector<double> slope(2 * n);
  const StageKernel<N> right_hand_side = stage_kernel<N>(layout);
  right_hand_side(layout, p, 0, 0.0, state.data(), slope.data());
  Eigen::VectorXd load(n);
  for (std::size_t r = 0; r < n; ++r) load(static_cast<Eigen::Index>(r)) = -slope[n + r];

  p.drive = p.ring_drive = p.carrier_load = p.output_load = 0.0;
  p.centrifugal.fill(0.0);
  p.sun_planet.error_cos.fill(0.0);
  p.ring_planet.error_cos.fill(0.0);
  p.sun_planet.error_mean.fill(0.0);
  p.ring_planet.error_mean.fill(0.0);
  p.sun_planet.shafts.clear();
  p.ring_planet.shafts.clear();
  Eigen::MatrixXd stiffness(n, n);
  for (std::size_t c = 0; c < n; ++c) {
    state[c] = 1.0;
    right_hand_side(layout, p, 0, 0.0, state.data(), slope.data());
    state[c] = 0.0;
    for (std::size_t r = 0; r < n; ++r)
      stiffness(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(c)) = slope[n + r];
  }
  // Least norm where the stage floats (a sun without support, the rigid rotation in full coordinates).
  const Eigen::VectorXd q = least_norm_solution(stiffness, load);
  std::vector<double> start(2 * n, 0.0);
  std::copy(q.begin(), q.end(), start.begin());
  return start;
}

template <std::size_t N>
std::vector<std::vector<double>> quasi_static_states(Layout layout, Parameters<double, N> p, std::vector<double> start,
                                                     std::span<const double> phases) {
  p.carrier_speed = 0.0;
  p.centrifugal.fill(0.0);
  p.sun_planet.damping = p.ring_planet.damping = 0.0;  // or e' would load the meshes
  AtRest stage(layout, p);
  std::vector<AtRest> smoothed;
  const auto converge_through_smooth_gaps = [&](double s, double load, std::vector<double>& state) {
    if (smoothed.empty())
      for (const double width : {1.0, 0.3, 0.1, 0.03, 1e-2, 3e-3, 1e-3, 1e-4, 1e-5}) {
        if (width <= p.smoothing) break;
        Parameters<double, N> wide = p;
        wide.smooth = true;
        wide.smoothing = width;
        smoothed.emplace_back(layout, wide);
      }
    return std::ranges::all_of(smoothed, [&](AtRest& wide) { return converge(wide, s, load, state); }) &&
           converge(stage, s, load, state);
  };
  std::vector<std::vector<double>> all;
  std::vector<double> state = start;
  double load = 0.0;
  for (const double s : phases) {
    if (all.empty()) {
      stage.evaluate(s, std::vector<double>(start.size(), 0.0));
      load = stage.acceleration().norm();
    }
    if (!converge(stage, s, load, state)) {
      state = start;
      if (!converge_through_smooth_gaps(s, load, state)) return {};
    }
    all.push_back(state);
  }
  return all;
}

#define EPICYCLIC_INSTANTIATE(N)                                                                                    \
  template std::vector<double> linear_equilibrium(Layout, Parameters<double, N>);                                   \
  template std::vector<std::vector<double>> quasi_static_states(Layout, Parameters<double, N>, std::vector<double>, \
                                                                std::span<const double>);
EPICYCLIC_FOR_PLANETS(EPICYCLIC_INSTANTIATE)
#undef EPICYCLIC_INSTANTIATE

}  // namespace epicyclic::model
