// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "microswarm/world/obstacles/obstacle.hpp"

namespace microswarm {

/// Outline of the channel's free inside at time t [s] in the mover's frame, counter-clockwise; a
/// simple ring for every t when the channel is valid.
std::vector<Vec2> channel_outline(const DeformingChannel& channel, double t);

/// The block with the channel cut out, in the mover's frame.
Polygon channel_block(const DeformingChannel& channel, double t);

/// An issue when the channel closes, folds in a bend too tight for its width, runs into itself or
/// leaves the block at any time.
Issues validate(const DeformingChannel& channel);

}  // namespace microswarm
