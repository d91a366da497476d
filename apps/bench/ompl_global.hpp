// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>

#include "microswarm/planning/global_input/global_rrt.hpp"

namespace microswarm::bench {

/// Result of growing OMPL's RRT.
struct OmplGrowth {
  std::size_t nodes = 0;
  double seconds = 0;
};

/// Grows OMPL's RRT to `nodes` or for `max_seconds` in the space of several robots' positions, with
/// its own nearest neighbours and our local planner, Alg 2 [global], as its directed control
/// sampler. Each input is one step of its propagator.
OmplGrowth grow_ompl(const Map& map, std::span<const Vec2> starts,
                     const planning::GlobalRrtParams& params, std::size_t nodes,
                     double max_seconds);

}  // namespace microswarm::bench
