#include "sweep_records.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/errors.hpp"
#include "studies/known_attractors.hpp"

namespace epicyclic::app {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t width = 2;  // bytes of a number

class Reader {
 public:
  Reader(std::size_t points, const integrate::IntegratorOptions& integrator, const SweepRecordLimits& limits)
      : integrator_(integrator), limits_(limits) {
    constexpr std::size_t columns = 2;  // a mesh of the sun and one of the ring, at least
    records_.rows_of_a_point =
        std::max<std::size_t>(1, limits.section / (columns * width) / std::max<std::size_t>(1, points));
  }

  /// @param model  may be empty
  void add(const studies::PointResult& r, const std::optional<model::DynamicModel>& model) {
    const std::size_t deflections = (r.meshes.is_pair() ? 1 : 2) * r.meshes.sun_planet.size();
    const bool has_section = r.poincare_rows() > 0 && r.poincare_columns > deflections && deflections > 0;
    if (has_section) add_section(r, model, deflections);
    records_.starts.push_back(records_.section.empty() ? 0.0 : static_cast<double>(records_.section.front().size()));
    add_spectrum(r);
    add_history(r, has_section ? model : std::nullopt, r.poincare_columns - deflections);
  }

  SweepRecords records() { return std::move(records_); }

 private:
  void add_section(const studies::PointResult& r, const std::optional<model::DynamicModel>& model,
                   std::size_t deflections) {
    if (records_.names.empty()) {
      const bool pair = r.meshes.is_pair();
      const std::size_t planets = pair ? deflections : deflections / 2;
      for (std::size_t i = 1; i <= planets; ++i) records_.names.push_back("delta_sp_" + std::to_string(i));
      for (std::size_t i = 1; i <= planets && !pair; ++i) records_.names.push_back("delta_rp_" + std::to_string(i));
      if (model) records_.names.emplace_back("delta_sp_1_rate");
      if (model && !pair) records_.names.emplace_back("delta_rp_1_rate");
      records_.section.resize(records_.names.size());
    }
    const std::size_t dimension = r.poincare_columns - deflections;
    model::MeshDeflections d;
    for (std::size_t k = 0; k < std::min(r.poincare_rows(), records_.rows_of_a_point); ++k) {
      const double* row = r.poincare.data() + k * r.poincare_columns;
      for (std::size_t j = 0; j < deflections; ++j) records_.section[j].push_back(row[dimension + j]);
      if (!model) continue;
      model->deflections(0.0, row, d);
      records_.section[deflections].push_back(d.sun_planet_rate.front());
      if (!r.meshes.is_pair()) records_.section[deflections + 1].push_back(d.ring_planet_rate.front());
    }
  }

  void add_spectrum(const studies::PointResult& r) {
    if (records_.orders == 0 && !r.spectrum.empty()) {
      records_.orders = r.spectrum.size();
      records_.resolution = r.spectrum_resolution;
      records_.points_of_spectra = records_.points() - 1;
      records_.spectra.assign(records_.orders * records_.points_of_spectra, nan);
    }
    if (width * (records_.spectra.size() + records_.orders) > limits_.spectra || records_.orders == 0) return;
    for (std::size_t k = 0; k < records_.orders; ++k)
      records_.spectra.push_back(k < r.spectrum.size() && r.spectrum[k] > 0.0 ? std::log10(r.spectrum[k]) : nan);
    ++records_.points_of_spectra;
  }

  void add_history(const studies::PointResult& r, const std::optional<model::DynamicModel>& model,
                   std::size_t dimension) {
    const std::size_t rows = SweepRecords::history_rows * (records_.points_of_histories + 1);
    if (width * rows * records_.histories.size() > limits_.histories) return;
    std::optional<studies::ShortHistory> history;
    if (model && r.outcome == integrate::Outcome::reached)
      if (const std::vector<double> state = studies::state_on(r, dimension); !state.empty()) try {
          history = studies::short_history(*model, state, integrator_, SweepRecords::periods, SweepRecords::phases);
        } catch (const SolverError&) {
          history.reset();  // a page without it says enough
        }
    for (std::size_t k = 0; k < records_.histories.size(); ++k) {
      auto& column = records_.histories[k];
      if (history) column.insert(column.end(), history->columns[k].begin(), history->columns[k].end());
      column.resize(rows, nan);
    }
    records_.any_history = records_.any_history || history.has_value();
    ++records_.points_of_histories;
  }

  SweepRecords records_;
  const integrate::IntegratorOptions& integrator_;
  const SweepRecordLimits& limits_;
};

/// What says most of a point comes first: planet 1, then its rates, then the others.
int rank_of(const std::string& name) {
  if (name == "delta_sp_1") return 0;
  if (name == "delta_rp_1") return 1;
  if (name.ends_with("_1_rate")) return 2;
  return name.starts_with("delta_") ? 3 : 4;
}

}  // namespace

std::vector<bool> kept_columns(std::span<const std::string> names, std::size_t rows, std::size_t limit) {
  std::vector<std::size_t> order(names.size());
  for (std::size_t k = 0; k < order.size(); ++k) order[k] = k;
  std::ranges::stable_sort(order, {}, [&](std::size_t k) { return rank_of(names[k]); });
  std::vector<bool> kept(names.size(), false);
  const std::size_t count = rows == 0 ? order.size() : limit / (width * rows);
  for (std::size_t k = 0; k < std::min(count, order.size()); ++k) kept[order[k]] = true;
  return kept;
}

SweepRecords sweep_records(std::span<const std::size_t> points,
                           const std::function<studies::PointResult(std::size_t)>& read,
                           const std::function<model::DynamicModel(std::size_t)>& model_at,
                           const integrate::IntegratorOptions& integrator, const std::function<void()>& stop_here,
                           const SweepRecordLimits& limits) {
  Reader reader(points.size(), integrator, limits);
  for (const std::size_t point : points) {
    stop_here();
    std::optional<model::DynamicModel> model;
    if (model_at) model = model_at(point);
    reader.add(read(point), model);
  }
  return reader.records();
}

}  // namespace epicyclic::app
