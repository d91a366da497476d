// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/gathering/gather.hpp"

#include <optional>

#include "microswarm/navigation/gathering/crowd.hpp"

namespace microswarm {
namespace {

/// `next` gives the move of a step, or nothing when they are gathered.
template <class Policy, class Next>
GatherResult gather_by(const RobotStepper& stepper, const Policy& policy, Robots& robots,
                       int most_steps, const Stop& stop, Next next) {
  GatherResult result;
  for (;; ++result.steps) {
    const std::optional<Vec2> move = next(result.steps);
    if (move && !stop() && result.steps < most_steps) {
      stepper.step(robots, *move, ContactRule::stop);
      continue;
    }
    result.status = !move ? Status::solved : stop() ? Status::stopped : Status::time_limit;
    result.mean_way = policy.mean_way();
    result.guard_count = policy.guard_count();
    return result;
  }
}

}  // namespace

GatherResult gather(const RobotStepper& stepper, Gatherer& gatherer, Robots& robots, int most_steps,
                    const Stop& stop) {
  constexpr int steps_between_joins = 16;
  Crowd crowd(robots);
  const GatherResult result =
      gather_by(stepper, gatherer, crowd.places(), most_steps, stop, [&](int step) {
        if (step % steps_between_joins == 0)
          if (const auto new_places = crowd.join(); !new_places.empty())
            gatherer.joined(new_places);
        return gatherer.next(crowd.places(), crowd.counts());
      });
  robots = crowd.robots();
  return result;
}

GatherResult gather(const RobotStepper& stepper, RolloutGatherer& gatherer, Robots& robots,
                    int most_steps, const Stop& stop) {
  return gather_by(stepper, gatherer, robots, most_steps, stop,
                   [&](int) { return gatherer.next(robots, stop); });
}

}  // namespace microswarm
