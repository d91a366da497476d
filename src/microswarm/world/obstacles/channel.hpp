// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "microswarm/world/obstacles/obstacle.hpp"

namespace microswarm {

/// Outline of the channel's free interior at time t [s] in the mover's frame, counter-clockwise. It
/// is a simple ring for every t if the channel is valid.
std::vector<Vec2> channel_outline(const DeformingChannel& channel, double t);

/// The block with the channel cut out, in the mover's frame.
Polygon channel_block(const DeformingChannel& channel, double t);

/// Reports an issue if at any time the channel closes, folds in a bend too tight for its width,
/// intersects itself or leaves the block.
Issues validate(const DeformingChannel& channel);

}  // namespace microswarm
