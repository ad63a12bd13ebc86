#include "studies/ramp.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <numeric>
#include <tuple>
#include <utility>

#include "analysis/poincare.hpp"
#include "analysis/spectrum.hpp"
#include "core/errors.hpp"
#include "gear/kinematics.hpp"
#include "integrate/make_flow.hpp"
#include "model/dynamic_model.hpp"

namespace epicyclic::studies {

namespace {

constexpr double mesh_period = 2.0 * std::numbers::pi;

/// Linear between the rows, constant before and behind them.
double interpolated(const std::vector<double>& x, const std::vector<double>& y, double at) {
  const auto above = static_cast<std::size_t>(std::upper_bound(x.begin(), x.end(), at) - x.begin());
  if (above == 0) return y.front();
  if (above == x.size()) return y.back();
  const double part = (at - x[above - 1]) / (x[above] - x[above - 1]);
  return y[above - 1] + part * (y[above] - y[above - 1]);
}

bool has_lubricated_friction(const gear::Stage& stage) {
  return stage.sun_planet_mesh.friction.ehl.has_value() || stage.ring_planet_mesh.friction.ehl.has_value();
}

/// One trajectory through all ramps.
class Ramps {
 public:
  Ramps(const gear::Stage& stage, const model::Scales& scales, const model::ModelOptions& model,
        const RampOptions& options, const integrate::IntegratorOptions& integrator, const RampControl& control)
      : stage_(stage),
        scales_(scales),
        model_options_(model),
        options_(options),
        integrator_(integrator),
        control_(control),
        ramp_(std::make_shared<model::SpeedRamp>()),
        samples_(analysis::uniform_phases(mesh_period, options.output_phases)) {
    result_.course = ramp_course(options, stage, scales);
    result_.inertia_torque_Nm = inertia_torque_Nm(stage, result_.course.rate * scales.omega_sn * scales.omega_sn);
    if (!options.torque_time_s.empty())
      torque_ = [this, nominal = stage.load.torque_Nm.value()](double tau) {
        return interpolated(options_.torque_time_s, options_.torque_Nm, tau / scales_.omega_sn) / nominal;
      };
  }

  std::optional<RampResult> all(const std::vector<double>& start) {
    bool first = true;
    for (const Direction direction : options_.directions) {
      const bool up = direction == Direction::up;
      ramp_->omega = up ? result_.course.from : result_.course.to;
      ramp_->rate = 0.0;
      make_model(ramp_->omega);
      if (first) state_ = start.empty() ? model_.default_start : start;
      // Time begins with the first ramp.
      if (first) ramp_->tau = -mesh_period * options_.hold_periods / ramp_->omega;
      first = false;
      if (!hold()) return ended();
      ramp_->rate = (up ? 1.0 : -1.0) * result_.course.rate;
      for (int number = 0; number < result_.course.windows; ++number)
        if (!window(direction, number)) return ended();
    }
    return std::move(result_);
  }

 private:
  /// Nothing if it was stopped; a result that a failed integration has cut off is one.
  std::optional<RampResult> ended() {
    if (result_.outcome == integrate::Outcome::reached) return std::nullopt;
    return std::move(result_);
  }
  [[nodiscard]] bool goes_on() const { return !control_.go_on || control_.go_on(); }

  void make_model(double reference) {
    model_ = model::make_ramped_model(stage_, scales_, model_options_, ramp_, reference, torque_);
    flow_ = integrate::make_flow(model_, integrator_);
  }

  /// One mesh period.
  bool period(std::span<const double> samples, const integrate::Observer& observer) {
    const integrate::Evolution e = flow_->evolve(state_, 0.0, mesh_period, samples, observer);
    const double tau = ramp_->tau_at(mesh_period);
    ramp_->omega = ramp_->omega_at(mesh_period);
    ramp_->tau = tau;
    result_.outcome = e.outcome;
    result_.message = e.message;
    return e.reached();
  }

  bool hold() {
    const double end = ramp_->tau + mesh_period * options_.hold_periods / ramp_->omega;
    if (const auto known = recalled(0)) {
      resume(*known);
    } else {
      for (int k = 0; k < options_.hold_periods; ++k)
        if (!goes_on() || !period({}, {})) return false;
      keep({});
    }
    ramp_->tau = end;
    return true;
  }

  /// Of an earlier session: `count` numbers, and what the integration goes on from.
  [[nodiscard]] std::optional<std::vector<double>> recalled(std::size_t count) const {
    return control_.recall ? control_.recall(count + state_.size() + 1) : std::nullopt;
  }
  void resume(const std::vector<double>& known) {
    std::copy(known.end() - 1 - static_cast<std::ptrdiff_t>(state_.size()), known.end() - 1, state_.begin());
    flow_->set_next_step(known.back());
  }

