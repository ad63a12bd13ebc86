#include "input/speed_aliases.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "gear/kinematics.hpp"
#include "model/scales.hpp"
#include "studies/speed_unit.hpp"

namespace epicyclic::input {

const std::array<SpeedAlias, 3>& speed_aliases() {
  using gear::Stage;
  static const std::array<SpeedAlias, 3> all = {{
      {studies::speed_keys[0], &GivenSpeed::sun_speed_rpm,
       [](const Stage& stage) { return gear::rpm * gear::speeds(stage, 1.0).sun; }},
      {studies::speed_keys[1], &GivenSpeed::carrier_speed_rpm,
       [](const Stage& stage) { return gear::rpm * std::abs(gear::speeds(stage, 1.0).carrier); }},
      {studies::speed_keys[2], &GivenSpeed::mesh_frequency_Hz,
       [](const Stage& /*stage*/) { return 0.5 / std::numbers::pi; }},
  }};
  return all;
}

const SpeedAlias* find_speed_alias(std::string_view key) {
  const auto& all = speed_aliases();
  const auto found = std::ranges::find(all, key, &SpeedAlias::key);
  return found == all.end() ? nullptr : &*found;
}

std::optional<double> ratio_per_unit(const SpeedAlias& alias, const gear::Stage& stage) {
  const double per_mesh_frequency = alias.per_mesh_frequency(stage);
  if (per_mesh_frequency == 0.0) return std::nullopt;
  return 1.0 / (per_mesh_frequency * model::scales_of(stage).omega_sn);
}

}  // namespace epicyclic::input
