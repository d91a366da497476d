// SPDX-License-Identifier: Apache-2.0
#include "microswarm/experiment/plant/obstacle_detection.hpp"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

namespace microswarm::experiment {
namespace {

/// Whether the gap between two bodies is smaller than the larger of them.
bool are_near(const Body& a, const Body& b) {
  const Disc one = enclosing_disc(a), other = enclosing_disc(b);
  return distance(one.centre, other.centre) <
         one.radius + other.radius + 2 * std::max(one.radius, other.radius);
}

}  // namespace

Snapshot ObstacleDetection::frame(const World& world, double taken, double told, double dt) {
  Snapshot exact = world.at(taken);
  if (params_.obstacle_noise == 0 && params_.obstacle_missed_share == 0 &&
      params_.swapped_share == 0 && taken == told)
    return exact;
  std::vector<Body> found;
  std::optional<std::uint32_t> obstacle;
  bool missed = false;
  Vec2 error;
  for (const Body& body : exact.moving().bodies()) {
    if (obstacle != body.obstacle) {
      obstacle = body.obstacle;
      missed = dropouts_.miss(body.obstacle, dt, rng_);
      const double dx = rng_.normal(), dy = rng_.normal();
      error = params_.obstacle_noise * Vec2{dx, dy};
    }
    if (missed) continue;
    found.push_back(body);
    shift(found.back(), error);
  }
  if (params_.swapped_share > 0) swap_identities(world, found);
  return Snapshot(exact.shared_map(), told, std::move(found));
}

/// In a share of the frames two obstacles that are near each other exchange identities.
void ObstacleDetection::swap_identities(const World& world, std::vector<Body>& bodies) {
  if (rng_.uniform() >= params_.swapped_share) return;
  // Walls that move are not taken for an obstacle.
  const auto is_wall = [&](const Body& body) {
    return std::holds_alternative<DeformingChannel>(world.obstacles[body.obstacle].shape);
  };
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
  for (const Body& a : bodies)
    for (const Body& b : bodies)
      if (a.obstacle < b.obstacle && !is_wall(a) && !is_wall(b) && are_near(a, b))
        pairs.emplace_back(a.obstacle, b.obstacle);
  if (pairs.empty()) return;
  const auto [one, other] = pairs[rng_.below(pairs.size())];
  for (Body& body : bodies) {
    if (body.obstacle == one)
      body.obstacle = other;
    else if (body.obstacle == other)
      body.obstacle = one;
  }
  std::ranges::stable_sort(bodies, {}, &Body::obstacle);
}

}  // namespace microswarm::experiment
