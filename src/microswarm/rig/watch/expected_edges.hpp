// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "microswarm/formats/images/image.hpp"
#include "microswarm/rig/perception/perception.hpp"
#include "microswarm/vision/tracking/ring_fit.hpp"
#include "microswarm/world/map/map.hpp"

namespace cv {
class Mat;
}

namespace microswarm::rig {

/// Point of an edge that a picture should show.
struct ExpectedEdge {
  Vec2 at_px{};
  Vec2 normal{};  ///< unit vector towards the wall, or towards the darker side in a still
};

/// Edges of a map's walls in a picture of `view`, one a few pixels. `border`: those of the
/// workspace's border, too, of which a camera may show nothing.
std::vector<ExpectedEdge> wall_edges(const Map& map, const CameraView& view, bool border);

/// The strongest edges of a still, apart from what is within the discs [px], such as the swarm and
/// moving obstacles.
std::vector<ExpectedEdge> still_edges(const formats::Image& still,
                                      std::span<const vision::Ring> moving);

/// The picture as read by edge searches: slightly blurred, 8 bits.
cv::Mat calm_picture(const formats::Image& picture);

/// Typical difference of grey values two pixels apart where there is no edge.
double edge_noise(const cv::Mat& calm);

}  // namespace microswarm::rig
