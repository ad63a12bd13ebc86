#include "core/fit.hpp"

#include <limits>
#include <stdexcept>

#include <gsl/gsl_fit.h>

namespace epicyclic {

double fitted_slope(std::span<const double> x, std::span<const double> y) {
  if (x.size() != y.size()) throw std::invalid_argument("fitted_slope: x and y differ in length");
  if (x.size() < 3) return std::numeric_limits<double>::quiet_NaN();
  double intercept = 0.0;
  double slope = 0.0;
  double c00 = 0.0;
  double c01 = 0.0;
  double c11 = 0.0;
  double squares = 0.0;
  gsl_fit_linear(x.data(), 1, y.data(), 1, x.size(), &intercept, &slope, &c00, &c01, &c11, &squares);
  return slope;
}

void PooledSlope::add(std::span<const double> x, std::span<const double> y) {
  if (x.size() != y.size()) throw std::invalid_argument("PooledSlope: x and y differ in length");
  const auto append = [](std::vector<double>& all, std::span<const double> values) {
    double mean = 0.0;
    for (const double v : values) mean += v / static_cast<double>(values.size());
    for (const double v : values) all.push_back(v - mean);
  };
  append(x_, x);
  append(y_, y);
}

}  // namespace epicyclic
