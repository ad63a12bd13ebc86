// Journal records of points: exact, and damaged ones refused.

#include "io/sweep_output.hpp"

#include <limits>

#include <gtest/gtest.h>

#include "io/journal.hpp"

namespace epicyclic::io {
namespace {

studies::PointResult example() {
  studies::PointResult r;
  r.point = {7, studies::Direction::down, 0.1};
  r.outcome = integrate::Outcome::diverged;
  r.message = "left the bound";
  r.recurrence = {3, 1e-9, 3, 5e-10};
  studies::MeshRecord mesh;
  mesh.delta_min = -std::numeric_limits<double>::infinity();
  mesh.delta_max = 5e-324;
  mesh.loss = mesh.back = true;
  r.sun_planet = {mesh, mesh, {}};
  r.ring_planet = {mesh};
  r.planet_spread = 0.3;
  r.rhs_evaluations = 1234567890123L;
  r.end_state = {1.0, -0.0, 3.0};
  r.poincare_columns = 2;
  r.poincare = {1, 2, 3, 4};
  return r;
}

TEST(PointRecord, ComesBackExactly) {
  const studies::PointResult a = example();
  const studies::PointResult b = decode_point(encode_point(a));
  EXPECT_EQ(encode_point(b), encode_point(a));
  EXPECT_EQ(b.point.index, a.point.index);
  EXPECT_EQ(b.message, a.message);
  EXPECT_EQ(b.rhs_evaluations, a.rhs_evaluations);
  EXPECT_EQ(b.sun_planet[0].contact(), "loss+back");
  EXPECT_EQ(b.poincare, a.poincare);
}

TEST(PointRecord, AnyPartOfItIsRefused) {
  const std::vector<std::byte> record = encode_point(example());
  for (std::size_t n = 0; n < record.size(); ++n)
    EXPECT_THROW((void)decode_point(std::span(record).first(n)), DamagedData) << n;
  std::vector<std::byte> longer = record;
  longer.push_back(std::byte{0});
  EXPECT_THROW((void)decode_point(longer), DamagedData);
}

TEST(PointRecord, LengthsBeyondTheRecordAreRefusedBeforeMemoryIsTaken) {
  std::vector<std::byte> record = encode_point(example());
  for (std::size_t k = 0; k < record.size(); ++k) {
    std::vector<std::byte> bad = record;
    bad[k] = std::byte{0xff};
    try {
      (void)decode_point(bad);
    } catch (const DamagedData&) {
    }
  }
}

}  // namespace
}  // namespace epicyclic::io
