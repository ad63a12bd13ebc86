#include "reports/gear_output.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "core/atomic_file.hpp"
#include "core/csv.hpp"
#include "core/errors.hpp"
#include "gear/bearing.hpp"
#include "gear/ehl_friction.hpp"
#include "gear/gear_set.hpp"
#include "gear/kinematics.hpp"
#include "input/study_model.hpp"
#include "model/modes.hpp"
#include "reports/gear_figures.hpp"
#include "reports/gear_report.hpp"
#include "reports/markdown.hpp"
#include "reports/transmission_error_report.hpp"

namespace epicyclic::reports {

namespace {

constexpr int harmonics_shown = 3;

std::string modes_csv(const gear::Stage& stage, const std::vector<model::Mode>& modes, const model::Scales& scales,
                      const std::vector<ModeRange>& ranges) {
  std::vector<std::string> columns = {"mode", "frequency_Hz", "frequency_ratio", "type", "multiplicity"};
  for (std::size_t k = 0; k < model::element_count; ++k)
    columns.push_back("elastic_" + std::string(model::to_string(static_cast<model::Element>(k))));
  for (std::size_t k = 0; k < model::displacement_count; ++k)
    columns.push_back("kinetic_" + std::string(model::to_string(static_cast<model::MemberDisplacement>(k))));
  if (!ranges.empty()) columns.insert(columns.end(), {"frequency_low_Hz", "frequency_high_Hz"});
  const model::LinearStage linear = model::linear_stage(stage, scales);
  CsvWriter csv(columns);
  int number = 1;
  for (const model::Mode& mode : modes) {
    const model::ModalEnergies e = model::modal_energies(linear, mode, stage.planet_count);
    csv.cell(number++)
        .cell(mode.frequency_ratio * scales.omega_sn / (2.0 * std::numbers::pi))
        .cell(mode.frequency_ratio)
        .cell(model::to_string(mode.type))
        .cell(mode.multiplicity);
    for (const double share : e.elastic) csv.cell(share);
    for (const double share : e.kinetic) csv.cell(share);
    if (!ranges.empty()) {
      const ModeRange& range = ranges[static_cast<std::size_t>(number - 2)];
      csv.cell(range.from).cell(range.to);
    }
    csv.end_row();
  }
  return csv.text();
}

/// Natural frequencies, and the speeds at which the mesh frequency meets them, for a terminal.
std::string mode_summary(const gear::Stage& stage, const std::vector<model::Mode>& modes, bool moves) {
  const double omega_sn = model::scales_of(stage).omega_sn;
  std::vector<std::vector<std::string>> rows{{"mode", "type", "multiplicity", "frequency [Hz]", "ω/ω_sn"}};
  const std::string driving = stage.is_pair() ? "gear 1" : "sun";
  if (moves) rows[0].emplace_back("at " + driving + " speed [rpm]");
  for (const model::Mode& mode : modes) {
    const double omega = mode.frequency_ratio * omega_sn;
    rows.push_back({std::to_string(rows.size()), std::string(model::to_string(mode.type)),
                    std::to_string(mode.multiplicity), fmt::format("{:.1f}", omega / (2.0 * std::numbers::pi)),
                    fmt::format("{:.4f}", mode.frequency_ratio)});
    if (moves)
      rows.back().push_back(omega > 0.0 ? fmt::format("{:.0f}", gear::rpm * gear::speeds(stage, omega).sun) : "-");
  }
  return aligned(rows) +
         (moves ? "At the " + driving + " speed of a mode the mesh frequency is its natural frequency.\n" : "");
}

std::string mode_shapes_csv(const gear::Stage& stage, const std::vector<model::Mode>& modes) {
  std::vector<std::string> columns = {"mode", "shape"};
  for (const std::string& name : model::coordinate_names(model::Layout::full, stage.planet_count))
    columns.push_back(name);
  CsvWriter csv(columns);
  int number = 1;
  for (const model::Mode& mode : modes) {
    for (Eigen::Index k = 0; k < mode.shapes.cols(); ++k) {
      csv.cell(number).cell(static_cast<int>(k) + 1);
      for (Eigen::Index slot = 0; slot < mode.shapes.rows(); ++slot) csv.cell(mode.shapes(slot, k));
      csv.end_row();
    }
    ++number;
  }
  return csv.text();
}

/// Intersections of the harmonics of the mesh frequency with the natural frequencies: Omega = frequency_ratio / h.
std::string campbell_csv(const gear::Stage& stage, const std::vector<model::Mode>& modes) {
  const model::Scales scales = model::scales_of(stage);
  const bool moves = gear::problems_for_dynamics(stage).empty();
  std::vector<std::string> columns = {
      "mode", "type", "frequency_ratio", "harmonic", "mesh_frequency_ratio", "mesh_frequency_Hz"};
  if (moves) columns.emplace_back("sun_speed_rpm");
  CsvWriter csv(columns);
  int number = 1;
  for (const model::Mode& mode : modes) {
    for (int h = 1; h <= harmonics_shown && mode.frequency_ratio > 0.0; ++h) {
      const double ratio = mode.frequency_ratio / h;
      const double frequency = ratio * scales.omega_sn;
      csv.cell(number).cell(model::to_string(mode.type)).cell(mode.frequency_ratio).cell(h).cell(ratio);
      csv.cell(frequency / (2.0 * std::numbers::pi));
      if (moves) csv.cell(gear::rpm * gear::speeds(stage, frequency).sun);
      csv.end_row();
    }
    ++number;
  }
  return csv.text();
}

/// Phases of the common s at which stiffness is tabulated: even ones, and both sides of each jump of either mesh.
struct PhaseRow {
  double phase;
  double inside;  ///< a phase on the side that is meant
};

std::vector<PhaseRow> phase_rows(const gear::GearSet& set) {
  constexpr int even = 500;
  constexpr double side = 1e-9;
  std::vector<PhaseRow> rows;
  for (int k = 0; k < even; ++k) rows.push_back({static_cast<double>(k) / even, static_cast<double>(k) / even + side});
  const auto jumps = [&](const gear::MeshedPair& mesh, double lead) {
    for (const double own : mesh.breakpoints()) {
      const double cycles = own - lead;
      const double phase = cycles - std::floor(cycles);
      rows.push_back({phase, phase - side});
      rows.push_back({phase, phase + side});
    }
  };
  jumps(set.sun_planet, 0.0);
  if (!set.is_pair()) jumps(set.ring_planet, set.ring_mesh_lead);
  std::sort(rows.begin(), rows.end(), [](const PhaseRow& a, const PhaseRow& b) { return a.inside < b.inside; });
  return rows;
}

std::string stiffness_csv(const gear::GearSet& set) {
  if (set.is_pair()) {
    CsvWriter csv({"phase", "k_sp_N_per_m", "k_sp_fourier_N_per_m"});
    for (const PhaseRow& row : phase_rows(set))
      csv.row(row.phase, set.sun_planet.stiffness(row.phase, row.inside - std::floor(row.inside)),
              set.sun_planet_stiffness.at(row.phase));
    return csv.text();
  }
  CsvWriter csv({"phase", "k_sp_N_per_m", "k_rp_N_per_m", "k_sp_fourier_N_per_m", "k_rp_fourier_N_per_m"});
  const auto value = [](const gear::MeshedPair& mesh, const PhaseRow& row, double lead) {
    const double inside = row.inside + lead;
    const double cycles = std::floor(inside);
    return mesh.stiffness(row.phase + lead - cycles, inside - cycles);
  };
  for (const PhaseRow& row : phase_rows(set))
    csv.row(row.phase, value(set.sun_planet, row, 0.0), value(set.ring_planet, row, set.ring_mesh_lead),
            set.sun_planet_stiffness.at(row.phase), set.ring_planet_stiffness.at(row.phase + set.ring_mesh_lead));
  return csv.text();
}

struct NamedMesh {
  const char* name;
  const gear::MeshedPair& pair;
  gear::LineOfAction line;
};

std::vector<NamedMesh> meshes(const gear::GearSet& set, const gear::Stage& stage) {
  std::vector<NamedMesh> all = {{"sp", set.sun_planet, gear::sun_planet_line(stage)}};
  if (!set.is_pair()) all.push_back({"rp", set.ring_planet, gear::ring_planet_line(stage)});
  return all;
}

std::string load_sharing_csv(const std::vector<NamedMesh>& both, const gear::Lubrication& any) {
  CsvWriter csv({"mesh", "position", "distance_from_pitch_point_mm", "share"});
  for (const NamedMesh& m : both) {
    const gear::EhlFriction e = gear::ehl_of(m.pair, any);
    for (std::size_t k = 0; k < e.share.size(); ++k)
      csv.row(m.name, e.share_position[k], m.pair.arm_mm(e.share_position[k]) - m.pair.pair.pitch_arm_mm, e.share[k]);
  }
  return csv.text();
}

std::string friction_csv(const std::vector<NamedMesh>& both, const gear::Lubrication& lubrication,
                         const gear::MeshLoad& load) {
  CsvWriter csv({"mesh", "position", "distance_from_pitch_point_mm", "sliding_m_per_s", "rolling_m_per_s",
                 "slide_to_roll", "pressure_GPa", "radius_mm", "share", "mu", "signed_ratio", "within_range"});
  for (const NamedMesh& m : both) {
    const gear::EhlFriction e = gear::ehl_of(m.pair, lubrication);
    for (std::size_t k = 0; k < e.share.size(); ++k) {
      const gear::LubricatedContact c = gear::lubricated_contact(e, m.line, load, e.share_position[k], e.share[k]);
      const double mu = gear::xu_friction_coefficient(c);
      csv.row(m.name, e.share_position[k], m.pair.arm_mm(e.share_position[k]) - m.pair.pair.pitch_arm_mm,
              c.slide_to_roll * c.rolling_m_per_s, c.rolling_m_per_s, c.slide_to_roll, c.pressure_GPa, 1e3 * c.radius_m,
              e.share[k], mu, c.slide_to_roll > 0.0 ? -mu : mu, static_cast<int>(gear::within_xu_range(c)));
    }
  }
  return csv.text();
}

std::string friction_ratios_csv(const std::vector<NamedMesh>& both, const gear::Lubrication& lubrication,
                                const gear::MeshLoad& load) {
  CsvWriter csv({"mesh", "phase", "force_ratio", "moment_ratio_driving_mm", "moment_ratio_driven_mm"});
  for (const NamedMesh& m : both) {
    const gear::FrictionTable t = gear::friction_table(gear::ehl_of(m.pair, lubrication), m.line, load);
    for (std::size_t k = 0; k < t.phase.size(); ++k)
      csv.row(m.name, t.phase[k], t.force_ratio[k], t.moment_driving_mm[k], t.moment_driven_mm[k]);
  }
  return csv.text();
}

/// An extrapolated value of Xu's regression is marked, not refused.
void warn_of_range(std::vector<std::string>& warnings, const NamedMesh& m, const gear::Lubrication& lubrication,
                   const gear::MeshLoad& load) {
  const gear::LubricationRange r = gear::lubrication_range(gear::ehl_of(m.pair, lubrication), m.line, load);
  if (!r.within)
    warnings.push_back(
        fmt::format("friction of the {} mesh is extrapolated: Xu's formula was fitted at about 0.5 to 2.5 GPa, 1 to 20 "
                    "m/s, 5 to 100 "
                    "mPa s and 0.1 to 0.8 um; here {:.2f} to {:.2f} GPa, {:.1f} to {:.1f} m/s, {} mPa s, {} um",
                    m.name, r.least_pressure_GPa, r.greatest_pressure_GPa, r.least_rolling_m_per_s,
                    r.greatest_rolling_m_per_s, lubrication.viscosity_mPas, lubrication.roughness_um));
}

std::string bearings_csv(const gear::Catalogue& catalogue) {
  CsvWriter csv({"member", "bearing", "approach_um", "stiffness_N_per_m", "force_N"});
  const auto rows = [&](const char* member, const std::optional<gear::SupportBearing>& bearing) {
    if (!bearing) return;
    const gear::BearingData data = *gear::bearing_data(*bearing);
    constexpr int count = 50;
    for (int k = 0; k <= count; ++k) {
      const double approach_um = k;
      csv.row(member, data.name, approach_um, data.stiffness(approach_um * 1e-6), data.force(approach_um * 1e-6));
    }
  };
  rows("sun", catalogue.sun_bearing);
  rows("planet", catalogue.planet_bearing);
  rows("carrier", catalogue.carrier.bearing);
  return csv.text();
}

/// Collects files as they are written.
class Folder {
 public:
  explicit Folder(std::filesystem::path path) : path_(std::move(path)) {}
  void write(const std::string& name, const std::string& text) {
    write_file_atomically(path_ / name, text);
    files_.push_back(name);
  }
  [[nodiscard]] const std::vector<std::string>& files() const { return files_; }

