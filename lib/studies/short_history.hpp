// Some mesh periods of a stage from a state that is stored, to be shown and not to be judged.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "integrate/options.hpp"
#include "model/dynamic_model.hpp"

namespace epicyclic::studies {

/// Of the meshes of planet 1.
struct ShortHistory {
  static constexpr std::array<std::string_view, 6> names = {"delta_sp_1",      "delta_rp_1", "delta_sp_1_rate",
                                                            "delta_rp_1_rate", "force_sp_1", "force_rp_1"};
  std::array<std::vector<double>, names.size()> columns;  ///< [b_c, b_c, b_c per tau, b_c per tau, N, N]
};

/// @param state    at the mesh phase 0
/// @param periods  mesh periods
/// @param phases   samples in each, the first at the mesh phase 0; the end is one more
/// @returns nothing if the end is not reached
/// @throws as Flow::evolve()
[[nodiscard]] std::optional<ShortHistory> short_history(const model::DynamicModel& model, std::span<const double> state,
                                                        const integrate::IntegratorOptions& integrator, int periods,
                                                        int phases);

}  // namespace epicyclic::studies
