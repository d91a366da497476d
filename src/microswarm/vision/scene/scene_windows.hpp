// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <span>
#include <vector>

#include "microswarm/vision/scene/background.hpp"
#include "microswarm/vision/scene/scene_finder.hpp"

namespace microswarm {

/// Finds the scene of each picture of a video as `find_scene` does, in a fraction of the time: the
/// light is fitted to a coarse picture, and only windows around what differs from it there are
/// searched pixel by pixel. Keeps nothing from picture to picture. Positions and radii agree with
/// those of `find_scene` to a tenth of a pixel; the tests hold them to that.
class SceneWindows {
 public:
  /// `walls` is empty or has the size of the pictures, which are grey.
  explicit SceneWindows(Mask walls);

  /// As `find_scene`.
  SeenScene find(const Image& picture, const SceneParams& params, std::optional<Vec2> before_px,
                 std::span<const Ring> expected);

 private:
  /// Background of a look: what counts as a difference, and the roughness.
  struct Backdrop {
    float least = 0;
    double noise = 0;
  };

  void look_coarsely(const SceneParams& params);
  void place_windows(const SceneParams& params);
  std::vector<Blob> search(const BlobParams& look, const Mask* hidden,
                           const std::vector<cv::Rect>& windows) const;
  std::optional<std::vector<Blob>> search_within(const BlobParams& look, const Mask* hidden,
                                                 const std::vector<cv::Rect>& windows) const;
  Backdrop backdrop(const BlobParams& look) const;
  cv::Mat ground(const cv::Rect& box, int side) const;

  Mask walls_;
  cv::Mat coarse_seen_;
  const Image* picture_ = nullptr;  // during a call
  cv::Mat fine_;
  std::optional<GroundSurface> light_;
  cv::Mat differs_;                // coarse pixels, 255 where a window is needed
  std::vector<cv::Rect> windows_;  // [px] apart from each other
};

}  // namespace microswarm
