#include "analysis/locus.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "analysis/contact_extrema.hpp"
#include "analysis/crossings.hpp"
#include "analysis/shooting.hpp"
#include "core/dense.hpp"
#include "core/errors.hpp"
#include "core/require.hpp"
#include "core/root_finding.hpp"
#include "core/text.hpp"

namespace epicyclic::analysis {

namespace {

/// Which g a locus is the root of.
enum class Form {
  bordered,  ///< a real multiplier at c
  pair,      ///< of conjugate multipliers
  single,    ///< one multiplier of a block that stands for two
  contact,   ///< an extremum of a surface
};

/// Angle between the lines through 0 in two directions [rad].
double line_angle(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return std::acos(std::clamp(std::abs(a.dot(b)) / (a.norm() * b.norm()), 0.0, 1.0));
}

/// Takes out the one nearest to a place.
std::complex<double> take_nearest(Multipliers& values, std::complex<double> to) {
  const std::complex<double> taken = nearest(values, to);
  values.erase(std::find(values.begin(), values.end(), taken));
  return taken;
}

}  // namespace

/// The orbits of one surface and the points of one locus on it.
class Locus {
 public:
  Locus(const OrbitSurface& surface, const LocusSubject& subject, Eigen::Index dimension)
      : surface_(surface),
        subject_(subject),
        blocks_(invariant_blocks(static_cast<std::size_t>(dimension), surface.family.kept())),
        system_(surface_.family, surface_.scales(), dimension, [this](const OrbitPlace& z) { return evaluate(z); }) {
    block_ = find(subject.symmetry_index);
    if (block_ == nullptr)
      throw InputError("a locus of symmetry index " + std::to_string(subject.symmetry_index) +
                       ", which the symmetry does not have");
    form_ = subject.kind == SpecialKind::grazing          ? Form::contact
            : !block_->real                               ? Form::single
            : subject.kind == SpecialKind::neimark_sacker ? Form::pair
                                                          : Form::bordered;
    at_ = subject.kind == SpecialKind::period_doubling ? -1.0 : 1.0;
  }
  Locus(const Locus&) = delete;
  Locus& operator=(const Locus&) = delete;
  ~Locus() = default;

  [[nodiscard]] const OrbitSurface& surface() const { return surface_; }
  [[nodiscard]] const LocusSubject& subject() const { return subject_; }
  [[nodiscard]] const std::vector<InvariantBlock>& blocks() const { return blocks_; }
  [[nodiscard]] const InvariantBlock& block(int symmetry_index) const { return *find(symmetry_index); }
  [[nodiscard]] Form form() const { return form_; }
  [[nodiscard]] double inner(const OrbitPlace& a, const OrbitPlace& b) const { return system_.inner(a, b); }
  [[nodiscard]] double length(const OrbitPlace& a) const { return system_.length(a); }

  /// The point where the row holds, near a guess; [A-locus] if the row is a direction.
  /// @param near  a point whose multipliers, bordering vectors and directions are near
  LocusCorrection correct(const LocusPoint& near, const OrbitPlace& guess, const ClosingRow& row) {
    LocusCorrection result;
    const std::vector<ClosingRow> rows = {row, {&near.across}};
    OrbitPlace z = guess;
    double slope = near.slope;
    double distance = 0.0;  // along the orbits of the plane
    double distance_before = 0.0;
    double g_before = 0.0;
    double stepped = std::numeric_limits<double>::infinity();
    constexpr int iterations = 10;
    for (int k = 0; k < iterations; ++k) {
      NewtonOutcome newton = system_.newton(z, rows);
      result.evaluations += newton.evaluations;
      if (!newton.found) {
        result.message = std::move(newton.message);
        return result;
      }
      MatrixProduct monodromy = newton.last.shot.monodromy();
      const std::optional<double> g = function(near, newton.at, monodromy);
      if (!g) {
        result.message = "the function of the locus has no value here";
        return result;
      }
      // A slope from a step as short as the noise of g counts only if it agrees with the known slope.
      const double seen = k > 0 ? (*g - g_before) / (distance - distance_before) : slope;
      constexpr double alike = 2.0;
      const bool agrees = seen / slope > 1.0 / alike && seen / slope < alike;
      if (std::isfinite(seen) && seen != 0.0 && (agrees || stepped > surface_.family.known)) slope = seen;
      const double step = -*g / slope;
      if (!std::isfinite(step)) break;
      // At the noise of the multipliers nothing falls any more.
      constexpr double resolved = 1e-10;
      const bool still = k > 0 && std::abs(*g) > 0.5 * std::abs(g_before) && stepped <= surface_.family.known;
      const OrbitPlace along = system_.tangent(newton.last, rows, 1);
      if (std::abs(step) <= resolved || still) {
        // The last step costs no evaluation.
        result.point.at = finite(along) && !still ? newton.at + step * along : newton.at;
        if (row.along == nullptr) result.point.at.values(row.value) = guess.values(row.value);
        result.point.monodromy = std::move(monodromy);
        result.point.residual = newton.residual;
        result.distance = length(result.point.at - guess);
        result.evaluations += finish(near, newton.last, result.point);
        result.found = result.point.slope > 0.0;
        if (!result.found) result.message = "the locus has no direction of its own here";
        return result;
      }
      g_before = *g;
      distance_before = distance;
      distance += step;
      stepped = std::abs(step);
      z = newton.at + step * along;
    }
    result.message = "no point of the locus near the guess";
    return result;
  }

