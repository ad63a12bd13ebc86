// The Flow that every solver of SUNDIALS is wrapped into; `Stepper` is what differs between ARKODE's and CVODE's.
//
// An evolution is split at the breakpoints. Each segment restarts the solver, makes it stop exactly at the segment's
// end, and takes one step at a time. So samples, the escape bound, the step limit and contact changes are tested at
// every accepted step. A Stepper has
//
//   Stepper(SundialsSystem&, N_Vector, SUNContext, const Method&, const IntegratorOptions&, double fixed_step)
//   void start(double s, N_Vector y, double first_step)      restart; 0 lets the solver choose the step
//   void limit_step(double longest)                          infinite: no limit
//   double gap()                                             [I-sample]
//   void stop_at(double s)
//   Step step(double to, N_Vector y, double& reached)
//   void dense(double s, N_Vector y)                         within the last step
//   double proposed_step() ,  long attempts()                since the restart
//   static constexpr bool carries_step                       whether a step's length is taken over a restart
//
// Private to integrate.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/errors.hpp"
#include "core/root_finding.hpp"
#include "integrate/checks.hpp"
#include "integrate/flow.hpp"
#include "integrate/methods.hpp"
#include "integrate/options.hpp"
#include "integrate/sundials/state_vector.hpp"
#include "integrate/sundials/sundials_system.hpp"

namespace epicyclic::integrate {

/// What one call of a solver has done.
enum class Step { accepted, at_stop, refused };

/// One solver with its vectors: for the state alone, or for the state with a number of tangent vectors.
template <class Stepper>
class Integration {
 public:
  Integration(const VectorField& field, const IntegratorOptions& options, const Method& method, double fixed_step,
              const VectorShape& shape, bool parameter)
      : context_(make_context()),
        y_(make_state_vector(shape, context_.get())),
        sample_(make_state_vector(shape, context_.get())),
        before_(make_state_vector(shape, context_.get())),
        system_{.field = &field, .options = &options, .parameter = parameter, .message = {}, .thrown = {}},
        stepper_(system_, y_.get(), context_.get(), method, options, fixed_step),
        fixed_(fixed_step > 0.0) {}

  [[nodiscard]] const Work& work() const { return system_.work; }
  [[nodiscard]] VectorShape shape() const { return shape_of(y_.get()); }
  [[nodiscard]] bool parameter() const { return system_.parameter; }
  [[nodiscard]] double* column(std::size_t j) { return data_of(y_.get()) + j * column_stride(y_.get()); }

  /// Evolves the columns from `from` to `to`.
  /// @param next_step  length of the first step, replaced by that of the next one
  Evolution evolve(double from, double to, std::span<const double> samples, const Observer& observer,
                   double& next_step) {
    check_interval(from, to);
    check_samples(from, samples);
    const VectorField& field = *system_.field;
    std::vector<double> stops = breakpoints_between(field, from, to);
    stops.push_back(to);
    const double periods = field.period > 0.0 ? std::ceil((to - from) / field.period - 1e-9) : 1.0;
    steps_left_ = system_.options->max_steps_per_period * static_cast<long>(std::max(1.0, periods));
    samples_ = samples;
    observer_ = &observer;
    next_sample_ = 0;
    double s = from;
    for (const double stop : stops) {
      Evolution part = evolve_segment(s, stop, next_step);
      if (!part.reached()) return part;
      s = stop;
    }
    return {Outcome::reached, to, {}};
  }

 private:
  /// Where the present step is to end.
  struct Crossing {
    std::size_t surface = 0;
    double s = 0;
    bool extremum = false;  ///< not of the surface: its value is so near to it that the step has to determine the side
  };

