#include "core/interpolation.hpp"

#include <algorithm>
#include <cmath>

#include "core/errors.hpp"

namespace epicyclic {

namespace {

using Numbers = std::span<const double>;

double secant(Numbers x, Numbers y, std::size_t k) { return (y[k + 1] - y[k]) / (x[k + 1] - x[k]); }

/// At the first row, from the parabola through three: his limits keep it monotone.
double steffen_end(double s_0, double s_1, double h_0, double h_1) {
  const double p = s_0 * (1.0 + h_0 / (h_0 + h_1)) - s_1 * h_0 / (h_0 + h_1);
  if (p * s_0 <= 0.0) return 0.0;
  return std::abs(p) > 2.0 * std::abs(s_0) ? 2.0 * s_0 : p;
}

double steffen_slope(Numbers x, Numbers y, std::size_t k) {
  const std::size_t n = x.size();
  const auto h = [&](std::size_t i) { return x[i + 1] - x[i]; };
  const auto s = [&](std::size_t i) { return secant(x, y, i); };
  if (n == 2) return s(0);
  if (k == 0) return steffen_end(s(0), s(1), h(0), h(1));
  if (k == n - 1) return steffen_end(s(n - 2), s(n - 3), h(n - 2), h(n - 3));
  const double left = s(k - 1);
  const double right = s(k);
  if (left * right <= 0.0) return 0.0;
  const double p = (left * h(k) + right * h(k - 1)) / (h(k - 1) + h(k));
  return std::copysign(2.0 * std::min({std::abs(left), std::abs(right), 0.5 * std::abs(p)}), left);
}

/// Slope of the polynomial through the five rows nearest to k, or through all rows if there are fewer.
double lagrange_slope(Numbers x, Numbers y, std::size_t k) {
  const std::size_t width = std::min<std::size_t>(5, x.size());
  const std::size_t first = std::min(k < width / 2 ? 0 : k - width / 2, x.size() - width);
  // 1 over the barycentric weight.
  const auto inverse_weight = [&](std::size_t j) {
    double product = 1.0;
    for (std::size_t i = first; i < first + width; ++i)
      if (i != j) product *= x[j] - x[i];
    return product;
  };
  const double own = inverse_weight(k);
  double slope = 0.0;
  for (std::size_t j = first; j < first + width; ++j)
    if (j != k) slope += own / inverse_weight(j) * (y[j] - y[k]) / (x[k] - x[j]);
  return slope;
}

}  // namespace

std::vector<CubicCoefficients> cubics_through(Interpolation how, Numbers x, Numbers y, std::size_t first,
                                              std::size_t count) {
  for (std::size_t k = 1; k < x.size(); ++k)
    if (!(x[k] > x[k - 1])) throw InputError("table over the phase: neighbouring rows have the same phase");
  std::vector<CubicCoefficients> cubics;
  if (how == Interpolation::linear || x.size() == 2) {
    for (std::size_t k = first; k < first + count; ++k) cubics.push_back({y[k], secant(x, y, k), 0.0, 0.0});
    return cubics;
  }
  const auto slope = [&](std::size_t k) {
    return how == Interpolation::monotone ? steffen_slope(x, y, k) : lagrange_slope(x, y, k);
  };
  double left = slope(first);
  for (std::size_t k = first; k < first + count; ++k) {
    const double right = slope(k + 1);
    const double h = x[k + 1] - x[k];
    const double s = secant(x, y, k);
    cubics.push_back({y[k], left, (3.0 * s - 2.0 * left - right) / h, (left + right - 2.0 * s) / (h * h)});
    left = right;
  }
  return cubics;
}

std::vector<std::size_t> every_second(Numbers x, Numbers breakpoints) {
  std::vector<std::size_t> kept;
  std::size_t anchor = 0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    const bool twin = (k > 0 && x[k - 1] == x[k]) || (k + 1 < x.size() && x[k + 1] == x[k]);
    const bool fixed = twin || k == 0 || std::find(breakpoints.begin(), breakpoints.end(), x[k]) != breakpoints.end();
    if (fixed) anchor = k;
    if ((k - anchor) % 2 == 0) kept.push_back(k);
  }
  return kept;
}

}  // namespace epicyclic