  /// Numbers, then what the integration goes on from.
  void keep(std::vector<double> numbers) const {
    numbers.insert(numbers.end(), state_.begin(), state_.end());
    numbers.push_back(flow_->next_step());
    if (control_.keep) control_.keep(numbers);
  }

  bool window(Direction direction, int number) {
    const int periods = options_.window_periods;
    RampWindow w;
    w.direction = direction;
    w.number = number;
    const double half = 0.5 * mesh_period * periods;
    w.omega = ramp_->omega_at(half);
    w.tau = ramp_->tau_at(half);
    w.torque_Nm = gear::torques(stage_, w.omega * scales_.omega_sn).sun * (torque_ ? torque_(w.tau) : 1.0);
    if (has_lubricated_friction(stage_)) make_model(w.omega);
    const std::size_t count = numbers_of_window(options_);
    const double end = mesh_period * periods;
    const model::SpeedRamp next = {ramp_->omega_at(end), ramp_->rate, ramp_->tau_at(end)};
    if (const auto known = recalled(count)) {
      restore(w, std::span(*known).first(count));
      resume(*known);
    } else if (!integrate(w)) {
      return false;
    }
    *ramp_ = next;
    done(std::move(w));
    return true;
  }

  /// The numbers of the window from its mesh periods.
  bool integrate(RampWindow& w) {
    const int periods = options_.window_periods;
    std::vector<double> signal;
    std::vector<std::size_t> losses(2 * static_cast<std::size_t>(model_.planets));
    model::MeshDeflections d;
    model::StageForces f;
    for (int k = 0; k < periods; ++k) {
      if (!goes_on()) return false;
      const bool reached = period(samples_, [&](std::size_t, double s, std::span<const double> y) {
        model_.deflections(s, y.data(), d);
        model_.forces(s, y.data(), f);
        signal.push_back(d.sun_planet[0]);
        for (std::size_t i = 0; i < d.sun_planet.size(); ++i) {
          if (model::DynamicModel::contact(d.sun_planet[i], model_.sun_planet_half_gap) == model::Contact::loss)
            ++losses[2 * i];
          if (model_.has_ring() &&
              model::DynamicModel::contact(d.ring_planet[i], model_.ring_planet_half_gap) == model::Contact::loss)
            ++losses[2 * i + 1];
        }
        w.force_max = std::max(w.force_max, std::ranges::max(f.sun_planet));
        if (model_.has_ring()) w.ring_force_max = std::max(w.ring_force_max, std::ranges::max(f.ring_planet));
        w.bearing_max = std::max(w.bearing_max, std::ranges::max(f.planet_bearing));
      });
      if (!reached) return false;
    }
    for (double* force : {&w.force_max, &w.ring_force_max, &w.bearing_max}) *force = scales_.force_newton(*force);
    const auto samples = static_cast<double>(signal.size());
    w.loss_time = static_cast<double>(std::ranges::max(losses)) / samples;
    std::tie(w.delta_min, w.delta_max) = std::pair(std::ranges::min(signal), std::ranges::max(signal));
    w.delta_mean = std::accumulate(signal.begin(), signal.end(), 0.0) / samples;
    for (double& x : signal) x -= w.delta_mean;
    w.delta_rms = std::sqrt(std::inner_product(signal.begin(), signal.end(), signal.begin(), 0.0) / samples);
    const analysis::Spectrum spectrum =
        analysis::amplitude_spectrum(signal, 1.0 / options_.output_phases, analysis::Window::hann);
    w.orders.assign(spectrum.amplitude.begin(),
                    spectrum.amplitude.begin() + options_.orders * options_.window_periods + 1);
    w.orders.front() = 0.0;
    keep(numbers(w));
    return true;
  }

  void done(RampWindow w) {
    result_.windows.push_back(std::move(w));
    if (control_.at) control_.at(result_.windows.size());
  }

  static std::vector<double> numbers(const RampWindow& w) {
    std::vector<double> all = {w.delta_mean, w.delta_rms,      w.delta_min,   w.delta_max,
                               w.force_max,  w.ring_force_max, w.bearing_max, w.loss_time};
    all.insert(all.end(), w.orders.begin(), w.orders.end());
    return all;
  }
  static void restore(RampWindow& w, std::span<const double> all) {
    auto next = all.begin();
    for (double* x : {&w.delta_mean, &w.delta_rms, &w.delta_min, &w.delta_max, &w.force_max, &w.ring_force_max,
                      &w.bearing_max, &w.loss_time})
      *x = *next++;
    w.orders.assign(next, all.end());
  }

