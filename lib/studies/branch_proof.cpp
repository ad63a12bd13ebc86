#include "studies/branch_proof.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <span>
#include <tuple>
#include <utility>

#include <Eigen/Core>

#include "core/require.hpp"
#include "core/text.hpp"

namespace epicyclic::studies {

namespace {

using analysis::Branch;
using analysis::BranchOrbit;
using analysis::SpecialKind;

constexpr double infinite = std::numeric_limits<double>::infinity();

/// The orbit of a branch at a value between two neighbours, as states at the beginnings of its periods.
class OrbitsAt {
 public:
  explicit OrbitsAt(const TracedBranches& traced) : traced_(traced) {}

  /// @returns no columns if Newton's method finds none
  const Eigen::MatrixXd& states(std::size_t branch, std::size_t after, double value) {
    const auto [known, is_new] = known_.try_emplace({branch, after, value});
    if (is_new) known->second = find(traced_.branches[branch], after, value);
    return known->second;
  }

 private:
  static Eigen::MatrixXd find(const Branch& branch, std::size_t after, double value) {
    const BranchOrbit& a = branch.orbits[after];
    const BranchOrbit& b = branch.orbits[after + 1];
    const double part = (value - a.at.value) / (b.at.value - a.at.value);
    const analysis::Correction c = correct_at(branch.family, value, (1.0 - part) * a.at.states + part * b.at.states);
    if (!c.found) return {a.at.states.rows(), 0};
    return period_states(branch.family, c.orbit.at);
  }

  const TracedBranches& traced_;
  std::map<std::tuple<std::size_t, std::size_t, double>, Eigen::MatrixXd> known_;
};

/// A state of the point's orbit, or the last one of its section.
Eigen::VectorXd state_of(const PointResult& point, std::size_t dimension) {
  Eigen::VectorXd state(static_cast<Eigen::Index>(dimension));
  if (point.orbit.size() >= dimension) {
    std::copy_n(point.orbit.begin(), dimension, state.data());
    return state;
  }
  if (point.poincare_rows() == 0) return {};
  std::copy_n(point.poincare.end() - static_cast<std::ptrdiff_t>(point.poincare_columns), dimension, state.data());
  return state;
}

/// How far a state is from the nearest of an orbit's, or of its images.
double distance_to_orbit(const Eigen::VectorXd& state, const Eigen::MatrixXd& orbit,
                         const analysis::CyclicSymmetry& symmetry) {
  double least = infinite;
  for (Eigen::Index k = 0; k < orbit.cols(); ++k)
    least = std::min(least, image_distance(state, orbit.col(k), symmetry));
  return least;
}

/// States at the beginnings of the periods from the branch's rows, between two neighbours.
Eigen::MatrixXd rough_states(const std::vector<BranchRow>& rows, std::size_t after, double value,
                             std::size_t dimension) {
  const BranchRow& a = rows[after];
  const BranchRow& b = rows[after + 1];
  const int n = a.period;
  Eigen::MatrixXd states(static_cast<Eigen::Index>(dimension), n);
  if (a.section.empty() || a.section.size() != b.section.size()) return {states.rows(), 0};
  const std::size_t columns = a.section.size() / static_cast<std::size_t>(n);
  const double part = (value - a.value) / (b.value - a.value);
  for (Eigen::Index k = 0; k < n; ++k)
    for (std::size_t j = 0; j < dimension; ++j) {
      const std::size_t at = static_cast<std::size_t>(k) * columns + j;
      states(static_cast<Eigen::Index>(j), k) = (1.0 - part) * a.section[at] + part * b.section[at];
    }
  return states;
}

bool holds(double a, double b, double value) { return value >= std::min(a, b) && value <= std::max(a, b); }

/// The stretches of branches: from one fold in the parameter to the next.
class Stretches {
 public:
  explicit Stretches(const TracedBranches& traced) : traced_(traced) {
    for (std::size_t b = 0; b < traced.rows.size(); ++b) {
      const std::vector<BranchRow>& rows = traced.rows[b];
      std::vector<std::size_t>& numbers = of_.emplace_back();
      bool rises = false;
      for (std::size_t k = 0; k + 1 < rows.size(); ++k) {
        const double step = rows[k + 1].value - rows[k].value;
        const bool reverses = step != 0.0 && !numbers.empty() && (step > 0.0) != rises;
        numbers.push_back(numbers.empty() ? 0 : numbers.back() + (reverses ? 1 : 0));
        if (step != 0.0) rises = step > 0.0;
      }
      // The first stretch of a closed branch begins before its first orbit, unless that orbit is at a fold.
      if (traced.branches[b].last.end != analysis::BranchEnd::closed || numbers.empty() || numbers.back() % 2 != 0)
        continue;
      const std::size_t last = numbers.back();
      std::ranges::replace(numbers, last, std::size_t{0});
    }
  }

