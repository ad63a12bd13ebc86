#include "analysis/spectrum.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <new>
#include <numbers>
#include <numeric>

#include <gsl/gsl_fft_real.h>

#include "core/errors.hpp"

namespace epicyclic::analysis {

namespace {

struct WavetableDeleter {
  void operator()(gsl_fft_real_wavetable* w) const { gsl_fft_real_wavetable_free(w); }
};
struct WorkspaceDeleter {
  void operator()(gsl_fft_real_workspace* w) const { gsl_fft_real_workspace_free(w); }
};

/// Periodic in N, not symmetric: bins of the transform are then zeros of the window's side lobes.
double window_at(Window window, std::size_t j, std::size_t n) {
  const double angle = 2.0 * std::numbers::pi * static_cast<double>(j) / static_cast<double>(n);
  switch (window) {
    case Window::rectangular:
      return 1.0;
    case Window::hann:
      return 0.5 - 0.5 * std::cos(angle);
    case Window::flat_top:
      return 1.0 - 1.93 * std::cos(angle) + 1.29 * std::cos(2.0 * angle) - 0.388 * std::cos(3.0 * angle) +
             0.028 * std::cos(4.0 * angle);
  }
  return 1.0;
}

/// A window and the transform behind it, for signals of one length.
class Transform {
 public:
  Transform(std::size_t n, double dt, Window window) : resolution_(1.0 / (dt * static_cast<double>(n))) {
    if (n < 2) throw DomainError("a spectrum of " + std::to_string(n) + " samples is requested, at least 2 are needed");
    if (!(dt > 0.0)) throw DomainError("the sampling interval " + std::to_string(dt) + " must be > 0");
    for (std::size_t j = 0; j < n; ++j) window_.push_back(window_at(window, j, n));
    for (const double w : window_) weight_ += w;
    table_.reset(gsl_fft_real_wavetable_alloc(n));
    work_.reset(gsl_fft_real_workspace_alloc(n));
    if (!table_ || !work_) throw std::bad_alloc();
  }

  /// @param of  (k, Re X_k, Im X_k, what makes A_k of |X_k|): called for k = 0 .. n/2
  template <class F>
  void each(std::span<const double> x, const F& of) {
    const std::size_t n = window_.size();
    data_.resize(n);
    for (std::size_t j = 0; j < n; ++j) data_[j] = x[j] * window_[j];
    const int flag = gsl_fft_real_transform(data_.data(), 1, n, table_.get(), work_.get());
    if (flag != 0) throw SolverError("gsl_fft_real_transform", flag, 0.0, "the transform failed");
    for (std::size_t k = 0; k <= n / 2; ++k) {
      // GSL's half-complex order: Re 0, Re 1, Im 1, Re 2, Im 2, ..., and the last one real if n is even.
      const double re = k == 0 ? data_[0] : data_[2 * k - 1];
      const double im = k == 0 || 2 * k == n ? 0.0 : data_[2 * k];
      of(k, re, im, (k == 0 || 2 * k == n ? 1.0 : 2.0) / weight_);
    }
  }

  [[nodiscard]] double resolution() const { return resolution_; }

 private:
  double resolution_;
  std::vector<double> window_, data_;
  double weight_ = 0.0;
  std::unique_ptr<gsl_fft_real_wavetable, WavetableDeleter> table_;
  std::unique_ptr<gsl_fft_real_workspace, WorkspaceDeleter> work_;
};

}  // namespace

Spectrum amplitude_spectrum(std::span<const double> x, double dt, Window window, double first) {
  Transform transform(x.size(), dt, window);
  Spectrum s;
  s.resolution = transform.resolution();
  transform.each(x, [&s, first](std::size_t k, double re, double im, double scale) {
    s.amplitude.push_back(scale * std::hypot(re, im));
    constexpr double two_pi = 2.0 * std::numbers::pi;
    s.phase.push_back(std::remainder(std::atan2(im, re) - two_pi * s.frequency(k) * first, two_pi));
  });
  return s;
}

Spectrum averaged_spectrum(std::span<const double> x, double dt, std::size_t stretch, Window window) {
  const std::size_t n = std::min(stretch, x.size());
  Transform transform(n, dt, window);
  const double mean = std::accumulate(x.begin(), x.end(), 0.0) / static_cast<double>(x.size());
  std::vector<double> alternating(x.begin(), x.end());
  for (double& value : alternating) value -= mean;
  Spectrum s;
  s.resolution = transform.resolution();
  s.amplitude.assign(n / 2 + 1, 0.0);
  double count = 0.0;
  for (std::size_t first = 0; first + n <= x.size(); first += std::max<std::size_t>(1, n / 2)) {
    transform.each(std::span(alternating).subspan(first, n), [&s](std::size_t k, double re, double im, double scale) {
      s.amplitude[k] += scale * scale * (re * re + im * im);
    });
    count += 1.0;
  }
  for (double& a : s.amplitude) a = std::sqrt(a / count);
  s.amplitude[0] = std::abs(mean);
  return s;
}

std::string Harmonic::label() const {
  const int common = std::gcd(order, period);
  const int p = order / common;
  const int q = period / common;
  return q == 1 ? std::to_string(p) : std::to_string(p) + "/" + std::to_string(q);
}

std::vector<Harmonic> harmonics(std::span<const double> x, int n, double first) {
  if (n < 1) throw DomainError("harmonics of period " + std::to_string(n) + " are requested, must be >= 1");
  if (x.size() < 2 * static_cast<std::size_t>(n))
    throw DomainError(std::to_string(x.size()) + " samples are less than two per period");
  const double dt = static_cast<double>(n) / static_cast<double>(x.size());
  const Spectrum s = amplitude_spectrum(x, dt, Window::rectangular, first);
  std::vector<Harmonic> lines;
  for (std::size_t k = 0; k < s.amplitude.size(); ++k)
    lines.push_back({static_cast<int>(k), n, s.amplitude[k], s.phase[k]});
  return lines;
}

std::vector<Peak> peaks(const Spectrum& spectrum, double forcing, std::size_t most, double floor) {
  const std::vector<double>& a = spectrum.amplitude;
  if (a.size() < 3) return {};
  const double least = floor * *std::max_element(a.begin() + 1, a.end());
  std::vector<Peak> found;
  for (std::size_t k = 1; k + 1 < a.size(); ++k) {
    if (!(a[k] > a[k - 1] && a[k] >= a[k + 1] && a[k] > least)) continue;
    double shift = 0.0;
    if (k > 1 && a[k - 1] > 0.0 && a[k + 1] > 0.0) {
      const double before = std::log(a[k - 1]);
      const double at = std::log(a[k]);
      const double after = std::log(a[k + 1]);
      shift = 0.5 * (before - after) / (before - 2.0 * at + after);
    }
    Peak p;
    p.frequency = spectrum.resolution * (static_cast<double>(k) + shift);
    p.amplitude = a[k];
    p.harmonic = static_cast<int>(std::lround(p.frequency / forcing));
    p.offset = p.frequency - p.harmonic * forcing;
    found.push_back(p);
  }
  std::stable_sort(found.begin(), found.end(), [](const Peak& p, const Peak& q) { return p.amplitude > q.amplitude; });
  if (found.size() > most) found.resize(most);
  std::sort(found.begin(), found.end(), [](const Peak& p, const Peak& q) { return p.frequency < q.frequency; });
  return found;
}

}  // namespace epicyclic::analysis
