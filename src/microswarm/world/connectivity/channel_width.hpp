// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/core/maths/rng.hpp"
#include "microswarm/world/map/map.hpp"

namespace microswarm {

/// Typical channel width of a map [µm], estimated at random points: in a channel of width w the
/// mean clearance of a free point is w/4. Throws InputError if no free point is found.
double channel_width(const Map& map, Rng& rng);

/// Width [µm] of the channel or hall around a free point: of the widest disc that is reached from
/// it by going to where the walls are farther.
double width_around(const Map& map, Vec2 p);

}  // namespace microswarm
