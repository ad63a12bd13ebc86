// Speeds in words, for summaries.
#pragma once

#include <numbers>
#include <string>

#include "core/text.hpp"
#include "gear/kinematics.hpp"

namespace epicyclic::reports {

/// "sun 6000 rpm, carrier 1500 rpm, mesh frequency 2025 Hz".
/// @param mesh_frequency  omega_m [rad/s]
[[nodiscard]] inline std::string speed_words(const gear::Speeds& speeds, double mesh_frequency) {
  constexpr int digits = 6;
  return "sun " + short_text(gear::rpm * speeds.sun, digits) + " rpm, carrier " +
         short_text(gear::rpm * speeds.carrier, digits) + " rpm, mesh frequency " +
         short_text(mesh_frequency / (2.0 * std::numbers::pi), digits) + " Hz";
}

}  // namespace epicyclic::reports
