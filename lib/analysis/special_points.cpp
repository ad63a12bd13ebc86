#include "analysis/special_points.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

#include "analysis/contact_extrema.hpp"
#include "analysis/crossings.hpp"
#include "core/dense.hpp"
#include "core/errors.hpp"
#include "core/require.hpp"
#include "core/root_finding.hpp"

namespace epicyclic::analysis {

namespace {

/// With the direction of the branch.
Signs signs_of(const InvariantBlock& block, const BranchOrbit& orbit) {
  Signs s = signs_of(block, multipliers_of(block, orbit.monodromy));
  s.falling = block.symmetry_index == 0 && orbit.direction.value < 0.0;
  return s;
}

/// The one event between two orbits by what has changed.
/// @returns nothing if none; unresolved if it cannot be one alone
std::optional<SpecialKind> event_between(const InvariantBlock& block, const Signs& a, const Signs& b) {
  const std::optional<Crossing> crossing = crossing_between(block, a, b);
  if (!crossing) return std::nullopt;
  switch (*crossing) {
    case Crossing::plus:
      return a.falling != b.falling ? SpecialKind::fold : SpecialKind::branch_point;
    case Crossing::minus:
      return SpecialKind::period_doubling;
    case Crossing::pair:
      return SpecialKind::neimark_sacker;
    case Crossing::unresolved:
      break;
  }
  return SpecialKind::unresolved;
}

/// The multiplier that an event is about.
std::complex<double> critical(SpecialKind kind, const Multipliers& values, std::complex<double> expected) {
  switch (kind) {
    case SpecialKind::fold:
    case SpecialKind::branch_point:
      return nearest(values, 1.0);
    case SpecialKind::period_doubling:
      return nearest(values, -1.0);
    default:
      return nearest(values, expected);
  }
}

/// Something that is only known to be between two neighbours.
SpecialPoint between_neighbours(const BranchOrbit& a, const BranchOrbit& b, int symmetry_index, std::string note) {
  SpecialPoint point;
  point.value = 0.5 * (a.at.value + b.at.value);
  point.error_bound = std::abs(b.at.value - a.at.value);
  point.orbit = a;
  point.symmetry_index = symmetry_index;
  point.note = std::move(note);
  return point;
}

/// A surface that is grazed between two orbits.
struct Grazing {
  std::size_t surface = 0;
  bool least = false;
  bool rising = false;
};

/// One event in one block, or at one surface, between two orbits.
class Event {
 public:
  Event(const OrbitFamily& family, const Grazing& grazing, const BranchOrbit& a, const BranchOrbit& b,
        const SpecialOptions& options)
      : family_(family), kind_(SpecialKind::grazing), grazing_(grazing), a_(a), b_(b), options_(options) {}

  Event(const OrbitFamily& family, const InvariantBlock& block, SpecialKind kind, const BranchOrbit& a,
        const BranchOrbit& b, const SpecialOptions& options)
      : family_(family), block_(&block), kind_(kind), a_(a), b_(b), options_(options) {
    const Signs at_a = signs_of(block, a);
    const Signs at_b = signs_of(block, b);
    inside_ = std::min(at_a.outside, at_b.outside);
    outwards_ = at_b.outside > at_a.outside;
    crosses_here_ = kind == SpecialKind::branch_point && block.symmetry_index == 0;
    parameter_extremum_ = kind == SpecialKind::fold || (crosses_here_ && at_a.plus == at_b.plus);
  }

