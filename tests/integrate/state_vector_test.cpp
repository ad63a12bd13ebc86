// The project's N_Vector against the definitions of the SUNDIALS user guide, operation by operation: the checks that
// SUNDIALS makes of its own vectors, written anew, for every instruction set that this machine runs and for lengths
// around the padding.
#include "integrate/sundials/state_vector.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <ostream>
#include <random>
#include <string>
#include <type_traits>
#include <vector>

#include <gtest/gtest.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>

namespace epicyclic::integrate::state_vector_test {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

struct ContextDeleter {
  void operator()(SUNContext c) const { SUNContext_Free(&c); }
};

struct Case {
  const char* kernels;
  std::size_t length;
};

std::ostream& operator<<(std::ostream& out, const Case& c) { return out << c.kernels << " " << c.length; }

class StateVector : public ::testing::TestWithParam<Case> {
 protected:
  void SetUp() override {
    kernels = vector_kernels(GetParam().kernels);
    SUNContext raw = nullptr;
    ASSERT_EQ(SUNContext_Create(nullptr, &raw), 0);
    context.reset(raw);
  }

  [[nodiscard]] Vector zeros() const { return make_state_vector(GetParam().length, context.get(), *kernels); }
  [[nodiscard]] Vector filled(const std::vector<double>& values) const {
    Vector v = zeros();
    std::copy(values.begin(), values.end(), data_of(v.get()));
    return v;
  }
  [[nodiscard]] std::vector<double> random(unsigned seed) const {
    std::mt19937 engine(seed);
    std::uniform_real_distribution<double> draw(-2.0, 2.0);
    std::vector<double> values(GetParam().length);
    for (double& x : values) x = draw(engine);
    return values;
  }
  [[nodiscard]] std::vector<double> values(const Vector& v) const {
    return {data_of(v.get()), data_of(v.get()) + GetParam().length};
  }
  /// No operation may leave anything but zeros behind the numbers.
  static void expect_clean_padding(const Vector& v, std::size_t length) {
    for (std::size_t i = length; i < padded_size(v.get()); ++i) EXPECT_EQ(data_of(v.get())[i], 0.0) << i;
  }
  void expect(const Vector& v, const std::vector<double>& expected) const {
    const auto found = values(v);
    for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_EQ(found[i], expected[i]) << i;
    expect_clean_padding(v, expected.size());
  }
  [[nodiscard]] std::size_t n() const { return GetParam().length; }

