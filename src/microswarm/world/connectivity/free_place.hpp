// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/world/map/map.hpp"

namespace microswarm {

/// Where something may be that was seen at `place`, keeping `r` > 0 [µm] from walls: `place` itself
/// when that is free, else a free place about as near as there is one, looked for in 16 directions
/// at distances that grow by a quarter. `place` when none is found.
Vec2 free_place(const Map& map, Vec2 place, double r);

}  // namespace microswarm
