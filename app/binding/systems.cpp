// One's own oscillator: dy/dt = f(t, y; p), periodic in t. What is known of it is computed by the layer analysis, in
// the phase s = 2 pi t / T: so the period stays the same while a parameter changes it.
//
// A Jacobian that is not given is that of differences of f, (8 (f(y + e v) - f(y - e v)) - f(y + 2 e v) + f(y - 2 e v))
// / (12 e), with e a 5000th of the state's largest component, or of 1. Its error is some 1e-12 of f where f is smooth.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <pybind11/complex.h>
#include <pybind11/stl.h>

#include "analysis/bifurcation_diagram.hpp"
#include "analysis/lyapunov.hpp"
#include "analysis/periodic_orbit.hpp"
#include "analysis/poincare.hpp"
#include "analysis/regime.hpp"
#include "analysis/regime_flows.hpp"
#include "arrays.hpp"
#include "binding.hpp"
#include "core/errors.hpp"
#include "integrate/make_flow.hpp"

namespace epicyclic::binding {

namespace py = pybind11;

namespace {

using integrate::Flow;
using integrate::IntegratorOptions;

/// void f(double t, const double* y, const double* p, double* dydt), and a Jacobian of that signature, row by row.
using Function = void (*)(double, const double*, const double*, double*);

constexpr double circle = 2.0 * std::numbers::pi;

/// A derivative by differences of fourth order: the sum of weight f(x + place h), over 12 h. With h = 2e-4 of the scale
/// of x the truncation error is some h^4 = 2e-15 of it, and the rounding error some 1e-16 / h = 5e-13.
constexpr std::pair<double, double> difference_places[] = {{1.0, 8.0}, {-1.0, -8.0}, {2.0, -1.0}, {-2.0, 1.0}};
constexpr double difference_step = 2e-4;

/// Calls of Python take 8 to 11 us each, those of a pointer next to nothing.
class Callback {
 public:
  /// @param address   of a Function, or 0
  /// @param callable  f(t, y, p), or none
  Callback(std::uintptr_t address, py::object callable, std::size_t n, std::size_t parameters, std::size_t results)
      : pointer_(reinterpret_cast<Function>(address)),
        callable_(std::move(callable)),
        n_(n),
        parameters_(parameters),
        results_(results) {}

  [[nodiscard]] explicit operator bool() const { return pointer_ != nullptr || !callable_.is_none(); }

  void operator()(double t, const double* y, const double* p, double* out) const {
    if (pointer_ != nullptr) {
      pointer_(t, y, p, out);
      return;
    }
    const py::gil_scoped_acquire gil;
    const py::object result = callable_(t, array(y, n_), array(p, parameters_));
    const Array values = Array::ensure(result);
    if (!values) {
      PyErr_Clear();
      throw InputError("the function gave no array of numbers");
    }
    if (values.size() != static_cast<py::ssize_t>(results_))
      throw InputError("the function gave " + std::to_string(values.size()) + " numbers, not " +
                       std::to_string(results_));
    std::copy_n(values.data(), results_, out);
  }

 private:
  static Array array(const double* values, std::size_t size) { return Array(static_cast<py::ssize_t>(size), values); }

  Function pointer_;
  py::object callable_;
  std::size_t n_, parameters_, results_;
};

/// Stops a computation by an exception when Python has one, such as KeyboardInterrupt. Ten times a second.
class Interrupts {
 public:
  bool operator()() {
    const auto now = std::chrono::steady_clock::now();
    if (now < due_) return true;
    due_ = now + std::chrono::milliseconds(100);
    const py::gil_scoped_acquire gil;
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    return true;
  }

 private:
  std::chrono::steady_clock::time_point due_{};
};

IntegratorOptions exactly(double tolerance) {
  IntegratorOptions o;
  o.relative_tolerance = o.absolute_tolerance = tolerance;
  o.max_steps_per_period = 1000000;
  o.tangent_error_control = true;
  return o;
}

/// Sums of two counts are below the largest int.
constexpr int most_periods = 1000000000;

struct Count {
  const char* name;
  int value;
  int least;
};

void require_counts(std::initializer_list<Count> counts) {
  for (const Count& count : counts)
    if (count.value < count.least || count.value > most_periods)
      throw InputError(std::string(count.name) + " is " + std::to_string(count.value) + ", must be from " +
                       std::to_string(count.least) + " to " + std::to_string(most_periods));
}

py::list complex_list(const std::vector<std::complex<double>>& values) {
  py::list list;
  for (const auto& value : values) list.append(value);
  return list;
}

void nothing(std::size_t /*index*/, double /*s*/, std::span<const double> /*y*/) {}

void require_reached(const integrate::Evolution& evolution, double to_time) {
  if (!evolution.reached())
    throw DomainError("the integration ended at t = " + std::to_string(evolution.s * to_time) + ": " +
                      evolution.message);
}

class System {
 public:
  System(std::size_t n, std::size_t parameters, std::uintptr_t address, const py::object& callable,
         std::uintptr_t jacobian_address, const py::object& jacobian_callable, py::object period)
      : n_(n),
        parameters_(parameters),
        f_(address, callable, n, parameters, n),
        jacobian_(jacobian_address, jacobian_callable, n, parameters, n * n),
        period_(std::move(period)) {
    if (n == 0) throw InputError("n is 0, must be >= 1");
  }