  /// Do both places lie on one stretch, without a fold between them?
  [[nodiscard]] bool shared(const SweepPlace& a, const SweepPlace& b) const {
    return std::ranges::any_of(a.on, [&](const PlaceOnBranch& p) {
      return std::ranges::any_of(b.on, [&](const PlaceOnBranch& q) {
        return p.branch == q.branch && of_[p.branch][p.after] == of_[q.branch][q.after];
      });
    });
  }

  /// Does the place's stretch reach the first or the last end of its branch?
  [[nodiscard]] bool ends(const PlaceOnBranch& place, bool first) const {
    const std::vector<std::size_t>& numbers = of_[place.branch];
    return numbers[place.after] == (first ? numbers.front() : numbers.back());
  }

  /// Is a special point on the stretch of the place, or at an end of it? A fold is at the end of two.
  [[nodiscard]] bool has(const SweepPlace& place, const SpecialRow& r) const {
    const std::vector<std::size_t>& numbers = of_[r.branch];
    return std::ranges::any_of(place.on, [&](const PlaceOnBranch& p) {
      if (p.branch != r.branch) return false;
      const std::size_t own = numbers[p.after];
      if (r.after < numbers.size() && numbers[r.after] == own) return true;
      if (r.kind == SpecialKind::fold) {
        const bool closed = traced_.branches[r.branch].last.end == analysis::BranchEnd::closed;
        const std::size_t n = numbers.size();
        if (r.after > 0 ? numbers[r.after - 1] == own : closed && numbers.back() == own) return true;
        if (r.after + 1 < n ? numbers[r.after + 1] == own : closed && numbers.front() == own) return true;
      }
      // A branch is born at its first special point, or dies at its last one: behind its last orbit.
      return r.after >= numbers.size() && numbers.back() == own;
    });
  }

 private:
  const TracedBranches& traced_;
  std::vector<std::vector<std::size_t>> of_;  ///< of each branch, for each orbit but the last
};

/// Locates points on branches.
class Locator {
 public:
  Locator(const TracedBranches& traced, std::size_t dimension, const ProofOptions& options)
      : traced_(traced), orbits_(traced), dimension_(dimension), options_(options) {}

  /// The branch of period n that the point is nearest to, if it is on it.
  /// @param preferred  taken before others that it is on too
  void locate(const PointResult& point, int n, std::optional<std::size_t> preferred, SweepPlace& place) {
    const Eigen::VectorXd state = state_of(point, dimension_);
    place.distance = infinite;
    if (state.size() == 0) return;
    for (std::size_t b = 0; b < traced_.branches.size(); ++b) {
      const std::vector<BranchRow>& rows = traced_.rows[b];
      if (rows.empty() || rows.front().period != n) continue;
      const auto& symmetry = traced_.branches[b].family.symmetry;
      std::vector<std::pair<PlaceOnBranch, double>> hits;  // of this branch, and how near
      for (std::size_t k = 0; k + 1 < rows.size(); ++k) {
        if (!holds(rows[k].value, rows[k + 1].value, point.point.value) || rows[k].value == rows[k + 1].value) continue;
        const Eigen::MatrixXd rough = rough_states(rows, k, point.point.value, dimension_);
        if (!(distance_to_orbit(state, rough, symmetry) <= options_.near)) continue;
        const Eigen::MatrixXd& exact = orbits_.states(b, k, point.point.value);
        const double distance = distance_to_orbit(state, exact, symmetry);
        const bool on_it = distance <= options_.same;
        if (on_it) hits.push_back({{b, k}, distance});
        const bool prefers = on_it && preferred == b && place.branch != preferred;
        if (!prefers && (!(distance < place.distance) || (place.branch && place.branch == preferred && preferred != b)))
          continue;
        place.distance = distance;
        if (!on_it) continue;
        place.branch = b;
        place.stable = stable_at(b, k, point.point.value);
      }
      add_nearest(hits, place.on);
    }
  }

