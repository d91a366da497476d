// SPDX-License-Identifier: Apache-2.0
#include "microswarm/scenes/avoidance_worlds.hpp"
#include "microswarm/experiment/scenario/scene.hpp"
#include "microswarm/swarm/body/swarm_body.hpp"
#include "microswarm/world/world.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "microswarm/core/maths/angles.hpp"
#include "microswarm/geometry/distance.hpp"
#include "microswarm/scenes/avoidance_movers.hpp"

namespace microswarm::scenes {
namespace {

constexpr double look = 0.5;           // time step for checking a mover's motion [s]
constexpr double looked_at = 120;      // duration of the check [s]
constexpr double off_walls = 5;        // clearance of crossing obstacles [µm]
constexpr int tries_each = 15;         // attempts per fair obstacle
constexpr double goal_tolerance = 30;  // [µm]

VortexParams random_vortex(Rng& rng) {
  VortexParams swarm;
  swarm.radius = rng.uniform(35, 55);
  swarm.moving_radius = swarm.radius * rng.uniform(0.85, 1.15);
  swarm.radius_ripple = rng.uniform(0, 0.5);
  swarm.max_speed = rng.uniform(60, 100);
  swarm.position_noise = rng.uniform(0, 1.5);
  return swarm;
}

SwarmParams random_swarm(Hardship hardship, Rng& rng) {
  const VortexParams vortex = random_vortex(rng);
  if (hardship != Hardship::turn_limit && hardship != Hardship::drift) return vortex;
  RibbonParams ribbon{.radius = vortex.radius,
                      .max_speed = vortex.max_speed,
                      .position_noise = vortex.position_noise};
  if (hardship == Hardship::turn_limit) {
    ribbon.max_turn_rate = rng.uniform(1.5, 4);
  } else {
    ribbon.max_turn_rate = 2 * pi;
    const Vec2 downstream = unit_vector(rng.uniform(-pi, pi));
    ribbon.drift = rng.uniform(5, 15) * downstream;
    ribbon.speed_factor = rng.uniform(0.85, 1);
  }
  return ribbon;
}

/// Makes the sight worse, if that is the hardship.
void worsen(Hardship hardship, experiment::SensingParams& sensing, Rng& rng) {
  if (hardship == Hardship::lost_sight) {
    sensing.missed_share = rng.uniform(0.02, 0.1);
    sensing.obstacle_missed_share = rng.uniform(0.05, 0.2);
    sensing.missed_time = rng.uniform(0.1, 0.3);
  } else if (hardship == Hardship::mistaken_identity) {
    sensing.obstacle_noise = rng.uniform(0, 2);
    sensing.swapped_share = rng.uniform(0.05, 0.3);
  } else if (hardship == Hardship::hidden_delay) {
    sensing.hidden_delay = rng.uniform(0.05, 0.25);
  }
}

experiment::SensingParams random_sensing(Rng& rng) {
  experiment::SensingParams sensing;
  sensing.position_noise = rng.uniform(0, 2);
  sensing.heading_noise = rng.uniform(0, 0.05);
  sensing.missed_share = rng.uniform(0, 0.05);
  return sensing;
}

/// Accepts only obstacles that leave a fair world.
class Referee {
 public:
  Referee(const Ground& ground, const Map& walls, const Crosser& swarm, double swarm_radius)
      : ground_(ground),
        walls_(walls),
        passage_(2 * swarm.half_passage),
        radius_(swarm_radius),
        goal_busy_(static_cast<std::size_t>(looked_at / look), false) {}

  bool accepts(const Mover& mover) {
    if (!starts_apart(mover.obstacle)) return false;
    if (mover.rests && !leaves_passages(mover)) return false;
    std::vector<bool> busy = goal_busy_;
    for (std::size_t i = 0; i < busy.size(); ++i) {
      const double t = look * static_cast<double>(i);
      const Placement at = placement(mover.obstacle.motion, t);
      if (!at.present) continue;
      if (!keeps_off_walls(mover, at.pose.position)) return false;
      busy[i] = busy[i] || gap(mover.obstacle, t, ground_.goal) <
                               radius_ + goal_tolerance + avoidance_passage_gap;
    }
    const auto count = std::count(busy.begin(), busy.end(), true);
    if (static_cast<double>(count) > avoidance_goal_busy * static_cast<double>(busy.size()))
      return false;
    goal_busy_ = std::move(busy);
    if (mover.rests) resting_.push_back({position(mover), mover.extent});
    return true;
  }

 private:
  static Vec2 position(const Mover& mover) {
    return placement(mover.obstacle.motion, 0).pose.position;
  }

  static double gap(const Obstacle& obstacle, double t, Vec2 p) {
    std::vector<Body> bodies;
    append_bodies(obstacle, 0, t, bodies);
    double least = std::numeric_limits<double>::infinity();
    for (const Body& body : bodies) least = std::min(least, distance(p, body));
    return least;
  }

  bool starts_apart(const Obstacle& obstacle) const {
    return gap(obstacle, 0, ground_.start) >= radius_ + avoidance_start_gap + top_speed(obstacle);
  }

