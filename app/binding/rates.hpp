// A stage's equations of motion in the time tau, as Python and Octave have them.
#pragma once

#include <cmath>
#include <cstddef>
#include <memory>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "core/errors.hpp"
#include "input/study_model.hpp"
#include "model/dynamic_model.hpp"
#include "studies/named_parameters.hpp"

namespace epicyclic::binding {

/// dy/dtau = Omega dy/ds at s = Omega tau.
class Rates {
 public:
  /// At the operating point of the input.
  /// @throws InputError for a stage without a study
  explicit Rates(const std::shared_ptr<const input::LoadedInput>& input) : model_(model_of(input)) {}

  [[nodiscard]] const model::DynamicModel& model() const { return model_; }
  [[nodiscard]] double period() const { return model_.period / model_.omega; }

  /// @throws InputError for a time that is not finite
  void evaluate(double tau, const double* y, double* dydtau) const {
    if (!std::isfinite(tau)) throw InputError("tau is not a finite number");
    const double reduced = std::fmod(model_.omega * tau, model_.period);
    const double s = reduced < 0.0 ? reduced + model_.period : reduced;
    model_.right_hand_side(model::segment_at(model_.breakpoints, s), s, y, dydtau);
    for (std::size_t i = 0; i < model_.dimension; ++i) dydtau[i] *= model_.omega;
  }

 private:
  static model::DynamicModel model_of(const std::shared_ptr<const input::LoadedInput>& input) {
    if (!input->study.has_dynamics()) throw InputError("a stage without a study has no equations of motion");
    return input::model_at(input, studies::speed_parameter)(input->study.mesh_frequency_ratio);
  }

  model::DynamicModel model_;
};

}  // namespace epicyclic::binding
