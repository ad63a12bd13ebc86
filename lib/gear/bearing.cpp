#include "gear/bearing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/errors.hpp"

namespace epicyclic::gear {

namespace {

constexpr std::string_view paper = "source: Tang et al. 2020, Table 3";
constexpr std::string_view balls_of_ratings =
    "estimate: Z and D_w that reproduce the load ratings and f0 of NSK CAT. No. E1102e by ISO 76 and ISO 281";
constexpr std::string_view frequencies =
    "catalogue: Timken, table A-9 (defect frequencies of the same rolling elements); also fits NSK's load ratings";
constexpr std::string_view rollers_of_ratings =
    "estimate: Z, D_w and l that reproduce the load ratings of NSK CAT. No. E1102e (EW, EM) by ISO 76 and ISO 281, Z "
    "from 0.76 to 0.88 of a full complement";
constexpr std::string_view needles_of_ratings =
    "estimate: Z, D_w and l that reproduce the load ratings of IKO's machined needle bearings by ISO 76 and ISO 281, Z "
    "from 0.62 to 0.76 of a full complement";
constexpr std::string_view full_of_ratings =
    "estimate: D_w and l that reproduce the load ratings of APB's NCF 30 V by ISO 76 and ISO 281, Z a full complement";

constexpr std::string_view nsk = "catalogue: NSK CAT. No. E1102e";
constexpr std::string_view iko = "catalogue: IKO, machined type caged needle roller bearings";
constexpr std::string_view apb = "catalogue: APB, full complement cylindrical roller bearings";

// Designation; bore, outer diameter, width; Z, D_w, l; C, C0.
constexpr std::array<BearingType, 133> types = {{
    {"6004", 20, 42, 12, 9, 6.35, 0, 9.4, 5, balls_of_ratings, nsk},
    {"6005", 25, 47, 12, 10, 6.35, 0, 10.1, 5.85, balls_of_ratings, nsk},
    {"6006", 30, 55, 13, 11, 7.144, 0, 13.2, 8.3, balls_of_ratings, nsk},
    {"6007", 35, 62, 14, 11, 7.938, 0, 16, 10.3, balls_of_ratings, nsk},
    {"6008", 40, 68, 15, 12, 7.938, 0, 16.8, 11.5, balls_of_ratings, nsk},
    {"6009", 45, 75, 16, 13, 8.731, 0, 20.9, 15.2, balls_of_ratings, nsk},
    {"6010", 50, 80, 16, 14, 8.731, 0, 21.8, 16.6, balls_of_ratings, nsk},
    {"6011", 55, 90, 18, 13, 10.319, 0, 28.3, 21.2, balls_of_ratings, nsk},
    {"6012", 60, 95, 18, 14, 10.319, 0, 29.5, 23.2, balls_of_ratings, nsk},
    {"6013", 65, 100, 18, 15, 10.319, 0, 30.5, 25.2, balls_of_ratings, nsk},
    {"6014", 70, 110, 20, 14, 11.906, 0, 38, 31, balls_of_ratings, nsk},
    {"6015", 75, 115, 20, 15, 11.906, 0, 39.5, 33.5, balls_of_ratings, nsk},
    {"6016", 80, 125, 22, 14, 13.494, 0, 47.5, 40, balls_of_ratings, nsk},
    {"6017", 85, 130, 22, 15, 13.494, 0, 49.5, 43, balls_of_ratings, nsk},
    {"6018", 90, 140, 24, 14, 15.081, 0, 58, 50, balls_of_ratings, nsk},
    {"6019", 95, 145, 24, 15, 15.081, 0, 60.5, 54, balls_of_ratings, nsk},
    {"6020", 100, 150, 24, 14, 16, 0, 60, 54, paper, nsk},
    {"6021", 105, 160, 26, 15, 16.669, 0, 72.5, 66, balls_of_ratings, nsk},
    {"6022", 110, 170, 28, 13, 19.05, 0, 85, 73, balls_of_ratings, nsk},
    {"6024", 120, 180, 28, 14, 19.05, 0, 88, 80, balls_of_ratings, nsk},
    {"6204", 20, 47, 14, 8, 7.938, 0, 12.8, 6.6, balls_of_ratings, nsk},
    {"6205", 25, 52, 15, 9, 7.938, 0, 14, 7.85, balls_of_ratings, nsk},
    {"6206", 30, 62, 16, 9, 9.525, 0, 19.5, 11.3, frequencies, nsk},
    {"6207", 35, 72, 17, 9, 11.112, 0, 25.7, 15.3, balls_of_ratings, nsk},
    {"6208", 40, 80, 18, 9, 11.906, 0, 29.1, 17.9, balls_of_ratings, nsk},
    {"6209", 45, 85, 19, 10, 12, 0, 31.5, 20.4, balls_of_ratings, nsk},
    {"6210", 50, 90, 20, 10, 12.7, 0, 35, 23.2, frequencies, nsk},
    {"6211", 55, 100, 21, 10, 14.288, 0, 43.5, 29.3, frequencies, nsk},
    {"6212", 60, 110, 22, 10, 15.875, 0, 52.5, 36, frequencies, nsk},
    {"6213", 65, 120, 23, 10, 16.67, 0, 57.5, 40, paper, nsk},
    {"6214", 70, 125, 24, 10, 17.462, 0, 62, 44, frequencies, nsk},
    {"6215", 75, 130, 25, 11, 17.462, 0, 66, 49.5, frequencies, nsk},
    {"6216", 80, 140, 26, 10, 19.05, 0, 72.5, 53, balls_of_ratings, nsk},
    {"6217", 85, 150, 28, 10, 20.637, 0, 84, 62, balls_of_ratings, nsk},
    {"6218", 90, 160, 30, 10, 22.225, 0, 96, 71.5, balls_of_ratings, nsk},
    {"6219", 95, 170, 32, 10, 23.812, 0, 109, 82, balls_of_ratings, nsk},
    {"6220", 100, 180, 34, 10, 25.4, 0, 122, 93, balls_of_ratings, nsk},
    {"6221", 105, 190, 36, 10, 26.987, 0, 133, 105, balls_of_ratings, nsk},
    {"6222", 110, 200, 38, 10, 28.575, 0, 144, 117, balls_of_ratings, nsk},
    {"6224", 120, 215, 40, 10, 30.162, 0, 155, 131, balls_of_ratings, nsk},
    {"6304", 20, 52, 15, 7, 9.525, 0, 15.9, 7.9, balls_of_ratings, nsk},
    {"6305", 25, 62, 17, 8, 10.319, 0, 20.6, 11.2, balls_of_ratings, nsk},
    {"6306", 30, 72, 19, 8, 11.906, 0, 26.7, 15, balls_of_ratings, nsk},
    {"6307", 35, 80, 21, 8, 13.494, 0, 33.5, 19.2, balls_of_ratings, nsk},
    {"6308", 40, 90, 23, 8, 15.081, 0, 40.5, 24, balls_of_ratings, nsk},
    {"6309", 45, 100, 25, 8, 17.462, 0, 53, 32, balls_of_ratings, nsk},
    {"6310", 50, 110, 27, 8, 19, 0, 62, 38.5, balls_of_ratings, nsk},
    {"6311", 55, 120, 29, 8, 20.637, 0, 71.5, 44.5, balls_of_ratings, nsk},
    {"6312", 60, 130, 31, 8, 22.225, 0, 82, 52, balls_of_ratings, nsk},
    {"6313", 65, 140, 33, 8, 23.812, 0, 92.5, 60, balls_of_ratings, nsk},
    {"6314", 70, 150, 35, 8, 25.4, 0, 104, 68, balls_of_ratings, nsk},
    {"6315", 75, 160, 37, 8, 27, 0, 113, 77, balls_of_ratings, nsk},
    {"6316", 80, 170, 39, 8, 28.575, 0, 123, 86.5, balls_of_ratings, nsk},
    {"6317", 85, 180, 41, 8, 30.162, 0, 133, 97, balls_of_ratings, nsk},
    {"6318", 90, 190, 43, 8, 31.75, 0, 143, 107, balls_of_ratings, nsk},
    {"6319", 95, 200, 45, 8, 33.337, 0, 153, 119, balls_of_ratings, nsk},
    {"6320", 100, 215, 47, 8, 36.512, 0, 173, 141, balls_of_ratings, nsk},
    {"6321", 105, 225, 49, 8, 38.1, 0, 184, 154, balls_of_ratings, nsk},
    {"6322", 110, 240, 50, 8, 41, 0, 205, 179, balls_of_ratings, nsk},
    {"6324", 120, 260, 55, 8, 41.275, 0, 207, 185, balls_of_ratings, nsk},
    {"NA4904", 20, 37, 17, 15, 4, 11, 21, 25, needles_of_ratings, iko},
    {"NA4905", 25, 42, 17, 18, 4, 11, 23.7, 30.7, needles_of_ratings, iko},
    {"NA4906", 30, 47, 17, 20, 4, 11, 25.2, 34.7, needles_of_ratings, iko},
    {"NA4907", 35, 55, 20, 26, 4, 12, 32, 50.1, needles_of_ratings, iko},
    {"NA4908", 40, 62, 22, 25, 4.5, 14.9, 41.6, 67.4, needles_of_ratings, iko},
    {"NA4909", 45, 68, 22, 25, 4.5, 16.1, 43.5, 73.3, needles_of_ratings, iko},
    {"NA4910", 50, 72, 22, 32, 4.5, 14, 46.2, 82.1, needles_of_ratings, iko},
    {"NA4911", 55, 80, 25, 29, 5.5, 15.1, 57.6, 97.2, needles_of_ratings, iko},
    {"NA4912", 60, 85, 25, 29, 5.5, 16.2, 60.2, 105, needles_of_ratings, iko},
    {"NA4913", 65, 90, 25, 28, 5.5, 18, 62.7, 113, needles_of_ratings, iko},
    {"NA4914", 70, 100, 30, 28, 6, 23, 83.2, 158, needles_of_ratings, iko},
    {"NA4915", 75, 105, 30, 31, 6, 22.1, 86.2, 169, needles_of_ratings, iko},
    {"NA4916", 80, 110, 30, 32, 6, 22.1, 87.3, 175, needles_of_ratings, iko},
    {"NA4917", 85, 120, 35, 35, 6, 28, 110, 244, needles_of_ratings, iko},
    {"NA4918", 90, 125, 35, 43, 6, 24, 113, 258, needles_of_ratings, iko},
    {"NA4919", 95, 130, 35, 45, 6, 24.1, 116, 271, needles_of_ratings, iko},
    {"NCF3005V", 25, 47, 16, 13, 8, 9.3, 35.1, 32.8, full_of_ratings, apb},
    {"NCF3006V", 30, 55, 19, 14, 9, 10, 45.2, 43.3, full_of_ratings, apb},
    {"NCF3007V", 35, 62, 20, 14, 10, 11.5, 55.4, 55.3, full_of_ratings, apb},
    {"NCF3008V", 40, 68, 21, 14, 11, 12.8, 66.8, 67.8, full_of_ratings, apb},
    {"NCF3009V", 45, 75, 23, 16, 10.5, 12.7, 70.5, 76.4, full_of_ratings, apb},
    {"NCF3010V", 50, 80, 23, 16, 11.5, 14.8, 88.4, 97, full_of_ratings, apb},
    {"NCF3011V", 55, 90, 26, 15, 14, 18.7, 124, 138, full_of_ratings, apb},
    {"NCF3012V", 60, 95, 26, 16, 13.5, 19, 125, 147, full_of_ratings, apb},
    {"NCF3013V", 65, 100, 26, 18, 13.5, 18.1, 132, 161, full_of_ratings, apb},
    {"NCF3014V", 70, 110, 30, 15, 16.5, 20.5, 157, 179, full_of_ratings, apb},
    {"NCF3015V", 75, 115, 30, 17, 16, 19.8, 163, 196, full_of_ratings, apb},
    {"NCF3016V", 80, 125, 34, 22, 14.5, 18.9, 172, 228, full_of_ratings, apb},
    {"NCF3017V", 85, 130, 34, 22, 15, 19.1, 178, 238, full_of_ratings, apb},
    {"NCF3018V", 90, 140, 37, 22, 16, 21.4, 209, 285, full_of_ratings, apb},
    {"NCF3020V", 100, 150, 37, 25, 15.5, 20.9, 216.7, 312, full_of_ratings, apb},
    {"NCF3022V", 110, 170, 45, 22, 19, 24.4, 278, 387, full_of_ratings, apb},
    {"NCF3024V", 120, 180, 46, 23, 20, 25, 307, 438, full_of_ratings, apb},
    {"NU204", 20, 47, 14, 11, 7.5, 8, 25.7, 22.6, rollers_of_ratings, nsk},
    {"NU205", 25, 52, 15, 13, 7.5, 8, 29.3, 27.7, rollers_of_ratings, nsk},
    {"NU206", 30, 62, 16, 13, 9, 9, 39, 37.5, rollers_of_ratings, nsk},
    {"NU207", 35, 72, 17, 14, 10, 10, 50.5, 50, rollers_of_ratings, nsk},
    {"NU208", 40, 80, 18, 14, 11, 10, 55.5, 55.5, rollers_of_ratings, nsk},
    {"NU209", 45, 85, 19, 15, 11, 11, 63, 66.5, rollers_of_ratings, nsk},
    {"NU210", 50, 90, 20, 17, 11, 11, 69, 76.5, rollers_of_ratings, nsk},
    {"NU211", 55, 100, 21, 17, 12, 13, 86.5, 98.5, rollers_of_ratings, nsk},
    {"NU212", 60, 110, 22, 16, 14, 13, 97.5, 107, rollers_of_ratings, nsk},
    {"NU213", 65, 120, 23, 15, 15, 14.3, 108, 119, rollers_of_ratings, nsk},
    {"NU214", 70, 125, 24, 16, 15, 15.3, 119, 137, rollers_of_ratings, nsk},
    {"NU215", 75, 130, 25, 17, 15, 16.3, 130, 156, rollers_of_ratings, nsk},
    {"NU216", 80, 140, 26, 17, 16, 16.3, 139, 167, rollers_of_ratings, nsk},
    {"NU217", 85, 150, 28, 17, 18, 17.4, 167, 199, rollers_of_ratings, nsk},
    {"NU218", 90, 160, 30, 18, 19, 17, 182, 217, rollers_of_ratings, nsk},
    {"NU219", 95, 170, 32, 17, 21, 20, 220, 265, rollers_of_ratings, nsk},
    {"NU220", 100, 180, 34, 17, 22, 22, 249, 305, rollers_of_ratings, nsk},
    {"NU221", 105, 190, 36, 16, 24, 21.9, 262, 310, rollers_of_ratings, nsk},
    {"NU222", 110, 200, 38, 17, 24, 24, 293, 365, rollers_of_ratings, nsk},
    {"NU224", 120, 215, 40, 16, 26, 27.1, 335, 420, rollers_of_ratings, nsk},
    {"NU304", 20, 52, 15, 10, 9, 9, 31.5, 26.9, rollers_of_ratings, nsk},
    {"NU305", 25, 62, 17, 11, 10, 10, 41.5, 37.5, rollers_of_ratings, nsk},
    {"NU306", 30, 72, 19, 12, 11, 10.9, 53, 50, rollers_of_ratings, nsk},
    {"NU307", 35, 80, 21, 13, 12, 12, 66.5, 65.5, rollers_of_ratings, nsk},
    {"NU308", 40, 90, 23, 12, 14, 14, 83, 81.5, rollers_of_ratings, nsk},
    {"NU309", 45, 100, 25, 12, 15, 15.6, 97.5, 98.5, rollers_of_ratings, nsk},
    {"NU310", 50, 110, 27, 13, 16, 15.4, 110, 113, rollers_of_ratings, nsk},
    {"NU311", 55, 120, 29, 12, 18, 18.9, 137, 143, rollers_of_ratings, nsk},
    {"NU312", 60, 130, 31, 13, 19, 18, 150, 157, rollers_of_ratings, nsk},
    {"NU313", 65, 140, 33, 13, 21, 19.9, 181, 191, rollers_of_ratings, nsk},
    {"NU314", 70, 150, 35, 13, 22, 22, 205, 222, rollers_of_ratings, nsk},
    {"NU315", 75, 160, 37, 13, 24, 24, 240, 263, rollers_of_ratings, nsk},
    {"NU316", 80, 170, 39, 12, 25, 26.7, 256, 282, rollers_of_ratings, nsk},
    {"NU317", 85, 180, 41, 14, 26, 25.6, 291, 330, rollers_of_ratings, nsk},
    {"NU318", 90, 190, 43, 12, 28, 29.9, 315, 355, rollers_of_ratings, nsk},
    {"NU319", 95, 200, 45, 13, 28, 29.6, 335, 385, rollers_of_ratings, nsk},
    {"NU320", 100, 215, 47, 13, 32, 29, 380, 425, rollers_of_ratings, nsk},
    {"NU321", 105, 225, 49, 13, 34, 31, 425, 480, rollers_of_ratings, nsk},
    {"NU322", 110, 240, 50, 14, 34, 31, 450, 525, rollers_of_ratings, nsk},
    {"NU324", 120, 260, 55, 13, 38, 35, 530, 610, rollers_of_ratings, nsk},
}};

constexpr double mm_per_m = 1e3;
constexpr double line_contact_mm = 7.68e-5;  // of both contacts of a roller, at 1 N and 1 mm
constexpr double most_loaded = 5.0;          // Q = 5 F / Z

}  // namespace

double palmgren_coefficient(int balls, double ball_diameter_mm, double contact_angle_deg) {
  constexpr double newton_per_mm_1_5 = 32900.0;
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
  return mm_per_m * newton_per_mm * std::pow(rollers, 0.9) * std::pow(length_mm, 0.8) * std::pow(load_N, 0.1);
}

double roller_force(double approach_m, int rollers, double length_mm) {
  return rollers / most_loaded *
         std::pow(approach_m * mm_per_m * std::pow(length_mm, 0.8) / line_contact_mm, 1.0 / 0.9);
}

double BearingData::stiffness(double approach_m) const {
  return kind == RollingElements::balls
             ? palmgren_stiffness(palmgren_coefficient(elements, ball_diameter_mm, contact_angle_deg), approach_m)
             : roller_stiffness(force(approach_m), elements, roller_length_mm);
}

double BearingData::force(double approach_m) const {
  return kind == RollingElements::balls
             ? palmgren_force(palmgren_coefficient(elements, ball_diameter_mm, contact_angle_deg), approach_m)
             : roller_force(approach_m, elements, roller_length_mm);
}

std::span<const BearingType> bearing_types() { return types; }

std::optional<BearingData> bearing_data(const SupportBearing& bearing) {
  BearingData data{.name = "own data", .contact_angle_deg = bearing.contact_angle_deg, .origin = "own data"};
  if (bearing.balls && bearing.ball_diameter_mm) {
    data.elements = *bearing.balls;
    data.ball_diameter_mm = *bearing.ball_diameter_mm;
    return data;
  }
  if (bearing.rollers && bearing.roller_length_mm) {
    data.kind = RollingElements::rollers;
    data.elements = *bearing.rollers;
    data.roller_length_mm = *bearing.roller_length_mm;
    return data;
  }
  const std::optional<BearingType> type = find_bearing(bearing.type);
  if (!type) return std::nullopt;
  data.name = type->designation;
  data.kind = type->has_balls() ? RollingElements::balls : RollingElements::rollers;
  data.elements = type->elements;
  data.ball_diameter_mm = type->has_balls() ? type->diameter_mm : 0.0;
  data.roller_length_mm = type->length_mm;
  data.dynamic_rating_kN = type->dynamic_rating_kN;
  data.origin = type->origin;
  data.ratings = type->ratings;
  return data;
}

std::optional<BearingType> find_bearing(std::string_view designation) {
  const auto it = std::find_if(types.begin(), types.end(),
                               [&](const BearingType& type) { return type.designation == designation; });
  return it == types.end() ? std::nullopt : std::optional(*it);
}

}  // namespace epicyclic::gear
