// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/core/execution/status.hpp"
#include "microswarm/core/execution/stop.hpp"
#include "microswarm/navigation/gathering/policies/aggregation_policy.hpp"
#include "microswarm/navigation/gathering/policies/common_input.hpp"
#include "microswarm/navigation/gathering/rollout/rollout_policy.hpp"

namespace microswarm::navigation {

/// Result of a gathering.
struct GatherResult {
  Status status = Status::time_limit;  ///< solved, time_limit (the steps ran out) or stopped
  int steps = 0;
  double mean_distance = 0;  ///< F at the end [µm]
  int guard_count = 0;
};

/// Gathers robots step by step, without camera, delay or noise. `robots` ends
/// with their final positions. Episode gathers with camera, delay and noise.
GatherResult gather(const CommonInput& input, AggregationPolicy& policy, Robots& robots,
                    int max_steps, const Stop& stop = {});
GatherResult gather(const CommonInput& input, RolloutPolicy& policy, Robots& robots, int max_steps,
                    const Stop& stop = {});

}  // namespace microswarm::navigation
