#include "claims/period_one.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <optional>

#include <Eigen/Eigenvalues>

#include "analysis/periodic_orbit.hpp"
#include "core/errors.hpp"
#include "core/largest_difference.hpp"
#include "studies/classification.hpp"

namespace epicyclic::claims {

using namespace studies;

namespace {

/// b of [P-lack].
double short_of(double level, double width, double to_doubling) {
  constexpr double half_distance = 0.4;  // d_0
  if (level > 0.0) return 0.5 * std::max(0.0, 1.0 - level / width);
  return 0.5 + 0.5 * to_doubling / (to_doubling + half_distance);
}

/// x of [P-lack].
double beyond(double growth) {
  constexpr double steepness = 20.0;  // k
  const double x = steepness * std::max(0.0, growth);
  return x / (1.0 + x);
}

constexpr double never = -20.0;  // h if no multiplier is negative: as far from a period doubling as an orbit can be

PeriodOne of_multipliers(const Eigen::VectorXcd& multipliers) {
  PeriodOne p;
  p.found = true;
  p.to_doubling = std::numeric_limits<double>::infinity();
  double largest = 0.0;
  double rest = 0.0;
  double least = 0.0;
  for (const std::complex<double>& mu : multipliers) {
    largest = std::max(largest, std::abs(mu));
    p.to_doubling = std::min(p.to_doubling, std::abs(mu + 1.0));
    if (mu.imag() != 0.0) continue;
    least = std::min(least, mu.real());
    p.fold = std::max(p.fold, mu.real());
  }
  for (const std::complex<double>& mu : multipliers)
    if (mu.imag() != 0.0 || mu.real() != least || least == 0.0) rest = std::max(rest, std::abs(mu));
  const auto logarithm = [](double x) { return x > 0.0 ? std::max(never, std::log(x)) : never; };
  p.growth = logarithm(largest);
  p.doubling = logarithm(-least);
  p.rest = logarithm(rest);
  return p;
}

/// Of the trajectory from the model's default start, the state that comes back nearest to itself.
std::optional<std::vector<double>> nearest_return(integrate::Flow& flow, const std::vector<double>& start) {
  constexpr int periods = 60;
  constexpr int transient = 20;
  std::vector<double> y = start;
  std::optional<std::vector<double>> nearest;
  double least = std::numeric_limits<double>::infinity();
  for (int k = 0; k < periods; ++k) {
    const std::vector<double> before = y;
    if (!flow.evolve(y, 0.0, flow.field().period).reached()) break;
    const double back = largest_difference(y, before);
    if (k < transient || !(back < least)) continue;
    least = back;
    nearest = y;
  }
  return nearest;
}

/// An orbit, and the value that it is at.
struct Place {
  double value = 0;
  std::vector<double> state;
};

/// Prediction of the orbit: along the line through the last two.
std::vector<double> ahead(const std::vector<Place>& places, double value) {
  std::vector<double> guess = places.back().state;
  if (places.size() < 2) return guess;
  const Place& a = places[places.size() - 2];
  const Place& b = places.back();
  const double part = (value - b.value) / (b.value - a.value);
  for (std::size_t i = 0; i < guess.size(); ++i) guess[i] += part * (b.state[i] - a.state[i]);
  return guess;
}

}  // namespace

std::optional<double> PeriodOne::lacks(std::string_view word) const {
  constexpr double width = 0.05;
  constexpr double of_chaos = 0.3;
  constexpr double unknown = 0.5;
  constexpr std::array<std::string_view, 5> others = {"not period 1", "not periodic", "multi-period", "quasiperiodic",
                                                      "aperiodic"};
  std::optional<double> lack;
  if (word == "period 1") lack = beyond(growth);
  if (word == "period 2") lack = 0.5 * (short_of(doubling, width, to_doubling) + beyond(rest));
  if (word == "chaotic") lack = short_of(growth, of_chaos, to_doubling);
  if (std::ranges::find(others, word) != others.end()) lack = short_of(growth, width, to_doubling);
  return lack && !found ? unknown : lack;
}

std::vector<PeriodOne> follow_period_one(std::span<const double> values, const ModelAt& model_at,
                                         const integrate::IntegratorOptions& integrator,
                                         const std::atomic<bool>* stop) {
  // A guess a little beside the orbit is enough: multipliers are wanted to a few digits.
  analysis::OrbitOptions options;
  options.iterations = 8;
  options.residual = 1e-6;
  options.known = 1e-3;
  options.keep_tangents = true;
  std::vector<PeriodOne> points(values.size());
  std::vector<Place> places;
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (stop != nullptr && stop->load()) break;
    const model::DynamicModel model = model_at(values[k]);
    if (!has_classification(model)) throw InputError(no_multipliers);
    // One trajectory per flow: lanes that have only one trajectory cost eight times as much.
    const auto flow = make_flow_of_one_trajectory(model, integrator);
    std::optional<analysis::PeriodicOrbit> orbit;
    const auto seek = [&](const std::vector<double>& from) {
      orbit = analysis::find_periodic_orbit(*flow, from, 1, options);
      if (!orbit->found()) orbit.reset();
      return orbit.has_value();
    };
    if (places.empty() || !seek(ahead(places, values[k]))) {
      flow->forget();
      if (const auto from = nearest_return(*flow, model.default_start)) seek(*from);
    }
    if (!orbit) continue;
    points[k] = of_multipliers(orbit->monodromy.eigenvalues());
    places.push_back({values[k], std::move(orbit->state)});
  }
  return points;
}

}  // namespace epicyclic::claims