  /// Adds the nearest orbit of one branch, and those that are as near: its images, if the branch has a fold at a
  /// pitchfork.
  void add_nearest(const std::vector<std::pair<PlaceOnBranch, double>>& hits, std::vector<PlaceOnBranch>& on) const {
    double least = infinite;
    for (const auto& [place, distance] : hits) least = std::min(least, distance);
    for (const auto& [place, distance] : hits)
      if (distance <= 2.0 * least + 1e-3 * options_.same) on.push_back(place);
  }

  [[nodiscard]] bool stable_at(std::size_t branch, std::size_t after, double value) const {
    const BranchRow& a = traced_.rows[branch][after];
    const BranchRow& b = traced_.rows[branch][after + 1];
    if (a.stable == b.stable) return a.stable;
    const auto change = traced_.change_behind(branch, after);
    const double at = change ? traced_.special[*change].value : 0.5 * (a.value + b.value);
    return holds(a.value, at, value) ? a.stable : b.stable;
  }

 private:
  const TracedBranches& traced_;
  OrbitsAt orbits_;
  std::size_t dimension_;
  ProofOptions options_;
};

/// Finds the causes of the changes along one direction.
class Explainer {
 public:
  /// @param directions  places of all points
  /// @param places      those of the direction whose changes are explained, one of these
  Explainer(const TracedBranches& traced, const Stretches& stretches, const Locator& locator,
            const std::vector<std::vector<SweepPlace>>& directions, const std::vector<SweepPlace>& places)
      : traced_(traced), stretches_(stretches), locator_(locator), directions_(directions), places_(places) {}

  void explain(std::size_t i, SweepChange& change) const {
    const SweepPlace& a = change.before;
    const SweepPlace& b = change.behind;
    from_ = a.value;
    to_ = b.value;
    step_ = std::abs(to_ - from_);
    // If the orbit is stable between both values, the branches give no cause of the change.
    if (!is_stable_throughout(a)) {
      // Special points between the values come before those behind them. A birth comes first, then the orbit before the
      // change. The orbit after the change does not explain the end of one that no branch follows.
      const bool unknown = a.periodic && !a.branch;
      for (const bool between : {true, false})
        for (const bool birth : {true, false})
          for (const SweepPlace* side : {&a, &b}) {
            if (!side->branch || (side == &b && !birth && unknown)) continue;
            if (by_special_point(*side, side == &a ? b : a, birth, between, change)) return;
          }
      for (const SweepPlace* side : {&a, &b})
        if (!(side == &b && unknown && !may_bear(a, b)) && by_end(*side, side == &a ? b : a, change)) return;
    }
    if (by_cascade(i, change)) return;
    if (!a.periodic && is_stable_throughout(b)) {
      change.cause = Cause::crisis;
      change.words = "the attractor (" + a.regime + ") ends; the sweep falls onto branch " + std::to_string(*b.branch) +
                     ", which is stable on both sides";
      return;
    }
    change.words = reason(change);
  }

 private:
  /// May the orbit be the one from which the other, of twice its period, is born?
  static bool may_bear(const SweepPlace& orbit, const SweepPlace& other) {
    return other.periodic && other.period == 2 * orbit.period;
  }

  /// Steps of the grid that a value is outside of the two.
  [[nodiscard]] double beside(double value) const {
    return holds(from_, to_, value) ? 0.0 : std::min(std::abs(value - from_), std::abs(value - to_)) / step_;
  }

  /// Did the sweep pass the value, at most a step ago?
  [[nodiscard]] bool is_within_the_grid(double value) const {
    return beside(value) <= 1.0 && (value - to_) * (to_ - from_) <= 0.0;
  }

