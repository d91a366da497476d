// SPDX-License-Identifier: Apache-2.0
#include "microswarm/experiment/session/standalone_navigator.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/fields/overloaded.hpp"
#include "microswarm/navigation/make.hpp"
#include "microswarm/swarm/robots/robot_swarm.hpp"

namespace microswarm::experiment {
namespace {

constexpr double max_time = 1e9;    // [s]
constexpr double max_place = 1e7;   // [µm]
constexpr double max_radius = 1e6;  // [µm]
constexpr std::size_t max_bodies = 5'000;
constexpr std::size_t max_corners = 100'000;  // of all outlines

/// Maximum distance [µm] of a body from its expected position: as in a picture of the map.
double reach_in(const Map& map) {
  constexpr double share = 0.05;
  return share * std::max(map.bounds().width(), map.bounds().height());
}

void require(bool holds, const char* name, double value, const char* limit) {
  if (!holds) throw InputError(fmt::format("{} is {}, {}", name, value, limit));
}

void require_place(const char* name, Vec2 p) {
  for (const double v : {p.x, p.y})
    require(std::abs(v) <= max_place, name, v, "must be a number of at most 1e7 µm");
}

}  // namespace

StandaloneNavigator::StandaloneNavigator(Experiment experiment, std::uint32_t trial)
    : experiment_(std::move(experiment)),
      navigator_(navigation::make_navigator(scenario().navigator, navigation_task(scenario()),
                                            Rng(scenario().seed, Purpose::planner, trial))),
      numbers_(reach_in(map())),
      memory_(scenario().sensing.obstacle_memory) {
  if (scenario().robots)
    robots_ = scenario().robots->count > 0 ? static_cast<std::size_t>(scenario().robots->count)
                                           : scenario().robots->starts.size();
}

void StandaloneNavigator::check(const ExternalObservation& given) const {
  require(std::abs(given.now) <= max_time, "now_s", given.now, "must be a number of at most 1e9 s");
  require(!last_ || given.now >= *last_, "now_s", given.now,
          "must not be before that of the step before");
  require(given.seen <= given.now && given.seen >= -max_time, "seen_s", given.seen,
          "must be a number and not after now_s");
  if (scenario().robots) {
    if (given.swarm) throw InputError("the scenario has robots: give their places, no swarm");
    if (!given.robots.empty() && given.robots.size() != robots_)
      throw InputError(
          fmt::format("there are {} robots, the scenario has {}", given.robots.size(), robots_));
    if (given.unseen < 0 || static_cast<std::size_t>(given.unseen) > robots_)
      throw InputError(fmt::format("{} of {} robots are unseen", given.unseen, robots_));
  } else if (!given.robots.empty() || given.unseen != 0) {
    throw InputError("the scenario has no robots");
  }
  for (const Vec2& robot : given.robots) require_place("robot", robot);
  if (given.swarm) {
    require_place("place of the swarm", given.swarm->pose.position);
    require(std::isfinite(given.swarm->pose.heading), "heading of the swarm",
            given.swarm->pose.heading, "must be finite");
    require(given.swarm->radius >= 0 && given.swarm->radius <= max_radius, "radius of the swarm",
            given.swarm->radius, "must be 0 to 1e6 µm");
  }
  if (given.obstacles.size() > max_bodies)
    throw InputError(
        fmt::format("{} obstacles, at most {} are taken", given.obstacles.size(), max_bodies));
  std::size_t corners = 0;
  const auto check_disc = [](const Disc& disc) {
    require_place("place of an obstacle", disc.centre);
    require(disc.radius > 0 && disc.radius <= max_radius, "radius of an obstacle", disc.radius,
            "must be above 0 and at most 1e6 µm");
  };
  const auto check_polygon = [&](const Polygon& polygon) {
    const std::vector<Vec2>& outline = polygon.outer;
    if (outline.size() < 3) throw InputError("the outline of an obstacle has fewer than 3 points");
    for (const Vec2& p : outline) require_place("outline of an obstacle", p);
    corners += outline.size();
  };
  for (const Body& body : given.obstacles)
    std::visit(Overloaded{check_disc, check_polygon}, body.shape);
  if (corners > max_corners)
    throw InputError(fmt::format("outlines of obstacles have {} points, at most {} are taken",
                                 corners, max_corners));
}

Command StandaloneNavigator::step(const ExternalObservation& given, const Stop& stop) {
  check(given);
  if (!is_prepared_) {  // first, since it may throw
    navigator_->prepare(Snapshot(experiment_.world.map, given.seen, given.obstacles), stop);
    if (stop()) return {};
    is_prepared_ = true;
  }
  last_ = given.now;
  std::vector<Body> bodies = given.obstacles;
  if (!given.are_numbered) numbers_.number(bodies, given.seen, stop);
  std::optional<SwarmPose> swarm = given.swarm;
  if (!given.robots.empty()) swarm = enclosing_pose(given.robots, command_.heading);
  const Observation seen =
      memory_.complete({.now = given.now,
                        .seen = given.seen,
                        .swarm = swarm,
                        .robots = given.robots,
                        .unseen = given.unseen,
                        .world = std::make_shared<const Snapshot>(experiment_.world.map, given.seen,
                                                                  std::move(bodies))});
  return command_ = navigator_->step(seen, stop);
}

}  // namespace microswarm::experiment
