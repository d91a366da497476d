// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <variant>
#include <vector>

#include "microswarm/core/maths/infinity.hpp"
#include "microswarm/vision/camera/camera_scale.hpp"
#include "microswarm/vision/scene/swarm_finder.hpp"
#include "microswarm/vision/tracking/ring_fit.hpp"

namespace microswarm::vision {

/// Settings of `find_scene`. If obstacles have the swarm's tone, `swarm.look.min_texture`
/// distinguishes them from it. A dense swarm may have no texture at the camera's magnification:
/// with `smooth_swarm` a smooth blob is the swarm where nothing has texture and it is the only one.
struct SceneParams {
  SwarmFinderParams swarm{.look = {.min_texture = 5}};
  BlobParams obstacles{.gap = 4};
  bool smooth_swarm = true;
  double roundness = 0.06;

  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.swarm, plain("swarm", "Detection of the swarm."));
    visit(self.obstacles, plain("obstacles", "Appearance of moving obstacles."));
    visit(self.smooth_swarm,
          plain("smooth_swarm", "Without texture, a single smooth blob is the swarm."));
    visit(self.roundness,
          plain("roundness", 0, 1, "Deviation from a circle, in radii, below which it is a disc."));
  }
};

/// A moving obstacle in a picture [px]; x right, y down, (0, 0) is the centre of the first pixel.
struct SeenObstacle {
  Blob blob{};                  ///< its visible part
  std::optional<Ring> disc{};   ///< if round, with hidden parts, or one of several; else the hull
  std::vector<Vec2> hull_px{};  ///< convex; contains the outline to half a pixel

  /// Shape in the world [µm], as in a Body.
  std::variant<Disc, Polygon> shape(const CameraScale& scale) const;
};

/// Prior knowledge of the swarm in a picture.
struct SwarmPrior {
  std::optional<Vec2> at_px{};  ///< its last position: what is farther than `jump` is not the swarm
  double around_px = 0;         ///< radius around it within which other blobs are reported too
  double min_radius_px = 0;     ///< of a smooth blob that can be the swarm
  double max_radius_px = infinity;
};

/// The swarm and the obstacles of a picture.
struct SeenScene {
  SwarmSighting swarm{};
  std::vector<SeenObstacle> obstacles{};  ///< sorted by decreasing size
};

/// Whether a blob without texture can be the swarm: as `prior` says, and not cut.
bool fits(const Blob& smooth, const SceneParams& params, const SwarmPrior& prior);

/// Finds the swarm and the obstacles in a picture. Obstacles are all other regions that differ from
/// the background, including those that touch the swarm. Where several of the `expected` discs have
/// joined in one region, each is a separate obstacle. `walls` and errors as in `find_swarm`.
SeenScene find_scene(const formats::Image& picture, const SceneParams& params = {},
                     const SwarmPrior& prior = {}, const formats::Mask* walls = nullptr,
                     std::span<const Ring> expected = {});

}  // namespace microswarm::vision
