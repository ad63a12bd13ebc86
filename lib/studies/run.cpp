#include "studies/run.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <future>
#include <memory>
#include <numbers>
#include <numeric>
#include <system_error>
#include <utility>

#include "analysis/regime_flows.hpp"
#include "core/largest_difference.hpp"
#include "integrate/make_flow.hpp"
#include "integrate/methods.hpp"
#include "studies/stage_lanes.hpp"
#include "studies/tension.hpp"

namespace epicyclic::studies {

namespace {

using integrate::Flow;

/// Planets whose deflections differ by less move as one [b_c].
constexpr double synchronous = 1e-6;

/// Names and units of the history's columns, and its rows.
class Recorder {
 public:
  Recorder(const model::DynamicModel& model, const model::Scales& scales, History& history)
      : model_(model), scales_(scales), history_(history) {
    add("periods", "1");
    add("tau", "1");
    const std::size_t n = model.state_names.size() / 2;
    for (std::size_t k = 0; k < 2 * n; ++k) add(model.state_names[k], k < n ? "b_c" : "b_c per tau");
    const auto add_meshes = [&](const std::string& what, const std::string& behind, const char* unit) {
      add_planets(what + "_sp_", behind, unit);
      if (model.has_ring()) add_planets(what + "_rp_", behind, unit);
    };
    add_meshes("delta", "", "b_c");
    add_meshes("delta", "_rate", "b_c per tau");
    add_meshes("force", "", "N");
    if (model.has_ring()) add_meshes("load_sharing", "", "1");
    add_planets("bearing_planet_", "", "N");
    add("bearing_sun", "N");
  }

  /// Deflections and forces at an instant, valid until the next one.
  void recording(double s, std::span<const double> y) {
    model_.deflections(s, y.data(), d_);
    model_.forces(s, y.data(), f_);
  }
  [[nodiscard]] const model::MeshDeflections& deflections() const { return d_; }
  [[nodiscard]] const model::StageForces& forces() const { return f_; }

  /// A row of the history, of the instant that recording() has seen.
  void keep(std::size_t period, double s, std::span<const double> y) {
    constexpr double whole = 2.0 * std::numbers::pi;
    const double phase = static_cast<double>(period) * model_.period + s;
    put(phase / whole);
    put(phase / model_.omega);
    put(y);
    if (model_.has_ring()) {
      for (const auto* list : {&d_.sun_planet, &d_.ring_planet, &d_.sun_planet_rate, &d_.ring_planet_rate}) put(*list);
      for (const auto* list : {&f_.sun_planet, &f_.ring_planet}) put_newtons(*list);
      for (const auto* list : {&f_.sun_planet, &f_.ring_planet}) {
        const double sum = std::accumulate(list->begin(), list->end(), 0.0);
        for (const double f : *list) put(static_cast<double>(list->size()) * f / sum);
      }
    } else {
      put(d_.sun_planet);
      put(d_.sun_planet_rate);
      put_newtons(f_.sun_planet);
    }
    put_newtons(f_.planet_bearing);
    put(scales_.force_newton(f_.sun_bearing));
  }

 private:
  void add(std::string name, const char* unit) {
    history_.columns.push_back(std::move(name));
    history_.units.emplace_back(unit);
  }
  void add_planets(const std::string& before, const std::string& behind, const char* unit) {
    for (int i = 1; i <= model_.planets; ++i) add(before + std::to_string(i) + behind, unit);
  }
  void put(double x) { history_.values.push_back(x); }
  void put(std::span<const double> list) { history_.values.insert(history_.values.end(), list.begin(), list.end()); }
  void put_newtons(const std::vector<double>& list) {
    for (const double f : list) put(scales_.force_newton(f));
  }

