// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/contracts/plan.hpp"
#include "microswarm/planning/trees/fmt_star_params.hpp"

namespace microswarm::planning {

/// Connection radius γ √(log n / n) [µm], with γ = 2 (1 + η) √(1/2) √(area / π), for n samples in a
/// free space of `area` µm².
double fmt_radius(double radius_factor, double area, std::size_t n);

/// Plans with FMT*; see planners.hpp for the common interface.
Plan plan(const Snapshot& world, Pose2 start, Vec2 goal, const FmtStarParams& params, Rng& rng,
          const Stop& stop = {});

}  // namespace microswarm::planning