  Evolution evolve_segment(double from, double to, double& next_step) {
    const IntegratorOptions& options = *system_.options;
    N_Vector y = y_.get();
    const VectorKernels& kernels = kernels_of(y);
    const bool only_column = shape().columns == 1;
    const double bound = std::min(options.escape_bound, std::numeric_limits<double>::max());
    system_.segment = segment_after(*system_.field, from);
    if (!fixed_) stepper_.limit_step(longest_step(*system_.field, options, system_.segment, stepper_.gap()));
    system_.message.clear();
    if (options.locate_contacts) find_sides(from);

    double s = from;
    double target = to;
    bool crossing_ahead = false;
    bool extremum_ahead = false;
    Crossing crossing;
    double proposed = next_step;
    int stalled = 0;
    restart(s, proposed, target);
    while (s < to) {
      const double before = proposed;
      const double s_before = s;
      std::copy_n(data_of(y), padded_size(y), data_of(before_.get()));
      double reached = s;
      const Step step = stepper_.step(target, y, reached);
      system_.rethrow();
      if (step == Step::refused) return fail(s, system_.message);
      const bool at_stop = step == Step::at_stop || reached >= target;
      const bool inside = kernels.within(data_of(y), bound, column_stride(y));
      if (!(inside && only_column) && !finite(y)) return fail(s, "the state is not finite after a step");
      const double arrived = at_stop ? target : reached;
      if (options.locate_contacts && !crossing_ahead && find_crossing(s_before, arrived, before, crossing)) {
        crossing_ahead = !crossing.extremum;
        extremum_ahead = crossing.extremum;
        target = crossing.s;
        step_again(s_before, std::min(before, target - s_before), target);
        proposed = before;
        continue;
      }
      s = arrived;
      system_.phase = s;
      observe(s);
      proposed = stepper_.proposed_step();
      // A step cut short by the stop says nothing against the longer one that was proposed before it.
      if (at_stop) proposed = std::max(proposed, before);
      if (!fixed_) next_step = proposed;
      // Steps at the rounding of s lead nowhere; one such step may be what a stop has left over.
      const bool tiny = s - s_before <= 4.0 * std::numeric_limits<double>::epsilon() * std::max(std::abs(s), 1.0);
      stalled = tiny && !at_stop ? stalled + 1 : 0;
      const bool spent = spent_ + stepper_.attempts() >= steps_left_ && s < to;
      if (!inside || spent || stalled > 3) return give_up(s, inside, spent);
      if (options.locate_contacts) remember_surfaces(s);
      if (at_stop && (crossing_ahead || extremum_ahead) && s < to) {
        if (crossing_ahead) side_[crossing.surface] = !side_[crossing.surface];
        crossing_ahead = extremum_ahead = false;
        target = to;
        spent_ += stepper_.attempts();
        restart(s, proposed, target);
      }
    }
    steps_left_ -= spent_ + stepper_.attempts();
    return end(Outcome::reached, to, {});
  }

  /// After a step that left the bound, was the last one allowed, or came to nothing once too often.
  Evolution give_up(double s, bool inside, bool spent) {
    const IntegratorOptions& options = *system_.options;
    if (!inside)
      return end(Outcome::diverged, s,
                 "a component of the state left the bound " + std::to_string(options.escape_bound));
    if (spent)
      return end(Outcome::step_limit, s,
                 "more than " + std::to_string(options.max_steps_per_period) + " steps in a period");
    return end(Outcome::failed, s, "the step has shrunk to the rounding of s");
  }

  /// Back to the last step's beginning, s, to end it on `target`.
  void step_again(double s, double first_step, double target) {
    std::copy_n(data_of(before_.get()), padded_size(y_.get()), data_of(y_.get()));
    spent_ += stepper_.attempts();
    restart(s, first_step, target);
  }

  void restart(double s, double first_step, double target) {
    system_.phase = s;
    stepper_.start(s, y_.get(), fixed_ ? 0.0 : first_step);
    stepper_.stop_at(target);
  }

  Evolution end(Outcome outcome, double s, std::string message) {
    system_.work.steps += spent_ + stepper_.attempts();
    spent_ = 0;
    return {outcome, s, std::move(message)};
  }

