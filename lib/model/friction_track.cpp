#include "model/friction_track.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

#include <gsl/gsl_interp.h>

#include "core/errors.hpp"

namespace epicyclic::model {

namespace {

using Row = std::array<double, 4>;  // phase, A, B_1/r_b1, B_2/r_b2

// Slopes of Steffen's interpolant at the rows, or of the straight line through two.
std::vector<double> slopes(const std::vector<double>& x, const std::vector<double>& y) {
  if (x.size() == 2) return std::vector<double>(2, (y[1] - y[0]) / (x[1] - x[0]));
  // GSL aborts the program on rows that do not rise, so they are looked at first.
  for (std::size_t k = 1; k < x.size(); ++k)
    if (!(x[k] > x[k - 1])) throw InputError("friction: phases of neighbouring rows cannot be told apart");
  const std::unique_ptr<gsl_interp, decltype(&gsl_interp_free)> interpolant(
      gsl_interp_alloc(gsl_interp_steffen, x.size()), &gsl_interp_free);
  gsl_interp_init(interpolant.get(), x.data(), y.data(), x.size());
  std::vector<double> result(x.size());
  for (std::size_t k = 0; k < x.size(); ++k)
    gsl_interp_eval_deriv_e(interpolant.get(), x.data(), y.data(), x[k], nullptr, &result[k]);
  return result;
}

double wrapped(double phase) { return phase - std::floor(phase); }

}  // namespace

FrictionTrack::FrictionTrack(const gear::Friction::Table& table, double lead, double driving_radius_mm,
                             double driven_radius_mm) {
  std::vector<Row> rows;
  for (std::size_t k = 0; k < table.phase.size(); ++k)
    rows.push_back({table.phase[k] + lead, table.force_ratio[k], table.moment_driving_mm[k] / driving_radius_mm,
                    table.moment_driven_mm[k] / driven_radius_mm});

  const auto shifted = [](Row r, double turns) {
    r[0] += turns;
    return r;
  };

  if (table.breakpoints.empty()) {
    // One smooth periodic curve: rows of the neighbouring periods give the slopes at the seam.
    constexpr std::size_t neighbours = 2;
    std::vector<Row> extended;
    const std::size_t n = rows.size();
    for (std::size_t k = 0; k < n + 1 + 2 * neighbours; ++k) {
      const std::size_t at = k + n * (neighbours + 1) - neighbours;
      extended.push_back(shifted(rows[at % n], static_cast<double>(at / n) - static_cast<double>(neighbours + 1)));
    }
    append_piece(extended);
    starts_.erase(starts_.begin(), starts_.begin() + neighbours);
    cubics_.erase(cubics_.begin(), cubics_.begin() + neighbours);
    starts_.resize(n);
    cubics_.resize(n);
    pieces_ = {{0, n - 1}};
    return;
  }

  const std::size_t breaks = table.breakpoints.size();
  for (std::size_t b = 0; b < breaks; ++b) {
    const double from = table.breakpoints[b] + lead;
    const bool wraps = b + 1 == breaks;
    const double to = wraps ? (table.breakpoints[0] + lead) + 1.0 : table.breakpoints[b + 1] + lead;
    std::vector<Row> piece;
    for (int turn = 0; turn < 2; ++turn)
      for (std::size_t k = 0; k < rows.size(); ++k) {
        const Row r = shifted(rows[k], turn);
        const bool twin_before = k > 0 && rows[k - 1][0] == rows[k][0];
        const bool twin_after = k + 1 < rows.size() && rows[k + 1][0] == rows[k][0];
        const bool starts_here = r[0] == from && !twin_after;
        const bool ends_here = r[0] == to && !twin_before;
        if (starts_here || ends_here || (r[0] > from && r[0] < to)) piece.push_back(r);
      }
    append_piece(piece);
    breakpoints_.push_back(wrapped(from));
  }
  std::sort(breakpoints_.begin(), breakpoints_.end());
}

void FrictionTrack::append_piece(const std::vector<Row>& rows) {
  if (rows.size() < 2) throw InputError("friction: a piece between two breakpoints needs a row at each of its ends");
  const std::size_t first = starts_.size();
  std::vector<double> x;
  for (const Row& r : rows) x.push_back(r[0]);
  for (std::size_t k = 0; k + 1 < rows.size(); ++k) {
    starts_.push_back(x[k]);
    cubics_.emplace_back();
  }
  for (std::size_t j = 0; j < 3; ++j) {
    std::vector<double> y;
    for (const Row& r : rows) y.push_back(r[j + 1]);
    const std::vector<double> slope = slopes(x, y);
    for (std::size_t k = 0; k + 1 < rows.size(); ++k) {
      const double h = x[k + 1] - x[k];
      const double secant = (y[k + 1] - y[k]) / h;
      cubics_[first + k][j] = {y[k], slope[k], (3.0 * secant - 2.0 * slope[k] - slope[k + 1]) / h,
                               (slope[k] + slope[k + 1] - 2.0 * secant) / (h * h)};
    }
  }
  pieces_.push_back({first, starts_.size() - 1});
}

FrictionTrack::Place FrictionTrack::place(double phase) const {
  const double origin = starts_.front();
  // One smooth curve has no sides: its centre is that of its period.
  if (breakpoints_.empty()) return {pieces_.front(), origin + 0.5};
  const double x = phase - std::floor(phase - origin);
  std::size_t k = 0;
  while (k + 1 < pieces_.size() && x >= starts_[pieces_[k + 1].lo]) ++k;
  return {pieces_[k], x};
}

}  // namespace epicyclic::model
