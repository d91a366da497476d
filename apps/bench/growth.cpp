// SPDX-License-Identifier: Apache-2.0
#include "bench/growth.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <string>

#include "bench/naive_robots.hpp"
#include "bench/ompl_peer.hpp"
#include "bench/planning.hpp"
#include "bench/radar.hpp"
#include "microswarm/core/maths/angles.hpp"
#include "microswarm/core/maths/maths.hpp"
#include "microswarm/core/maths/rng.hpp"
#include "microswarm/core/maths/statistics.hpp"
#include "microswarm/geometry/uniform_in.hpp"
#include "microswarm/planning/path/planners.hpp"
#include "microswarm/scenes/vascular.hpp"
#include "microswarm/scenes/worlds.hpp"
#include "microswarm/swarm/robots/robot_stepper.hpp"

namespace microswarm::bench {
namespace {

using CountedTimes = std::vector<std::pair<double, double>>;  ///< by a number of things

/// Growth of times with a number of objects.
struct Growth {
  std::string name;
  std::string of;  ///< the objects counted
  std::string unit;
  std::string peer;
  double aim = 1;  ///< the exponent, at most
  CountedTimes ours = {};
  CountedTimes theirs = {};  ///< not always of the same numbers

  void add_to(std::vector<report::BenchRow>& rows) const;
};

/// Slope of the line through the logarithms, by least squares: times grow as the number to this
/// power. Nothing for fewer than three.
std::optional<double> exponent(const CountedTimes& times) {
  if (times.size() < 3) return std::nullopt;
  std::vector<double> x, y;
  for (const auto& [n, t] : times) x.push_back(maths::log(n)), y.push_back(maths::log(t));
  const double mean_x = mean(x), mean_y = mean(y);
  double above = 0, below = 0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    above += (x[k] - mean_x) * (y[k] - mean_y);
    below += (x[k] - mean_x) * (x[k] - mean_x);
  }
  return above / below;
}

void Growth::add_to(std::vector<report::BenchRow>& rows) const {
  for (const auto& [n, t] : ours) {
    report::BenchRow row{.name = fmt::format("{}, {} {}", name, n, of),
                         .quantity = "time, median",
                         .unit = unit,
                         .ours = t};
    for (const auto& [theirs_n, theirs_t] : theirs)
      if (theirs_n == n) row.peer = theirs_t, row.peer_name = peer;
    rows.push_back(std::move(row));
  }
  const std::optional<double> fitted = exponent(ours);
  if (!fitted) return;
  report::BenchRow row{
      .name = fmt::format("{}, {} to {} {}", name, ours.front().first, ours.back().first, of),
      .quantity = "exponent of its growth",
      .ours = *fitted,
      .aim = aim};
  if (const auto beside = exponent(theirs)) row.peer = beside, row.peer_name = peer;
  rows.push_back(std::move(row));
}

/// Median time of a call, in `unit` seconds.
template <class Call>
double mean_time(int repeats, double unit, Call&& call) {
  std::vector<double> times;
  for (int k = 0; k < repeats; ++k) {
    const auto began = std::chrono::steady_clock::now();
    call(k);
    times.push_back(seconds_since(began) / unit);
  }
  return quantile(times, 0.5);
}

constexpr double microsecond = 1e-6;
constexpr double millisecond = 1e-3;

/// A step of robots that slide along the walls of the larger vascular map.
Growth of_robots(bool quick, const Stop& stop) {
  Growth growth{
      .name = "a step, robots slide", .of = "robots", .unit = "µs", .peer = {}, .aim = 1.1};
  const Map map = scenes::larger_vascular_network().map();
  const RobotStepper stepper(map, 1);
  Rng rng(1, Purpose::scene);
  std::vector<Vec2> positions;
  while (positions.size() < 65536) {
    const Vec2 p = uniform_in(map.bounds(), rng);
    if (map.is_free(p, 4 * stepper.guard())) positions.push_back(p);
  }
  const int count = quick ? 200 : 1000;
  std::vector<Vec2> moves;
  moves.reserve(static_cast<std::size_t>(count));
  for (int k = 0; k < count; ++k)
    moves.push_back(k % 25 == 0 ? unit_vector(rng.uniform(0, 2 * pi)) : moves.back());
  for (const std::size_t n : {256U, 1024U, 4096U, 16384U, 65536U}) {
    if (stop()) break;
    const std::vector<Vec2> first(positions.begin(),
                                  positions.begin() + static_cast<std::ptrdiff_t>(n));
    Robots all = stepper.place(first);
    const double ours = mean_time(count, microsecond, [&](int k) {
      stepper.step(all, moves[static_cast<std::size_t>(k)], ContactRule::slide);
    });
    growth.ours.emplace_back(n, ours);
  }
  return growth;
}

/// Guarded decisions of the radar on drives among discs.
Growth of_obstacles(bool quick, const Stop& stop) {
  Growth growth{.name = "a guarded radar decision on a drive",
                .of = "discs",
                .unit = "µs",
                .peer = "every direction against every disc",
                .aim = 0.5};
  for (const int n : {16, 64, 256, 1024, 4096}) {
    if (stop()) break;
    const DecisionTimes times = drive(n, true, quick ? 2 : 10, stop);
    growth.ours.emplace_back(n, quantile(times.ours, 0.5));
    growth.theirs.emplace_back(n, quantile(times.naive, 0.5));
  }
  return growth;
}

/// RRT* that grows among discs and polygons.
Growth of_vertices(bool quick, const Stop& stop) {
  Growth growth{
      .name = "RRT* grown", .of = "vertices", .unit = "ms", .peer = "OMPL RRT*", .aim = 1.2};
  Rng rng(1, Purpose::scene);
  const Snapshot world = scenes::cluttered(rng).snapshot();
  planning::RrtStarParams params;
  params.clearance = 10;
  params.stop_at_first = false;
  params.max_iterations = 10'000'000;
  const PathQuery q = far_pairs(world, params.clearance, 1, rng).at(0);
  for (const int n : {1000, 4000, 16'000, 64'000}) {
    if (stop()) break;
    params.max_nodes = n;
    const double ours = mean_time(quick ? 1 : 5, millisecond, [&](int k) {
      Rng stream(1, Purpose::planner, static_cast<std::uint32_t>(k));
      planning::plan(world, q.start, q.goal, params, stream);
    });
    growth.ours.emplace_back(n, ours);
  }
  // OMPL stops after a time.
  for (const double seconds : {0.1, 0.4, 1.6, 6.4}) {
    if (stop() || (quick && seconds > 2)) break;
    const OmplResult found =
        run_ompl(OmplPlanner::rrt_star, {.world = world,
                                         .start = q.start.position,
                                         .goal = q.goal,
                                         .clearance = params.clearance,
                                         .goal_tolerance = params.goal_tolerance,
                                         .range = params.step,
                                         .max_seconds = seconds,
                                         .first_solution = false});
    growth.theirs.emplace_back(found.vertices, found.seconds / millisecond);
  }
  return growth;
}

/// Growth of map queries with the number of shapes.
std::vector<Growth> of_shapes(bool quick, const Stop& stop) {
  constexpr double clearance = 10;
  Growth loads{.name = "a map made", .of = "shapes", .unit = "ms", .peer = {}, .aim = 1.1};
  Growth positions{.name = "is the place free",
                   .of = "shapes",
                   .unit = "ns",
                   .peer = "every shape in turn",
                   .aim = 0.2};
  Growth exact{.name = "exact across the map, tangents kept",
               .of = "shapes",
               .unit = "ms",
               .peer = "our A*, cells of 10 µm",
               .aim = 1};
  for (const int side : {1, 2, 4, 8}) {
    if (stop()) break;
    Rng rng(4, Purpose::scene);
    const scenes::RawWorld raw = scenes::cluttered(rng, side);
    const auto count = static_cast<double>(raw.walls.size() + raw.discs.size());
    loads.ours.emplace_back(count,
                            mean_time(quick ? 1 : 5, millisecond, [&](int) { raw.snapshot(); }));
    const Snapshot world = raw.snapshot();
    std::vector<Vec2> asked(100'000);
    for (Vec2& p : asked) p = uniform_in(world.bounds(), rng);
    std::size_t sum = 0;
    const double all = mean_time(5, 1e-9, [&](int) {
      for (const Vec2 p : asked) sum += world.is_free(p, clearance) ? 1 : 0;
    });
    positions.ours.emplace_back(
        count, all / static_cast<double>(asked.size()) + 0 * static_cast<double>(sum));
    const double naive = mean_time(quick ? 20 : 200, 1e-9, [&](int k) {
      sum += raw.clearance(asked[static_cast<std::size_t>(k)]) >= clearance ? 1 : 0;
    });
    positions.theirs.emplace_back(count, naive + 0 * static_cast<double>(sum));
    const std::vector<PathQuery> pairs = far_pairs(world, clearance, quick ? 5 : 20, rng);
    const auto ask = [&](const planning::PlannerParams& params) {
      return mean_time(static_cast<int>(pairs.size()), millisecond, [&](int k) {
        const PathQuery& q = pairs[static_cast<std::size_t>(k)];
        planning::plan(world, q.start, q.goal, params, rng);
      });
    };
    const planning::ExactParams params{.clearance = clearance};
    for (int round = 0; round < 10; ++round) ask(params);  // until its tangents are kept
    exact.ours.emplace_back(count, ask(params));
    planning::AStarParams grid;
    grid.clearance = clearance;
    grid.cell = 10;
    exact.theirs.emplace_back(count, ask(grid));
  }
  return {loads, positions, exact};
}

}  // namespace

std::vector<report::BenchRow> growth(bool quick, const Stop& stop) {
  std::vector<report::BenchRow> rows;
  of_robots(quick, stop).add_to(rows);
  of_obstacles(quick, stop).add_to(rows);
  of_vertices(quick, stop).add_to(rows);
  for (const Growth& one : of_shapes(quick, stop)) one.add_to(rows);
  return rows;
}

}  // namespace microswarm::bench
