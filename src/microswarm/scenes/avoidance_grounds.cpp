// SPDX-License-Identifier: Apache-2.0
#include "microswarm/scenes/avoidance_grounds.hpp"

#include <algorithm>
#include <cmath>

#include "microswarm/core/maths/angles.hpp"
#include "microswarm/core/maths/maths.hpp"
#include "microswarm/scenes/vascular.hpp"
#include "microswarm/scenes/worlds.hpp"
#include "microswarm/world/obstacles/clip.hpp"

namespace microswarm::scenes {
namespace {

constexpr double side_at(int obstacles) { return 1400 + 25.0 * obstacles; }

/// Places start and goal at opposite sides, horizontally or vertically, in either order.
void place_ends(Ground& ground, double off_border, Rng& rng) {
  const double side = ground.map.hi.x;
  const double near = off_border + 0.08 * side * rng.uniform();
  const double far = side - off_border - 0.08 * side * rng.uniform();
  Vec2 a{near, rng.uniform(off_border, side - off_border)};
  Vec2 b{far, rng.uniform(off_border, side - off_border)};
  if (rng.below(2) == 1) std::swap(a, b);
  if (rng.below(2) == 1) std::swap(a.x, a.y), std::swap(b.x, b.y);
  ground.start = a;
  ground.goal = b;
}

std::vector<Vec2> star(Vec2 centre, double radius, Rng& rng) {
  const int corners = 3 + static_cast<int>(rng.below(6));
  const double turn = rng.uniform(-pi, pi);
  std::vector<Vec2> ring;
  ring.reserve(static_cast<std::size_t>(corners));
  for (int k = 0; k < corners; ++k)
    ring.push_back(centre +
                   radius * rng.uniform(0.5, 1) * unit_vector(turn + 2 * pi * k / corners));
  return ring;
}

void add_wall(Ground& ground, const Polygon& wall) { ground.map.walls.push_back(wall.outer); }

/// Adds a vertical wall from x to x + thickness with two gates: `width()` draws the width of each,
/// and `fit(low, width)` adds what is in it.
template <class Width, class Fit>
void add_barrier(Ground& ground, double x, double thickness, Rng& rng, Width&& width, Fit&& fit) {
  const double height = ground.map.hi.y;
  double from = 0;
  for (int k = 0; k < 2; ++k) {
    const double gate = width();
    const double least = 0.1 * height + 0.45 * height * k;
    const double low = rng.uniform(least, least + 0.35 * height - gate);
    add_wall(ground, rectangle({{x, from}, {x + thickness, low}}));
    from = low + gate;
    fit(low, gate);
  }
  add_wall(ground, rectangle({{x, from}, {x + thickness, height}}));
}

constexpr double barrier = 60;  // thickness [µm]

/// Adds a barrier with gates of which some have a valve. A valve is open to the swarm for about
/// half of its period.
void add_gates(Ground& ground, const Crosser& swarm, double x, double speed, Rng& rng) {
  const double gate = 2 * swarm.half_passage;
  const auto width = [&] { return rng.uniform(1.1, 1.6) * gate; };
  const auto fit = [&](double low, double span) {
    if (rng.below(2) == 0) return;
    Valve valve{.span = span,
                .thickness = 30,
                .min_gap = rng.uniform(0, 40),
                .max_gap = rng.uniform(2, 2.4) * gate,
                .phase = rng.uniform()};
    valve.period = pi / 2 * (valve.max_gap - valve.min_gap) / speed;
    const Obstacle gate_valve{valve, Still{{x + barrier / 2, low + span / 2}, 0}};
    ground.fixtures.push_back(gate_valve);
  };
  add_barrier(ground, x, barrier, rng, width, fit);
}

/// An area for barriers.
Ground barrier_ground() {
  Ground ground;
  ground.map.hi = {2400, 2000};
  ground.extent = 70;
  return ground;
}

/// Places start and goal at the two sides of the barriers.
void place_beside_barriers(Ground& ground, const Crosser& swarm, Rng& rng) {
  const double gate = 2 * swarm.half_passage;
  ground.start = {rng.uniform(gate, 350), rng.uniform(gate, 2000 - gate)};
  ground.goal = {2400 - rng.uniform(gate, 350), rng.uniform(gate, 2000 - gate)};
}

void maybe_swap_ends(Ground& ground, Rng& rng) {
  if (rng.below(2) == 1) std::swap(ground.start, ground.goal);
}

}  // namespace

Ground open_ground(const Crosser& swarm, int obstacles, Rng& rng) {
  Ground ground;
  const double side = side_at(obstacles);
  ground.map.hi = {side, side};
  place_ends(ground, 2 * swarm.half_passage, rng);
  return ground;
}

Ground scattered_ground(const Crosser& swarm, int obstacles, Rng& rng) {
  Ground ground = open_ground(swarm, obstacles + 15, rng);
  const double side = ground.map.hi.x;
  const double passage = 2 * swarm.half_passage;
  std::vector<Disc> taken{{ground.start, swarm.half_passage}, {ground.goal, swarm.half_passage}};
  const int walls = 3 + static_cast<int>(rng.below(12));
  for (int tries = 0; tries < 12 * walls && ground.map.walls.size() + ground.map.discs.size() <
                                                static_cast<std::size_t>(walls);
       ++tries) {
    const double radius = rng.uniform(40, 220);
    const double inset = passage + radius;
    const double x = rng.uniform(inset, side - inset);
    const Disc room{{x, rng.uniform(inset, side - inset)}, radius};
    const auto is_near = [&](const Disc& other) {
      return distance(other.centre, room.centre) < other.radius + radius + passage;
    };
    const std::uint64_t kind = rng.below(3);
    if (std::any_of(taken.begin(), taken.end(), is_near)) continue;
    taken.push_back(room);
    const double slant = rng.uniform(0.15, 1.4);
    if (kind == 0) {
      ground.map.discs.push_back({room.centre, radius});
    } else if (kind == 1) {
      const Vec2 half = radius * unit_vector(slant);
      add_wall(ground, turned_rectangle(room.centre, 2 * half.x, 2 * half.y, rng.uniform(-pi, pi)));
    } else {
      ground.map.walls.push_back(star(room.centre, radius, rng));
    }
  }
  return ground;
}

Ground gated_ground(const Crosser& swarm, double speed_ratio, Rng& rng) {
  Ground ground = barrier_ground();
  const int walls = 1 + static_cast<int>(rng.below(2));
  for (int k = 0; k < walls; ++k) {
    const double x = walls == 1 ? rng.uniform(1000, 1400) : rng.uniform(650, 850) + 850 * k;
    add_gates(ground, swarm, x, speed_ratio * swarm.speed, rng);
  }
  place_beside_barriers(ground, swarm, rng);
  maybe_swap_ends(ground, rng);
  return ground;
}

Ground narrow_ground(const Crosser& swarm, double half_width, Rng& rng) {
  Ground ground = barrier_ground();
  const double x = rng.uniform(800, 1100);
  const auto nothing = [](double, double) {};
  add_barrier(
      ground, x, rng.uniform(100, 500), rng, [&] { return 2 * half_width; }, nothing);
  place_beside_barriers(ground, swarm, rng);
  maybe_swap_ends(ground, rng);
  return ground;
}

Ground blocked_ground(const Crosser& swarm, Rng& rng) {
  Ground ground = barrier_ground();
  const double x = rng.uniform(1000, 1400);
  bool shut = rng.below(2) == 0;  // the first gate
  const auto width = [&] { return rng.uniform(1.1, 1.6) * 2 * swarm.half_passage; };
  const auto fit = [&](double low, double span) {
    if (shut) {
      const Obstacle plug{DiscShape{span / 2}, Still{{x + barrier / 2, low + span / 2}, 0}};
      ground.fixtures.push_back(plug);
    }
    shut = !shut;
  };
  add_barrier(ground, x, barrier, rng, width, fit);
  place_beside_barriers(ground, swarm, rng);
  maybe_swap_ends(ground, rng);
  return ground;
}

Ground dead_end_ground(const Crosser& swarm, Rng& rng) {
  constexpr double thickness = 40;
  Ground ground = barrier_ground();
  place_beside_barriers(ground, swarm, rng);
  const bool back = rng.below(2) == 1;  // the swarm comes from the right
  const int pockets = 1 + static_cast<int>(rng.below(2));
  for (int k = 0; k < pockets; ++k) {
    const double x = pockets == 1 ? rng.uniform(1000, 1400) : 825 + 750.0 * k;
    const double half = rng.uniform(250, 500), depth = rng.uniform(200, 450);
    const double off = 2 * swarm.half_passage + half;
    const double share = (x - ground.start.x) / (ground.goal.x - ground.start.x);
    const double y = std::clamp(
        ground.start.y + share * (ground.goal.y - ground.start.y) + rng.uniform(-0.5, 0.5) * half,
        off, ground.map.hi.y - off);
    const double left = x - depth / 2, right = x + depth / 2;
    const double end = back ? left : right;  // of the pocket
    add_wall(ground, rectangle({{end - thickness / 2, y - half}, {end + thickness / 2, y + half}}));
    for (const double arm : {y - half, y + half - thickness})
      add_wall(ground, rectangle({{left, arm}, {right, arm + thickness}}));
  }
  if (back) std::swap(ground.start, ground.goal);
  return ground;
}

Ground vessel_ground(const Crosser& swarm, Rng& rng) {
  VascularShape shape;
  shape.width = 3200;
  shape.height = 2400;
  shape.spacing = 800;
  shape.min_half = 2 * swarm.half_passage + 70;
  shape.max_half = shape.min_half + 60;
  shape.wander = 0.12;
  const ChannelGraph graph = random_channels(shape, rng);
  Ground ground;
  ground.map.hi = graph.bounds.hi;
  // Split into two halves in which no wall surrounds a vessel, so outlines have no holes.
  const std::vector<Polygon> free = difference(graph.bounds, graph_walls(graph));
  const Vec2 middle = graph.bounds.centre();
  for (const Box half : {Box{graph.bounds.lo, {middle.x, graph.bounds.hi.y}},
                         Box{{middle.x, graph.bounds.lo.y}, graph.bounds.hi}}) {
    for (const Polygon& wall : difference(half, free)) add_wall(ground, wall);
  }
  for (const auto& [a, b] : graph.channels)
    ground.lanes.push_back({graph.joints[a].centre, graph.joints[b].centre});
  ground.lane_room = shape.min_half;
  ground.extent = 60;
  ground.enclosed = true;
  ground.goal = graph.joints[0].centre;
  const auto farther = [&](const Disc& a, const Disc& b) {
    return distance(a.centre, ground.goal) < distance(b.centre, ground.goal);
  };
  ground.start = std::max_element(graph.joints.begin(), graph.joints.end(), farther)->centre;
  return ground;
}

Ground channel_ground(const Crosser& swarm, double speed_ratio, Rng& rng) {
  Ground ground;
  DeformingChannel channel;
  channel.amplitude = rng.uniform(10, 30);
  channel.half_width = 2 * swarm.half_passage + 70 + channel.amplitude;
  channel.end_half_width = channel.half_width + rng.uniform(0, 60);
  channel.wavelength = rng.uniform(500, 1000);
  channel.period = 2 * pi * channel.amplitude / (speed_ratio * swarm.speed);
  const double swing = rng.uniform(0, 110);
  const double wave = rng.uniform(1500, 2200);
  const double phase = rng.uniform(-pi, pi);
  constexpr double length = 2200;
  const double inset = channel.end_half_width + channel.amplitude + 60;
  const double middle = inset + swing + 60;
  for (double x = 0; x <= length + 1; x += length / 16)
    channel.centre_line.push_back(
        {inset + x, middle + swing * maths::sin(2 * pi * x / wave + phase)});
  ground.map.hi = {2 * inset + length, 2 * middle};
  channel.block_centre = 0.5 * ground.map.hi;
  channel.block_width = ground.map.hi.x + 200;
  channel.block_height = ground.map.hi.y + 200;
  ground.lanes = {channel.centre_line};
  ground.lane_room = channel.half_width - channel.amplitude;
  ground.extent = 60;
  ground.enclosed = true;
  ground.start = channel.centre_line.front();
  ground.goal = channel.centre_line.back();
  if (rng.below(2) == 1) std::swap(ground.start, ground.goal);
  const Obstacle block{channel, Still{}};
  ground.fixtures.push_back(block);
  return ground;
}

}  // namespace microswarm::scenes
