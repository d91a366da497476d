// SPDX-License-Identifier: Apache-2.0
#include "bench/global.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <string>

#include "bench/ompl_global.hpp"
#include "microswarm/core/execution/stop.hpp"
#include "microswarm/core/maths/statistics.hpp"
#include "microswarm/experiment/record/global_tree_file.hpp"
#include "microswarm/formats/images/mask.hpp"
#include "microswarm/geometry/bucket_kd_tree.hpp"
#include "microswarm/scenes/global_tasks.hpp"
#include "microswarm/scenes/global_worlds.hpp"

namespace microswarm::bench {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t published_nodes = 341'997;  // Fig 9 [global]

planning::GlobalTree grow(const Map& map, std::span<const Vec2> starts, std::size_t nodes,
                          double step = 5) {
  planning::GlobalRrtParams params;
  params.robostep = step;
  params.max_nodes = static_cast<int>(nodes);
  Rng rng(1, Purpose::planner);
  return planning::global_rrt(map, starts, {}, params, rng).tree;
}

/// Nodes per second: median of several runs.
double rate(const Map& map, std::span<const Vec2> starts, std::size_t nodes, int repeats,
            double step, const Stop& stop) {
  std::vector<double> rates;
  for (int k = 0; k < repeats && !stop(); ++k) {
    const auto began = Clock::now();
    const planning::GlobalTree tree = grow(map, starts, nodes, step);
    rates.push_back(static_cast<double>(tree.size()) / seconds_since(began));
  }
  return rates.empty() ? 0 : median(rates);
}

/// Memory per node during growth: its entry and its share of the kd-tree.
double bytes_a_node(const planning::GlobalTree& tree) {
  BucketKdTree nearest(2 * tree.robots);
  for (std::uint32_t node = 0; node < tree.size(); ++node) nearest.add(tree.configuration(node));
  return static_cast<double>(tree.bytes() + nearest.bytes()) / static_cast<double>(tree.size());
}

std::vector<report::BenchRow> growth(bool quick, const Stop& stop) {
  const Map map = scenes::global_world(1);
  const std::size_t nodes = quick ? 100'000 : 300'000;
  std::vector<report::BenchRow> rows;
  for (const auto& [robots, aim] : {std::pair{2, 200e3}, std::pair{3, 100e3}, std::pair{4, 50e3}}) {
    const auto starts = std::span(scenes::global_starts).first(static_cast<std::size_t>(robots));
    const OmplGrowth peer = grow_ompl(map, starts, {}, nodes, quick ? 3 : 20);
    const std::string name = fmt::format("Env 1, {} robots, {} nodes", robots, nodes);
    rows.push_back({.name = name,
                    .quantity = "nodes per second",
                    .unit = "1/s",
                    .ours = rate(map, starts, nodes, quick ? 1 : 3, 5, stop),
                    .peer = static_cast<double>(peer.nodes) / peer.seconds,
                    .peer_name = fmt::format("OMPL RRT ({} in {:.0f} s)", peer.nodes, peer.seconds),
                    .aim = aim,
                    .at_most = false});
    rows.push_back({.name = name,
                    .quantity = "memory a node",
                    .unit = "B",
                    .ours = bytes_a_node(grow(map, starts, nodes)),
                    .aim = 100});
    if (stop()) break;
  }
  return rows;
}

/// The map rasterised with pixels of `px` µm.
Map in_pixels(const Map& map, double px) {
  const Box& box = map.bounds();
  formats::Mask walls(static_cast<int>(box.width() / px), static_cast<int>(box.height() / px));
  for (int row = 0; row < walls.height; ++row)
    for (int column = 0; column < walls.width; ++column)
      walls.at(column, row) = !map.is_free(formats::cell_centre(walls, column, row, px, box.lo), 0);
  return {formats::cell_bounds(walls, px, box.lo), formats::mask_walls(walls, px, box.lo)};
}

/// Tree growth on a vessel mask as obstacle map.
report::BenchRow raster(bool quick, const Stop& stop) {
  const scenes::GlobalTask task = scenes::vascular_task();
  const std::size_t nodes = quick ? 50'000 : 200'000;
  const int repeats = quick ? 1 : 3;
  const Map pixels = in_pixels(task.map, 0.5);
  return {.name = "vascular network of 800 × 628 pixels, 3 robots",
          .quantity = "nodes per second",
          .unit = "1/s",
          .ours = rate(pixels, task.starts, nodes, repeats, task.robostep, stop),
          .peer = rate(task.map, task.starts, nodes, repeats, task.robostep, stop),
          .peer_name = "the same walls as polygons, ours",
          .at_most = false};
}

std::vector<report::BenchRow> kept_tree(const Stop& stop) {
  const formats::LoadedMap map{std::make_shared<const Map>(scenes::global_world(3)), 3};
  const planning::GlobalTree tree = grow(*map.map, scenes::global_starts, published_nodes);
  std::vector<double> asking;
  for (int k = 0; k < 20 && !stop(); ++k) {
    const std::span<const Vec2> goals =
        k % 2 == 0 ? std::span<const Vec2>(scenes::global_goals) : scenes::global_other_goals;
    const auto began = Clock::now();
    const planning::GoalAnswer answer = planning::ask(tree, goals, 20);
    asking.push_back(1e3 * seconds_since(began) + (answer.node > tree.size() ? 1 : 0));
  }
  namespace fs = std::filesystem;
  const fs::path file =
      fs::temp_directory_path() / fmt::format("microswarm_bench_{}.h5", ::getpid());
  auto began = Clock::now();
  experiment::write_global_tree(tree, map, file);
  const double writing = seconds_since(began);
  began = Clock::now();
  const planning::GlobalTree loaded = experiment::read_global_tree(file, map);
  const double reading = seconds_since(began);
  fs::remove(file);
  const std::string name = fmt::format("tree of {} nodes, 4 robots", loaded.size());
  return {
      {.name = name,
       .quantity = "asking it for other goals, median",
       .unit = "ms",
       .ours = median(asking),
       .aim = 5},
      {.name = name, .quantity = "saving it", .unit = "s", .ours = writing},
      {.name = name, .quantity = "loading it, every input played", .unit = "s", .ours = reading}};
}

}  // namespace

std::vector<report::BenchRow> global(bool quick, const Stop& stop) {
  std::vector<report::BenchRow> rows = growth(quick, stop);
  if (stop()) return rows;
  rows.push_back(raster(quick, stop));
  for (report::BenchRow& row : kept_tree(stop)) rows.push_back(std::move(row));
  return rows;
}

}  // namespace microswarm::bench
