// SPDX-License-Identifier: Apache-2.0
#include "microswarm/scenes/avoidance_movers.hpp"

#include <algorithm>
#include <cmath>

#include "microswarm/core/fields/overloaded.hpp"
#include "microswarm/core/maths/angles.hpp"
#include "microswarm/core/maths/maths.hpp"

namespace microswarm::scenes {
namespace {

/// Random position of a mover: anywhere, or near a lane.
Vec2 random_place(const Ground& ground, Rng& rng) {
  if (ground.lanes.empty()) {
    const double x = rng.uniform(0, ground.map.hi.x);
    return {x, rng.uniform(0, ground.map.hi.y)};
  }
  const std::vector<Vec2>& lane = ground.lanes[rng.below(ground.lanes.size())];
  const std::size_t leg = rng.below(lane.size() - 1);
  const double share = rng.uniform();
  const Vec2 direction = unit_vector(rng.uniform(-pi, pi));
  const Vec2 aside = 0.4 * ground.lane_room * rng.uniform() * direction;
  return (1 - share) * lane[leg] + share * lane[leg + 1] + aside;
}

// Shapes; their pace is set later.

PolygonShape random_polygon(double extent, Rng& rng) {
  PolygonShape shape;
  const int corners = 3 + static_cast<int>(rng.below(6));
  for (int k = 0; k < corners; ++k)
    shape.vertices.push_back(extent * rng.uniform(0.5, 1) * unit_vector(2 * pi * k / corners));
  return shape;
}

Shape random_shape(double most, double& extent, Rng& rng) {
  const std::uint64_t kind = rng.below(10);
  extent = most * rng.uniform(0.35, 1);
  if (kind < 3) return DiscShape{extent};
  if (kind < 5)
    return BreathingDisc{
        .min_radius = extent * rng.uniform(0.4, 0.8), .max_radius = extent, .phase = rng.uniform()};
  if (kind < 7) {
    const double slant = rng.uniform(0.25, 1.3);
    const Vec2 half = extent * unit_vector(slant);
    return BoxShape{2 * half.x, 2 * half.y};
  }
  if (kind < 9) return random_polygon(extent, rng);
  const double span = 2 * extent;
  return Valve{.span = span,
               .thickness = 0.15 * span,
               .min_gap = rng.uniform(0, 0.3) * span,
               .max_gap = rng.uniform(0.5, 0.9) * span,
               .phase = rng.uniform()};
}

// Motions; their pace is set later.

HarmonicLine random_line(const Ground& ground, Rng& rng) {
  HarmonicLine line{.centre = random_place(ground, rng), .phase = rng.uniform()};
  const Vec2 direction = unit_vector(rng.uniform(-pi, pi));
  line.amplitude = rng.uniform(120, 450) * direction;
  return line;
}

HarmonicArc random_arc(const Ground& ground, Rng& rng) {
  return {.pivot = random_place(ground, rng),
          .radius = rng.uniform(120, 400),
          .middle = rng.uniform(-pi, pi),
          .half_angle = rng.uniform(0.5, 2.5),
          .phase = rng.uniform()};
}

Waypoints random_waypoints(const Ground& ground, Rng& rng) {
  Waypoints waypoints;
  if (!ground.lanes.empty()) {
    waypoints.points = ground.lanes[rng.below(ground.lanes.size())];
    if (rng.below(2) == 1) std::reverse(waypoints.points.begin(), waypoints.points.end());
    return waypoints;
  }
  const std::size_t count = 2 + rng.below(4);
  while (waypoints.points.size() < count) waypoints.points.push_back(random_place(ground, rng));
  waypoints.at_end = rng.below(2) == 0 ? AtEnd::back : AtEnd::loop;
  return waypoints;
}

/// Passes near the straight path of the swarm at a time when the swarm may be there.
Straight random_passage(const Ground& ground, const Crosser& swarm, double speed, Rng& rng) {
  const Vec2 line = ground.goal - ground.start;
  const double share = rng.uniform(0.1, 1);
  const double arrival = share * norm(line) / swarm.speed * rng.uniform(0.9, 1.5);
  const Vec2 aside =
      3 * swarm.half_passage * rng.uniform(-1, 1) * unit_vector(heading_along(line) + pi / 2);
  const Vec2 velocity = speed * unit_vector(rng.uniform(-pi, pi));
  return {.start = ground.start + share * line + aside - arrival * velocity, .velocity = velocity};
}

Track track_of(Samples samples) {
  Track track;
  track.samples = std::make_shared<const Samples>(std::move(samples));
  return track;
}

/// Random walk with a varying heading that turns back at the border.
Track random_walk(const Ground& ground, double speed, double time_limit, Rng& rng) {
  constexpr double step = 0.5;  // [s]
  const Vec2 middle = 0.5 * ground.map.hi;
  const double reach = 0.45 * std::min(ground.map.hi.x, ground.map.hi.y);
  Samples samples;
  Vec2 position = random_place(ground, rng);
  double heading = rng.uniform(-pi, pi);
  for (double t = -1; t < time_limit + 2; t += step) {
    samples.times.push_back(t);
    samples.points.push_back(position);
    heading += 0.25 * rng.normal();
    if (distance(position, middle) > reach) {
      const double back = wrap(heading_along(middle - position) - heading);
      heading += std::clamp(back, -0.4, 0.4);
    }
    position += step * speed * unit_vector(heading);
  }
  return track_of(std::move(samples));
}

/// Heads for one point after the other, as fast as the waypoints.
Track turning_track(const Waypoints& way, double time_limit) {
  constexpr double step = 0.25, turn_rate = 1.5;  // [s, rad/s]
  const double near = 1.5 * way.speed / turn_rate;
  const std::size_t count = way.points.size();
  Samples samples;
  Vec2 position = way.points[0];
  double heading = heading_along(way.points[1] - position);
  std::size_t next = 1;
  bool back = false;
  for (double t = -1; t < time_limit + 2; t += step) {
    samples.times.push_back(t);
    samples.points.push_back(position);
    if (distance(position, way.points[next]) < near) {
      if (way.at_end == AtEnd::back && next == (back ? 0 : count - 1)) back = !back;
      next = (next + (back ? count - 1 : 1)) % count;
    }
    const double turn = wrap(heading_along(way.points[next] - position) - heading);
    heading += std::clamp(turn, -step * turn_rate, step * turn_rate);
    position += step * way.speed * unit_vector(heading);
  }
  return track_of(std::move(samples));
}

/// Speeds up a shape or a motion by `factor`, if it has its own pace.
struct Quicken {
  double factor;
  void operator()(OneOf<BreathingDisc, Valve, DeformingChannel, HarmonicLine, HarmonicArc> auto&
                      periodic) const {
    periodic.period /= factor;
  }
  void operator()(Waypoints& m) const { m.speed *= factor; }
  void operator()(OneOf<DiscShape, BoxShape, PolygonShape, Still, Straight, Track> auto&) const {}
};

/// Sets the top speed of the shape's own points and that added by the motion.
void set_pace(Obstacle& obstacle, double shape_speed, double motion_speed) {
  const double own = top_speed(Obstacle{obstacle.shape, Still{}});
  if (own > 0) std::visit(Quicken{shape_speed / own}, obstacle.shape);
  const double moved = top_speed(obstacle) - top_speed(Obstacle{obstacle.shape, Still{}});
  if (moved > 0) std::visit(Quicken{motion_speed / moved}, obstacle.motion);
}

}  // namespace

Mover random_mover(const Ground& ground, const Crosser& swarm, double speed_ratio, bool may_rest,
                   double time_limit, Rng& rng) {
  Mover mover;
  mover.obstacle.shape = random_shape(ground.extent, mover.extent, rng);
  const bool breathes = top_speed(Obstacle{mover.obstacle.shape, Still{}}) > 0;
  const double speed = speed_ratio * swarm.speed;
  const std::uint64_t kind = may_rest ? rng.below(8) : 1 + rng.below(7);
  mover.rests = kind == 0;
  mover.passes = kind == 1 || kind == 2;
  const double max_own = std::min(speed, 0.5 * swarm.speed);
  const double own = breathes ? (mover.rests ? speed : rng.uniform(0.2, 0.8) * max_own) : 0;
  const double carried = speed - own;
  switch (kind) {
    case 0:
      mover.obstacle.motion = Still{random_place(ground, rng), rng.uniform(-pi, pi)};
      break;
    case 1:
    case 2:
      mover.obstacle.motion = random_passage(ground, swarm, carried, rng);
      break;
    case 3:
      mover.obstacle.motion = random_line(ground, rng);
      break;
    case 4:
      mover.obstacle.motion = random_arc(ground, rng);
      break;
    case 5:
      mover.obstacle.motion = random_walk(ground, carried, time_limit, rng);
      break;
    default:
      mover.obstacle.motion = random_waypoints(ground, rng);
  }
  set_pace(mover.obstacle, own, carried);
  return mover;
}

void limit_turns(Mover& mover, double time_limit) {
  const auto* way = std::get_if<Waypoints>(&mover.obstacle.motion);
  if (way && way->points.size() > 1) mover.obstacle.motion = turning_track(*way, time_limit);
}

}  // namespace microswarm::scenes