  /// A point known from elsewhere, its direction not.
  LocusCorrection begin(const OrbitPlace& z, std::complex<double> multiplier) {
    LocusPoint near;
    near.at = z;
    near.multiplier = multiplier;
    near.partner = std::conj(multiplier);
    const OrbitShot shot = evaluate(z);
    LocusCorrection result;
    if (!shot.shot.evolution.reached()) {
      result.message = shot.shot.evolution.message;
      return result;
    }
    near.monodromy = shot.shot.monodromy();
    LocusPoint first = near;
    finish(near, shot, first);
    if (!(first.slope > 0.0)) {
      result.message = "the locus has no direction of its own here";
      return result;
    }
    // Rising: the second parameter, or the first where that rests.
    constexpr double rests = 1e-6;
    const Eigen::VectorXd p = first.direction.values.cwiseQuotient(surface_.scales());
    const double rise = std::abs(p(1)) > rests ? p(1) : p(0);
    if (rise < 0.0) first = reversed(std::move(first));
    return correct(first, first.at, {&first.direction});
  }

  /// A point between a and b, in the plane there that stands on a's direction.
  LocusCorrection between(const LocusPoint& a, const LocusPoint& b, double part) {
    const OrbitPlace guess = cubic_between(a.at, a.direction, b.at, b.direction, inner(b.at - a.at, a.direction),
                                           inner(b.direction, a.direction), part);
    return correct(part < 0.5 ? a : b, guess, {&a.direction});
  }

  /// A point of this surface from one of another subdivision or tolerance, in its plane.
  LocusCorrection recut(const LocusPoint& point) {
    LocusPoint near = point;
    if (point.at.states.cols() != surface_.family.shooting_intervals) {
      const std::optional<OrbitPlace> at = cut(point.at);
      const std::optional<OrbitPlace> direction = cut_direction(point.at, point.direction);
      const std::optional<OrbitPlace> across = cut_direction(point.at, point.across);
      if (!at || !direction || !across) return {};
      near.at = *at;
      near.direction = *direction;
      near.across = *across;
    }
    return correct(near, near.at, {&near.direction});
  }

  /// Multipliers of a block but those that the locus is about.
  [[nodiscard]] Multipliers others(const InvariantBlock& block, const LocusPoint& point) const {
    Multipliers values = multipliers_of(block, point.monodromy);
    if (block.symmetry_index != subject_.symmetry_index || form_ == Form::contact) return values;
    take_nearest(values, form_ == Form::bordered ? at_ : point.multiplier);
    if (form_ == Form::pair) take_nearest(values, point.partner);
    return values;
  }

  /// w: the line on which the parameters move along the orbits near a fold.
  [[nodiscard]] Eigen::Vector2d line(const LocusPoint& point) const {
    const Eigen::VectorXd scales = surface_.scales();
    Eigen::MatrixXd p(2, 2);
    p.col(0) = point.direction.values.cwiseQuotient(scales);
    p.col(1) = point.across.values.cwiseQuotient(scales);
    return singular_values(p).u.col(0);
  }

 private:
  [[nodiscard]] const InvariantBlock* find(int symmetry_index) const {
    for (const InvariantBlock& b : blocks_)
      if (b.symmetry_index == symmetry_index) return &b;
    return nullptr;
  }

  [[nodiscard]] OrbitShot evaluate(const OrbitPlace& z) const {
    const double first = z.values(0);
    const double second = z.values(1);
    OrbitShot f;
    f.by_value.push_back(shot_with_parameter(surface_.at(second), {z.states, first}, f.shot));
    if (!f.shot.evolution.reached()) return f;
    f.by_value.push_back(parameter_difference([&](double value) { return surface_.flows(first, value); }, z.states,
                                              second, surface_.family.difference * surface_.second_scale,
                                              surface_.family.period, f.shot));
    return f;
  }

  /// Singular where the block's M - at I is.
  [[nodiscard]] Eigen::MatrixXd shifted(const MatrixProduct& monodromy) const {
    return real_block_of(*block_, monodromy).cyclic(at_);
  }

