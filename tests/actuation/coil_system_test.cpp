// SPDX-License-Identifier: Apache-2.0
#include "microswarm/actuation/coils/coil_system.hpp"

#include <gtest/gtest.h>
#include <Eigen/LU>
#include <cmath>

#include "microswarm/actuation/coils/currents.hpp"
#include "microswarm/actuation/coils/uniformity.hpp"
#include "microswarm/config/yaml.hpp"
#include "tests/actuation/support.hpp"
#include "tests/files.hpp"
#include "tests/messages.hpp"

namespace microswarm::actuation {
namespace {

CoilSystem system_of(const std::string& yaml) {
  return CoilSystem(read_yaml_text<CoilSystemParams>(yaml, "rig.yaml"), "rig.yaml");
}

TEST(CoilSystem, HelmholtzPairHasTheKnownField) {
  const CoilSystem system =
      system_of("coils: {type: helmholtz, radius_um: [40000, 50000, 60000], turns: [10, 20, 30]}");
  const Actuation at = system.at({0, 0, 0});
  // (4/5)^(3/2) µ0 n / R on each axis alone.
  const double factor = std::pow(0.8, 1.5) * mu_0;
  const Eigen::Vector3d expected(factor * 10 / 40000, factor * 20 / 50000, factor * 30 / 60000);
  EXPECT_LE((at.field - Eigen::Matrix3d(expected.asDiagonal())).norm(), 1e-12);
  EXPECT_LE(at.gradients.norm(), 1e-15);
}

TEST(CoilSystem, HelmholtzFieldIsEvenToTheFourthOrder) {
  const CoilSystem system = system_of("coils: {type: helmholtz}");
  const Eigen::Vector3d currents(0, 0, 1);
  const auto deviation = [&](double half_width) {
    return uniformity(system, currents, {.half_width = half_width, .points = 3})->largest();
  };
  EXPECT_NEAR(deviation(4000) / deviation(2000), 16, 0.2);
  const UniformityMap map = *uniformity(system, currents, {.half_width = 40000, .points = 41});
  EXPECT_EQ(map.at(20, 20), 0);
  EXPECT_LT(map.radius_within(0.01), map.radius_within(0.05));
  EXPECT_GT(map.radius_within(0.01), 10000);
  for (const double share : {0.001, 0.01, 0.05})
    for (int row = 0; row < map.grid.points; ++row)
      for (int column = 0; column < map.grid.points; ++column)
        if ((map.place(column, row) - map.grid.centre).norm() <= map.radius_within(share)) {
          EXPECT_LE(map.at(column, row), share);
        }
  EXPECT_EQ(map.place(0, 40), Eigen::Vector3d(-40000, 40000, 0));
  const UniformityMap side =
      *uniformity(system, currents, {.plane = Plane::yz, .half_width = 1000, .points = 3});
  EXPECT_EQ(side.place(2, 0), Eigen::Vector3d(0, 1000, -1000));
}

TEST(CoilSystem, CubeCoilsPushTowardsTheirAxes) {
  const CoilSystem system = system_of("coils: {type: cube, length_um: 20000, thickness_um: 10000}");
  ASSERT_EQ(system.size(), 6u);
  EXPECT_EQ(system.coil_names()[1], "x+");
  const Actuation at = system.at({0, 0, 0});
  for (int i = 0; i < 6; ++i) {
    const Eigen::Vector3d b = at.field.col(i);
    EXPECT_GT(b[i / 2], 0);
    EXPECT_LE((b - b[i / 2] * Eigen::Vector3d::Unit(i / 2)).norm(), 1e-12 * b.norm());
    // The field grows towards the coil that makes it.
    EXPECT_GT(gradient_matrix(at.gradients.col(i))(i / 2, i / 2) * (i % 2 ? 1 : -1), 0);
  }
}

TEST(CoilSystem, DivergenceAndCurlAreZeroOutsideOfWindings) {
  const CoilSystem system = system_of(
      "coils: {type: cube, radius_um: 30000, distance_um: 60000, length_um: 15000, "
      "thickness_um: 8000}");
  test::Dice dice(5);
  for (int trial = 0; trial < 40; ++trial) {
    const Eigen::Vector3d p = 20000 * dice.vector();
    Eigen::VectorXd currents(6);
    for (double& i : currents) i = 5 * dice.number();
    const auto field = [&](const Eigen::Vector3d& at) {
      return system.at(at).total_field(currents);
    };
    const Eigen::Matrix3d g = test::difference_gradient(field, p, 100);
    const Actuation at = system.at(p);
    const double scale = at.gradients.norm() * currents.norm();
    EXPECT_NEAR(g.trace(), 0, 1e-8 * scale);
    EXPECT_LE((g - g.transpose()).norm(), 1e-8 * scale);
    EXPECT_LE((g - at.total_gradient(currents)).norm(), 1e-8 * scale);
  }
}

TEST(CoilSystem, LoopsOfAFileAreThoseOfTheKinds) {
  const CoilSystem cube = system_of("coils: {type: cube, radius_um: 30000, turns: 50}");
  const CoilSystem loops = system_of(R"(coils:
  type: loops
  coils:
    - name: right
      windings:
        - {centre_um: [60000, 0, 0], axis: [2, 0, 0], radius_um: 30000, turns: 50})");
  const Eigen::Vector3d p(1000, -2000, 3000);
  EXPECT_LE((cube.at(p).field.col(1) - loops.at(p).field.col(0)).norm(), 1e-15);
}

TEST(CoilSystem, AMatrixHoldsEverywhere) {
  const CoilSystem system = system_of(
      "coils: {type: matrix, names: [a, b], field_mt_per_a: [[1, 2], [0, 3], [0, 0]], offset_mt: "
      "[0, 0, 0.05]}");
  const Actuation at = system.at({1e6, 0, 0});
  EXPECT_EQ(at.total_field(Eigen::Vector2d(1, 2)), Eigen::Vector3d(5, 6, 0.05));
}

TEST(CoilSystem, RefusesInOneLine) {
  const auto refusal = [](const std::string& yaml) {
    return test::error_of([&] {
      const test::Folder folder;
      const auto path = folder.with("rig.yaml", yaml);
      try {
        read_coil_system(path);
      } catch (const InputError& error) {
        throw InputError(std::string(error.what()).substr(path.string().size() - 8));
      }
    });
  };
  EXPECT_EQ(refusal("name: none"), "rig.yaml:1:1: missing key 'coils'");
  EXPECT_TRUE(test::is_one_line_naming(refusal("coils: {type: helmholtz, radius_um: [1, 2]}"),
                                       "rig.yaml:1:37", {"radius_um", "2", "[x, y, z]"}));
  EXPECT_TRUE(test::is_one_line_naming(refusal("coils: {type: cube}\ndrives: [{}, {}]"),
                                       "rig.yaml:2:9", {"2", "6", "coil"}));
  EXPECT_TRUE(test::is_one_line_naming(
      refusal("coils: {type: matrix, names: [a, a], field_mt_per_a: [[1, 2], [1, 2], [1, 2]]}"),
      "rig.yaml:1:8", {"coils", "a"}));
  EXPECT_TRUE(test::is_one_line_naming(
      refusal("coils: {type: matrix, names: [a], field_mt_per_a: [[1], [1, 2], [1]]}"),
      "rig.yaml:1:51", {"row 2", "field_mt_per_a", "2", "1"}));
  EXPECT_TRUE(test::is_one_line_naming(refusal("coils: {type: loops, coils: []}"), "rig.yaml:1:8",
                                       {"0", "coils", "1..64"}));
  EXPECT_TRUE(
      test::is_one_line_naming(refusal("coils: {type: loops, coils: [{name: a, windings: []}]}"),
                               "rig.yaml:1:50", {"coil", "a"}));
}

TEST(Currents, AreTheLeastThatMakeTheField) {
  const CoilSystem system = system_of("coils: {type: cube}");
  test::Dice dice(6);
  for (int trial = 0; trial < 100; ++trial) {
    const Actuation at = system.at(15000 * dice.vector());
    const Eigen::Vector3d wanted = 10 * dice.vector();
    const CurrentsForField found = currents_for(at, wanted);
    EXPECT_TRUE(found.reached);
    EXPECT_EQ(found.rank, 3);
    EXPECT_EQ(found.missing.cols(), 0);
    EXPECT_LE((at.total_field(found.currents) - wanted).norm(), 1e-11);
    const Eigen::Matrix3d square = at.field * at.field.transpose();
    const Eigen::VectorXd formula = at.field.transpose() * (square.inverse() * wanted);
    EXPECT_LE((found.currents - formula).norm(), 1e-9 * formula.norm());
    // Whatever leaves the field as it is makes them larger.
    Eigen::VectorXd change(6);
    for (double& c : change) c = dice.number();
    change -= at.field.transpose() * (square.inverse() * (at.field * change));
    EXPECT_LE((at.field * change).norm(), 1e-12);
    EXPECT_GE((found.currents + change).norm(), found.currents.norm());
  }
}

TEST(Currents, SayWhatCoilsCannotMake) {
  const CoilSystem flat = system_of(
      "coils: {type: matrix, names: [a, b], field_mt_per_a: [[1, 0], [0, 2], [0, 0]], offset_mt: "
      "[0.5, 0, 0.25]}");
  const Actuation at = flat.at({0, 0, 0});
  const CurrentsForField up = currents_for(at, {1.5, 4, 3});
  EXPECT_FALSE(up.reached);
  EXPECT_EQ(up.rank, 2);
  ASSERT_EQ(up.missing.cols(), 1);
  EXPECT_NEAR(std::abs(up.missing(2, 0)), 1, 1e-12);
  EXPECT_NEAR(up.short_by, 2.75, 1e-12);
  EXPECT_LE((up.currents - Eigen::Vector2d(1, 2)).norm(), 1e-12);
  EXPECT_TRUE(currents_for(at, {1.5, 4, 0.25}).reached);
  const CoilSystem dead =
      system_of("coils: {type: matrix, names: [a], field_mt_per_a: [[0], [0], [0]]}");
  const CurrentsForField none = currents_for(dead.at({0, 0, 0}), {1, 0, 0});
  EXPECT_EQ(none.rank, 0);
  EXPECT_EQ(none.currents[0], 0);
  EXPECT_FALSE(none.reached);
}

}  // namespace
}  // namespace microswarm::actuation
