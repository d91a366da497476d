// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "microswarm/world/map/map.hpp"

namespace microswarm::experiment {

/// Whether a path with the clearance [µm] between two free points exists, up to rounding; false is
/// a proof. A point's own clearance may be asked for.
bool leads_to(const Map& map, Vec2 from, Vec2 to, double clearance);

/// Clearance of the widest path, up to `enough` [µm], and where it is tightest: ": about 50 µm are
/// left at (500, 500) µm". Empty without a path.
std::string tightest_text(const Map& map, Vec2 from, Vec2 to, double enough);

}  // namespace microswarm::experiment
