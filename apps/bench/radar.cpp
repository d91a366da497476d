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
#include "microswarm/navigation/radar/radar.hpp"
#include "microswarm/scenes/worlds.hpp"

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
  const RadarCircles circles = circles_of({}, swarm_radius);
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
    for (const Place& place : all) {
      const auto began = Clock::now();
      decide(place);
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

/// Obstacles that move steadily and turn back at the borders of their square.
class Drift {
 public:
  Drift(int obstacles, bool discs, Rng& rng)
      : side_(room_an_obstacle * std::sqrt(obstacles)),
        map_(std::make_shared<const Map>(Box{{0, 0}, {side_, side_}}, std::vector<Polygon>{})) {
    for (int i = 0; i < obstacles; ++i) {
      const double x = rng.uniform(0, side_);
      const Vec2 at{x, rng.uniform(0, side_)};
      const double speed = rng.uniform(10, 60);
      movers_.push_back({.at = at,
                         .velocity = speed * unit_vector(rng.uniform(-pi, pi)),
                         .turn_rate = discs ? 0 : rng.uniform(-0.3, 0.3)});
      movers_.back().body = obstacle(at, discs, static_cast<std::uint32_t>(i), rng);
    }
  }

  double side() const { return side_; }
  Snapshot at(double t) const {
    std::vector<Body> bodies;
    bodies.reserve(movers_.size());
    for (const Mover& one : movers_) {
      Body body = one.body;
      if (auto* polygon = std::get_if<Polygon>(&body.shape))
        for (Vec2& p : polygon->outer) p = one.at + rotated(p - one.at, t * one.turn_rate);
      const Vec2 there = one.at + t * one.velocity;
      shift(body, Vec2{folded(there.x), folded(there.y)} - one.at);
      bodies.push_back(std::move(body));
    }
    return Snapshot(map_, t, std::move(bodies));
  }

 private:
  struct Mover {
    Vec2 at, velocity;
    double turn_rate = 0;  ///< [rad/s]
    Body body;             ///< at time 0
  };

  double folded(double v) const {
    const double turn = std::fmod(std::abs(v), 2 * side_);
    return turn > side_ ? 2 * side_ - turn : turn;
  }

  double side_;
  std::shared_ptr<const Map> map_;
  std::vector<Mover> movers_;
};

SwarmLimits swarm_limits() {
  return {.radius = swarm_radius,
          .max_speed = 85.8,
          .max_turn_rate = std::numeric_limits<double>::infinity()};
}

std::vector<BenchRow> rows_of(const std::string& name, const std::vector<double>& ours,
                              const std::vector<double>& naive, Aims aims) {
  std::vector<BenchRow> rows;
  for (const double q : {0.5, 0.99})
    rows.push_back({.name = name,
                    .quantity = q < 0.6 ? "time of a decision, p50" : "time of a decision, p99",
                    .unit = "µs",
                    .ours = quantile(ours, q),
                    .peer = quantile(naive, q),
                    .peer_name = "every direction against every obstacle",
                    .aim = q < 0.6 ? aims.p50 : aims.p99});
  return rows;
}

/// Rows of a guarded decision on drives among obstacles that move steadily.
std::vector<BenchRow> drive_rows(const std::string& name, int obstacles, bool discs, Aims aims,
                                 bool quick, const Stop& stop) {
  constexpr double tick = 0.1;
  constexpr int ticks = 200;
  constexpr int warm_up = 5;
  Rng rng(2, Purpose::scene);
  std::vector<double> ours, naive;
  double sum = 0;  // prevents the results from being optimised away
  for (int drive = 0; drive < (quick ? 10 : 50) && !stop(); ++drive) {
    const Drift drift(obstacles, discs, rng);
    const double side = drift.side();
    RadarNavigator navigator({}, swarm_limits(), {0.9 * side, 0.9 * side}, 1,
                             Rng(1, Purpose::planner));
    Vec2 swarm{0.1 * side, 0.1 * side};
    for (int i = 0; i < ticks; ++i) {
      const double now = i * tick;
      const Snapshot world = drift.at(now);
      const auto began = Clock::now();
      const Command command = navigator.step({.now = now,
                                              .seen = now,
                                              .swarm = SwarmPose{{swarm, 0}, swarm_radius},
                                              .robots = {},
                                              .world = borrowed(world)},
                                             {});
      const auto decided = Clock::now();
      if (navigator.last_look()) sum += scan(*navigator.last_look(), world, 360).weights.target;
      const auto scanned = Clock::now();
      if (i < warm_up) continue;
      ours.push_back(std::chrono::duration<double, std::micro>(decided - began).count());
      naive.push_back(std::chrono::duration<double, std::micro>(scanned - decided).count());
      swarm += tick * command.speed * unit_vector(command.heading);
    }
  }
  ours.front() += 0 * sum;
  return rows_of(name, ours, naive, aims);
}

/// Rows of a radar decision, as published or with the safety filter.
void add_rows(std::vector<BenchRow>& rows, const std::string& name, int obstacles, bool discs,
              bool guarded, Aims aims, bool quick, const Stop& stop) {
  Rng rng(1, Purpose::scene);
  const std::vector<Place> all = places(obstacles, discs, quick ? 100 : 400, rng);
  RadarParams params;
  params.safety_filter.active = guarded;
  RadarNavigator navigator(params, swarm_limits(), {0, 0}, 1, Rng(1, Purpose::planner));
  double now = 0;
  double sum = 0;  // prevents the results from being optimised away
  const std::vector<double> ours = times(all, quick ? 20 : 100, stop, [&](const Place& place) {
    now += 0.1;
    sum += navigator
               .step({.now = now,
                      .seen = now,
                      .swarm = SwarmPose{{place.swarm, 0}, swarm_radius},
                      .robots = {},
                      .world = borrowed(*place.world)},
                     {})
               .heading;
  });
  const std::vector<double> naive = times(all, quick ? 1 : 3, stop, [&](const Place& place) {
    navigator.step({.now = now,
                    .seen = now,
                    .swarm = SwarmPose{{place.swarm, 0}, swarm_radius},
                    .robots = {},
                    .world = borrowed(*place.world)},
                   {});
    if (navigator.last_look())
      sum += scan(*navigator.last_look(), *place.world, 360).weights.target;
  });
  std::ranges::move(rows_of(name, ours, naive, aims), std::back_inserter(rows));
  rows.back().ours += 0 * sum;
}

}  // namespace

