// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/safe_interval/resting_bodies.hpp"

#include <algorithm>
#include <cmath>

namespace microswarm::navigation {
namespace {

/// Uncertainty of a speed, in rest speeds, above which a body cannot be said to rest.
constexpr double certain_share = 2;

bool is_at_rest(const TrackedBody& motion, double rest_speed) {
  if (motion.frames < 2 || motion.velocity_error > certain_share * rest_speed) return false;
  return norm(motion.velocity) <= rest_speed + 2 * motion.velocity_error &&
         std::abs(motion.radius_rate) <= rest_speed && motion.outline_speed <= rest_speed;
}

}  // namespace

RestingBodies::Known& RestingBodies::known(std::uint32_t obstacle, std::uint32_t leaf) {
  const auto at = std::find_if(known_.begin(), known_.end(), [&](const Known& k) {
    return k.obstacle == obstacle && k.leaf == leaf;
  });
  return at != known_.end() ? *at : known_.emplace_back(Known{obstacle, leaf, last_});
}

void RestingBodies::update(std::span<const Body> bodies, const MultiModelPredictor& predictor,
                           double t) {
  if (t < last_) known_.clear();
  last_ = t;
  rests_.assign(bodies.size(), false);
  std::uint32_t leaf = 0;
  for (std::size_t i = 0; i < bodies.size() && i < predictor.size(); ++i) {
    leaf = i > 0 && bodies[i].obstacle == bodies[i - 1].obstacle ? leaf + 1 : 0;
    Known& body = known(bodies[i].obstacle, leaf);
    if (!is_at_rest(predictor.tracked(i), rest_speed_)) body.since = t;
    rests_[i] = t - body.since >= rest_time_;
  }
}

}  // namespace microswarm::navigation