  /// The last step came to nothing: the state is that before it.
  Evolution fail(double s, std::string message) {
    std::copy_n(data_of(before_.get()), padded_size(y_.get()), data_of(y_.get()));
    if (message.empty()) message = "the solver gave up without a message";
    return end(Outcome::failed, s, std::move(message));
  }

  void observe(double s) {
    const std::size_t n = system_.field->dimension;
    while (next_sample_ < samples_.size() && samples_[next_sample_] <= s) {
      const double at = samples_[next_sample_];
      if (at == s) {
        (*observer_)(next_sample_, s, {data_of(y_.get()), n});
      } else {
        stepper_.dense(at, sample_.get());
        (*observer_)(next_sample_, at, {data_of(sample_.get()), n});
      }
      ++next_sample_;
    }
  }

  // ---- contact changes ----------------------------------------------------------------------------------------------

  /// Values of all surfaces.
  const std::vector<double>& surfaces(double s, N_Vector y) {
    const SwitchingSurfaces& all = system_.field->surfaces;
    values_.resize(all.count);
    rates_.resize(all.count);
    if (all.count > 0) all.evaluate(s, data_of(y), values_.data(), rates_.data());
    return values_;
  }
  [[nodiscard]] double surface(std::size_t k, double s, N_Vector y) { return surfaces(s, y)[k]; }

  void find_sides(double s) {
    side_.clear();
    for (const double value : surfaces(s, y_.get())) side_.push_back(value > 0.0);
    remember_surfaces(s);
  }

  /// Values and rates where the next step begins.
  void remember_surfaces(double s) {
    start_values_ = surfaces(s, y_.get());
    start_rates_ = rates_;
  }

  /// How a step may have been on the other side of a surface that it begins and ends on one side of.
  struct Visit {
    double s = 0;        ///< of the extremum
    bool clear = false;  ///< it is beyond the surface, else too near to decide
  };

  /// An orbit that just makes or loses contact does so between the ends of a step.
  /// @param along  the surface's value within the step, positive on the side of the ends
  template <class Along>
  [[nodiscard]] std::optional<Visit> visit(std::size_t k, double a, double b, double value, double rate, Along along) {
    const double sign = side_[k] ? 1.0 : -1.0;
    const double h = b - a;
    const double v0 = sign * start_values_[k], v1 = sign * value;
    const double d0 = sign * start_rates_[k] * h, d1 = sign * rate * h;
    if (!(d0 < 0.0 && d1 > 0.0)) return std::nullopt;
    // The extremum of the cubic through both ends.
    const double c2 = 3.0 * (v1 - v0) - 2.0 * d0 - d1, c3 = d0 + d1 - 2.0 * (v1 - v0);
    const double t = std::clamp(-d0 / (c2 + std::sqrt(std::max(0.0, c2 * c2 - 3.0 * c3 * d0))), 0.0, 1.0);
    const double least = v0 + t * (d0 + t * (c2 + t * c3));
    // The error of the cubic is of the fourth power of the step: far from the surface no test is needed.
    constexpr double far = 0.3;
    const double scale = std::max(v0, v1);
    if (!(least < far * scale)) return std::nullopt;
    const auto slope = [&](double s) {
      (void)along(s);
      return sign * rates_[k];
    };
    const double low = a + nearest_extremum * h, high = b - nearest_extremum * h;
    if (!(slope(low) < 0.0 && slope(high) > 0.0)) return std::nullopt;
    const double s = find_root(slope, low, high);
    // The dense output is off by less.
    constexpr double near = 0.03;
    const double there = along(s);
    if (there > near * scale) return std::nullopt;
    return Visit{s, there < -near * scale};
  }

  /// Of the step: an extremum nearer to its ends is as good as on the end, to the square of that.
  static constexpr double nearest_extremum = 1e-3;

