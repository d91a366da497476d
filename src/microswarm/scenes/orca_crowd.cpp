// SPDX-License-Identifier: Apache-2.0
#include "microswarm/scenes/orca_crowd.hpp"

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "microswarm/core/maths/angles.hpp"
#include "microswarm/core/maths/maths.hpp"
#include "microswarm/core/maths/rng.hpp"
#include "microswarm/scenes/orca.hpp"

namespace microswarm::scenes {
namespace {

// Lengths in µm, at 100 µm for a metre.
constexpr int people = 5;
constexpr double person_radius = 30, person_speed = 100;
constexpr double circle_radius = 400;
constexpr double apart = 20;                          // at the start, beside the radii
constexpr double orca_margin = 1;                     // added to a radius
constexpr double orca_horizon = 5, orca_step = 0.25;  // [s]
constexpr double crossing_limit = 25;                 // [s]
constexpr Vec2 robot_start{0, -circle_radius}, robot_goal{0, circle_radius};

struct Person {
  OrcaAgent agent{};
  Vec2 goal{};
  Samples track{};
};

/// People on the circle, each away from the others and from the robot, as are their goals.
std::vector<Person> placed_people(Rng& rng) {
  std::vector<Person> all;
  while (all.size() < people) {
    const double angle = rng.uniform(0, 2 * pi);
    const Vec2 noise = person_speed * Vec2{rng.uniform(-0.5, 0.5), rng.uniform(-0.5, 0.5)};
    const Vec2 at = circle_radius * Vec2{maths::cos(angle), maths::sin(angle)} + noise;
    constexpr double least = 2 * person_radius + apart;
    const auto is_free = [&](Vec2 start, Vec2 goal) {
      return distance(at, start) >= least && distance(at, goal) >= least;
    };
    const bool fits = is_free(robot_start, robot_goal) &&
                      std::ranges::all_of(
                          all, [&](const Person& p) { return is_free(p.agent.position, p.goal); });
    if (!fits) continue;
    all.push_back(
        {{.position = at, .radius = person_radius + orca_margin, .max_speed = person_speed},
         -at,
         {}});
  }
  return all;
}

void walk(std::vector<Person>& all) {
  std::vector<OrcaAgent> agents(all.size());
  const int steps = static_cast<int>(crossing_limit / orca_step) + 4;
  for (int k = 0; k <= steps; ++k) {
    for (std::size_t i = 0; i < all.size(); ++i) {
      Person& p = all[i];
      p.track.times.push_back(orca_step * k);
      p.track.points.push_back(p.agent.position);
      const Vec2 left = p.goal - p.agent.position;
      p.agent.preferred = norm(left) > person_speed ? person_speed / norm(left) * left : left;
      agents[i] = p.agent;
    }
    const std::vector<Vec2> velocities = orca_velocities(agents, orca_horizon, orca_step);
    for (std::size_t i = 0; i < all.size(); ++i) {
      all[i].agent.velocity = velocities[i];
      all[i].agent.position += orca_step * velocities[i];
    }
  }
}

}  // namespace

experiment::Scenario orca_crowd_scenario(std::uint64_t seed) {
  Rng rng(seed, Purpose::scene);
  std::vector<Person> all = placed_people(rng);
  walk(all);
  experiment::Scenario s;
  formats::PolygonsMap map;
  map.lo = {-700, -700};
  map.hi = {700, 700};
  s.map = std::move(map);
  s.swarm = VortexParams{
      .radius = person_radius, .moving_radius = person_radius, .max_speed = person_speed};
  s.start = Pose2{robot_start, pi / 2};
  s.goal = robot_goal;
  s.goal_tolerance = person_radius;
  s.time_limit = crossing_limit;
  s.hold_limit = crossing_limit;
  s.seed = seed;
  for (Person& p : all) {
    Track track{"people.csv", std::to_string(s.obstacles.size() + 1), {}};
    track.samples = std::make_shared<const Samples>(std::move(p.track));
    s.obstacles.push_back({DiscShape{person_radius}, std::move(track)});
  }
  return s;
}

}  // namespace microswarm::scenes
