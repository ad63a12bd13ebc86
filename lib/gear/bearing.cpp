#include "gear/bearing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/errors.hpp"

namespace epicyclic::gear {

namespace {

constexpr std::string_view paper = "source: Tang et al. 2020, Table 3";
constexpr std::string_view ratings =
    "estimate: Z and D_w that reproduce the load ratings and f0 of NSK CAT. No. E1102e by ISO 76 and ISO 281";
constexpr std::string_view frequencies =
    "catalogue: Timken, table A-9 (defect frequencies of the same rolling elements); also fits NSK's load ratings";

constexpr std::array<BearingType, 12> types = {{
    {"6018", 90, 140, 24, 14, 15.081, ratings},
    {"6019", 95, 145, 24, 15, 15.081, ratings},
    {"6020", 100, 150, 24, 14, 16, paper},
    {"6021", 105, 160, 26, 15, 16.669, ratings},
    {"6022", 110, 170, 28, 13, 19.05, ratings},
    {"6206", 30, 62, 16, 9, 9.525, frequencies},
    {"6210", 50, 90, 20, 10, 12.7, frequencies},
    {"6211", 55, 100, 21, 10, 14.288, frequencies},
    {"6212", 60, 110, 22, 10, 15.875, frequencies},
    {"6213", 65, 120, 23, 10, 16.67, paper},
    {"6214", 70, 125, 24, 10, 17.462, frequencies},
    {"6215", 75, 130, 25, 11, 17.462, ratings},
}};

}  // namespace

double palmgren_coefficient(int balls, double ball_diameter_mm, double contact_angle_deg) {
  constexpr double newton_per_mm_1_5 = 32900.0;
  constexpr double mm_per_m = 1e3;
  const double cosine = std::cos(contact_angle_deg * std::numbers::pi / 180.0);
  const double per_mm = newton_per_mm_1_5 * balls * std::sqrt(ball_diameter_mm * std::pow(cosine, 5));
  return per_mm * mm_per_m * std::sqrt(mm_per_m);
}

double palmgren_coefficient(const SunBearing& bearing) {
  if (!bearing.balls || !bearing.ball_diameter_mm) throw DomainError("Eq. (11) needs balls and ball_diameter_mm");
  return palmgren_coefficient(*bearing.balls, *bearing.ball_diameter_mm, bearing.contact_angle_deg);
}

double palmgren_stiffness(double coefficient, double approach_m) { return coefficient * std::sqrt(approach_m); }

double palmgren_force(double coefficient, double approach_m) {
  return 2.0 / 3.0 * palmgren_stiffness(coefficient, approach_m) * approach_m;
}

double roller_stiffness(double load_N, int rollers, double length_mm) {
  constexpr double newton_per_mm = 3400.0;
  constexpr double mm_per_m = 1e3;
  return mm_per_m * newton_per_mm * std::pow(rollers, 0.9) * std::pow(length_mm, 0.8) * std::pow(load_N, 0.1);
}

std::span<const BearingType> bearing_types() { return types; }

std::optional<BearingData> bearing_data(const SupportBearing& bearing) {
  if (bearing.balls && bearing.ball_diameter_mm)
    return BearingData{"own data", *bearing.balls, *bearing.ball_diameter_mm, bearing.contact_angle_deg, "own data"};
  const std::optional<BearingType> type = find_bearing(bearing.type);
  if (!type) return std::nullopt;
  return BearingData{std::string(type->designation), type->balls, type->ball_diameter_mm, bearing.contact_angle_deg,
                     std::string(type->origin)};
}

std::optional<BearingType> find_bearing(std::string_view designation) {
  const auto it = std::find_if(types.begin(), types.end(),
                               [&](const BearingType& type) { return type.designation == designation; });
  return it == types.end() ? std::nullopt : std::optional(*it);
}

}  // namespace epicyclic::gear