  [[nodiscard]] py::tuple section(const py::object& start, const py::object& p, int transient, int periods,
                                  double tolerance, int longest) const {
    require_counts({{"transient", transient, 0}, {"periods", periods, 1}, {"longest", longest, 1}});
    std::vector<double> state = finite_vector(start, "start", n_);
    const std::vector<double> values = finite_vector(p, "params", parameters_);
    const double period = period_of(values);
    analysis::Strobe strobe;
    analysis::Recurrence recurrence;
    {
      const py::gil_scoped_release release;
      Interrupts go_on;
      const auto flow = integrate::make_flow(field(values, period), exactly(tolerance));
      strobe = analysis::strobe(*flow, state, {transient, periods, 1}, nothing, std::ref(go_on));
      if (strobe.evolution.reached() && periods >= 2)
        recurrence = analysis::recurrence(strobe.section, std::min(longest, periods / 2), 1e-6);
    }
    require_reached(strobe.evolution, period / circle);
    return py::make_tuple(matrix_of(strobe.section.states, n_), recurrence.period, recurrence.error);
  }

  [[nodiscard]] py::dict regime(const py::object& start, const py::object& p, int transient, int budget, int longest,
                                double tolerance) const {
    require_counts({{"transient", transient, 0}, {"budget", budget, 1}, {"longest", longest, 1}});
    std::vector<double> state = finite_vector(start, "start", n_);
    const std::vector<double> values = finite_vector(p, "params", parameters_);
    const double period = period_of(values);
    const double per_time = circle / period;
    analysis::Classification found;
    {
      const py::gil_scoped_release release;
      Interrupts go_on;
      const VectorField system = field(values, period);
      IntegratorOptions integrator = exactly(tolerance);
      integrator.tangent_error_control = false;
      const analysis::RegimeFlows flows = analysis::make_regime_flows(system, integrator);
      analysis::RegimeOptions options = flows.options();
      options.budget = std::max(options.window, budget);
      options.lasting = std::max(1, options.budget / 2);
      options.longest_period = longest;
      options.residual = std::max(options.residual, 3.0 * tolerance);
      const analysis::Strobe strobe =
          analysis::strobe(*flows.tight, state, {transient, 0, 1}, nothing, std::ref(go_on));
      if (strobe.evolution.reached())
        found = analysis::classify(*flows.windows, state, options, std::ref(go_on));
      else
        found.evolution = strobe.evolution;
    }
    require_reached(found.evolution, period / circle);
    const analysis::Evidence& e = found.evidence;
    py::dict result;
    result["regime"] = to_string(found.regime);
    result["period"] = found.period;
    result["state"] = array_of(found.orbit ? found.orbit->state : state);
    result["largest_multiplier"] = found.orbit ? e.largest_multiplier : std::nan("");
    result["multiplier_error"] = found.orbit ? e.multiplier_error : std::nan("");
    result["exponent"] = e.exponent.value * per_time;
    result["exponent_low"] = e.exponent.low() * per_time;
    result["exponent_high"] = e.exponent.high() * per_time;
    result["zero_one"] = e.zero_one ? *e.zero_one : std::nan("");
    result["periods"] = e.periods;
    result["note"] = e.note;
    return result;
  }

