// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/core/status.hpp"
#include "microswarm/core/stop.hpp"
#include "microswarm/navigation/gathering/aggregation.hpp"
#include "microswarm/navigation/gathering/rollout.hpp"
#include "microswarm/swarm/robots/robot_stepper.hpp"

namespace microswarm {

/// How a gathering ended.
struct GatherResult {
  Status status = Status::time_limit;  ///< solved, time_limit (the steps ran out) or stopped
  int steps = 0;
  double mean_way = 0;  ///< F at the end [µm]
  int guard_count = 0;
};

/// Gathers robots step by step under the rule "stop", without camera, delay or noise; they end
/// where they were gathered. With those an Episode gathers.
GatherResult gather(const RobotStepper& stepper, Gatherer& gatherer, Robots& robots, int most_steps,
                    const Stop& stop = {});
GatherResult gather(const RobotStepper& stepper, RolloutGatherer& gatherer, Robots& robots,
                    int most_steps, const Stop& stop = {});

}  // namespace microswarm
