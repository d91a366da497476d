// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/core/maths/angles.hpp"
#include "microswarm/world/obstacles/obstacle.hpp"
#include "microswarm/world/snapshot.hpp"

namespace microswarm::scenes {

/// The S-shaped channel with two wider ends of Fig 3(a) [drrt] in a block of 2000 × 1000 µm, as in
/// scenarios/papers/drrt/s_channel.yaml. The paper shows its outline only as a picture. Ours is
/// shaped so that A* with 40 µm clearance finds a path of about 1702 µm.
DeformingChannel s_channel_shape();
Snapshot s_channel(const DeformingChannel& shape = s_channel_shape());
inline constexpr Pose2 s_channel_start{{200, 700}, pi};
inline constexpr Vec2 s_channel_goal{1750, 300};

}  // namespace microswarm::scenes