 private:
  std::filesystem::path path_;
  std::vector<std::string> files_;
};

void note_figures(GearOutput& out, const std::vector<GearFigure>& figures) {
  for (const GearFigure& figure : figures) {
    if (figure.outcome.drawn())
      out.figures.push_back(figure.stem);
    else if (figure.outcome.failed())
      out.undrawn.push_back(figure.stem + ": " + figure.outcome.message);
  }
}

}  // namespace

void require_finite_numbers(const input::LoadedInput& input) {
  const gear::Stage& stage = input.study.stage;
  const model::Scales scales = model::scales_of(stage);
  std::vector<Quantity> all = operating_quantities(stage, input.study.mesh_frequency_ratio);
  if (stage.catalogue)
    for (Quantity& q : gear_quantities(gear::make_gear_set(stage), stage)) all.push_back(std::move(q));
  std::vector<std::string> names;
  for (const Quantity& q : all)
    if (!std::isfinite(q.value)) names.push_back(q.name);
  if (names.empty())
    for (const model::Mode& mode : model::modes(stage, scales))
      if (!std::isfinite(mode.frequency_ratio) || !mode.shapes.allFinite()) {
        names.emplace_back("the natural frequencies");
        break;
      }
  if (names.empty()) return;
  constexpr std::size_t most = 5;
  if (names.size() > most) names.resize(most);
  throw InputError(input.study_file.name +
                   ": its numbers are within their bounds, but not together: no finite number "
                   "comes out for " +
                   input::listed(names));
}

std::string modes_table(const input::LoadedInput& input) {
  const gear::Stage& stage = input.study.stage;
  const model::Scales scales = model::scales_of(stage);
  const std::vector<model::Mode> modes = model::modes(stage, scales);
  return modes_csv(stage, modes, scales, mode_ranges(input, modes));
}

std::string mode_shapes_table(const input::LoadedInput& input) {
  const gear::Stage& stage = input.study.stage;
  return mode_shapes_csv(stage, model::modes(stage, model::scales_of(stage)));
}

GearOutput write_gear_output(const std::filesystem::path& path, const input::LoadedInput& input) {
  const gear::Stage& stage = input.study.stage;
  const model::Scales scales = model::scales_of(stage);
  const std::vector<model::Mode> modes = model::modes(stage, scales);
  const bool moves = gear::problems_for_dynamics(stage).empty();
  const double mesh_frequency = input.study.mesh_frequency_ratio * scales.omega_sn;
  const std::filesystem::path figures = path / "figures";
  Folder folder(path);
  GearOutput out = gear_words(input);
  GearPage page;
  page.title = stage.is_pair() ? "Gear pair" : "Planetary stage";
  if (!stage.name.empty()) page.title += " " + stage.name;

  page.mode_ranges = mode_ranges(input, modes);
  folder.write("modes.csv", out.modes);
  folder.write("mode_shapes.csv", mode_shapes_csv(stage, modes));
  folder.write("campbell.csv", campbell_csv(stage, modes));
  if (stage.catalogue) {
    const gear::GearSet set = gear::make_gear_set(stage);
    page.quantities = gear_quantities(set, stage);
    const auto both = meshes(set, stage);
    folder.write("stiffness.csv", stiffness_csv(set));
    folder.write("load_sharing.csv", load_sharing_csv(both, set.catalogue.lubrication.value_or(gear::Lubrication{})));
    folder.write("bearings.csv", bearings_csv(set.catalogue));
    gear::MeshLoad load;
    if (moves) load = gear::mean_mesh_load(stage, mesh_frequency);
    if (moves && set.catalogue.lubrication) {
      for (const NamedMesh& m : both) warn_of_range(out.warnings, m, *set.catalogue.lubrication, load);
      folder.write("friction.csv", friction_csv(both, *set.catalogue.lubrication, load));
      folder.write("friction_ratios.csv", friction_ratios_csv(both, *set.catalogue.lubrication, load));
    }
    note_figures(out, draw_gear_set_figures(figures, set, load, stage));
    if (const auto design = gear::design_torque_Nm(stage); design || moves) {
      const std::vector<TransmissionErrorTable> errors =
          transmission_errors(set, design ? *design : std::abs(gear::torques(stage, mesh_frequency).sun));
      folder.write("static_transmission_error.csv", transmission_error_csv(errors));
      page.transmission_error = transmission_error_section(errors, set.catalogue.is_modified());
      note_figures(out, draw_transmission_error_figures(figures, errors, stage));
    }
  }
  for (Quantity& q : operating_quantities(stage, input.study.mesh_frequency_ratio))
    page.quantities.push_back(std::move(q));
  folder.write("geometry.csv", quantities_csv(page.quantities));
  note_figures(out, draw_mode_figures(figures, stage));

  page.verdicts = out.verdicts;
  page.warnings = out.warnings;
  page.figures = out.figures;
  page.files = folder.files();
  folder.write("gear.md", gear_page(page, input, modes, scales));
  return out;
}

GearOutput gear_words(const input::LoadedInput& input) {
  const gear::Stage& stage = input.study.stage;
  const model::Scales scales = model::scales_of(stage);
  const std::vector<model::Mode> modes = model::modes(stage, scales);
  const std::vector<ModeRange> ranges = mode_ranges(input, modes);
  const bool moves = gear::problems_for_dynamics(stage).empty();
  GearOutput out;
  out.warnings = input::gear_warnings(input);
  out.modes = modes_csv(stage, modes, scales, ranges);
  out.mode_summary = mode_summary(stage, modes, moves);
  if (stage.catalogue) {
    out.verdicts = contact_verdicts(gear::make_gear_set(stage), stage);
    if (moves) out.verdicts.insert(out.verdicts.begin(), operation_verdict(stage, input.study.mesh_frequency_ratio));
    for (const std::string& line : input::stiffness_notes(input)) out.verdicts.push_back(line + ".");
  }
  if (const std::string drive = drive_words(stage); moves && !drive.empty())
    out.verdicts.push_back("Drive: " + drive + ".");
  if (moves) out.verdicts.push_back("The " + error_words(stage, input.study.mesh_frequency_ratio) + ".");
  if (!ranges.empty()) out.verdicts.push_back(range_words(ranges));
  return out;
}

}  // namespace epicyclic::reports
