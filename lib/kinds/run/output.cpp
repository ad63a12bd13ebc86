#include "kinds/run/output.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdint>
#include <limits>
#include <numbers>
#include <numeric>
#include <span>

#include <fmt/format.h>

#include "analysis/zero_one_test.hpp"
#include "core/csv.hpp"
#include "core/text.hpp"
#include "model/scales.hpp"
#include "reports/markdown.hpp"
#include "reports/section_output.hpp"
#include "reports/speed_words.hpp"
#include "store/hdf5_file.hpp"

namespace epicyclic::kinds {

using namespace reports;

namespace {

using analysis::Regime;
using studies::History;
using studies::MeshSummary;
using studies::RunResult;
using studies::SignalSpectrum;

constexpr double mesh_period = 2.0 * std::numbers::pi;  // [units of s]
constexpr double rounding = 1e-9;                       // of the largest line of a spectrum

bool ok(const RunResult& r) { return r.point.outcome == integrate::Outcome::reached; }

double record_periods(const History& h) {
  return h.phases > 0 ? static_cast<double>(h.rows()) / static_cast<double>(h.phases) : 0.0;
}

bool is_mesh_harmonic(double frequency, double resolution) {
  return std::abs(frequency - std::round(frequency)) < 0.5 * resolution;
}

/// "1/2", or by the order of a shaft "1 + 1/27 (sun)".
std::string line_words(const SignalSpectrum& s, const analysis::Harmonic& line) {
  const std::string words = studies::shaft_order_words(
      static_cast<double>(line.order) / static_cast<double>(line.period), s.shafts, rounding);
  return words.empty() ? line.label() : words;
}

std::vector<std::string> state_names(const RunOutput& output, std::size_t dimension) {
  const auto end = output.points.poincare_columns.begin() +
                   static_cast<std::ptrdiff_t>(std::min(dimension, output.points.poincare_columns.size()));
  return {output.points.poincare_columns.begin(), end};
}

// ---------------------------------------------------------------------------------------------------------------------
// Tables

/// A history with its dimensionless columns once more behind the others: in s, um and m/s.
struct HistoryTable {
  explicit HistoryTable(const RunResult& r) : history(r.history), columns(history.columns), units(history.units) {
    const auto add = [&](std::size_t column, const std::string& name, const char* unit, double factor) {
      columns.push_back(name);
      units.emplace_back(unit);
      scaled.push_back({column, factor});
    };
    const double um = 1e6 * model::length_scale_m;
    for (std::size_t j = 0; j < history.columns.size(); ++j) {
      const std::string& name = history.columns[j];
      if (name == "tau") add(j, "time_s", "s", 1.0 / r.omega_sn);
      if (history.units[j] == "b_c") add(j, name + "_um", "um", um);
      if (history.units[j] == "b_c per tau") add(j, name + "_m_per_s", "m/s", model::length_scale_m * r.omega_sn);
    }
  }

  /// @param values  columns.size() numbers
  void fill(std::size_t row, std::span<double> values) const {
    const std::size_t width = history.columns.size();
    const auto from = std::span(history.values).subspan(row * width, width);
    auto to = std::ranges::copy(from, values.begin()).out;
    for (const auto& [column, factor] : scaled) *to++ = factor * from[column];
  }

  const History& history;
  std::vector<std::string> columns, units;
  std::vector<std::pair<std::size_t, double>> scaled{};  ///< column, factor
};

void write_history_csv(const std::filesystem::path& file, const RunResult& r, int periods) {
  const HistoryTable table(r);
  CsvWriter csv(file, table.columns);
  std::vector<double> values(table.columns.size());
  for (std::size_t row = first_row(r.history, periods); row < r.history.rows(); ++row) {
    table.fill(row, values);
    for (const double x : values) csv.cell(x);
    csv.end_row();
  }
  csv.commit();
}

void write_spectrum_csv(const std::filesystem::path& file, const std::vector<SignalSpectrum>& spectra) {
  CsvWriter csv(file, {"signal", "unit", "exact", "frequency", "line", "amplitude", "phase"});
  for (const SignalSpectrum& s : spectra) {
    const int exact = s.exact ? 1 : 0;
    if (s.exact && !s.lines.empty()) {
      for (const analysis::Harmonic& line : s.lines) {
        const double frequency = static_cast<double>(line.order) / static_cast<double>(line.period);
        if (frequency > tabulated_frequency) break;
        csv.row(s.signal, s.unit, exact, frequency, line_words(s, line), line.amplitude, line.phase);
      }
      continue;
    }
    for (std::size_t k = 0; k < s.spectrum.amplitude.size(); ++k) {
      if (s.spectrum.frequency(k) > tabulated_frequency) break;
      csv.row(s.signal, s.unit, exact, s.spectrum.frequency(k),
              studies::shaft_order_words(s.spectrum.frequency(k), s.shafts, rounding), s.spectrum.amplitude[k],
              s.spectrum.phase[k]);
    }
  }
  csv.commit();
}

void write_exponents_csv(const std::filesystem::path& file, const RunResult& result) {
  const analysis::LyapunovSpectrum& e = result.exponents;
  std::vector<std::string> columns{"periods"};
  std::vector<std::vector<double>> means;
  for (std::size_t i = 0; i < e.exponents; ++i) {
    columns.push_back(fmt::format("lambda_{}", i + 1));
    means.push_back(e.history(i));
  }
  CsvWriter csv(file, columns);
  for (std::size_t k = 0; k < means.front().size(); ++k) {
    csv.cell(static_cast<double>(k + 1) * e.interval / mesh_period);
    for (const std::vector<double>& mean : means) csv.cell(mean[k] * result.omega);
    csv.end_row();
  }
  csv.commit();
}

void write_multipliers_csv(const std::filesystem::path& file, const RunResult& result) {
  const analysis::FloquetMultipliers& m = *result.multipliers;
  const double time = mesh_period * std::max(1, result.point.period) / result.omega;
  CsvWriter csv(file, {"index", "re", "im", "modulus", "argument", "error", "multiplicity", "critical", "exponent"});
  for (std::size_t k = 0; k < m.values.size(); ++k) {
    const double modulus = std::abs(m.values[k]);
    csv.row(k, m.values[k].real(), m.values[k].imag(), modulus, std::arg(m.values[k]), m.errors[k], m.multiplicity[k],
            static_cast<int>(k == m.critical), std::log(modulus) / time);
  }
  csv.commit();
}

void write_crossing_csv(const std::filesystem::path& file, const RunOutput& output, const RunResult& result) {
  std::vector<std::string> columns{"index", "phase", "delta_sp_1_rate"};
  const std::vector<std::string> names = state_names(output, result.crossing.dimension);
  columns.insert(columns.end(), names.begin(), names.end());
  CsvWriter csv(file, columns);
  for (std::size_t k = 0; k < result.crossing.size(); ++k) {
    csv.cell(k).cell(result.crossing_phase[k]).cell(result.crossing_rate[k]);
    for (const double x : result.crossing.point(k)) csv.cell(x);
    csv.end_row();
  }
  csv.commit();
}

bool has_history(const RunResult& r) { return !r.history.columns.empty(); }

// ---------------------------------------------------------------------------------------------------------------------
// results.h5

/// Columns of numbers and texts of one group.
class Group {
 public:
  Group(store::Hdf5File& h5, std::string path) : h5_(h5), path_(std::move(path)) { h5_.create_group(path_); }

