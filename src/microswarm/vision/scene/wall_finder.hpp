// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "microswarm/core/fields/fields.hpp"
#include "microswarm/formats/images/image.hpp"
#include "microswarm/formats/images/mask.hpp"
#include "microswarm/geometry/shapes.hpp"
#include "microswarm/vision/camera/camera_scale.hpp"
#include "microswarm/vision/tracking/particles.hpp"

namespace microswarm::vision {

/// Settings of `find_walls`.
struct WallParams {
  ParticleTone tone = ParticleTone::dark;
  double min_contrast = 15;
  double smooth = 2;
  double min_area = 200;

  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.tone, plain("tone", "Walls are dark or bright against the channels."));
    visit(self.min_contrast, plain("min_contrast", 1, 255, "Minimum contrast to the channels."));
    visit(self.smooth, px("smooth", 0, 100, "Standard deviation of the smoothing Gaussian."));
    visit(self.min_area,
          plain("min_area", 0, 1e8, "Minimum area of walls and holes, in square pixels."));
  }
};

/// Static background: the median of each pixel over the pictures. Throws InputError if there are no
/// pictures or their sizes differ.
formats::Image still_background(std::span<const formats::Image> pictures);

/// Segments the walls in a picture without swarm and obstacles, 1 = wall, by a threshold between
/// two greys. Uneven light is removed first. It is estimated from grey gradients everywhere except
/// at edges, so walls may cover most of the picture. The result is empty if there is only one grey
/// or the two differ by less than `min_contrast`.
formats::Mask find_walls(const formats::Image& background, const WallParams& params = {});

/// The walls of a picture with a swarm in it.
struct WallsBesideSwarm {
  formats::Mask walls{};          ///< 1 = wall; the picture's size
  std::vector<Polygon> shapes{};  ///< their smooth outlines [µm]
};

/// Segments walls that may move, independently in each picture. `fixed` (the picture's size) marks
/// known walls. A region much darker than the walls, or separate from them within `reach_px` of
/// `swarm_px`, is the swarm. The result is without walls if the picture has only one grey.
WallsBesideSwarm find_walls_beside(const formats::Image& picture, const WallParams& params,
                                   const formats::Mask& fixed, Vec2 swarm_px, double reach_px,
                                   const CameraScale& scale);

/// Smooth outlines [µm] of walls for a Map, within `tolerance` [µm] of the mask's outline.
std::vector<Polygon> walls_in_world(const formats::Mask& walls, const CameraScale& scale,
                                    double tolerance);

}  // namespace microswarm::vision
