// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/formats/images/mask.hpp"
#include "microswarm/vision/camera/camera_scale.hpp"
#include "microswarm/world/map/map.hpp"

namespace microswarm {

/// Mask of the pixels whose centre is in or on a wall, or outside the map.
inline Mask walls_in_picture(const Map& map, const CameraScale& scale, int width, int height) {
  Mask walls(width, height);
  for (int row = 0; row < height; ++row)
    for (int column = 0; column < width; ++column)
      walls.at(column, row) =
          !map.is_free(scale.to_world({static_cast<double>(column), static_cast<double>(row)}), 0);
  return walls;
}

}  // namespace microswarm
