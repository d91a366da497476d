// SPDX-License-Identifier: Apache-2.0
// The baselines for one body: straight_stop, potential_field, velocity_obstacle.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "microswarm/core/maths/angles.hpp"
#include "microswarm/navigation/baselines/potential_field.hpp"
#include "microswarm/navigation/baselines/straight.hpp"
#include "microswarm/navigation/baselines/velocity_obstacle.hpp"
#include "microswarm/world/obstacles/obstacle.hpp"
#include "microswarm/world/world.hpp"
#include "tests/navigation/room.hpp"

namespace microswarm::navigation {
namespace {

constexpr SwarmLimits fast_vortex{50, 80, std::numeric_limits<double>::infinity(), 0.1};
constexpr SwarmLimits fast_ribbon{50, 80, 3, 0.1};

Polygon box(Vec2 lo, Vec2 hi) {
  return {.outer = {lo, {hi.x, lo.y}, hi, {lo.x, hi.y}}, .holes = {}};
}

/// A swarm that does what it is told, late, in a world of obstacles that are seen late.
struct BaselineDrive {
  std::vector<Polygon> walls{};
  std::vector<Obstacle> obstacles{};
  SwarmLimits swarm = fast_vortex;
  Pose2 pose{{200, 500}, 0};
  double delay = 0.05;
  double min_gap = std::numeric_limits<double>::infinity();  ///< from edge to edge
  double time = 0;
  bool arrived = false;
  std::vector<NavigatorState> states{};

  bool was(NavigatorState state) const {
    return std::find(states.begin(), states.end(), state) != states.end();
  }