  const VectorKernels* kernels = nullptr;
  std::unique_ptr<std::remove_pointer_t<SUNContext>, ContextDeleter> context;
};

template <class F>
std::vector<double> each(const std::vector<double>& x, const std::vector<double>& y, F f) {
  std::vector<double> z(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) z[i] = f(x[i], y[i]);
  return z;
}

TEST_P(StateVector, IsAlignedPaddedAndZero) {
  const Vector v = zeros();
  EXPECT_EQ(reinterpret_cast<std::uintptr_t>(data_of(v.get())) % 64, 0U);
  EXPECT_EQ(padded_size(v.get()) % vector_block, 0U);
  EXPECT_LT(padded_size(v.get()) - n(), vector_block);
  expect(v, std::vector<double>(n(), 0.0));
  EXPECT_EQ(N_VGetLength(v.get()), static_cast<sunindextype>(n()));
  EXPECT_EQ(N_VGetVectorID(v.get()), SUNDIALS_NVEC_CUSTOM);
  EXPECT_EQ(N_VGetArrayPointer(v.get()), data_of(v.get()));
}

TEST_P(StateVector, ClonesHaveMemoryOfTheirOwn) {
  const Vector v = filled(random(1));
  const Vector copy(N_VClone(v.get()));
  ASSERT_TRUE(copy);
  EXPECT_NE(data_of(copy.get()), data_of(v.get()));
  N_VConst(3.0, copy.get());
  expect(copy, std::vector<double>(n(), 3.0));
  expect(v, random(1));
  const Vector empty(N_VCloneEmpty(v.get()));
  ASSERT_TRUE(empty);
  EXPECT_EQ(N_VGetLength(empty.get()), N_VGetLength(v.get()));
}

TEST_P(StateVector, LinearSumInEveryCaseOfItsFactorsAndOperands) {
  for (const double a : {1.0, -1.0, 0.5, 2.0, 0.0})
    for (const double b : {1.0, -1.0, 0.5, -2.0, 0.0}) {
      const auto x = random(1);
      const auto y = random(2);
      const auto expected = each(x, y, [&](double p, double q) { return a * p + b * q; });
      const Vector vx = filled(x);
      const Vector vy = filled(y);
      const Vector z = zeros();
      N_VLinearSum(a, vx.get(), b, vy.get(), z.get());
      expect(z, expected);
      N_VLinearSum(a, vx.get(), b, vy.get(), vy.get());  // z = y
      expect(vy, expected);
      const Vector again = filled(y);
      N_VLinearSum(a, vx.get(), b, again.get(), vx.get());  // z = x
      expect(vx, expected);
    }
}

TEST_P(StateVector, ElementWiseOperations) {
  const auto x = random(3);
  const auto y = random(4);
  const Vector vx = filled(x);
  const Vector vy = filled(y);
  const Vector z = zeros();
  N_VProd(vx.get(), vy.get(), z.get());
  expect(z, each(x, y, [](double p, double q) { return p * q; }));
  N_VDiv(vx.get(), vy.get(), z.get());
  expect(z, each(x, y, [](double p, double q) { return p / q; }));
  N_VAbs(vx.get(), z.get());
  expect(z, each(x, y, [](double p, double) { return std::abs(p); }));
  N_VInv(vx.get(), z.get());
  expect(z, each(x, y, [](double p, double) { return 1.0 / p; }));
  N_VAddConst(vx.get(), -0.75, z.get());
  expect(z, each(x, y, [](double p, double) { return p - 0.75; }));
  N_VConst(-1.5, z.get());
  expect(z, std::vector<double>(n(), -1.5));
  for (const double c : {1.0, -1.0, 0.5}) {
    N_VScale(c, vx.get(), z.get());
    expect(z, each(x, y, [&](double p, double) { return c * p; }));
    const Vector self = filled(x);
    N_VScale(c, self.get(), self.get());
    expect(self, each(x, y, [&](double p, double) { return c * p; }));
  }
  N_VCompare(1.0, vx.get(), z.get());
  expect(z, each(x, y, [](double p, double) { return std::abs(p) >= 1.0 ? 1.0 : 0.0; }));
}

TEST_P(StateVector, Reductions) {
  const auto x = random(5);
  auto w = random(6);
  for (double& value : w) value = std::abs(value) + 0.1;
  const Vector vx = filled(x);
  const Vector vw = filled(w);
  long double dot = 0.0L;
  long double square = 0.0L;
  long double masked = 0.0L;
  long double l1 = 0.0L;
  double largest = 0.0;
  double least = x[0];
  std::vector<double> mask(n());
  for (std::size_t i = 0; i < n(); ++i) {
    mask[i] = i % 3 == 1 ? 0.0 : 1.0;
    dot += static_cast<long double>(x[i]) * w[i];
    square += static_cast<long double>(x[i]) * w[i] * x[i] * w[i];
    if (mask[i] > 0.0) masked += static_cast<long double>(x[i]) * w[i] * x[i] * w[i];
    l1 += std::abs(x[i]);
    largest = std::max(largest, std::abs(x[i]));
    least = std::min(least, x[i]);
  }
  const Vector vm = filled(mask);
  const auto count = static_cast<long double>(n());
  const double rounding = 4.0 * epsilon * static_cast<double>(n());
  const auto near = [&](double value, long double expected) {
    EXPECT_NEAR(value, static_cast<double>(expected), rounding * (1.0 + static_cast<double>(l1 + square)));
  };
  near(N_VDotProd(vx.get(), vw.get()), dot);
  near(N_VWrmsNorm(vx.get(), vw.get()), std::sqrt(square / count));
  near(N_VWrmsNormMask(vx.get(), vw.get(), vm.get()), std::sqrt(masked / count));
  near(N_VWL2Norm(vx.get(), vw.get()), std::sqrt(square));
  near(N_VL1Norm(vx.get()), l1);
  EXPECT_EQ(N_VMaxNorm(vx.get()), largest);
  EXPECT_EQ(N_VMin(vx.get()), least);
}

TEST_P(StateVector, InverseTestAndConstraintsAndQuotients) {
  auto x = random(7);
  const Vector good = filled(x);
  const Vector z = zeros();
  EXPECT_TRUE(N_VInvTest(good.get(), z.get()));
  expect(z, each(x, x, [](double p, double) { return 1.0 / p; }));
  x[n() / 2] = 0.0;
  const Vector bad = filled(x);
  EXPECT_FALSE(N_VInvTest(bad.get(), z.get()));

  std::vector<double> kinds(n());
  std::vector<double> values(n());
  for (std::size_t i = 0; i < n(); ++i) {
    kinds[i] = static_cast<double>(i % 5) - 2.0;  // -2 -1 0 1 2: < 0, <= 0, free, >= 0, > 0
    values[i] = kinds[i];
  }
  const Vector c = filled(kinds);
  const Vector v = filled(values);
  EXPECT_TRUE(N_VConstrMask(c.get(), v.get(), z.get()));
  expect(z, std::vector<double>(n(), 0.0));
  for (double& value : values) value = -value;
  const Vector wrong = filled(values);
  const bool any_bound = n() > 1 || kinds[0] != 0.0;
  EXPECT_EQ(N_VConstrMask(c.get(), wrong.get(), z.get()), any_bound ? SUNFALSE : SUNTRUE);
  expect(z, each(kinds, kinds, [](double k, double) { return k == 0.0 ? 0.0 : 1.0; }));

  std::vector<double> numerator(n(), 2.0);
  std::vector<double> denominator(n(), 4.0);
  denominator[0] = 0.0;
  if (n() > 1) numerator[n() - 1] = 1.0;
  const double expected = n() > 1 ? 0.25 : std::numeric_limits<double>::max();
  EXPECT_EQ(N_VMinQuotient(filled(numerator).get(), filled(denominator).get()), expected);
}

TEST_P(StateVector, FusedOperationsAreTheirPartsInOrder) {
  constexpr int most = 7;
  std::vector<Vector> x;
  std::vector<N_Vector> raw;
  std::vector<std::vector<double>> numbers;
  std::vector<double> c;
  for (int j = 0; j < most; ++j) {
    numbers.push_back(random(10U + static_cast<unsigned>(j)));
    x.push_back(filled(numbers.back()));
    raw.push_back(x.back().get());
    c.push_back(0.3 * j - 0.7);
  }
  for (int count = 1; count <= most; ++count) {
    std::vector<double> expected(n(), 0.0);
    for (std::size_t i = 0; i < n(); ++i) {
      double sum = c[0] * numbers[0][i];
      for (int j = 1; j < count; ++j) sum += c[static_cast<std::size_t>(j)] * numbers[static_cast<std::size_t>(j)][i];
      expected[i] = sum;
    }
    const Vector z = zeros();
    ASSERT_EQ(N_VLinearCombination(count, c.data(), raw.data(), z.get()), 0);
    expect(z, expected);
    // z is the first of the operands
    const Vector first = filled(numbers[0]);
    std::vector<N_Vector> with_first = raw;
    with_first[0] = first.get();
    ASSERT_EQ(N_VLinearCombination(count, c.data(), with_first.data(), first.get()), 0);
    expect(first, expected);
  }
  std::vector<double> products(most);
  ASSERT_EQ(N_VDotProdMulti(most, raw[0], raw.data(), products.data()), 0);
  for (int j = 0; j < most; ++j)
    EXPECT_EQ(products[static_cast<std::size_t>(j)], N_VDotProd(raw[0], raw[static_cast<std::size_t>(j)]));
  std::vector<Vector> out;
  std::vector<N_Vector> raw_out;
  for (int j = 0; j < most; ++j) {
    out.push_back(zeros());
    raw_out.push_back(out.back().get());
  }
  ASSERT_EQ(N_VScaleAddMulti(most, c.data(), raw[1], raw.data(), raw_out.data()), 0);
  for (std::size_t j = 0; j < most; ++j)
    expect(out[j], each(numbers[1], numbers[j], [&](double p, double q) { return c[j] * p + 1.0 * q; }));
}

TEST_P(StateVector, WeightsAndFiniteness) {
  const auto y = random(20);
  const Vector v = filled(y);
  const Vector w = zeros();
  constexpr double relative = 1e-7;
  constexpr double absolute = 1e-9;
  kernels->error_weights(data_of(v.get()), relative, absolute, data_of(w.get()), n());
  expect(w, each(y, y, [&](double p, double) { return 1.0 / (relative * std::abs(p) + absolute); }));
  EXPECT_TRUE(finite(v.get()));
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), infinity, -infinity})
    for (std::size_t i = 0; i < n(); ++i) {
      const Vector broken = filled(y);
      data_of(broken.get())[i] = bad;
      EXPECT_FALSE(finite(broken.get())) << i;
    }
}