  /// g.
  /// @param near  whose multipliers and bordering vectors it goes by
  /// @returns nothing where it has no value
  [[nodiscard]] std::optional<double> function(const LocusPoint& near, const OrbitPlace& z,
                                               const MatrixProduct& monodromy) const {
    std::optional<double> g;
    switch (form_) {
      case Form::bordered: {
        // Bordered where orbits begin and end: what that says of M - c I does not depend on the shooting intervals.
        const Eigen::MatrixXd cyclic = shifted(monodromy);
        const Eigen::Index n = cyclic.rows();
        const Eigen::Index size = near.right.size();
        Eigen::MatrixXd a = Eigen::MatrixXd::Zero(n + 1, n + 1);
        a.topLeftCorner(n, n) = cyclic;
        a.col(n).segment(n - size, size) = near.left;
        a.row(n).head(size) = near.right.transpose();
        g = solution(a, Eigen::VectorXd::Unit(n + 1, n))(n);
        break;
      }
      case Form::pair: {
        Multipliers values = multipliers_of(*block_, monodromy);
        if (values.size() < 2) return std::nullopt;
        const std::complex<double> one = take_nearest(values, near.multiplier);
        g = 0.5 * std::log(std::abs(one * nearest(values, near.partner)));
        break;
      }
      case Form::single:
        g = std::log(std::abs(nearest(multipliers_of(*block_, monodromy), near.multiplier)));
        break;
      case Form::contact:
        g = contact_extremum(surface_.at(z.values(1)), {z.states, z.values(0)}, subject_.surface, subject_.least);
        break;
    }
    if (!g || !std::isfinite(*g)) return std::nullopt;
    return g;
  }

  /// g at any place, orbit or not.
  [[nodiscard]] std::optional<double> function_at(const LocusPoint& near, const OrbitPlace& z) const {
    if (form_ == Form::contact) return function(near, z, {});
    const Shot shot = shoot(*surface_.flows(z.values(0), z.values(1)), z.states, surface_.family.period);
    if (!shot.evolution.reached()) return std::nullopt;
    return function(near, z, shot.monodromy());
  }

  /// Multipliers, bordering vectors and directions of a point whose place and monodromy are known.
  /// @returns evaluations of F with its derivatives
  int finish(const LocusPoint& near, const OrbitShot& shot, LocusPoint& point) {
    follow(near, point);
    const std::vector<OrbitPlace> e = system_.tangents(shot);
    Eigen::Vector2d gradient;
    // An orbit that comes back to within h^2 has g to h^2, and the same on both sides.
    const double h = surface_.gradient_step;
    for (std::size_t k = 0; k < 2; ++k) {
      const auto above = function_at(point, point.at + h * e[k]);
      const auto below = function_at(point, point.at - h * e[k]);
      if (!above || !below) return 4;
      gradient(static_cast<Eigen::Index>(k)) = (*above - *below) / (2.0 * h);
    }
    const double norm = gradient.norm();
    if (!std::isfinite(norm) || !(norm > 0.0)) return 4;
    gradient /= norm;
    point.slope = norm;
    point.across = gradient(0) * e[0] + gradient(1) * e[1];
    point.direction = gradient(1) * e[0] - gradient(0) * e[1];
    if (near.direction.states.size() != 0 && inner(point.direction, near.direction) < 0.0)
      point = reversed(std::move(point));
    return 4;
  }

  void follow(const LocusPoint& near, LocusPoint& point) const {
    if (form_ == Form::contact) return;
    Multipliers values = multipliers_of(*block_, point.monodromy);
    if (form_ == Form::bordered) {
      point.multiplier = nearest(values, at_);
      const SingularValues s = singular_values(shifted(point.monodromy));
      const Eigen::Index last = s.s.size() - 1;
      const Eigen::Index size = block_->basis.cols();
      point.left = s.u.col(last).tail(size).normalized();
      point.right = s.v.col(last).head(size).normalized();
      return;
    }
    point.multiplier = take_nearest(values, near.multiplier);
    if (form_ == Form::pair && !values.empty()) point.partner = nearest(values, near.partner);
  }

  [[nodiscard]] std::optional<OrbitPlace> cut(const OrbitPlace& z) const {
    std::optional<CurvePoint> c = split_into_intervals(surface_.at(z.values(1)), z.states.col(0), z.values(0));
    if (!c) return std::nullopt;
    return OrbitPlace{std::move(c->states), z.values};
  }

