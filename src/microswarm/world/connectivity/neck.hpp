// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/world/connectivity/passage.hpp"

namespace microswarm {

/// Passage near `position`, where a lattice of the given spacing measured the clearance `least`.
/// The result is the middle of the shortest connection of the two walls that form the passage, if
/// it agrees with `least` within the lattice's error and nothing else is nearer. Otherwise it is
/// the lattice's measurement.
Passage neck_near(const Map& map, Vec2 position, double least, double spacing);

}  // namespace microswarm
