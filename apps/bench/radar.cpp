// SPDX-License-Identifier: Apache-2.0
#include "bench/radar.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iterator>
#include <limits>
#include <memory>
#include <string>
#include <tuple>

#include "microswarm/core/maths/angles.hpp"
#include "microswarm/core/maths/rng.hpp"
#include "microswarm/core/maths/statistics.hpp"
#include "microswarm/geometry/uniform_in.hpp"
#include "microswarm/navigation/radar/radar.hpp"
#include "microswarm/scenes/worlds.hpp"
#include "microswarm/world/world.hpp"

namespace microswarm::bench {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double swarm_radius = 350;
constexpr double room_an_obstacle = 1400;  // side of its square [µm]

/// A swarm among obstacles, at least one of which is in its detection circle.
struct Place {
  std::shared_ptr<const Snapshot> world;
  Vec2 swarm;
};

Body obstacle(Vec2 at, bool is_disc, std::uint32_t number, Rng& rng) {
  Body body{.shape = Disc{at, 275}, .obstacle = number};
  if (!is_disc) body.shape = scenes::turned_rectangle(at, 700, 300, rng.uniform(-pi, pi));
  return body;
}

std::vector<Place> places(int obstacles, bool discs, int count, Rng& rng) {
  const double side = room_an_obstacle * std::sqrt(obstacles);
  const auto map = std::make_shared<const Map>(Box{{0, 0}, {side, side}}, std::vector<Polygon>{});
  const RadarCircles circles = navigation::make_circles({}, swarm_radius);
  std::vector<Place> all;
  for (int draw = 0; draw < 1000 * count && std::ssize(all) < count; ++draw) {
    std::vector<Body> bodies;
    for (int i = 0; i < obstacles; ++i) {
      const double x = rng.uniform(0, side);
      bodies.push_back(
          obstacle({x, rng.uniform(0, side)}, discs, static_cast<std::uint32_t>(i), rng));
    }
    const auto world = std::make_shared<const Snapshot>(map, 0, std::move(bodies));
    for (int k = 0; k < 20 && std::ssize(all) < count; ++k) {
      const double x = rng.uniform(0.1 * side, 0.9 * side);
      const Vec2 p{x, rng.uniform(0.1 * side, 0.9 * side)};
      const double gap = world->moving().clearance(p, 1e9);
      if (gap > swarm_radius && gap < circles.detection) all.push_back({world, p});
    }
  }
  return all;
}

template <class Decide>
std::vector<double> times(const std::vector<Place>& all, int rounds, const Stop& stop,
                          Decide&& decide) {
  std::vector<double> microseconds;
  for (int round = 0; round < rounds && !stop(); ++round) {
    for (const Place& position : all) {
      const auto began = Clock::now();
      decide(position);
      const std::chrono::duration<double, std::micro> took = Clock::now() - began;
      if (round > 0 || rounds == 1) microseconds.push_back(took.count());  // else warm-up
    }
  }
  return microseconds;
}

/// Times of a decision to be met [µs].
struct Aims {
  std::optional<double> p50, p99;
};

/// Discs or boxes that move steadily to and fro.
World moving_world(int obstacles, bool discs, Rng& rng) {
  const double side = room_an_obstacle * std::sqrt(obstacles);
  const Box box{{0, 0}, {side, side}};
  World world{std::make_shared<const Map>(box, std::vector<Polygon>{}), {}};
  for (int i = 0; i < obstacles; ++i) {
    const Shape shape = discs ? Shape(DiscShape{275}) : Shape(BoxShape{700, 300});
    const Vec2 from = uniform_in(box, rng);
    const Vec2 to = uniform_in(box, rng);
    world.obstacles.push_back({shape, Waypoints{{from, to}, rng.uniform(10, 60), AtEnd::back}});
  }
  return world;
}

navigation::Task task(Vec2 goal) {
  return {.swarm = {.radius = swarm_radius,
                    .max_speed = 85.8,
                    .max_turn_rate = std::numeric_limits<double>::infinity()},
          .goal = goal,
          .goal_tolerance = 1};
}

Observation observed(const Snapshot& world, Vec2 swarm, double now) {
  return {.now = now,
          .seen = now,
          .swarm = SwarmPose{{swarm, 0}, swarm_radius},
          .robots = {},
          .world = borrowed(world)};
}

std::vector<report::BenchRow> bench_rows(const std::string& name, const DecisionTimes& times,
                                         Aims aims) {
  std::vector<report::BenchRow> rows;
  for (const double q : {0.5, 0.99})
    rows.push_back({.name = name,
                    .quantity = q < 0.6 ? "time of a decision, p50" : "time of a decision, p99",
                    .unit = "µs",
                    .ours = quantile(times.ours, q),
                    .peer = quantile(times.naive, q),
                    .peer_name = "every direction against every obstacle",
                    .aim = q < 0.6 ? aims.p50 : aims.p99});
  return rows;
}

/// Rows of a radar decision, as published or with the safety filter.
void add_rows(std::vector<report::BenchRow>& rows, const std::string& name, int obstacles,
              bool discs, bool guarded, Aims aims, bool quick, const Stop& stop) {
  Rng rng(1, Purpose::scene);
  const std::vector<Place> all = places(obstacles, discs, quick ? 100 : 400, rng);
  navigation::RadarParams params;
  params.safety_filter.active = guarded;
  navigation::RadarNavigator navigator(params, task({0, 0}), Rng(1, Purpose::planner));
  double now = 0;
  double sum = 0;  // prevents the results from being optimised away
  DecisionTimes measured;
  measured.ours = times(all, quick ? 20 : 100, stop, [&](const Place& position) {
    now += 0.1;
    sum += navigator.step(observed(*position.world, position.swarm, now), {}).heading;
  });
  measured.naive = times(all, quick ? 1 : 3, stop, [&](const Place& position) {
    navigator.step(observed(*position.world, position.swarm, now), {});
    if (navigator.last_look())
      sum += navigation::scan(*navigator.last_look(), *position.world, 360).weights.target;
  });
  std::ranges::move(bench_rows(name, measured, aims), std::back_inserter(rows));
  rows.back().ours += 0 * sum;
}

}  // namespace