  /// Exponents per unit of time, their half widths, and those of their sum.
  [[nodiscard]] py::tuple exponents(const py::object& start, const py::object& p, int transient, int aligning,
                                    int periods, double tolerance) const {
    require_counts({{"transient", transient, 0}, {"aligning", aligning, 0}, {"periods", periods, 1}});
    std::vector<double> state = finite_vector(start, "start", n_);
    const std::vector<double> values = finite_vector(p, "params", parameters_);
    const double period = period_of(values);
    const double per_time = circle / period;
    analysis::LyapunovSpectrum spectrum;
    {
      const py::gil_scoped_release release;
      Interrupts go_on;
      const auto flow = integrate::make_flow(field(values, period), exactly(tolerance));
      const analysis::Strobe strobe = analysis::strobe(*flow, state, {transient, 0, 1}, nothing, std::ref(go_on));
      spectrum.evolution = strobe.evolution;
      if (strobe.evolution.reached()) {
        analysis::SpectrumOptions options;
        options.aligning_intervals = aligning;
        options.intervals = periods;
        spectrum = analysis::lyapunov_spectrum(*flow, state, options, std::ref(go_on));
      }
    }
    require_reached(spectrum.evolution, period / circle);
    std::vector<double> value, half_width;
    for (const analysis::Estimate& e : spectrum.per_s) {
      value.push_back(e.value * per_time);
      half_width.push_back(e.half_width * per_time);
    }
    return py::make_tuple(array_of(value), array_of(half_width), spectrum.sum.value * per_time,
                          spectrum.sum.half_width * per_time);
  }

  [[nodiscard]] py::dict orbit(const py::object& start, const py::object& p, int transient, int n,
                               double tolerance) const {
    require_counts({{"transient", transient, 0}, {"period", n, 1}});
    std::vector<double> state = finite_vector(start, "start", n_);
    const std::vector<double> values = finite_vector(p, "params", parameters_);
    const double period = period_of(values);
    analysis::PeriodicOrbit found;
    std::optional<analysis::FloquetMultipliers> multipliers;
    integrate::Evolution evolution;
    {
      const py::gil_scoped_release release;
      Interrupts go_on;
      const VectorField system = field(values, period);
      const auto fine = integrate::make_flow(system, exactly(tolerance));
      evolution = analysis::strobe(*fine, state, {transient, 0, 1}, nothing, std::ref(go_on)).evolution;
      if (evolution.reached()) {
        found = analysis::find_periodic_orbit(*fine, state, n);
        const auto coarse = integrate::make_flow(system, exactly(10.0 * tolerance));
        if (found.found()) {
          const analysis::PeriodicOrbit second =
              analysis::find_periodic_orbit(*coarse, found.state, n, {.shooting_intervals = 2});
          if (second.found()) multipliers = analysis::floquet_multipliers(found, second);
        }
      }
    }
    require_reached(evolution, period / circle);
    if (!found.found()) throw DomainError("no orbit of period " + std::to_string(n) + " was found: " + found.message);
    if (!multipliers) throw DomainError("the orbit was not found again at ten times the tolerance");
    py::dict result;
    result["state"] = array_of(found.state);
    result["error"] = found.error;
    result["multipliers"] = complex_list(multipliers->values);
    result["multiplier_errors"] = array_of(multipliers->errors);
    result["stable"] = multipliers->stable();
    return result;
  }

  [[nodiscard]] py::list branches(const py::object& start, const py::object& p, std::size_t which, double from,
                                  double to, int transient, int n, int largest_period, double max_step,
                                  std::size_t most, double tolerance) const {
    std::vector<double> state = finite_vector(start, "start", n_);
    const std::vector<double> values = finite_vector(p, "params", parameters_);
    require_counts({{"transient", transient, 0}, {"period", n, 1}, {"largest_period", largest_period, 1}});
    if (which >= parameters_) throw InputError("no such parameter");
    if (!(max_step > 0.0) || !(from < to)) throw InputError("no step, or no range, of the parameter");
    std::vector<analysis::Branch> all;
    std::vector<std::vector<double>> points;
    std::string why_not;
    {
      const py::gil_scoped_release release;
      Interrupts go_on;
      const double range = to - from;
      const auto flows = [&](double to_tolerance) {
        return integrate::make_flow_family(
            [this, values, which, range](double value) { return member(values, which, value, range); },
            exactly(to_tolerance));
      };
      const integrate::FlowFamily family_flows = flows(tolerance);
      analysis::OrbitFamily family;
      family.flows = family_flows;
      family.period = n;
      family.residual = 10.0 * tolerance;
      const double value = values[which];
      const auto flow = family_flows(value);
      const auto evolution = analysis::strobe(*flow, state, {transient, 0, 1}, nothing, std::ref(go_on)).evolution;
      if (!evolution.reached()) why_not = evolution.message;
      for (const double y : state) family.state_scale = std::max(family.state_scale, std::abs(y));
      constexpr double part_of_range = 0.3;
      family.value_scale = part_of_range * range;
      if (why_not.empty()) {
        const analysis::Correction first = analysis::first_orbit(family, value, state);
        if (!first.found) why_not = first.message;
        analysis::TreeOptions options;
        options.continuation.from = from;
        options.continuation.to = to;
        options.continuation.max_step = max_step;
        options.continuation.first_step = std::min(options.continuation.first_step, max_step);
        options.largest_period = largest_period;
        options.branches = most;
        const double finer = std::max(0.1 * tolerance, 3e-14);
        options.special.others = {{flows(finer), 1}, {flows(finer), 2}};
        analysis::BifurcationDiagram tree(family, options);
        if (first.found) tree.start(first.orbit);
        while (tree.advance()) (void)go_on();
        all = tree.branches();
        for (const analysis::Branch& branch : all) points.push_back(points_of(branch, go_on));
      }
    }
    if (!why_not.empty()) throw DomainError("no orbit to start from: " + why_not);
    py::list result;
    for (std::size_t k = 0; k < all.size(); ++k) result.append(described(all[k], points[k]));
    return result;
  }