  bool leaves_passages(const Mover& mover) const {
    const Vec2 p = position(mover);
    if (distance(p, ground_.goal) < mover.extent + passage_) return false;
    if (walls_.border_clearance(p) < mover.extent + passage_) return false;
    return std::none_of(resting_.begin(), resting_.end(), [&](const Disc& other) {
      return distance(p, other.centre) < other.radius + mover.extent + passage_;
    });
  }

  bool keeps_off_walls(const Mover& mover, Vec2 p) const {
    if (!walls_.bounds().contains(p)) return mover.passes && !ground_.enclosed;
    const double room = ground_.lanes.empty() ? walls_.wall_clearance(p) : lane_room(p);
    return room >= mover.extent + (mover.passes ? off_walls : passage_);
  }

  /// Lower bound of the distance from p to the moving walls.
  double lane_room(Vec2 p) const {
    double off = std::numeric_limits<double>::infinity();
    for (const std::vector<Vec2>& lane : ground_.lanes)
      for (std::size_t i = 1; i < lane.size(); ++i)
        off = std::min(off, distance(p, Segment{lane[i - 1], lane[i]}));
    return ground_.lane_room - off;
  }

  const Ground& ground_;
  const Map& walls_;
  double passage_;
  double radius_;
  std::vector<Disc> resting_;
  std::vector<bool> goal_busy_;
};

Ground random_ground(const AvoidanceOptions& options, const Crosser& swarm, int obstacles,
                     Rng& rng) {
  if (options.hardship == Hardship::dead_ends) return dead_end_ground(swarm, rng);
  if (options.hardship == Hardship::blocked_gates) return blocked_ground(swarm, rng);
  if (options.hardship == Hardship::narrow_lanes)
    return narrow_ground(
        swarm, swarm.half_passage - avoidance_passage_gap + passage_gap(options.hardship), rng);
  if (!options.walls) return open_ground(swarm, obstacles, rng);
  const double slow = std::min(0.9, options.max_speed_ratio);
  const std::uint64_t kind = rng.below(20);
  if (kind < 8) return scattered_ground(swarm, obstacles, rng);
  if (kind < 13) return gated_ground(swarm, slow * rng.uniform(0.3, 1), rng);
  if (kind < 19) return vessel_ground(swarm, rng);
  return channel_ground(swarm, slow * rng.uniform(0.3, 1), rng);
}

}  // namespace

experiment::Scenario avoidance_scenario(std::uint64_t seed, const AvoidanceOptions& options) {
  Rng rng(seed, Purpose::scene);
  experiment::Scenario s;
  s.swarm = random_swarm(options.hardship, rng);
  s.sensing = random_sensing(rng);
  worsen(options.hardship, s.sensing, rng);
  s.seed = seed;
  const SwarmLimits swarm = swarm_limits(s.swarm);
  const double radius = swarm.radius;
  const Crosser crosser{radius + avoidance_passage_gap, swarm.max_speed};
  const auto most = static_cast<std::uint64_t>(options.max_obstacles);
  const int asked = 1 + static_cast<int>(rng.below(most));
  const Ground ground = random_ground(options, crosser, asked, rng);
  s.map = ground.map;
  s.obstacles = ground.fixtures;
  s.start = Pose2{ground.start, heading_along(ground.goal - ground.start)};
  s.goal = ground.goal;
  s.goal_tolerance = goal_tolerance;
  s.time_limit = 60 + 5 * distance(ground.start, ground.goal) / swarm.max_speed;
  s.hold_limit = s.time_limit;
  s.stop_at_contact = false;
  s.detection_range = avoidance_detection_range;

  // A coarse field suffices for the few queries here.
  constexpr double field_cell = 50;
  const formats::MapParts parts = formats::read_map_parts(s.map);
  const Map walls(parts.bounds, parts.walls, parts.discs, field_cell);
  Referee referee(ground, walls, crosser, radius);
  for (int i = 0; i < asked; ++i) {
    for (int k = 0; k < tries_each; ++k) {
      const double ratio = rng.uniform(options.min_speed_ratio, options.max_speed_ratio);
      Mover mover =
          random_mover(ground, crosser, ratio, options.min_speed_ratio < 1, s.time_limit, rng);
      if (!options.turn_at_once) limit_turns(mover, s.time_limit);
      if (!referee.accepts(mover)) continue;
      s.obstacles.push_back(std::move(mover.obstacle));
      break;
    }
  }
  return s;
}

AvoidanceOptions hardship_options(Hardship hardship, std::uint64_t seed) {
  return {.walls = seed % 2 == 1, .turn_at_once = false, .hardship = hardship};
}

void see_obstacles_with_noise(experiment::Scenario& scenario) {
  constexpr std::uint32_t sight = 1;  // separate from the world's stream
  Rng rng(scenario.seed, Purpose::scene, sight);
  scenario.sensing.obstacle_noise = rng.uniform(0, 2);
  scenario.sensing.obstacle_missed_share = rng.uniform(0, 0.05);
}

World avoidance_world(const experiment::Scenario& scenario) {
  return experiment::build_world({scenario, formats::read_map_parts(scenario.map)});
}

}  // namespace microswarm::scenes