  /// Of the step: a crossing nearer to its ends is on the end.
  static constexpr double nearest_to_ends = 1e-6;

  /// The first surface that the accepted step from a to b has crossed, and where: the root of its value along steps of
  /// the method itself. So the crossing is as accurate as the method, more accurate than its dense output.
  bool find_crossing(double a, double b, double first_step, Crossing& crossing) {
    bool found = false;
    const std::vector<double> at_end = surfaces(b, y_.get());
    const std::vector<double> rates_at_end = rates_;
    // A step this short has no places between its ends, and the error of a kink in it is of the order of its square.
    const bool resolved = nearest_to_ends * (b - a) > 4.0 * std::numeric_limits<double>::epsilon() * std::max(1.0, b);
    for (std::size_t k = 0; k < side_.size(); ++k) {
      const double sign = side_[k] ? 1.0 : -1.0;
      const auto along = [&](double s) {
        stepper_.dense(s, sample_.get());
        return sign * surface(k, s, sample_.get());
      };
      double end = b;
      if ((at_end[k] > 0.0) == side_[k]) {
        const auto there = resolved ? visit(k, a, b, at_end[k], rates_at_end[k], along) : std::nullopt;
        if (!there) continue;
        if (!there->clear) {
          if (!found || there->s < crossing.s) crossing = {k, there->s, true};
          found = true;
          continue;
        }
        end = there->s;
      } else if (!resolved) {
        side_[k] = !side_[k];
        continue;
      }
      // Just after a crossing of the same surface, its value is rounding, of either sign.
      const double at_start = sign * start_values_[k];
      const double length = b - a;
      constexpr double nothing = 1e-9;
      const double low = at_start > 0.0 ? a : a + nothing * length;
      if (at_start <= 0.0 && !(low > a && along(low) > 0.0)) {
        side_[k] = !side_[k];
        continue;
      }
      // The dense output ends beside the state by rounding: a crossing within that is at the end.
      const double s =
          along(end) > 0.0 ? end : find_root([&](double x) { return x <= a ? at_start : along(x); }, low, end);
      if (!found || s < crossing.s) crossing = {k, s};
      found = true;
    }
    if (!found || crossing.extremum) return found;
    crossing.s = refine(crossing, a, b, first_step);
    return true;
  }

  /// The dense output's root corrected by steps of the method itself from the step's beginning (secant).
  double refine(const Crossing& guess, double a, double b, double first_step) {
    const double length = b - a;
    constexpr int most = 20;
    if (guess.s - a < nearest_to_ends * length) return guess.s > a ? guess.s : a + nearest_to_ends * length;
    const auto value = [&](double s) {
      std::copy_n(data_of(before_.get()), padded_size(y_.get()), data_of(sample_.get()));
      spent_ += stepper_.attempts();
      stepper_.start(a, sample_.get(), std::min(first_step, s - a));
      stepper_.stop_at(s);
      double reached = a;
      while (reached < s)
        if (stepper_.step(s, sample_.get(), reached) != Step::accepted) break;
      return surface(guess.surface, s, sample_.get());
    };
    double x0 = guess.s;
    double f0 = value(x0);
    double x1 = x0 + (x0 - a < b - x0 ? 1.0 : -1.0) * 1e-4 * length;
    for (int i = 0; i < most && f0 != 0.0; ++i) {
      const double f1 = value(x1);
      if (f1 == f0) break;
      const double x2 = x1 - f1 * (x1 - x0) / (f1 - f0);
      x0 = x1;
      f0 = f1;
      x1 = std::clamp(x2, a + nearest_to_ends * length, b);
      if (std::abs(x1 - x0) <= 4.0 * std::numeric_limits<double>::epsilon() * std::max(1.0, std::abs(x1))) break;
    }
    return x1;
  }

