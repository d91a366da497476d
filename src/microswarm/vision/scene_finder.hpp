// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <variant>
#include <vector>

#include "microswarm/vision/camera_scale.hpp"
#include "microswarm/vision/swarm_finder.hpp"

namespace microswarm {

/// Settings of `find_scene`. Where obstacles have the swarm's tone, `swarm.min_grain` tells them
/// apart.
struct SceneParams {
  SwarmFinderParams swarm;
  BlobParams obstacles{.gap = 3};
  double roundness = 0.06;

  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.swarm, {"swarm", Unit::none, {}, "How the swarm is found."});
    visit(self.obstacles, {"obstacles", Unit::none, {}, "How moving obstacles look."});
    visit(self.roundness, {"roundness",
                           Unit::none,
                           {0, 1},
                           "An obstacle whose outline is nowhere farther from a circle, in radii, "
                           "is a disc; others are convex polygons."});
  }
};

/// A moving obstacle in a picture [px]; x right, y down, (0, 0) is the middle of the first pixel.
struct SeenObstacle {
  Blob blob;                  ///< with the outline as seen
  bool is_disc = false;       ///< of radius `blob.radius_px`; else the hull
  std::vector<Vec2> hull_px;  ///< convex, holds the outline to half a pixel

  /// In the world [µm], as a Body has it.
  std::variant<Disc, Polygon> shape(const CameraScale& scale) const;
};

/// What a picture shows: the swarm and what else moves.
struct SeenScene {
  SwarmSighting swarm;
  std::vector<SeenObstacle> obstacles;  ///< the largest first
};

/// The swarm and the obstacles in a picture; `before_px`, `walls` and errors as for `find_swarm`.
/// What is not taken to be the swarm but looks like an obstacle is one.
SeenScene find_scene(const Image& picture, const SceneParams& params = {},
                     std::optional<Vec2> before_px = std::nullopt, const Mask* walls = nullptr);

/// Settings of `find_walls`.
struct WallParams {
  ParticleTone tone = ParticleTone::dark;
  double min_contrast = 15;
  double smooth = 2;
  double min_area = 200;

  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.tone, {"tone", Unit::none, {}, "Walls are dark or bright against the channels."});
    visit(self.min_contrast,
          {"min_contrast", Unit::none, {1, 255}, "Least difference to the channels, in greys."});
    visit(self.smooth,
          {"smooth", Unit::px, {0, 100}, "Spread of the Gaussian that takes the noise away."});
    visit(self.min_area, {"min_area",
                          Unit::none,
                          {0, 1e8},
                          "Smaller walls, and smaller holes in them, are none; "
                          "in square px."});
  }
};

/// What stands still: each pixel's median over the pictures. Throws InputError when there is none
/// or their sizes differ.
Image still_background(std::span<const Image> pictures);

/// The walls in a picture without swarm and obstacles, 1 = wall: what is farther from the light on
/// the channels than half of the contrast. The light may be uneven; it is fitted to the channels
/// alone. No walls where the contrast is below `min_contrast`.
Mask find_walls(const Image& background, const WallParams& params = {});

/// Smooth outlines [µm] of walls, for a Map, within `tolerance` [µm] of the mask's.
std::vector<Polygon> walls_in_world(const Mask& walls, const CameraScale& scale, double tolerance);

}  // namespace microswarm
