// SPDX-License-Identifier: Apache-2.0
#include "microswarm/swarm/robots/robot_swarm.hpp"

#include <algorithm>
#include <cmath>

#include "microswarm/core/maths/maths.hpp"

namespace microswarm {

SwarmPose enclosing_pose(std::span<const Vec2> robots, double heading) {
  Vec2 sum{};
  for (const Vec2 p : robots) sum += p;
  const Vec2 middle = sum / static_cast<double>(robots.size());
  double squares = 0;
  for (const Vec2 p : robots) squares += squared_norm(p - middle);
  return {{middle, heading}, std::sqrt(squares / static_cast<double>(robots.size()))};
}

RobotSwarm::RobotSwarm(const RobotSwarmParams& params, RobotStepper stepper,
                       std::span<const Vec2> starts, Rng& rng)
    : params_(params),
      stepper_(std::move(stepper)),
      robots_(stepper_.place(starts)),
      commands_(params.response_lag) {
  const bool alike = params.speed_spread == 0 && params.heading_noise == 0 &&
                     params.position_noise == 0 && params.sticking_interval == 0;
  if (alike) return;
  stuck_for_.assign(starts.size(), 0);
  for (std::size_t i = 0; i < starts.size(); ++i)
    own_speed_.push_back(std::clamp(1 + params.speed_spread * rng.normal(), 0.1, 3.0));
}

void RobotSwarm::step(const Command& command, double dt, Rng& rng) {
  commands_.pass(command, dt, dt, [&](Command active, double piece) {
    active.speed = std::clamp(active.speed, 0.0, params_.max_speed);
    own_speed_.empty() ? stepper_.step(robots_, displacement(active, piece), params_.contact)
                       : advance_each(active, piece, rng);
  });
}

// The number of draws is constant, so that one robot's noise does not change another's.
void RobotSwarm::advance_each(const Command& command, double dt, Rng& rng) {
  for (std::size_t i = 0; i < own_speed_.size(); ++i) {
    const double turn = rng.normal(), dx = rng.normal(), dy = rng.normal();
    if (stuck(i, dt, rng)) continue;
    Vec2 move = displacement(
        {command.heading + params_.heading_noise * turn, own_speed_[i] * command.speed}, dt);
    move += params_.position_noise * std::sqrt(dt) * Vec2{dx, dy};
    const PointF at =
        stepper_.moved({robots_.x[i], robots_.y[i]},
                       {static_cast<float>(move.x), static_cast<float>(move.y)}, params_.contact);
    robots_.x[i] = at.x;
    robots_.y[i] = at.y;
  }
}

bool RobotSwarm::stuck(std::size_t robot, double dt, Rng& rng) {
  const double chance = rng.uniform(), how_long = rng.uniform();
  double& left = stuck_for_[robot];
  if (left <= 0 && params_.sticking_interval > 0 &&
      chance < -maths::expm1(-dt / params_.sticking_interval))
    left = -params_.sticking_time * maths::log1p(-how_long);
  if (left <= 0) return false;
  left -= dt;
  return true;
}

}  // namespace microswarm