  /// A point of the side's stretch within the grid where its stability changes; of several the one beside the side.
  /// @param birth    of the other side, else not
  /// @param between  the values, else behind them
  bool by_special_point(const SweepPlace& side, const SweepPlace& other, bool birth, bool between,
                        SweepChange& change) const {
    std::optional<std::size_t> best;
    const auto distance = [&](std::size_t k) { return std::abs(traced_.special[k].value - side.value); };
    for (std::size_t k = 0; k < traced_.special.size(); ++k) {
      const SpecialRow& r = traced_.special[k];
      if (r.kind == SpecialKind::grazing || r.kind == SpecialKind::unresolved) continue;
      if (!is_within_the_grid(r.value) || (beside(r.value) == 0.0) != between || !is_ahead(r.value, side, other))
        continue;
      if (!stretches_.has(side, r) || !changes_stability(r) || is_birth(r, side, other) != birth) continue;
      if (!best || distance(k) < distance(*best)) best = k;
    }
    if (!best) return false;
    const SpecialRow& r = traced_.special[*best];
    change.special = best;
    change.beside = beside(r.value);
    change.cause = birth ? Cause::bifurcation : Cause::jump;
    change.words =
        to_string(r.kind) + " of branch " + std::to_string(r.branch) + " at " + with_error(r.value, r.error_bound);
    if (!birth) change.words += whereto(side, other, change);
    return true;
  }

  /// The target or the origin of a jump.
  static std::string whereto(const SweepPlace& side, const SweepPlace& other, const SweepChange& change) {
    std::string words = &side == &change.before ? "; the sweep jumps to " : "; the sweep comes from ";
    if (!other.branch) {
      words += "what is " + other.regime;
      return words;
    }
    if (other.branch == side.branch) words += "another stretch of ";
    words += "branch " + std::to_string(*other.branch);
    return words;
  }

  /// An end within the grid at which the side's branch is born of an orbit that none follows.
  bool by_end(const SweepPlace& side, const SweepPlace& other, SweepChange& change) const {
    for (const PlaceOnBranch& p : side.on) {
      const analysis::Branch& branch = traced_.branches[p.branch];
      const std::vector<BranchRow>& rows = traced_.rows[p.branch];
      for (const analysis::BranchLimit* limit : {&branch.first, &branch.last}) {
        const bool first = limit == &branch.first;
        const double end = (first ? rows.front() : rows.back()).value;
        if (!limit->born || limit->place || !is_within_the_grid(end) || !is_ahead(end, side, other) ||
            !stretches_.ends(p, first) || is_stable_throughout(p, side.value))
          continue;
        change.cause = Cause::jump;
        change.beside = beside(end);
        change.words = "branch " + std::to_string(p.branch) + " ends at " + short_text(end, 9) +
                       ", at an orbit that is on no branch" + whereto(side, other, change);
        return true;
      }
    }
    return false;
  }

  /// If the orbit is stable, the point that ends its stability is ahead, towards the other side.
  static bool is_ahead(double value, const SweepPlace& side, const SweepPlace& other) {
    return !side.stable || (value - side.value) * (other.value - side.value) >= 0.0;
  }

  /// Is the other side born from the side's stretch at this point?
  [[nodiscard]] bool is_birth(const SpecialRow& r, const SweepPlace& side, const SweepPlace& other) const {
    if (r.kind == SpecialKind::neimark_sacker) return other.regime == "quasiperiodic" && !coexists(other, side);
    const auto is_there = [&](const analysis::BranchLimit& limit) {
      return limit.place && limit.place->branch == r.branch && limit.place->point == r.point;
    };
    if (r.kind == SpecialKind::period_doubling && other.periodic && other.period == 2 * side.period && !other.branch) {
      // One of those that are followed, it would be on.
      const bool followed = std::ranges::any_of(
          traced_.branches, [&](const analysis::Branch& b) { return is_there(b.first) || is_there(b.last); });
      return !followed && !coexists(other, side);
    }
    return std::ranges::any_of(other.on, [&](const PlaceOnBranch& p) {
      const analysis::Branch& branch = traced_.branches[p.branch];
      return (is_there(branch.first) && stretches_.ends(p, true)) ||
             (is_there(branch.last) && stretches_.ends(p, false));
    });
  }

  /// Has another direction the same regime on no branch at the side's own value, too, while the side's orbit is still
  /// stable?
  [[nodiscard]] bool coexists(const SweepPlace& other, const SweepPlace& side) const {
    constexpr double same_value = 1e-6;  // steps
    return side.stable && std::ranges::any_of(directions_, [&](const std::vector<SweepPlace>& places) {
             return &places != &places_ && std::ranges::any_of(places, [&](const SweepPlace& p) {
               return std::abs(p.value - side.value) <= same_value * step_ && p.regime == other.regime && !p.branch;
             });
           });
  }

