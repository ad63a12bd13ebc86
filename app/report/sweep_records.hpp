// What a report draws of the records of a sweep: Poincaré points of the deflections, spectra, and short histories from
// the stored states. All of it may be too much for a page, so each part has its limit.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "studies/short_history.hpp"
#include "studies/sweep.hpp"

namespace epicyclic::app {

/// Bytes of two for each number, before they are deflated.
struct SweepRecordLimits {
  std::size_t section = std::size_t{6} << 20;
  std::size_t spectra = std::size_t{3} << 20;
  std::size_t histories = std::size_t{3} << 20;
};

struct SweepRecords {
  static constexpr int periods = 4;  ///< mesh periods of a history
  static constexpr int phases = 32;  ///< samples in each
  static constexpr std::size_t history_rows = static_cast<std::size_t>(periods) * phases + 1;

  /// Poincaré points, those of one point of the sweep behind those of another: delta_sp_1, ..., delta_rp_1, ... and
  /// with a model delta_sp_1_rate, delta_rp_1_rate [b_c, b_c per tau].
  std::vector<std::string> names;
  std::vector<std::vector<double>> section;  ///< by name
  std::vector<double> starts{0.0};           ///< of each point, and the end
  std::size_t rows_of_a_point = 0;           ///< most that are kept; all are, if there are no more

  /// log10 of the amplitudes of delta_sp_1 [b_c], `orders` for each point; not a number where there is none.
  std::vector<double> spectra;
  std::size_t orders = 0;
  double resolution = 0;              ///< of the spectra, in mesh frequencies
  std::size_t points_of_spectra = 0;  ///< the first ones

  /// `history_rows` for each point, by ShortHistory::names; not a number where there is none.
  std::array<std::vector<double>, studies::ShortHistory::names.size()> histories;
  std::size_t points_of_histories = 0;  ///< the first ones
  bool any_history = false;

  [[nodiscard]] std::size_t points() const { return starts.size() - 1; }
};

/// Which columns of the section go into a page: if not all do, those of planet 1 first.
/// @returns by name, true of those that do
[[nodiscard]] std::vector<bool> kept_columns(std::span<const std::string> names, std::size_t rows, std::size_t limit);

/// @param points      indices, in the order of the page
/// @param read        a point by its index
/// @param model_at    empty: no rates and no histories, which need the model
/// @param stop_here   called between points; may throw
/// @throws what read() and model_at() throw
[[nodiscard]] SweepRecords sweep_records(std::span<const std::size_t> points,
                                         const std::function<studies::PointResult(std::size_t)>& read,
                                         const std::function<model::DynamicModel(std::size_t)>& model_at,
                                         const integrate::IntegratorOptions& integrator,
                                         const std::function<void()>& stop_here, const SweepRecordLimits& limits = {});

}  // namespace epicyclic::app