  const model::DynamicModel& model_;
  const model::Scales& scales_;
  History& history_;
  model::MeshDeflections d_;
  model::StageForces f_;
};

/// Samples of a portrait for each of the history: some for each oscillation of the fastest meshes, whose frequency is
/// about twice omega_sn. Fewer if many periods are drawn with a thin line.
int portrait_detail(const model::DynamicModel& model, const RunOptions& options, int periods) {
  constexpr double oscillation = 200;
  constexpr int most = 50000;  // samples
  const double wanted = oscillation * std::max(1.0, fastest_mode / model.omega) / options.dense_phases;
  const int affordable = most / (std::max(1, periods) * options.dense_phases);
  return std::max(1, std::min(static_cast<int>(std::ceil(std::min(wanted, double{most}))), affordable));
}

/// Options whose counts are of mesh periods, in periods of the field.
integrate::IntegratorOptions in_periods_of(const model::DynamicModel& model, integrate::IntegratorOptions options) {
  options.max_steps_per_period *= model.mesh_periods;
  options.max_step_periods /= model.mesh_periods;
  return options;
}

/// Intervals of Lyapunov exponents, however long each is.
constexpr int least_intervals = 50;

/// One operating point, step by step into its result.
class Run {
 public:
  Run(const model::DynamicModel& model, const RecordingOptions& recording, const RunOptions& options,
      const integrate::IntegratorOptions& integrator, const RunControl& control)
      : model_(model),
        scales_(model.scales),
        recording_(recording),
        options_(options),
        integrator_(in_periods_of(model, integrator)),
        control_(control),
        go_on_(control.go_on ? control.go_on : [] { return true; }) {}

  /// @returns false if ended
  bool all(RunResult& r) {
    r.mesh_periods = model_.mesh_periods;
    r.omega = model_.omega;
    r.omega_sn = scales_.omega_sn;
    r.static_force = scales_.force_newton(model_.static_mesh_force);
    at("transient, regime");
    if (control_.memory.point) {
      r.point = *control_.memory.point;
    } else {
      r.point = compute_point({0, Direction::up, model_.omega}, model_, {}, recording_of_point(), integrator_, go_on_);
      if (!go_on_()) return false;
      if (control_.memory.keep) control_.memory.keep(r.point);
    }
    if (r.point.outcome != integrate::Outcome::reached) return true;
    state_ = r.point.end_state;
    at("orbit");
    if (!model_.jumps_at_surfaces) find_orbit(r);
    // Exponents read the present results, the record writes other parts of them.
    std::future<void> exponents;
    if (options_.exponent_periods > 0 && !model_.jumps_at_surfaces && takes_sections() && go_on_())
      exponents = begun([&] { find_exponents(r); });
    at("histories, spectra");
    record(r);
    find_section(r);
    summarise(r);
    if (go_on_()) find_spectra(r);
    if (go_on_()) cross(r);
    if (exponents.valid()) exponents.get();
    if (options_.exponent_periods > 0 && !model_.jumps_at_surfaces && go_on_() && model_.remove_synchronous &&
        r.point.meshes.planet_spread <= synchronous)
      find_transverse(r);
    count_in_mesh_periods(r);
    return go_on_();
  }

 private:
  void at(const char* what, int exponent_interval = 0) const {
    if (control_.at) control_.at(what, exponent_interval);
  }

  /// What was counted in periods of the field.
  void count_in_mesh_periods(RunResult& r) const {
    analysis::Recurrence& of_record = r.point.recurrence;
    analysis::Recurrence& of_evidence = r.point.evidence.recurrence;
    for (int* count : {&r.point.period, &of_record.period, &of_record.best_period, &of_evidence.period,
                       &of_evidence.best_period, &r.point.evidence.periods})
      *count *= model_.mesh_periods;
    if (r.checks) r.checks->intervals *= model_.mesh_periods;
  }

  /// Periods of the field that have so many mesh periods, or more.
  [[nodiscard]] int sections(int mesh_periods) const {
    return (mesh_periods + model_.mesh_periods - 1) / model_.mesh_periods;
  }
  /// Samples in a period of the field.
  [[nodiscard]] int dense_phases() const { return options_.dense_phases * model_.mesh_periods; }

  [[nodiscard]] bool takes_sections() const { return model_.mesh_periods <= section_periods_max; }

  /// The section is taken once in each period of the field: its counts are those of the options, or too many.
  [[nodiscard]] RecordingOptions recording_of_point() const {
    RecordingOptions o = recording_;
    o.output_phases *= model_.mesh_periods;
    if (takes_sections()) return o;
    o = by_recurrence_alone(o);
    o.growth_periods = 0;
    o.transient_periods = sections(o.transient_periods);
    o.recorded_periods = sections(o.recorded_periods);
    return o;
  }

