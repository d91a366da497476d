// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/gathering/gather.hpp"

#include <optional>

#include "microswarm/navigation/gathering/policies/merged_robots.hpp"

namespace microswarm::navigation {
namespace {

/// `next` gives the move of a step, or nothing when they are gathered.
template <class Policy, class Next>
GatherResult gather_by(const CommonInput& input, const Policy& policy, Robots& robots,
                       int max_steps, const Stop& stop, Next next) {
  GatherResult result;
  for (;; ++result.steps) {
    const std::optional<Vec2> move = next(result.steps);
    if (move && !stop() && result.steps < max_steps) {
      input.step(robots, *move);
      continue;
    }
    result.status = !move ? Status::solved : stop() ? Status::stopped : Status::time_limit;
    result.mean_distance = policy.mean_distance();
    result.guard_count = policy.guard_count();
    return result;
  }
}

}  // namespace

GatherResult gather(const CommonInput& input, AggregationPolicy& policy, Robots& robots,
                    int max_steps, const Stop& stop) {
  constexpr int steps_between_joins = 16;
  MergedRobots merged(robots);
  const GatherResult result =
      gather_by(input, policy, merged.positions(), max_steps, stop, [&](int step) {
        if (step % steps_between_joins == 0)
          if (const auto new_places = merged.merge_coincident(); !new_places.empty())
            policy.remap(new_places);
        return policy.next(merged.positions(), merged.counts());
      });
  robots = merged.robots();
  return result;
}

GatherResult gather(const CommonInput& input, RolloutPolicy& policy, Robots& robots, int max_steps,
                    const Stop& stop) {
  return gather_by(input, policy, robots, max_steps, stop,
                   [&](int) { return policy.next(robots, stop); });
}

}  // namespace microswarm::navigation
