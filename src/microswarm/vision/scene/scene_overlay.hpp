// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "microswarm/formats/images/image.hpp"
#include "microswarm/formats/images/mask.hpp"
#include "microswarm/vision/scene/scene_finder.hpp"
#include "microswarm/vision/scene/swarm_criteria.hpp"

namespace microswarm::vision {

/// Draws detections over the picture in colour: the swarm's outline in green (yellow for each of
/// several candidates) with ellipse and axes in white, obstacles as discs or hulls in orange, walls
/// in blue.
formats::Image draw_scene(const formats::Image& picture, const SeenScene& scene,
                          const formats::Mask* walls = nullptr);

/// Draws over a picture in colour why blobs are not the swarm: a thin outline and a few words each.
void draw_reasons(formats::Image& shown, const std::vector<NotSwarm>& blobs);

}  // namespace microswarm::vision
