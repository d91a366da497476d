// SPDX-License-Identifier: Apache-2.0
#include "microswarm/scenes/avoidance_worlds.hpp"
#include "microswarm/experiment/scenario/scene.hpp"
#include "microswarm/experiment/scenario/validate.hpp"
#include "microswarm/formats/map_file.hpp"
#include "microswarm/formats/map_parts.hpp"
#include "microswarm/world/world.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>

#include "microswarm/world/connectivity/passage.hpp"

namespace microswarm::experiment {
namespace {

using scenes::AvoidanceOptions;

constexpr int drawn_worlds = 10;

scenes::AvoidanceOptions with_walls(scenes::AvoidanceOptions options) {
  options.walls = true;
  return options;
}

template <class Check>
void for_each_world(const scenes::AvoidanceOptions& options, Check&& check_one) {
  for (std::uint64_t seed = 0; seed < drawn_worlds; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Scenario s = scenes::avoidance_scenario(seed, options);
    check_one(s, scenes::avoidance_world(s));
  }
}

double radius_of(const Scenario& s) { return swarm_limits(s.swarm).radius; }

class AvoidanceWorlds : public testing::TestWithParam<scenes::AvoidanceOptions> {};

TEST_P(AvoidanceWorlds, AreScenariosThatTheProgramTakes) {
  for_each_world(GetParam(), [](Scenario s, const World& world) {
    for (const Obstacle& obstacle : s.obstacles) EXPECT_TRUE(validate(obstacle).empty());
    navigation::HierarchicalParams navigator;
    navigator.clearance = radius_of(s) + 0.8 * scenes::passage_gap(GetParam().hardship);
    s.navigator = navigator;
    EXPECT_TRUE(validate(s, world).empty());
  });
}

TEST_P(AvoidanceWorlds, NothingIsNearTheSwarmAtTheStart) {
  for_each_world(GetParam(), [](const Scenario& s, const World& world) {
    for (std::size_t i = 0; i < s.obstacles.size(); ++i) {
      if (std::holds_alternative<DeformingChannel>(s.obstacles[i].shape)) continue;
      const World alone{world.map, {s.obstacles[i]}};
      const double gap = alone.at(0).moving().clearance(s.start->position, 1e4) - radius_of(s);
      EXPECT_GE(gap, scenes::avoidance_start_gap + top_speed(s.obstacles[i]) - 1e-9) << i;
    }
  });
}

TEST_P(AvoidanceWorlds, ObstaclesKeepToTheirSpeeds) {
  for_each_world(GetParam(), [](const Scenario& s, const World&) {
    const double swarm = swarm_limits(s.swarm).max_speed;
    for (const Obstacle& obstacle : s.obstacles) {
      const double ratio = top_speed(obstacle) / swarm;
      EXPECT_LE(ratio, GetParam().max_speed_ratio + 1e-6);
      if (GetParam().min_speed_ratio < 1) continue;
      EXPECT_GE(ratio, GetParam().min_speed_ratio - 1e-6);
    }
  });
}

TEST_P(AvoidanceWorlds, TheGoalIsFreeMostOfTheTime) {
  for_each_world(GetParam(), [](const Scenario& s, const World& world) {
    int busy = 0;
    constexpr int looks = 60;
    for (int k = 0; k < looks; ++k)
      busy += !world.at(2 * k).moving().is_free(*s.goal, radius_of(s) + s.goal_tolerance);
    EXPECT_LE(busy, 0.5 * looks);
  });
}

TEST_P(AvoidanceWorlds, WhatStandsLeavesAWay) {
  for_each_world(GetParam(), [](const Scenario& s, const World&) {
    // A disc that holds all that a resting obstacle ever covers, in place of it.
    std::vector<Disc> resting;
    for (const Obstacle& obstacle : s.obstacles) {
      const auto* still = std::get_if<Still>(&obstacle.motion);
      const auto* valve = std::get_if<Valve>(&obstacle.shape);
      if (!still || std::holds_alternative<DeformingChannel>(obstacle.shape)) continue;
      if (valve && GetParam().walls) continue;  // of a gate: it opens again
      double extent = 0;
      for (int k = 0; k < 40; ++k) {
        std::vector<Body> bodies;
        append_bodies(obstacle, 0, k, bodies);
        for (const Body& body : bodies) {
          if (const auto* disc = std::get_if<Disc>(&body.shape)) {
            extent = std::max(extent, disc->radius);
          } else {
            for (const Vec2 p : std::get<Polygon>(body.shape).outer)
              extent = std::max(extent, distance(p, still->position));
          }
        }
      }
      resting.push_back({still->position, extent});
    }
    formats::MapParts parts = formats::read_map_parts(s.map);
    parts.discs.insert(parts.discs.end(), resting.begin(), resting.end());
    const Map map(parts.bounds, parts.walls, parts.discs);
    const WidestPath way = widest_path(map, s.start->position, *s.goal, radius_of(s));
    EXPECT_GE(way.clearance + 1.5 * way.resolution, radius_of(s));
  });
}

TEST_P(AvoidanceWorlds, AreAPureFunctionOfTheirArguments) {
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const Scene once{scenes::avoidance_scenario(seed, GetParam()), {}};
    const Scene again{scenes::avoidance_scenario(seed, GetParam()), {}};
    EXPECT_EQ(once.hash(), again.hash());
    const Scene other{scenes::avoidance_scenario(seed + 1, GetParam()), {}};
    EXPECT_NE(once.hash(), other.hash());
  }
}

std::vector<AvoidanceOptions> all_options() {
  std::vector<AvoidanceOptions> all{scenes::slow_obstacles, with_walls(scenes::slow_obstacles),
                                    scenes::fast_obstacles};
  for (const auto& [hardship, name] : enum_names(scenes::Hardship()))
    for (const std::uint64_t seed : {0, 1}) all.push_back(scenes::hardship_options(hardship, seed));
  return all;
}

INSTANTIATE_TEST_SUITE_P(Kinds, AvoidanceWorlds, testing::ValuesIn(all_options()));

TEST(AvoidanceWorlds, HaveAllShapesAndMotions) {
  std::set<std::string_view> kinds;
  for_each_world(with_walls(scenes::slow_obstacles), [&](const Scenario& s, const World&) {
    for (const Obstacle& obstacle : s.obstacles) {
      kinds.insert(std::visit([](const auto& shape) { return shape.type_name; }, obstacle.shape));
      kinds.insert(
          std::visit([](const auto& motion) { return motion.type_name; }, obstacle.motion));
    }
  });
  EXPECT_EQ(kinds.size(), std::variant_size_v<Shape> + std::variant_size_v<Motion>);
}

template <class Check>
void for_each_hard_world(scenes::Hardship hardship, Check&& check_one) {
  for (std::uint64_t seed = 0; seed < drawn_worlds; ++seed) {
    SCOPED_TRACE(std::string(enum_name(hardship)) + ", seed " + std::to_string(seed));
    check_one(scenes::avoidance_scenario(seed, scenes::hardship_options(hardship, seed)));
  }
}

/// Gaps between the pieces of a barrier across, from below [µm].
std::vector<std::pair<double, double>> gates(const Scenario& s) {
  std::vector<Box> pieces;
  for (const std::vector<Vec2>& wall : std::get<formats::PolygonsMap>(s.map).walls)
    pieces.push_back(bounding_box(wall));
  std::ranges::sort(pieces, {}, [](const Box& box) { return box.lo.y; });
  std::vector<std::pair<double, double>> gates;
  for (std::size_t i = 1; i < pieces.size(); ++i)
    gates.emplace_back(pieces[i - 1].hi.y, pieces[i].lo.y);
  return gates;
}

TEST(Hardships, SwarmsTurnSlowlyOrDrift) {
  for_each_hard_world(scenes::Hardship::turn_limit, [](const Scenario& s) {
    const auto& ribbon = std::get<RibbonParams>(s.swarm);
    EXPECT_TRUE(ribbon.max_turn_rate >= 1.5 && ribbon.max_turn_rate <= 4);
    EXPECT_EQ(ribbon.drift, Vec2{});
  });
  for_each_hard_world(scenes::Hardship::drift, [](const Scenario& s) {
    const auto& ribbon = std::get<RibbonParams>(s.swarm);
    EXPECT_TRUE(norm(ribbon.drift) >= 5 && norm(ribbon.drift) <= 15);
    EXPECT_TRUE(ribbon.speed_factor >= 0.85 && ribbon.speed_factor <= 1);
  });
}

TEST(Hardships, WallsStandInTheWay) {
  int in_the_way = 0;
  for_each_hard_world(scenes::Hardship::dead_ends, [&](const Scenario& s) {
    const auto walls = std::get<formats::PolygonsMap>(s.map).walls.size();
    EXPECT_TRUE(walls == 3 || walls == 6);
    const World world = scenes::avoidance_world(s);
    in_the_way += !world.map->is_free(Segment{s.start->position, *s.goal}, 1);
  });
  EXPECT_GE(in_the_way, drawn_worlds - 1);
  for_each_hard_world(scenes::Hardship::narrow_lanes, [](const Scenario& s) {
    ASSERT_EQ(gates(s).size(), 2u);
    for (const auto& [low, high] : gates(s)) EXPECT_NEAR(high - low, 2 * radius_of(s) + 15, 1e-9);
  });
  for_each_hard_world(scenes::Hardship::blocked_gates, [](const Scenario& s) {
    int shut = 0;
    for (const auto& [low, high] : gates(s))
      for (const Obstacle& obstacle : s.obstacles) {
        const auto* disc = std::get_if<DiscShape>(&obstacle.shape);
        const auto* still = std::get_if<Still>(&obstacle.motion);
        shut += disc && still && still->position.y - disc->radius <= low + 1e-9 &&
                still->position.y + disc->radius >= high - 1e-9;
      }
    EXPECT_EQ(shut, 1);
  });
}

TEST(Hardships, SightIsWorse) {
  for_each_hard_world(scenes::Hardship::lost_sight, [](const Scenario& s) {
    EXPECT_GE(s.sensing.missed_share, 0.02);
    EXPECT_GE(s.sensing.obstacle_missed_share, 0.05);
    EXPECT_TRUE(s.sensing.missed_time >= 0.1 && s.sensing.missed_time <= 0.3);
  });
  for_each_hard_world(scenes::Hardship::mistaken_identity,
                      [](const Scenario& s) { EXPECT_GE(s.sensing.swapped_share, 0.05); });
  for_each_hard_world(scenes::Hardship::hidden_delay,
                      [](const Scenario& s) { EXPECT_GE(s.sensing.hidden_delay, 0.05); });
}

}  // namespace
}  // namespace microswarm::experiment