 private:
  [[nodiscard]] double period_of(const std::vector<double>& values) const {
    const py::gil_scoped_acquire gil;
    const bool is_function = PyCallable_Check(period_.ptr()) != 0;
    const py::object given = is_function ? period_(array_of(values)) : period_;
    const double period = PyFloat_AsDouble(given.ptr());
    if (PyErr_Occurred() != nullptr) {
      PyErr_Clear();
      throw InputError("the period is no number");
    }
    if (!(period > 0.0) || !std::isfinite(period))
      throw InputError("the period is " + std::to_string(period) + ", must be a finite number > 0");
    return period;
  }

  /// ds/dt dy/ds = f.
  void slope(const std::vector<double>& values, double period, double s, const double* y, double* dyds) const {
    f_(s * period / circle, y, values.data(), dyds);
    for (std::size_t i = 0; i < n_; ++i) dyds[i] *= period / circle;
  }

  void push(const std::vector<double>& values, double period, double s, const double* y, const Columns<const double>& v,
            double* dyds, const Columns<double>& dvds) const {
    slope(values, period, s, y, dyds);
    if (jacobian_) {
      std::vector<double> matrix(n_ * n_);
      jacobian_(s * period / circle, y, values.data(), matrix.data());
      for (std::size_t j = 0; j < v.count; ++j)
        for (std::size_t i = 0; i < n_; ++i) {
          double sum = 0.0;
          for (std::size_t k = 0; k < n_; ++k) sum += matrix[i * n_ + k] * v.column(j)[k];
          dvds.column(j)[i] = sum * period / circle;
        }
      return;
    }
    double largest = 1.0;
    for (std::size_t i = 0; i < n_; ++i) largest = std::max(largest, std::abs(y[i]));
    std::vector<double> beside(n_), rate(n_);
    for (std::size_t j = 0; j < v.count; ++j) {
      const double* along = v.column(j);
      double* out = dvds.column(j);
      double length = 0.0;
      for (std::size_t i = 0; i < n_; ++i) length = std::max(length, std::abs(along[i]));
      std::fill_n(out, n_, 0.0);
      if (length == 0.0) continue;
      const double step = difference_step * largest / length;
      for (const auto& [at, weight] : difference_places) {
        for (std::size_t i = 0; i < n_; ++i) beside[i] = y[i] + at * step * along[i];
        slope(values, period, s, beside.data(), rate.data());
        for (std::size_t i = 0; i < n_; ++i) out[i] += weight * rate[i];
      }
      for (std::size_t i = 0; i < n_; ++i) out[i] /= 12.0 * step;
    }
  }

  [[nodiscard]] VectorField field(const std::vector<double>& values, double period) const {
    VectorField field;
    field.dimension = n_;
    field.period = circle;
    field.right_hand_side = [this, values, period](std::size_t, double s, const double* y, double* dyds) {
      slope(values, period, s, y, dyds);
    };
    field.tangents = [this, values, period](std::size_t, double s, const double* y, const Columns<const double>& v,
                                            double* dyds,
                                            const Columns<double>& dvds) { push(values, period, s, y, v, dyds, dvds); };
    return field;
  }