  /// Work by a thread of its own if one is wanted, and the system gives it; else when its end is waited for.
  template <class Work>
  [[nodiscard]] std::future<void> begun(Work work) const {
    try {
      return std::async(control_.threads > 1 ? std::launch::async : std::launch::deferred, work);
    } catch (const std::system_error&) {
      return std::async(std::launch::deferred, work);
    }
  }

  [[nodiscard]] std::unique_ptr<Flow> kept(std::unique_ptr<Flow> flow, RunPart part) const {
    return control_.memory.of ? remembered(std::move(flow), control_.memory.of(part)) : std::move(flow);
  }

  [[nodiscard]] std::unique_ptr<Flow> flow() const { return integrate::make_flow(model_, integrator_); }

  [[nodiscard]] integrate::IntegratorOptions exact_options(double tolerance) const {
    integrate::IntegratorOptions o;
    o.relative_tolerance = o.absolute_tolerance = tolerance;
    o.escape_bound = integrator_.escape_bound;
    o.max_step_periods = integrator_.max_step_periods;
    o.max_steps_per_period = std::max(o.max_steps_per_period, integrator_.max_steps_per_period) * 20;
    return o;
  }

  /// By the default method, whose tangents are controlled: for exact results.
  [[nodiscard]] std::unique_ptr<Flow> exact_flow(double tolerance, bool controlled = true,
                                                 bool with_divergence = false) const {
    return exact_flow(with_divergence ? analysis::with_divergence(model_) : VectorField(model_), tolerance, controlled);
  }
  [[nodiscard]] std::unique_ptr<Flow> exact_flow(const VectorField& field, double tolerance, bool controlled) const {
    integrate::IntegratorOptions o = exact_options(tolerance);
    o.tangent_error_control = controlled;
    return integrate::make_flow(field, o);
  }

  void find_orbit(RunResult& r) {
    if (r.point.regime != analysis::Regime::periodic || !takes_sections()) return;
    const double coarser = 10.0 * options_.check_tolerance;
    const auto fine = exact_flow(options_.check_tolerance);
    analysis::PeriodicOrbit orbit = analysis::find_periodic_orbit(*fine, state_, r.point.period);
    if (!orbit.found()) return;
    const auto coarse = exact_flow(coarser);
    const analysis::PeriodicOrbit second =
        analysis::find_periodic_orbit(*coarse, orbit.state, r.point.period, {.shooting_intervals = 2});
    if (second.found()) r.multipliers = analysis::floquet_multipliers(orbit, second);
    if (model_.with_halved_tables) {
      r.friction_table_error = model_.friction_table_error;
      const auto halved = exact_flow(model_.with_halved_tables(), options_.check_tolerance, false);
      const std::vector<double> moved = analysis::displaced_orbit(*halved, orbit, r.point.period, 2);
      if (!moved.empty()) r.table_displacement = largest_difference(moved, orbit.state);
      if (!moved.empty() && r.multipliers) add_table_errors(orbit, moved, r);
    }
    state_ = orbit.state;
    r.orbit = std::move(orbit);
  }

  /// Error of the multipliers due to interpolation in tables. With rows half as dense it is some 16 times as large, by
  /// fourth order. A quarter is taken, since coarse rows and those beside a pitch point gain less.
  void add_table_errors(const analysis::PeriodicOrbit& orbit, const std::vector<double>& moved, RunResult& r) const {
    constexpr double part = 1.0 / 4.0;
    const auto halved = exact_flow(model_.with_halved_tables(), options_.check_tolerance, true);
    const analysis::PeriodicOrbit other = analysis::find_periodic_orbit(*halved, moved, r.point.period);
    if (!other.found()) return;
    const std::vector<double> apart = analysis::floquet_multipliers(orbit, other).errors;
    for (std::size_t k = 0; k < apart.size(); ++k) r.multipliers->errors[k] += part * apart[k];
  }

  struct Signal {
    const char* name;
    const char* unit;
    std::vector<double> values;  ///< phases in each mesh period
  };

