// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "microswarm/swarm/robots/contact_rule.hpp"
#include "microswarm/swarm/robots/wall_faces.hpp"

namespace microswarm {

/// Moves all robots with vectors of the best width of the machine it runs on; the bits are those of
/// ContactMoves with WallFaces::first_contact on any. Where a map has few faces, many robots are
/// looked at together, else the faces near each robot.
void step_lanes(const WallFaces& faces, PointF move, ContactRule rule, std::span<float> x,
                std::span<float> y);

}  // namespace microswarm
