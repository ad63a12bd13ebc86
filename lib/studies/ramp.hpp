// Run-up and run-down: the speed changes at a constant rate, and orders of the response are tracked.
//
//   Omega(tau) = Omega_0 +- a tau ,  s = int Omega d tau                                                  [M-ramp]
//   A_k of windows of W mesh periods, sampled evenly in the mesh phase, Hann window: order k / W          [S-order]
//
// The phase, and not the time, is sampled evenly, so that orders of the mesh frequency stay on their bins while the
// speed changes (order tracking). Within a window the speed changes by 2 pi W a / Omega; amplitudes are those of a
// response that changes little over a window. Ramps consist of whole windows: they end at the last one that does not
// pass the end of the range. Each ramp starts from the last state of the one before. Regimes are not claimed: no part
// of a response at a changing speed repeats.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "gear/stage.hpp"
#include "integrate/flow.hpp"
#include "integrate/options.hpp"
#include "model/options.hpp"
#include "model/scales.hpp"
#include "studies/ramp_options.hpp"

namespace epicyclic::studies {

/// Speeds of a ramp without dimension.
struct RampCourse {
  double from = 0, to = 0;  ///< Omega, from < to
  double rate = 0;          ///< d Omega / d tau > 0
  int windows = 0;          ///< of each direction
  int window_periods = 1;
};

/// @throws DomainError when the speeds do not rise or a number is missing
[[nodiscard]] RampCourse ramp_course(const RampOptions& options, const gear::Stage& stage, const model::Scales& scales);

/// The numbers of one window.
struct RampWindow {
  Direction direction = Direction::up;
  int number = 0;         ///< along its direction, from 0
  double tau = 0;         ///< in the middle of the phase, from the beginning of the first ramp
  double omega = 0;       ///< Omega there
  double torque_Nm = 0;   ///< on the sun, there
  double delta_mean = 0;  ///< of delta_sp_1 [b_c]
  double delta_rms = 0;   ///< about the mean
  double delta_min = 0, delta_max = 0;
  double force_max = 0;        ///< largest force of any sun mesh [N]
  double ring_force_max = 0;   ///< of any ring mesh; 0 of a pair [N]
  double bearing_max = 0;      ///< largest force of any planet's bearing [N]
  double loss_time = 0;        ///< part of the samples with a mesh out of contact, the mesh with most of them [-]
  std::vector<double> orders;  ///< amplitude of delta_sp_1 at k / W, k = 0 to orders W; 0 of the mean [b_c]
};

/// Length of RampWindow as numbers.
[[nodiscard]] std::size_t numbers_of_window(const RampOptions& options);

struct RampResult {
  RampCourse course;
  std::vector<RampWindow> windows;
  integrate::Outcome outcome = integrate::Outcome::reached;  ///< of the last window that was begun
  std::string message;
  double inertia_torque_Nm = 0;  ///< inertia_torque_Nm(), left out of the equations
};

/// What a run of it remembers and shows.
struct RampControl {
  std::function<bool()> go_on;               ///< null: always
  std::function<void(std::size_t done)> at;  ///< windows that are done
  /// Numbers of the next window and the state behind it, of an earlier session; nothing if there is none.
  std::function<std::optional<std::vector<double>>(std::size_t numbers)> recall;
  std::function<void(std::span<const double>)> keep;  ///< of a new window
};

/// @param start  empty: the default start
/// @returns nothing if ended
[[nodiscard]] std::optional<RampResult> run_ramp(const gear::Stage& stage, const model::Scales& scales,
                                                 const model::ModelOptions& model, const RampOptions& options,
                                                 const std::vector<double>& start,
                                                 const integrate::IntegratorOptions& integrator,
                                                 const RampControl& control = {});

/// Torque that accelerates the whole train as a rigid one, about the sun, or about the carrier if the sun is held, by
/// Lagrange's equation for its kinetic energy [N m].
/// @param rate  d omega_m / dt [rad/s^2]
[[nodiscard]] double inertia_torque_Nm(const gear::Stage& stage, double rate);

}  // namespace epicyclic::studies
