// SPDX-License-Identifier: Apache-2.0
#include "bench/planning.hpp"

#include <fmt/format.h>

#include <array>
#include <chrono>
#include <stdexcept>

#include "bench/ompl_peer.hpp"
#include "microswarm/core/execution/stop.hpp"
#include "microswarm/core/maths/statistics.hpp"
#include "microswarm/experiment/scenario/scene.hpp"
#include "microswarm/geometry/distance.hpp"
#include "microswarm/geometry/uniform_in.hpp"
#include "microswarm/planning/path/planners.hpp"
#include "microswarm/scenes/worlds.hpp"

namespace microswarm::bench {
namespace {

using Clock = std::chrono::steady_clock;

std::vector<double> our_times(const Snapshot& world, const Pose2& start, Vec2 goal,
                              const planning::PlannerParams& params, int seeds, const Stop& stop) {
  std::vector<double> ms;
  for (int seed = 0; seed < seeds && !stop(); ++seed) {
    Rng rng(1, Purpose::planner, static_cast<std::uint32_t>(seed));
    const auto began = Clock::now();
    const Plan made = planning::plan(world, start, goal, params, rng);
    if (made.status != Status::solved) throw std::runtime_error("bench: a query was not solved");
    ms.push_back(1e3 * seconds_since(began));
  }
  return ms;
}

std::vector<double> peer_times(OmplPlanner planner, const OmplQuery& query, int runs,
                               const Stop& stop) {
  std::vector<double> ms;
  for (int run = 0; run < runs && !stop(); ++run)
    ms.push_back(1e3 * run_ompl(planner, query).seconds);
  return ms;
}

/// Length of the best path of RRT* after 20 ms, beside the shortest there is.
report::BenchRow after_20_ms(const std::string& world_name, const Snapshot& world,
                             const Pose2& start, Vec2 goal, double clearance, int seeds,
                             const Stop& stop) {
  using namespace std::chrono_literals;
  planning::RrtStarParams params;
  params.clearance = clearance;
  params.stop_at_first = false;
  params.max_nodes = 10'000'000;
  params.max_iterations = 100'000'000;
  Rng rng(1, Purpose::planner);
  const planning::ExactParams exact{.clearance = clearance,
                                    .goal_tolerance = params.goal_tolerance};
  // Ours may end anywhere within the tolerance.
  const double shortest =
      path_length(planning::plan(world, start, goal, exact, rng)) - params.goal_tolerance;
  std::vector<double> excess;
  for (int seed = 0; seed < seeds && !stop(); ++seed) {
    Rng stream(1, Purpose::planner, static_cast<std::uint32_t>(seed));
    const Plan made = planning::plan(world, start, goal, params, stream, Stop(20ms));
    excess.push_back(path_length(made) / shortest);
  }
  return {.name = "RRT*, " + world_name + ", after 20 ms",
          .quantity = "length beside the shortest, median",
          .unit = "",
          .ours = quantile(excess, 0.5),
          .aim = 1.01};
}

/// The S-channel of Fig 3 [drrt]: time to the first path.
std::vector<report::BenchRow> s_channel(const std::filesystem::path& scenarios, bool quick,
                                        const Stop& stop) {
  const auto file = scenarios / "papers" / "drrt" / "s_channel.yaml";
  const experiment::Scene scene =
      experiment::load_scene(experiment::read_scenario(file), file.parent_path());
  const Snapshot world = experiment::build_world(scene).at(0);
  const experiment::Scenario& s = scene.scenario;
  const int seeds = quick ? 100 : 1000;
  planning::DrrtStarParams usual;
  usual.exact_route = false;  // the first path of the tree
  std::vector<report::BenchRow> rows;
  const auto add = [&](const char* name, const planning::PlannerParams& ours,
                       std::initializer_list<OmplPlanner> peers, std::optional<double> median,
                       std::optional<double> p99) {
    const auto ms = our_times(world, *s.start, *s.goal, ours, seeds, stop);
    for (const OmplPlanner peer : peers) {
      const auto theirs = peer_times(peer,
                                     {.world = world,
                                      .start = s.start->position,
                                      .goal = *s.goal,
                                      .clearance = usual.clearance,
                                      .goal_tolerance = usual.goal_tolerance,
                                      .range = usual.step},
                                     quick ? 20 : 100, stop);
      for (report::BenchRow& row : time_rows(fmt::format("{}, S-channel", name), ms, theirs,
                                             std::string(to_text(peer)), median, p99))
        rows.push_back(std::move(row));
    }
  };
  using enum OmplPlanner;
  add("D-RRT*, first path", usual, {rrt_star, informed_rrt_star, bit_star, rrt_connect}, 0.15, 0.4);
  add("RRT*, first path", planning::RrtStarParams{}, {rrt_star}, {}, {});
  add("RRT-Connect, first path", planning::RrtConnectParams{}, {rrt_connect}, {}, {});
  add("exact, tangents kept", planning::ExactParams{}, {bit_star, rrt_connect}, {}, {});
  rows.push_back(
      after_20_ms("S-channel", world, *s.start, *s.goal, usual.clearance, quick ? 9 : 50, stop));
  return rows;
}

/// Time to the first path between distant points on a 2000 × 1000 µm map with 140 discs and 70
/// polygons.
std::vector<report::BenchRow> clutter(bool quick, const Stop& stop) {
  Rng rng(1, Purpose::scene);
  const Snapshot world = scenes::cluttered(rng).snapshot();
  constexpr double clearance = 10;
  const std::vector<PathQuery> pairs = far_pairs(world, clearance, 40, rng);
  planning::RrtParams rrt;
  rrt.clearance = clearance;
  planning::DrrtStarParams drrt;
  drrt.clearance = clearance;
  drrt.exact_route = false;
  std::vector<double> theirs;
  for (const PathQuery& q : pairs) {
    const auto more = peer_times(OmplPlanner::rrt_connect,
                                 {.world = world,
                                  .start = q.start.position,
                                  .goal = q.goal,
                                  .clearance = clearance,
                                  .goal_tolerance = rrt.goal_tolerance,
                                  .range = rrt.step},
                                 quick ? 2 : 10, stop);
    theirs.insert(theirs.end(), more.begin(), more.end());
  }
  std::vector<report::BenchRow> rows;
  const auto row = [&](const char* name, const planning::PlannerParams& params,
                       std::optional<double> median, std::optional<double> p99) {
    std::vector<double> ours;
    for (const PathQuery& q : pairs) {
      const auto more = our_times(world, q.start, q.goal, params, quick ? 3 : 25, stop);
      ours.insert(ours.end(), more.begin(), more.end());
    }
    for (report::BenchRow& one : time_rows(name, ours, theirs, "OMPL RRTConnect", median, p99))
      rows.push_back(std::move(one));
  };
  planning::RrtConnectParams connect;
  connect.clearance = clearance;
  row("RRT-Connect, 140 discs and 70 polygons, first path", connect, {}, {});
  row("RRT, 140 discs and 70 polygons, first path", rrt, 0.5, {});
  row("D-RRT*, 140 discs and 70 polygons, first path", drrt, 0.5, 2);
  return rows;
}

/// Growth rate of a tree that continues after its first path, on the same map.
std::vector<report::BenchRow> tree_growth(bool quick, const Stop& stop) {
  Rng rng(1, Purpose::scene);
  const Snapshot world = scenes::cluttered(rng).snapshot();
  constexpr double clearance = 10;
  const PathQuery q = far_pairs(world, clearance, 1, rng).at(0);
  std::vector<report::BenchRow> rows;
  planning::RrtStarParams grow;
  grow.clearance = clearance;
  grow.stop_at_first = false;
  grow.max_nodes = 20'000;
  grow.max_iterations = 1'000'000;
  std::vector<double> rate;
  for (int k = 0; k < (quick ? 3 : 9) && !stop(); ++k) {
    Rng stream(1, Purpose::planner, static_cast<std::uint32_t>(k));
    const auto began = Clock::now();
    const Plan made = planning::plan(world, q.start, q.goal, grow, stream);
    rate.push_back(static_cast<double>(made.tree.size()) / seconds_since(began));
  }
  const OmplQuery long_query{.world = world,
                             .start = q.start.position,
                             .goal = q.goal,
                             .clearance = clearance,
                             .goal_tolerance = grow.goal_tolerance,
                             .range = grow.step,
                             .max_seconds = quick ? 2.0 : 4.0,
                             .first_solution = false};
  const OmplResult star = run_ompl(OmplPlanner::rrt_star, long_query);
  rows.push_back(
      {.name = "RRT*, growing to 20,000 vertices",
       .quantity = "vertices per second",
       .unit = "1/s",
       .ours = quantile(rate, 0.5),
       .peer = static_cast<double>(star.vertices) / star.seconds,
       .peer_name = fmt::format("OMPL RRT* ({} in {:g} s)", star.vertices, long_query.max_seconds),
       .aim = 200'000,
       .at_most = false});
  return rows;
}

}  // namespace

std::vector<report::BenchRow> time_rows(const std::string& name, const std::vector<double>& ours,
                                        const std::vector<double>& theirs, const std::string& peer,
                                        std::optional<double> median_aim,
                                        std::optional<double> p99_aim) {
  std::vector<report::BenchRow> rows;
  for (const auto& [what, share, aim] :
       {std::tuple{"time, median", 0.5, median_aim}, std::tuple{"time, p99", 0.99, p99_aim}})
    rows.push_back({.name = name,
                    .quantity = what,
                    .unit = "ms",
                    .ours = quantile(ours, share),
                    .peer = quantile(theirs, share),
                    .peer_name = peer,
                    .aim = aim});
  return rows;
}

std::vector<PathQuery> far_pairs(const Snapshot& world, double clearance, int count, Rng& rng) {
  const Box& box = world.bounds();
  const auto position = [&] { return uniform_in(box, rng); };
  std::vector<PathQuery> pairs;
  for (int draw = 0; draw < 1000 * count && std::ssize(pairs) < count; ++draw) {
    const PathQuery q{{position(), 0}, position()};
    if (distance(q.start.position, q.goal) >= 0.5 * box.width() &&
        world.is_free(q.start.position, 2 * clearance) && world.is_free(q.goal, 2 * clearance))
      pairs.push_back(q);
  }
  return pairs;
}

std::vector<report::BenchRow> planning(const std::filesystem::path& scenarios, bool quick,
                                       const Stop& stop) {
  std::vector<report::BenchRow> rows = clearance_queries(quick);
  for (auto&& more : {map_loading(quick, stop), exact_paths(quick, stop), clutter(quick, stop),
                      tree_growth(quick, stop), s_channel(scenarios, quick, stop),
                      fmt_star(scenarios, quick, stop), replanning(scenarios, quick, stop)})
    rows.insert(rows.end(), more.begin(), more.end());
  return rows;
}

}  // namespace microswarm::bench
