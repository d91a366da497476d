// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string_view>
#include <utility>
#include <vector>

#include "microswarm/core/fields/fields.hpp"
#include "microswarm/formats/images/image.hpp"
#include "microswarm/vision/camera/camera_scale.hpp"

namespace microswarm::vision {

/// Marks of a calibration slide.
enum class GridPattern { dots, chessboard };
constexpr auto enum_names(GridPattern) {
  return std::array<std::pair<GridPattern, std::string_view>, 2>{
      {{GridPattern::dots, "dots"}, {GridPattern::chessboard, "chessboard"}}};
}

/// A grid of points with square cells. The points of a chessboard are its inner corners.
struct GridParams {
  GridPattern pattern = GridPattern::dots;
  int columns = 9;
  int rows = 6;
  double pitch = 100;  ///< distance between neighbours [µm]

  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.pattern, plain("pattern", "Pattern: dots, or inner corners of a chessboard."));
    visit(self.columns, plain("columns", 2, 1000, "Number of points in a row."));
    visit(self.rows, plain("rows", 2, 1000, "Number of points in a column."));
    visit(self.pitch, um("pitch", 1e-3, 1e6, "Distance between neighbouring points."));
  }
};

/// Finds the grid's points in a picture, row by row from the lower left. Columns run along the grid
/// direction nearest to the picture's x axis that matches the numbers of columns and rows. World
/// positions are multiples of the pitch from the first point. The grid may be rotated in the
/// picture, but must not be tilted. Throws InputError unless the picture shows exactly such a grid.
std::vector<ScalePoint> find_grid(const formats::Image& picture, const GridParams& params);

}  // namespace microswarm::vision
