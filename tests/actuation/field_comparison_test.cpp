// SPDX-License-Identifier: Apache-2.0
#include "microswarm/actuation/coils/field_comparison.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "microswarm/core/maths/angles.hpp"
#include "microswarm/core/maths/maths.hpp"
#include "microswarm/core/maths/rng.hpp"
#include "tests/messages.hpp"

namespace microswarm::actuation {
namespace {

TEST(FieldDoubt, FactorsAreNamedWithTheirCause) {
  const Eigen::Vector3d expected(8.2, -0.3, 0.5);
  for (const auto& [factor, cause] :
       std::vector<std::pair<double, const char*>>{{2, "full_scale_a"},
                                                   {0.5, "full_scale_a"},
                                                   {10, "gauss"},
                                                   {9.2, "gauss"},
                                                   {0.1, "decimal point"},
                                                   {1000, "µT"},
                                                   {0.001, "T instead"}}) {
    const std::string doubt = field_doubt(factor * expected, expected);
    EXPECT_TRUE(test::names(doubt, cause)) << factor << ": " << doubt;
    EXPECT_TRUE(test::names(doubt, fmt::format("{:.3g} times", factor))) << doubt;
  }
  const std::string other = field_doubt(4 * expected, expected);
  EXPECT_EQ(other, "4 times the expected field");
  EXPECT_EQ(field_doubt(Eigen::Vector3d::Zero(), expected), "0 times the expected field");
}

TEST(FieldDoubt, DirectionsAreNamedWithTheirCause) {
  const Eigen::Vector3d expected(8, 0.2, 0);
  EXPECT_TRUE(test::names(field_doubt(-expected, expected), "a reversed coil"));
  EXPECT_TRUE(test::names(field_doubt({0.2, 8, 0}, expected), "x and y"));
  EXPECT_TRUE(test::names(field_doubt({0, 0.2, 8}, expected), "x and z"));
  EXPECT_EQ(field_doubt({5.6, 5.6, 0}, {8, 0, 0}), "45° from the expected direction");
  const std::string both = field_doubt({0, 80, 0}, {8, 0, 0});
  EXPECT_TRUE(test::names(both, "gauss")) << both;
  EXPECT_TRUE(test::names(both, "x and y")) << both;
}

TEST(FieldDoubt, TolerancesOfCoilsAndProbesArePlausible) {
  Rng rng(3, Purpose::scene);
  for (int i = 0; i < 1000; ++i) {
    const Eigen::Vector3d expected(rng.uniform(-9, 9), rng.uniform(-9, 9), rng.uniform(1, 9));
    const double factor = rng.uniform(0.71, 1.39), angle = rng.uniform(0, radians(14.9));
    const Eigen::Vector3d axis = expected.cross(Eigen::Vector3d::UnitX()).normalized();
    const Eigen::Vector3d measured =
        factor * (maths::cos(angle) * expected + maths::sin(angle) * axis.cross(expected));
    EXPECT_EQ(field_doubt(measured, expected), "");
    const FieldComparison found = compare_fields(measured, expected);
    EXPECT_NEAR(found.ratio, factor, 1e-9);
    EXPECT_NEAR(found.angle, angle, 1e-7);
    EXPECT_NE(field_doubt(2 * measured, expected), "");
  }
}

}  // namespace
}  // namespace microswarm::actuation
