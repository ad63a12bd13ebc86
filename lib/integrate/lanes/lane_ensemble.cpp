#include "integrate/lanes/lane_ensemble.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <new>
#include <string_view>
#include <utility>

#include "core/errors.hpp"
#include "integrate/checks.hpp"

namespace epicyclic::integrate {

namespace {

constexpr std::size_t most_stages = 7;

/// A weighted sum of slopes, without the slopes of weight 0.
struct Terms {
  std::size_t count = 0;
  std::array<double, most_stages> weight{};
  std::array<std::size_t, most_stages> slope{};

  constexpr Terms() = default;
  constexpr Terms(std::initializer_list<double> weights) {
    std::size_t j = 0;
    for (const double w : weights) {
      if (w != 0.0) {
        weight[count] = w;
        slope[count++] = j;
      }
      ++j;
    }
  }
};

/// An explicit pair of orders 5 and 4.
struct Pair {
  std::string_view name;
  std::size_t stages;
  bool first_same_as_last;                ///< the last slope is taken at the step's end, where the next step starts
  std::array<double, most_stages> nodes;  ///< c
  std::array<Terms, most_stages> rows;    ///< of A, from the second on
  Terms weights;                          ///< b
  Terms differences;                      ///< b - b^

  /// Slopes at one node are taken at one place: the places' nodes, and which one each slope has. Place 0 is the step's
  /// start, `end` its end.
  struct Places {
    std::size_t count = 0;
    std::size_t end = 0;
    std::array<double, most_stages> node{};
    std::array<std::size_t, most_stages> of{};
  };
  [[nodiscard]] constexpr Places places() const {
    Places p;
    for (std::size_t j = 0; j < stages; ++j) {
      std::size_t k = 0;
      while (k < p.count && p.node[k] != nodes[j]) ++k;
      if (k == p.count) p.node[p.count++] = nodes[j];
      if (nodes[j] == 1.0) p.end = k;
      p.of[j] = k;
    }
    return p;
  }
};

constexpr std::array<Pair, 2> pairs = {{
    {"lanes-dopri5",
     7,
     true,
     {0.0, 1.0 / 5.0, 3.0 / 10.0, 4.0 / 5.0, 8.0 / 9.0, 1.0, 1.0},
     {{{},
       {1.0 / 5.0},
       {3.0 / 40.0, 9.0 / 40.0},
       {44.0 / 45.0, -56.0 / 15.0, 32.0 / 9.0},
       {19372.0 / 6561.0, -25360.0 / 2187.0, 64448.0 / 6561.0, -212.0 / 729.0},
       {9017.0 / 3168.0, -355.0 / 33.0, 46732.0 / 5247.0, 49.0 / 176.0, -5103.0 / 18656.0},
       {35.0 / 384.0, 0.0, 500.0 / 1113.0, 125.0 / 192.0, -2187.0 / 6784.0, 11.0 / 84.0}}},
     {35.0 / 384.0, 0.0, 500.0 / 1113.0, 125.0 / 192.0, -2187.0 / 6784.0, 11.0 / 84.0},
     {71.0 / 57600.0, 0.0, -71.0 / 16695.0, 71.0 / 1920.0, -17253.0 / 339200.0, 22.0 / 525.0, -1.0 / 40.0}},
    {"lanes-cash-karp",
     6,
     false,
     {0.0, 1.0 / 5.0, 3.0 / 10.0, 3.0 / 5.0, 1.0, 7.0 / 8.0},
     {{{},
       {1.0 / 5.0},
       {3.0 / 40.0, 9.0 / 40.0},
       {3.0 / 10.0, -9.0 / 10.0, 6.0 / 5.0},
       {-11.0 / 54.0, 5.0 / 2.0, -70.0 / 27.0, 35.0 / 27.0},
       {1631.0 / 55296.0, 175.0 / 512.0, 575.0 / 13824.0, 44275.0 / 110592.0, 253.0 / 4096.0}}},
     {37.0 / 378.0, 0.0, 250.0 / 621.0, 125.0 / 594.0, 0.0, 512.0 / 1771.0},
     {37.0 / 378.0 - 2825.0 / 27648.0, 0.0, 250.0 / 621.0 - 18575.0 / 48384.0, 125.0 / 594.0 - 13525.0 / 55296.0,
      -277.0 / 14336.0, 512.0 / 1771.0 - 1.0 / 4.0}},
}};

/// @throws InputError for a method that is not one of lanes
const Pair& pair_of(const std::string& method) {
  const auto it = std::find_if(pairs.begin(), pairs.end(), [&](const Pair& p) { return p.name == method; });
  if (it == pairs.end()) throw InputError("method = '" + method + "', must be one of lanes");
  return *it;
}

/// Memory aligned for registers.
class Numbers {
 public:
  explicit Numbers(std::size_t count)
      : data_(static_cast<double*>(::operator new(count * sizeof(double), std::align_val_t(64)))) {
    std::fill_n(data_.get(), count, 0.0);
  }
  [[nodiscard]] double* get() { return data_.get(); }
  [[nodiscard]] const double* get() const { return data_.get(); }
  double& operator[](std::size_t i) { return data_.get()[i]; }
  double operator[](std::size_t i) const { return data_.get()[i]; }