  /// @param phases  of the signal in a mesh period
  /// @param exact  the signal is that of an orbit of period n: its harmonics are exact. Harmonics beyond half of
  /// dense_phases only prevent aliasing, and are left out.
  [[nodiscard]] SignalSpectrum spectrum_of(Signal signal, int phases, bool exact, int n) const {
    SignalSpectrum s;
    s.signal = signal.name;
    s.unit = signal.unit;
    s.exact = exact;
    s.shafts = model_.shafts;
    const double dt = 1.0 / phases;  // in mesh periods, the first of them at dt [uniform_phases()]
    std::vector<double>& values = signal.values;
    if (!exact) {
      // A window spreads the mean over its neighbours.
      const double mean = std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
      for (double& x : values) x -= mean;
    }
    s.spectrum = analysis::amplitude_spectrum(values, dt,
                                              exact ? analysis::Window::rectangular : analysis::Window::flat_top, dt);
    if (exact) {
      s.lines = analysis::harmonics(values, n, dt);
      const auto lines = static_cast<std::size_t>(n * options_.dense_phases / 2 + 1);
      s.lines.resize(lines);
      s.spectrum.amplitude.resize(lines);
      s.spectrum.phase.resize(lines);
    } else {
      constexpr std::size_t most = 20;
      constexpr double floor = 1e-3;
      s.peaks = analysis::peaks(s.spectrum, 1.0, most, floor);
    }
    return s;
  }

  /// Spectral lines of an orbit with contact that is made and lost fall with the cube of their order. With samples as
  /// dense as the history's, aliasing would be visible.
  void find_spectra(RunResult& r) const {
    const bool exact = r.orbit.has_value();
    const int periods = exact ? r.point.period : sections(options_.spectrum_periods);
    const int n = periods * model_.mesh_periods;
    const int phases = options_.dense_phases * (exact ? oversampling(n) : 1);
    const auto own_flow = flow();
    const std::vector<double> samples =
        analysis::uniform_phases(own_flow->field().period, phases * model_.mesh_periods);
    model::MeshDeflections d;
    model::StageForces f;
    std::vector<Signal> signals = {
        {"delta_sp_1", "um", {}}, {"delta_rp_1", "um", {}}, {"force_sp_1", "N", {}}, {"force_rp_1", "N", {}}};
    std::vector<double> y = state_;
    for (int k = 0; k < periods; ++k) {
      if (!go_on_()) return;
      const integrate::Evolution e = own_flow->evolve(
          y, 0.0, own_flow->field().period, samples, [&](std::size_t, double s, std::span<const double> now) {
            model_.deflections(s, now.data(), d);
            model_.forces(s, now.data(), f);
            signals[0].values.push_back(scales_.displacement_um(d.sun_planet[0]));
            signals[1].values.push_back(scales_.displacement_um(d.ring_planet[0]));
            signals[2].values.push_back(scales_.force_newton(f.sun_planet[0]));
            signals[3].values.push_back(scales_.force_newton(f.ring_planet[0]));
          });
      if (!e.reached()) return;
    }
    if (!model_.has_ring())
      std::erase_if(signals,
                    [](const Signal& s) { return std::string_view(s.name).find("_rp_") != std::string_view::npos; });
    for (Signal& signal : signals) r.spectra.push_back(spectrum_of(std::move(signal), phases, exact, n));
  }

  /// How many times as many samples as those of the history an orbit's lines are taken of.
  [[nodiscard]] int oversampling(int periods) const {
    constexpr int wanted = 4096;     // in a mesh period
    constexpr int most = 64 * 4096;  // in all
    const int affordable = std::min(wanted, most / periods);
    return std::max(1, (affordable + options_.dense_phases - 1) / options_.dense_phases);
  }

  void record(RunResult& r) const {
    const auto own_flow = flow();
    const double period = own_flow->field().period;
    const std::vector<double> samples = analysis::uniform_phases(period, dense_phases());
    r.history.phases = options_.dense_phases;
    Recorder recorder(model_, scales_, r.history);
    std::vector<double> y = state_;
    const int shown =
        r.orbit.has_value() ? std::max(r.point.period * model_.mesh_periods, options_.shown_periods) : portrait_periods;
    const auto detail = static_cast<std::size_t>(portrait_detail(model_, options_, shown));
    r.portrait.phases = options_.dense_phases * static_cast<int>(detail);
    const std::vector<double> fine = analysis::uniform_phases(period, r.portrait.phases * model_.mesh_periods);
    const int kept = sections(options_.history_periods);
    for (int k = 0; k < kept; ++k) {
      if (!go_on_()) break;
      const bool drawn = k >= kept - sections(shown);
      const integrate::Evolution e = own_flow->evolve(
          y, 0.0, period, drawn ? fine : samples, [&](std::size_t j, double s, std::span<const double> now) {
            recorder.recording(s, now);
            if (drawn) {
              r.portrait.deflection.push_back(recorder.deflections().sun_planet[0]);
              r.portrait.rate.push_back(recorder.deflections().sun_planet_rate[0]);
              if ((j + 1) % detail != 0) return;
            }
            recorder.keep(static_cast<std::size_t>(k), s, now);
          });
      if (!e.reached()) break;
    }
  }

