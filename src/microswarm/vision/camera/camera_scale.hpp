// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "microswarm/core/fields/fields.hpp"
#include "microswarm/geometry/shapes.hpp"

namespace microswarm::vision {

/// Pose and scale of a camera: a similarity between pixels (x right, y down, (0, 0) is the middle
/// of the first pixel) and world [µm].
struct CameraScale {
  double um_per_px = 1;
  double rotation = 0;  ///< angle of the picture's x axis in the world [rad]
  bool y_up = true;     ///< the picture's up is the world's up; false for a mirrored picture
  Vec2 origin_px{};     ///< pixel of the world's origin

  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.um_per_px, plain("um_per_px", 1e-6, 1e6, "Scale: side of a pixel in µm.").needed());
    visit(self.rotation,
          deg("rotation", -360, 360, "Direction of the image's x axis, counter-clockwise."));
    visit(self.y_up, plain("y_up", "Image y axis points up in the world; false if mirrored."));
    visit(self.origin_px, px("origin", -1e6, 1e6, "World origin in the image, x right, y down."));
  }

  /// World position [µm] of a pixel position.
  Vec2 to_world(Vec2 at_px) const { return direction_to_world(at_px - origin_px); }
  /// Pixel position of a world position [µm].
  Vec2 to_picture(Vec2 position) const {
    const Vec2 turned = rotated(position, -rotation) / um_per_px;
    return origin_px + Vec2{turned.x, y_up ? -turned.y : turned.y};
  }
  /// World displacement [µm] of a displacement in pixels.
  Vec2 direction_to_world(Vec2 distance_px) const {
    return um_per_px * rotated({distance_px.x, y_up ? -distance_px.y : distance_px.y}, rotation);
  }
};

/// Scale of a picture of `height` pixels whose lower left corner is the world's origin, as that of
/// maps (formats/mask.hpp).
inline CameraScale upright_scale(int height, double um_per_px) {
  return {.um_per_px = um_per_px, .origin_px = {-0.5, height - 0.5}};
}

/// A pixel position and its world position [µm].
struct ScalePoint {
  Vec2 at_px{};
  Vec2 position{};
};

/// A fitted scale and the residuals of its points.
struct FittedScale {
  CameraScale scale{};
  std::vector<double> residuals{};  ///< of each point [µm]
  double rms = 0;                   ///< [µm]
  double worst = 0;                 ///< [µm]
};

/// Fits a similarity to two or more points by least squares. Throws InputError if all points
/// coincide.
FittedScale fit_scale(std::span<const ScalePoint> points, bool y_up = true);

/// Scale from two points of known distance [µm]; the axes of world and picture are parallel. The
/// origin is at `origin_px`, or at the lower left corner of a picture of `height` pixels. Throws
/// InputError if the points coincide or the distance is not positive.
CameraScale scale_of_distance(Vec2 a_px, Vec2 b_px, double distance, int height,
                              std::optional<Vec2> origin_px = std::nullopt, bool y_up = true);

/// Converts a polygon from pixels to the world [µm], with the orientation that Polygon requires.
Polygon polygon_in_world(const Polygon& in_picture, const CameraScale& scale);

}  // namespace microswarm::vision
