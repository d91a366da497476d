// SPDX-License-Identifier: Apache-2.0
#include "microswarm/scenes/worlds.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "microswarm/core/maths/angles.hpp"
#include "microswarm/geometry/distance.hpp"
#include "microswarm/geometry/uniform_in.hpp"

namespace microswarm::scenes {
namespace {

void scatter_discs(int count, std::vector<Disc>& out, const Box& box, Rng& rng) {
  for (int i = 0; i < count; ++i) {
    const Vec2 centre = uniform_in(box, rng);
    out.push_back({centre, rng.uniform(10, 70)});
  }
}

void scatter_boxes(int count, RawWorld& world, Rng& rng) {
  for (int i = 0; i < count; ++i) {
    const Vec2 centre = uniform_in(world.bounds, rng);
    const double width = rng.uniform(20, 160);
    const double height = rng.uniform(5, 80);
    world.walls.push_back(turned_rectangle(centre, width, height, rng.uniform(-pi, pi)));
  }
}

/// Adds vertical 1 µm walls across the world, each with one gap.
void thin_walls(RawWorld& world, Rng& rng) {
  const Box& b = world.bounds;
  for (double x = b.lo.x + 120; x < b.hi.x - 100; x += rng.uniform(100, 220)) {
    const double gap = rng.uniform(110, 200);
    const double from = rng.uniform(b.lo.y, b.hi.y - gap);
    world.walls.push_back(rectangle({{x, b.lo.y}, {x + 1, from}}));
    world.walls.push_back(rectangle({{x, from + gap}, {x + 1, b.hi.y}}));
  }
}

/// Adds thick walls with an opening alternately above and below.
void channels(RawWorld& world, Rng& rng) {
  const Box& b = world.bounds;
  bool above = rng.below(2) == 0;
  for (double x = b.lo.x + 150; x < b.hi.x - 150; x += rng.uniform(180, 260), above = !above) {
    const double width = rng.uniform(20, 60);
    const double gap = rng.uniform(100, 180);
    world.walls.push_back(above ? rectangle({{x, b.lo.y}, {x + width, b.hi.y - gap}})
                                : rectangle({{x, b.lo.y + gap}, {x + width, b.hi.y}}));
  }
}

}  // namespace

Snapshot RawWorld::snapshot() const {
  std::vector<Body> moving;
  for (const Disc& disc : movers) {
    Body body;
    body.shape = disc;
    body.obstacle = static_cast<std::uint32_t>(moving.size());
    moving.push_back(body);
  }
  return Snapshot(std::make_shared<const Map>(bounds, walls, discs, field_cell), 0, moving);
}

double RawWorld::clearance(Segment s) const {
  double least = std::numeric_limits<double>::infinity();
  for (const Vec2 p : {s.a, s.b}) {
    least = std::min(
        {least, p.x - bounds.lo.x, bounds.hi.x - p.x, p.y - bounds.lo.y, bounds.hi.y - p.y});
  }
  for (const Polygon& wall : walls) least = std::min(least, distance(s, wall));
  for (const Disc& disc : discs) least = std::min(least, distance(s, disc));
  for (const Disc& disc : movers) least = std::min(least, distance(s, disc));
  return least;
}

Polygon rectangle(Box box) {
  return {{box.lo, {box.hi.x, box.lo.y}, box.hi, {box.lo.x, box.hi.y}}, {}};
}

Polygon turned_rectangle(Vec2 centre, double width, double height, double angle) {
  Polygon box = rectangle({{-width / 2, -height / 2}, {width / 2, height / 2}});
  for (Vec2& p : box.outer) p = centre + rotated(p, angle);
  return box;
}

RawWorld random_world(int kind, Rng& rng) {
  RawWorld world;
  switch (kind) {
    case 0:
      world.name = "discs";
      scatter_discs(5 + static_cast<int>(rng.below(25)), world.discs, world.bounds, rng);
      break;
    case 1:
      world.name = "boxes";
      scatter_boxes(5 + static_cast<int>(rng.below(20)), world, rng);
      break;
    case 2:
      world.name = "thin walls";
      thin_walls(world, rng);
      break;
    case 3:
      world.name = "channels";
      channels(world, rng);
      break;
    default:
      world.name = "all, moving";
      thin_walls(world, rng);
      scatter_boxes(4, world, rng);
      scatter_discs(4, world.discs, world.bounds, rng);
      scatter_discs(6, world.movers, world.bounds, rng);
  }
  return world;
}

Vec2 random_free_point(const RawWorld& world, double clearance, Rng& rng) {
  for (int i = 0; i < 10'000; ++i) {
    const Vec2 p = uniform_in(world.bounds, rng);
    if (world.clearance(p) > clearance + 1e-6) return p;
  }
  return world.bounds.centre();
}

RawWorld cluttered(Rng& rng, int side) {
  const int discs = 140 * side * side;
  const int polygons = 70 * side * side;
  RawWorld world;
  world.name = fmt::format("{} discs, {} polygons", discs, polygons);
  world.bounds = {{0, 0}, {2000.0 * side, 1000.0 * side}};
  world.field_cell = 0;
  for (int i = 0; i < discs; ++i) {
    const Vec2 centre = uniform_in(world.bounds, rng);
    world.discs.push_back({centre, rng.uniform(8, 25)});
  }
  for (int i = 0; i < polygons; ++i) {
    const Vec2 centre = uniform_in(world.bounds, rng);
    Polygon polygon;
    const int corners = 3 + static_cast<int>(rng.below(6));
    const double radius = rng.uniform(10, 30);
    for (int k = 0; k < corners; ++k) {
      polygon.outer.push_back(centre + radius * unit_vector(2 * pi * k / corners));
    }
    world.walls.push_back(polygon);
  }
  return world;
}

}  // namespace microswarm::scenes
