// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/world/connectivity/passage.hpp"

namespace microswarm {

/// The passage near `place`, where a lattice of the given spacing saw the clearance `least`,
/// measured between the two walls that make it: the middle of their shortest connection, if the
/// lattice's error allows it and nothing else is nearer. Else what the lattice saw.
Passage neck_near(const Map& map, Vec2 place, double least, double spacing);

}  // namespace microswarm
