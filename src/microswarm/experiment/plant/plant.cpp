// SPDX-License-Identifier: Apache-2.0
#include "microswarm/experiment/plant/plant.hpp"

#include <algorithm>
#include <utility>

#include "microswarm/core/maths/angles.hpp"
#include "microswarm/experiment/monitors/contact_monitor.hpp"

namespace microswarm::experiment {

KinematicPlant::KinematicPlant(const Scenario& scenario, World world, std::uint32_t trial)
    : world_(std::move(world)),
      sensing_(scenario.sensing),
      swarm_(scenario.swarm, *scenario.start),
      drift_(scenario.seed, Purpose::plant, trial),
      noise_(scenario.seed, Purpose::sensor, trial),
      dropouts_(sensing_.missed_share, sensing_.missed_time),
      obstacles_(sensing_, Rng(scenario.seed, Purpose::obstacle_sensor, trial)),
      history_{{0, *scenario.start, swarm_.pose().radius}} {}

Observation KinematicPlant::observe() {
  const double taken = std::max(0.0, now_ - sensing_.age());
  const double dt = now_ - std::exchange(observed_, now_);
  const double told = std::max(0.0, now_ - sensing_.observation_delay);
  Observation observation{
      .now = now_,
      .seen = told,
      .swarm = {},
      .robots = {},
      .world = std::make_shared<const Snapshot>(obstacles_.frame(world_, taken, told, dt))};
  // Always draw the same count, so a missed frame does not change the noise of the next.
  const bool missed = dropouts_.miss(0, dt, noise_);
  const double dx = noise_.normal(), dy = noise_.normal(), turn = noise_.normal();
  if (missed) return observation;
  const PoseStamped was = moment_on(history_, taken);
  Pose2 pose = was.pose;
  pose.position += sensing_.position_noise * Vec2{dx, dy};
  if (sensing_.heading_noise > 0) pose.heading = wrap(pose.heading + sensing_.heading_noise * turn);
  observation.swarm = SwarmPose{pose, was.radius};
  return observation;
}

void KinematicPlant::apply(const Command& command, double dt) {
  swarm_.step(command, dt, drift_);
  for (const PoseStamped& pose : swarm_.trajectory().subspan(1))
    history_.push_back({now_ + pose.t, pose.pose, pose.radius});
  now_ += dt;
  const double oldest = now_ - sensing_.age();
  const auto still_seen = std::find_if(history_.begin(), history_.end() - 1,
                                       [&](const PoseStamped& p) { return p.t > oldest; });
  if (still_seen - history_.begin() > 1) history_.erase(history_.begin(), still_seen - 1);
}

bool KinematicPlant::set_obstacles(const std::vector<Obstacle>& obstacles) {
  world_.obstacles = obstacles;
  return true;
}

std::optional<GroundTruth> KinematicPlant::ground_truth() const {
  return GroundTruth{.now = now_,
                     .swarm = swarm_.pose(),
                     .speed = swarm_.speed(),
                     .trajectory = swarm_.trajectory(),
                     .robots = {},
                     .world = &world_};
}

}  // namespace microswarm::experiment
