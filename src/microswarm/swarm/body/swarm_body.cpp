// SPDX-License-Identifier: Apache-2.0
#include "microswarm/swarm/body/swarm_body.hpp"

#include <limits>

namespace microswarm {

namespace {

SwarmLimits limits(const RibbonParams& p) {
  return {.radius = p.radius,
          .max_speed = p.max_speed,
          .max_turn_rate = p.max_turn_rate,
          .response_lag = p.response_lag};
}

SwarmLimits limits(const VortexParams& p) {
  return {.radius = max_radius(p),
          .max_speed = p.max_speed,
          .max_turn_rate = std::numeric_limits<double>::infinity(),
          .response_lag = p.response_lag,
          .radius_variation = max_radius(p) - min_radius(p)};
}

std::variant<Ribbon, Vortex> made(const RibbonParams& p, Pose2 start) { return Ribbon(p, start); }
std::variant<Ribbon, Vortex> made(const VortexParams& p, Pose2 start) { return Vortex(p, start); }

}  // namespace

SwarmLimits swarm_limits(const SwarmParams& params) {
  return std::visit([](const auto& p) { return limits(p); }, params);
}

SwarmBody::SwarmBody(const SwarmParams& params, Pose2 start)
    : body_(std::visit([&](const auto& p) { return made(p, start); }, params)) {}

SwarmPose SwarmBody::pose() const {
  return std::visit([](const auto& b) { return SwarmPose{b.pose(), b.radius()}; }, body_);
}

double SwarmBody::speed() const {
  return std::visit([](const auto& b) { return b.speed(); }, body_);
}

void SwarmBody::step(const Command& command, double dt, Rng& rng) {
  std::visit([&](auto& b) { b.step(command, dt, rng); }, body_);
}

std::span<const PoseStamped> SwarmBody::trajectory() const {
  return std::visit([](const auto& b) { return b.trajectory(); }, body_);
}

}  // namespace microswarm