  SpecialPoint locate() {
    SpecialPoint point;
    point.kind = kind_;
    point.symmetry_index = block_ != nullptr ? block_->symmetry_index : 0;
    point.outwards = outwards_;
    point.surface = grazing_.surface;
    point.least = grazing_.least;
    point.rising = grazing_.rising;
    std::optional<Place> place;
    try {
      if (!crosses_here_) bracket();
      place = find(family_);
      if (!place) return unresolved("no orbit beside it");
      values_ = {place->value};
      rounding_ = place->rounding;
      angles_ = {std::abs(std::arg(place->multiplier))};
      spread_ = place->spread;
      for (const Refinement& other : options_.others) {
        OrbitFamily finer_family = family_;
        finer_family.flows = other.flows;
        finer_family.shooting_intervals *= other.shooting_intervals;
        if (const std::optional<Place> finer = find(finer_family)) {
          values_.push_back(finer->value);
          angles_.push_back(std::abs(std::arg(finer->multiplier)));
          spread_ = std::max(spread_, finer->spread);
          rounding_ = finer->rounding;
        } else {
          point.note = "one of the finer families found no orbit";
        }
      }
    } catch (const DomainError& e) {
      return unresolved(e.what());
    }
    point.value = values_.back();
    point.kind = kind_;
    point.nullity = nullity_;
    if (nullity_ > 1) point.note = "two multipliers with two eigenvectors cross together: parts that are alike";
    point.orbit = std::move(place->orbit);
    point.multiplier = place->multiplier;
    point.error_bound = bound();
    // A real multiplier of a block that stands for two comes as two real ones in the whole.
    constexpr double real = 1e-6;
    if (kind_ == SpecialKind::neimark_sacker && !block_->real) {
      if (std::abs(std::arg(point.multiplier)) < real) point.kind = SpecialKind::branch_point;
      if (std::numbers::pi - std::abs(std::arg(point.multiplier)) < real) point.kind = SpecialKind::period_doubling;
    }
    if (point.kind == SpecialKind::neimark_sacker) point.resonance = resonance();
    return point;
  }

 private:
  /// Where a family has it.
  struct Place {
    double value = 0;
    BranchOrbit orbit;
    std::complex<double> multiplier;
    double spread = 0;    ///< of the value by fewer orbits, where it is interpolated
    double rounding = 0;  ///< what rounding of the multiplier leaves of the value
  };

  [[nodiscard]] SpecialPoint unresolved(const std::string& note) const {
    return between_neighbours(a_, b_, block_ != nullptr ? block_->symmetry_index : 0, to_string(kind_) + ": " + note);
  }

  /// Has opposite signs on the two sides of the event, whatever else happens to the multipliers.
  [[nodiscard]] double sign_function(const BranchOrbit& orbit) const {
    if (kind_ == SpecialKind::grazing) return nearest_to_the_surface(family_, orbit);
    if (parameter_extremum_) return orbit.direction.value;
    // Of two that cross together no parity changes.
    const Crossing crossing = nullity_ > 1                            ? Crossing::pair
                              : kind_ == SpecialKind::branch_point    ? Crossing::plus
                              : kind_ == SpecialKind::period_doubling ? Crossing::minus
                                                                      : Crossing::pair;
    return analysis::sign_function(*block_, crossing, multipliers_of(*block_, orbit.monodromy), inside_);
  }

  /// Smooth at the event, by the multiplier that it is about.
  [[nodiscard]] double smooth_function(const OrbitFamily& family, const BranchOrbit& orbit) const {
    if (kind_ == SpecialKind::grazing) return nearest_to_the_surface(family, orbit);
    if (parameter_extremum_) return orbit.direction.value / family_.value_scale;
    const std::complex<double> x = critical(kind_, multipliers_of(*block_, orbit.monodromy), expected_);
    if (kind_ == SpecialKind::branch_point) return x.real() - 1.0;
    if (kind_ == SpecialKind::period_doubling) return x.real() + 1.0;
    return std::log(std::abs(x));
  }

  [[nodiscard]] double nearest_to_the_surface(const OrbitFamily& family, const BranchOrbit& orbit) const {
    const std::optional<double> value = contact_extremum(family, orbit.at, grazing_.surface, grazing_.least);
    if (!value) throw DomainError("the orbit could not be integrated to its contacts");
    return *value;
  }

  /// To a thousandth of the distance from a to b.
  void bracket() {
    constexpr double width = 1e-3;
    const auto function = [&](double part) {
      if (part == 0.0) return sign_function(a_);
      if (part == 1.0) return sign_function(b_);
      const Correction c = between(family_, a_, b_, part);
      if (!c.found) throw DomainError(c.message);
      near_ = c.orbit;
      return sign_function(c.orbit);
    };
    const double part = find_root(function, 0.0, 1.0, width);
    if (const Correction c = between(family_, a_, b_, part); c.found) near_ = c.orbit;
    if (block_ == nullptr) return;
    const Multipliers values = multipliers_of(*block_, near_.monodromy);
    expected_ = kind_ == SpecialKind::neimark_sacker ? values.at(inside_) : critical(kind_, values, 0.0);
    if (kind_ == SpecialKind::neimark_sacker && block_->real) classify_double();
  }

