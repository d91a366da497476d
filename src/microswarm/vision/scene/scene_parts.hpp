// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core.hpp>
#include <span>
#include <vector>

#include "microswarm/vision/scene/scene_finder.hpp"

namespace microswarm::vision {

// Steps of `find_scene`, for blobs found in any way.

/// The walls and the area of a blob, grown slightly.
formats::Mask hidden_by(const Blob& blob, const formats::Image& picture, const formats::Mask* walls,
                        double margin);

/// Whether a swarm without texture is looked for where nothing has texture, and how it looks then.
bool looks_for_smooth(const SceneParams& params);
BlobParams smooth_look(const SceneParams& params);
/// The only smooth blob that can be the swarm; nothing if there are others.
SwarmSighting choose_smooth(std::vector<Blob> blobs, const SceneParams& params,
                            const SwarmPrior& prior);

/// The obstacles that the blobs show in a picture of this size.
std::vector<SeenObstacle> to_obstacles(std::vector<Blob> blobs, const cv::Size& size,
                                       const formats::Mask* hidden, const SceneParams& params,
                                       std::span<const Ring> expected);

}  // namespace microswarm::vision
