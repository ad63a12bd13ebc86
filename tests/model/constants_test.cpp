// Every constant of a stage goes through for_each_constant: what does not has no derivative, and is not a lane's own.

#include <cstddef>

#include <gtest/gtest.h>

#include "model/parameters.hpp"

namespace epicyclic::model::constants_test {
namespace {

/// A scalar as long as K doubles.
template <std::size_t K>
struct Scalar {
  double values[K] = {};
  Scalar() = default;
  Scalar(double x) : values{x} {}
  friend bool operator<(const Scalar& a, const Scalar& b) { return a.values[0] < b.values[0]; }
};

/// Scalars that stand in the parameters themselves, by how much longer they get with longer ones: these are
/// multiples of what rows are aligned to.
template <std::size_t N>
std::size_t stored() {
  return (sizeof(Parameters<Scalar<8>, N>) - sizeof(Parameters<Scalar<4>, N>)) / (4 * sizeof(double));
}

template <std::size_t N>
std::size_t visited(std::size_t harmonics) {
  Parameters<Scalar<1>, N> p;
  for (auto* mesh : {&p.sun_planet, &p.ring_planet}) {
    mesh->stiffness_cos.resize(harmonics);
    mesh->stiffness_sin.resize(harmonics);
  }
  std::size_t count = 0;
  for_each_constant(p, [&count](const Scalar<1>&) { ++count; });
  return count;
}

TEST(Constants, AreAllVisited) {
  EXPECT_EQ(visited<3>(0), stored<3>());
  EXPECT_EQ(visited<5>(0), stored<5>());
  constexpr std::size_t harmonics = 2;
  EXPECT_EQ(visited<3>(harmonics), stored<3>() + 2 * 2 * harmonics * 3);
}

}  // namespace
}  // namespace epicyclic::model::constants_test
