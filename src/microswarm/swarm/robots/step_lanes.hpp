// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "microswarm/swarm/robots/contact_rule.hpp"
#include "microswarm/swarm/robots/wall_faces.hpp"

namespace microswarm {

/// Moves all robots with the machine's widest vectors; the result has the same bits as ContactMoves
/// with WallFaces::first_contact on all machines. Maps with few faces process many robots per
/// vector, others the faces near each robot.
void step_lanes(const WallFaces& faces, PointF move, ContactRule rule, std::span<float> x,
                std::span<float> y);

}  // namespace microswarm