  void numbers(const std::string& name, std::span<const double> values, const std::string& units) {
    h5_.write(at(name), values);
    h5_.set_units(at(name), units);
  }
  void table(const std::string& name, std::span<const double> values, std::size_t rows, std::size_t columns,
             const std::string& units) {
    h5_.write(at(name), values, rows, columns);
    h5_.set_units(at(name), units);
  }
  void number(const std::string& name, double value, const std::string& units) { numbers(name, {&value, 1}, units); }
  void integers(const std::string& name, std::span<const std::int64_t> values, const std::string& units) {
    h5_.write(at(name), values);
    h5_.set_units(at(name), units);
  }
  void integer(const std::string& name, std::int64_t value, const std::string& units) {
    integers(name, {&value, 1}, units);
  }
  void texts(const std::string& name, const std::vector<std::string>& values) {
    h5_.write(at(name), std::span<const std::string>(values));
  }
  void text(const std::string& name, const std::string& value) { texts(name, {value}); }

  /// One entry for each of `items`.
  template <class Items, class Value>
  void column(const std::string& name, const Items& items, Value&& value, const std::string& units) {
    std::vector<double> values;
    for (const auto& item : items) values.push_back(value(item));
    numbers(name, values, units);
  }
  template <class Items, class Value>
  void integer_column(const std::string& name, const Items& items, Value&& value, const std::string& units) {
    std::vector<std::int64_t> values;
    for (const auto& item : items) values.push_back(static_cast<std::int64_t>(value(item)));
    integers(name, values, units);
  }
  template <class Items, class Value>
  void text_column(const std::string& name, const Items& items, Value&& value) {
    std::vector<std::string> values;
    for (const auto& item : items) values.push_back(value(item));
    texts(name, values);
  }

  /// Row by row, for any storage order of Eigen.
  void matrix(const std::string& name, const Eigen::MatrixXd& m, const std::string& units) {
    std::vector<double> values;
    for (Eigen::Index i = 0; i < m.rows(); ++i)
      for (Eigen::Index j = 0; j < m.cols(); ++j) values.push_back(m(i, j));
    table(name, values, static_cast<std::size_t>(m.rows()), static_cast<std::size_t>(m.cols()), units);
  }

 private:
  [[nodiscard]] std::string at(const std::string& name) const { return path_ + "/" + name; }

