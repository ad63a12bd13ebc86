// Boost.odeint as a peer.
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include <boost/numeric/odeint.hpp>

#include "bench/orbit.hpp"
#include "integrate/flow.hpp"
#include "model/dynamic_model.hpp"

namespace epicyclic::bench {

/// Boost.odeint's controlled dopri5, stepped onto breakpoints and ends as the others are.
class Odeint {
 public:
  Odeint(const model::DynamicModel& model, double tolerance, State start)
      : model_(model), field_(model), tolerance_(tolerance), y_(std::move(start)) {}

  void mesh_period() {
    namespace odeint = boost::numeric::odeint;
    const auto o = options(tolerance_);
    std::vector<double> stops = integrate::breakpoints_between(field_, 0.0, period);
    stops.push_back(period);
    double s = 0.0;
    for (const double stop : stops) {
      const std::size_t segment = integrate::segment_after(field_, s);
      const auto rhs = [&](const State& x, State& f, double t) {
        model_.right_hand_side(segment, t, x.data(), f.data());
        calls_ += 1.0;
      };
      auto stepper =
          odeint::make_controlled(o.absolute_tolerance, o.relative_tolerance, odeint::runge_kutta_dopri5<State>());
      while (s < stop) {
        double h = std::min(step_, stop - s);
        const bool cut = h < step_;
        if (stepper.try_step(rhs, y_, s, h) == odeint::success) {
          if (cut && stop - s < 1e-12) s = stop;
          step_ = cut ? std::max(step_, h) : h;
        } else {
          step_ = h;
        }
      }
    }
  }
  [[nodiscard]] double calls() const { return calls_; }
  [[nodiscard]] State state() const { return y_; }

 private:
  const model::DynamicModel& model_;
  VectorField field_;
  double tolerance_;
  State y_;
  double step_ = 1e-2;
  double calls_ = 0.0;
};

}  // namespace epicyclic::bench