  /// The field at a value of one of the parameters, with the derivative by it.
  [[nodiscard]] VectorField member(std::vector<double> values, std::size_t which, double value, double range) const {
    values[which] = value;
    VectorField member = field(values, period_of(values));
    const double step = difference_step * range;
    std::vector<std::pair<double, std::pair<std::vector<double>, double>>> beside;  // weight, values, period
    for (const auto& [at, weight] : difference_places) {
      std::vector<double> other = values;
      other[which] = value + at * step;
      const double period = period_of(other);
      beside.emplace_back(weight, std::pair(std::move(other), period));
    }
    member.parameter_derivative = [this, beside, step](std::size_t, double s, const double* y, double* dgdp) {
      std::vector<double> rate(n_);
      std::fill_n(dgdp, n_, 0.0);
      for (const auto& [weight, there] : beside) {
        slope(there.first, there.second, s, y, rate.data());
        for (std::size_t i = 0; i < n_; ++i) dgdp[i] += weight * rate[i];
      }
      for (std::size_t i = 0; i < n_; ++i) dgdp[i] /= 12.0 * step;
    };
    return member;
  }

  /// The states of each orbit at the beginning of each period, orbit by orbit.
  [[nodiscard]] static std::vector<double> points_of(const analysis::Branch& branch, Interrupts& go_on) {
    std::vector<double> points;
    for (const analysis::BranchOrbit& orbit : branch.orbits) {
      std::vector<double> state(orbit.at.states.col(0).begin(), orbit.at.states.col(0).end());
      const auto flow = branch.family.period > 1 ? branch.family.flows(orbit.at.value) : nullptr;
      for (int k = 0; k < branch.family.period; ++k) {
        if (k > 0 && !flow->evolve(state, 0.0, circle).reached()) std::ranges::fill(state, std::nan(""));
        points.insert(points.end(), state.begin(), state.end());
      }
      (void)go_on();
    }
    return points;
  }

  [[nodiscard]] py::dict described(const analysis::Branch& branch, const std::vector<double>& points) const {
    std::vector<double> value;
    py::list multipliers, special;
    const auto add_state = [&](std::vector<double>& out, const analysis::BranchOrbit& orbit) {
      for (std::size_t i = 0; i < n_; ++i) out.push_back(orbit.at.states(static_cast<Eigen::Index>(i), 0));
    };
    for (const analysis::BranchOrbit& orbit : branch.orbits) {
      value.push_back(orbit.at.value);
      multipliers.append(complex_list(analysis::multipliers_of(branch.family, orbit.monodromy)));
    }
    for (const analysis::SpecialPoint& point : branch.special) {
      std::vector<double> state;
      add_state(state, point.orbit);
      py::dict one;
      one["kind"] = to_string(point.kind);
      one["value"] = point.value;
      one["error_bound"] = point.error_bound;
      one["multiplier"] = point.multiplier;
      one["state"] = array_of(state);
      one["note"] = point.note;
      special.append(std::move(one));
    }
    py::dict result;
    result["period"] = branch.family.period;
    result["value"] = array_of(value);
    result["states"] = Array({static_cast<py::ssize_t>(value.size()), static_cast<py::ssize_t>(branch.family.period),
                              static_cast<py::ssize_t>(n_)},
                             points.data());
    result["multipliers"] = std::move(multipliers);
    result["special"] = std::move(special);
    result["ends"] = py::make_tuple(branch.first.message, branch.last.message);
    return result;
  }

  std::size_t n_, parameters_;
  Callback f_, jacobian_;
  py::object period_;
};

}  // namespace

void add_systems(py::module_& module) {
  py::class_<System>(module, "System")
      .def(py::init<std::size_t, std::size_t, std::uintptr_t, const py::object&, std::uintptr_t, const py::object&,
                    py::object>(),
           py::arg("n"), py::arg("parameters"), py::arg("address"), py::arg("callable"), py::arg("jacobian_address"),
           py::arg("jacobian"), py::arg("period"))
      .def("section", &System::section, py::arg("start"), py::arg("params"), py::arg("transient"), py::arg("periods"),
           py::arg("tolerance"), py::arg("longest"))
      .def("regime", &System::regime, py::arg("start"), py::arg("params"), py::arg("transient"), py::arg("budget"),
           py::arg("longest"), py::arg("tolerance"))
      .def("exponents", &System::exponents, py::arg("start"), py::arg("params"), py::arg("transient"),
           py::arg("aligning"), py::arg("periods"), py::arg("tolerance"))
      .def("orbit", &System::orbit, py::arg("start"), py::arg("params"), py::arg("transient"), py::arg("period"),
           py::arg("tolerance"))
      .def("branches", &System::branches, py::arg("start"), py::arg("params"), py::arg("which"), py::arg("low"),
           py::arg("high"), py::arg("transient"), py::arg("period"), py::arg("largest_period"), py::arg("max_step"),
           py::arg("most"), py::arg("tolerance"));
}

}  // namespace epicyclic::binding
