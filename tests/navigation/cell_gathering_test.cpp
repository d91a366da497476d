// SPDX-License-Identifier: Apache-2.0
// Distances between cells, the two farthest of some, and gathering from cell to cell.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "microswarm/navigation/gathering/policies/farthest_pair.hpp"
#include "tests/navigation/gathering.hpp"

namespace microswarm::navigation {
namespace {

std::vector<std::uint32_t> some_nodes(const CellGraph& graph, std::size_t count, Rng& rng) {
  std::vector<std::uint32_t> nodes(count);
  for (std::uint32_t& node : nodes) node = static_cast<std::uint32_t>(rng.below(graph.size()));
  return nodes;
}

std::vector<Map> cell_maps() {
  std::vector<Map> maps{scenes::t_junction().map(), scenes::vascular_network().map()};
  for (std::uint32_t number = 1; number <= 4; ++number) {
    Rng rng(number, Purpose::scene);
    maps.push_back(scenes::random_vascular({}, rng).map());
  }
  return maps;
}

// Beside Bellman's equation: each is the least over the neighbours, plus the step.
TEST(CellGraph, DistancesAreShortest) {
  for (const Map& map : cell_maps()) {
    for (const CellSteps steps : {CellSteps::hops, CellSteps::lengths}) {
      const CellGraph graph(map, 1.5, steps);
      const auto all = graph.distances(0);
      const auto until = graph.distances(0, graph.size() / 2);
      EXPECT_EQ(until[graph.size() / 2], all[graph.size() / 2]);
      EXPECT_EQ(all[0], 0u);
      for (std::uint32_t node = 1; node < graph.size(); ++node) {
        std::uint32_t least = CellGraph::unreached;
        for (std::size_t k = 0; k < CellGraph::directions; ++k) {
          const std::uint32_t next = graph.neighbour(node, k);
          if (next == node || all[next] == CellGraph::unreached) continue;
          const std::uint32_t step = steps == CellSteps::hops ? 1 : k % 2 == 0 ? 5 : 7;
          least = std::min(least, all[next] + step);
          EXPECT_EQ(CellGraph::nearest_direction(graph[next] - graph[node]), k);
        }
        ASSERT_EQ(all[node], least);
      }
    }
  }
}

TEST(FarthestPair, IsTheFarthestOfAllPairs) {
  Rng rng(5, Purpose::scene);
  for (const Map& map : cell_maps()) {
    const CellGraph graph(map, 2, CellSteps::lengths);
    for (const std::size_t count : {1u, 2u, 3u, 20u}) {
      for (int k = 0; k < 5; ++k) {
        const auto nodes = some_nodes(graph, count, rng);
        std::uint32_t most = 0;
        for (const std::uint32_t from : nodes) {
          const auto far = graph.distances(from);
          for (const std::uint32_t to : nodes)
            if (far[to] != CellGraph::unreached) most = std::max(most, far[to]);
        }
        const NodePair pair = farthest_pair(graph, nodes);
        EXPECT_EQ(pair.distance, most);
        EXPECT_EQ(graph.distances(nodes[pair.first])[nodes[pair.second]], most);
      }
    }
  }
}

TEST(CommonInput, MovesFromCellToFreeCell) {
  const Map map = scenes::vascular_network().map();
  const CellGraph graph(map, 1, CellSteps::hops);
  const CommonInput input(graph);
  Rng rng(6, Purpose::scene);
  Robots robots = robots_at(graph, some_nodes(graph, 50, rng));
  for (int k = 0; k < 200; ++k) {
    const double x = static_cast<double>(rng.below(3)) - 1;
    const Vec2 move{x, static_cast<double>(rng.below(3)) - 1};
    const Robots before = robots;
    input.step(robots, move);
    for (std::size_t i = 0; i < robots.size(); ++i) {
      const Vec2 next = before.position(i) + move;
      const bool free = map.bounds().lo.x < next.x && next.x < map.bounds().hi.x &&
                        map.bounds().lo.y < next.y && next.y < map.bounds().hi.y &&
                        map.is_free(next, 0);
      ASSERT_EQ(robots.position(i), free ? next : before.position(i));
    }
  }
}

/// Robots in cells of Fig 8(b) that are all to come within ten cells of the goal.
struct InCells {
  scenes::Vascular scene = scenes::vascular_network();
  AggregationParams params = [] {
    AggregationParams p;
    p.gathered = Gathered::all;
    p.sigma = 10.5;
    p.rollout.max_work = 1e6;
    return p;
  }();

  void expect_gathered(Aggregation method, std::size_t count) {
    params.method = method;
    Rng tree(1, Purpose::planner);
    const AggregationMap map(scene.map(), scene.goal, params, tree, MoveRule::cells);
    const CommonInput input(*map.cells);
    Rng rng(7, Purpose::scene);
    Robots robots = robots_at(*map.cells, some_nodes(*map.cells, count, rng));
    GatherResult result;
    if (method == Aggregation::rollout) {
      RolloutPolicy policy(map, input, params, Rng(1, Purpose::planner));
      result = gather(input, policy, robots, 20'000);
    } else {
      AggregationPolicy policy(map, params);
      result = gather(input, policy, robots, 20'000);
    }
    EXPECT_EQ(result.status, Status::solved) << enum_name(method);
    for (std::size_t i = 0; i < robots.size(); ++i)
      EXPECT_LE(map.hops[map.cells->at(robots.position(i))], 10u) << enum_name(method);
  }
};

TEST(CellGathering, EveryMethodBringsAllWithinTenCells) {
  InCells cells;
  for (const auto& [method, name] : enum_names(Aggregation{}))
    for (const std::size_t count : {1u, 2u, 64u}) cells.expect_gathered(method, count);
}

}  // namespace
}  // namespace microswarm::navigation