  void run(Navigator& navigator, double seconds) {
    constexpr double substep = 0.01;
    World world{std::make_shared<const Map>(Box{{0, 0}, {2000, 1000}}, walls), obstacles};
    navigator.prepare(world.at(0), {});
    std::vector<Pose2> was(static_cast<std::size_t>(std::lround(delay / substep)) + 1, pose);
    std::vector<Command> pending(
        static_cast<std::size_t>(std::lround(swarm.response_lag / substep)));
    while (time < seconds && !arrived) {
      const double seen = std::max(0.0, time - delay);
      const Snapshot frame = world.at(seen);
      const Observation observation{.now = time,
                                    .seen = seen,
                                    .swarm = SwarmPose{was.front(), swarm.radius},
                                    .robots = {},
                                    .world = borrowed(frame)};
      const Command command = navigator.step(observation, {});
      states.push_back(navigator.view().state);
      for (int k = 0; k < 10; ++k, time += substep) {
        pending.push_back(command);
        pose = unicycle_step(pose, pending.front(), swarm.max_turn_rate, substep);
        pending.erase(pending.begin());
        was.push_back(pose);
        was.erase(was.begin());
        min_gap =
            std::min(min_gap, world.at(time + substep).clearance(pose.position) - swarm.radius);
      }
      arrived = distance(pose.position, room_goal) <= room_tolerance;
    }
  }
};

TEST(Straight, GoesStraightInTheOpen) {
  for (const SwarmLimits& swarm : {fast_vortex, fast_ribbon}) {
    BaselineDrive drive{.swarm = swarm, .pose = {{200, 500}, pi}};
    StraightNavigator navigator({}, body_task(swarm), Rng(1, Purpose::planner));
    drive.run(navigator, 60);
    EXPECT_TRUE(drive.arrived);
    EXPECT_LT(drive.time, 1600 / 60.0 + 2);
  }
}

TEST(Straight, StopsBeforeWhatStandsAheadAndGoesOnAfterIt) {
  BaselineDrive drive{.obstacles = {{DiscShape{60}, Straight{{1000, 300}, {0, 10}}}}};
  StraightNavigator navigator({}, body_task(fast_vortex), Rng(1, Purpose::planner));
  drive.run(navigator, 100);
  EXPECT_TRUE(drive.arrived);
  EXPECT_TRUE(drive.was(NavigatorState::hold));
  EXPECT_GT(drive.min_gap, 0);
}

TEST(Straight, StopsBeforeAWallAtItsDistance) {
  BaselineDrive drive{.walls = {box({1000, 0}, {1020, 1000})}};
  StraightNavigator navigator({}, body_task(fast_vortex), Rng(1, Purpose::planner));
  drive.run(navigator, 60);
  EXPECT_FALSE(drive.arrived);
  EXPECT_NEAR(drive.pose.position.x, 1000 - 100 - 10 - 50, 8);
  EXPECT_EQ(drive.states.back(), NavigatorState::hold);
}

TEST(Straight, MayLeaveWhatIsNearBehindIt) {
  BaselineDrive drive{.walls = {box({100, 400}, {145, 600})}};  // 5 µm behind its edge
  StraightNavigator navigator({}, body_task(fast_vortex), Rng(1, Purpose::planner));
  drive.run(navigator, 60);
  EXPECT_TRUE(drive.arrived);
}

TEST(PotentialField, GoesRoundADiscThatStandsAside) {
  for (const SwarmLimits& swarm : {fast_vortex, fast_ribbon}) {
    BaselineDrive drive{.obstacles = {{DiscShape{80}, Still{{1000, 520}, 0}}}, .swarm = swarm};
    PotentialFieldNavigator navigator({}, body_task(swarm), Rng(1, Purpose::planner));
    drive.run(navigator, 80);
    EXPECT_TRUE(drive.arrived);
    EXPECT_TRUE(drive.was(NavigatorState::avoid));
    EXPECT_GT(drive.min_gap, 10);
  }
}

TEST(PotentialField, IsStuckWhereForcesCancelOut) {
  BaselineDrive drive{.obstacles = {{DiscShape{80}, Still{{1000, 500}, 0}}}};
  PotentialFieldNavigator navigator({}, body_task(fast_vortex), Rng(1, Purpose::planner));
  drive.run(navigator, 60);
  EXPECT_FALSE(drive.arrived);
  EXPECT_EQ(drive.states.back(), NavigatorState::stuck);
  EXPECT_GT(drive.min_gap, 20);
}

TEST(PotentialField, ReachesAGoalBesideAWall) {
  BaselineDrive drive{.walls = {box({1870, 300}, {1900, 700})}};
  PotentialFieldNavigator navigator({}, body_task(fast_vortex), Rng(1, Purpose::planner));
  drive.run(navigator, 120);
  EXPECT_TRUE(drive.arrived);
  EXPECT_GT(drive.min_gap, 0);
}

TEST(PotentialField, TheRouteLeadsThroughTheGap) {
  const std::vector<Polygon> walls{box({1000, 0}, {1030, 700})};
  for (const Guide guide : {Guide::straight, Guide::route}) {
    BaselineDrive drive{.walls = walls};
    PotentialFieldParams params;
    params.guide = guide;
    PotentialFieldNavigator navigator(params, body_task(fast_vortex), Rng(1, Purpose::planner));
    drive.run(navigator, 120);
    EXPECT_EQ(drive.arrived, guide == Guide::route);
    EXPECT_GT(drive.min_gap, 0);
  }
}

TEST(PotentialField, GivesWayToWhatCrosses) {
  BaselineDrive drive{.obstacles = {{DiscShape{60}, Straight{{1000, 0}, {0, 40}}}}};
  PotentialFieldNavigator navigator({}, body_task(fast_vortex), Rng(1, Purpose::planner));
  drive.run(navigator, 80);
  EXPECT_TRUE(drive.arrived);
  EXPECT_GT(drive.min_gap, 0);
}

TEST(VelocityObstacle, KeepsToThePreferredVelocityInTheOpen) {
  BaselineDrive drive;
  VelocityObstacleNavigator navigator({}, body_task(fast_vortex), Rng(1, Purpose::planner));
  drive.run(navigator, 60);
  EXPECT_TRUE(drive.arrived);
  EXPECT_LT(drive.time, 1600 / 60.0 + 1);
  EXPECT_FALSE(drive.was(NavigatorState::avoid));
}

TEST(VelocityObstacle, AvoidsWhatCrossesOrComesHeadOn) {
  for (const SwarmLimits& swarm : {fast_vortex, fast_ribbon})
    for (const Straight& motion : {Straight{{1000, -40}, {0, 40}}, Straight{{1700, 500}, {-55, 0}},
                                   Straight{{600, 1250}, {30, -50}}}) {
      BaselineDrive drive{.obstacles = {{DiscShape{70}, motion}}, .swarm = swarm};
      VelocityObstacleNavigator navigator({}, body_task(swarm), Rng(1, Purpose::planner));
      drive.run(navigator, 80);
      EXPECT_TRUE(drive.arrived);
      EXPECT_TRUE(drive.was(NavigatorState::avoid));
      EXPECT_GT(drive.min_gap, 0) << motion.start.x << " " << swarm.max_turn_rate;
    }
}

TEST(VelocityObstacle, AvoidsBoxesAndWhatGrows) {
  BaselineDrive drive{
      .obstacles = {{BoxShape{160, 60}, Straight{{1000, -200}, {0, 40}}},
                    {BreathingDisc{20, 120, 8, 0}, Still{{600, 540}, 0}},
                    {BoxShape{200, 30}, HarmonicArc{{1500, 500}, 60, 0, 0.5, 20, 0}}}};
  VelocityObstacleNavigator navigator({}, body_task(fast_vortex), Rng(1, Purpose::planner));
  drive.run(navigator, 90);
  EXPECT_TRUE(drive.arrived);
  EXPECT_GT(drive.min_gap, 0);
}

TEST(VelocityObstacle, TheRouteLeadsThroughTheGap) {
  BaselineDrive drive{.walls = {box({1000, 0}, {1030, 700}), box({1300, 400}, {1330, 1000})}};
  VelocityObstacleNavigator navigator({}, body_task(fast_vortex), Rng(1, Purpose::planner));
  drive.run(navigator, 120);
  EXPECT_TRUE(drive.arrived);
  EXPECT_GT(drive.min_gap, 0);
}

}  // namespace
}  // namespace microswarm::navigation
