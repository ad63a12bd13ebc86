#include "model/layout.hpp"

namespace epicyclic::model {

std::vector<std::string> coordinate_names(Layout layout, int planets) {
  if (planets == 1 && layout != Layout::full) {
    std::vector<std::string> names;
    const bool moves = has_translations(layout);
    if (moves) names.insert(names.end(), {"x_1", "y_1"});
    names.emplace_back(has_both_rotations(layout) ? "u_1" : "w");
    if (moves) names.insert(names.end(), {"x_2", "y_2"});
    if (has_both_rotations(layout)) names.emplace_back("u_2");
    return names;
  }
  const std::string rotation = layout == Layout::full ? "u_" : "w_";
  std::vector<std::string> names = {"x_s", "y_s", rotation + "s"};
  for (int i = 1; i <= planets; ++i) {
    const std::string planet = std::string("p").append(std::to_string(i));
    names.push_back("x_" + planet);
    names.push_back("y_" + planet);
    names.push_back(rotation + planet);
  }
  for (const char* name : {"x_r", "y_r", "x_c", "y_c"}) names.emplace_back(name);
  if (has_ring_rotation(layout)) names.emplace_back("u_r");
  if (has_carrier_rotation(layout)) names.emplace_back("u_c");
  return names;
}

}  // namespace epicyclic::model
