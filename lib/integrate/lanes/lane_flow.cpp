#include "integrate/lanes/lane_flow.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "integrate/lanes/lane_ensemble.hpp"

namespace epicyclic::integrate {

namespace {

/// State and tangent vectors as one system.
struct Extended {
  Extended(const VectorField& field, const IntegratorOptions& options, std::size_t m, bool with_parameter)
      : vectors(m),
        parameter(with_parameter),
        system(extended(field, m, with_parameter)),
        lanes(one_by_one(step_loops().width, system.dimension, field.surfaces.count), options, step_loops()) {
    lanes.control(field.dimension, options.tangent_error_control ? m : 0, with_parameter);
    lanes.load(0, system);
  }

  static VectorField extended(const VectorField& field, std::size_t m, bool with_parameter) {
    const std::size_t n = field.dimension;
    VectorField all;
    all.dimension = n * (1 + m);
    all.period = field.period;
    all.breakpoints = field.breakpoints;
    all.sampling_interval = field.sampling_interval;
    all.surfaces = field.surfaces;
    all.right_hand_side = [&field, n, m, with_parameter, dgdp = std::vector<double>(n)](
                              std::size_t segment, double s, const double* y, double* f) mutable {
      field.tangents(segment, s, y, {y + n, m, n}, f, {f + n, m, n});
      if (!with_parameter) return;
      field.parameter_derivative(segment, s, y, dgdp.data());
      for (std::size_t i = 0; i < n; ++i) f[n * m + i] += dgdp[i];
    };
    return all;
  }

  std::size_t vectors;
  bool parameter;
  VectorField system;
  LaneEnsemble lanes;
};

class LaneFlow final : public Flow {
 public:
  LaneFlow(VectorField field, const IntegratorOptions& options)
      : field_(std::move(field)),
        options_(options),
        lanes_(one_by_one(step_loops().width, field_.dimension, field_.surfaces.count), options, step_loops()) {
    lanes_.load(lane, field_);
  }

  [[nodiscard]] const VectorField& field() const override { return field_; }

  Evolution evolve(std::span<double> state, double from, double to, std::span<const double> samples,
                   const Observer& observer) override {
    lanes_.begin(lane, state, from, to, samples, observer);
    lanes_.run();
    lanes_.copy_state(lane, state);
    return lanes_.evolution(lane);
  }

  Evolution evolve_tangents(std::span<double> state, std::span<double> tangents, double from, double to,
                            LastTangent last) override {
    const std::size_t n = field_.dimension;
    check_tangents(field_, tangents, last);
    const std::size_t m = tangents.size() / n;
    const bool parameter = last == LastTangent::parameter;
    if (!extended_ || extended_->vectors != m || extended_->parameter != parameter) {
      if (extended_) add(extended_->lanes.work(lane));
      extended_ = std::make_unique<Extended>(field_, options_, m, parameter);
    }
    std::vector<double> all(state.begin(), state.end());
    all.insert(all.end(), tangents.begin(), tangents.end());
    extended_->lanes.set_next_step(lane, next_step());
    extended_->lanes.begin(lane, all, from, to);
    extended_->lanes.run();
    extended_->lanes.copy_state(lane, all);
    set_next_step(extended_->lanes.next_step(lane));
    std::copy_n(all.begin(), n, state.begin());
    std::copy(all.begin() + static_cast<std::ptrdiff_t>(n), all.end(), tangents.begin());
    return extended_->lanes.evolution(lane);
  }

  [[nodiscard]] Work work() const override {
    Work sum = earlier_;
    const Work own = lanes_.work(lane);
    sum.right_hand_sides += own.right_hand_sides;
    sum.steps += own.steps;
    if (extended_) {
      sum.tangent_right_hand_sides += extended_->lanes.work(lane).right_hand_sides;
      sum.steps += extended_->lanes.work(lane).steps;
    }
    return sum;
  }

  [[nodiscard]] double next_step() const override { return lanes_.next_step(lane); }
  void set_next_step(double step) override { lanes_.set_next_step(lane, step); }

 private:
  static constexpr std::size_t lane = 0;

  void add(const Work& tangents) {
    earlier_.tangent_right_hand_sides += tangents.right_hand_sides;
    earlier_.steps += tangents.steps;
  }

  VectorField field_;
  IntegratorOptions options_;
  LaneEnsemble lanes_;
  std::unique_ptr<Extended> extended_;
  Work earlier_{};
};

}  // namespace

std::unique_ptr<Flow> make_lane_flow(VectorField field, const IntegratorOptions& options) {
  return std::make_unique<LaneFlow>(std::move(field), options);
}

}  // namespace epicyclic::integrate
