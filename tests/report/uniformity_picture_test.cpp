// SPDX-License-Identifier: Apache-2.0
#include "microswarm/report/uniformity_picture.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/files.hpp"

namespace microswarm::report {
namespace {

// The field grows to the right: it deviates by 100 % at the edges and is even along y.
actuation::UniformityMap sloping() {
  actuation::UniformityMap map{.grid = {.half_width = 1000, .points = 3},
                               .centre_field = {1, 0, 0}};
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) {
      map.field.emplace_back(column, 0, 0);
      map.deviation.push_back(std::abs(column - 1));
    }
  return map;
}

TEST(UniformityPicture, TableHasALineForEachPoint) {
  const std::string table = uniformity_table(sloping());
  EXPECT_EQ(table.substr(0, table.find('\n')), "x_um,y_um,z_um,bx_mt,by_mt,bz_mt,deviation");
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 10);
  EXPECT_NE(table.find("\n1000,-1000,0,2,0,0,1\n"), std::string::npos);
}

TEST(UniformityPicture, IsWrittenInTheFormatOfItsName) {
  const test::Folder folder;
  draw_uniformity(sloping(), true, folder / "even.svg");
  const std::string svg = read_file(folder / "even.svg");
  EXPECT_NE(svg.find("<svg"), std::string::npos);
}

}  // namespace
}  // namespace microswarm::report
