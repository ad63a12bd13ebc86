// The keys of the input in words, one line per key, for users who search one. From the schema, and so from the tables.
#pragma once

#include <string>
#include <vector>

namespace epicyclic::input {

struct KeyLine {
  std::string pointer;   ///< "/stage/lumped/planet/bearing_N_per_m"; N in place of the index of an element
  std::string kinds;     ///< of studies that have it, where not all do: "run, sweep"
  std::string unit;      ///< empty of pure numbers and words
  std::string standard;  ///< its default; empty: none
  std::string bounds;    ///< "0 to 1e+18", "one of: as_printed, fixed_ring, star"
  std::string meaning;
};

/// All of them, in the order of the tables. Those of a stage stand below /stage.
[[nodiscard]] std::vector<KeyLine> key_lines();

/// "/operation/sun_speed_rpm [rpm]  1e-09 to 1e+09  Speed of the sun, ...", one line.
[[nodiscard]] std::string key_text(const KeyLine& key);

}  // namespace epicyclic::input
