// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/formats/images/rasterise.hpp"
#include "microswarm/vision/camera/camera_scale.hpp"
#include "microswarm/world/map/map.hpp"

namespace microswarm::rig {

/// Mask of the pixels whose centre is in or on a wall, or outside the map.
inline formats::Mask walls_in_picture(const Map& map, const vision::CameraScale& scale, int width,
                                      int height) {
  return formats::blocked_cells(map, width, height, [&](int column, int row) {
    return scale.to_world({static_cast<double>(column), static_cast<double>(row)});
  });
}

}  // namespace microswarm::rig
