// Amplitude spectra of uniformly sampled signals.
//
//   X_k = sum_{j<N} w_j x_j exp(-2 pi i j k / N) ,   f_k = k / (N dt)
//   A_k = 2 |X_k| / sum_j w_j   for 0 < k < N/2 ,    half of that at k = 0 and k = N/2                        [A-fft]
//
// so that a sine of amplitude a on a bin shows a, whatever the window. Between bins a window loses some of it
// (rectangular 36 %, Hann 15 %, flat top 0.1 %) and spreads the rest over its main lobe. A response of period n that is
// sampled over exactly n periods of the forcing has all its lines on bins, and needs no window.
//
// Source: F. J. Harris, Proc. IEEE 66 (1978) 51; flat top: ISO 18431-2. Transform: GSL, any length (fastest for
// products of small primes). Smoothness: none needed; kinks show as lines that fall with the square of their order.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace epicyclic::analysis {

enum class Window { rectangular, hann, flat_top };

struct Spectrum {
  double resolution = 0;          ///< f_1, in cycles per unit of dt
  std::vector<double> amplitude;  ///< A_k, k = 0 .. N/2, in the units of the signal
  std::vector<double> phase;      ///< arg X_k [rad], of cos(2 pi f t + phase)

  [[nodiscard]] double frequency(std::size_t k) const { return resolution * static_cast<double>(k); }
};

/// @param dt     from one sample to the next
/// @param first  t of the first sample
/// @throws DomainError for fewer than two samples or dt <= 0
[[nodiscard]] Spectrum amplitude_spectrum(std::span<const double> x, double dt, Window window, double first = 0.0);

/// The root of the mean square of A_k over stretches of the signal that overlap by half (Welch, IEEE Trans. Audio
/// Electroacoust. 15 (1967) 70), the signal's mean subtracted and stored as A_0. Without phases.
/// @param stretch  samples of one; all of them if there are fewer
/// @throws DomainError for fewer than two samples or dt <= 0
[[nodiscard]] Spectrum averaged_spectrum(std::span<const double> x, double dt, std::size_t stretch, Window window);

/// A line of a periodic response: at p / n of the frequency of the forcing.
struct Harmonic {
  int order = 0;   ///< p
  int period = 1;  ///< n
  double amplitude = 0;
  double phase = 0;  ///< [rad]

  /// A harmonic of the forcing itself, and not one between.
  [[nodiscard]] bool of_forcing() const { return order % period == 0; }
  /// "0", "1", "1/2", "3/2", ...: times the frequency of the forcing, in lowest terms.
  [[nodiscard]] std::string label() const;
};

/// Lines of a signal that is sampled uniformly over exactly n periods of the forcing, p = 0 .. N/2, in order.
/// @param first  t of the first sample, in periods of the forcing
/// @throws DomainError for n < 1 or fewer than two samples per period
[[nodiscard]] std::vector<Harmonic> harmonics(std::span<const double> x, int n, double first = 0.0);

/// A local maximum of a spectrum.
struct Peak {
  double frequency = 0;  ///< by the parabola through the logarithms of three neighbours
  double amplitude = 0;  ///< of the bin itself
  int harmonic = 0;      ///< the nearest multiple of the forcing's frequency
  double offset = 0;     ///< frequency - harmonic * f_m: of a sideband
};

/// The `most` largest local maxima above `floor` times the largest amplitude (k = 0 left out), by frequency.
/// @param forcing  f_m
[[nodiscard]] std::vector<Peak> peaks(const Spectrum& spectrum, double forcing, std::size_t most, double floor);

}  // namespace epicyclic::analysis
