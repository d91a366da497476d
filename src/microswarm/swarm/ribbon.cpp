// SPDX-License-Identifier: Apache-2.0
#include "microswarm/swarm/ribbon.hpp"

#include <algorithm>
#include <cmath>

#include "microswarm/swarm/unicycle.hpp"

namespace microswarm {

namespace {

// Times nearer than this are the same moment: sums of ticks and lags do not come out even.
constexpr double same_moment = 1e-9;

}  // namespace

Ribbon::Ribbon(const RibbonParams& params, Pose2 start) : params_(params), pose_(start) {}

void Ribbon::step(const Command& command, double dt, Rng& rng) {
  pending_.push_back({command, params_.response_lag});
  swept_.assign(1, {0, pose_});
  double passed = 0;
  while (dt - passed > same_moment) {
    while (!pending_.empty() && pending_.front().due <= same_moment) {
      active_ = pending_.front().command;
      active_.speed = std::clamp(active_.speed, 0.0, params_.max_speed);
      pending_.pop_front();
    }
    const double until_next = pending_.empty() ? dt : pending_.front().due;
    const double piece = std::min({ribbon_substep, dt - passed, until_next});
    advance(piece, rng);
    for (Pending& p : pending_) p.due -= piece;
    passed += piece;
    swept_.push_back({passed, pose_});
  }
  swept_.back().t = dt;
}

void Ribbon::advance(double dt, Rng& rng) {
  pose_ = unicycle_step(pose_, active_, params_.max_turn_rate, dt);
  const double spread = std::sqrt(dt);
  if (params_.position_noise > 0) {
    const double x = rng.normal();
    pose_.position += params_.position_noise * spread * Vec2{x, rng.normal()};
  }
  if (params_.heading_noise > 0)
    pose_.heading = wrap(pose_.heading + params_.heading_noise * spread * rng.normal());
}

}  // namespace microswarm
