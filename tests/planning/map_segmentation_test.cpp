// SPDX-License-Identifier: Apache-2.0
#include "microswarm/planning/gathering/map_segmentation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "microswarm/scenes/vascular.hpp"
#include "microswarm/scenes/worlds.hpp"
#include "tests/cases.hpp"

namespace microswarm::planning {
namespace {

ObstacleWeightedRrt grow(const scenes::Vascular& scene, const Map& map, int nodes,
                         std::uint64_t seed = 1) {
  ObstacleWeightedRrtParams params = scaled({}, scene.width / 10);
  params.nodes = nodes;
  Rng rng(seed, Purpose::planner);
  return obstacle_weighted_rrt(map, scene.goal, params, rng);
}

void expect_laws(const ObstacleWeightedRrt& tree, const Routes& routes,
                 const MapSegmentation& found) {
  const std::size_t n = tree.nodes.size();
  ASSERT_EQ(found.region.size(), n);
  ASSERT_EQ(found.branch.size(), n);
  ASSERT_FALSE(found.regions.empty());
  EXPECT_EQ(found.region[0], 0u);
  EXPECT_EQ(found.regions[0].next, 0u);
  EXPECT_EQ(found.regions[0].junction, tree.nodes[0]);
  std::set<std::uint32_t> used;
  for (std::uint32_t v = 0; v < n; ++v) {
    ASSERT_LT(found.region[v], found.regions.size());
    ASSERT_LT(found.branch[v], found.regions[found.region[v]].branches);
    used.insert(found.region[v]);
    const std::uint32_t next = routes.next[v];
    if (!tree.medial[v]) {
      ASSERT_EQ(found.region[v], found.region[next]);
      ASSERT_EQ(found.branch[v], found.branch[next]);
    }
    // On the way to the goal regions only ever change to such with a lower number.
    ASSERT_LE(found.region[next], found.region[v]);
  }
  EXPECT_EQ(used.size(), found.regions.size());
  for (std::uint32_t r = 1; r < found.regions.size(); ++r) {
    const Region& region = found.regions[r];
    EXPECT_LT(region.next, r);
    EXPECT_EQ(found.region[region.gate], r);
    EXPECT_EQ(found.region[region.node], r);
    EXPECT_EQ(found.region[routes.next[region.gate]], region.next);
    EXPECT_GE(routes.cost[region.gate], routes.cost[found.regions[r - 1].gate]);
    EXPECT_GE(region.branches, 1u);
  }
  for (std::uint32_t v = 0; v < n; ++v) {
    EXPECT_GE(routes.cost[v], routes.cost[found.regions[found.region[v]].gate]);
  }
  EXPECT_TRUE(std::is_sorted(found.junction_nodes.begin(), found.junction_nodes.end()));
  for (const std::uint32_t v : found.junction_nodes) EXPECT_TRUE(tree.medial[v]);
}

TEST(MapSegmentation, TheTJunctionHasTwoRegionsAsPublished) {
  const scenes::Vascular scene = scenes::t_junction();
  const Map map = scene.map();
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const ObstacleWeightedRrt tree = grow(scene, map, scene.nodes, seed);
    const MapSegmentation found = segment_map(map, tree, tree.weighted);
    expect_laws(tree, tree.weighted, found);
    ASSERT_EQ(found.regions.size(), 2u);
    EXPECT_NEAR(distance(found.regions[1].junction, Vec2{50, 94}), 0, 1.5);
    EXPECT_EQ(found.regions[0].branches, 1u);
    ASSERT_EQ(found.regions[1].branches, 2u);
    EXPECT_EQ(found.region[tree.nearest({50, 80})], 0u);
    EXPECT_EQ(found.region[tree.nearest({2, 98})], 1u);
    EXPECT_EQ(found.region[tree.nearest({98, 92})], 1u);
    EXPECT_NE(found.branch[tree.nearest({2, 98})], found.branch[tree.nearest({98, 92})]);
  }
}

// Published: 9 and 31 regions; on the second ours finds 27.
// a bend.
TEST(MapSegmentation, TheLargerMapsHaveAboutThePublishedNumbersOfRegions) {
  for (const auto& [scene, least, most] :
       {std::tuple{scenes::vascular_network(), 9u, 9u},
        std::tuple{scenes::larger_vascular_network(), 26u, 31u}}) {
    const Map map = scene.map();
    const ObstacleWeightedRrt tree = grow(scene, map, scene.nodes);
    for (const Routes* routes : {&tree.weighted, &tree.plain}) {
      const MapSegmentation found = segment_map(map, tree, *routes);
      expect_laws(tree, *routes, found);
      if (routes == &tree.plain) continue;
      EXPECT_GE(found.regions.size(), least) << scene.name;
      EXPECT_LE(found.regions.size(), most) << scene.name;
    }
  }
}

/// Two channels of width 10 that meet in a bend or a fork of the given directions.
scenes::Vascular star(const std::vector<double>& directions_deg) {
  scenes::ChannelGraph graph;
  graph.bounds = {{0, 0}, {120, 120}};
  graph.joints.push_back({{60, 60}, 5});
  for (const double direction : directions_deg) {
    graph.channels.push_back({0, static_cast<std::uint32_t>(graph.joints.size())});
    graph.joints.push_back({Vec2{60, 60} + 50.0 * unit_vector(radians(direction)), 5});
  }
  return {"star", graph.bounds, scenes::graph_walls(graph), graph.joints[1].centre, 2000, 10};
}

TEST(MapSegmentation, BendsAreNoJunctionsAndForksAre) {
  for (const double bend : {180.0, 150.0, 120.0, 90.0, 75.0}) {
    const scenes::Vascular scene = star({0, bend});
    const Map map = scene.map();
    const ObstacleWeightedRrt tree = grow(scene, map, scene.nodes);
    EXPECT_EQ(segment_map(map, tree, tree.weighted).regions.size(), 1u) << bend;
  }
  const std::vector<std::vector<double>> forks{
      {0, 120, 240}, {0, 90, 180}, {0, 180, 240}, {0, 130, 180}, {0, 90, 180, 270}};
  for (const std::vector<double>& fork : forks) {
    const scenes::Vascular scene = star(fork);
    const Map map = scene.map();
    const ObstacleWeightedRrt tree = grow(scene, map, scene.nodes);
    const MapSegmentation found = segment_map(map, tree, tree.weighted);
    ASSERT_EQ(found.regions.size(), 2u) << fork[1];
    EXPECT_EQ(found.regions[1].branches, fork.size() - 1);
    EXPECT_LT(distance(found.regions[1].junction, Vec2{60, 60}), 8);
  }
}

TEST(MapSegmentation, LawsHoldOnGeneratedMaps) {
  for (int seed = 1; seed <= test::cases(12); ++seed) {
    scenes::VascularShape shape;
    shape.min_half = seed % 3 == 0 ? 1.5 : 3.5;
    Rng rng(seed, Purpose::scene);
    const scenes::Vascular scene = scenes::random_vascular(shape, rng);
    const Map map = scene.map();
    const ObstacleWeightedRrt tree = grow(scene, map, 3000, seed);
    expect_laws(tree, tree.weighted, segment_map(map, tree, tree.weighted));
  }
}

TEST(MapSegmentation, AnOpenHallIsOneRegion) {
  const scenes::Vascular hall{"hall", {{0, 0}, {60, 60}}, {}, {5, 5}, 2000, 10};
  const Map map = hall.map();
  const ObstacleWeightedRrt tree = grow(hall, map, hall.nodes);
  const MapSegmentation found = segment_map(map, tree, tree.weighted);
  expect_laws(tree, tree.weighted, found);
  EXPECT_EQ(found.regions.size(), 1u);
}

TEST(Vascular, GeneratedMapsAreConnectedAndEndAtADeadEnd) {
  for (int seed = 1; seed <= test::cases(20); ++seed) {
    scenes::VascularShape shape;
    shape.loops = 0.04 * seed;
    Rng rng(seed, Purpose::scene);
    Rng same(seed, Purpose::scene);
    const scenes::Vascular scene = scenes::random_vascular(shape, rng);
    const Map map = scene.map();
    ASSERT_TRUE(map.is_free(scene.goal, 1)) << seed;
    EXPECT_EQ(scene.goal, scenes::random_vascular(shape, same).goal);
    // A tree of enough nodes comes near every free place.
    const ObstacleWeightedRrt tree = grow(scene, map, 4000);
    for (int i = 0; i < 500; ++i) {
      const double x = rng.uniform(0, shape.width);
      const Vec2 p{x, rng.uniform(0, shape.height)};
      if (map.is_free(p, 1)) {
        EXPECT_LT(distance(p, tree.nodes[tree.nearest(p)]), 4)
            << seed << " (" << p.x << ", " << p.y << ")";
      }
    }
  }
}

}  // namespace
}  // namespace microswarm::planning