 private:
  struct Deleter {
    void operator()(double* p) const { ::operator delete(p, std::align_val_t(64)); }
  };
  std::unique_ptr<double, Deleter> data_;
};

/// Values of switching surfaces and d/ds of them.
struct SurfaceValues {
  explicit SurfaceValues(std::size_t count) : values(count), rates(count) {}
  Numbers values, rates;
};

}  // namespace

LaneField one_by_one(std::size_t width, std::size_t dimension, std::size_t surfaces) {
  struct Lane {
    // Its own: a lane that is idle is evaluated with the others, and its system may be gone.
    decltype(VectorField::right_hand_side) right_hand_side;
    SwitchingSurfaces surfaces;
    std::size_t segment = 0;
  };
  struct All {
    std::vector<Lane> lanes;
    std::vector<double> places, y, f, values, rates;
  };
  const auto all = std::make_shared<All>();
  all->lanes.resize(width);
  all->y.resize(dimension);
  all->f.resize(dimension);
  all->values.resize(surfaces);
  all->rates.resize(surfaces);
  LaneField field;
  field.width = width;
  field.dimension = dimension;
  field.load = [all, dimension, surfaces](std::size_t lane, const VectorField& system) {
    if (system.dimension != dimension)
      throw InputError("a system of dimension " + std::to_string(system.dimension) + " in a lane of " +
                       std::to_string(dimension));
    if (surfaces > 0 && system.surfaces.count != surfaces)
      throw InputError("a system of " + std::to_string(system.surfaces.count) + " switching surfaces in a lane of " +
                       std::to_string(surfaces));
    all->lanes[lane] = {system.right_hand_side, system.surfaces, 0};
  };
  field.set_segment = [all](std::size_t lane, std::size_t segment) { all->lanes[lane].segment = segment; };
  field.set_places = [all, width](std::size_t count, const double* s) { all->places.assign(s, s + count * width); };
  field.right_hand_side = [all, width, dimension](std::size_t place, const double* y, double* dyds) {
    const double* const s = all->places.data() + place * width;
    for (std::size_t lane = 0; lane < width; ++lane) {
      const Lane& own = all->lanes[lane];
      if (!own.right_hand_side) continue;
      for (std::size_t i = 0; i < dimension; ++i) all->y[i] = y[i * width + lane];
      own.right_hand_side(own.segment, s[lane], all->y.data(), all->f.data());
      for (std::size_t i = 0; i < dimension; ++i) dyds[i * width + lane] = all->f[i];
    }
  };
  field.surfaces = surfaces;
  field.surface_values = [all, width, dimension, surfaces](std::size_t place, const double* y, double* values,
                                                           double* rates) {
    const double* const s = all->places.data() + place * width;
    for (std::size_t lane = 0; lane < width; ++lane) {
      const Lane& own = all->lanes[lane];
      if (!own.surfaces.evaluate) continue;
      for (std::size_t i = 0; i < dimension; ++i) all->y[i] = y[i * width + lane];
      own.surfaces.evaluate(s[lane], all->y.data(), all->values.data(), all->rates.data());
      for (std::size_t k = 0; k < surfaces; ++k) {
        values[k * width + lane] = all->values[k];
        rates[k * width + lane] = all->rates[k];
      }
    }
  };
  return field;
}

class LaneEnsemble::Impl {
 public:
  Impl(LaneField field, const IntegratorOptions& options, const StepLoops& kernels)
      : field_(std::move(field)),
        options_(options),
        pair_(pair_of(options.method)),
        places_(pair_.places()),
        gap_(widest_gap({pair_.nodes.data(), pair_.stages})),
        kernels_(kernels),
        w_(kernels.width),
        n_(field_.dimension),
        y_(n_ * w_),
        next_(n_ * w_),
        k_{Numbers(n_ * w_), Numbers(n_ * w_), Numbers(n_ * w_), Numbers(n_ * w_),
           Numbers(n_ * w_), Numbers(n_ * w_), Numbers(n_ * w_)},
        start_(field_.surfaces * w_),
        end_(field_.surfaces * w_),
        at_(most_stages * w_),
        relative_(w_),
        absolute_(w_),
        lanes_(w_),
        sample_(n_) {
    options_.validate();
    if (field_.width != w_)
      throw InputError("a field of " + std::to_string(field_.width) + " lanes in loops of " + std::to_string(w_));
    for (std::size_t lane = 0; lane < w_; ++lane)
      set_tolerances(lane, options_.relative_tolerance, options_.absolute_tolerance);
    find_slopes();
  }

