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
      obstacle_noise_(scenario.seed, Purpose::obstacle_sensor, trial),
      history_{{0, *scenario.start, swarm_.pose().radius}} {}

Observation KinematicPlant::observe() {
  const double seen = std::max(0.0, now_ - sensing_.observation_delay);
  Observation observation{.now = now_,
                          .seen = seen,
                          .swarm = {},
                          .robots = {},
                          .world = std::make_shared<const Snapshot>(frame_at(seen))};
  // Always draw the same count, so a missed frame does not change the noise of the next.
  const bool missed = noise_.uniform() < sensing_.missed_share;
  const double dx = noise_.normal(), dy = noise_.normal(), turn = noise_.normal();
  if (missed) return observation;
  const PoseStamped was = moment_on(history_, seen);
  Pose2 pose = was.pose;
  pose.position += sensing_.position_noise * Vec2{dx, dy};
  if (sensing_.heading_noise > 0) pose.heading = wrap(pose.heading + sensing_.heading_noise * turn);
  observation.swarm = SwarmPose{pose, was.radius};
  return observation;
}

// The leaves of a valve are one obstacle: they share missed detections and noise.
Snapshot KinematicPlant::frame_at(double t) {
  Snapshot exact = world_.at(t);
  if (sensing_.obstacle_noise == 0 && sensing_.obstacle_missed_share == 0) return exact;
  std::vector<Body> found;
  std::optional<std::uint32_t> obstacle;
  bool missed = false;
  Vec2 error;
  for (const Body& body : exact.moving().bodies()) {
    if (obstacle != body.obstacle) {
      obstacle = body.obstacle;
      missed = obstacle_noise_.uniform() < sensing_.obstacle_missed_share;
      const double dx = obstacle_noise_.normal(), dy = obstacle_noise_.normal();
      error = sensing_.obstacle_noise * Vec2{dx, dy};
    }
    if (missed) continue;
    found.push_back(body);
    shift(found.back(), error);
  }
  return Snapshot(exact.shared_map(), t, std::move(found));
}

void KinematicPlant::apply(const Command& command, double dt) {
  swarm_.step(command, dt, drift_);
  for (const PoseStamped& pose : swarm_.trajectory().subspan(1))
    history_.push_back({now_ + pose.t, pose.pose, pose.radius});
  now_ += dt;
  const double oldest = now_ - sensing_.observation_delay;
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