  [[nodiscard]] bool changes_stability(const SpecialRow& r) const {
    const std::vector<BranchRow>& rows = traced_.rows[r.branch];
    if (r.after + 1 >= rows.size()) return !rows.empty();  // born there
    if (rows[r.after].stable != rows[r.after + 1].stable) return true;
    // There and back between two orbits; a multiplier of the orbit that is not critical must not be outside.
    return !rows[r.after].stable && !rows[r.after + 1].stable ? false : several_between(r);
  }

  [[nodiscard]] bool several_between(const SpecialRow& r) const {
    return std::ranges::count_if(traced_.special, [&](const SpecialRow& o) {
             return o.branch == r.branch && o.after == r.after && o.kind != SpecialKind::grazing;
           }) > 1;
  }

  /// Is the orbit on a stretch that is stable from one value to the other?
  [[nodiscard]] bool is_stable_throughout(const SweepPlace& place) const {
    return std::ranges::any_of(place.on, [&](const PlaceOnBranch& p) { return is_stable_throughout(p, place.value); });
  }

  /// @param value  at the place
  [[nodiscard]] bool is_stable_throughout(const PlaceOnBranch& place, double value) const {
    const std::vector<BranchRow>& rows = traced_.rows[place.branch];
    const double slack = 1e-6 * step_;  // ends of ranges are rounded
    if (!locator_.stable_at(place.branch, place.after, value)) return false;
    for (const double to : {from_, to_}) {
      if (std::abs(to - value) <= slack) continue;
      // Along the branch towards that value.
      const bool rising = rows[place.after + 1].value > rows[place.after].value;
      const bool onwards = (to > value) == rising;
      std::size_t k = place.after;
      while (!holds(rows[k].value, rows[k + 1].value, to)) {
        const BranchRow& next = rows[onwards ? k + 1 : k];
        if (!next.stable) return false;
        if (std::abs(next.value - to) <= slack) break;
        if (onwards ? k + 2 >= rows.size() : k == 0) return false;
        k = onwards ? k + 1 : k - 1;
        if ((rows[k + 1].value > rows[k].value) != rising) return false;
      }
      if (holds(rows[k].value, rows[k + 1].value, to) && !locator_.stable_at(place.branch, k, to)) return false;
    }
    return true;
  }

  /// Between a known period doubling (flip) and the change, only periods of its cascade occur.
  bool by_cascade(std::size_t i, SweepChange& change) const {
    for (const bool backwards : {true, false}) {
      const SweepPlace& side = backwards ? change.before : change.behind;
      const SweepPlace& other = backwards ? change.behind : change.before;
      if (!side.periodic || side.branch) continue;
      if (other.periodic && other.period != 2 * side.period && 2 * other.period != side.period) continue;
      // From the periodic side away from the change.
      std::size_t k = backwards ? i : i + 1;
      int period = side.period;
      while (places_[k].periodic && !places_[k].branch &&
             (places_[k].period == period || 2 * places_[k].period == period)) {
        period = places_[k].period;
        if (backwards ? k == 0 : k + 1 == places_.size()) break;
        k = backwards ? k - 1 : k + 1;
      }
      const SweepPlace& root = places_[k];
      if (!root.branch || 2 * root.period != period) continue;
      const SweepPlace& next = places_[backwards ? k + 1 : k - 1];
      for (std::size_t n = 0; n < traced_.special.size(); ++n) {
        const SpecialRow& r = traced_.special[n];
        const double slack = std::abs(next.value - root.value);
        if (r.kind != SpecialKind::period_doubling || r.branch != *root.branch ||
            !holds(std::min(root.value, next.value) - slack, std::max(root.value, next.value) + slack, r.value))
          continue;
        change.cause = Cause::cascade;
        change.special = n;
        change.beside = beside(r.value);
        change.words = "in the cascade whose last located period doubling is that of branch " +
                       std::to_string(r.branch) + " at " + with_error(r.value, r.error_bound);
        return true;
      }
    }
    return false;
  }

  /// Why nothing explains it.
  [[nodiscard]] static std::string reason(const SweepChange& change) {
    for (const SweepPlace* side : {&change.before, &change.behind})
      if (side->periodic && !side->branch)
        return "no branch of period " + std::to_string(side->period) + " is known at point " +
               std::to_string(side->point) + ": --from FOLDER:" + std::to_string(side->point) + " continues one";
    if (change.before.branch && change.before.stable) return "the sweep leaves an orbit that is stable here";
    return "no branch changes here";
  }

