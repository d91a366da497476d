// SPDX-License-Identifier: Apache-2.0
// Exact shortest paths beside a dense graph of points around the obstacles.
#include "microswarm/planning/exact/shortest_paths.hpp"

#include <gtest/gtest.h>

#include <queue>
#include <set>

#include "microswarm/contracts/plan.hpp"
#include "microswarm/core/maths/angles.hpp"
#include "microswarm/geometry/uniform_in.hpp"
#include "microswarm/planning/exact/shortest_path_tree.hpp"
#include "random_worlds.hpp"

namespace microswarm::planning {
namespace {

/// Length of the shortest path over points on the circles around all corners and discs, a little
/// longer than the true one; infinite if there is none.
double length_over_points(const Snapshot& world, Vec2 start, Vec2 goal, double clearance) {
  constexpr int around = 40;
  std::vector<Vec2> points{start, goal};
  const auto add = [&](Vec2 centre, double radius) {
    // Neighbours see each other along the circle.
    const double outer = std::max(1e-4, radius * (1 + 1e-6) / std::cos(pi / around));
    for (int k = 0; k < around; ++k) {
      const Vec2 p = centre + outer * unit_vector(2 * pi * k / around);
      if (world.is_free(p, clearance)) points.push_back(p);
    }
  };
  for (const BodySet* bodies : {&world.map().walls(), &world.moving()})
    for (const Body& body : bodies->bodies()) {
      if (const auto* disc = std::get_if<Disc>(&body.shape))
        add(disc->centre, disc->radius + clearance);
      if (const auto* polygon = std::get_if<Polygon>(&body.shape))
        for (const Vec2 corner : polygon->outer) add(corner, clearance);
    }
  std::vector<double> best(points.size(), std::numeric_limits<double>::infinity());
  std::vector<bool> done(points.size());
  using Entry = std::pair<double, std::size_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  open.emplace(best[0] = 0, 0);
  while (!open.empty()) {
    const auto [length, i] = open.top();
    open.pop();
    if (done[i]) continue;
    done[i] = true;
    if (i == 1) return length;
    for (std::size_t k = 0; k < points.size(); ++k) {
      const double through = length + distance(points[i], points[k]);
      if (done[k] || through >= best[k]) continue;
      if (!world.is_free(Segment{points[i], points[k]}, clearance)) continue;
      open.emplace(best[k] = through, k);
    }
  }
  return std::numeric_limits<double>::infinity();
}

/// Asks at random in random worlds and compares with paths over points.
void expect_shortest(Rng& rng, int worlds, bool moving) {
  int solved = 0, without = 0, bent = 0;
  for (int number = 0; number < worlds; ++number) {
    SCOPED_TRACE(number);
    const auto map =
        std::make_shared<const Map>(moving && number % 2 == 0 ? crowded_map(rng) : random_map(rng));
    const double clearance = number % 3 == 0 ? 0 : rng.uniform(0.5, 5);
    ShortestPaths paths(*map, clearance);
    for (int query = 0; query < 4; ++query) {
      const Snapshot world(map, 0, moving ? random_bodies(rng) : std::vector<Body>{});
      const Vec2 start = uniform_in(map->bounds(), rng), goal = uniform_in(map->bounds(), rng);
      if (!world.is_free(start, clearance) || !world.is_free(goal, clearance)) continue;
      const ShortestPath path = paths.find(start, goal, world.moving());
      const double other = length_over_points(world, start, goal, clearance);
      if (path.status == Status::no_path) {
        ++without;
        EXPECT_EQ(other, std::numeric_limits<double>::infinity());
        continue;
      }
      ASSERT_EQ(path.status, Status::solved);
      ++solved;
      bent += path.points.size() > 2;
      EXPECT_GE(path.length, distance(start, goal) - 1e-9);
      EXPECT_LE(path.length, other * (1 + 1e-9));
      // Passages through which the points do not fit are rare.
      if (std::isfinite(other)) {
        EXPECT_GE(path.length, 0.99 * other - 1e-9);
      }
      EXPECT_EQ(path.points.front(), start);
      EXPECT_EQ(path.points.back(), goal);
      const double drawn = path_length(path.points);
      EXPECT_GE(drawn, path.length - 1e-6);
      EXPECT_LE(drawn, 1.001 * path.length + 1e-6);
      EXPECT_TRUE(world.is_free(path.points, clearance));
      for (std::size_t i = 1; i < path.points.size(); ++i)
        EXPECT_TRUE(world.is_free(Segment{path.points[i - 1], path.points[i]}, clearance)) << i;
    }
  }
  EXPECT_GT(solved, worlds / 2);
  EXPECT_GT(bent, worlds / 3);
  if (!moving) {
    EXPECT_GT(without, 0);
  }
}

TEST(ShortestPaths, NoPathOverPointsIsShorterAndOneIsHardlyLonger) {
  Rng rng(1, Purpose::test);
  expect_shortest(rng, 30, false);
}

TEST(ShortestPaths, AmongMovingBodiesToo) {
  Rng rng(2, Purpose::test);
  expect_shortest(rng, 9, true);
}

TEST(ShortestPaths, WhatWasKeptChangesNoBit) {
  Rng rng(3, Purpose::test);
  int solved = 0;
  for (int number = 0; number < 12; ++number) {
    SCOPED_TRACE(number);
    const auto map = std::make_shared<const Map>(random_map(rng));
    const double clearance = number % 3 == 0 ? 0 : rng.uniform(0.5, 5);
    ShortestPaths kept(*map, clearance);
    for (int query = 0; query < 60; ++query) {
      const Snapshot world(map, 0, query % 3 == 0 ? random_bodies(rng) : std::vector<Body>{});
      const Vec2 start = uniform_in(map->bounds(), rng), goal = uniform_in(map->bounds(), rng);
      if (!world.is_free(start, clearance) || !world.is_free(goal, clearance)) continue;
      const ShortestPath path = kept.find(start, goal, world.moving());
      const ShortestPath anew = ShortestPaths(*map, clearance).find(start, goal, world.moving());
      EXPECT_EQ(path.status, anew.status);
      EXPECT_EQ(path.length, anew.length);
      EXPECT_EQ(path.points, anew.points);
      EXPECT_EQ(path.expanded, anew.expanded);
      EXPECT_EQ(path.lines, anew.lines);
      solved += path.status == Status::solved;
    }
  }
  EXPECT_GT(solved, 200);
}

/// A block whose lower left corner is at `corner`, turned by `angle`, in a room of 2 mm.
Map tilted_block(Vec2 corner, double angle, Vec2 size) {
  const Vec2 u = unit_vector(angle), v = perpendicular(u);
  return Map(
      {{0, 0}, {2000, 2000}},
      {{{corner, corner + size.x * u, corner + size.x * u + size.y * v, corner + size.y * v}, {}}});
}

/// Places at the distance from the left face of the block, up to its ends and beyond the bend.
std::vector<Vec2> places_beside(const Map& map, Vec2 corner, double angle, double height,
                                double clearance) {
  std::vector<Vec2> places;
  const Vec2 u = unit_vector(angle), v = perpendicular(u);
  for (const double along : {0.0, 1e-9, 1e-6, 1e-3, 0.02, 0.5, 30.0, 300.0, 599.0, 600.0}) {
    Vec2 place = corner + std::min(along, height) * v - clearance * u;
    while (!map.is_free(place, clearance)) place -= 1e-14 * norm(place) * u;
    places.push_back(place);
  }
  return places;
}

TEST(ShortestPaths, FromAndToPlacesAtTheClearanceBesideAFace) {
  for (const double angle : {0.0, 0.1, radians(30), radians(45), radians(-20)})
    for (const double clearance : {0.3, 41.0, 50.0, 55.0}) {
      const Vec2 corner{900, 700};
      const Vec2 other =
          corner + 500 * unit_vector(angle) + 300 * perpendicular(unit_vector(angle));
      const Map map = tilted_block(corner, angle, {200, 600});
      ShortestPaths paths(map, clearance);
      ShortestPathTree tree(map, other, clearance);
      for (const Vec2 place : places_beside(map, corner, angle, 600, clearance)) {
        SCOPED_TRACE(testing::Message() << angle << ' ' << clearance << ' ' << place.y);
        const Vec2 away = place - 1e-3 * unit_vector(angle);
        const ShortestPath path = paths.find(place, other);
        EXPECT_EQ(path.status, Status::solved);
        EXPECT_NEAR(path.length, paths.find(away, other).length, 2e-3);
        const ShortestPath back = paths.find(other, place);
        EXPECT_EQ(back.status, Status::solved);
        EXPECT_NEAR(back.length, path.length, 1e-6);
        EXPECT_NEAR(tree.length_from(place), path.length, 1e-6);
        EXPECT_NEAR(ShortestPathTree(map, place, clearance).length_from(other), path.length, 1e-6);
        for (std::size_t i = 1; i < path.points.size(); ++i)
          EXPECT_TRUE(
              map.is_free(Segment{path.points[i - 1], path.points[i]}, clearance * (1 - 1e-9)));
      }
    }
}

/// The circle of radius `radius` around a corner.
TurningCircle circle_around(const Corner& corner, double radius) {
  return {.centre = corner.centre,
          .radius = radius,
          .from = corner.from,
          .width = corner.width,
          .first = corner.first,
          .last = corner.last,
          .is_disc = corner.is_disc};
}

TEST(Corners, EveryFreeTangentLeadsToWhatIsSeen) {
  Rng rng(9, Purpose::test);
  int tangents = 0, seen = 0, all = 0;
  for (int world = 0; world < 100; ++world) {
    const Map map = world % 2 == 0 ? random_map(rng) : crowded_map(rng);
    const Corners& corners = map.corners();
    const double clearance = world % 4 == 0 ? 0 : rng.uniform(0.2, 5);
    const double margin = 1e-7 * std::max(1.0, clearance);
    std::vector<TurningCircle> circles;
    std::vector<std::vector<Arc>> arcs;
    for (const Corner& corner : corners.all()) {
      circles.push_back(circle_around(corner, corner.radius + clearance + margin));
      arcs.emplace_back();
      add_free_arcs(circles.back(), map, nullptr, clearance, margin, arcs.back());
    }
    for (std::uint32_t i = 0; i < circles.size(); ++i)
      for (const double sense : {1.0, -1.0}) {
        if (arcs[i].empty()) continue;
        std::set<std::pair<std::uint32_t, bool>> found;
        corners.seen_from(i, circles[i].radius, clearance, sense > 0,
                          [&](std::uint32_t other, auto&& find_sides) {
                            const Sides sides = find_sides();
                            if (sides.left) found.emplace(other, true);
                            if (sides.right) found.emplace(other, false);
                          });
        seen += static_cast<int>(found.size());
        all += 2 * static_cast<int>(circles.size());
        for (std::uint32_t k = 0; k < circles.size(); ++k)
          for (const bool left : {true, false}) {
            if (k == i || found.contains({k, left})) continue;
            const double there = left ? 1 : -1;
            const auto line = tangent(circles[i], sense, circles[k], there, margin);
            if (!line) continue;
            const Vec2 from = circles[i].touch(sense, line->along);
            const Vec2 normal = perpendicular(line->along);
            if (arc_at(circles[i], circles[i].angle_at(-sense * normal), arcs[i]) < 0) continue;
            if (arc_at(circles[k], circles[k].angle_at(-there * normal), arcs[k]) < 0) continue;
            EXPECT_FALSE(map.is_free(Segment{from, from + line->length * line->along}, clearance))
                << "world " << world << " from " << i << (sense > 0 ? "+" : "-") << " to " << k
                << (left ? "+" : "-");
            ++tangents;
          }
      }
  }
  EXPECT_GT(tangents, 250);
  EXPECT_LT(seen, all / 2);
}

}  // namespace
}  // namespace microswarm::planning
