// Speeds in words, for summaries.
#pragma once

#include <numbers>
#include <string>

#include "core/text.hpp"
#include "gear/kinematics.hpp"
#include "model/scales.hpp"

namespace epicyclic::reports {

/// "sun 6000 rpm"; the carrier's speed if the sun is held.
[[nodiscard]] inline std::string sun_speed_words(const gear::Speeds& speeds, int digits) {
  if (speeds.sun == 0.0 && speeds.carrier != 0.0)
    return "carrier " + short_text(gear::rpm * speeds.carrier, digits) + " rpm";
  return "sun " + short_text(gear::rpm * speeds.sun, digits) + " rpm";
}

/// "sun 6000 rpm, carrier 1500 rpm, mesh frequency 2025 Hz"; without a carrier that stands still, or is not there.
/// @param mesh_frequency  omega_m [rad/s]
[[nodiscard]] inline std::string speed_words(const gear::Speeds& speeds, double mesh_frequency) {
  constexpr int digits = 6;
  const std::string carrier = speeds.carrier == 0.0 || speeds.sun == 0.0
                                  ? std::string()
                                  : ", carrier " + short_text(gear::rpm * speeds.carrier, digits) + " rpm";
  return sun_speed_words(speeds, digits) + carrier + ", mesh frequency " +
         short_text(mesh_frequency / (2.0 * std::numbers::pi), digits) + " Hz";
}

/// The sun's speed of a stage at a mesh frequency.
/// @param mesh_frequency  omega_m [rad/s]
[[nodiscard]] inline std::string sun_speed_words(const gear::Stage& stage, double mesh_frequency, int digits) {
  return sun_speed_words(gear::speeds(stage, mesh_frequency), digits);
}

/// At a mesh frequency ratio of a stage that moves.
[[nodiscard]] inline std::string speed_words(const gear::Stage& stage, double mesh_frequency_ratio) {
  const double mesh_frequency = mesh_frequency_ratio * model::scales_of(stage).omega_sn;
  return speed_words(gear::speeds(stage, mesh_frequency), mesh_frequency);
}

}  // namespace epicyclic::reports
