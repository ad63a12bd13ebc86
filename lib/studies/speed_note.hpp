// How an origin notes that the mesh frequency ratio was given as another speed: "choice: run-up, sun_speed_rpm = 4000".
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace epicyclic::studies {

/// Speeds that may be given in place of the mesh frequency ratio [rpm, rpm, Hz].
inline constexpr std::array<std::string_view, 3> speed_keys = {"sun_speed_rpm", "carrier_speed_rpm",
                                                               "mesh_frequency_Hz"};

struct SpeedNote {
  std::string key;  ///< one of speed_keys
  double value;
  std::string text;    ///< "sun_speed_rpm = 4000"
  std::string before;  ///< the origin without it: "choice: run-up"
};

/// What speeds are given in, in place of the mesh frequency ratio.
struct SpeedUnit {
  std::string key;       ///< one of speed_keys
  double per_ratio = 1;  ///< how many of it a ratio of 1 is [rpm, rpm, Hz]
};

/// @returns nothing of an origin that notes no speed
[[nodiscard]] std::optional<SpeedNote> find_speed_note(std::string_view origin);

/// The origin with a note.
/// @param number  of the speed, as it is to be read again
[[nodiscard]] std::string with_speed_note(std::string origin, std::string_view key, std::string_view number);

}  // namespace epicyclic::studies
