// SPDX-License-Identifier: Apache-2.0
// What a navigator avoids, it avoids late too: frames are old, commands take effect later, and
// between two of them everything moves on.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <deque>

#include "microswarm/core/maths/infinity.hpp"
#include "microswarm/navigation/make.hpp"
#include "microswarm/swarm/body/unicycle.hpp"
#include "microswarm/world/snapshot.hpp"
#include "tests/laws/body_navigators.hpp"

namespace microswarm {
namespace {

constexpr double substep = 0.025;  // [s]
constexpr SwarmLimits delayed_swarm{.radius = 30, .max_speed = 70, .max_turn_rate = infinity};

/// Discs that meet the swarm on its straight path, and grow. Positions are pure in t.
struct Approach {
  std::shared_ptr<const Map> map =
      std::make_shared<const Map>(Box{{0, 0}, {1200, 800}}, std::vector<Polygon>{});
  Vec2 start, goal;
  struct Disc {
    Vec2 from, velocity;
    double radius, growth;
  };
  std::vector<Disc> discs;

  Snapshot at(double t) const {
    std::vector<Body> bodies;
    for (std::size_t i = 0; i < discs.size(); ++i) {
      const Disc& d = discs[i];
      bodies.push_back({.shape = microswarm::Disc{d.from + t * d.velocity, d.radius + t * d.growth},
                        .obstacle = static_cast<std::uint32_t>(i)});
    }
    return Snapshot(map, t, std::move(bodies));
  }
};

Approach random_approach(std::uint32_t trial) {
  Rng rng(36, Purpose::scene, trial);
  Approach scene;
  scene.start = {120, rng.uniform(250, 550)};
  scene.goal = {820, rng.uniform(250, 550)};
  const Vec2 ahead = unit_vector(heading_along(scene.goal - scene.start));
  for (int i = 0; i < 8; ++i) {
    const double meets_at = rng.uniform(2.5, 9);  // [s]
    const Vec2 velocity = rng.uniform(20, 60) * unit_vector(rng.uniform(-pi, pi));
    const Vec2 where = scene.start + meets_at * delayed_swarm.max_speed * ahead;
    scene.discs.push_back({where - meets_at * velocity, velocity, rng.uniform(15, 60),
                           rng.uniform(0, 1) < 0.5 ? rng.uniform(1, 15) : 0});
  }
  return scene;
}

struct Timing {
  double tick = 0.1;
  double age = 0;  ///< of a frame
  double lag = 0;  ///< of a command
};

/// Whether the swarm touches a disc within 12 s, or until it arrives.
bool touches(const Approach& scene, const navigation::NavigatorParams& params,
             const Timing& timing) {
  SwarmLimits limits = delayed_swarm;
  limits.response_lag = timing.lag;
  const navigation::Task task{
      .swarm = limits, .robots = {}, .goal = scene.goal, .goal_tolerance = 20, .tick = timing.tick};
  const auto navigator = navigation::make_navigator(params, task, Rng(1, Purpose::planner));
  navigator->prepare(scene.at(0), {});
  const auto steps = [](double seconds) {
    return static_cast<std::size_t>(std::lround(seconds / substep));
  };
  std::deque<Pose2> was(steps(timing.age) + 1, {scene.start, 0});
  std::deque<Command> pending(steps(timing.lag));
  Command command;
  for (std::size_t k = 0; k < steps(12); ++k) {
    const double now = static_cast<double>(k) * substep;
    if (k % steps(timing.tick) == 0) {
      const double seen = std::max(0.0, now - timing.age);
      const Snapshot world = scene.at(seen);
      command = navigator->step({.now = now,
                                 .seen = seen,
                                 .swarm = SwarmPose{was.front(), limits.radius},
                                 .robots = {},
                                 .world = borrowed(world)},
                                {});
    }
    pending.push_back(command);
    was.push_back(unicycle_step(was.back(), pending.front(), infinity, substep));
    pending.pop_front();
    was.pop_front();
    const Vec2 p = was.back().position;
    for (const Approach::Disc& d : scene.discs) {
      const double t = now + substep;
      if (distance(p, d.from + t * d.velocity) < d.radius + t * d.growth + limits.radius)
        return true;
    }
    if (distance(p, scene.goal) <= 20) return false;
  }
  return false;
}

class NavigatorDelayLaws : public testing::TestWithParam<BodyNavigator> {};

TEST_P(NavigatorDelayLaws, DelayCostsNoContact) {
  constexpr std::array late{Timing{0.05, 0, 0.4},  Timing{0.1, 0.1, 0.3},   Timing{0.2, 0, 0.4},
                            Timing{0.3, 0.2, 0.0}, Timing{0.1, 0.05, 0.05}, Timing{0.2, 0.1, 0.2}};
  int avoided = 0;
  int touched = 0;
  for (std::uint32_t trial = 0; trial < 24; ++trial) {
    const Approach scene = random_approach(trial);
    const Timing timing = late[trial % late.size()];
    if (touches(scene, GetParam().params, {.tick = timing.tick})) continue;
    ++avoided;
    touched += touches(scene, GetParam().params, timing);
  }
  RecordProperty("avoided", avoided);
  RecordProperty("touched", touched);
  EXPECT_GT(avoided, 0);
  EXPECT_LE(touched, GetParam().late_contacts * avoided) << "of " << avoided;
  if (GetParam().late_contacts == 1) {
    EXPECT_GT(touched, 0.2 * avoided) << "it compensates no delay, or the discs are too few";
  }
}

INSTANTIATE_TEST_SUITE_P(All, NavigatorDelayLaws, testing::ValuesIn(body_navigators()),
                         [](const auto& c) { return c.param.name; });

}  // namespace
}  // namespace microswarm
