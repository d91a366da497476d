// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core.hpp>
#include <span>
#include <vector>

#include "microswarm/formats/images/image.hpp"
#include "microswarm/formats/images/mask.hpp"
#include "microswarm/geometry/vec2.hpp"

namespace microswarm::rig {

/// Background without robots, learned from picture to picture: light and the edges of walls. After
/// its removal robots are equally dark everywhere, including at walls.
class BackgroundModel {
 public:
  /// `walls` are the pixels on walls; `reach` [px] is the radius of a robot in the picture.
  BackgroundModel(const formats::Mask& walls, int reach);

  /// Grey of the background after its removal.
  static constexpr double level = 180;
  /// The picture without background: `level` everywhere except at robots. Valid until the next
  /// call.
  const formats::Image& take_out(const formats::Image& picture);
  /// Whether that picture is darker than the background at this position [px].
  bool is_dark(Vec2 at_px) const;
  /// Learns from that picture where there is no robot; `robots` are the robots' positions [px].
  void learn(std::span<const Vec2> robots);

 private:
  void compare_with_light(const formats::Image& picture);

  int reach_;
  cv::Mat free_;                   // 255 off walls
  cv::Mat beyond_;                 // 255 on walls beyond the reach of any robot
  cv::Mat at_edge_;                // 255 within reach of a wall's edge
  std::vector<float> share_;       // the picture divided by the light
  std::vector<float> background_;  // the same without robots; empty before the first picture
  formats::Image open_;
};

}  // namespace microswarm::rig