  void find_section(RunResult& r) const {
    model::MeshDeflections d;
    for (std::size_t row = 0; row < r.point.poincare_rows(); ++row) {
      model_.deflections(0.0, r.point.poincare.data() + row * r.point.poincare_columns, d);
      r.section_deflection.push_back(d.sun_planet[0]);
      r.section_rate.push_back(d.sun_planet_rate[0]);
    }
  }

  /// Of the periods of the history.
  [[nodiscard]] StageRecord statistics(const History& history) const {
    ResponseStatistics all(model_, dense_phases());
    const auto own_flow = flow();
    std::vector<double> y = state_;
    for (std::size_t row = 0; row < history.rows(); row += static_cast<std::size_t>(dense_phases()))
      if (!own_flow
               ->evolve(y, 0.0, own_flow->field().period, all.phases(),
                        [&](std::size_t, double, std::span<const double> now) { all.see(now); })
               .reached())
        break;
    return all.finish();
  }

  void summarise(RunResult& r) const {
    const auto planets = static_cast<std::size_t>(model_.planets);
    if (r.history.rows() == 0) return;
    const StageRecord all = statistics(r.history);
    for (const char* kind : {"sp", "rp"}) {
      const bool of_sun = kind[0] == 's';
      if (!of_sun && !model_.has_ring()) continue;
      const double gap = of_sun ? model_.sun_planet_half_gap : model_.ring_planet_half_gap;
      const std::vector<MeshRecord>& meshes = of_sun ? all.sun_planet : all.ring_planet;
      for (std::size_t i = 0; i < planets; ++i) {
        const MeshRecord& mesh = meshes[i];
        MeshSummary m;
        m.name = std::string(kind) + "_" + std::to_string(i + 1);
        m.force_min = mesh.force.least;
        m.force_max = mesh.force.largest;
        m.force_mean = mesh.force.mean;
        m.force_ratio_max = m.force_max / r.static_force;
        m.quasi_static = mesh.quasi_static;
        m.kv = mesh.kv();
        m.load_sharing = StageRecord::share(meshes, &Course::mean, i);
        m.tensile_force_max = mesh.tension * r.static_force;
        m.tension_time = mesh.tension_time;
        m.drive = mesh.drive;
        m.loss = mesh.loss();
        m.back = mesh.back;
        m.contact_losses = contact_losses(r.history.column("delta_" + m.name), gap);
        r.meshes.push_back(std::move(m));
      }
    }
  }

  /// How often a deflection loses the contact of the drive flank.
  [[nodiscard]] static int contact_losses(const std::vector<double>& delta, double half_gap) {
    int losses = 0;
    for (std::size_t k = 1; k < delta.size(); ++k)
      if (delta[k - 1] > half_gap && !(delta[k] > half_gap)) ++losses;
    return losses;
  }

  void cross(RunResult& r) const {
    const auto own_flow = flow();
    std::vector<double> y = state_;
    model::MeshDeflections d;
    const auto surface = [&](double s, std::span<const double> now) {
      model_.deflections(s, now.data(), d);
      return d.sun_planet[0] - model_.sun_planet_half_gap;
    };
    analysis::SurfaceSection section =
        analysis::surface_section(*own_flow, y, surface, analysis::SectionCrossing::rising,
                                  r.orbit ? r.point.period : sections(recording_.recorded_periods),
                                  recording_.output_phases * model_.mesh_periods, go_on_);
    for (std::size_t k = 0; k < section.section.size(); ++k) {
      model_.deflections(section.phase[k], section.section.point(k).data(), d);
      r.crossing_rate.push_back(d.sun_planet_rate[0]);
    }
    r.crossing = std::move(section.section);
    r.crossing_phase = std::move(section.phase);
  }