  [[nodiscard]] std::optional<OrbitPlace> cut_direction(const OrbitPlace& z, const OrbitPlace& direction) const {
    constexpr double little = 1e-5;
    const auto ahead = cut(z + little * direction);
    const auto behind = cut(z - little * direction);
    if (!ahead || !behind) return std::nullopt;
    const OrbitPlace t = (0.5 / little) * (*ahead - *behind);
    return (1.0 / length(t)) * t;
  }

  OrbitSurface surface_;
  LocusSubject subject_;
  std::vector<InvariantBlock> blocks_;
  const InvariantBlock* block_ = nullptr;
  Form form_ = Form::bordered;
  double at_ = 1.0;  ///< c
  OrbitSystem system_;
};

namespace {

/// [A-bound] of both parameters, from those of other families: of the one that moved more, in their scales. One alone
/// may come out alike by chance, or by the direction of the locus.
void set_bounds(LocusPoint& point, const std::vector<Eigen::VectorXd>& finer, const Eigen::VectorXd& scales,
                double safety) {
  if (finer.empty()) return;
  double most = 0.0;
  std::vector<Eigen::VectorXd> all = finer;
  all.push_back(point.at.values);
  for (const Eigen::VectorXd& v : all)
    most = std::max(most, (v - finer.back()).cwiseQuotient(scales).lpNorm<Eigen::Infinity>());
  constexpr double rounding = 1e-14;
  const Eigen::VectorXd bound = safety * most * scales + rounding * point.at.values.cwiseAbs();
  point.first_bound = bound(0);
  point.second_bound = bound(1);
}

OrbitSurface refined(const OrbitSurface& surface, const LocusRefinement& other) {
  OrbitSurface finer = surface;
  finer.flows = other.flows;
  finer.family.shooting_intervals *= other.shooting_intervals;
  return finer;
}

/// The bounds of a point: the same one by the other families.
/// @param again  finds it on another locus, near what it is given
template <class Again>
bool bound(const Locus& locus, const LocusOptions& options, LocusPoint& point, const Again& again) {
  std::vector<Eigen::VectorXd> finer;
  bool all = true;
  for (const LocusRefinement& other : options.others) {
    Locus others(refined(locus.surface(), other), locus.subject(), point.at.states.rows());
    const std::optional<LocusPoint> found = again(others, point);
    if (found)
      finer.push_back(found->at.values);
    else
      all = false;
  }
  set_bounds(point, finer, locus.surface().scales(), options.safety);
  return all;
}

/// In its own plane.
void set_bounds(const Locus& locus, const LocusOptions& options, LocusPoint& point) {
  bound(locus, options, point, [](Locus& other, const LocusPoint& near) -> std::optional<LocusPoint> {
    LocusCorrection c = other.recut(near);
    if (!c.found) return std::nullopt;
    return std::move(c.point);
  });
}

/// One point of codimension two between two points of a locus.
struct Event {
  using Function = std::function<double(const Locus&, const LocusPoint&)>;
  CodimTwo kind = CodimTwo::unresolved;
  int symmetry_index = 0;            ///< of the block of the other multiplier
  std::optional<Crossing> crossing;  ///< that it makes; none: the locus' own direction, or multiplier
  std::size_t inside = 0;            ///< as of sign_function()
  std::complex<double> expected{};   ///< where it is, of a pair
  Function own{};                    ///< of the locus' own: of another sign on each side, and smooth

  /// Has opposite signs on the two sides, whatever else happens to the multipliers.
  [[nodiscard]] double sign(const Locus& locus, const LocusPoint& p) const {
    if (!crossing) return own(locus, p);
    const InvariantBlock& block = locus.block(symmetry_index);
    return sign_function(block, *crossing, locus.others(block, p), inside);
  }

  /// The other multiplier; the locus' own if there is no other.
  [[nodiscard]] std::complex<double> multiplier(const Locus& locus, const LocusPoint& p) const {
    if (!crossing) return p.multiplier;
    return nearest(locus.others(locus.block(symmetry_index), p), *crossing == Crossing::pair ? expected : at());
  }

  /// Smooth at the event.
  [[nodiscard]] double smooth(const Locus& locus, const LocusPoint& p) const {
    if (!crossing) return own(locus, p);
    if (kind == CodimTwo::resonance_1_1 || kind == CodimTwo::resonance_1_2) {
      // Two that meet go like the root of the distance; their sum is smooth.
      Multipliers all = multipliers_of(locus.block(symmetry_index), p.monodromy);
      const std::complex<double> one = take_nearest(all, at());
      return (one + nearest(all, at())).real() - 2.0 * at().real();
    }
    const std::complex<double> x = multiplier(locus, p);
    return *crossing == Crossing::pair ? std::log(std::abs(x)) : (x - at()).real();
  }

