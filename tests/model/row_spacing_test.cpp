#include "model/row_spacing.hpp"

#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "model/dynamic_model.hpp"
#include "problems/r1.hpp"

namespace epicyclic::model::row_spacing_test {
namespace {

std::vector<double> even_rows(int count) {
  std::vector<double> rows;
  for (int k = 0; k < count; ++k) rows.push_back(static_cast<double>(k) / count);
  return rows;
}

TEST(RowSpacing, ManyEvenRowsAreOneRun) {
  const RowSpacing rows(even_rows(16), 1.0);
  EXPECT_TRUE(rows.stops().empty());
  for (const double phase : {-0.1, 0.0, 0.3, 2.9}) EXPECT_EQ(rows.at(phase), 1.0 / 16.0);
}

TEST(RowSpacing, FewRowsAreSteppedOnto) { EXPECT_EQ(RowSpacing(even_rows(4), 1.0).stops(), even_rows(4)); }

TEST(RowSpacing, RunsEndWhereRowsStandMoreThanTwiceAsFarApart) {
  std::vector<double> given = {0.0};
  for (int k = 0; k <= 20; ++k) given.push_back(0.49 + 0.001 * k);
  const RowSpacing rows(given, 1.0);
  EXPECT_EQ(rows.stops(), (std::vector{0.0, given[1], given.back()}));
  EXPECT_NEAR(rows.at(0.5), 0.001, 1e-15);
  EXPECT_NEAR(rows.at(0.2), 0.49, 1e-15);
  EXPECT_NEAR(rows.at(0.7), 0.49, 1e-15);
}

TEST(RowSpacing, AJumpIsNoInterval) { EXPECT_EQ(RowSpacing(std::vector{0.0, 0.5, 0.5}, 1.0).at(0.1), 0.5); }

TEST(RowSpacing, NoRowsAreNoBound) { EXPECT_EQ(RowSpacing().at(0.3), std::numeric_limits<double>::infinity()); }

TEST(RowSpacing, RowsOfASmoothFunctionAreDenserThanItNeedsByTheFourthRootOfTheirError) {
  EXPECT_NEAR(rows_per_feature(1e-3 / 16.0), 2.0, 1e-12);
  EXPECT_EQ(rows_per_feature(0.1), 1.0);
  EXPECT_NEAR(RowSpacing(std::vector{0.0, 0.5}, 3.0).at(0.1), 1.5, 1e-15);
}

TEST(RowSpacing, HarmonicsAreSampledTwiceAWave) {
  gear::Stage s = problems::with_teeth(problems::r1(), 28, 26, 80, 3);
  s.sun_planet_mesh.stiffness_cos_N_per_m = std::vector<double>(20, 1e6);
  const DynamicModel model = make_dynamic_model(s, scales_of(s), 1.0, {});
  ASSERT_EQ(model.sampling_interval.size(), 1U);
  EXPECT_NEAR(model.sampling_interval[0], model.period / 40.0, 1e-12);
}

}  // namespace
}  // namespace epicyclic::model::row_spacing_test
