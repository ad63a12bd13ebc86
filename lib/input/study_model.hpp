// From the input to models: what a sweep requests at each value of its parameter.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "gear/warnings.hpp"
#include "input/study_input.hpp"
#include "studies/sweep.hpp"

namespace epicyclic::input {

/// The model at each value of the study's sweep parameter, named or a JSON pointer. Scales are those of the stage as
/// given. `input` must outlive the result. A call throws InputError when the study is not valid at that value.
[[nodiscard]] studies::ModelAt model_at(const LoadedInput& input);
studies::ModelAt model_at(LoadedInput&& input) = delete;

/// The same of any parameter, named or a JSON pointer: of a sweep whose axis is not the study's.
/// @throws InputError where the input has no such number
[[nodiscard]] studies::ModelAt model_at(const LoadedInput& input, const std::string& parameter);
studies::ModelAt model_at(LoadedInput&& input, const std::string& parameter) = delete;

/// The same of an input that is shared: the result keeps it, and needs nothing else to live.
[[nodiscard]] studies::ModelAt model_at(std::shared_ptr<const LoadedInput> input, const std::string& parameter);

/// The model at each value of any parameter, named or a JSON pointer, with the derivative of its right-hand side by it:
/// what integrate::make_flow_family() takes. Scales are those of the stage as given. `input` must outlive the result. A
/// call throws InputError when the study is not valid at that value, or there is no derivative.
/// @param step  h of the difference of constants, as of model::set_parameter_derivative(): about 1e-3 of the range
/// over which they change; the study has to be valid at value +- 2 h
[[nodiscard]] studies::ModelAt model_family(const LoadedInput& input, const std::string& parameter, double step);
studies::ModelAt model_family(LoadedInput&& input, const std::string& parameter, double step) = delete;

/// The same at values of two parameters, with the derivative by the first.
[[nodiscard]] std::function<model::DynamicModel(double first, double second)> model_plane(
    const LoadedInput& input, const std::string& first_parameter, const std::string& second_parameter, double step);
std::function<model::DynamicModel(double first, double second)> model_plane(LoadedInput&& input,
                                                                            const std::string& first_parameter,
                                                                            const std::string& second_parameter,
                                                                            double step) = delete;

/// The value of a parameter, named or a JSON pointer, in the given study.
/// @throws InputError if the input has no such number
[[nodiscard]] double given_value(const LoadedInput& input, const std::string& parameter);

/// Points and chains of a study that has points.
[[nodiscard]] studies::SweepPlan plan_of(const Study& study);

/// The model at each point of plan_of(); of basins with the point's own start for the default one. Scales are those of
/// the stage as given. `input` must outlive the result. A call throws InputError when the study is not valid there.
[[nodiscard]] studies::ModelAtPoint model_at_point(const LoadedInput& input);
studies::ModelAtPoint model_at_point(LoadedInput&& input) = delete;

/// The model at a value of the sweep parameter with another width of the smooth clearance. `input` must outlive the
/// result.
[[nodiscard]] std::function<model::DynamicModel(double value, double clearance_smoothing)> smoothed_model_at(
    const LoadedInput& input);
std::function<model::DynamicModel(double value, double clearance_smoothing)> smoothed_model_at(LoadedInput&& input) =
    delete;

/// The model with the initial state of the study.
[[nodiscard]] model::DynamicModel started(model::DynamicModel model, const Study& study);

/// The model of an operating point.
/// @throws InputError if its numbers contradict each other
[[nodiscard]] model::DynamicModel model_of(const model::OperatingPoint& point, const model::Scales& scales);

/// Warnings of valid but unusual values, most important first (gear/warnings.hpp): of the stage, of the operating
/// points at the ends of varied ranges, of the study itself, and of ignored values. For a study without the notes on
/// drawings, which `epicyclic gear` has.
[[nodiscard]] std::vector<std::string> warnings(const LoadedInput& input);

/// Warnings of the stage and its operating point alone, for `epicyclic gear`: most important first, with the notes on
/// its drawings, and the reason if its equations cannot be integrated.
[[nodiscard]] std::vector<std::string> gear_warnings(const LoadedInput& input);

/// The error of the mesh stiffness with the chosen harmonics, a line for each mesh. A default choice gives a warning.
[[nodiscard]] std::vector<std::string> stiffness_notes(const LoadedInput& input);

/// Does mesh damping jump at contact? By the values of the resolved input, else by the defaults.
[[nodiscard]] bool damping_jumps(const nlohmann::json& resolved);

/// Warning that regimes of such an input are classified without tangents; at a pointer.
[[nodiscard]] gear::Warning without_tangents(std::string pointer);
/// The same for a study that classifies the regimes of its points.
void warn_without_tangents(std::vector<gear::Warning>& out, const LoadedInput& input);

}  // namespace epicyclic::input