  std::size_t width() const { return w_; }

  void set_tolerances(std::size_t lane, double relative, double absolute) {
    relative_[lane] = relative;
    absolute_[lane] = absolute;
  }

  void keep_together() { together_ = true; }

  void control(std::size_t n, std::size_t vectors, bool last_is_parameter) {
    controlled_ = n;
    vectors_ = vectors;
    last_is_parameter_ = last_is_parameter;
  }

  void load(std::size_t lane, const VectorField& system) {
    check_field(system);
    field_.load(lane, system);
    Lane& l = lanes_[lane];
    l = {};
    l.system = &system;
    steps_.attempts[lane] = 0;
  }

  void begin(std::size_t lane, std::span<const double> state, double from, double to, std::span<const double> samples,
             const Observer& observer) {
    Lane& l = lanes_[lane];
    if (state.size() != n_)
      throw InputError("a state of " + std::to_string(state.size()) + " numbers for a field of dimension " +
                       std::to_string(n_));
    check_interval(from, to);
    check_samples(from, samples);
    for (std::size_t i = 0; i < n_; ++i) y_[i * w_ + lane] = state[i];
    l.samples = samples;
    l.observer = observer ? &observer : nullptr;
    l.next_sample = 0;
    l.stops = breakpoints_between(*l.system, from, to);
    l.stops.push_back(to);
    l.next_stop = 0;
    const double periods = l.system->period > 0.0 ? std::ceil((to - from) / l.system->period) : 1.0;
    l.evolution = {Outcome::reached, from, {}};
    if (!std::exchange(l.busy, true)) ++running_;
    steps_.s[lane] = from;
    steps_.stop[lane] = l.stops.front();
    steps_.proposed[lane] = l.proposed;
    steps_.running[lane] = all_bits;
    steps_.refused[lane] = 0;
    steps_.hopping[lane] = 0;
    steps_.hop[lane] = 0.0;
    steps_.allowed[lane] =
        steps_.attempts[lane] + static_cast<long long>(std::max(1.0, periods)) * options_.max_steps_per_period;
    await_sample(lane);
    enter_segment(lane);
  }

  bool busy(std::size_t lane) const { return lanes_[lane].busy; }

  std::size_t run() {
    for (std::size_t lane = 0; lane < w_; ++lane)
      if (lanes_[lane].busy && lanes_[lane].ended) return take(lane);
    if (running_ == 0) return w_;
    for (;;) {
      if (!step()) continue;
      for (std::size_t lane = 0; lane < w_; ++lane)
        if (lanes_[lane].ended) return take(lane);
    }
  }

