// SPDX-License-Identifier: Apache-2.0
#include "microswarm/experiment/run/swarm_state.hpp"

#include <utility>

namespace microswarm::experiment {

SwarmState::SwarmState(const Scenario& scenario, const Plant& plant)
    : scenario_(scenario), plant_(plant) {
  if (scenario.start) now_.pose = *scenario.start;
}

void SwarmState::take_robots(const Observation& seen, GoalMonitor& goal) {
  if (!goal.take_robots(seen.world->map())) return;
  const auto truth = plant_.ground_truth();
  if (truth || seen.swarm) now_.pose = truth ? truth->swarm.pose : seen.swarm->pose;
}

void SwarmState::take(const Observation& seen, GoalMonitor& goal) {
  if (const auto truth = plant_.ground_truth()) {
    now_ = {truth->now, truth->swarm.pose, scenario_.robots ? 0 : truth->swarm.radius, truth->speed,
            goal.left(truth->swarm.pose.position, truth->robots)};
    return;
  }
  now_.t = seen.now;
  if (!seen.swarm) return;
  const Pose2& pose = seen.swarm->pose;
  const double passed = seen.now - seen_at_.value_or(seen.now);
  const double moved = distance(now_.pose.position, pose.position);
  seen_at_ = seen.now;
  now_ = {seen.now, pose, scenario_.robots ? 0 : seen.swarm->radius,
          passed > 0 ? moved / passed : 0, goal.left(pose.position, seen.robots)};
}

bool SwarmState::take_sight(const Observation& seen) {
  const bool knows_all = plant_.ground_truth().has_value();
  was_seen_ = was_seen_ || seen.swarm || knows_all;
  return !knows_all && std::exchange(unseen_, seen.unseen) != seen.unseen;
}

std::span<const Vec2> SwarmState::robots(const Observation& seen) const {
  const auto truth = plant_.ground_truth();
  return truth ? truth->robots : std::span<const Vec2>(seen.robots);
}

Snapshot SwarmState::world(const Observation& seen) const {
  const auto truth = plant_.ground_truth();
  return truth ? truth->world->at(now_.t) : *seen.world;
}

}  // namespace microswarm::experiment