  const gear::Stage& stage_;
  const model::Scales& scales_;
  const model::ModelOptions& model_options_;
  const RampOptions& options_;
  const integrate::IntegratorOptions& integrator_;
  const RampControl& control_;
  std::function<double(double tau)> torque_;
  std::shared_ptr<model::SpeedRamp> ramp_;
  std::vector<double> samples_;
  model::DynamicModel model_;
  std::unique_ptr<integrate::Flow> flow_;
  std::vector<double> state_;
  RampResult result_;
};

}  // namespace

std::size_t numbers_of_window(const RampOptions& options) {
  constexpr std::size_t single = 8;
  return single + static_cast<std::size_t>(options.orders * options.window_periods) + 1;
}

RampCourse ramp_course(const RampOptions& options, const gear::Stage& stage, const model::Scales& scales) {
  // rpm of the sun at Omega = 1
  const double rpm = gear::rpm * gear::speeds(stage, scales.omega_sn).sun;
  if (rpm == 0.0 && (options.from_sun_speed_rpm || options.to_sun_speed_rpm || options.rate_rpm_per_s))
    throw DomainError("the sun is held, so that a ramp is given by from, to and rate_per_tau");
  const auto ratio = [rpm](const std::optional<double>& own, const std::optional<double>& in_rpm) {
    if (own) return *own;
    if (in_rpm) return *in_rpm / rpm;
    throw DomainError("a ramp needs the speeds of its ends");
  };
  RampCourse c;
  c.from = ratio(options.from, options.from_sun_speed_rpm);
  c.to = ratio(options.to, options.to_sun_speed_rpm);
  if (!(c.from < c.to)) throw DomainError("the speeds of a ramp must rise from `from` to `to`");
  c.rate = options.rate_per_tau ? *options.rate_per_tau : options.rate_rpm_per_s.value() / rpm / scales.omega_sn;
  c.window_periods = options.window_periods;
  const double phase = (c.to - c.from) * (c.to + c.from) / (2.0 * c.rate);
  const double windows = phase / (mesh_period * options.window_periods);
  constexpr double most = 1e6;
  if (windows > most) throw DomainError("a ramp of more than 1e6 windows; the rate is too low");
  constexpr double rounding = 1e-9;  // of a range that was chosen to be whole windows
  c.windows = static_cast<int>(windows * (1.0 + rounding));
  return c;
}

double inertia_torque_Nm(const gear::Stage& stage, double rate) {
  const auto inertia = [](double over_r2_kg, const std::optional<double>& radius_mm) {
    const double r = radius_mm.value() * 1e-3;
    return over_r2_kg * r * r;
  };
  // Speeds at a mesh frequency of 1 rad/s; planets and ring rotate backward against the carrier.
  const double sun = gear::speeds(stage, 1.0).sun;
  const double carrier = gear::carrier_speed(stage, 1.0);
  const auto behind_carrier = [carrier](int teeth) { return carrier - 1.0 / static_cast<double>(teeth); };
  const double planet = behind_carrier(stage.planet.teeth.value());
  const auto count = static_cast<double>(stage.planet_count);
  double energy = inertia(stage.sun.inertia_over_r2_kg, stage.sun.base_radius_mm) * sun * sun;
  energy += count * inertia(stage.planet.inertia_over_r2_kg, stage.planet.base_radius_mm) * planet * planet;
  if (!stage.is_pair()) {
    const double r_c = stage.centre_distance_mm.value() * 1e-3;
    const double ring = behind_carrier(stage.ring.teeth.value());
    energy += (count * stage.planet.mass_kg + stage.carrier.inertia_over_r2_kg) * r_c * r_c * carrier * carrier;
    energy += inertia(stage.ring.inertia_over_r2_kg, stage.ring.base_radius_mm) * ring * ring;
  }
  return energy * rate / (sun == 0.0 ? std::abs(carrier) : sun);
}

std::optional<RampResult> run_ramp(const gear::Stage& stage, const model::Scales& scales,
                                   const model::ModelOptions& model, const RampOptions& options,
                                   const std::vector<double>& start, const integrate::IntegratorOptions& integrator,
                                   const RampControl& control) {
  return Ramps(stage, scales, model, options, integrator, control).all(start);
}

}  // namespace epicyclic::studies