  const Evolution& evolution(std::size_t lane) const { return lanes_[lane].evolution; }
  void copy_state(std::size_t lane, std::span<double> state) const {
    for (std::size_t i = 0; i < n_; ++i) state[i] = y_[i * w_ + lane];
  }
  double next_step(std::size_t lane) const { return lanes_[lane].proposed; }
  void set_next_step(std::size_t lane, double step) { lanes_[lane].proposed = step; }
  Work work(std::size_t lane) const {
    Work work;
    work.steps = static_cast<long>(steps_.attempts[lane]);
    work.right_hand_sides =
        lanes_[lane].more_slopes + work.steps * static_cast<long>(pair_.stages - (pair_.first_same_as_last ? 1 : 0));
    return work;
  }
  std::size_t evaluations() const { return evaluated_; }
  std::size_t evaluations_in_progress() const { return in_progress_; }

 private:
  static constexpr long long all_bits = -1;

  struct Lane {
    const VectorField* system = nullptr;
    bool busy = false;
    bool ended = false;
    bool fresh = false;         ///< its first slope is not that of this place yet
    double proposed = 0;        ///< length of the next evolution's first step; 0 if not known
    std::vector<double> stops;  ///< breakpoints up to the end, and the end
    std::size_t next_stop = 0;
    std::span<const double> samples;
    const Observer* observer = nullptr;
    std::size_t next_sample = 0;
    Evolution evolution;
    long more_slopes = 0;  ///< than those of its attempts, since it was loaded
  };

  std::size_t take(std::size_t lane) {
    Lane& l = lanes_[lane];
    l.busy = l.ended = false;
    l.proposed = steps_.proposed[lane];
    // An idle lane takes steps of length 0.
    steps_.proposed[lane] = 0.0;
    steps_.running[lane] = 0;
    --running_;
    return lane;
  }

  void end(Lane& l, Outcome outcome, double s, std::string message) {
    l.evolution = {outcome, s, std::move(message)};
    l.ended = true;
  }

  void enter_segment(std::size_t lane) {
    Lane& l = lanes_[lane];
    const std::size_t segment = segment_after(*l.system, steps_.s[lane]);
    field_.set_segment(lane, segment);
    steps_.longest[lane] = longest_step(*l.system, options_, segment, gap_);
    l.fresh = true;
    ++fresh_;
  }

  /// Passes the places of the step to the field, without its start if the slopes there are known.
  void set_places(bool with_start) {
    first_place_ = with_start ? 0 : 1;
    field_.set_places(places_.count - first_place_, at_.get() + first_place_ * w_);
  }

  void evaluate(std::size_t place, const double* y, Numbers& slope) {
    field_.right_hand_side(place - first_place_, y, slope.get());
    ++evaluated_;
    in_progress_ += running_;
  }

  void measure_surfaces(std::size_t place, const double* y, SurfaceValues& surfaces) {
    if (field_.surfaces > 0)
      field_.surface_values(place - first_place_, y, surfaces.values.get(), surfaces.rates.get());
  }

  /// The slopes that a sum is made of.
  using Slopes = std::array<const double*, most_stages>;

  /// To be called when slopes have changed places.
  void find_slopes() {
    const auto of = [&](const Terms& terms) {
      Slopes slopes{};
      for (std::size_t j = 0; j < terms.count; ++j) slopes[j] = k_[terms.slope[j]].get();
      return slopes;
    };
    for (std::size_t j = 0; j < pair_.stages; ++j) row_slopes_[j] = of(pair_.rows[j]);
    weight_slopes_ = of(pair_.weights);
    difference_slopes_ = of(pair_.differences);
  }

  void advance_by(const Terms& terms, const Slopes& slopes) {
    kernels_.stage(n_, terms.count, terms.weight.data(), slopes.data(), steps_.h.data(), y_.get(), next_.get());
  }

  /// The first slope of each lane's step. Lanes that have theirs take them anew at the same places: the same bits.
  void take_first_slopes(std::size_t place) {
    evaluate(place, y_.get(), k_[0]);
    if (fresh_ == 0) return;
    measure_surfaces(place, y_.get(), start_);
    for (Lane& l : lanes_) {
      if (l.busy && l.fresh && pair_.first_same_as_last) ++l.more_slopes;
      l.fresh = false;
    }
    fresh_ = 0;
  }