  using TangentFlow = std::function<std::unique_ptr<Flow>(bool controlled)>;

  /// For chaos in lanes and at the tolerance of their records, whose error is far below the exponents' intervals. For
  /// other attractors, whose exponents may be known to many digits, as exactly as their multipliers.
  void find_exponents(RunResult& r) {
    if (r.point.regime != analysis::Regime::chaotic) {
      find_exponents(r, [this](bool controlled) { return exact_flow(options_.check_tolerance, controlled); });
      return;
    }
    integrate::IntegratorOptions o = exact_options(analysis::statistical_tolerance);
    o.method = "lanes-cash-karp";
    integrate::LanePool pool = stage_pool(model_, o, integrate::step_loops());
    pool.run(1, [&] {
      find_exponents(r, [&](bool controlled) {
        o.tangent_error_control = controlled;
        return pool.make_flow(model_, o);
      });
    });
  }

  void find_exponents(RunResult& r, const TangentFlow& tangent_flow) {
    const double period = model_.period;
    const auto tangents = kept(tangent_flow(true), RunPart::exponents);
    const auto divergence = kept(exact_flow(options_.check_tolerance, true, true), RunPart::divergence);
    // The divergence is averaged along the same trajectory: over each interval, from the state at its beginning.
    constexpr std::size_t checked = 32;
    double along = 0.0;
    std::size_t intervals = 0;
    analysis::SpectrumOptions o;
    o.intervals = options_.exponent_periods;
    if (model_.mesh_periods > 1) o.intervals = std::max(sections(o.intervals), least_intervals);
    std::vector<double> first;
    o.begins = [&](double s, std::span<const double> y) {
      if (intervals >= checked) return;
      if (intervals == 0) first.assign(y.begin(), y.end());
      std::vector<double> extended(y.begin(), y.end());
      extended.push_back(0.0);
      divergence->forget();
      if (!divergence->evolve(extended, s, s + period).reached()) return;
      along += extended.back();
      ++intervals;
    };
    std::vector<double> y = state_;
    int interval = 0;
    r.exponents = analysis::lyapunov_spectrum(*tangents, y, o, [&] {
      at("Lyapunov exponents", interval++);
      return go_on_();
    });
    const std::size_t m = r.exponents.exponents;
    if (!go_on_() || !r.exponents.evolution.reached() || intervals == 0) return;
    const auto dimension = [&](auto number) {
      std::vector<double> values;
      for (const analysis::Estimate& e : r.exponents.per_s) values.push_back(number(e));
      std::sort(values.rbegin(), values.rend());
      return analysis::kaplan_yorke_dimension(values);
    };
    r.dimension = dimension([](const analysis::Estimate& e) { return e.value; });
    r.dimension_low = dimension([](const analysis::Estimate& e) { return e.low(); });
    r.dimension_high = dimension([](const analysis::Estimate& e) { return e.high(); });

    ExponentChecks checks;
    const double time = static_cast<double>(intervals) * period / model_.omega;
    const auto end = r.exponents.growth.begin() + static_cast<std::ptrdiff_t>(intervals * m);
    checks.intervals = static_cast<int>(intervals);
    checks.sum = std::accumulate(r.exponents.growth.begin(), end, 0.0) / time;
    checks.divergence = along / time;
    compare_with_multipliers(r, checks);

    // Without error control of the tangents, from the same state and the same vectors.
    constexpr int few = 8;
    o.begins = nullptr;
    o.aligning_intervals = 0;
    o.intervals = few;
    std::vector<double> a = first;
    std::vector<double> b = first;
    const auto free_flow = kept(tangent_flow(false), RunPart::step_control);
    tangents->forget();
    const auto with = analysis::lyapunov_spectrum(*tangents, a, o, go_on_);
    const auto without = analysis::lyapunov_spectrum(*free_flow, b, o, go_on_);
    if (!go_on_()) return;
    if (with.evolution.reached() && without.evolution.reached()) {
      double most = 0.0;
      for (std::size_t i = 0; i < m; ++i)
        most = std::max(most, std::abs(with.per_s[i].value - without.per_s[i].value) * model_.omega);
      checks.step_control = most;
    }
    r.checks = checks;
  }

