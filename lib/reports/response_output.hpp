// Figures of a sweep's records on vibration and load along the parameter: response curves, largest forces, dynamic
// factor, load sharing of the planets, and the spectrum as a map.
#pragma once

#include <filesystem>
#include <string>

#include "figures/gnuplot.hpp"
#include "studies/point_source.hpp"
#include "studies/sweep_options.hpp"

namespace epicyclic::reports {

/// The data of curves.
struct ResponseInput {
  const studies::SweepOptions& sweep;
  const studies::PointSource& points;  ///< along the first direction, then the second
  figures::FigureText text;            ///< title and abscissa
};

/// Root mean square and range of the deflection of planet 1's mesh, up and down: the classical response curve.
[[nodiscard]] figures::FigureOutcome write_response_figure(const std::filesystem::path& folder, const std::string& stem,
                                                           const ResponseInput& input, bool sun_planet);

/// Largest force of any mesh over the static one, of both kinds.
[[nodiscard]] figures::FigureOutcome write_largest_force_figure(const std::filesystem::path& folder,
                                                                const std::string& stem, const ResponseInput& input);

/// Is the quasi-static solution known anywhere?
[[nodiscard]] bool has_quasi_static(const studies::PointSource& points);

/// Dynamic factor K_v of both kinds of mesh [S-kv].
[[nodiscard]] figures::FigureOutcome write_kv_figure(const std::filesystem::path& folder, const std::string& stem,
                                                     const ResponseInput& input);

/// Do planets have unequal loads anywhere?
[[nodiscard]] bool loads_differ(const studies::PointSource& points);

/// Share of each planet in the load of both kinds of mesh, by time means or by largest forces.
[[nodiscard]] figures::FigureOutcome write_load_sharing_figure(const std::filesystem::path& folder,
                                                               const std::string& stem, const ResponseInput& input,
                                                               bool largest);

/// Spectra of the sun mesh of planet 1 over the parameter, along one direction.
[[nodiscard]] figures::FigureOutcome write_waterfall_figure(const std::filesystem::path& folder,
                                                            const std::string& stem, const ResponseInput& input,
                                                            std::size_t direction);

}  // namespace epicyclic::reports
