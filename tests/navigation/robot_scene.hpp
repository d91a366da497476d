// SPDX-License-Identifier: Apache-2.0
// Individually tracked robots under a navigator, seen some ticks late.
#pragma once

#include <algorithm>
#include <deque>
#include <memory>
#include <utility>
#include <vector>

#include "microswarm/contracts/observation.hpp"
#include "microswarm/swarm/robots/robot_swarm.hpp"

namespace microswarm::test {

struct RobotScene {
  Map map;
  RobotSwarmParams params;
  std::size_t delay_ticks;
  double tick;
  double now;
  Snapshot world;
  Rng rng{5, Purpose::plant};
  RobotSwarm swarm;
  std::deque<std::vector<Vec2>> history;

  RobotScene(Map m, const RobotSwarmParams& p, const std::vector<Vec2>& starts, std::size_t delay,
             double tick_length = 0.1, double begin = 0)
      : map(std::move(m)),
        params(p),
        delay_ticks(delay),
        tick(tick_length),
        now(begin),
        world(std::make_shared<const Map>(map)),
        swarm(p, RobotStepper(map, p.max_speed * tick), starts, rng),
        history{places()} {}

  std::vector<Vec2> places() const { return swarm.robots().positions(); }
  Observation observe() const {
    const auto ticks = static_cast<double>(history.size() - 1);
    return {.now = now,
            .seen = now - ticks * tick,
            .swarm = SwarmPose{},
            .robots = history.front(),
            .world = borrowed(world)};
  }
  void apply(const Command& command) {
    swarm.step(command, tick, rng);
    now += tick;
    history.push_back(places());
    if (history.size() > delay_ticks + 1) history.pop_front();
  }
  /// Distance [µm] of the robot that is farthest from its own goal.
  double worst() const {
    double w = 0;
    for (std::size_t i = 0; i < params.goals.size(); ++i)
      w = std::max(w, distance(swarm.robots().position(i), params.goals[i]));
    return w;
  }
};

}  // namespace microswarm::test
