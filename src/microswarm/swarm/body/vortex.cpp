// SPDX-License-Identifier: Apache-2.0
#include "microswarm/swarm/body/vortex.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "microswarm/core/maths/maths.hpp"
#include "microswarm/swarm/body/unicycle.hpp"

namespace microswarm {

namespace {

constexpr double substep = 0.01;    // maximum integration step [s]
constexpr double max_ripples = 2;   // standard deviations
constexpr double min_share = 1e-3;  // of the radius, for any ripple

}  // namespace

double max_radius(const VortexParams& p) {
  return std::max(p.radius, p.moving_radius) + max_ripples * p.radius_ripple;
}

double min_radius(const VortexParams& p) {
  const double least = std::min(p.radius, p.moving_radius);
  return std::max(min_share * least, least - max_ripples * p.radius_ripple);
}

double helix_pitch(const VortexParams& params, const Command& command) {
  return params.max_pitch * std::clamp(command.speed / params.max_speed, 0.0, 1.0);
}

Vortex::Vortex(const VortexParams& params, Pose2 start)
    : params_(params), pose_(start), radius_(params.radius), commands_(params.response_lag) {}

void Vortex::step(const Command& command, double dt, Rng& rng) {
  trajectory_.assign(1, {0, pose_, radius_});
  double passed = 0;
  commands_.pass(command, dt, substep, [&](const Command& active, double piece) {
    active_ = {active.heading,
               helix_pitch(params_, active) / params_.max_pitch * params_.max_speed};
    advance(piece, rng);
    breathe(piece, rng);
    passed += piece;
    trajectory_.push_back({passed, pose_, radius_});
  });
  trajectory_.back().t = dt;
}

void Vortex::advance(double dt, Rng& rng) {
  pose_ = unicycle_step(pose_, active_, std::numeric_limits<double>::infinity(), dt);
  if (params_.position_noise <= 0) return;
  const double spread = params_.position_noise * std::sqrt(dt);
  const double x = rng.normal();
  pose_.position += spread * Vec2{x, rng.normal()};
}

/// Moves the radius towards the value for the current speed, with bounded random ripple.
void Vortex::breathe(double dt, Rng& rng) {
  const double share = active_.speed / params_.max_speed;
  const double aim = params_.radius + share * (params_.moving_radius - params_.radius);
  const double kept = maths::exp(-dt / params_.radius_lag);
  radius_ = aim + kept * (radius_ - aim);
  if (params_.radius_ripple <= 0) return;
  radius_ += params_.radius_ripple * std::sqrt(1 - kept * kept) * rng.normal();
  radius_ = std::clamp(radius_, min_radius(params_), max_radius(params_));
}

}  // namespace microswarm
