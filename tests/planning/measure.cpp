// SPDX-License-Identifier: Apache-2.0
// Measures what docs/drrt-star.md and docs/planners.md state. Times are processor times of one
// thread, so that a busy machine does not count.
//
//     planning_measure [s_channel | ideas | radius | first | rate] [TRIALS]
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string_view>

#include "microswarm/core/angles.hpp"
#include "microswarm/planning/planners.hpp"
#include "microswarm/planning/straighten.hpp"
#include "tests/scenes/s_channel.hpp"
#include "tests/scenes/worlds.hpp"

namespace microswarm {
namespace {

double quantile(std::vector<double> v, double q) {
  if (v.empty()) return 0;
  std::sort(v.begin(), v.end());
  return v[std::min(v.size() - 1, static_cast<std::size_t>(q * static_cast<double>(v.size())))];
}

double cpu_ms() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return 1e3 * static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_nsec);
}

struct Question {
  Snapshot world;
  Pose2 start;
  Vec2 goal;
};

struct Tally {
  int asked = 0;
  int solved = 0;
  std::vector<double> length, turning, turning_from_start, ms, nodes;

  void add(const Plan& plan, double start_heading, double time) {
    ++asked;
    ms.push_back(time);
    nodes.push_back(static_cast<double>(plan.tree.size()));
    if (plan.status != Status::solved) return;
    ++solved;
    length.push_back(path_length(plan.path));
    turning.push_back(degrees(path_turning(plan.path)));
    turning_from_start.push_back(degrees(path_turning(plan.path, start_heading)));
  }
  void print(const char* name) const {
    std::printf("%-26s %4d/%-4d %8.1f µm %7.1f° %7.1f°   ms %.3f p99 %.3f max %.3f   nodes %.0f\n",
                name, solved, asked, quantile(length, 0.5), quantile(turning, 0.5),
                quantile(turning_from_start, 0.5), quantile(ms, 0.5), quantile(ms, 0.99),
                quantile(ms, 1), quantile(nodes, 0.5));
  }
};

Question s_channel_question() {
  return {scenes::s_channel(), scenes::s_channel_start, scenes::s_channel_goal};
}

void ask(const char* name, const Question& q, const PlannerParams& params, int trials,
         int straighten_rounds = -1) {
  Tally tally;
  for (int trial = 0; trial < trials; ++trial) {
    Rng rng(1, Purpose::planner, static_cast<std::uint32_t>(trial));
    const double begin = cpu_ms();
    Plan found = plan(q.world, q.start, q.goal, params, rng);
    if (straighten_rounds >= 0) {
      straighten(q.world, 40, q.start.heading, {1, 100}, straighten_rounds, found.path,
                 found.counts.edge_checks);
    }
    tally.add(found, q.start.heading, cpu_ms() - begin);
  }
  tally.print(name);
}

DrrtStarParams as_printed() {
  DrrtStarParams params;
  params.straighten = false;
  return params;
}

void compare(int trials) {
  const Question q = s_channel_question();
  ask("A*", q, AStarParams{}, 10);
  ask("RRT", q, RrtParams{}, trials);
  ask("RRT*", q, RrtStarParams{}, trials);
  ask("uniform RRT*", q, UniformRrtStarParams{}, trials);
  ask("D-RRT* as printed", q, as_printed(), trials);
  ask("D-RRT*", q, DrrtStarParams{}, trials);
}

/// What each part of D-RRT* gives, and what straightening gives to RRT*.
void ideas(int trials) {
  const Question q = s_channel_question();
  ask("as printed", q, as_printed(), trials);
  ask("+ chain of vertices", q, as_printed(), trials, 0);
  ask("+ 1 round", q, as_printed(), trials, 1);
  ask("+ 2 rounds (default)", q, as_printed(), trials, 2);
  ask("+ 5 rounds", q, as_printed(), trials, 5);
  ask("RRT* + 2 rounds", q, RrtStarParams{}, trials, 2);
  for (const int candidates : {1, 2, 10}) {
    DrrtStarParams params = as_printed();
    params.candidates = candidates;
    ask(("as printed, M = " + std::to_string(candidates)).c_str(), q, params, trials);
  }
  for (const double gain : {2.0, 8.0}) {
    DrrtStarParams params = as_printed();
    params.heading_gain = gain;
    ask(gain == 2 ? "as printed, k_p = 2" : "as printed, k_p = 8", q, params, trials);
  }
  for (const double diameter : {150.0, 450.0}) {
    DrrtStarParams params = as_printed();
    params.detection_diameter = diameter;
    ask(diameter == 150 ? "as printed, D_dec = 150" : "as printed, D_dec = 450", q, params, trials);
  }
}

