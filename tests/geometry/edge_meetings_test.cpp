// SPDX-License-Identifier: Apache-2.0
#include "microswarm/geometry/edge_meetings.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "microswarm/core/maths/rng.hpp"
#include "microswarm/geometry/predicates.hpp"
#include "microswarm/geometry/touching_edges.hpp"

namespace microswarm {
namespace {

using Pairs = std::vector<EdgePair>;

bool cross_within(const Segment& s, const Segment& t) {
  return orientation(s.a, s.b, t.a) * orientation(s.a, s.b, t.b) < 0 &&
         orientation(t.a, t.b, s.a) * orientation(t.a, t.b, s.b) < 0;
}

Pairs brute_force(const std::vector<Segment>& edges, bool& any_cross) {
  Pairs pairs;
  any_cross = false;
  for (std::uint32_t i = 0; i < edges.size(); ++i)
    for (std::uint32_t j = i + 1; j < edges.size(); ++j) {
      if (!intersects(edges[i], edges[j])) continue;
      pairs.emplace_back(i, j);
      any_cross = any_cross || cross_within(edges[i], edges[j]);
    }
  return pairs;
}

EdgeGrid body_of(const std::vector<Segment>& edges) {
  return {edges, std::vector<std::uint32_t>(edges.size(), 0)};
}

Pairs meetings(const std::vector<Segment>& edges) {
  Pairs pairs;
  EXPECT_TRUE(for_each_meeting(body_of(edges), [&](std::size_t i, std::size_t j) {
    pairs.emplace_back(i, j);
    return true;
  }));
  std::ranges::sort(pairs);
  return pairs;
}

/// Points of a coarse lattice: most rings touch themselves, many have edges that lie on each other
/// or are points.
std::vector<Segment> lattice_ring(Rng& rng, std::size_t points, std::size_t side) {
  std::vector<Vec2> ring(points);
  for (Vec2& p : ring)
    p = {static_cast<double>(rng.below(side)), static_cast<double>(rng.below(side))};
  std::vector<Segment> edges;
  for (std::size_t i = 0; i < points; ++i) edges.push_back({ring[i], ring[(i + 1) % points]});
  return edges;
}

// Both outcomes of the sweep come up: nothing for edges that cross, else the pairs of brute force.
TEST(TouchingEdges, ThoseOfBruteForceOrNoneWhereEdgesCross) {
  Rng rng(1, Purpose::test);
  int crossing = 0, touching = 0;
  for (int trial = 0; trial < 20'000; ++trial) {
    const auto edges = lattice_ring(rng, 3 + rng.below(8), 2 + rng.below(5));
    bool any_cross = false;
    const Pairs expected = brute_force(edges, any_cross);
    const auto found = find_touching_edges(edges, 1000);
    ASSERT_EQ(found.has_value(), !any_cross) << trial;
    ++(any_cross ? crossing : touching);
    if (found) {
      ASSERT_EQ(*found, expected) << trial;
    }
  }
  EXPECT_GT(crossing, 2000);
  EXPECT_GT(touching, 2000);
}

// Edges of lattice squares that share sides and corners, many collinear: no two cross.
TEST(TouchingEdges, WallsOfCellsTouchManyTimes) {
  Rng rng(2, Purpose::test);
  for (int trial = 0; trial < 100; ++trial) {
    std::vector<Segment> edges;
    for (int k = 0; k < 40; ++k) {
      const double x = static_cast<double>(rng.below(6)), y = static_cast<double>(rng.below(6));
      const Vec2 corner[] = {{x, y}, {x + 1, y}, {x + 1, y + 1}, {x, y + 1}};
      for (int side = 0; side < 4; ++side) edges.push_back({corner[side], corner[(side + 1) % 4]});
    }
    bool any_cross = false;
    const Pairs expected = brute_force(edges, any_cross);
    ASSERT_FALSE(any_cross);
    const auto found = find_touching_edges(edges, expected.size());
    ASSERT_TRUE(found);
    ASSERT_EQ(*found, expected);
    ASSERT_FALSE(find_touching_edges(edges, expected.size() - 1));
  }
}

TEST(EdgeMeetings, ThoseOfBruteForce) {
  Rng rng(3, Purpose::test);
  for (int trial = 0; trial < 2000; ++trial) {
    const auto edges = lattice_ring(rng, 3 + rng.below(30), 2 + rng.below(30));
    bool any_cross = false;
    ASSERT_EQ(meetings(edges), brute_force(edges, any_cross)) << trial;
  }
}

/// A line that goes to and fro `edges` times, turned by an angle, so that its edges are parallel.
std::vector<Segment> serpentine(int edges, double angle) {
  const Vec2 along{std::cos(angle), std::sin(angle)}, across{-along.y, along.x};
  std::vector<Vec2> ring;
  for (int k = 0; k <= 2 * edges; ++k)
    ring.push_back((k + 1) / 2 % 2 * 10'000.0 * along + k / 2 * 1.0 * across);
  std::vector<Segment> made;
  for (std::size_t i = 0; i + 1 < ring.size(); ++i) made.push_back({ring[i], ring[i + 1]});
  return made;
}

// A grid would compare 2·10⁸ pairs at each angle, for minutes.
TEST(EdgeMeetings, LongParallelEdgesAreSwept) {
  for (const double angle : {0.0, 0.3, 0.7854, 1.5707963}) {
    const auto edges = serpentine(20'000, angle);
    EXPECT_EQ(meetings(edges).size(), edges.size() - 1) << angle;
  }
}

TEST(EdgeMeetings, GivesUpWhereEdgesCrossTooOften) {
  Rng rng(4, Purpose::test);
  const auto edges = lattice_ring(rng, 100'000, 1 << 20);
  std::size_t count = 0;
  EXPECT_FALSE(for_each_meeting(body_of(edges), [&](std::size_t, std::size_t) {
    ++count;
    return true;
  }));
  EXPECT_LE(count, max_edge_meetings(edges.size()) + 1);
}

TEST(EdgeMeetings, EndsWhenItIsAsked) {
  Rng rng(5, Purpose::test);
  const auto edges = lattice_ring(rng, 1000, 1 << 20);
  int count = 0;
  EXPECT_TRUE(
      for_each_meeting(body_of(edges), [&](std::size_t, std::size_t) { return ++count < 3; }));
  EXPECT_EQ(count, 3);
}

}  // namespace
}  // namespace microswarm