  /// Is it a pair, or are it two real ones of parts that are alike?
  void classify_double() {
    // They may be a thousandth of the distance from a to b away, and the second singular value as far from 0. A pair
    // that meets at +1 or -1 has one eigenvector there: the second singular value is of the order of 1.
    constexpr double near = 1e-2;
    for (const double at : {1.0, -1.0}) {
      if (!(std::abs(expected_ - at) < near)) continue;
      const Eigen::VectorXd s = singular_values(real_block_of(*block_, near_.monodromy).cyclic(at)).s;
      if (s.size() < 2 || !(s(s.size() - 2) < near)) continue;
      kind_ = at > 0.0 ? SpecialKind::branch_point : SpecialKind::period_doubling;
      nullity_ = 2;
      crosses_here_ = at > 0.0 && block_->symmetry_index == 0;
    }
  }

  [[nodiscard]] std::optional<Place> find(const OrbitFamily& family) const {
    return crosses_here_ ? from_beside(family) : polish(family);
  }

  /// The root of the smooth function along the branch, near near_.
  [[nodiscard]] std::optional<Place> polish(const OrbitFamily& family) const {
    const Correction base = recut(family, near_);
    if (!base.found) return std::nullopt;
    const CurvePoint normal = base.orbit.direction;
    const CurvePoint origin = base.orbit.at;
    Correction last;
    const auto at = [&](double s) -> std::optional<double> {
      last = s == 0.0 ? base : correct(family, origin + s * normal, normal);
      if (!last.found) return std::nullopt;
      return smooth_function(family, last.orbit);
    };
    const double span = length(family_, b_.at - a_.at);
    if (!secant_root(at, 1e-3 * span, span)) return std::nullopt;
    Place place{last.orbit.at.value, last.orbit, critical_of(last.orbit)};
    if (parameter_extremum_) return place;
    // A root that is resolved to 1e-11 of f leaves the same error to each family: by the slope to what f resolves.
    constexpr double resolved = 1e-11;
    const double here = smooth_function(family, place.orbit);
    const Correction beside = correct(family, place.orbit.at + (1e-3 * span) * normal, normal);
    if (!beside.found) return place;
    const double slope = (beside.orbit.at.value - place.value) / (smooth_function(family, beside.orbit) - here);
    if (!std::isfinite(slope)) return place;
    if (std::abs(here) < resolved) place.value -= here * slope;
    place.rounding = rounding_of(place, slope);
    return place;
  }

  /// What rounding leaves of the value.
  /// @param slope  dv / df
  [[nodiscard]] double rounding_of(const Place& place, double slope) const {
    if (block_ == nullptr) {
      // Of the state's sums over some hundred steps.
      constexpr double of_the_state = 1e-14;
      return of_the_state * place.orbit.at.states.lpNorm<Eigen::Infinity>() * std::abs(slope);
    }
    const Multipliers values = multipliers_of(*block_, place.orbit.monodromy);
    const std::vector<double> errors = multiplier_errors(*block_, place.orbit.monodromy);
    const auto at = std::find(values.begin(), values.end(), nearest(values, place.multiplier));
    const double rounding = errors[static_cast<std::size_t>(at - values.begin())] * std::abs(slope);
    return std::isnan(rounding) ? std::numeric_limits<double>::infinity() : rounding;
  }

  /// An orbit by another subdivision, whose direction at the new cuts is that between two orbits.
  [[nodiscard]] static Correction recut(const OrbitFamily& family, const BranchOrbit& orbit) {
    if (orbit.at.states.cols() == family.shooting_intervals) return correct(family, orbit.at, orbit.direction);
    constexpr double little = 1e-4;
    const std::optional<CurvePoint> at = split_into_intervals(family, orbit.at.states.col(0), orbit.at.value);
    const CurvePoint beyond = orbit.at + little * orbit.direction;
    const std::optional<CurvePoint> ahead = split_into_intervals(family, beyond.states.col(0), beyond.value);
    if (!at || !ahead) return {};
    return correct(family, *at, (1.0 / little) * (*ahead - *at));
  }

