// SPDX-License-Identifier: Apache-2.0
#include "microswarm/planning/trees/turn_edge.hpp"

#include <gtest/gtest.h>

#include "microswarm/core/maths/angles.hpp"
#include "microswarm/core/maths/rng.hpp"
#include "microswarm/planning/path/planners.hpp"
#include "microswarm/scenes/worlds.hpp"

namespace microswarm::planning {
namespace {

TEST(TurnEdge, StraightAheadIsStraight) {
  const TurnEdge edge = turn_edge({{10, 20}, 0.3}, Vec2{10, 20} + 200 * unit_vector(0.3), 15);
  EXPECT_NEAR(edge.turn, 0, 1e-9);
  EXPECT_NEAR(edge.length, 200, 1e-9);
}

TEST(TurnEdge, BehindItIsAHalfTurnAndMore) {
  const TurnEdge edge = turn_edge({{0, 0}, 0}, {-200, 0}, 10);
  EXPECT_GT(std::abs(edge.turn), pi);
  EXPECT_NEAR(edge.length, 10 * std::abs(edge.turn) + edge.straight, 1e-12);
}

TEST(TurnEdge, EndsAtThePointAndItsChordsBendNoMoreThanTheRadius) {
  Rng rng(4, Purpose::test);
  for (int i = 0; i < 2000; ++i) {
    const Pose2 from{{rng.uniform(-100, 100), rng.uniform(-100, 100)}, rng.uniform(-pi, pi)};
    const Vec2 to{rng.uniform(-100, 100), rng.uniform(-100, 100)};
    const double radius = rng.uniform(1, 40);
    const TurnEdge edge = turn_edge(from, to, radius);
    ASSERT_TRUE(std::isfinite(edge.length));
    std::vector<Vec2> chords;
    append_edge(from, to, radius, chords);
    ASSERT_EQ(chords.front(), from.position);
    ASSERT_EQ(chords.back(), to);
    std::vector<Vec2> computed;
    append_chords(from, edge, radius, edge.length, computed);
    ASSERT_LT(distance(computed.back(), to), 1e-6);
    // Chords are shorter than the arc, by no more than a thousandth.
    ASSERT_LE(path_length(chords), edge.length + 1e-6);
    ASSERT_GE(path_length(chords), edge.length - 2e-3 * radius * std::abs(edge.turn) - 1e-6);
    double heading = from.heading;
    for (std::size_t k = 1; k < chords.size(); ++k) {
      const Vec2 step = chords[k] - chords[k - 1];
      if (norm(step) < 1e-6) continue;
      ASSERT_LE(turn_between(heading, heading_along(step)), pi / 18 + 1e-6);
      heading = heading_along(step);
    }
    ASSERT_LT(turn_between(heading, edge.heading), pi / 36 + 1e-6);
  }
}

// Brute force: of the ways that turn for an angle and then go straight, the shortest that hits; it
// hits where the straight line passes from one side of the point to the other.
TEST(TurnEdge, IsTheShortestTurnAndStraightLine) {
  Rng rng(5, Purpose::test);
  for (int i = 0; i < 100; ++i) {
    const Vec2 to{rng.uniform(-100, 100), rng.uniform(-100, 100)};
    const double radius = rng.uniform(5, 30);
    double best = 1e9;
    for (const double side : {-1.0, 1.0}) {
      double before = 0;
      for (double turn = 0; turn < 2 * pi; turn += 1e-4) {
        const Vec2 u = unit_vector(side * turn);
        const Vec2 at = side * radius * (Vec2{0, 1} - Vec2{-u.y, u.x});
        const double off = cross(u, to - at);
        const double ahead = dot(to - at, u);
        if (turn > 0 && off * before <= 0 && ahead >= 0)
          best = std::min(best, radius * turn + ahead);
        before = off;
      }
    }
    ASSERT_LT(best, 1e9);
    EXPECT_NEAR(turn_edge({{}, 0}, to, radius).length, best, 0.1);
  }
}

// Paths that a unicycle can drive: from the start's heading on, no turn is sharper than the radius.
TEST(DrrtStarArcs, PathsBeginWithTheStartsHeadingAndAreOfBoundedCurvature) {
  DrrtStarParams params;
  params.arcs = true;
  params.clearance = 10;
  params.goal_tolerance = 30;
  params.turn_radius = 20;
  int solved = 0;
  for (std::uint32_t trial = 0; trial < 20; ++trial) {
    Rng scene(6, Purpose::scene, trial);
    const auto map = std::make_shared<const Map>(
        Box{{0, 0}, {1000, 600}},
        std::vector<Polygon>{scenes::turned_rectangle({scene.uniform(300, 700), 300}, 150, 40,
                                                      scene.uniform(0, 3))});
    const Pose2 start{{100, 300}, scene.uniform(-pi, pi)};
    for (const bool straighten : {true, false}) {
      params.straighten = straighten;
      Rng rng(trial, Purpose::planner);
      const Plan made = plan(Snapshot(map), start, {900, 300}, params, rng);
      if (made.status != Status::solved) continue;
      ++solved;
      double heading = start.heading;
      for (std::size_t k = 1; k < made.path.size(); ++k) {
        const Vec2 step = made.path[k] - made.path[k - 1];
        if (norm(step) < 1e-6) continue;
        EXPECT_LE(turn_between(heading, heading_along(step)), pi / 18 + 1e-6) << trial << ", " << k;
        heading = heading_along(step);
      }
    }
  }
  EXPECT_GE(solved, 36);
}

}  // namespace
}  // namespace microswarm::planning