  /// Slopes at the ends of the steps, if a sample inside of one is wanted.
  void take_last_slopes() {
    if (pair_.first_same_as_last) return;
    bool wanted = false;
    for (std::size_t lane = 0; lane < w_; ++lane) {
      if (steps_.event[lane] == 0 || steps_.accepted[lane] == 0 || steps_.sample[lane] >= steps_.end[lane]) continue;
      ++lanes_[lane].more_slopes;
      wanted = true;
    }
    if (wanted) evaluate(places_.end, next_.get(), k_[most_stages - 1]);
  }

  /// A first guess of a step's length is made of the slope.
  bool needs_guess(std::size_t lane) const { return lanes_[lane].busy && steps_.proposed[lane] <= 0.0; }

  void guess_first_steps() {
    bool needed = false;
    for (std::size_t lane = 0; lane < w_; ++lane) needed = needed || needs_guess(lane);
    if (!needed) return;
    first_place_ = 0;
    field_.set_places(1, steps_.s.data());
    take_first_slopes(0);
    have_first_ = true;
    for (std::size_t lane = 0; lane < w_; ++lane)
      if (needs_guess(lane)) steps_.proposed[lane] = first_step(lane);
  }

  /// How far before a surface steps land, in parts of the refused step [I-hop]: as near as lets errors of vectors pass
  /// where they count, and no nearer than places of surfaces are good to where nothing else sees them.
  double margin() const {
    if (controlled_ == n_) return 0.0;
    return vectors_ > 0 ? 1e-3 : 1e-2;
  }

  /// One attempt in each lane.
  /// @returns whether a lane may have ended
  bool step() {
    // The field still has the places of the last step, at whose end all lanes are.
    have_first_ = fresh_ == 0 && pair_.first_same_as_last;
    if (fresh_ > 0) {
      guess_first_steps();
    } else if (!have_first_ && all_at_end_) {
      take_first_slopes(places_.end);
      have_first_ = true;
    }
    kernels_.measure(steps_, places_.count, places_.node.data(), at_.get());
    set_places(!have_first_);
    if (!have_first_) take_first_slopes(0);
    for (std::size_t j = 1; j < pair_.stages; ++j) {
      advance_by(pair_.rows[j], row_slopes_[j]);
      evaluate(places_.of[j], next_.get(), k_[j]);
    }
    if (!pair_.first_same_as_last) advance_by(pair_.weights, weight_slopes_);
    const Terms& e = pair_.differences;
    kernels_.error(controlled_, e.count, e.weight.data(), difference_slopes_.data(), steps_.h.data(), y_.get(),
                   next_.get(), relative_.get(), absolute_.get(), steps_.norm.data(), steps_.largest.data());
    for (std::size_t j = 1; j <= vectors_; ++j) worst_with_vector(j);
    if (together_) share_norm();
    measure_surfaces(places_.end, next_.get(), end_);
    if (margin() > 0.0) kernels_.refuse_crossings(steps_, field_.surfaces, start_.values.get(), end_.values.get());
    const LaneVerdict verdict = kernels_.judge(steps_, options_.escape_bound);
    if (verdict.accepted < running_)
      kernels_.land(steps_, margin(), field_.surfaces, start_.values.get(), start_.rates.get(), end_.values.get(),
                    end_.rates.get());
    if (verdict.eventful) handle_events();
    all_at_end_ = verdict.accepted == running_;
    if (verdict.accepted == w_) {
      std::swap(y_, next_);
      std::swap(start_, end_);
      if (pair_.first_same_as_last) {
        std::swap(k_[0], k_[most_stages - 1]);
        find_slopes();
      }
    } else {
      kernels_.accept(n_, steps_.accepted.data(), next_.get(), y_.get());
      kernels_.accept(field_.surfaces, steps_.accepted.data(), end_.values.get(), start_.values.get());
      kernels_.accept(field_.surfaces, steps_.accepted.data(), end_.rates.get(), start_.rates.get());
      if (pair_.first_same_as_last) kernels_.accept(n_, steps_.accepted.data(), k_[most_stages - 1].get(), k_[0].get());
    }
    kernels_.accept(1, steps_.accepted.data(), steps_.end.data(), steps_.s.data());
    if (verdict.eventful) arrive();
    return verdict.eventful;
  }

