#include "gear/accuracy.hpp"

#include <cmath>
#include <span>
#include <string>

#include "core/errors.hpp"

namespace epicyclic::gear {

namespace {

constexpr double module_limits[] = {0.5, 2, 3.5, 6, 10, 16, 25, 40, 70};
constexpr double diameter_limits[] = {5, 20, 50, 125, 280, 560, 1000, 1600, 2500, 4000, 6000, 8000, 10000};
constexpr double width_limits[] = {4, 10, 20, 40, 80, 160, 250, 400, 650, 1000};

/// Geometric mean of the limits of the range that holds a value; an upper limit belongs to its range.
double range_mean(double value, std::span<const double> limits, const char* what) {
  for (std::size_t k = 0; k + 1 < limits.size(); ++k)
    if (value <= limits[k + 1] && (value > limits[k] || (k == 0 && value == limits[0])))
      return std::sqrt(limits[k] * limits[k + 1]);
  throw DomainError(std::string("ISO 1328-1 has no tolerances for a ") + what + " of " + std::to_string(value) +
                    " mm, only from " + std::to_string(limits.front()) + " to " + std::to_string(limits.back()) +
                    " mm");
}

double rounded(double um) {
  const double step = um > 10.0 ? 1.0 : um >= 5.0 ? 0.5 : 0.1;
  return std::round(um / step) * step;
}

}  // namespace

Tolerances tolerances(int grade, double module_mm, double reference_diameter_mm, double width_mm,
                      double contact_ratio) {
  if (grade < 0 || grade > 12) throw DomainError("ISO 1328-1 has accuracy grades 0 to 12");
  const double m = range_mean(module_mm, module_limits, "module");
  const double d = range_mean(reference_diameter_mm, diameter_limits, "reference diameter");
  const double b = range_mean(width_mm, width_limits, "face width");
  const double factor = std::pow(2.0, 0.5 * (grade - 5));
  const auto at_grade = [&](double um) { return rounded(factor * um); };
  const double root_m = std::sqrt(m);
  const double root_d = std::sqrt(d);
  const double k = contact_ratio < 4.0 ? 0.2 * (contact_ratio + 4.0) / contact_ratio : 0.4;
  return {at_grade(0.3 * (m + 0.4 * root_d) + 4.0),
          at_grade(0.3 * m + 1.25 * root_d + 7.0),
          at_grade(3.2 * root_m + 0.22 * root_d + 0.7),
          at_grade(2.5 * root_m + 0.17 * root_d + 0.5),
          at_grade(2.0 * root_m + 0.14 * root_d + 0.5),
          at_grade(0.1 * root_d + 0.63 * std::sqrt(b) + 4.2),
          at_grade(k * (9.0 + 0.3 * m + 3.2 * root_m + 0.34 * root_d))};
}

}  // namespace epicyclic::gear
