// A plane of points: two parameters, or two components of the state that a motion starts from.
#pragma once

#include <map>
#include <string>

namespace epicyclic::studies {

struct Axis {
  std::string name;  ///< a sweep parameter, or a component of the state
  double from = 0;
  double to = 1;
  int points = 50;
};

struct PlaneOptions {
  Axis first;  ///< runs fastest
  Axis second;
  std::map<std::string, double> base;  ///< of basins: components that both axes leave alone, where not at default
};

}  // namespace epicyclic::studies