  const TracedBranches& traced_;
  const Stretches& stretches_;
  const Locator& locator_;
  const std::vector<std::vector<SweepPlace>>& directions_;
  const std::vector<SweepPlace>& places_;
  mutable double from_ = 0, to_ = 0, step_ = 0;  ///< of the change in question, along the direction
};

}  // namespace

std::string to_string(Cause cause) {
  switch (cause) {
    case Cause::bifurcation:
      return "bifurcation";
    case Cause::jump:
      return "jump";
    case Cause::cascade:
      return "cascade";
    case Cause::crisis:
      return "crisis";
    case Cause::undecided:
      return "undecided";
    case Cause::unexplained:
      break;
  }
  return "unexplained";
}

void ProofOptions::validate() const {
  require(same > 0.0, "same", same, "> 0");
  require(near >= same, "near", near, ">= same");
}

std::size_t BranchProof::counted() const {
  return static_cast<std::size_t>(std::ranges::count_if(changes, [](const SweepChange& c) { return c.counted; }));
}

std::size_t BranchProof::unexplained() const {
  return static_cast<std::size_t>(
      std::ranges::count_if(changes, [](const SweepChange& c) { return c.counted && c.cause == Cause::unexplained; }));
}

BranchProof prove(const TracedBranches& traced, const SweepOptions& sweep, const PointSource& points,
                  std::size_t dimension, const ProofOptions& options,
                  const std::function<void(std::size_t)>& finished) {
  options.validate();
  BranchProof proof;
  const Stretches stretches(traced);
  Locator locator(traced, dimension, options);
  const std::size_t points_per_direction = points.count / sweep.directions.size();
  std::vector<std::vector<SweepPlace>> directions(sweep.directions.size());
  for (std::size_t d = 0; d < sweep.directions.size(); ++d) {
    std::vector<SweepPlace>& places = directions[d];
    for (std::size_t i = 0; i < points_per_direction; ++i) {
      const PointResult point = points.read(d * points_per_direction + i);
      SweepPlace place;
      place.point = point.point.index;
      place.value = point.point.value;
      place.regime = "failed";
      if (point.outcome == integrate::Outcome::reached) {
        place.regime = regime_name(point);
        place.periodic = point.regime == analysis::Regime::periodic;
        place.period = place.periodic ? point.period : 0;
        if (place.periodic) {
          locator.locate(point, point.period, places.empty() ? std::nullopt : places.back().branch, place);
          ++proof.periodic;
          if (place.branch)
            proof.largest_distance = std::max(proof.largest_distance, place.distance);
          else
            proof.off.push_back(place);
        }
      }
      places.push_back(std::move(place));
      finished(d * points_per_direction + i + 1);
    }
  }
  for (std::size_t d = 0; d < sweep.directions.size(); ++d) {
    const std::vector<SweepPlace>& places = directions[d];
    const Explainer explainer(traced, stretches, locator, directions, places);
    // Is the undecided point on the branch of the other side?
    const auto converges_onto = [&](const SweepChange& change) {
      const SweepPlace& side = change.before.branch ? change.before : change.behind;
      const SweepPlace& other = change.before.branch ? change.behind : change.before;
      if (!side.branch || other.regime != to_string(analysis::Regime::undecided)) return false;
      SweepPlace there = other;
      locator.locate(points.read(other.point), side.period, side.branch, there);
      return there.branch == side.branch;
    };
    for (std::size_t i = 0; i + 1 < places.size(); ++i) {
      const SweepPlace& a = places[i];
      const SweepPlace& b = places[i + 1];
      // Orbits on no branch cannot be distinguished: they are listed.
      const bool jumps = a.branch || b.branch ? !stretches.shared(a, b) : false;
      if (a.regime == b.regime && !jumps) continue;
      SweepChange change;
      change.before = a;
      change.behind = b;
      change.direction = sweep.directions[d];
      change.counted = a.periodic || b.periodic;
      if (change.counted) explainer.explain(i, change);
      if (change.counted && change.cause == Cause::unexplained && converges_onto(change)) {
        change.cause = Cause::undecided;
        change.words = "the undecided point is on the orbit too";
      }
      proof.changes.push_back(std::move(change));
    }
  }
  return proof;
}

}  // namespace epicyclic::studies
