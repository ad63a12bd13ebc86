// Bounds of options of studies for every caller; the input's own bounds are closer (input/study_tables.cpp).

#include <string>
#include <string_view>
#include <vector>

#include "core/errors.hpp"
#include "core/require.hpp"
#include "studies/crosscheck_options.hpp"
#include "studies/plane_options.hpp"
#include "studies/recording_options.hpp"
#include "studies/run_options.hpp"
#include "studies/sweep_options.hpp"
#include "studies/tolerance_options.hpp"

namespace epicyclic::studies {

namespace {

/// Each of a list.
void require_each(std::string_view name, const std::vector<double>& values, bool (*holds)(double),
                  std::string_view bound) {
  for (const double value : values) require(holds(value), name, value, bound);
}

bool positive(double x) { return x > 0.0; }
bool not_negative(double x) { return x >= 0.0; }

void require_some(std::string_view name, std::size_t count) {
  if (count == 0) throw InputError(std::string(name) + " is empty, must have one at least");
}

}  // namespace

void RecordingOptions::validate() const {
  require(transient_periods >= 0, "transient_periods", transient_periods, ">= 0");
  require(recorded_periods >= 1, "recorded_periods", recorded_periods, ">= 1");
  require(output_phases >= 1, "output_phases", output_phases, ">= 1");
  require(period_max >= 1, "period_max", period_max, ">= 1");
  require(recurrence_tolerance > 0.0, "recurrence_tolerance", recurrence_tolerance, "> 0");
  require(growth_periods >= 0, "growth_periods", growth_periods, ">= 0");
  require(classification_periods >= 0, "classification_periods", classification_periods, ">= 0");
  require(classification_periods >= 1 || transient == Transient::fixed, "classification_periods",
          classification_periods, ">= 1 for an adaptive transient");
}

void SweepCheck::validate() const {
  require(points >= 0, "points", points, ">= 0");
  require_some("methods", methods.size());
  require(orbit_tolerance > 0.0, "orbit_tolerance", orbit_tolerance, "> 0");
}

void SweepOptions::validate() const {
  axis.validate();
  require_some("directions", directions.size());
  require(segments >= 0, "segments", segments, ">= 0");
  require(segments <= axis.points, "segments", segments, "<= points");
  require(coarse_periods >= 1, "coarse_periods", coarse_periods, ">= 1");
  recording.validate();
  check.validate();
}

int segments_of(const SweepOptions& options) {
  constexpr int few = 64;
  constexpr int points_per_chain = 8;
  if (options.start == Start::cold) return 1;
  if (options.segments > 0) return options.segments;
  return options.axis.points < few ? 1 : options.axis.points / points_per_chain;
}

void Plane::validate() const {
  first.validate();
  second.validate();
  if (first.name == second.name) throw InputError("both axes are \"" + first.name + "\", must be two");
}

void MapOptions::validate() const {
  plane.validate();
  require_some("directions", directions.size());
  recording.validate();
}

void BasinsOptions::validate() const {
  plane.validate();
  recording.validate();
}

void RunOptions::validate() const {
  require(exponent_periods >= 0, "exponent_periods", exponent_periods, ">= 0");
  require(dense_phases >= 1, "dense_phases", dense_phases, ">= 1");
  require(history_periods >= 1, "history_periods", history_periods, ">= 1");
  require(spectrum_periods >= 1, "spectrum_periods", spectrum_periods, ">= 1");
  require(shown_periods >= 1, "shown_periods", shown_periods, ">= 1");
  require(check_tolerance > 0.0, "check_tolerance", check_tolerance, "> 0");
}

void CrosscheckOptions::validate() const {
  require_some("methods", methods.size());
  require_each("clearance_smoothings", clearance_smoothings, not_negative, ">= 0");
  require(orbit_tolerance > 0.0, "orbit_tolerance", orbit_tolerance, "> 0");
  require(continued_periods >= 1, "continued_periods", continued_periods, ">= 1");
}

void ToleranceOptions::validate() const {
  require_some("methods", methods.size());
  require_some("tolerances", tolerances.size());
  require_each("tolerances", tolerances, positive, "> 0");
  require_each("clearance_smoothings", clearance_smoothings, positive, "> 0");
  require(reference_tolerance > 0.0, "reference_tolerance", reference_tolerance, "> 0");
  require(target_error > 0.0, "target_error", target_error, "> 0");
  require(chaotic_periods >= 1, "chaotic_periods", chaotic_periods, ">= 1");
}

SweepOptions sweep_of_one(double mesh_frequency_ratio, const RecordingOptions& recording) {
  SweepOptions one;
  one.axis = {speed_parameter, mesh_frequency_ratio, mesh_frequency_ratio, 1};
  one.recording = recording;
  return one;
}

}  // namespace epicyclic::studies
