// Speeds in rpm and Hz, in place of the mesh frequency ratio: of the operating point and along an axis.
//
//   n_s, n_c = 30 / pi omega_s, omega_c [rpm] ,   f_m = omega_m / (2 pi) [Hz] ,   omega_m = Omega omega_sn     [G-kin],
//   [M-23]
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "gear/stage.hpp"

namespace epicyclic::input {

/// An operating point's speed as it is given; none of it: Omega.
struct GivenSpeed {
  std::optional<double> sun_speed_rpm{}, carrier_speed_rpm{}, mesh_frequency_Hz{};

  [[nodiscard]] bool any() const { return sun_speed_rpm || carrier_speed_rpm || mesh_frequency_Hz; }
};

struct SpeedAlias {
  std::string_view key;
  std::optional<double> GivenSpeed::*given;
  double (*per_mesh_frequency)(const gear::Stage&);  ///< its value at omega_m = 1 rad/s; 0 of a member at rest
};

[[nodiscard]] const std::array<SpeedAlias, 3>& speed_aliases();

/// @returns nullptr if there is none of that name
[[nodiscard]] const SpeedAlias* find_speed_alias(std::string_view key);

/// Omega for a speed of 1.
/// @param stage  complete, and one that moves
/// @returns nothing of a member at rest
[[nodiscard]] std::optional<double> ratio_per_unit(const SpeedAlias& alias, const gear::Stage& stage);

}  // namespace epicyclic::input
