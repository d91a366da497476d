// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <filesystem>

#include "microswarm/report/picture.hpp"
#include "microswarm/reproduce/gather/gather.hpp"

namespace microswarm::reproduce {
namespace {

// Fig 3 to 6 on the map of Fig 8(b): the tree, its weights, the regions and DCA.

void draw_routes(report::Picture& picture, const navigation::AggregationMap& map,
                 const planning::Routes& routes, report::Colour colour) {
  for (std::size_t v = 0; v < map.tree.nodes.size(); ++v)
    picture.line(std::array{map.tree.nodes[v], map.tree.nodes[routes.next[v]]}, colour, 1);
}

void draw_robots(report::Picture& picture, const Robots& robots, report::Colour colour) {
  for (std::size_t i = 0; i < robots.size(); ++i) picture.disc({robots.position(i), 0.4}, colour);
}

report::Picture& with_walls(report::Picture& picture, const navigation::AggregationMap& map) {
  picture.walls(map.map);
  return picture;
}

void keep(report::Picture& picture, const navigation::AggregationMap& map,
          const ReproduceOptions& options, const std::string& name) {
  picture.mark(map.tree.nodes[0], "goal", report::colours::goal);
  if (!options.out.empty()) picture.write_everywhere(std::filesystem::path(options.out) / name);
}

/// Fig 4: the tree, and the routes along the medial axis.
void draw_trees(const navigation::AggregationMap& map, const ReproduceOptions& options) {
  report::Picture plain(map.map.bounds(), "RRT, Alg 1");
  draw_routes(with_walls(plain, map), map, map.tree.plain, report::colours::tree);
  keep(plain, map, options, "fig4a");
  report::Picture weighted(map.map.bounds(), "obstacle-weighted RRT, Alg 2");
  draw_routes(with_walls(weighted, map), map, map.tree.weighted, report::colours::tree);
  for (std::size_t v = 0; v < map.tree.nodes.size(); ++v)
    if (map.tree.medial[v]) weighted.disc({map.tree.nodes[v], 0.15}, report::colours::swarm);
  weighted.legend("V*", report::colours::swarm, true);
  keep(weighted, map, options, "fig4b");
}

/// Fig 5: junction nodes, regions, and the branches of one region.
void draw_regions(const navigation::AggregationMap& map, const ReproduceOptions& options) {
  const planning::MapSegmentation& found = map.segmentation;
  const auto of = [](std::uint32_t k) {
    return report::colours::robots[k % report::colours::robots.size()];
  };
  const auto most =
      std::max_element(found.regions.begin(), found.regions.end(),
                       [](const Region& a, const Region& b) { return a.branches < b.branches; });
  const auto shown = static_cast<std::uint32_t>(most - found.regions.begin());
  report::Picture junctions(map.map.bounds(), "junction nodes, Alg 4");
  report::Picture regions(map.map.bounds(), "regions, Alg 4");
  report::Picture branches(map.map.bounds(), "branches of a region, Alg 4");
  for (report::Picture* picture : {&junctions, &regions, &branches}) with_walls(*picture, map);
  for (std::uint32_t v = 0; v < map.tree.nodes.size(); ++v) {
    const Disc node{map.tree.nodes[v], 0.25};
    if (map.tree.medial[v]) junctions.disc(node, report::colours::goal);
    regions.disc(node, of(found.region[v]));
    if (found.region[v] == shown) branches.disc(node, of(found.branch[v]));
  }
  for (const std::uint32_t v : found.junction_nodes)
    junctions.disc({map.tree.nodes[v], 0.3}, report::colours::swarm);
  junctions.legend("V*", report::colours::goal, true);
  junctions.legend("V_J", report::colours::swarm, true);
  keep(junctions, map, options, "fig5a");
  keep(regions, map, options, "fig5b");
  keep(branches, map, options, "fig5c");
}

/// Fig 6: the swarm before, during and after DCA.
void draw_transitions(const navigation::AggregationMap& map, const scenes::Vascular& scene,
                      const ReproduceOptions& options) {
  const RobotStepper stepper(map.map, 1);
  Robots robots = gather_robots(scene, map, stepper, 64, 0, 0);
  navigation::AggregationPolicy policy(
      map, gather_params(scene, navigation::Aggregation::divide_and_conquer));
  int done = 0;
  for (const int steps : {0, 100, 300, 600}) {
    for (; done < steps; ++done) {
      const auto move = policy.next(robots);
      if (!move) break;
      stepper.step(robots, *move, ContactRule::stop);
    }
    report::Picture picture(map.map.bounds(), "DCA, " + std::to_string(done) + " steps");
    draw_robots(with_walls(picture, map), robots, report::colours::path);
    keep(picture, map, options, "fig6-" + std::to_string(steps));
  }
}

/// Fig 3: a swarm led around a corner along the medial axis and along the shortest path. Returns
/// the final distance of its robots from their mean.
double spread_when_led(const navigation::AggregationMap& map, Vec2 start,
                       const ReproduceOptions& options, const std::string& name) {
  constexpr int count = 64;
  constexpr double radius = 3;
  const RobotStepper stepper(map.map, 1);
  Rng rng(1, Purpose::scene);
  std::vector<Vec2> positions;
  while (std::ssize(positions) < count) {
    const double x = rng.uniform(-radius, radius);
    const Vec2 off{x, rng.uniform(-radius, radius)};
    if (norm(off) <= radius && map.map.is_free(start + off, 4 * stepper.guard()))
      positions.push_back(start + off);
  }
  Robots robots = stepper.place(positions);
  Robots leader = stepper.place(std::vector<Vec2>{start});
  navigation::AggregationParams params;
  params.method = navigation::Aggregation::heuristic;
  params.sigma = 2;
  navigation::AggregationPolicy policy(map, params);
  std::vector<Vec2> path{start};
  for (int i = 0; i < 2000; ++i) {
    const auto move = policy.next(leader);
    if (!move) break;
    for (Robots* all : {&leader, &robots}) stepper.step(*all, *move, ContactRule::stop);
    path.push_back(leader.position(0));
  }
  const Vec2 end = leader.position(0);
  double sum = 0;
  for (std::size_t i = 0; i < robots.size(); ++i) sum += distance(robots.position(i), end);
  report::Picture picture(map.map.bounds(), name);
  with_walls(picture, map).line(path);
  draw_robots(picture, stepper.place(positions), report::colours::swarm);
  draw_robots(picture, robots, report::colours::obstacle);
  picture.legend("at the start", report::colours::swarm, true);
  picture.legend("at the end", report::colours::obstacle, true);
  keep(picture, map, options, map.obstacle_weighted ? "fig3-middle" : "fig3-tree");
  return sum / count;
}

}  // namespace

void gather_maps(const ReproduceOptions& options, const Stop&,
                 std::vector<report::ReproduceRow>& rows) {
  const scenes::Vascular scene = scenes::vascular_network();
  const navigation::AggregationMap map = gather_map(scene, true);
  const navigation::AggregationMap plain = gather_map(scene, false);
  constexpr Vec2 start{24, 95};
  const double middle = spread_when_led(map, start, options, "along the middle");
  const double tree = spread_when_led(plain, start, options, "along the RRT");
  rows.push_back(row_without_aim("a drawing in the paper", "fig3-6",
                                 "mean distance from the leader at the goal, along the middle",
                                 "µm", {}, middle));
  rows.push_back(row_without_aim("a drawing in the paper", "fig3-6",
                                 "mean distance from the leader at the goal, along the RRT", "µm",
                                 {}, tree));
  rows.push_back(row_within(0, "fig3-6", "regions of Fig 8(b)", "1", 9,
                            static_cast<double>(map.segmentation.regions.size())));
  draw_trees(map, options);
  draw_regions(map, options);
  draw_transitions(map, scene, options);
}

}  // namespace microswarm::reproduce
