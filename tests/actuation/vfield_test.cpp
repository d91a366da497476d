// SPDX-License-Identifier: Apache-2.0
#include "microswarm/actuation/coils/vfield.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/actuation/support.hpp"
#include "tests/files.hpp"
#include "tests/messages.hpp"

namespace microswarm::actuation {
namespace {

/// Linear in each coordinate alone, so that the straight lines hit it everywhere [m] → [T].
Eigen::Vector3d trilinear(double x, double y, double z) {
  return {1 + 2 * x - y, 3 * x * y * z, z * y - x};
}

std::string grid_text() {
  std::string text = "24\n2 3 4\n-0.01 0.01\n0 0.02\n-0.03 0\n";
  for (const double x : {-0.01, 0.01})
    for (const double y : {0.0, 0.01, 0.02})
      for (const double z : {-0.03, -0.02, -0.01, 0.0}) {
        const Eigen::Vector3d b = trilinear(x, y, z);
        text += fmt::format("{} {} {} {} {} {}\n", x, y, z, b[0], b[1], b[2]);
      }
  return text;
}

TEST(Vfield, InterpolatesByStraightLines) {
  const FieldGrid grid = parse_vfield_text(grid_text(), "grid.txt");
  test::Dice dice(4);
  for (int trial = 0; trial < 200; ++trial) {
    const Eigen::Vector3d p = Eigen::Vector3d(0, 0.01, -0.015) +
                              dice.vector().cwiseProduct(Eigen::Vector3d(0.01, 0.01, 0.015));
    const FieldGradient f = grid.at(1e6 * p);
    EXPECT_LE((f.field - 1e3 * trilinear(p[0], p[1], p[2])).norm(), 1e-9);
    Eigen::Matrix3d g;
    g << 2, -1, 0, 3 * p[1] * p[2], 3 * p[0] * p[2], 3 * p[0] * p[1], -1, p[2], p[1];
    EXPECT_LE((f.gradient - 1e-3 * g).norm(), 1e-9);
  }
  EXPECT_TRUE(grid.contains({1e4, 2e4, 0}));
  EXPECT_LE((grid.at({1e4, 2e4, 0}).field - 1e3 * trilinear(0.01, 0.02, 0)).norm(), 1e-9);
  EXPECT_FALSE(grid.contains({1.01e4, 2e4, 0}));
}

TEST(Vfield, ReadsTheYamlForm) {
  std::string text =
      "name: coil\ndim_x: 2\ndim_y: 2\ndim_z: 2\nmin_x: 0\nmax_x: 1\nmin_y: 0\nmax_y: 1\n"
      "min_z: 0\nmax_z: 1\ndata:\n";
  for (int i = 0; i < 8; ++i) text += fmt::format("  - [{}, {}, {}]\n", i >> 2, i >> 1 & 1, i & 1);
  const FieldGrid grid = parse_vfield_yaml(text, "grid.yaml");
  EXPECT_LE((grid.at({2e5, 3e5, 4e5}).field - Eigen::Vector3d(200, 300, 400)).norm(), 1e-9);
  EXPECT_EQ(test::error_of([&] { parse_vfield_yaml(text + "  - [1, 2, 3]\n", "grid.yaml"); }),
            "grid.yaml: data has 9 nodes, 2 × 2 × 2 are 8");
}

TEST(Vfield, RefusesGridsAndFieldsThatCannotBe) {
  const auto yaml = [](const char* most, const char* field) {
    std::string text = fmt::format(
        "dim_x: 2\ndim_y: 2\ndim_z: 2\nmin_x: 0\nmax_x: {}\nmin_y: 0\nmax_y: 1\nmin_z: 0\n"
        "max_z: 1\ndata:\n",
        most);
    for (int i = 0; i < 8; ++i) text += fmt::format("  - [0, {}, 1]\n", field);
    return test::error_of([&] { parse_vfield_yaml(text, "grid.yaml"); });
  };
  EXPECT_EQ(yaml("1", "1"), "nothing was thrown");
  EXPECT_EQ(yaml("1e-300", "1"), "grid.yaml: range 0 .. 1e-300 m, must ascend");
  EXPECT_EQ(yaml("1", "-1e300"),
            "grid.yaml: node 1 of data: a field of -1e300 T for one ampere, allowed -1000..1000");
}

TEST(Vfield, RefusesInOneLine) {
  const auto refusal = [](std::string_view from, std::string_view to) {
    std::string text = grid_text();
    text.replace(text.find(from), from.size(), to);
    return test::error_of([&] { parse_vfield_text(text, "grid.txt"); });
  };
  EXPECT_TRUE(test::is_one_line_naming(refusal("24\n", "25\n"), "grid.txt:2",
                                       {"25", "nodes", "2 × 3 × 4", "24", "4000000"}));
  EXPECT_TRUE(
      test::is_one_line_naming(refusal("2 3 4", "1 3 4"), "grid.txt:2", {"1", "nodes", "2..1000"}));
  EXPECT_TRUE(
      test::is_one_line_naming(refusal("-0.03 0\n", "0 -0.03\n"), "grid.txt:5", {"0", "-0.03"}));
  EXPECT_TRUE(test::is_one_line_naming(refusal("-0.01 0 -0.02", "-0.01 0.01 -0.03"), "grid.txt:7",
                                       {"-0.01", "0", "-0.02"}));
  EXPECT_TRUE(test::is_one_line_naming(refusal("-0.01 0 -0.02", "-0.01 0 x"), "grid.txt:7",
                                       {"node", "x", "number"}));
  const std::string text = grid_text();
  EXPECT_EQ(
      test::error_of([&] { parse_vfield_text(text.substr(0, text.rfind("0.01 0.02")), "g"); }),
      "g:28: the file ends where a node: x y z Bx By Bz should stand");
  EXPECT_EQ(test::error_of([&] { parse_vfield_text(text + "1", "g"); }),
            "g:30: nothing is expected after the last node");
}

}  // namespace
}  // namespace microswarm::actuation
