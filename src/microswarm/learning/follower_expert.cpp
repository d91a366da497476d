// SPDX-License-Identifier: Apache-2.0
#include "microswarm/learning/follower_expert.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "microswarm/core/maths/angles.hpp"
#include "microswarm/core/maths/maths.hpp"
#include "microswarm/navigation/following/path_follower.hpp"

namespace microswarm::learning {
namespace {

constexpr double tick = 0.1;  // [s]
constexpr int ticks = 15;     // of the preview
constexpr std::array<double, 7> tried_lookaheads{0.06, 0.1, 0.16, 0.25, 0.4, 0.6, 0.9};  // [s]
constexpr std::array<double, 4> shares{1, 0.8, 0.6, 0.4};  // fractions of the speed
// Cost terms besides the mean squared distance from the path, in seconds of travel.
constexpr double slow_weight = 0.02;
constexpr double turn_weight = 0.01;  // of squared turns per tick [1/rad²]
constexpr double softness = 2e-4;     // paths whose costs differ by less have similar weights

SwarmLimits limits(const RibbonParams& swarm) {
  return {.radius = swarm.radius,
          .max_speed = swarm.max_speed,
          .max_turn_rate = swarm.max_turn_rate,
          .response_lag = swarm.response_lag};
}

}  // namespace

FollowerExpert::FollowerExpert(const RibbonParams& swarm, std::span<const Vec2> path, double speed)
    : swarm_(swarm), path_(path), speed_(speed), compensator_(limits(swarm)) {
  last_.heading = heading_along(path[1] - path[0]);
}

void FollowerExpert::note(double now, const Command& command) {
  compensator_.note(now, {command.heading, swarm_.speed_factor * command.speed});
  if (command.speed > 0) last_ = command;
}

Command FollowerExpert::command(const Pose2& pose, double now) {
  Pose2 at_effect = compensator_.at_effect(
      {.now = now, .seen = now, .swarm = SwarmPose{pose, swarm_.radius}, .robots = {}});
  at_effect.position += swarm_.response_lag * swarm_.drift;
  position_ = navigation::nearest_position(path_, at_effect.position, position_);
  std::array<Trial, tried_lookaheads.size() * shares.size()> trials;
  auto trial = trials.begin();
  for (const double lookahead : tried_lookaheads)
    for (const double share : shares) *trial++ = play(at_effect, position_, lookahead, share);
  const Trial& best = *std::min_element(
      trials.begin(), trials.end(), [](const Trial& a, const Trial& b) { return a.cost < b.cost; });
  double sum = 0, off = 0, speed = 0;
  for (const Trial& w : trials) {
    const double weight = maths::exp((best.cost - w.cost) / softness);
    sum += weight;
    off += weight * wrap(w.first.heading - best.first.heading);
    speed += weight * w.first.speed;
  }
  return {wrap(best.first.heading + off / sum), speed / sum};
}

Pose2 FollowerExpert::moved(const Pose2& pose, const Command& command) const {
  Pose2 next = unicycle_step(pose, {command.heading, swarm_.speed_factor * command.speed},
                             swarm_.max_turn_rate, tick);
  next.position += tick * swarm_.drift;
  return next;
}

FollowerExpert::Trial FollowerExpert::play(Pose2 pose, navigation::PathPosition position,
                                           double lookahead, double share) const {
  const double speed = share * speed_;
  const double unit = speed_ * speed_;
  Trial trial{.cost = slow_weight * (1 - share) * (1 - share)};
  double heading = last_.heading;
  for (int k = 0; k < ticks; ++k) {
    Command command = navigation::pursue_in_flow(path_, position, pose, lookahead * speed_,
                                                 swarm_.speed_factor * speed, swarm_.drift);
    command.speed = speed;
    if (k == 0) trial.first = command;
    const double turn = wrap(command.heading - heading);
    heading = command.heading;
    pose = moved(pose, command);
    if (navigation::remaining(path_, position) < tick * speed_) break;
    const navigation::PathPosition now =
        navigation::nearest_position(path_, pose.position, position);
    const double off2 = squared_norm(pose.position - navigation::point_ahead(path_, now, 0));
    trial.cost += (off2 / unit + turn_weight * turn * turn) / ticks;
  }
  return trial;
}

}  // namespace microswarm::learning