TEST_P(StateVector, WithinABound) {
  const auto y = random(20);
  const double largest =
      std::abs(*std::max_element(y.begin(), y.end(), [](double a, double b) { return std::abs(a) < std::abs(b); }));
  const Vector v = filled(y);
  EXPECT_TRUE(kernels->within(data_of(v.get()), largest, padded_size(v.get())));
  EXPECT_FALSE(kernels->within(data_of(v.get()), std::nextafter(largest, 0.0), padded_size(v.get())));
  for (std::size_t i = 0; i < n(); ++i)
    for (const double out : {2.0 * largest, -2.0 * largest}) {
      const Vector outside = filled(y);
      data_of(outside.get())[i] = out;
      EXPECT_FALSE(kernels->within(data_of(outside.get()), largest, padded_size(outside.get()))) << i;
    }
}

// Every instruction set gives the same bits: sums are taken in one order.
TEST_P(StateVector, ColumnsAreOneVectorWhoseErrorNormsMayBeThoseOfTheFirst) {
  constexpr std::size_t columns = 3;
  const std::vector<double> x = random(1);
  const std::vector<double> w = random(2);
  const Vector one_x = filled(x);
  const Vector one_w = filled(w);
  for (const std::size_t measured : {std::size_t{1}, columns}) {
    const VectorShape shape{n(), columns, measured};
    const Vector a = make_state_vector(shape, context.get(), *kernels);
    const Vector b(N_VClone(a.get()));
    ASSERT_EQ(shape_of(b.get()).columns, columns);
    ASSERT_EQ(padded_size(b.get()), columns * column_stride(a.get()));
    EXPECT_EQ(N_VGetLength(a.get()), static_cast<sunindextype>(columns * n()));
    const auto clean = [&](const Vector& v) {
      for (std::size_t j = 0; j < columns; ++j)
        for (std::size_t i = n(); i < column_stride(v.get()); ++i)
          EXPECT_EQ(data_of(v.get())[j * column_stride(v.get()) + i], 0.0) << j << ' ' << i;
    };
    // Operations that would fill the padding.
    N_VConst(3.0, a.get());
    clean(a);
    N_VAddConst(a.get(), -1.0, b.get());
    clean(b);
    N_VInv(a.get(), b.get());
    clean(b);
    N_VDiv(a.get(), b.get(), b.get());
    clean(b);
    for (std::size_t j = 0; j < columns; ++j)
      for (std::size_t i = 0; i < n(); ++i)
        EXPECT_EQ(data_of(b.get())[j * column_stride(b.get()) + i], 3.0 / (1.0 / 3.0));
    EXPECT_EQ(N_VMin(a.get()), 3.0);
    // The first column holds x, the others ten times as much.
    for (std::size_t j = 0; j < columns; ++j)
      for (std::size_t i = 0; i < n(); ++i) {
        data_of(a.get())[j * column_stride(a.get()) + i] = (j == 0 ? 1.0 : 10.0) * x[i];
        data_of(b.get())[j * column_stride(b.get()) + i] = w[i];
      }
    const double first = N_VWrmsNorm(one_x.get(), one_w.get());
    const double all = N_VWrmsNorm(a.get(), b.get());
    if (measured == 1) {
      EXPECT_EQ(all, first);
    } else {
      constexpr double rounding = 1e-14;
      EXPECT_NEAR(all, first * std::sqrt((1.0 + 100.0 + 100.0) / 3.0), rounding * all);
    }
    EXPECT_EQ(N_VMaxNorm(a.get()), 10.0 * N_VMaxNorm(one_x.get()));
  }
}