  /// Searches for a pair at a point close to the event.
  void expect_near(const Locus& locus, const LocusPoint& p) {
    if (crossing == Crossing::pair) expected = locus.others(locus.block(symmetry_index), p).at(inside);
  }

 private:
  [[nodiscard]] std::complex<double> at() const { return *crossing == Crossing::minus ? -1.0 : 1.0; }
};

/// Both multipliers of the pair lie on the real axis, away from where it meets.
bool is_real_pair(const LocusPoint& point) {
  return point.multiplier.imag() == 0.0 && point.partner.imag() == 0.0 && point.multiplier != point.partner;
}

/// (lambda + its partner) / 2, the cosine of the angle: smooth where the pair meets.
double half_trace(const LocusPoint& point) { return 0.5 * (point.multiplier + point.partner).real(); }

/// Strong resonances of a pair, or of one multiplier.
void resonances(const Locus& locus, const LocusPoint& a, const LocusPoint& b, std::vector<Event>& found) {
  if (locus.subject().kind != SpecialKind::neimark_sacker) return;
  constexpr std::array<CodimTwo, 4> kinds = {CodimTwo::resonance_1_1, CodimTwo::resonance_1_2, CodimTwo::resonance_1_3,
                                             CodimTwo::resonance_1_4};
  for (int k = 1; k <= 4; ++k) {
    const double angle = 2.0 * std::numbers::pi / k;
    const CodimTwo kind = kinds[static_cast<std::size_t>(k - 1)];
    const auto watch = [&](const Event::Function& f) {
      if ((f(locus, a) > 0.0) != (f(locus, b) > 0.0))
        found.push_back({kind, locus.subject().symmetry_index, std::nullopt, 0, 0.0, f});
    };
    if (locus.form() == Form::pair) {
      watch([cosine = std::cos(angle)](const Locus&, const LocusPoint& p) { return half_trace(p) - cosine; });
      continue;
    }
    for (const double sense : {1.0, -1.0}) {
      if (k <= 2 && sense < 0.0) continue;
      const std::complex<double> back = std::polar(1.0, -sense * angle);
      // Only on this side of the circle.
      if (!((a.multiplier * back).real() > 0.0) || !((b.multiplier * back).real() > 0.0)) continue;
      watch([back](const Locus&, const LocusPoint& p) { return (p.multiplier * back).imag(); });
    }
  }
}

void cusp(const Locus& locus, const LocusPoint& a, const LocusPoint& b, std::vector<Event>& found) {
  if (locus.subject().kind != SpecialKind::fold) return;
  const Eigen::Vector2d along = locus.line(a);
  // p's part of the line that is nearest to a's.
  const Event::Function f = [along](const Locus& of, const LocusPoint& p) {
    const Eigen::Vector2d w = of.line(p);
    const Eigen::Vector2d direction = p.direction.values.cwiseQuotient(of.surface().scales());
    return (w.dot(along) < 0.0 ? -1.0 : 1.0) * w.dot(direction);
  };
  if ((f(locus, a) > 0.0) == (f(locus, b) > 0.0)) return;
  found.push_back({CodimTwo::cusp, 0, std::nullopt, 0, 0.0, f});
}

/// The name of another crossing on a locus.
CodimTwo name_of(const Locus& locus, const InvariantBlock& block, Crossing crossing) {
  const LocusSubject& s = locus.subject();
  const bool same = block.symmetry_index == s.symmetry_index;
  const bool fold = s.kind == SpecialKind::fold;
  const bool period_doubling = s.kind == SpecialKind::period_doubling;
  const bool torus = s.kind == SpecialKind::neimark_sacker;
  const bool synchronous = block.symmetry_index == 0;
  switch (crossing) {
    case Crossing::plus:
      if (same && !period_doubling && !torus) return CodimTwo::resonance_1_1;
      if (!synchronous) return CodimTwo::double_crossing;
      return period_doubling ? CodimTwo::fold_period_doubling
             : torus         ? CodimTwo::fold_neimark_sacker
                             : CodimTwo::double_crossing;
    case Crossing::minus:
      if (same && period_doubling) return CodimTwo::resonance_1_2;
      return fold    ? CodimTwo::fold_period_doubling
             : torus ? CodimTwo::period_doubling_neimark_sacker
                     : CodimTwo::double_crossing;
    case Crossing::pair:
      return fold              ? CodimTwo::fold_neimark_sacker
             : period_doubling ? CodimTwo::period_doubling_neimark_sacker
                               : CodimTwo::double_crossing;
    case Crossing::unresolved:
      break;
  }
  return CodimTwo::unresolved;
}

/// The root of an event's smooth function along the locus, near a point.
std::optional<LocusPoint> polish(Locus& locus, const Event& event, const LocusPoint& near, double span) {
  const LocusCorrection base = locus.recut(near);
  if (!base.found) return std::nullopt;
  LocusCorrection last;
  const auto at = [&](double s) -> std::optional<double> {
    last =
        s == 0.0 ? base : locus.correct(base.point, base.point.at + s * base.point.direction, {&base.point.direction});
    if (!last.found) return std::nullopt;
    return event.smooth(locus, last.point);
  };
  if (!secant_root(at, 1e-3 * span, span)) return std::nullopt;
  return last.point;
}

Codim2Point unresolved(const LocusPoint& a, const LocusPoint& b, std::string note) {
  Codim2Point mark;
  mark.point = a;
  const Eigen::VectorXd apart = (b.at.values - a.at.values).cwiseAbs();
  mark.point.first_bound = apart(0);
  mark.point.second_bound = apart(1);
  mark.note = std::move(note);
  return mark;
}

Codim2Point locate(Locus& locus, Event event, const LocusPoint& a, const LocusPoint& b, const LocusOptions& options) {
  Codim2Point mark;
  mark.kind = event.kind;
  mark.symmetry_index = event.symmetry_index;
  const std::string name = to_string(event.kind) + ": ";
  try {
    LocusPoint near = a;
    const auto function = [&](double part) {
      if (part == 0.0) return event.sign(locus, a);
      if (part == 1.0) return event.sign(locus, b);
      const LocusCorrection c = locus.between(a, b, part);
      if (!c.found) throw DomainError(c.message);
      near = c.point;
      return event.sign(locus, c.point);
    };
    // To a thousandth of the distance.
    constexpr double width = 1e-3;
    const double part = find_root(function, 0.0, 1.0, width);
    function(part);
    event.expect_near(locus, near);
    const double span = locus.length(b.at - a.at);
    const std::optional<LocusPoint> found = polish(locus, event, near, span);
    if (!found) return unresolved(a, b, name + "no point beside it");
    mark.point = *found;
    mark.multiplier = event.multiplier(locus, mark.point);
    const auto again = [&](Locus& other, const LocusPoint& point) { return polish(other, event, point, span); };
    if (!bound(locus, options, mark.point, again)) mark.note = "one of the finer families found no point";
  } catch (const DomainError& e) {
    return unresolved(a, b, name + e.what());
  }
  return mark;
}

void find_marks(Locus& locus, const LocusPoint& a, const LocusPoint& b, const LocusOptions& options, int halvings,
                std::vector<Codim2Point>& found) {
  if (locus.form() == Form::contact) return;
  std::vector<Event> events;
  cusp(locus, a, b, events);
  resonances(locus, a, b, events);
  bool parted = true;
  for (const InvariantBlock& block : locus.blocks()) {
    const Multipliers of_a = locus.others(block, a);
    const Multipliers of_b = locus.others(block, b);
    const Signs at_a = signs_of(block, of_a);
    const Signs at_b = signs_of(block, of_b);
    const std::optional<Crossing> crossing = crossing_between(block, at_a, at_b);
    if (!crossing) continue;
    if (*crossing == Crossing::unresolved) {
      parted = false;
      continue;
    }
    events.push_back(
        {name_of(locus, block, *crossing), block.symmetry_index, crossing, std::min(at_a.outside, at_b.outside)});
  }
  if (!parted) {
    const LocusCorrection middle = halvings > 0 ? locus.between(a, b, 0.5) : LocusCorrection{};
    if (middle.found) {
      find_marks(locus, a, middle.point, options, halvings - 1, found);
      find_marks(locus, middle.point, b, options, halvings - 1, found);
      return;
    }
    found.push_back(unresolved(a, b, "several events that could not be parted"));
  }
  for (const Event& event : events) found.push_back(locate(locus, event, a, b, options));
}

/// All points of codimension two between two points, in order.
std::vector<Codim2Point> marks_between(Locus& locus, const LocusPoint& a, const LocusPoint& b,
                                       const LocusOptions& options) {
  // After this number of halvings, neighbours differ by 1e-6 of their distance.
  constexpr int halvings = 20;
  std::vector<Codim2Point> found;
  find_marks(locus, a, b, options, halvings, found);
  const auto along = [&](const Codim2Point& m) { return locus.inner(m.point.at - a.at, a.direction); };
  std::stable_sort(found.begin(), found.end(),
                   [&](const Codim2Point& p, const Codim2Point& q) { return along(p) < along(q); });
  return found;
}

}  // namespace

std::string to_string(CodimTwo kind) {
  switch (kind) {
    case CodimTwo::cusp:
      return "cusp";
    case CodimTwo::resonance_1_1:
      return "resonance_1_1";
    case CodimTwo::resonance_1_2:
      return "resonance_1_2";
    case CodimTwo::resonance_1_3:
      return "resonance_1_3";
    case CodimTwo::resonance_1_4:
      return "resonance_1_4";
    case CodimTwo::fold_period_doubling:
      return "fold_flip";
    case CodimTwo::fold_neimark_sacker:
      return "fold_neimark_sacker";
    case CodimTwo::period_doubling_neimark_sacker:
      return "flip_neimark_sacker";
    case CodimTwo::double_crossing:
      return "double_crossing";
    case CodimTwo::unresolved:
      break;
  }
  return "unresolved";
}

OrbitFamily OrbitSurface::at(double second) const {
  OrbitFamily along = family;
  along.flows = [flows = flows, second](double first) { return flows(first, second); };
  return along;
}

Eigen::VectorXd OrbitSurface::scales() const { return Eigen::Vector2d(family.value_scale, second_scale); }

void OrbitSurface::validate() const {
  family.validate();
  require(second_scale > 0.0, "second_scale", second_scale, "> 0");
  require(gradient_step > 0.0, "gradient_step", gradient_step, "> 0");
}

void LocusOptions::validate() const {
  along.validate();
  require(second_from < second_to, "second_to", second_to, "> second_from");
  require(safety >= 1.0, "safety", safety, ">= 1");
}

LocusSubject subject_of(const SpecialPoint& point) {
  return {point.kind, point.symmetry_index, point.surface, point.least};
}

LocusPoint reversed(LocusPoint point) {
  point.direction = -1.0 * point.direction;
  return point;
}

LocusCorrection locus_start(const OrbitSurface& surface, const SpecialPoint& point, double second) {
  surface.validate();
  if (point.kind == SpecialKind::unresolved || (point.kind == SpecialKind::branch_point && point.symmetry_index == 0))
    throw InputError("there is no locus of a point that is " + to_string(point.kind));
  Locus locus(surface, subject_of(point), point.orbit.at.states.rows());
  OrbitPlace z{point.orbit.at.states, Eigen::Vector2d(point.orbit.at.value, second)};
  if (z.states.cols() != surface.family.shooting_intervals) {
    const auto cut = split_into_intervals(surface.at(second), z.states.col(0), z.values(0));
    if (!cut) {
      LocusCorrection none;
      none.message = "the orbit could not be divided into shooting intervals";
      return none;
    }
    z.states = cut->states;
  }
  return locus.begin(z, point.multiplier);
}

LocusTrace::LocusTrace(OrbitSurface surface, const LocusSubject& subject, LocusOptions options, LocusPoint start)
    : surface_(std::move(surface)), subject_(subject), options_(std::move(options)), start_(std::move(start)) {
  surface_.validate();
  options_.validate();
  const ContinuationOptions& range = options_.along;
  if (!(start_.first() >= range.from && start_.first() <= range.to && start_.second() >= options_.second_from &&
        start_.second() <= options_.second_to))
    throw InputError("the locus starts at " + short_text(start_.first()) + ", " + short_text(start_.second()) +
                     ", outside its rectangle");
  Locus locus(surface_, subject_, start_.at.states.rows());
  set_bounds(locus, options_, start_);
  before_ = state_.now = start_;
  state_.tangent_derivative = 0.0 * start_.at;
  state_.step = range.first_step;
}

OrbitPlace LocusTrace::guess(double step) const {
  return state_.now.at + step * state_.now.direction + (0.5 * step * step) * state_.tangent_derivative;
}

/// The edge that is met first between the current point and a place.
std::optional<LocusTrace::Edge> LocusTrace::edge_before(const OrbitPlace& there) const {
  std::optional<Edge> first;
  double least = 1.0;
  const auto request = [&](Eigen::Index parameter, double edge) {
    const double now = state_.now.at.values(parameter);
    const double part = (edge - now) / (there.values(parameter) - now);
    if (!(part > 0.0 && part <= least)) return;
    least = part;
    first = Edge{parameter, edge};
  };
  request(0, options_.along.from);
  request(0, options_.along.to);
  request(1, options_.second_from);
  request(1, options_.second_to);
  return first;
}

/// Is there nothing ahead but what is outside the rectangle?
bool LocusTrace::leaves_here() const {
  const auto leaves = [&](Eigen::Index parameter, double from, double to) {
    const double now = state_.now.at.values(parameter);
    const double component = state_.now.direction.values(parameter);
    return (now == to && component > 0.0) || (now == from && component < 0.0);
  };
  return leaves(0, options_.along.from, options_.along.to) || leaves(1, options_.second_from, options_.second_to);
}

bool LocusTrace::accept(const Locus& locus, const LocusCorrection& c, double step) {
  state_.evaluations += c.evaluations;
  if (!c.found) {
    state_.message = c.message;
    return false;
  }
  double angle = std::acos(std::clamp(locus.inner(state_.now.direction, c.point.direction), -1.0, 1.0));
  // The line of a fold's parameters may rotate by this multiple of the angle: its rotation identifies a cusp.
  constexpr double times = 4.0;
  if (subject_.kind == SpecialKind::fold)
    angle = std::max(angle, line_angle(locus.line(state_.now), locus.line(c.point)) / times);
  StepVerdict verdict = judge_step(options_.along, step, angle, c.distance,
                                   multiplier_change(locus.blocks(), state_.now.monodromy, c.point.monodromy));
  state_.message = std::move(verdict.reason);
  grow_ = verdict.grow;
  return verdict.good;
}

bool LocusTrace::back_at_the_start(Locus& locus, const LocusPoint& next, double step) const {
  if (!state_.left_start) return false;
  // Between this point and the next, with the same direction.
  const OrbitPlace to_start = start_.at - state_.now.at;
  const double ahead = locus.inner(to_start, state_.now.direction);
  if (ahead < 0.0 || ahead > step || locus.inner(next.direction, start_.direction) < 0.0) return false;
  if (locus.length(to_start) > 2.0 * step) return false;
  const LocusCorrection c = locus.correct(state_.now, guess(ahead), {&state_.now.direction});
  // Equal points of one locus: to the corrector's own accuracy, in parts of a step.
  constexpr double same = 1e-3;
  return c.found && locus.length(c.point.at - start_.at) < same * step;
}

bool LocusTrace::step_onto(Locus& locus, const Edge& edge, double step) {
  const double now = state_.now.at.values(edge.parameter);
  const double ahead = guess(step).values(edge.parameter);
  OrbitPlace on_the_edge = guess(std::clamp((edge.value - now) / (ahead - now), 0.0, 1.0) * step);
  on_the_edge.values(edge.parameter) = edge.value;
  const LocusCorrection c = locus.correct(state_.now, on_the_edge, {nullptr, edge.parameter});
  if (!accept(locus, c, step)) return false;
  // Another edge may have been passed before.
  if (const auto first = edge_before(c.point.at); first && first->parameter != edge.parameter) return false;
  take(locus, c.point);
  if (state_.end == LocusEnd::none) state_.end = LocusEnd::range;
  return true;
}

void LocusTrace::take(Locus& locus, LocusPoint next) {
  state_.marks = marks_between(locus, state_.now, next, options_);
  const auto met = std::find_if(state_.marks.begin(), state_.marks.end(), [&](const Codim2Point& mark) {
    return mark.kind == CodimTwo::resonance_1_1 || mark.kind == CodimTwo::resonance_1_2;
  });
  if (locus.form() == Form::pair && is_real_pair(next) && met != state_.marks.end()) {
    next = met->point;
    state_.marks.erase(met + 1, state_.marks.end());
    state_.end = LocusEnd::resonance;
  } else {
    set_bounds(locus, options_, next);
  }
  const double taken = locus.inner(next.at - state_.now.at, state_.now.direction);
  state_.tangent_derivative = (1.0 / taken) * (next.direction - state_.now.direction);
  before_ = std::exchange(state_.now, std::move(next));
  ++state_.points;
  if (locus.length(state_.now.at - start_.at) > 2.0 * state_.step) state_.left_start = true;
}

bool LocusTrace::advance() {
  if (state_.end != LocusEnd::none) return false;
  state_.marks.clear();
  if (state_.points >= options_.along.orbits) {
    state_.end = LocusEnd::many;
    return false;
  }
  if (leaves_here()) {
    state_.end = LocusEnd::range;
    return false;
  }
  Locus locus(surface_, subject_, state_.now.at.states.rows());
  for (;;) {
    const OrbitPlace ahead = guess(state_.step);
    if (const auto edge = edge_before(ahead)) {
      if (step_onto(locus, *edge, state_.step)) return true;
    } else {
      const LocusCorrection c = locus.correct(state_.now, ahead, {&state_.now.direction});
      // The step may have passed an edge that the guess did not reach: a shorter step decides.
      if (accept(locus, c, state_.step) && !edge_before(c.point.at)) {
        if (back_at_the_start(locus, c.point, state_.step)) {
          take(locus, start_);
          state_.end = LocusEnd::closed;
          return true;
        }
        take(locus, c.point);
        state_.step =
            std::clamp(state_.step * std::clamp(grow_, 0.3, 2.0), options_.along.min_step, options_.along.max_step);
        return true;
      }
    }
    if (state_.step <= options_.along.min_step) {
      state_.end = LocusEnd::min_step;
      return false;
    }
    state_.step = std::max(0.5 * state_.step, options_.along.min_step);
  }
}

}  // namespace epicyclic::analysis