  /// At a crossing of branches, the orbits of both are solutions, and the equations are singular. The place follows
  /// from three orbits on each side.
  [[nodiscard]] std::optional<Place> from_beside(const OrbitFamily& family) const {
    const Correction a = recut(family, a_);
    const Correction b = recut(family, b_);
    if (!a.found || !b.found) return std::nullopt;
    constexpr double apart = 0.05;  // in parts of the distance from a to b
    constexpr std::array<double, 6> beside = {-3.0 * apart, -2.0 * apart, -apart, apart, 2.0 * apart, 3.0 * apart};
    const double at_a = sign_function(a_);
    double root = at_a / (at_a - sign_function(b_));
    constexpr int iterations = 6;
    for (int k = 0; k < iterations; ++k) {
      std::array<BranchOrbit, 6> orbits;
      std::array<double, 6> f;
      for (std::size_t i = 0; i < beside.size(); ++i) {
        Correction c = between(family, a.orbit, b.orbit, root + beside[i]);
        if (!c.found) return std::nullopt;
        f[i] = smooth_function(family, c.orbit);
        orbits[i] = std::move(c.orbit);
      }
      const std::array<double, 6> to_zero = lagrange(f, 0.0);
      double step = 0.0;
      for (std::size_t i = 0; i < beside.size(); ++i) step += to_zero[i] * beside[i];
      if (!(std::abs(step) < 1.0)) return std::nullopt;
      if (std::abs(step) < 0.1 * apart) {
        Place place = interpolated(orbits, lagrange(beside, step));
        for (const bool inner : {true, false})
          place.spread = std::max(place.spread, std::abs(by_four(orbits, f, inner) - place.value));
        if (!parameter_extremum_)
          place.rounding = rounding_of(place, (orbits[5].at.value - orbits[0].at.value) / (f[5] - f[0]));
        return place;
      }
      root += step;
    }
    return std::nullopt;
  }

  /// The value where f is 0 by four of the orbits alone: the inner ones, nearest to the singularity, or the outer ones.
  static double by_four(const std::array<BranchOrbit, 6>& orbits, const std::array<double, 6>& f, bool inner) {
    const std::array<std::size_t, 4> of =
        inner ? std::array<std::size_t, 4>{1, 2, 3, 4} : std::array<std::size_t, 4>{0, 1, 4, 5};
    double value = 0.0;
    for (const std::size_t i : of) {
      double weight = 1.0;
      for (const std::size_t j : of)
        if (j != i) weight *= f[j] / (f[j] - f[i]);
      value += weight * orbits[i].at.value;
    }
    return value;
  }

  /// Weights of Lagrange's polynomial through places, at x.
  static std::array<double, 6> lagrange(const std::array<double, 6>& places, double x) {
    std::array<double, 6> weights;
    for (std::size_t i = 0; i < places.size(); ++i) {
      weights[i] = 1.0;
      for (std::size_t j = 0; j < places.size(); ++j)
        if (j != i) weights[i] *= (x - places[j]) / (places[i] - places[j]);
    }
    return weights;
  }

  [[nodiscard]] Place interpolated(const std::array<BranchOrbit, 6>& orbits,
                                   const std::array<double, 6>& weights) const {
    BranchOrbit o = orbits[0];
    o.at = 0.0 * o.at;
    o.direction = 0.0 * o.direction;
    for (Eigen::MatrixXd& m : o.monodromy.factors) m.setZero();
    for (std::size_t i = 0; i < orbits.size(); ++i) {
      o.at = o.at + weights[i] * orbits[i].at;
      o.direction = o.direction + weights[i] * orbits[i].direction;
      for (std::size_t k = 0; k < o.monodromy.factors.size(); ++k)
        o.monodromy.factors[k] += weights[i] * orbits[i].monodromy.factors[k];
      o.residual = std::max(o.residual, orbits[i].residual);
    }
    return {o.at.value, o, critical_of(o)};
  }

  [[nodiscard]] std::complex<double> critical_of(const BranchOrbit& orbit) const {
    if (block_ == nullptr) return 0.0;
    return critical(kind_, multipliers_of(*block_, orbit.monodromy), expected_);
  }

  /// [A-resonance]
  [[nodiscard]] int resonance() const {
    if (angles_.size() < 2) return 0;
    double most = 0.0;
    for (const double a : angles_) most = std::max(most, std::abs(a - angles_.back()));
    constexpr double rounding = 1e-12;  // of multipliers of modulus 1 from matrices of some dozens
    constexpr int weakest = 4;
    for (int k = 1; k <= weakest; ++k) {
      // 1:1 is the angle 0.
      const double angle = k == 1 ? 0.0 : 2.0 * std::numbers::pi / k;
      if (std::abs(angles_.back() - angle) <= options_.safety * most + rounding) return k;
    }
    return 0;
  }

  [[nodiscard]] double bound() const {
    if (values_.size() < 2) return std::numeric_limits<double>::infinity();
    double most = 0.0;
    // A family that found nothing has no value; what is left has to be enough.
    constexpr std::size_t enough = 4;
    const std::size_t first = options_.branch_counts || values_.size() < enough ? 0 : 1;
    for (std::size_t k = first; k < values_.size(); ++k) most = std::max(most, std::abs(values_[k] - values_.back()));
    constexpr double rounding = 1e-14;
    return options_.safety * (most + spread_) + rounding_ + rounding * std::abs(values_.back());
  }

