// Units of given speeds.
#pragma once

#include <array>
#include <string>
#include <string_view>

namespace epicyclic::studies {

/// Speeds that may be given in place of the mesh frequency ratio [rpm, rpm, Hz].
inline constexpr std::array<std::string_view, 3> speed_keys = {"sun_speed_rpm", "carrier_speed_rpm",
                                                               "mesh_frequency_Hz"};

/// The unit of given speeds, in place of the mesh frequency ratio.
struct SpeedUnit {
  std::string key;       ///< one of speed_keys
  double per_ratio = 1;  ///< how many of it a ratio of 1 is [rpm, rpm, Hz]
};

}  // namespace epicyclic::studies