  /// At events other than stops.
  void handle_events() {
    take_last_slopes();
    for (std::size_t lane = 0; lane < w_; ++lane) {
      if (steps_.event[lane] == 0) continue;
      if (steps_.accepted[lane] != 0) {
        observe(lane);
      } else {
        give_up(lane);
      }
    }
  }

  void worst_with_vector(std::size_t j) {
    const Terms& terms = pair_.differences;
    const std::size_t first = j * controlled_ * w_;
    Slopes slopes = difference_slopes_;
    for (std::size_t k = 0; k < terms.count; ++k) slopes[k] += first;
    const double least = last_is_parameter_ && (j + 1) * controlled_ == n_ ? 1.0 : 0.0;
    kernels_.vector_error(controlled_, terms.count, terms.weight.data(), slopes.data(), steps_.h.data(),
                          y_.get() + first, relative_.get(), absolute_.get(), least, steps_.norm.data());
  }

  /// The worst of all lanes is that of each.
  void share_norm() {
    double worst = 0.0;
    for (std::size_t lane = 0; lane < w_; ++lane)
      if (!(steps_.norm[lane] <= worst)) worst = steps_.norm[lane];
    steps_.norm.fill(worst);
  }

  /// Ends the evolution of a lane whose step was not accepted and cannot be repeated.
  void give_up(std::size_t lane) {
    Lane& l = lanes_[lane];
    const double s = steps_.s[lane];
    if (steps_.norm[lane] <= 1.0 && std::isfinite(steps_.largest[lane])) {
      end(l, Outcome::diverged, s, "a component left the escape bound");
    } else if (steps_.attempts[lane] >= steps_.allowed[lane]) {
      end(l, Outcome::step_limit, s, "more steps than allowed");
    } else {
      end(l, Outcome::failed, s, "no step is accepted");
    }
  }

  /// Lanes that have come to a stop, or have had as many attempts as allowed.
  void arrive() {
    for (std::size_t lane = 0; lane < w_; ++lane) {
      if (steps_.event[lane] == 0 || steps_.accepted[lane] == 0) continue;
      Lane& l = lanes_[lane];
      const double s = steps_.s[lane];
      if (steps_.cut[lane] != 0) {
        if (++l.next_stop == l.stops.size()) {
          end(l, Outcome::reached, s, {});
          continue;
        }
        steps_.stop[lane] = l.stops[l.next_stop];
        enter_segment(lane);
      }
      if (steps_.attempts[lane] >= steps_.allowed[lane]) end(l, Outcome::step_limit, s, "more steps than allowed");
    }
  }

  /// A first guess of which the change by the slope is a hundredth of the state, both in the norm of the error.
  double first_step(std::size_t lane) const {
    double size = 0.0;
    double speed = 0.0;
    for (std::size_t i = 0; i < controlled_; ++i) {
      const double x = y_[i * w_ + lane];
      const double scale = relative_[lane] * std::abs(x) + absolute_[lane];
      size += x / scale * (x / scale);
      speed += k_[0][i * w_ + lane] / scale * (k_[0][i * w_ + lane] / scale);
    }
    const double whole = steps_.stop[lane] - steps_.s[lane];
    constexpr double part = 1e-2;
    constexpr double careful = 1e-6;
    const double h = size > 0.0 && speed > 0.0 ? part * std::sqrt(size / speed) : careful * whole;
    return std::isfinite(h) ? std::min(h, whole) : careful * whole;
  }

  void await_sample(std::size_t lane) {
    const Lane& l = lanes_[lane];
    steps_.sample[lane] =
        l.next_sample < l.samples.size() ? l.samples[l.next_sample] : std::numeric_limits<double>::infinity();
  }

