#include "reports/section_output.hpp"

#include <optional>
#include <utility>

#include <fmt/format.h>

namespace epicyclic::reports {

namespace {

/// "s" is the sun, "p2" planet 2.
std::string body_words(std::string_view body) {
  if (body == "s") return "the sun";
  if (body == "r") return "the ring";
  if (body == "c") return "the carrier";
  if (body.starts_with("p")) return fmt::format("planet {}", body.substr(1));
  return std::string(body);
}

/// Of "sp_2": the mesh, the number of its planet.
std::string mesh_words(std::string_view mesh) {
  return fmt::format("{}-planet mesh {}", mesh.starts_with("sp") ? "sun" : "ring", mesh.substr(mesh.find('_') + 1));
}

/// Removes what a name begins with, if it does.
bool begins(std::string_view& name, std::string_view with) {
  if (!name.starts_with(with)) return false;
  name.remove_prefix(with.size());
  return true;
}

/// Of a displacement or deflection; nothing of other names.
std::optional<std::string> length_words(std::string_view name) {
  if (begins(name, "delta_")) return "deflection of " + mesh_words(name);
  if (name.size() < 3 || name[1] != '_') return std::nullopt;
  const std::string body = body_words(name.substr(2));
  switch (name[0]) {
    case 'x':
    case 'y':
      return fmt::format("displacement of {} along {}", body, name[0]);
    case 'u':
      return fmt::format("rotation of {}, a length on its base circle", body);
    case 'w':
      return fmt::format("rotation of {} relative to the ring, a length on its base circle", body);
    default:
      return std::nullopt;
  }
}

}  // namespace

ColumnWords column_words(std::string_view column) {
  if (column == "periods") return {"1", "time in mesh periods"};
  if (column == "tau") return {"1", "dimensionless time"};
  if (column == "time_s") return {"s", "time"};
  if (column == "phase") return {"rad", "mesh phase"};
  std::string_view name = column;
  if (begins(name, "force_")) return {"N", "force of " + mesh_words(name)};
  if (begins(name, "load_sharing_")) return {"1", "share of the load of " + mesh_words(name) + "; 1 is an even share"};
  if (begins(name, "bearing_planet_")) return {"N", fmt::format("force of the bearing of planet {}", name)};
  if (begins(name, "bearing_")) return {"N", fmt::format("force of the bearing of the {}", name)};
  std::string unit = "b_c";
  for (const auto& [ending, of_ending] : {std::pair("_um", "um"), std::pair("_m_per_s", "m/s")})
    if (const std::string_view end = ending; name.ends_with(end)) {
      name.remove_suffix(end.size());
      unit = of_ending;
    }
  constexpr std::string_view rate = "_rate";
  const bool is_rate = name.ends_with(rate);
  if (is_rate) name.remove_suffix(rate.size());
  if (is_rate && unit == "b_c") unit = "b_c per tau";
  const auto words = length_words(name);
  if (!words) return {std::move(unit), ""};
  return {std::move(unit), is_rate ? "rate of the " + *words : *words};
}

void write_section_h5(store::Hdf5File& h5, const std::string& group, const std::vector<std::string>& columns,
                      std::size_t rows, const std::function<void(std::size_t, std::span<double>)>& row_values,
                      const std::vector<std::string>& units) {
  h5.write_columns(group, columns, rows, row_values);
  for (std::size_t j = 0; j < columns.size(); ++j) {
    const std::string path = fmt::format("{}/{}", group, columns[j]);
    const ColumnWords words = column_words(columns[j]);
    h5.set_units(path, units.empty() ? words.unit : units.at(j));
    if (!words.meaning.empty()) h5.set_attribute(path, "meaning", words.meaning);
  }
}

}  // namespace epicyclic::reports
