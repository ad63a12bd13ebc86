// A plane of points: two parameters of a map, or two components of the state that motions start from, of basins.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "studies/axis.hpp"
#include "studies/recording_options.hpp"
#include "studies/sweep_options.hpp"

namespace epicyclic::studies {

struct Plane {
  Axis first;  ///< runs fastest
  Axis second;

  /// @throws InputError for what an axis refuses, and for two of one name
  void validate() const;
};

struct MapOptions {
  Plane plane;  ///< of parameters
  std::vector<Direction> directions = {Direction::up};
  Start start = Start::continued;  ///< along the first axis
  RecordingOptions recording = {.keep = Keep::row};

  /// @throws InputError for what plane and look refuse, and for no directions
  void validate() const;
};

/// Cells are cold, and settle until their regimes are told: a transient of a fixed length leaves motions on their way,
/// which are then counted as attractors.
struct BasinsOptions {
  Plane plane;                                     ///< of components
  std::map<std::string, double> other_components;  ///< components that both axes leave alone, where not at default
  RecordingOptions recording = {.transient = Transient::adaptive, .keep = Keep::attractor};

  /// @throws InputError for what plane and look refuse
  void validate() const;
};

}  // namespace epicyclic::studies
