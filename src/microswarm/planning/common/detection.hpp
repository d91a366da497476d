// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/contracts/plan.hpp"

namespace microswarm::planning {

/// Detection for one circle: Eq 1–3 [drrt], with the factor floored at `rho_min`. A circle of
/// radius 0 detects nothing. If stopped, the covered area is of no meaning.
Detection detect(const Snapshot& world, Disc circle, double rho_min, const Stop& stop = {});

}  // namespace microswarm::planning
