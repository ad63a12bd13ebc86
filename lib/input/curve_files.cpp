#include "input/curve_files.hpp"

#include <algorithm>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "core/errors.hpp"
#include "input/csv_columns.hpp"
#include "input/pointers.hpp"
#include "input/study_input.hpp"
#include "model/friction_track.hpp"

namespace epicyclic::input {

namespace {

using nlohmann::json;

/// The mean of a stiffness curve; nothing if its rows are wrong, which the rules of the stage report.
std::optional<double> mean_of(const json& rows) {
  ReadContext context;
  gear::StiffnessCurve curve;
  stiffness_curve_table().read(rows, "", curve, context);
  if (!context.findings.empty() || curve.phase.empty() || curve.phase.size() != curve.stiffness_N_per_m.size())
    return std::nullopt;
  try {
    return model::mean_stiffness(curve);
  } catch (const InputError&) {
    return std::nullopt;
  }
}

}  // namespace

void read_curve_files(
    json& stage, const std::string& root,
    const std::function<const TextFile&(const std::string& pointer, const std::string& name)>& text_of,
    const std::function<void(const std::string& pointer, std::string message)>& refuse) {
  for (const char* mesh_key : {"sun_planet_mesh", "ring_planet_mesh"})
    for (const auto& [curve_key, values] :
         {std::pair("stiffness_curve", "stiffness_N_per_m"), std::pair("error_curve", "error_um")}) {
      const std::string place = std::string("/lumped/") + mesh_key;
      json* mesh = find_at(stage, place);
      json* curve = find_at(stage, place + "/" + curve_key);
      if (curve == nullptr || !curve->is_object() || !curve->contains("file") || curve->contains("phase")) continue;
      const std::string pointer = root + place + "/" + curve_key;
      const auto is_text = [&](const char* key) { return !curve->contains(key) || curve->at(key).is_string(); };
      if (!is_text("file") || !is_text("column")) continue;  // the tables refuse it
      const std::string name = curve->at("file").get<std::string>();
      std::string origin = "table: " + name;
      if (const auto origins = curve->find("origin"); origins != curve->end() && origins->is_object()) {
        origin = origins->value("file", origin);
        origins->erase("file");
        origins->erase("column");
      }
      std::vector<std::vector<double>> rows;
      try {
        rows = csv_columns(text_of(pointer + "/file", name), {"phase", curve->value("column", values)});
      } catch (const InputError& error) {
        refuse(pointer + "/file", "the file " + name + ": " + error.what());
        mesh->erase(curve_key);
        continue;
      }
      curve->erase("file");
      curve->erase("column");
      const auto fill = [&](json& object, const char* key, json value, const std::string& from) {
        object[key] = std::move(value);
        if (!object["origin"].is_object()) object["origin"] = json::object();
        object["origin"][key] = from;
      };
      const std::vector<double>& phase = rows[0];
      if (!curve->contains("breakpoints")) {
        std::vector<double> jumps;
        for (std::size_t k = 1; k < phase.size(); ++k)
          if (phase[k] == phase[k - 1] && (jumps.empty() || jumps.back() != phase[k])) jumps.push_back(phase[k]);
        fill(*curve, "breakpoints", jumps, origin);
      }
      fill(*curve, "phase", phase, origin);
      fill(*curve, values, rows[1], origin);
      if (std::string_view(curve_key) == "stiffness_curve" && !mesh->contains("stiffness_N_per_m"))
        if (const auto mean = mean_of(*curve)) fill(*mesh, "stiffness_N_per_m", *mean, "table: mean of " + name);
    }
}

}  // namespace epicyclic::input