  Context context_;
  Vector y_, sample_, before_;
  SundialsSystem system_;
  Stepper stepper_;
  bool fixed_;
  std::span<const double> samples_;
  const Observer* observer_ = nullptr;
  std::size_t next_sample_ = 0;
  long steps_left_ = 0;
  long spent_ = 0;  ///< attempts before the last restart within a segment
  std::vector<bool> side_;
  std::vector<double> values_, rates_;              ///< of surfaces
  std::vector<double> start_values_, start_rates_;  ///< where the present step begins
};

template <class Stepper>
class SundialsFlow final : public Flow {
 public:
  SundialsFlow(VectorField field, const IntegratorOptions& options, const Method& method, double fixed_step)
      : field_(std::move(field)), options_(options), method_(method), fixed_step_(fixed_step) {
    options.validate();
    check_field(field_);
    if (method.implicit() && !field_.tangents)
      throw InputError("the implicit method '" + std::string(method.name) + "' needs a field with tangents");
    state_ = make({field_.dimension, 1, 1}, false);
  }

  [[nodiscard]] const VectorField& field() const override { return field_; }
  [[nodiscard]] double next_step() const override { return next_step_; }
  void set_next_step(double step) override { next_step_ = step; }

  [[nodiscard]] Work work() const override {
    Work sum = earlier_;
    for (const auto* integration : {state_.get(), tangents_.get()})
      if (integration != nullptr) add(integration->work(), sum);
    return sum;
  }

  Evolution evolve(std::span<double> state, double from, double to, std::span<const double> samples,
                   const Observer& observer) override {
    check_state(state);
    std::copy(state.begin(), state.end(), state_->column(0));
    Evolution e = state_->evolve(from, to, samples, observer, next_step_);
    std::copy_n(state_->column(0), state.size(), state.begin());
    return e;
  }

  Evolution evolve_tangents(std::span<double> state, std::span<double> tangents, double from, double to,
                            LastTangent last) override {
    check_state(state);
    const std::size_t n = field_.dimension;
    const bool parameter = last == LastTangent::parameter;
    check_tangents(field_, tangents, last);
    const std::size_t m = tangents.size() / n;
    if (!tangents_ || tangents_->shape().columns != m + 1 || tangents_->parameter() != parameter) {
      if (tangents_) add(tangents_->work(), earlier_);
      tangents_ = make({n, m + 1, options_.tangent_error_control ? m + 1 : 1}, parameter);
    }
    std::copy(state.begin(), state.end(), tangents_->column(0));
    for (std::size_t j = 0; j < m; ++j) std::copy_n(tangents.begin() + offset(j * n), n, tangents_->column(j + 1));
    Evolution e = tangents_->evolve(from, to, {}, {}, next_step_);
    std::copy_n(tangents_->column(0), n, state.begin());
    for (std::size_t j = 0; j < m; ++j) std::copy_n(tangents_->column(j + 1), n, tangents.begin() + offset(j * n));
    return e;
  }

 private:
  static std::ptrdiff_t offset(std::size_t i) { return static_cast<std::ptrdiff_t>(i); }

  static void add(const Work& part, Work& sum) {
    sum.right_hand_sides += part.right_hand_sides;
    sum.tangent_right_hand_sides += part.tangent_right_hand_sides;
    sum.jacobians += part.jacobians;
    sum.steps += part.steps;
  }

  void check_state(std::span<const double> state) const {
    if (state.size() != field_.dimension)
      throw InputError("a state of " + std::to_string(state.size()) + " numbers for a field of dimension " +
                       std::to_string(field_.dimension));
  }

  std::unique_ptr<Integration<Stepper>> make(const VectorShape& shape, bool parameter) {
    return std::make_unique<Integration<Stepper>>(field_, options_, method_, fixed_step_, shape, parameter);
  }

  VectorField field_;
  IntegratorOptions options_;
  Method method_;
  double fixed_step_;
  std::unique_ptr<Integration<Stepper>> state_, tangents_;
  Work earlier_{};
  double next_step_ = 0.0;
};

}  // namespace epicyclic::integrate
