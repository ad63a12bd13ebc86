#include "gear/loaded_contact.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <utility>

#include <Eigen/Core>

#include "core/errors.hpp"
#include "core/quadrature.hpp"

namespace epicyclic::gear {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double two_pi = 2.0 * std::numbers::pi;
// Kinks that are nearer are one: rows between them would be too near to each other.
constexpr double phase_resolution = 1e-7;

/// inv alpha of the involute at a radius, and its length of roll; the latter infinite inside the base circle.
struct InvolutePoint {
  double roll_mm, involute;
  InvolutePoint(double radius_mm, double base_radius_mm) {
    const double square = radius_mm * radius_mm - base_radius_mm * base_radius_mm;
    roll_mm = square >= 0.0 ? std::sqrt(square) : infinite;
    involute = roll_mm / base_radius_mm - std::atan(roll_mm / base_radius_mm);
  }
};

double in_period(double phase) { return phase - std::floor(phase); }

/// Where a property of the phase changes that is true at `low` and false at `high`.
template <class F>
double place_of_change(const F& holds, double low, double high) {
  constexpr int halvings = 60;
  for (int k = 0; k < halvings; ++k) {
    const double middle = 0.5 * (low + high);
    (holds(middle) ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace

double LoadedContact::Profile::at(double arm_mm) const {
  const double x = std::clamp((arm_mm - from) / (to - from), 0.0, 1.0);
  if (shape == ReliefShape::linear) return amount_um * x;
  if (shape == ReliefShape::parabolic) return amount_um * x * x;
  const double amount_mm = 1e-3 * amount_um;
  const double s = x * (to - from);
  const double radius = ((to - from) * (to - from) + amount_mm * amount_mm) / (2.0 * amount_mm);
  return amount_mm == 0.0 ? 0.0 : 1e3 * s * s / (radius + std::sqrt(radius * radius - s * s));
}

LoadedContact::Flank LoadedContact::flank(const GearData& data, const Tooth& tooth, double tip_arm_mm,
                                          double lowest_arm_mm) {
  Flank profiles;
  const auto add = [&](const std::optional<Relief>& relief, const std::string& name, double end_mm, double other_mm) {
    if (!relief) return;
    double from = relief->start_roll_mm.value_or(0.0);
    if (relief->start_diameter_mm) {
      from = InvolutePoint(0.5 * *relief->start_diameter_mm, tooth.base_radius_mm).roll_mm;
      if (!std::isfinite(from))
        throw DomainError("the " + name + " starts at " + std::to_string(*relief->start_diameter_mm) +
                          " mm, inside the base circle of " + std::to_string(2.0 * tooth.base_radius_mm) + " mm");
    }
    if (!((end_mm - from) * (end_mm - other_mm) > 0.0))
      throw DomainError("the " + name + " starts at a length of roll of " + std::to_string(from) +
                        " mm, not before its end at " + std::to_string(end_mm) + " mm (diameter " +
                        std::to_string(2.0 * std::hypot(end_mm, tooth.base_radius_mm)) + " mm)");
    profiles.push_back({from, end_mm, relief->amount_um, relief->shape});
  };
  add(data.tip_relief, "tip relief", tip_arm_mm, lowest_arm_mm);
  add(data.root_relief, "root relief", lowest_arm_mm, tip_arm_mm);
  return profiles;
}

LoadedContact::LoadedContact(const MeshedPair& mesh, const GearData& first, const GearData& second, double force_N)
    : pair_(mesh.pair),
      first_(flank(first, pair_.driving, pair_.end_mm, pair_.start_mm)),
      second_(flank(second, pair_.driven, pair_.arm_2_mm(pair_.start_mm), pair_.arm_2_mm(pair_.end_mm))),
      force_N_(force_N) {
  const double width = mesh.face_width_mm();
  for (const auto& [data, tooth] : {std::pair(&first, &mesh.driving.tooth), std::pair(&second, &mesh.driven.tooth)}) {
    const double ratio = width / tooth->width_mm;
    crowning_um_ += data->crowning_um.value_or(0.0) * ratio * ratio;  // [G-crown]
  }
  constexpr int intervals = 40;
  for (int k = 0; k <= intervals; ++k) {
    nodes_.push_back(0.5 * pair_.contact_ratio() * (1.0 - std::cos(std::numbers::pi * k / intervals)));
    values_.push_back(mesh.pair_stiffness(nodes_.back()));
  }
  breakpoints_ = breakpoints(force_N);
}

double LoadedContact::relief_um(const Flank& flank, double arm_mm) {
  double sum = 0.0;
  for (const Profile& profile : flank) sum += profile.at(arm_mm);
  return sum;
}

double LoadedContact::gap_before_um(double l) const {
  const Tooth& one = pair_.driving;
  const Tooth& two = pair_.driven;
  const double n = pair_.theoretical_length_mm;
  const InvolutePoint tip(two.tip_radius_mm, two.base_radius_mm);
  const double side = pair_.internal() ? 1.0 : -1.0;
  const double beta = side * (pair_.arm_2_mm(l) / two.base_radius_mm - tip.involute);
  // From the axis of gear 1: along the line of action, and towards N_1.
  const double x = -side * n + two.tip_radius_mm * std::sin(beta);
  const double y = one.base_radius_mm - side * (two.base_radius_mm - two.tip_radius_mm * std::cos(beta));
  const InvolutePoint contact(std::hypot(x, y), one.base_radius_mm);
  if (!std::isfinite(contact.roll_mm)) return infinite;
  const double separation_mm = one.base_radius_mm * (std::atan2(x, y) + contact.involute) - l;
  return 1e3 * separation_mm + relief_um(second_, tip.roll_mm) + relief_um(first_, contact.roll_mm);
}

double LoadedContact::gap_behind_um(double l) const {
  const Tooth& one = pair_.driving;
  const Tooth& two = pair_.driven;
  const double n = pair_.theoretical_length_mm;
  const InvolutePoint tip(one.tip_radius_mm, one.base_radius_mm);
  const double side = pair_.internal() ? 1.0 : -1.0;
  const double beta_1 = l / one.base_radius_mm - tip.involute;
  // From the axis of gear 2: along the line of action, and towards N_2.
  const double x = one.tip_radius_mm * std::sin(beta_1) + side * n;
  const double y = two.base_radius_mm + side * (one.tip_radius_mm * std::cos(beta_1) - one.base_radius_mm);
  const InvolutePoint contact(std::hypot(x, y), two.base_radius_mm);
  if (!std::isfinite(contact.roll_mm)) return infinite;
  const double separation_mm =
      side * (pair_.arm_2_mm(l) - two.base_radius_mm * (contact.involute + side * std::atan2(x, y)));
  return 1e3 * separation_mm + relief_um(first_, tip.roll_mm) + relief_um(second_, contact.roll_mm);
}

double LoadedContact::gap_um(double position) const {
  const double l = pair_.start_mm + position * pair_.base_pitch_mm;
  if (position < 0.0) return gap_before_um(l);
  if (position > pair_.contact_ratio()) return gap_behind_um(l);
  return relief_um(first_, l) + relief_um(second_, pair_.arm_2_mm(l));
}

double LoadedContact::pair_stiffness(double position) const {
  // Barycentric formula of Chebyshev's points of the second kind (Berrut and Trefethen, SIAM Rev. 46 (2004) 501).
  const double x = std::clamp(position, 0.0, pair_.contact_ratio());
  double sum = 0.0;
  double weights = 0.0;
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    if (x == nodes_[k]) return values_[k];
    const double end = k == 0 || k + 1 == nodes_.size() ? 0.5 : 1.0;
    const double weight = (k % 2 == 0 ? end : -end) / (x - nodes_[k]);
    sum += weight * values_[k];
    weights += weight;
  }
  return sum / weights;
}

double LoadedContact::closure_um(double d) const {
  if (d <= 0.0) return 0.0;
  return d >= crowning_um_ ? d - crowning_um_ / 3.0 : 2.0 / 3.0 * d * std::sqrt(d / crowning_um_);
}

double LoadedContact::contact_width_ratio(double d) const {
  if (d <= 0.0) return 0.0;
  return d >= crowning_um_ ? 1.0 : std::sqrt(d / crowning_um_);
}

std::vector<LoadedContact::State> LoadedContact::pairs(double phase) const {
  std::vector<State> all;
  for (int j = -1; j <= static_cast<int>(pair_.contact_ratio()) + 1; ++j)
    all.push_back({phase + j, gap_um(phase + j), 1e-6 * pair_stiffness(phase + j)});
  return all;
}

double LoadedContact::deflection_um(const std::vector<State>& pairs, double force_N) const {
  const auto nearest =
      std::min_element(pairs.begin(), pairs.end(), [](const State& a, const State& b) { return a.gap_um < b.gap_um; });
  if (force_N == 0.0) return nearest->gap_um;
  // The force is a convex function of delta: Newton's method from above falls to the root. Without crowning the force
  // is piecewise linear, and the steps are finite in number.
  double delta = nearest->gap_um + crowning_um_ + force_N / nearest->stiffness_N_per_um;
  constexpr int most_steps = 100;
  constexpr double rounding = 1e-15;
  for (int step = 0; step < most_steps; ++step) {
    double off = -force_N;
    double slope = 0.0;
    for (const State& p : pairs) {
      off += p.stiffness_N_per_um * closure_um(delta - p.gap_um);
      slope += p.stiffness_N_per_um * contact_width_ratio(delta - p.gap_um);
    }
    const double by = off / slope;
    delta -= by;
    if (!(by > rounding * delta)) break;
  }
  return delta;
}

double LoadedContact::no_load_error_um(double phase) const { return deflection_um(pairs(phase), 0.0); }

double LoadedContact::transmission_error_um(double phase, double force_N) const {
  return deflection_um(pairs(phase), force_N);
}

std::vector<PairLoad> LoadedContact::pair_loads(double phase, double force_N) const {
  const std::vector<State> all = pairs(phase);
  const double delta = deflection_um(all, force_N);
  std::vector<PairLoad> loads;
  for (const State& p : all)
    if (delta > p.gap_um) loads.push_back({p.position, p.stiffness_N_per_um * closure_um(delta - p.gap_um)});
  return loads;
}

double LoadedContact::stiffness(double phase) const {
  const std::vector<State> all = pairs(in_period(phase));
  return 1e6 * force_N_ / (deflection_um(all, force_N_) - deflection_um(all, 0.0));
}

double LoadedContact::load_share(double position) const {
  for (const PairLoad& load : pair_loads(in_period(position), force_N_))
    if (std::abs(load.position - position) < 0.5) return std::min(load.force_N / force_N_, 1.0);  // but for rounding
  return 0.0;
}

std::vector<double> LoadedContact::breakpoints(double force_N) const {
  std::vector<double> phases = {0.0, in_period(pair_.contact_ratio())};
  const auto add_starts = [&](const Flank& flank, auto arm_1_of) {
    for (const Profile& profile : flank) {
      const double position = (arm_1_of(profile.from) - pair_.start_mm) / pair_.base_pitch_mm;
      if (position > 0.0 && position < pair_.contact_ratio()) phases.push_back(in_period(position));
    }
  };
  add_starts(first_, [](double arm) { return arm; });
  add_starts(second_, [&](double arm) {
    return pair_.internal() ? arm - pair_.theoretical_length_mm : pair_.theoretical_length_mm - arm;
  });
  const auto sort = [&phases] {
    std::sort(phases.begin(), phases.end());
    phases.erase(std::unique(phases.begin(), phases.end(), [](double a, double b) { return b - a < phase_resolution; }),
                 phases.end());
    while (phases.size() > 1 && phases.back() > 1.0 - phase_resolution) phases.pop_back();
  };
  sort();

  // Changes of the pairs that bear and, without load, of the one that touches.
  struct Touch {
    std::vector<bool> bears;
    std::size_t nearest;
  };
  // Of two pairs that touch, the one that did before counts.
  const auto touch_at = [&](double phase, std::size_t nearest) {
    constexpr double rounding_um = 1e-9;
    const std::vector<State> all = pairs(phase);
    const double delta = deflection_um(all, force_N);
    const double nearest_gap_um = deflection_um(all, 0.0);
    Touch touch{{}, nearest};
    for (std::size_t j = 0; j < all.size(); ++j) {
      touch.bears.push_back(delta > all[j].gap_um);
      if (all[j].gap_um == nearest_gap_um && all[nearest].gap_um > nearest_gap_um + rounding_um) touch.nearest = j;
    }
    return touch;
  };
  const std::vector<double> parts = phases;
  constexpr int samples = 48;
  for (std::size_t k = 0; k < parts.size(); ++k) {
    const double to = k + 1 < parts.size() ? parts[k + 1] : 1.0;
    double low = parts[k];
    Touch before = touch_at(low, 0);
    for (int i = 1; i <= samples; ++i) {
      const double high = parts[k] + (to - parts[k]) * i / samples;
      const Touch behind = touch_at(high, before.nearest);
      for (std::size_t j = 0; j < before.bears.size(); ++j)
        if (before.bears[j] != behind.bears[j] && force_N > 0.0)
          phases.push_back(
              place_of_change([&](double phase) { return touch_at(phase, 0).bears[j] == before.bears[j]; }, low, high));
      if (before.nearest != behind.nearest)
        phases.push_back(place_of_change(
            [&](double phase) {
              const std::vector<State> all = pairs(phase);
              return all[before.nearest].gap_um <= all[behind.nearest].gap_um;
            },
            low, high));
      low = high;
      before = behind;
    }
  }
  sort();
  return phases;
}

namespace {

/// @param at  value [um] at a phase, within the part of another phase
template <class F>
TransmissionError over_period(const std::vector<double>& breaks, const F& at) {
  using Harmonics = Eigen::Array<double, 7, 1>;  // 1, cosines and sines
  double least = infinite;
  double greatest = -infinite;
  Harmonics sum = Harmonics::Zero();
  constexpr int panels = 2;
  for (std::size_t k = 0; k < breaks.size(); ++k) {
    const double to = k + 1 < breaks.size() ? breaks[k + 1] : 1.0;
    const auto value_at = [&](double phase) {
      const double value = at(phase, 0.5 * (breaks[k] + to));
      least = std::min(least, value);
      greatest = std::max(greatest, value);
      return value;
    };
    for (const double end : {breaks[k], to}) (void)value_at(end);
    sum += gauss_legendre_16().integrate(
        [&](double phase) -> Harmonics {
          const double value = value_at(phase);
          Harmonics f;
          f[0] = value;
          for (int h = 1; h <= 3; ++h) {
            f[2 * h - 1] = 2.0 * value * std::cos(two_pi * h * phase);
            f[2 * h] = 2.0 * value * std::sin(two_pi * h * phase);
          }
          return f;
        },
        breaks[k], to, panels);
  }
  TransmissionError result;
  result.mean_um = sum[0];
  for (int h = 1; h <= 3; ++h)
    result.harmonic_um[static_cast<std::size_t>(h - 1)] = std::hypot(sum[2 * h - 1], sum[2 * h]);
  result.peak_to_peak_um = greatest - least;
  return result;
}

}  // namespace

TransmissionError transmission_error(const LoadedContact& contact, double force_N) {
  const std::vector<double> breaks = contact.breakpoints(force_N);
  TransmissionError error =
      over_period(breaks, [&](double phase, double) { return contact.transmission_error_um(phase, force_N); });
  for (std::size_t k = 0; k < breaks.size(); ++k) {
    const double to = k + 1 < breaks.size() ? breaks[k + 1] : 1.0;
    const double middle = 0.5 * (breaks[k] + to);
    error.contact_ratio += (to - breaks[k]) * static_cast<double>(contact.pair_loads(middle, force_N).size());
  }
  return error;
}

TransmissionError linear_transmission_error(const MeshedPair& mesh, double force_N) {
  TransmissionError error = over_period(mesh.breakpoints(), [&](double phase, double inside) {
    const double without_load_um = mesh.loaded ? mesh.loaded->no_load_error_um(phase) : 0.0;
    return without_load_um + 1e6 * force_N / mesh.stiffness(phase, inside);
  });
  error.contact_ratio = mesh.contact_ratio();
  return error;
}

}  // namespace epicyclic::gear
