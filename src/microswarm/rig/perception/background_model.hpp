// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core.hpp>
#include <span>
#include <vector>

#include "microswarm/formats/images/image.hpp"
#include "microswarm/formats/images/mask.hpp"
#include "microswarm/geometry/vec2.hpp"

namespace microswarm {

/// What a camera sees where no robot is: light, and the edges of walls, learned from picture to
/// picture. Taken out of a picture it leaves robots that are equally dark everywhere, also at
/// walls.
class BackgroundModel {
 public:
  /// `walls` are the pixels on walls; `reach` [px] is how far a robot's picture reaches.
  BackgroundModel(const Mask& walls, int reach);

  /// The grey of the background in pictures that it is taken out of.
  static constexpr double level = 180;
  /// The picture without its background: of `level`, but where robots are. Valid until the next
  /// call.
  const Image& take_out(const Image& picture);
  /// Is it darker there [px], in that picture, than the background is?
  bool is_dark(Vec2 at_px) const;
  /// Learns from that picture where no robot is; robots are at these places [px].
  void learn(std::span<const Vec2> robots);

 private:
  void compare_with_light(const Image& picture);

  int reach_;
  cv::Mat free_;                   // 255 where no wall is
  cv::Mat beyond_;                 // 255 on walls that no robot's picture reaches
  cv::Mat at_edge_;                // 255 within reach of a wall's edge
  std::vector<float> share_;       // the picture as share of the light
  std::vector<float> background_;  // the same where no robot is; empty before the first picture
  Image open_;
};

}  // namespace microswarm
