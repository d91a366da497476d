// SPDX-License-Identifier: Apache-2.0
#include "microswarm/learning/follower_tasks.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "microswarm/core/maths/rng.hpp"
#include "microswarm/navigation/following/follower.hpp"
#include "microswarm/world/map/map.hpp"
#include "microswarm/world/world.hpp"

namespace microswarm::learning {
namespace {

/// One step of Chaikin's corner cutting: two points replace each inner point, a quarter of an edge
/// away.
std::vector<Vec2> with_cut_corners(const std::vector<Vec2>& path) {
  std::vector<Vec2> cut{path.front()};
  cut.reserve(2 * path.size());
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    const Vec2 edge = path[i + 1] - path[i];
    if (i > 0) cut.push_back(path[i] + 0.25 * edge);
    if (i + 2 < path.size()) cut.push_back(path[i] + 0.75 * edge);
  }
  cut.push_back(path.back());
  return cut;
}

/// Legs of random lengths within 75° of a main direction, so the path never approaches itself. Half
/// of the paths are rounded.
std::vector<Vec2> random_path(double unit, Rng& rng) {
  constexpr double max_off = 75 * pi / 180;
  const double main = rng.uniform(-pi, pi);
  const auto legs = static_cast<int>(5 + rng.below(5));
  std::vector<Vec2> path{{0, 0}};
  double off = 0;
  for (int i = 0; i < legs; ++i) {
    path.push_back(path.back() + rng.uniform(0.6, 3) * unit * unit_vector(main + off));
    off = std::clamp(off + 0.8 * rng.normal(), -max_off, max_off);
  }
  if (rng.uniform() < 0.5) path = with_cut_corners(with_cut_corners(with_cut_corners(path)));
  return path;
}

Box around(const std::vector<Vec2>& path, double margin) {
  Box box{path.front(), path.front()};
  for (const Vec2 p : path) {
    box.lo = {std::min(box.lo.x, p.x), std::min(box.lo.y, p.y)};
    box.hi = {std::max(box.hi.x, p.x), std::max(box.hi.y, p.y)};
  }
  return {box.lo - Vec2{margin, margin}, box.hi + Vec2{margin, margin}};
}

double total_length(const std::vector<Vec2>& path) { return navigation::remaining(path, {}); }

}  // namespace

FollowerTask follower_task(const FollowerTaskParams& params, std::uint64_t seed,
                           std::uint32_t number) {
  constexpr double at_once = 200 * pi;  // [rad/s]
  Rng rng(seed, Purpose::learning, number);
  const double speed = rng.uniform(params.min_speed, params.max_speed);
  std::vector<Vec2> path = random_path(speed, rng);
  experiment::Scenario s;
  s.name = "follow";
  RibbonParams swarm{.radius = 20, .max_speed = speed};
  swarm.max_turn_rate = rng.uniform(params.min_turn_rate, params.max_turn_rate);
  if (rng.uniform() < params.unlimited_share) swarm.max_turn_rate = at_once;
  swarm.response_lag = rng.uniform(0.05, 0.15);
  const Vec2 flow = unit_vector(rng.uniform(-pi, pi));
  swarm.drift = rng.uniform(0, params.max_flow) * speed * flow;
  swarm.speed_factor = rng.uniform(1 - params.speed_error, 1 + params.speed_error);
  swarm.position_noise = rng.uniform(0, params.random_drift);
  swarm.heading_noise = rng.uniform(0, params.heading_noise);
  s.sensing = {.observation_delay = rng.uniform(0.03, 0.1),
               .position_noise = rng.uniform(0, params.position_noise),
               .heading_noise = rng.uniform(0, params.heading_noise),
               .missed_share = params.missed_share};
  s.swarm = swarm;
  const double turned = rng.normal(), dx = rng.normal(), dy = rng.normal();
  s.start = Pose2{path.front() + params.start_spread * speed * Vec2{dx, dy},
                  wrap(heading_along(path[1] - path[0]) + 0.35 * turned)};
  s.goal = path.back();
  s.goal_tolerance = 10;
  s.time_limit = 3 * total_length(path) / speed + 10;
  s.seed = seed;
  World world{std::make_shared<const Map>(around(path, 10 * speed), std::vector<Polygon>{},
                                          std::vector<Disc>{}, 50),
              {}};
  FollowerTask task{number, std::move(path), std::move(s), std::move(world)};
  task.scenario.navigator = with_follower(task, {}, 0.3).navigator;
  return task;
}

experiment::Scenario with_follower(const FollowerTask& task,
                                   const navigation::FollowerParams& follower,
                                   double lookahead_time) {
  experiment::Scenario scenario = task.scenario;
  navigation::PathNavigatorParams params;
  params.path.assign(task.path.begin(), task.path.end() - 1);
  params.speed = std::get<RibbonParams>(scenario.swarm).max_speed;
  params.lookahead = lookahead_time * params.speed;
  params.follower = follower;
  scenario.navigator = params;
  return scenario;
}

}  // namespace microswarm::learning
