// SPDX-License-Identifier: Apache-2.0
#include "microswarm/rig/perception/body_numbers.hpp"

#include <algorithm>
#include <optional>

#include "microswarm/navigation/prediction/obstacle_tracker.hpp"

namespace microswarm {
namespace {

constexpr double memory = 1;       // [s] for which a hidden body is remembered
constexpr double smoothing = 0.3;  // weight of the newest velocity

}  // namespace

void BodyNumbers::number(std::vector<Body>& bodies, double t) {
  std::erase_if(known_, [&](const Known& k) { return t - k.t > memory; });
  std::vector<AssignmentEdge> edges;
  for (std::size_t b = 0; b < bodies.size(); ++b)
    for (std::size_t k = 0; k < known_.size(); ++k) {
      const Known& known = known_[k];
      const Vec2 expected = known.centre + (t - known.t) * known.velocity;
      const double off = squared_norm(extent_of(bodies[b]).centre - expected);
      if (off <= reach_ * reach_) edges.push_back({static_cast<int>(b), static_cast<int>(k), off});
    }
  const auto known_of = assignment_.solve(static_cast<int>(bodies.size()),
                                          static_cast<int>(known_.size()), edges, reach_ * reach_);
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const Vec2 centre = extent_of(bodies[b]).centre;
    const auto* disc = std::get_if<Disc>(&bodies[b].shape);
    const double radius = disc ? disc->radius : 0;
    if (!known_of[b]) {
      bodies[b].obstacle = next_++;
      known_.push_back({.number = bodies[b].obstacle,
                        .radius = radius,
                        .centre = centre,
                        .velocity = {},
                        .t = t});
      continue;
    }
    Known& known = known_[static_cast<std::size_t>(*known_of[b])];
    bodies[b].obstacle = known.number;
    if (t > known.t) {
      const Vec2 moved = (centre - known.centre) / (t - known.t);
      known.velocity += (known.pictures > 1 ? smoothing : 1) * (moved - known.velocity);
      ++known.pictures;
    }
    known.radius = radius;
    known.centre = centre;
    known.t = t;
  }
}

std::vector<Disc> BodyNumbers::expected_discs(double t) const {
  std::vector<Disc> discs;
  for (const Known& known : known_)
    if (known.radius > 0 && t - known.t <= memory)
      discs.push_back({known.centre + (t - known.t) * known.velocity, known.radius});
  return discs;
}

}  // namespace microswarm