TEST_P(StateVector, BitsDoNotDependOnTheInstructionSet) {
  const VectorKernels& baseline = *vector_kernels("baseline");
  const Vector x = filled(random(30));
  const Vector w = filled(random(31));
  const std::size_t size = padded_size(x.get());
  const double* a = data_of(x.get());
  const double* b = data_of(w.get());
  EXPECT_EQ(kernels->dot(a, b, size), baseline.dot(a, b, size));
  EXPECT_EQ(kernels->weighted_square_sum(a, b, size), baseline.weighted_square_sum(a, b, size));
  EXPECT_EQ(kernels->absolute_sum(a, size), baseline.absolute_sum(a, size));
  EXPECT_EQ(kernels->absolute_max(a, size), baseline.absolute_max(a, size));
}

/// Lengths around the padding and the model's 34, with each instruction set that this machine runs.
std::vector<Case> cases() {
  std::vector<Case> all;
  for (const char* kernels : {"baseline", "avx2", "avx512"})
    if (vector_kernels(kernels) != nullptr)
      for (const std::size_t length : {1U, 8U, 9U, 34U}) all.push_back({kernels, length});
  return all;
}

INSTANTIATE_TEST_SUITE_P(Kernels, StateVector, ::testing::ValuesIn(cases()), [](const auto& instance) {
  return std::string(instance.param.kernels) + "_" + std::to_string(instance.param.length);
});

}  // namespace
}  // namespace epicyclic::integrate::state_vector_test
