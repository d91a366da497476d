// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/hierarchical/impasse_leader.hpp"

#include <algorithm>

namespace microswarm::navigation {
namespace {

/// Those of a navigator that keeps at least the clearance of the hierarchical one.
SafeIntervalParams leader_params(const HierarchicalParams& led, const SwarmLimits& swarm) {
  const double gap = std::max(0.0, led.clearance - swarm.radius);
  SafeIntervalParams params;
  params.speed = led.speed;
  params.gap = std::max(params.gap, gap);
  params.max_gap = std::max(params.max_gap, gap);
  params.tuning.imminent.gap = std::max(params.tuning.imminent.gap, gap);
  params.wall_gap = params.tuning.imminent.wall_gap = gap;
  return params;
}

}  // namespace

std::optional<Decision> ImpasseLeader::decide(const Observation& seen, double left, bool is_alone,
                                              const Stop& stop) {
  leads_ = impasse_.update(seen.now, left, is_alone);
  if (leads_ && !navigator_) {
    navigator_ = std::make_unique<SafeIntervalNavigator>(leader_params(params_, task_.swarm), task_,
                                                         Rng(0, Purpose::planner));
    navigator_->prepare(*seen.world, stop);
  }
  if (!navigator_) return std::nullopt;
  const Command command = navigator_->step(seen, stop);
  if (!leads_) return std::nullopt;
  return Decision{command, navigator_->view().state};
}

void ImpasseLeader::overruled(double now, const Command& command) {
  if (navigator_) navigator_->overruled(now, command);
}

}  // namespace microswarm::navigation
