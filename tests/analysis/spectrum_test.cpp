// Spectra of signals whose lines are known.

#include "analysis/spectrum.hpp"

#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "core/errors.hpp"

namespace epicyclic::analysis::spectrum_test {
namespace {

constexpr double turn = 2.0 * std::numbers::pi;
constexpr double of_the_sums = 1e-13;  // rounding of a transform over some 1e3 samples of order 1

template <class F>
std::vector<double> sampled(std::size_t count, double dt, const F& f) {
  std::vector<double> x;
  for (std::size_t j = 0; j < count; ++j) x.push_back(f(static_cast<double>(j) * dt));
  return x;
}

class SineOnABin : public ::testing::TestWithParam<Window> {};

TEST_P(SineOnABin, ShowsItsAmplitudePhaseAndMean) {
  for (const std::size_t count : {240UL, 241UL, 1024UL}) {
    constexpr double three_operations = 1e-15;  // rounding of the resolution and its multiple
    const double dt = 0.01;
    const double f = 10.0 / (static_cast<double>(count) * dt);
    const auto x = sampled(count, dt, [&](double t) { return -1.5 + 0.3 * std::cos(turn * f * t + 0.7); });
    const Spectrum s = amplitude_spectrum(x, dt, GetParam());
    EXPECT_NEAR(s.frequency(10), f, three_operations * f);
    EXPECT_NEAR(s.amplitude[10], 0.3, of_the_sums);
    EXPECT_NEAR(s.phase[10], 0.7, of_the_sums);
    EXPECT_NEAR(s.amplitude[0], 1.5, of_the_sums);
    EXPECT_EQ(s.amplitude.size(), count / 2 + 1);
    for (std::size_t k = 20; k < s.amplitude.size(); ++k) EXPECT_LT(s.amplitude[k], of_the_sums) << k;
  }
}

INSTANTIATE_TEST_SUITE_P(Windows, SineOnABin, ::testing::Values(Window::rectangular, Window::hann, Window::flat_top));

TEST(Windows, LoseBetweenBinsWhatTheirSourceSays) {
  constexpr std::size_t count = 1000;
  const auto x = sampled(count, 1.0, [](double t) { return std::cos(turn * 100.5 / 1000.0 * t); });
  const auto largest = [&](Window w) {
    double most = 0.0;
    for (const double a : amplitude_spectrum(x, 1.0, w).amplitude) most = std::max(most, a);
    return most;
  };
  // What the negative frequency's line, 201 bins away, leaks: 1 / (201 pi) through no window, 1 / 201^3 through Hann's.
  constexpr double of_first_order = 2e-3;
  constexpr double of_third_order = 1e-6;
  constexpr double flat = 2e-3;  // measured: 0.0018, 0.0156 dB, of the window itself
  EXPECT_NEAR(largest(Window::rectangular), 2.0 / std::numbers::pi, of_first_order);   // -3.92 dB
  EXPECT_NEAR(largest(Window::hann), 8.0 / (3.0 * std::numbers::pi), of_third_order);  // -1.42 dB
  EXPECT_NEAR(largest(Window::flat_top), 1.0, flat);
}

TEST(Harmonics, OfAPeriodTwoMotionAreLabelled) {
  // Two periods of the forcing (unit frequency), 64 samples each.
  const auto x = sampled(128, 1.0 / 64.0, [](double t) {
    return 0.1 + std::cos(turn * t) + 0.25 * std::sin(turn * 0.5 * t) + 0.01 * std::cos(turn * 3.0 * t);
  });
  const auto lines = harmonics(x, 2);
  ASSERT_EQ(lines.size(), 65U);
  EXPECT_EQ(lines[1].label(), "1/2");
  EXPECT_EQ(lines[2].label(), "1");
  EXPECT_EQ(lines[3].label(), "3/2");
  EXPECT_EQ(lines[0].label(), "0");
  EXPECT_FALSE(lines[1].of_forcing());
  EXPECT_TRUE(lines[6].of_forcing());
  constexpr double rounding = 2e-15;  // of sums over 128 samples
  EXPECT_NEAR(lines[0].amplitude, 0.1, rounding);
  EXPECT_NEAR(lines[1].amplitude, 0.25, rounding);
  EXPECT_NEAR(lines[1].phase, -0.5 * std::numbers::pi, of_the_sums);
  EXPECT_NEAR(lines[2].amplitude, 1.0, rounding);
  EXPECT_NEAR(lines[6].amplitude, 0.01, rounding);
  EXPECT_LT(lines[3].amplitude, rounding);
}

TEST(Harmonics, PhasesAreThoseAtTheForcingsZeroWhereverSamplesBegin) {
  const auto signal = [](double t) { return std::cos(turn * t + 0.3) + 0.25 * std::cos(turn * 10.5 * t - 1.2); };
  for (const std::size_t each : {64UL, 128UL}) {
    const double dt = 1.0 / static_cast<double>(each);
    const auto x = sampled(2 * each, dt, [&](double t) { return signal(t + dt); });
    const auto lines = harmonics(x, 2, dt);
    EXPECT_NEAR(lines[2].phase, 0.3, of_the_sums);
    EXPECT_NEAR(lines[21].phase, -1.2, of_the_sums);
  }
}

TEST(Peaks, OfAModulatedSineAreTheCarrierAndItsSidebands) {
  // Carrier at twice the forcing's 1 Hz, modulated with 0.0832 Hz.
  const double dt = 1.0 / 32.0;
  const auto x =
      sampled(8192, dt, [](double t) { return (1.0 + 0.2 * std::cos(turn * 0.0832 * t)) * std::cos(turn * 2.0 * t); });
  const auto found = peaks(amplitude_spectrum(x, dt, Window::hann), 1.0, 3, 1e-3);
  ASSERT_EQ(found.size(), 3U);
  for (const Peak& p : found) EXPECT_EQ(p.harmonic, 2);
  // Measured: a parabola through the logarithms of three lines tells the place to a twentieth of a line's width. The
  // carrier is on a line, and its sidebands of 0.1 leak into it as 1 / 21^3.
  constexpr double place_hz = 2e-4;
  constexpr double leaked = 1e-4;
  EXPECT_NEAR(found[0].offset, -0.0832, place_hz);
  EXPECT_NEAR(found[1].offset, 0.0, place_hz);
  EXPECT_NEAR(found[2].offset, 0.0832, place_hz);
  EXPECT_NEAR(found[1].amplitude, 1.0, leaked);
}

TEST(Spectrum, SquaresOfAmplitudesAddUpToTheMeanSquare) {
  // Parseval's theorem.
  for (const std::size_t count : {96UL, 97UL}) {
    const auto x = sampled(count, 1.0, [](double t) { return std::sin(1.3 * t * t) + 0.2 * t; });
    const Spectrum s = amplitude_spectrum(x, 1.0, Window::rectangular);
    double lines = 0.0;
    for (std::size_t k = 0; k < s.amplitude.size(); ++k)
      lines += s.amplitude[k] * s.amplitude[k] * (k == 0 || 2 * k == count ? 1.0 : 0.5);
    double mean = 0.0;
    for (const double v : x) mean += v * v / static_cast<double>(count);
    EXPECT_NEAR(lines, mean, of_the_sums * mean);
  }
}

TEST(AveragedSpectrum, OfALineOnABinIsThatLine) {
  // The mean is told apart and leaks nowhere, however large it is.
  const auto x = sampled(512, 1.0 / 16.0, [](double t) { return 40.0 + 0.5 * std::cos(2.0 * std::numbers::pi * t); });
  const Spectrum s = averaged_spectrum(x, 1.0 / 16.0, 128, Window::hann);
  EXPECT_DOUBLE_EQ(s.resolution, 1.0 / 8.0);
  ASSERT_EQ(s.amplitude.size(), 65U);
  EXPECT_NEAR(s.amplitude[0], 40.0, of_the_sums * 40.0);
  EXPECT_NEAR(s.amplitude[8], 0.5, of_the_sums * 40.0);
  EXPECT_NEAR(s.amplitude[7], 0.25, of_the_sums * 40.0) << "Hann's window has half of it beside the line";
  EXPECT_NEAR(s.amplitude[20], 0.0, of_the_sums * 40.0);
}

TEST(AveragedSpectrum, IsTheMeanSquareOfItsStretches) {
  // A line that is there in the first half only: two of three stretches have it, one of them by half the window.
  const auto x = sampled(256, 1.0, [](double t) { return t < 128.0 ? std::cos(0.25 * std::numbers::pi * t) : 0.0; });
  const Spectrum s = averaged_spectrum(x, 1.0, 128, Window::rectangular);
  EXPECT_NEAR(s.amplitude[16], std::sqrt((1.0 + 0.25 + 0.0) / 3.0), 1e-2);  // the mean of x is taken off
  // Shorter than a stretch: all of it.
  const Spectrum whole = averaged_spectrum(x, 1.0, 1000, Window::rectangular);
  EXPECT_DOUBLE_EQ(whole.resolution, 1.0 / 256.0);
  EXPECT_NEAR(whole.amplitude[32], 0.5, 1e-2);
}

TEST(Spectrum, RefusesWhatHasNone) {
  const std::vector<double> one = {1.0};
  const std::vector<double> two = {1.0, 2.0};
  EXPECT_THROW((void)amplitude_spectrum(one, 1.0, Window::hann), DomainError);
  EXPECT_THROW((void)amplitude_spectrum(two, 0.0, Window::hann), DomainError);
  EXPECT_THROW((void)averaged_spectrum(one, 1.0, 8, Window::hann), DomainError);
  EXPECT_THROW((void)averaged_spectrum(two, 0.0, 8, Window::hann), DomainError);
  EXPECT_THROW((void)averaged_spectrum(two, 1.0, 1, Window::hann), DomainError);
  EXPECT_THROW((void)harmonics(two, 0), DomainError);
  EXPECT_THROW((void)harmonics(two, 2), DomainError);
  EXPECT_TRUE(peaks({1.0, {1.0, 2.0}, {0.0, 0.0}}, 1.0, 3, 0.0).empty());
}

}  // namespace
}  // namespace epicyclic::analysis::spectrum_test