  store::Hdf5File& h5_;
  std::string path_;
};

void write_point(store::Hdf5File& h5, const RunOutput& output, const RunResult& r) {
  Group g(h5, "/point");
  g.text("status", store::status_word(r.point.outcome));
  g.text("message", r.point.message);
  g.text("regime", store::regime_word(r.point));
  g.number("value", r.point.point.value, "-");
  g.number("omega", r.omega, "-");
  g.integer("period", r.point.period, "mesh periods");
  g.integer("classified", r.point.classified ? 1 : 0, "-");
  g.number("recurrence_error", r.point.recurrence.error, "b_c, b_c per tau");
  g.number("recurrence_error_late", r.point.recurrence.late_error, "b_c, b_c per tau");
  g.number("planet_spread", r.point.meshes.planet_spread, "b_c");
  g.number("static_force", r.static_force, "N");
  g.number("half_gap_sp", output.half_gap_sp, "b_c");
  g.number("half_gap_rp", output.half_gap_rp, "b_c");
  g.integer("rhs_evaluations", r.point.rhs_evaluations, "1");
  g.numbers("end_state", r.point.end_state, "b_c, b_c per tau");
  h5.name_axes("/point/end_state", {"component"});

  const analysis::Evidence& e = r.point.evidence;
  Group evidence(h5, "/evidence");
  evidence.integer("periods", e.periods, "mesh periods");
  evidence.integer("recurrence_period", e.recurrence.period, "mesh periods");
  evidence.number("recurrence_error", e.recurrence.error, "b_c, b_c per tau");
  evidence.number("residual", e.residual, "b_c, b_c per tau");
  evidence.number("orbit_error", e.orbit_error, "b_c, b_c per tau");
  evidence.number("largest_multiplier", e.largest_multiplier, "-");
  evidence.number("multiplier_error", e.multiplier_error, "-");
  evidence.number("exponent", e.exponent.value * r.omega, "per tau");
  evidence.number("exponent_half_width", e.exponent.half_width * r.omega, "per tau");
  evidence.number("late_growth", e.late_growth, "-");
  evidence.number("zero_one", e.zero_one.value_or(std::numeric_limits<double>::quiet_NaN()), "-");
  evidence.text("note", e.note);
}

void write_spectrum(store::Hdf5File& h5, const SignalSpectrum& s) {
  const std::string path = "/spectra/" + s.signal;
  Group g(h5, path);
  h5.set_attribute(path, "exact", static_cast<std::int64_t>(s.exact ? 1 : 0));
  g.number("resolution", s.spectrum.resolution, "mesh frequencies");
  g.numbers("amplitude", s.spectrum.amplitude, s.unit);
  g.numbers("phase", s.spectrum.phase, "rad");
  using analysis::Harmonic;
  using analysis::Peak;
  if (!s.lines.empty()) {
    Group lines(h5, path + "/lines");
    lines.text_column("label", s.lines, [](const Harmonic& l) { return l.label(); });
    lines.integer_column(
        "order", s.lines, [](const Harmonic& l) { return l.order; }, "-");
    lines.integer_column(
        "period", s.lines, [](const Harmonic& l) { return l.period; }, "mesh periods");
    lines.column(
        "amplitude", s.lines, [](const Harmonic& l) { return l.amplitude; }, s.unit);
    lines.column(
        "phase", s.lines, [](const Harmonic& l) { return l.phase; }, "rad");
  }
  if (!s.peaks.empty()) {
    Group peaks(h5, path + "/peaks");
    peaks.column(
        "frequency", s.peaks, [](const Peak& p) { return p.frequency; }, "mesh frequencies");
    peaks.column(
        "amplitude", s.peaks, [](const Peak& p) { return p.amplitude; }, s.unit);
    peaks.integer_column(
        "harmonic", s.peaks, [](const Peak& p) { return p.harmonic; }, "-");
    peaks.column(
        "offset", s.peaks, [](const Peak& p) { return p.offset; }, "mesh frequencies");
  }
}

void write_meshes(store::Hdf5File& h5, const std::vector<MeshSummary>& meshes) {
  Group g(h5, "/meshes");
  g.text_column("name", meshes, [](const MeshSummary& m) { return m.name; });
  g.column(
      "force_mean", meshes, [](const MeshSummary& m) { return m.force_mean; }, "N");
  g.column(
      "force_min", meshes, [](const MeshSummary& m) { return m.force_min; }, "N");
  g.column(
      "force_max", meshes, [](const MeshSummary& m) { return m.force_max; }, "N");
  g.column(
      "force_ratio_max", meshes, [](const MeshSummary& m) { return m.force_ratio_max; }, "-");
  g.column(
      "quasi_static_max", meshes, [](const MeshSummary& m) { return m.quasi_static.largest; }, "N");
  g.column(
      "quasi_static_mean", meshes, [](const MeshSummary& m) { return m.quasi_static.mean; }, "N");
  g.column(
      "kv", meshes, [](const MeshSummary& m) { return m.kv; }, "-");
  g.column(
      "load_sharing", meshes, [](const MeshSummary& m) { return m.load_sharing; }, "-");
  g.column(
      "drive", meshes, [](const MeshSummary& m) { return m.drive; }, "-");
  g.column(
      "loss", meshes, [](const MeshSummary& m) { return m.loss; }, "-");
  g.column(
      "back", meshes, [](const MeshSummary& m) { return m.back; }, "-");
  g.column(
      "tensile_force_max", meshes, [](const MeshSummary& m) { return m.tensile_force_max; }, "N");
  g.column(
      "tensile_time", meshes, [](const MeshSummary& m) { return m.tension_time; }, "-");
  g.integer_column(
      "contact_losses", meshes, [](const MeshSummary& m) { return m.contact_losses; }, "per record");
}

void write_exponents(store::Hdf5File& h5, const RunResult& r) {
  const analysis::LyapunovSpectrum& e = r.exponents;
  using analysis::Estimate;
  Group g(h5, "/exponents");
  g.column(
      "value", e.per_s, [&](const Estimate& x) { return x.value * r.omega; }, "per tau");
  g.column(
      "half_width", e.per_s, [&](const Estimate& x) { return x.half_width * r.omega; }, "per tau");
  g.number("interval", e.interval / mesh_period, "mesh periods");
  g.table("growth", e.growth, e.growth.size() / e.exponents, e.exponents, "-");
  g.number("sum", e.sum.value * r.omega, "per tau");
  g.number("sum_half_width", e.sum.half_width * r.omega, "per tau");
  g.number("dimension", r.dimension, "-");
  g.number("dimension_low", r.dimension_low, "-");
  g.number("dimension_high", r.dimension_high, "-");
  if (!r.checks) return;
  Group checks(h5, "/exponents/checks");
  checks.integer("intervals", r.checks->intervals, "mesh periods");
  checks.number("sum", r.checks->sum, "per tau");
  checks.number("divergence", r.checks->divergence, "per tau");
  if (r.checks->multipliers) {
    checks.number("multipliers", *r.checks->multipliers, "per tau");
    checks.integer("inside", r.checks->inside, "-");
    checks.integer("compared", r.checks->compared, "-");
  }
  if (r.checks->step_control) checks.number("step_control", *r.checks->step_control, "per tau");
}

std::string outcome_word(analysis::OrbitOutcome outcome) {
  switch (outcome) {
    case analysis::OrbitOutcome::converged:
      return "converged";
    case analysis::OrbitOutcome::stalled:
      return "stalled";
    case analysis::OrbitOutcome::not_converged:
      return "not_converged";
    case analysis::OrbitOutcome::not_reached:
      return "not_reached";
  }
  return "not_reached";
}

void write_orbit(store::Hdf5File& h5, const RunOutput& output, const RunResult& r) {
  const analysis::PeriodicOrbit& o = *r.orbit;
  Group g(h5, "/orbit");
  g.text("outcome", outcome_word(o.outcome));
  g.text("message", o.message);
  g.texts("state_names", state_names(output, o.state.size()));
  g.numbers("state", o.state, "b_c, b_c per tau");
  g.matrix("monodromy", o.monodromy, "b_c, b_c per tau of the row over those of the column");
  for (const char* name : {"/orbit/state_names", "/orbit/state"}) h5.name_axes(name, {"component"});
  h5.name_axes("/orbit/monodromy", {"component", "start_component"});
  g.numbers("residuals", o.residuals, "b_c, b_c per tau");
  h5.name_axes("/orbit/residuals", {"step"});
  g.number("error", o.error, "b_c, b_c per tau");
  if (r.table_displacement) g.number("table_displacement", *r.table_displacement, "b_c, b_c per tau");
  g.number("friction_table_error", r.friction_table_error, "-");
}

void write_multipliers(store::Hdf5File& h5, const analysis::FloquetMultipliers& m) {
  Group g(h5, "/multipliers");
  g.column(
      "re", m.values, [](const std::complex<double>& z) { return z.real(); }, "-");
  g.column(
      "im", m.values, [](const std::complex<double>& z) { return z.imag(); }, "-");
  g.numbers("error", m.errors, "-");
  g.integer_column(
      "multiplicity", m.multiplicity, [](int k) { return k; }, "-");
  g.integer("critical", static_cast<std::int64_t>(m.critical), "-");
}

// ---------------------------------------------------------------------------------------------------------------------
// summary.md

/// A message as a sentence within ours: without a full stop of its own.
std::string_view unstopped(std::string_view text) { return text.substr(0, text.find_last_not_of(". ") + 1); }

std::string bullet(const std::string& text) { return wrapped("- " + text, "  "); }

/// An exponent per unit of s, as its two readings.
std::string exponent_text(const analysis::Estimate& per_s, double omega) {
  return fmt::format("{} per tau ({} per mesh period)", with_error(per_s.value * omega, per_s.half_width * omega),
                     with_error(per_s.value * mesh_period, per_s.half_width * mesh_period));
}

std::string complex_text(const std::complex<double>& z) {
  return z.imag() == 0.0 ? fmt::format("{:.6g}", z.real())
                         : fmt::format("{:.6g} {} {:.6g}i", z.real(), z.imag() < 0.0 ? '-' : '+', std::abs(z.imag()));
}

std::string multiplier_text(const analysis::FloquetMultipliers& m, std::size_t k) {
  std::string text =
      fmt::format("{}, modulus {}", complex_text(m.values[k]), with_error(std::abs(m.values[k]), m.errors[k]));
  if (m.multiplicity[k] > 1) text += fmt::format(", one of {} that their errors do not separate", m.multiplicity[k]);
  if (!m.side_is_known(k)) text += ", on which side of the unit circle is not known";
  return text;
}

std::string regime_sentence(const RunResult& r) {
  const studies::PointResult& p = r.point;
  switch (p.regime) {
    case Regime::periodic:
      return p.classified
                 ? fmt::format("Periodic: the states repeat after {}.", mesh_periods(p.period))
                 : fmt::format("Periodic by recurrence alone: the record repeats after {} to within the tolerance.",
                               mesh_periods(p.period));
    case Regime::quasiperiodic:
      return "Quasiperiodic: tangent vectors neither grow nor shrink, as beside a torus, and the 0-1 test says "
             "regular.";
    case Regime::chaotic:
      return std::string("Chaotic: the largest exponent is positive by its interval") +
             (!p.evidence.zero_one                            ? "."
              : *p.evidence.zero_one > analysis::chaotic_vote ? ", and the 0-1 test agrees."
              : *p.evidence.zero_one > analysis::regular_vote ? " and all along; the 0-1 test abstains."
                                                              : " and all along, though the 0-1 test says regular.");
    case Regime::undecided:
      break;
  }
  return p.classified ? "Undecided: the evidence proves neither an orbit nor a torus nor chaos."
                      : "Undecided: the record does not repeat, and the study classifies by recurrence alone.";
}

/// Per unit of s: of the orbit's multipliers, which are the finest known, or as the regime's evidence has it.
analysis::Estimate largest_exponent(const RunResult& r) {
  if (r.point.regime != Regime::periodic || !has_multipliers(r)) return r.point.evidence.exponent;
  const double modulus = std::abs(r.multipliers->values.front());
  const double time = mesh_period * std::max(1, r.point.period);
  return {std::log(modulus) / time, std::log1p(r.multipliers->errors.front() / modulus) / time};
}

double recorded_mesh_periods(const RunOutput& output, const RunResult& r) {
  return r.mesh_periods == 1 ? static_cast<double>(output.points.sweep.recording.recorded_periods)
                             : static_cast<double>(r.point.poincare_rows()) * r.mesh_periods;
}

std::string regime_text(const RunOutput& output, const RunResult& r) {
  const studies::PointResult& p = r.point;
  const analysis::Evidence& e = p.evidence;
  std::string text = wrapped(regime_sentence(r) + " Evidence: docs/reference/regimes.md.") + "\n";
  if (output.start_is_chaotic && (p.regime == Regime::periodic || p.regime == Regime::quasiperiodic))
    text += bullet("**The start is chaotic, with the same equations of motion: that chaos was a transient.**");
  if (p.is_unconverged())
    text += bullet(
        "**The record has not reached this orbit, or is too short to show it** (`converged` is 0 in points.csv). Use "
        "\"transient\": \"adaptive\" or more /study/transient_periods.");
  if (p.regime == Regime::periodic && p.classified) {
    std::string line =
        fmt::format("The orbit closes to {:.2g} in its largest component [b_c, b_c per tau] and is known to {:.2g}",
                    e.residual, e.orbit_error);
    if (r.orbit && !r.orbit->residuals.empty())
      line += fmt::format("; sought again at tolerance {:g}, it closes to {:.2g} and is known to {:.2g}",
                          output.options.check_tolerance,
                          *std::min_element(r.orbit->residuals.begin(), r.orbit->residuals.end()), r.orbit->error);
    text += bullet(line + ".");
  }
  if (r.table_displacement) {
    std::string line = fmt::format(
        "With tables of friction and stiffness half as fine the orbit is {:.2g} away [b_c, b_c per tau] "
        "(docs/reference/outputs.md)",
        *r.table_displacement);
    if (r.friction_table_error > 0.0)
      line += fmt::format("; friction over normal force is off by {:.2g} at most", r.friction_table_error);
    text += bullet(line + ".");
  }
  if (has_multipliers(r)) {
    const analysis::FloquetMultipliers& m = *r.multipliers;
    text += bullet(fmt::format("Largest Floquet multiplier: {}. The orbit is {}.", multiplier_text(m, 0),
                               m.stable() ? "stable" : "not proven to be stable"));
    if (m.critical != 0) text += bullet(fmt::format("Nearest to the unit circle: {}.", multiplier_text(m, m.critical)));
  } else if (p.regime == Regime::periodic && p.classified) {
    text += bullet(
        fmt::format("Largest Floquet multiplier: modulus {}.", with_error(e.largest_multiplier, e.multiplier_error)));
  }
  if (p.classified) {
    text += bullet(fmt::format("Largest Lyapunov exponent{}: {}.",
                               p.regime == Regime::periodic ? ", of the multiplier" : "",
                               exponent_text(largest_exponent(r), r.omega)));
    if (p.regime != Regime::periodic) {
      text += bullet(e.zero_one ? fmt::format("0-1 test: K = {:.3f} (0: regular, 1: chaotic).", *e.zero_one)
                                : "0-1 test: not made, too few periods were integrated.");
      text += bullet(
          fmt::format("A tangent vector grew by e^{:.3g} over the last half of the last interval.", e.late_growth));
    }
    text += bullet(e.periods > 0 ? fmt::format("Integrated for the classification: {}.", mesh_periods(e.periods))
                                 : std::string("Integrated for the classification: the record alone."));
    if (!e.note.empty()) text += bullet(fmt::format("Note: {}.", unstopped(e.note)));
  }
  text += bullet(
      p.recurrence.period > 0
          ? fmt::format("The record of {:g} mesh periods repeats after {}, to {:.2g} [b_c, b_c per tau].",
                        recorded_mesh_periods(output, r), mesh_periods(p.recurrence.period), p.recurrence.error)
          : fmt::format("The record of {:g} mesh periods does not repeat: nearest after {}, to {:.2g} "
                        "[b_c, b_c per tau].",
                        recorded_mesh_periods(output, r), mesh_periods(p.recurrence.best_period), p.recurrence.error));
  return text;
}

/// Forces of the bearings of planets and sun, and the lives that are known; nothing of a stage without bearings.
std::string bearings_text(const studies::StageRecord& stage) {
  const bool lives = stage.sun_life || !stage.planet_lives.empty();
  std::vector<std::vector<std::string>> rows{{"bearing", "mean [N]", "max [N]"}};
  if (lives) rows[0].insert(rows[0].end(), {"P [N]", "L10 [10^6 rev]", "L10h [h]"});
  const auto add = [&](const std::string& name, const studies::Course& force, const gear::BearingLife& life) {
    if (!std::isfinite(force.largest)) return;
    rows.push_back({name, fmt::format("{:.5g}", force.mean), fmt::format("{:.5g}", force.largest)});
    const auto number = [](double x) { return std::isnan(x) ? std::string("-") : fmt::format("{:.4g}", x); };
    if (lives)
      rows.back().insert(rows.back().end(),
                         {number(life.equivalent_load_N), number(life.million_revolutions), number(life.hours)});
  };
  for (std::size_t i = 0; i < stage.planet_bearing.size(); ++i)
    add(stage.is_pair() ? std::string("gear 2") : fmt::format("planet {}", i + 1), stage.planet_bearing[i],
        stage.planet_lives.empty() ? gear::BearingLife() : stage.planet_lives[i]);
  add(stage.is_pair() ? "gear 1" : "sun", stage.sun_bearing, stage.sun_life.value_or(gear::BearingLife()));
  if (rows.size() == 1) return {};
  return "\n## Bearings\n\n" + aligned(rows) + "\n" +
         wrapped(std::string("Magnitude of the force, its mean and largest value.") +
                 (lives ? " P is the equivalent load and L10 the basic rating life of ISO 281." : ""));
}

/// Meshes with tensile forces: which ones, how large, how often and why.
std::string tensile_text(const RunOutput& output, const RunResult& r) {
  std::vector<std::vector<std::string>> rows{{"mesh with tensile force", "up to [N]", "over F_0", "of the time"}};
  for (const MeshSummary& m : r.meshes)
    if (m.tensile_force_max > 0.0)
      rows.push_back({m.name, fmt::format("{:.5g}", m.tensile_force_max),
                      fmt::format("{:.3g}", m.tensile_force_max / r.static_force),
                      fmt::format("{:.1f} %", 100.0 * m.tension_time)});
  if (rows.size() == 1) return "\nNo mesh force is tensile.\n";
  const bool always = output.gap_damping == model::GapDamping::always;
  return "\n" + aligned(rows) + "\n" +
         wrapped(fmt::format("The tensile force is that of the damping {}. See docs/reference/model_options.md.",
                             always ? "through the open gap (/model/gap_damping \"always\")"
                                    : "before contact is lost (/model/gap_damping \"contact_slope\")"));
}

/// What a section is with errors of shafts.
std::string section_text(const RunResult& r) {
  std::string text = fmt::format(
      "Eccentricities and pitch errors repeat after {} mesh periods, which is here one period.", r.mesh_periods);
  text +=
      r.mesh_periods <= studies::section_periods_max
          ? fmt::format(" The section has one point in each, and the periods below are multiples of {} mesh periods.",
                        r.mesh_periods)
          : fmt::format(" Regime, multipliers and exponents are not sought beyond {} mesh periods.",
                        studies::section_periods_max);
  return wrapped(text);
}

std::string meshes_text(const RunOutput& output, const RunResult& r) {
  std::string text = "\n## Meshes\n\n";
  std::vector<std::vector<std::string>> rows{
      {"mesh", "mean [N]", "min [N]", "max [N]", "F/F_0", "K_v", "share", "drive", "loss", "back", "losses"}};
  const double periods = std::max(1.0, record_periods(r.history));
  const auto percent = [](double part) { return fmt::format("{:.1f} %", 100.0 * part); };
  for (const MeshSummary& m : r.meshes)
    rows.push_back({m.name, fmt::format("{:.5g}", m.force_mean), fmt::format("{:.5g}", m.force_min),
                    fmt::format("{:.5g}", m.force_max), fmt::format("{:.3f}", m.force_ratio_max),
                    std::isnan(m.kv) ? std::string("-") : fmt::format("{:.3f}", m.kv),
                    fmt::format("{:.4f}", m.load_sharing), percent(m.drive), percent(m.loss), percent(m.back),
                    fmt::format("{:.3g}", m.contact_losses / periods)});
  text += aligned(rows);
  text +=
      "\n" + wrapped(fmt::format("Over {:g} mesh periods. Columns: docs/reference/outputs.md, \"Summary of a run\".",
                                 record_periods(r.history)));
  text += tensile_text(output, r);
  if (r.point.meshes.is_pair()) return text;
  text += "\n" + wrapped(fmt::format("Planets' spread: {:.3g} b_c, the largest difference between their deflections.",
                                     r.point.meshes.planet_spread));
  return text;
}

std::string spectra_text(const RunResult& r) {
  constexpr std::size_t most = 5;
  std::string text =
      "\n## Spectra\n\n" + wrapped("The largest lines, as times of the mesh frequency: amplitude.") + "\n";
  std::vector<std::vector<std::string>> rows{{"signal", "unit"}};
  std::size_t longest = 1;
  for (const SignalSpectrum& s : r.spectra) longest = std::max(longest, strongest_lines(s, most).size());
  for (std::size_t k = 0; k < longest; ++k) rows[0].push_back(fmt::format("line {}", k + 1));
  for (const SignalSpectrum& s : r.spectra) {
    std::vector<std::string> row{s.signal, s.unit};
    for (const SpectralLine& line : strongest_lines(s, most))
      row.push_back(fmt::format("{}: {:.4g}", line.label, line.amplitude));
    row.resize(longest + 2);
    rows.push_back(row);
  }
  text += aligned(rows);
  const bool exact = std::all_of(r.spectra.begin(), r.spectra.end(), [](const SignalSpectrum& s) { return s.exact; });
  text += "\n" + wrapped(exact ? "Exact: over whole periods of the orbit, without a window."
                               : "Through a flat-top window: amplitudes to 0.1 %, neighbours within a few bins merge.");
  return text;
}

std::string exponents_text(const RunResult& r) {
  const analysis::LyapunovSpectrum& e = r.exponents;
  constexpr std::size_t most = 4;
  std::string text = "\n## Lyapunov exponents\n\n";
  std::vector<std::vector<std::string>> rows{{"exponent", "per tau", "per mesh period"}};
  for (std::size_t i = 0; i < std::min(most, e.per_s.size()); ++i) {
    const analysis::Estimate& x = e.per_s[i];
    rows.push_back({fmt::format("lambda_{}", i + 1), with_error(x.value * r.omega, x.half_width * r.omega),
                    with_error(x.value * mesh_period, x.half_width * mesh_period)});
  }
  text += aligned(rows) + "\n" + wrapped("Definitions and checks: docs/theory/regimes.md.") + "\n";
  const std::string dimension = short_text(r.dimension, 4);
  const std::string low = short_text(r.dimension_low, 4);
  const std::string high = short_text(r.dimension_high, 4);
  // Beside an exponent of zero, a torus', rounding would decide.
  text += bullet(fmt::format("Counted over {:g} mesh periods, {} exponents. Dimension of Kaplan and Yorke: {}{}.",
                             static_cast<double>(e.growth.size() / e.exponents) * e.interval / mesh_period, e.exponents,
                             dimension,
                             low == high ? "" : fmt::format("; by the exponents' intervals {} to {}", low, high)));
  if (!r.checks) return text;
  text += bullet(fmt::format(
      "Sum of all: {:.10g} per tau; mean divergence of the field: {:.10g}; difference {:.2g} (over {}).", r.checks->sum,
      r.checks->divergence, std::abs(r.checks->sum - r.checks->divergence), mesh_periods(r.checks->intervals)));
  constexpr double agreed = 1e-3;  // of the divergence
  if (!(std::abs(r.checks->sum - r.checks->divergence) <= agreed * std::abs(r.checks->divergence) + agreed))
    text += bullet("**Sum and divergence disagree: the exponents above are not those of the attractor.**");
  if (r.checks->multipliers)
    text += bullet(
        fmt::format("Against the multipliers: {} of {} within their intervals, largest difference {:.2g} per tau.",
                    r.checks->inside, r.checks->compared, *r.checks->multipliers));
  if (r.checks->step_control)
    text += bullet(fmt::format("Without error control of the tangents: largest difference {:.2g} per tau.",
                               *r.checks->step_control));
  return text;
}

std::string transverse_text(const RunResult& r) {
  const analysis::Estimate& t = *r.transverse;
  const std::string meaning =
      t.high() < 0.0  ? "small differences between planets die out: synchronous planets stay synchronous"
      : t.low() > 0.0 ? "small differences between planets grow: synchronous planets do not stay synchronous"
                      : "its interval holds zero: whether synchronous planets stay so is not decided";
  return "\n## Synchronous planets\n\n" +
         wrapped(fmt::format("Transverse exponent: {} per tau: {}.", with_error(t.value, t.half_width), meaning));
}

std::string files_text(const RunOutput& output, const RunResult& r) {
  std::string text = "\n## Files\n\n";
  const auto file = [&](const char* name, const std::string& what) {
    text += bullet(fmt::format("`{}`: {}", name, what));
  };
  file("points.csv", "the point in one row");
  file("poincare.csv", "states at whole mesh periods");
  if (has_history(r))
    file(
        "history.csv",
        fmt::format("states, deflections, forces over the last {}",
                    mesh_periods(std::min(output.options.shown_periods, static_cast<int>(record_periods(r.history))))));
  if (!r.spectra.empty()) file("spectrum.csv", fmt::format("up to {:g} mesh frequencies", tabulated_frequency));
  if (has_exponents(r)) file("exponents.csv", "running means of the exponents, per tau");
  if (has_multipliers(r)) file("multipliers.csv", "Floquet multipliers with errors");
  if (has_crossing(r)) file("crossing.csv", "states where contact of mesh sp_1 is made");
  file("results.h5", "everything, the whole record included");
  if (ok(r)) file("figures/", "PNG and SVG, each with its data (.dat) and script (.gp)");
  return text;
}

}  // namespace

bool has_exponents(const RunResult& r) { return !r.exponents.per_s.empty() && !r.exponents.growth.empty(); }
bool has_multipliers(const RunResult& r) { return r.multipliers && !r.multipliers->values.empty(); }
bool has_crossing(const RunResult& r) { return r.crossing.size() > 0; }

std::string mesh_periods(int n) { return n == 1 ? "1 mesh period" : fmt::format("{} mesh periods", n); }

std::size_t first_row(const History& history, int periods) {
  const std::size_t wanted =
      static_cast<std::size_t>(std::max(0, periods)) * static_cast<std::size_t>(std::max(0, history.phases));
  return history.rows() - std::min(wanted, history.rows());
}

std::vector<SpectralLine> strongest_lines(const SignalSpectrum& signal, std::size_t most) {
  std::vector<SpectralLine> lines;
  for (const analysis::Harmonic& h : signal.lines)
    if (h.order > 0)
      lines.push_back({line_words(signal, h), static_cast<double>(h.order) / static_cast<double>(h.period), h.amplitude,
                       h.of_forcing()});
  for (const analysis::Peak& p : signal.peaks) {
    if (p.frequency < signal.spectrum.frequency(mean_bins)) continue;
    const bool of_mesh = is_mesh_harmonic(p.frequency, signal.spectrum.resolution);
    const std::string of_shaft =
        studies::shaft_order_words(p.frequency, signal.shafts, 0.5 * signal.spectrum.resolution);
    lines.push_back({of_mesh            ? std::to_string(p.harmonic)
                     : of_shaft.empty() ? short_text(p.frequency, 4)
                                        : of_shaft,
                     p.frequency, p.amplitude, of_mesh});
  }
  std::stable_sort(lines.begin(), lines.end(),
                   [](const SpectralLine& a, const SpectralLine& b) { return a.amplitude > b.amplitude; });
  std::size_t count = 0;
  while (count < std::min(most, lines.size()) && lines[count].amplitude > rounding * lines.front().amplitude) ++count;
  lines.resize(count);
  return lines;
}

void write_run_tables(const std::filesystem::path& folder, const RunOutput& output, const RunResult& result) {
  if (has_history(result)) write_history_csv(folder / "history.csv", result, output.options.shown_periods);
  if (!result.spectra.empty()) write_spectrum_csv(folder / "spectrum.csv", result.spectra);
  if (has_exponents(result)) write_exponents_csv(folder / "exponents.csv", result);
  if (has_multipliers(result)) write_multipliers_csv(folder / "multipliers.csv", result);
  if (has_crossing(result)) write_crossing_csv(folder / "crossing.csv", output, result);
}

void write_run_h5(const std::filesystem::path& file, const RunOutput& output, const RunResult& result) {
  store::Hdf5File h5(file);
  h5.set_attribute("/", "input_resolved", output.points.resolved_input);
  h5.set_attribute("/", "title", output.points.title);
  write_point(h5, output, result);
  write_point_columns(h5, studies::points_in_memory({&result.point, 1}));

  if (has_history(result)) {
    const History& h = result.history;
    Group g(h5, "/history");
    h5.set_attribute("/history", "phases", static_cast<std::int64_t>(h.phases));
    const HistoryTable table(result);
    write_section_h5(
        h5, "/history", table.columns, h.rows(),
        [&](std::size_t row, std::span<double> values) { table.fill(row, values); }, table.units);
  }
  if (!result.meshes.empty()) write_meshes(h5, result.meshes);
  for (const SignalSpectrum& s : result.spectra) write_spectrum(h5, s);
  {
    Group g(h5, "/poincare");
    const std::size_t columns = result.point.poincare_columns;
    std::vector<std::int64_t> index(result.point.poincare_rows());
    std::iota(index.begin(), index.end(), 0);
    g.integers("index", index, "1");
    write_section_h5(
        h5, "/poincare", output.points.poincare_columns, index.size(), [&](std::size_t row, std::span<double> values) {
          std::ranges::copy(std::span(result.point.poincare).subspan(row * columns, columns), values.begin());
        });
  }
  if (has_crossing(result)) {
    Group g(h5, "/crossing");
    g.numbers("phase", result.crossing_phase, "rad");
    g.numbers("delta_sp_1_rate", result.crossing_rate, "b_c per tau");
    write_section_h5(h5, "/crossing", state_names(output, result.crossing.dimension), result.crossing.size(),
                     [&](std::size_t row, std::span<double> values) {
                       std::ranges::copy(result.crossing.point(row), values.begin());
                     });
  }
  if (has_exponents(result)) write_exponents(h5, result);
  if (result.transverse) {
    Group g(h5, "/transverse");
    g.number("exponent", result.transverse->value, "per tau");
    g.number("half_width", result.transverse->half_width, "per tau");
  }
  if (result.orbit) write_orbit(h5, output, result);
  if (has_multipliers(result)) write_multipliers(h5, *result.multipliers);
  h5.close();
}

std::string run_summary(const RunOutput& output, const RunResult& r) {
  std::string text = fmt::format("# {}\n\n", output.points.title);
  text += wrapped(fmt::format(
      "Operating point: mesh frequency ratio Ω = {}: {}; {} b_c (b_c = {:g} µm); static mesh force "
      "F_0 = {:.1f} N.",
      short_text(r.omega, 8), speed_words(r.point.meshes.speeds, r.point.meshes.mesh_frequency),
      r.point.meshes.is_pair() ? fmt::format("half gap b = {}", short_text(output.half_gap_sp, 6))
                               : fmt::format("half gaps b_sp = {}, b_rp = {}", short_text(output.half_gap_sp, 6),
                                             short_text(output.half_gap_rp, 6)),
      1e6 * model::length_scale_m, r.static_force));
  if (!output.start.empty()) text += "\n" + wrapped(fmt::format("Start: {}.", fmt::join(output.start, "; ")));
  const std::string work = fmt::format("\nWork: {} right-hand sides.\n", r.point.rhs_evaluations);
  if (!ok(r)) {
    text +=
        "\n" + wrapped(fmt::format("**The point was not reached: status {}**: {}.", store::status_word(r.point.outcome),
                                   r.point.message.empty() ? "no reason was given" : unstopped(r.point.message)));
    return text + work + files_text(output, r);
  }
  text += "\n## Regime\n\n" + (r.mesh_periods > 1 ? section_text(r) + "\n" : std::string()) + regime_text(output, r);
  if (!r.meshes.empty()) text += meshes_text(output, r) + bearings_text(r.point.meshes);
  if (!r.spectra.empty()) text += spectra_text(r);
  if (has_exponents(r)) text += exponents_text(r);
  if (!r.exponents.evolution.reached())
    text += "\n## Lyapunov exponents\n\n" +
            wrapped(fmt::format("Not known: the integration with tangent vectors ended early, {}: {}.",
                                store::status_word(r.exponents.evolution.outcome),
                                unstopped(r.exponents.evolution.message)));
  if (r.transverse) text += transverse_text(r);
  return text + work + files_text(output, r);
}

}  // namespace epicyclic::kinds
