// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/prediction/obstacle_memory.hpp"

#include <algorithm>

namespace microswarm::navigation {
namespace {

bool holds(std::span<const Body> bodies, std::uint32_t obstacle) {
  return std::any_of(bodies.begin(), bodies.end(),
                     [&](const Body& body) { return body.obstacle == obstacle; });
}

}  // namespace

Observation ObstacleMemory::complete(const Observation& observation) {
  if (!observation.world || memory_ <= 0) return observation;
  const auto bodies = observation.world->moving().bodies();
  if (observation.seen < tracker_.seen()) {
    found_.clear();
    lost_.clear();
  }
  if (observation.seen != tracker_.seen()) {
    look_for_lost(bodies, observation.seen);
    tracker_.update(observation);
    found_.assign(bodies.begin(), bodies.end());
  }
  if (lost_.empty()) return observation;
  std::vector<Body> all(bodies.begin(), bodies.end());
  for (const Lost& lost : lost_) {
    all.push_back(lost.body);
    shift(all.back(), (observation.seen - lost.seen) * lost.velocity);
  }
  Observation out = observation;
  out.world = std::make_shared<const Snapshot>(observation.world->shared_map(),
                                               observation.world->time(), std::move(all));
  return out;
}

void ObstacleMemory::look_for_lost(std::span<const Body> bodies, double seen) {
  const bool alike =
      std::equal(bodies.begin(), bodies.end(), found_.begin(), found_.end(),
                 [](const Body& a, const Body& b) { return a.obstacle == b.obstacle; });
  for (std::size_t i = 0; i < found_.size() && !alike; ++i)
    if (!holds(bodies, found_[i].obstacle))
      lost_.push_back({found_[i], tracker_.body(i).velocity, tracker_.seen()});
  std::erase_if(lost_, [&](const Lost& lost) {
    return seen - lost.seen > memory_ || holds(bodies, lost.body.obstacle);
  });
}

}  // namespace microswarm::navigation
