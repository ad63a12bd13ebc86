// Duffing's oscillator by harmonic balance, its folds and the cusps where they meet.
#pragma once

#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <gtest/gtest.h>

#include "core/dense.hpp"
#include "integrate/flow.hpp"

namespace epicyclic::problems {

/// Duffing's periodic motion x'' + d x' + x + x^3 = g cos Wt by harmonic balance: no integration, so nothing shared
/// with what it is beside. Odd harmonics 1, 3, ... alone: x(t + T/2) = -x(t).
class HarmonicBalance {
 public:
  HarmonicBalance(double d, double g) : d_(d), g_(g) {}

  /// The frequency at which the branch folds, from values near it.
  /// @param z  sines and cosines, then W: the branch's own; and the null vector behind it, of length 1
  double fold(const Eigen::VectorXd& z) const {
    return newton(z, [&](const Eigen::VectorXd& at) { return extended(at); })(2 * harmonics);
  }

  /// Frequency and force at which two folds meet, from a fold near it: there is u with F_c u + F_cc v v = 0 then.
  std::pair<double, double> cusp(const Eigen::VectorXd& z) const {
    const Eigen::Index n = 2 * harmonics;
    Eigen::VectorXd all = Eigen::VectorXd::Zero(3 * n + 2);
    all << z, g_, Eigen::VectorXd::Zero(n);
    all = newton(all, [&](const Eigen::VectorXd& at) { return cusp_equations(at); });
    return {all(n), all(2 * n + 1)};
  }

  /// Sines and cosines of a motion given over one period, with W and the direction of the branch there.
  static Eigen::VectorXd start(const std::vector<double>& x, double w, const std::vector<double>& along) {
    const Eigen::Index n = 2 * harmonics;
    Eigen::VectorXd z(2 * n + 1);
    z.head(n) = transform(x);
    z(n) = w;
    z.tail(n) = transform(along).normalized();
    return z;
  }
  static constexpr int samples = 256;

 private:
  static constexpr int harmonics = 16;  // up to 31: what is left out is below 1e-12

  /// cos 2 pi k / samples.
  static double cosine(int k) {
    static const std::vector<double> all = [] {
      std::vector<double> c;
      for (int j = 0; j < samples; ++j) c.push_back(std::cos(2.0 * std::numbers::pi * j / samples));
      return c;
    }();
    return all[static_cast<std::size_t>(k % samples)];
  }
  static double sine(int k) { return cosine(k + 3 * samples / 4); }

  static Eigen::VectorXd transform(const std::vector<double>& x) {
    Eigen::VectorXd c = Eigen::VectorXd::Zero(2 * harmonics);
    for (int j = 0; j < samples; ++j) {
      for (int k = 0; k < harmonics; ++k) {
        c(2 * k) += 2.0 / samples * x[static_cast<std::size_t>(j)] * cosine((2 * k + 1) * j);
        c(2 * k + 1) += 2.0 / samples * x[static_cast<std::size_t>(j)] * sine((2 * k + 1) * j);
      }
    }
    return c;
  }

  static std::vector<double> motion(const Eigen::VectorXd& c) {
    std::vector<double> x(samples);
    for (int j = 0; j < samples; ++j)
      for (int k = 0; k < harmonics; ++k)
        x[static_cast<std::size_t>(j)] += c(2 * k) * cosine((2 * k + 1) * j) + c(2 * k + 1) * sine((2 * k + 1) * j);
    return x;
  }

  /// Balance of the harmonics, and its derivative along v.
  std::pair<Eigen::VectorXd, Eigen::VectorXd> balance(const Eigen::VectorXd& c, double w, double g,
                                                      const Eigen::VectorXd& v) const {
    const std::vector<double> x = motion(c), dx = motion(v);
    std::vector<double> cube(samples), slope(samples);
    for (std::size_t j = 0; j < cube.size(); ++j) {
      cube[j] = x[j] * x[j] * x[j];
      slope[j] = 3.0 * x[j] * x[j] * dx[j];
    }
    Eigen::VectorXd r = transform(cube), dr = transform(slope);
    const auto linear = [&](const Eigen::VectorXd& a, Eigen::VectorXd& out) {
      for (int k = 0; k < harmonics; ++k) {
        const double f = (2 * k + 1) * w;
        out(2 * k) += (1.0 - f * f) * a(2 * k) + d_ * f * a(2 * k + 1);
        out(2 * k + 1) += (1.0 - f * f) * a(2 * k + 1) - d_ * f * a(2 * k);
      }
    };
    linear(c, r);
    linear(v, dr);
    r(0) -= g;
    return {r, dr};
  }

  /// The balance, its singularity, and the length of the null vector.
  Eigen::VectorXd extended(const Eigen::VectorXd& z) const {
    const Eigen::Index n = 2 * harmonics;
    const auto [r, dr] = balance(z.head(n), z(n), g_, z.tail(n));
    Eigen::VectorXd all(2 * n + 1);
    all << r, dr, z.tail(n).squaredNorm() - 1.0;
    return all;
  }

  /// At c, W, v, g, u.
  Eigen::VectorXd cusp_equations(const Eigen::VectorXd& z) const {
    const Eigen::Index n = 2 * harmonics;
    const Eigen::VectorXd c = z.head(n), v = z.segment(n + 1, n), u = z.tail(n);
    const auto [r, along_v] = balance(c, z(n), z(2 * n + 1), v);
    const Eigen::VectorXd along_u = balance(c, z(n), z(2 * n + 1), u).second;
    const std::vector<double> x = motion(c), y = motion(v);
    std::vector<double> bend(samples);
    for (std::size_t j = 0; j < bend.size(); ++j) bend[j] = 6.0 * x[j] * y[j] * y[j];
    Eigen::VectorXd all(3 * n + 2);
    all << r, along_v, along_u + transform(bend), v.squaredNorm() - 1.0, v.dot(u);
    return all;
  }

  template <class F>
  static Eigen::VectorXd newton(Eigen::VectorXd z, const F& f) {
    for (int k = 0; k < 30; ++k) {
      Eigen::MatrixXd j(z.size(), z.size());
      for (Eigen::Index i = 0; i < z.size(); ++i) {
        constexpr double h = 1e-6;
        Eigen::VectorXd above = z, below = z;
        above(i) += h;
        below(i) -= h;
        j.col(i) = (f(above) - f(below)) / (2.0 * h);
      }
      const Eigen::VectorXd step = solution(j, -f(z));
      z += step;
      if (step.lpNorm<Eigen::Infinity>() < 1e-13) break;
    }
    return z;
  }

  double d_, g_;
};

/// x over one period from a state.
inline std::vector<double> over_a_period(integrate::Flow& flow, Eigen::VectorXd y) {
  std::vector<double> x;
  for (int j = 0; j < HarmonicBalance::samples; ++j) {
    x.push_back(y(0));
    const double step = flow.field().period / HarmonicBalance::samples;
    EXPECT_TRUE(flow.evolve({y.data(), 2}, j * step, (j + 1) * step).reached());
  }
  return x;
}

}  // namespace epicyclic::problems