std::vector<BenchRow> radar(bool quick, const Stop& stop) {
  std::vector<BenchRow> rows;
  add_rows(rows, "360 directions, 12 discs", 12, true, false, {5, 5}, quick, stop);
  add_rows(rows, "360 directions, 1000 discs", 1000, true, false, {100, 100}, quick, stop);
  add_rows(rows, "360 directions, 12 boxes", 12, false, false, {}, quick, stop);
  add_rows(rows, "360 directions, 1000 boxes", 1000, false, false, {}, quick, stop);
  add_rows(rows, "12 discs, guarded", 12, true, true, {5, 50}, quick, stop);
  add_rows(rows, "1000 discs, guarded", 1000, true, true, {100, 100}, quick, stop);
  for (const auto& [name, obstacles, discs, aims] :
       {std::tuple{"guarded drive among 12 moving discs", 12, true, Aims{5, 50}},
        {"guarded drive among 1000 moving discs", 1000, true, Aims{100, 100}},
        {"guarded drive among 12 turning boxes", 12, false, Aims{}},
        {"guarded drive among 1000 turning boxes", 1000, false, Aims{}}})
    std::ranges::move(drive_rows(name, obstacles, discs, aims, quick, stop),
                      std::back_inserter(rows));
  return rows;
}

}  // namespace microswarm::bench
