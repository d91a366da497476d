// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "microswarm/vision/scene/scene_finder.hpp"

namespace microswarm::vision {

/// Finds the scene of each picture of a video as `find_scene` does, in a fraction of the time: the
/// light is fitted to a coarse picture, and only windows around what differs from it there are
/// searched pixel by pixel. Keeps nothing from picture to picture. Positions and radii agree with
/// those of `find_scene` to a tenth of a pixel, or a pixel where the swarm or a wall cuts an
/// obstacle; the tests hold them to that.
class SceneWindows {
 public:
  /// `walls` is empty or has the size of the pictures, which are grey.
  explicit SceneWindows(formats::Mask walls);

  /// As `find_scene`.
  SeenScene find(const formats::Image& picture, const SceneParams& params, const SwarmPrior& prior,
                 std::span<const Ring> expected);

 private:
  formats::Mask walls_;
  formats::Mask coarse_walls_;  // 1 where a coarse pixel is not seen
};

}  // namespace microswarm::vision