  void observe(std::size_t lane) {
    Lane& l = lanes_[lane];
    const double arrived = steps_.end[lane];
    while (steps_.sample[lane] <= arrived) {
      const double at = steps_.sample[lane];
      const double h = steps_.h[lane];
      const double u = (at - steps_.s[lane]) / h;
      const double v = 1.0 - u;
      const double of_start = (1.0 + 2.0 * u) * v * v;
      const double of_end = u * u * (1.0 + 2.0 * v);
      const double of_slopes = u * v * h;
      const double* const first = k_[0].get() + lane;
      const double* const last = k_[most_stages - 1].get() + lane;
      for (std::size_t i = 0, c = lane; i < n_; ++i, c += w_)
        sample_[i] = at == arrived
                         ? next_[c]
                         : of_start * y_[c] + of_end * next_[c] + of_slopes * (v * first[i * w_] - u * last[i * w_]);
      if (l.observer != nullptr) (*l.observer)(l.next_sample, at, sample_);
      ++l.next_sample;
      await_sample(lane);
    }
  }

  LaneField field_;
  IntegratorOptions options_;
  // Copies: two cores share no more of what each step reads than they have to, see kernel_copies.
  const Pair pair_;
  const Pair::Places places_;
  const double gap_;
  const StepLoops kernels_;
  std::size_t w_;
  std::size_t n_;
  std::size_t controlled_ = n_;  ///< components of the state, whose error counts
  std::size_t vectors_ = 0;      ///< tangent vectors whose error counts too
  bool last_is_parameter_ = false;
  bool together_ = false;
  Numbers y_, next_;
  std::array<Numbers, most_stages> k_;  ///< the last one: slopes at the end of the step
  std::array<Slopes, most_stages> row_slopes_{};
  Slopes weight_slopes_{}, difference_slopes_{};
  LaneSteps steps_;
  SurfaceValues start_, end_;    ///< at the ends of the step
  Numbers at_;                   ///< places of the slopes
  Numbers relative_, absolute_;  ///< tolerances of each lane
  std::vector<Lane> lanes_;
  std::vector<double> sample_;
  std::size_t running_ = 0;      ///< lanes in progress
  std::size_t fresh_ = 0;        ///< above 0 if there is a fresh one
  bool have_first_ = false;      ///< slopes at the starts of the steps
  bool all_at_end_ = false;      ///< all lanes in progress are where their last step was to end
  std::size_t first_place_ = 0;  ///< of those passed to the field
  std::size_t evaluated_ = 0;
  std::size_t in_progress_ = 0;  ///< lanes, summed over evaluations
};

LaneEnsemble::LaneEnsemble(LaneField field, const IntegratorOptions& options, const StepLoops& kernels)
    : impl_(std::make_unique<Impl>(std::move(field), options, kernels)) {}
LaneEnsemble::~LaneEnsemble() = default;

std::size_t LaneEnsemble::width() const { return impl_->width(); }
void LaneEnsemble::control(std::size_t n, std::size_t vectors, bool last_is_parameter) {
  impl_->control(n, vectors, last_is_parameter);
}
void LaneEnsemble::keep_together() { impl_->keep_together(); }
void LaneEnsemble::set_tolerances(std::size_t lane, double relative, double absolute) {
  impl_->set_tolerances(lane, relative, absolute);
}
void LaneEnsemble::load(std::size_t lane, const VectorField& system) { impl_->load(lane, system); }
void LaneEnsemble::begin(std::size_t lane, std::span<const double> state, double from, double to,
                         std::span<const double> samples, const Observer& observer) {
  impl_->begin(lane, state, from, to, samples, observer);
}
bool LaneEnsemble::busy(std::size_t lane) const { return impl_->busy(lane); }
std::size_t LaneEnsemble::run() { return impl_->run(); }
const Evolution& LaneEnsemble::evolution(std::size_t lane) const { return impl_->evolution(lane); }
void LaneEnsemble::copy_state(std::size_t lane, std::span<double> state) const { impl_->copy_state(lane, state); }
double LaneEnsemble::next_step(std::size_t lane) const { return impl_->next_step(lane); }
void LaneEnsemble::set_next_step(std::size_t lane, double step) { impl_->set_next_step(lane, step); }
Work LaneEnsemble::work(std::size_t lane) const { return impl_->work(lane); }
std::size_t LaneEnsemble::evaluations() const { return impl_->evaluations(); }
std::size_t LaneEnsemble::evaluations_in_progress() const { return impl_->evaluations_in_progress(); }

}  // namespace epicyclic::integrate