DecisionTimes drive(int obstacles, bool discs, int drives, const Stop& stop) {
  constexpr double tick = 0.1;
  constexpr int ticks = 200;
  constexpr int warm_up = 5;
  Rng rng(2, Purpose::scene);
  DecisionTimes times;
  double sum = 0;  // prevents the results from being optimised away
  const auto micros = [](Clock::duration time) {
    return std::chrono::duration<double, std::micro>(time).count();
  };
  for (int k = 0; k < drives && !stop(); ++k) {
    const World world = moving_world(obstacles, discs, rng);
    const double side = world.map->bounds().width();
    navigation::RadarNavigator navigator({}, task({0.9 * side, 0.9 * side}),
                                         Rng(1, Purpose::planner));
    Vec2 swarm{0.1 * side, 0.1 * side};
    for (int i = 0; i < ticks; ++i) {
      const Snapshot seen = world.at(i * tick);
      const auto began = Clock::now();
      const Command command = navigator.step(observed(seen, swarm, i * tick), {});
      const auto decided = Clock::now();
      if (navigator.last_look())
        sum += navigation::scan(*navigator.last_look(), seen, 360).weights.target;
      const auto scanned = Clock::now();
      swarm += tick * command.speed * unit_vector(command.heading);
      if (i < warm_up) continue;
      times.ours.push_back(micros(decided - began));
      times.naive.push_back(micros(scanned - decided) + 0 * sum);
    }
  }
  return times;
}

std::vector<report::BenchRow> radar(bool quick, const Stop& stop) {
  std::vector<report::BenchRow> rows;
  add_rows(rows, "360 directions, 12 discs", 12, true, false, {5, 5}, quick, stop);
  add_rows(rows, "360 directions, 1000 discs", 1000, true, false, {100, 100}, quick, stop);
  add_rows(rows, "360 directions, 12 boxes", 12, false, false, {}, quick, stop);
  add_rows(rows, "360 directions, 1000 boxes", 1000, false, false, {}, quick, stop);
  add_rows(rows, "12 discs, guarded", 12, true, true, {5, 50}, quick, stop);
  add_rows(rows, "1000 discs, guarded", 1000, true, true, {100, 100}, quick, stop);
  for (const auto& [name, obstacles, discs, aims] :
       {std::tuple{"guarded drive among 12 moving discs", 12, true, Aims{5, 50}},
        {"guarded drive among 1000 moving discs", 1000, true, Aims{100, 100}},
        {"guarded drive among 12 moving boxes", 12, false, Aims{}},
        {"guarded drive among 1000 moving boxes", 1000, false, Aims{}}})
    std::ranges::move(bench_rows(name, drive(obstacles, discs, quick ? 10 : 50, stop), aims),
                      std::back_inserter(rows));
  return rows;
}

}  // namespace microswarm::bench
