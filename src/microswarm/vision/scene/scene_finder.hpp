// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <variant>
#include <vector>

#include "microswarm/vision/camera/camera_scale.hpp"
#include "microswarm/vision/scene/swarm_finder.hpp"
#include "microswarm/vision/tracking/ring_fit.hpp"

namespace microswarm {

/// Settings of `find_scene`. Where obstacles have the swarm's tone, `swarm.look.min_texture` tells
/// them apart.
struct SceneParams {
  SwarmFinderParams swarm{.look = {.min_texture = 5}};
  BlobParams obstacles{.gap = 4};
  double roundness = 0.06;

  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.swarm, {"swarm", Unit::none, {}, "Detection of the swarm."});
    visit(self.obstacles, {"obstacles", Unit::none, {}, "Appearance of moving obstacles."});
    visit(self.roundness, {"roundness",
                           Unit::none,
                           {0, 1},
                           "Deviation from a circle, in radii, below which it is a disc."});
  }
};

/// A moving obstacle in a picture [px]; x right, y down, (0, 0) is the middle of the first pixel.
struct SeenObstacle {
  Blob blob;                  ///< what is seen of it
  std::optional<Ring> disc;   ///< when it is one, with what is hidden of it; else the hull
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
/// Obstacles are what stands out besides the swarm, also where they touch it.
SeenScene find_scene(const Image& picture, const SceneParams& params = {},
                     std::optional<Vec2> before_px = std::nullopt, const Mask* walls = nullptr);

}  // namespace microswarm
