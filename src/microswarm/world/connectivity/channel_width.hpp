// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/core/maths/rng.hpp"
#include "microswarm/world/map/map.hpp"

namespace microswarm {

/// Typical channel width of a map [µm], estimated at random points: in a channel of width w the
/// mean clearance of a free point is w/4. Throws InputError if no free point is found.
double channel_width(const Map& map, Rng& rng);

}  // namespace microswarm