  const OrbitFamily& family_;
  const InvariantBlock* block_ = nullptr;  ///< none of a grazing
  SpecialKind kind_;
  Grazing grazing_{};
  const BranchOrbit& a_;
  const BranchOrbit& b_;
  const SpecialOptions& options_;
  std::size_t inside_ = 0;
  bool outwards_ = false;
  bool crosses_here_ = false;        ///< another branch, among the orbits that Newton's method finds
  bool parameter_extremum_ = false;  ///< the parameter has an extremum here
  BranchOrbit near_;
  std::complex<double> expected_;
  std::vector<double> values_, angles_;  ///< of the family and finer ones; angles without sign
  double spread_ = 0, rounding_ = 0;
  int nullity_ = 1;
};

/// Is an extremum of the parameter without a crossing a pitchfork, seen from the branch that begins there? The
/// multiplier touches 1 there and is on one side before and behind. Otherwise a fold stands beside a branch point.
bool parameter_extremum_at_pitchfork(const OrbitFamily& family, const InvariantBlock& block, const BranchOrbit& a,
                                     const BranchOrbit& b) {
  const Signs at_a = signs_of(block, a);
  const Signs at_b = signs_of(block, b);
  if (at_a.falling == at_b.falling || at_a.plus != at_b.plus || at_a.minus != at_b.minus ||
      at_a.outside != at_b.outside)
    return false;
  const double root = a.direction.value / (a.direction.value - b.direction.value);
  // So far from the extremum that the multiplier is clear of 1.
  constexpr double aside = 0.15;
  const Correction before = between(family, a, b, root - aside);
  const Correction behind = between(family, a, b, root + aside);
  if (!before.found || !behind.found) return false;
  const Signs left = signs_of(block, before.orbit);
  const Signs right = signs_of(block, behind.orbit);
  return left.falling == at_a.falling && right.falling == at_b.falling && left.plus == at_a.plus &&
         right.plus == at_a.plus;
}

/// Are as many other multipliers beyond the unit circle at an event as on the better side of it? If not, another event
/// lies between the two orbits: a period doubling inwards and a torus outwards have the counts of a period doubling
/// outwards.
bool is_the_only_one(const InvariantBlock& block, SpecialKind kind, const SpecialPoint& point, const BranchOrbit& a,
                     const BranchOrbit& b) {
  const Signs at_a = signs_of(block, a);
  const Signs at_b = signs_of(block, b);
  // At an extremum of the parameter without a crossing, the multiplier is on the same side before and behind.
  if (at_a.outside == at_b.outside) return true;
  Multipliers others = multipliers_of(block, point.orbit.monodromy);
  const auto leave_out = [&](std::complex<double> critical) {
    others.erase(std::find(others.begin(), others.end(), nearest(others, critical)));
  };
  leave_out(point.multiplier);
  if (kind == SpecialKind::neimark_sacker && block.real) leave_out(std::conj(point.multiplier));
  return signs_of(block, others).outside == std::min(at_a.outside, at_b.outside);
}

/// Do some multipliers leave the unit circle while others come in?
bool cross_in_both_directions(const InvariantBlock& block, const BranchOrbit& a, const BranchOrbit& b) {
  const Passages p = passages_between(multipliers_of(block, a.monodromy), multipliers_of(block, b.monodromy));
  return p.outwards > 0 && p.inwards > 0;
}

/// Is a pair that seems to cross the unit circle on it at both neighbours, to within what a finer family changes of it?
bool stays_on_the_circle(const OrbitFamily& family, const InvariantBlock& block, const BranchOrbit& a,
                         const BranchOrbit& b, const SpecialOptions& options) {
  const std::size_t inside = std::min(signs_of(block, a).outside, signs_of(block, b).outside);
  for (const BranchOrbit* orbit : {&a, &b}) {
    const Multipliers values = multipliers_of(block, orbit->monodromy);
    const std::complex<double> x = values.at(inside);
    double error = multiplier_errors(block, orbit->monodromy)[inside];
    for (const Refinement& other : options.others) {
      OrbitFamily finer = family;
      finer.flows = other.flows;
      // With the same shooting intervals: the states are those at their beginnings.
      if (const Correction c = correct(finer, orbit->at, orbit->direction); c.found)
        error = std::max(error, std::abs(nearest(multipliers_of(block, c.orbit.monodromy), x) - x));
    }
    if (!(std::abs(std::abs(x) - 1.0) <= options.safety * error)) return false;
  }
  return true;
}

/// All events in one block, the part halved until each is alone.
void find_events(const OrbitFamily& family, const InvariantBlock& block, const BranchOrbit& a, const BranchOrbit& b,
                 const SpecialOptions& options, int halvings, std::vector<SpecialPoint>& found) {
  std::optional<SpecialKind> kind = event_between(block, signs_of(block, a), signs_of(block, b));
  const bool both_directions = cross_in_both_directions(block, a, b);
  if (!kind && !both_directions) return;
  if (kind == SpecialKind::neimark_sacker && !both_directions && stays_on_the_circle(family, block, a, b, options))
    return;
  if (kind && parameter_extremum_at_pitchfork(family, block, a, b)) kind = SpecialKind::branch_point;
  std::optional<SpecialPoint> one;
  if (kind && *kind != SpecialKind::unresolved && !both_directions) {
    one = Event(family, block, *kind, a, b, options).locate();
    if (one->kind == SpecialKind::unresolved || is_the_only_one(block, *kind, *one, a, b)) {
      found.push_back(std::move(*one));
      return;
    }
  }
  const Correction middle = halvings > 0 ? between(family, a, b, 0.5) : Correction{};
  if (middle.found) {
    find_events(family, block, a, middle.orbit, options, halvings - 1, found);
    find_events(family, block, middle.orbit, b, options, halvings - 1, found);
    return;
  }
  if (one) found.push_back(std::move(*one));
  found.push_back(between_neighbours(a, b, block.symmetry_index, "several events that could not be parted"));
}

/// Surfaces that are grazed between two orbits.
void find_grazings(const OrbitFamily& family, const BranchOrbit& a, const BranchOrbit& b, const SpecialOptions& options,
                   std::vector<SpecialPoint>& found) {
  const auto at_a = contact_extrema(family, a.at);
  const auto at_b = contact_extrema(family, b.at);
  if (!at_a || !at_b) {
    found.push_back(between_neighbours(a, b, 0, "the contacts could not be computed"));
    return;
  }
  for (const bool least : {true, false}) {
    const std::vector<double>& before = least ? at_a->least : at_a->greatest;
    const std::vector<double>& behind = least ? at_b->least : at_b->greatest;
    for (std::size_t k = 0; k < before.size(); ++k)
      // Infinite: there is no such surface, at one of them or at both.
      if ((before[k] > 0.0) != (behind[k] > 0.0) && std::isfinite(before[k]) && std::isfinite(behind[k]))
        found.push_back(Event(family, Grazing{k, least, behind[k] > before[k]}, a, b, options).locate());
  }
}

}  // namespace

std::string to_string(SpecialKind kind) {
  switch (kind) {
    case SpecialKind::fold:
      return "fold";
    case SpecialKind::branch_point:
      return "branch_point";
    case SpecialKind::period_doubling:
      return "flip";
    case SpecialKind::neimark_sacker:
      return "neimark_sacker";
    case SpecialKind::grazing:
      return "grazing";
    case SpecialKind::unresolved:
      break;
  }
  return "unresolved";
}

void SpecialOptions::validate() const {
  require(safety >= 1.0, "safety", safety, ">= 1");
  require(branch_counts || others.size() >= 3, "others", static_cast<double>(others.size()),
          ">= 3 where the branch's own value does not count");
}

std::vector<SpecialPoint> special_points_between(const OrbitFamily& family, const BranchOrbit& a, const BranchOrbit& b,
                                                 const SpecialOptions& options) {
  options.validate();
  // After this number of halvings, neighbours differ by 1e-6 of their distance.
  constexpr int halvings = 20;
  std::vector<SpecialPoint> found;
  for (const InvariantBlock& block : invariant_blocks(static_cast<std::size_t>(a.at.states.rows()), family.kept()))
    find_events(family, block, a, b, options, halvings, found);
  find_grazings(family, a, b, options, found);
  const auto along = [&](const SpecialPoint& p) { return inner_product(family, p.orbit.at - a.at, a.direction); };
  std::stable_sort(found.begin(), found.end(),
                   [&](const SpecialPoint& p, const SpecialPoint& q) { return along(p) < along(q); });
  return found;
}

}  // namespace epicyclic::analysis
