// From the input to models: what a sweep asks at each value of its parameter, and what a study will cost.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "io/study_input.hpp"
#include "studies/sweep.hpp"

namespace epicyclic::io {

/// The model at each value of the study's sweep parameter, named or a JSON pointer. Scales are those of the stage as
/// given. `input` must outlive the result. A call throws InputError when the study is not valid at that value.
[[nodiscard]] studies::ModelAt model_at(const LoadedInput& input);

/// Points and chains of the study, a sweep's, a map's or those of basins.
[[nodiscard]] studies::SweepPlan plan_of(const Study& study);

/// The model at each of them; of basins with the point's own start for the default one. Otherwise as above.
[[nodiscard]] studies::ModelAtPoint model_at_point(const LoadedInput& input);

/// The model at a value of the sweep parameter with another width of the smooth clearance.
[[nodiscard]] std::function<model::DynamicModel(double value, double clearance_smoothing)> smoothed_model_at(
    const LoadedInput& input);

/// What is allowed but rarely meant, most important first (gear/warnings.hpp): the stage, the operating points at the
/// ends of what the study varies, the study itself, values that were ignored. Of a study without the notes on its
/// drawings, which `epicyclic gear` has.
[[nodiscard]] std::vector<std::string> warnings(const LoadedInput& input);

/// The same for `epicyclic gear`: of the stage and its operating point alone, with notes, and why it cannot be moved in
/// time.
[[nodiscard]] std::vector<std::string> gear_warnings(const LoadedInput& input);

/// What identifies the study's results: SHA-256 of the canonical resolved input with the versions of journal and
/// numerics. On one machine two inputs share it exactly where their resolved inputs, without origins and notes, are
/// equal; on another machine an input keeps it, although last digits of what is computed from catalogue data may
/// differ.
[[nodiscard]] std::string identity(const LoadedInput& input, std::string_view command);

/// Where another study's resolved input differs from this one's in what identifies them, a line each: pointer and both
/// values. Origins are left out.
[[nodiscard]] std::vector<std::string> differences(const nlohmann::json& other, const LoadedInput& input);

/// Name of study or stage with the boundary and, unless it is swept, the speed: for figures.
[[nodiscard]] std::string figure_title(const Study& study);

/// What a sweep will take.
struct Cost {
  std::size_t points = 0;
  std::size_t chains = 0;         ///< that can run at the same time
  std::int64_t mesh_periods = 0;  ///< in all
  std::size_t dimension = 0;      ///< of the state
  double rhs_per_period = 0;      ///< right-hand sides per mesh period, mean of a few periods at three values
  [[nodiscard]] double rhs_evaluations() const { return rhs_per_period * static_cast<double>(mesh_periods); }
};

/// Counts, and probes the sweep at its ends and middle from the default start.
[[nodiscard]] Cost estimate_cost(const LoadedInput& input);

}  // namespace epicyclic::io
