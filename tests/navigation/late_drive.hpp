// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "microswarm/core/maths/angles.hpp"
#include "microswarm/core/maths/infinity.hpp"
#include "microswarm/core/maths/rng.hpp"
#include "microswarm/swarm/body/unicycle.hpp"
#include "microswarm/world/world.hpp"
#include "tests/navigation/room.hpp"

namespace microswarm::navigation {

inline constexpr SwarmLimits slow_vortex{50, 70, infinity, 0.1};
inline constexpr SwarmLimits slow_ribbon{50, 70, 3, 0.1};

/// A swarm that obeys late in a world that is seen late, and crosses the room.
template <class N>
struct LateDrive {
  std::vector<Polygon> walls{};
  std::vector<Obstacle> obstacles{};
  SwarmLimits swarm = slow_vortex;
  Pose2 pose{{200, 500}, 0};
  typename N::Params params{};
  std::function<bool(int frame)> is_missed{};  ///< whether a frame does not show the swarm
  double noise = 0;           ///< standard deviation of the positions of discs [µm]
  std::uint64_t seed = 1;     ///< of the noise
  double swarm_noise = 0;     ///< of the swarm's positions [µm]
  Vec2 flow{};                ///< that carries the swarm [µm/s]
  double min_gap = infinity;  ///< from edge to edge [µm]
  double time = 0;
  bool arrived = false;
  double turned = 0;  ///< sum of the changes of the commanded heading [rad]
  std::vector<NavigatorState> states{};
  std::vector<Command> commands{};

  bool was(NavigatorState state) const {
    return std::find(states.begin(), states.end(), state) != states.end();
  }

  Snapshot seen_as(Snapshot exact, Rng& rng) const {
    if (noise <= 0) return exact;
    std::vector<Body> bodies(exact.moving().bodies().begin(), exact.moving().bodies().end());
    for (Body& body : bodies)
      if (Disc* disc = std::get_if<Disc>(&body.shape))
        disc->centre = disc->centre + noise * Vec2{rng.normal(), rng.normal()};
    return Snapshot(exact.shared_map(), exact.time(), std::move(bodies));
  }

  void run(double seconds) {
    constexpr double substep = 0.01;
    const World world{std::make_shared<const Map>(Box{{0, 0}, {2000, 1000}}, walls), obstacles};
    N navigator(params, body_task(swarm), Rng(1, Purpose::planner));
    navigator.prepare(world.at(0), {});
    Rng rng(seed, Purpose::obstacle_sensor);
    std::vector<Pose2> was_there(6, pose);
    std::vector<Command> pending(10);
    while (time < seconds && !arrived) {
      const double seen = std::max(0.0, time - 0.05);
      const Snapshot now = seen_as(world.at(seen), rng);
      std::optional<SwarmPose> swarm_seen = SwarmPose{was_there.front(), swarm.radius};
      if (swarm_noise > 0)
        swarm_seen->pose.position += swarm_noise * Vec2{rng.normal(), rng.normal()};
      if (is_missed && is_missed(static_cast<int>(commands.size()))) swarm_seen.reset();
      const Command command = navigator.step(
          {.now = time, .seen = seen, .swarm = swarm_seen, .robots = {}, .world = borrowed(now)},
          {});
      if (!commands.empty()) turned += turn_between(command.heading, commands.back().heading);
      commands.push_back(command);
      states.push_back(navigator.view().state);
      for (int k = 0; k < 10; ++k, time += substep) {
        pending.push_back(command);
        pose = unicycle_step(pose, pending.front(), swarm.max_turn_rate, substep);
        pose.position += substep * flow;
        pending.erase(pending.begin());
        was_there.push_back(pose);
        was_there.erase(was_there.begin());
        min_gap =
            std::min(min_gap, world.at(time + substep).clearance(pose.position) - swarm.radius);
      }
      arrived = distance(pose.position, room_goal) <= room_tolerance;
    }
  }
};

}  // namespace microswarm::navigation
