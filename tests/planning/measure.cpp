// SPDX-License-Identifier: Apache-2.0
// Prints what docs/drrt-star.md and docs/planners.md state: quality and time of every planner.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>

#include "microswarm/core/angles.hpp"
#include "microswarm/planning/planners.hpp"
#include "tests/scenes/s_channel.hpp"
#include "tests/scenes/worlds.hpp"

using namespace microswarm;

namespace {

double quantile(std::vector<double> v, double q) {
  std::sort(v.begin(), v.end());
  return v[std::min(v.size() - 1, static_cast<std::size_t>(q * static_cast<double>(v.size())))];
}

/// Processor time of this thread [ms]: what the planner takes on a core of its own.
double cpu_ms() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return 1e3 * static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_nsec);
}

struct Result {
  std::vector<double> length, turning, turning_from_start, ms, nodes;
  int solved = 0;
};

Result measure(const Snapshot& world, Pose2 start, Vec2 goal, const PlannerParams& params,
               int seeds) {
  Result result;
  for (int seed = 1; seed <= seeds; ++seed) {
    Rng rng(static_cast<std::uint64_t>(seed), Purpose::planner);
    const double begin = cpu_ms();
    const Plan p = plan(world, start, goal, params, rng);
    result.ms.push_back(cpu_ms() - begin);
    result.nodes.push_back(static_cast<double>(p.tree.size()));
    if (p.status != Status::solved) continue;
    ++result.solved;
    result.length.push_back(path_length(p.path));
    result.turning.push_back(degrees(path_turning(p.path)));
    result.turning_from_start.push_back(degrees(path_turning(p.path, start.heading)));
  }
  return result;
}

Result row(const char* name, const Snapshot& world, Pose2 start, Vec2 goal,
           const PlannerParams& params, int seeds) {
  const Result r = measure(world, start, goal, params, seeds);
  std::printf("%-22s %4d/%d solved", name, r.solved, seeds);
  if (r.solved)
    std::printf("  length %7.1f  turning %6.1f (with start %6.1f)", quantile(r.length, 0.5),
                quantile(r.turning, 0.5), quantile(r.turning_from_start, 0.5));
  std::printf("  ms median %.3f p99 %.3f max %.3f  nodes %.0f\n", quantile(r.ms, 0.5),
              quantile(r.ms, 0.99), quantile(r.ms, 1), quantile(r.nodes, 0.5));
  return r;
}

void s_channel(int seeds, const DeformingChannel& shape) {
  const Snapshot world = scenes::s_channel(shape);
  const Pose2 start = scenes::s_channel_start;
  const Vec2 goal = scenes::s_channel_goal;
  DrrtStarParams plain;
  plain.straighten = false;
  row("A*", world, start, goal, AStarParams{}, 3);
  row("RRT", world, start, goal, RrtParams{}, seeds);
  row("RRT*", world, start, goal, RrtStarParams{}, seeds);
  row("uniform RRT*", world, start, goal, UniformRrtStarParams{}, seeds);
  row("D-RRT* plain", world, start, goal, plain, seeds);
  row("D-RRT*", world, start, goal, DrrtStarParams{}, seeds);
}

void first_path(int seeds) {
  Rng rng(1, Purpose::scene);
  for (int i = 0; i < 3; ++i) {
    const scenes::RawWorld raw = scenes::cluttered(rng);
    const Snapshot world = raw.snapshot();
    for (const double clearance : {0.0, 10.0, 20.0}) {
      const Vec2 start{60, 60}, goal{1940, 940};
      std::printf("clearance %g\n", clearance);
      RrtParams rrt;
      rrt.clearance = clearance;
      DrrtStarParams drrt;
      drrt.clearance = clearance;
      row("RRT first path", world, {start, 0}, goal, rrt, seeds);
      row("D-RRT* first path", world, {start, 0}, goal, drrt, seeds);
    }
  }
}

void rate() {
  Rng rng(1, Purpose::scene);
  const Snapshot world = scenes::cluttered(rng).snapshot();
  for (const bool shrinking : {true, false}) {
    RrtStarParams params;
    params.clearance = 10;
    params.stop_at_first = false;
    params.max_nodes = 20'000;
    params.max_iterations = 1'000'000;
    params.shrinking = shrinking;
    Rng stream(1, Purpose::planner);
    const auto begin = std::chrono::steady_clock::now();
    const Plan p = plan(world, {{60, 60}, 0}, {1940, 940}, params, stream);
    const std::chrono::duration<double> time = std::chrono::steady_clock::now() - begin;
    std::printf("RRT* %s: %zu vertices, %.0f vertices/s, cost %.1f\n",
                shrinking ? "shrinking" : "fixed 160", p.tree.size(),
                static_cast<double>(p.tree.size()) / time.count(), path_length(p.path));
  }
}

}  // namespace

int main(int argc, char** argv) {
  const int seeds = argc > 2 ? std::atoi(argv[2]) : 100;
  if (argc < 2 || !std::strcmp(argv[1], "s_channel")) {
    DeformingChannel shape = scenes::s_channel_shape();
    if (argc > 3) shape.centre_line[1].y = 700 + std::atof(argv[3]);
    if (argc > 3) shape.centre_line[3].y = 300 - std::atof(argv[3]);
    if (argc > 4) shape.half_width = std::atof(argv[4]);
    s_channel(seeds, shape);
  }
  if (argc < 2 || !std::strcmp(argv[1], "first")) first_path(seeds);
  if (argc < 2 || !std::strcmp(argv[1], "rate")) rate();
}