  /// Exponents against log |multiplier| / period, both falling.
  void compare_with_multipliers(const RunResult& r, ExponentChecks& checks) const {
    if (!r.multipliers) return;
    std::vector<analysis::Estimate> exponents = r.exponents.per_s;
    std::sort(exponents.begin(), exponents.end(), [](const auto& a, const auto& b) { return a.value > b.value; });
    const double time = model_.period * r.point.period;
    double most = 0.0;
    for (std::size_t i = 0; i < exponents.size(); ++i) {
      const double modulus = std::abs(r.multipliers->values[i]);
      const double error = r.multipliers->errors[i];
      if (!(modulus > 10.0 * error)) break;  // the smaller ones are rounding
      const double difference = std::abs(exponents[i].value - std::log(modulus) / time);
      most = std::max(most, difference * model_.omega);
      ++checks.compared;
      if (difference <= exponents[i].half_width + error / modulus / time + 100.0 * options_.check_tolerance)
        ++checks.inside;
    }
    checks.multipliers = most;
  }

  void find_transverse(RunResult& r) const {
    at("Lyapunov exponent of planets that part", exponent_intervals(options_));
    // Only with these methods another flow continues with the same bits.
    using integrate::Family;
    const Family family = integrate::method_named(integrator_.method).family;
    const bool resumable = family == Family::erk || family == Family::lanes;
    const auto own_flow = resumable ? kept(flow(), RunPart::transverse) : flow();
    std::vector<double> y = state_;
    analysis::LyapunovOptions o;
    o.periods = options_.exponent_periods;
    o.project = model_.remove_synchronous;
    const analysis::LargestExponent e = analysis::largest_exponent(*own_flow, y, o, {}, go_on_);
    if (e.evolution.reached() && e.growth.size() == static_cast<std::size_t>(o.periods))
      r.transverse = e.per_s * model_.omega;
  }

  const model::DynamicModel& model_;
  const model::Scales& scales_;
  const RecordingOptions& recording_;
  const RunOptions& options_;
  const integrate::IntegratorOptions integrator_;  ///< its counts are of the field's period
  const RunControl& control_;
  const std::function<bool()> go_on_;
  std::vector<double> state_;  ///< the start of all parts after the point: the orbit's state, or the record's last
};

}  // namespace

std::string shaft_order_words(double frequency, const std::vector<model::Shaft>& shafts, double tolerance) {
  const double harmonic = std::round(frequency);
  for (const model::Shaft& shaft : shafts) {
    const double order = (frequency - harmonic) * shaft.teeth;
    if (std::abs(order - std::round(order)) > tolerance * shaft.teeth || std::round(order) == 0.0) continue;
    const std::string part = std::to_string(std::abs(static_cast<long>(std::round(order)))) + "/" +
                             std::to_string(shaft.teeth) + " (" + shaft.member + ")";
    if (harmonic == 0.0) return part;
    return std::to_string(static_cast<long>(harmonic)) + (order < 0.0 ? " - " : " + ") + part;
  }
  return {};
}

std::size_t History::index_of(const std::string& column) const {
  return static_cast<std::size_t>(std::find(columns.begin(), columns.end(), column) - columns.begin());
}

std::vector<double> History::column(const std::string& name) const {
  std::vector<double> values_of;
  const std::size_t k = index_of(name);
  if (k == columns.size()) return values_of;
  for (std::size_t row = 0; row < rows(); ++row) values_of.push_back(values[row * columns.size() + k]);
  return values_of;
}

int exponent_intervals(const RunOptions& options) {
  return options.exponent_periods > 0 ? analysis::SpectrumOptions{}.aligning_intervals + options.exponent_periods : 0;
}

std::optional<RunResult> run_operating_point(const model::DynamicModel& model, const RecordingOptions& recording,
                                             const RunOptions& options, const integrate::IntegratorOptions& integrator,
                                             const RunControl& control) {
  recording.validate();
  options.validate();
  RunResult result;
  if (!Run(model, recording, options, integrator, control).all(result)) return std::nullopt;
  return result;
}

}  // namespace epicyclic::studies
