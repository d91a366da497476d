// SPDX-License-Identifier: Apache-2.0
#include "microswarm/swarm/body/ribbon.hpp"

#include <algorithm>
#include <cmath>

#include "microswarm/swarm/body/unicycle.hpp"

namespace microswarm {

Ribbon::Ribbon(const RibbonParams& params, Pose2 start)
    : params_(params), pose_(start), commands_(params.response_lag) {}

void Ribbon::step(const Command& command, double dt, Rng& rng) {
  trajectory_.assign(1, {0, pose_, params_.radius});
  double passed = 0;
  commands_.pass(command, dt, ribbon_substep, [&](const Command& active, double piece) {
    const double speed = std::clamp(active.speed, 0.0, params_.max_speed);
    active_ = {active.heading, params_.speed_factor * speed};
    advance(piece, rng);
    passed += piece;
    trajectory_.push_back({passed, pose_, params_.radius});
  });
  trajectory_.back().t = dt;
}

void Ribbon::advance(double dt, Rng& rng) {
  pose_ = unicycle_step(pose_, active_, params_.max_turn_rate, dt);
  if (!(params_.drift == Vec2{})) pose_.position += dt * params_.drift;
  const double spread = std::sqrt(dt);
  if (params_.position_noise > 0) {
    const double x = rng.normal();
    pose_.position += params_.position_noise * spread * Vec2{x, rng.normal()};
  }
  if (params_.heading_noise > 0)
    pose_.heading = wrap(pose_.heading + params_.heading_noise * spread * rng.normal());
}

}  // namespace microswarm