void radius(int trials) {
  const Question q = s_channel_question();
  for (const double r : {80.0, 100.0, 120.0, 160.0, 240.0}) {
    std::printf("search radius %.0f µm\n", r);
    RrtStarParams rrt_star;
    rrt_star.search_radius = r;
    ask("RRT*", q, rrt_star, trials);
    DrrtStarParams drrt_star = as_printed();
    drrt_star.search_radius = r;
    ask("D-RRT* as printed", q, drrt_star, trials);
    drrt_star.straighten = true;
    ask("D-RRT*", q, drrt_star, trials);
  }
}

/// First paths between random free places of a cluttered map.
void first_path(int trials) {
  Rng scene(3, Purpose::scene);
  const scenes::RawWorld raw = scenes::cluttered(scene);
  const Snapshot world = raw.snapshot();
  for (const double clearance : {0.0, 10.0}) {
    std::printf("clearance %.0f µm\n", clearance);
    const auto run = [&](const char* name, PlannerParams params) {
      std::visit([&](auto& p) { p.clearance = clearance; }, params);
      Tally tally;
      for (int trial = 0; trial < trials; ++trial) {
        Rng pick(1, Purpose::start_goal, static_cast<std::uint32_t>(trial));
        Rng rng(1, Purpose::planner, static_cast<std::uint32_t>(trial));
        const Pose2 start{scenes::random_free_point(raw, clearance, pick), 0};
        const Vec2 goal = scenes::random_free_point(raw, clearance, pick);
        const double begin = cpu_ms();
        const Plan found = plan(world, start, goal, params, rng);
        tally.add(found, 0, cpu_ms() - begin);
      }
      tally.print(name);
    };
    run("RRT", RrtParams{});
    run("RRT*", RrtStarParams{});
    run("D-RRT*", DrrtStarParams{});
    run("A*", AStarParams{});
  }
}

void rate() {
  Rng scene(3, Purpose::scene);
  const Snapshot world = scenes::cluttered(scene).snapshot();
  RrtStarParams params;
  params.clearance = 10;
  params.stop_at_first = false;
  params.max_nodes = 20'000;
  params.max_iterations = 1'000'000;
  for (int trial = 0; trial < 5; ++trial) {
    Rng rng(1, Purpose::planner, static_cast<std::uint32_t>(trial));
    const double begin = cpu_ms();
    const Plan found = plan(world, {{60, 60}, 0}, {1940, 940}, params, rng);
    const double seconds = 1e-3 * (cpu_ms() - begin);
    const auto vertices = static_cast<double>(found.tree.size());
    std::printf("RRT*: %.0f vertices, %.0f vertices/s, path %.1f µm\n", vertices,
                vertices / seconds, path_length(found.path));
  }
}

}  // namespace
}  // namespace microswarm

int main(int argc, char** argv) {
  using namespace microswarm;
  const std::string_view what = argc > 1 ? argv[1] : "s_channel";
  const int trials = argc > 2 ? std::max(1, std::atoi(argv[2])) : 100;
  if (what == "s_channel") {
    compare(trials);
  } else if (what == "ideas") {
    ideas(trials);
  } else if (what == "radius") {
    radius(trials);
  } else if (what == "first") {
    first_path(trials);
  } else if (what == "rate") {
    rate();
  } else {
    std::fprintf(stderr, "usage: planning_measure [s_channel|ideas|radius|first|rate] [TRIALS]\n");
    return 2;
  }
  return 0;
}
