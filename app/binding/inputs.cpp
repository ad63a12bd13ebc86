// Inputs as the program reads them, the numbers of their gears, and their equations of motion.

#include <cstddef>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include "arrays.hpp"
#include "binding.hpp"
#include "command/commands.hpp"
#include "core/errors.hpp"
#include "gear/gear_set.hpp"
#include "input/starter.hpp"
#include "input/study_model.hpp"
#include "rates.hpp"
#include "reports/gear_output.hpp"
#include "reports/gear_report.hpp"
#include "studies/cost_estimate.hpp"

namespace epicyclic::binding {

namespace py = pybind11;

namespace {

std::string text_of(const nlohmann::json& json) {
  return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace);
}

/// The equations of motion at one operating point, for arrays.
/// @param y  shape (dimension,) or (dimension, k)
Array evaluate(const Rates& rates, double tau, const py::object& y) {
  const std::size_t n = rates.model().dimension;
  const Array states = finite_array(y, "y");
  if (states.ndim() < 1 || states.ndim() > 2 || states.shape(0) != static_cast<py::ssize_t>(n))
    throw InputError("y has the shape " + shape_text(states) + ", not (" + std::to_string(n) + ",) or (" +
                     std::to_string(n) + ", k)");
  const auto columns = states.ndim() == 2 ? static_cast<std::size_t>(states.shape(1)) : std::size_t{1};
  Array result(std::vector<py::ssize_t>(states.shape(), states.shape() + states.ndim()));
  if (states.ndim() == 1) {
    rates.evaluate(tau, states.data(), result.mutable_data());
    return result;
  }
  std::vector<double> state(n), rate(n);
  for (std::size_t k = 0; k < columns; ++k) {
    for (std::size_t i = 0; i < n; ++i) state[i] = states.data()[i * columns + k];
    rates.evaluate(tau, state.data(), rate.data());
    for (std::size_t i = 0; i < n; ++i) result.mutable_data()[i * columns + k] = rate[i];
  }
  return result;
}

/// An input, shared with what is made of it.
class Input {
 public:
  explicit Input(input::LoadedInput loaded) : input_(std::make_shared<const input::LoadedInput>(std::move(loaded))) {}

  [[nodiscard]] std::string resolved() const { return text_of(input_->resolved); }
  [[nodiscard]] std::string kind() const { return std::string(input_->study.kind()); }
  [[nodiscard]] bool has_dynamics() const { return input_->study.has_dynamics(); }
  [[nodiscard]] std::vector<std::string> warnings() const { return input::warnings(*input_); }

  /// What a study that is computed point by point has to compute; nothing of another one.
  [[nodiscard]] py::dict points() const {
    py::dict numbers;
    if (!input_->study.has_dynamics() || !input_->study.has_points()) return numbers;
    const studies::SweepPlan plan = input::plan_of(input_->study);
    numbers["points"] = plan.points.size();
    numbers["mesh_periods"] = studies::mesh_periods_of(plan, input_->study.recording());
    return numbers;
  }

  [[nodiscard]] py::dict gear() const {
    reports::require_finite_numbers(*input_);
    const reports::GearOutput words = reports::gear_words(*input_);
    const gear::Stage& stage = input_->study.stage;
    py::dict quantities;
    const auto add = [&](const std::vector<reports::Quantity>& all) {
      for (const reports::Quantity& q : all)
        quantities[py::str(q.name)] =
            py::dict(py::arg("value") = q.value, py::arg("unit") = q.unit, py::arg("symbol") = q.symbol,
                     py::arg("formula") = q.formula, py::arg("group") = q.group);
    };
    if (stage.catalogue) add(reports::gear_quantities(gear::make_gear_set(stage), stage));
    add(reports::operating_quantities(stage, input_->study.mesh_frequency_ratio));
    return py::dict(py::arg("quantities") = quantities, py::arg("modes") = words.modes,
                    py::arg("verdicts") = words.verdicts, py::arg("warnings") = words.warnings);
  }

  [[nodiscard]] Rates rates() const { return Rates(input_); }

 private:
  std::shared_ptr<const input::LoadedInput> input_;
};

/// The study of a diagram over the speed that `epicyclic init` writes, with its stage in it.
std::string drawn_study(const std::string& name, const app::InitArguments& given) {
  app::Arguments arguments;
  arguments.output = "stage";
  arguments.init = given;
  input::Drawing drawing = app::drawing_of(arguments);
  drawing.name = name;
  nlohmann::ordered_json study = input::starter_sweep(drawing, "stage.json");
  study["stage"] = input::starter_stage(drawing);
  return study.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

}  // namespace

void add_inputs(py::module_& module) {
  py::class_<Rates>(module, "RightHandSide")
      .def("__call__", &evaluate, py::arg("tau"), py::arg("y"))
      .def_property_readonly("names", [](const Rates& r) { return r.model().state_names; })
      .def_property_readonly("dimension", [](const Rates& r) { return r.model().dimension; })
      .def_property_readonly("mesh_frequency_ratio", [](const Rates& r) { return r.model().omega; })
      .def_property_readonly("omega_sn", [](const Rates& r) { return r.model().scales.omega_sn; })
      .def_property_readonly("start", [](const Rates& r) { return array_of(r.model().default_start); })
      .def_property_readonly("period", &Rates::period);

  py::class_<Input>(module, "Input")
      .def_static(
          "read",
          [](const std::string& file, const std::vector<std::string>& sets) {
            return Input(input::load_input(file, input::parse_assignments(sets)));
          },
          py::arg("file"), py::arg("sets"))
      .def_static(
          "parse",
          [](const std::string& text, const std::string& name, const std::vector<std::string>& sets) {
            return Input(input::load_input_text(text, name, input::parse_assignments(sets)));
          },
          py::arg("text"), py::arg("name"), py::arg("sets"))
      .def_property_readonly("resolved", &Input::resolved)
      .def_property_readonly("kind", &Input::kind)
      .def_property_readonly("has_dynamics", &Input::has_dynamics)
      .def("warnings", &Input::warnings)
      .def("points", &Input::points)
      .def("gear", &Input::gear)
      .def("right_hand_side", &Input::rates);

  py::class_<app::InitArguments>(module, "Drawing")
      .def(py::init<>())
      .def_readwrite("pair", &app::InitArguments::pair)
      .def_readwrite("teeth", &app::InitArguments::teeth)
      .def_readwrite("profile_shifts", &app::InitArguments::profile_shifts)
      .def_readwrite("module_mm", &app::InitArguments::module_mm)
      .def_readwrite("pressure_angle_deg", &app::InitArguments::pressure_angle_deg)
      .def_readwrite("width_mm", &app::InitArguments::width_mm)
      .def_readwrite("planets", &app::InitArguments::planets)
      .def_readwrite("angles_deg", &app::InitArguments::angles_deg)
      .def_readwrite("torque_Nm", &app::InitArguments::torque_Nm)
      .def_readwrite("speed_rpm", &app::InitArguments::speed_rpm)
      .def("study", [](const app::InitArguments& given, const std::string& name) { return drawn_study(name, given); });
}

}  // namespace epicyclic::binding
