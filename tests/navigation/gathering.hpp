// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/navigation/aggregation.hpp"
#include "tests/scenes/vascular.hpp"

namespace microswarm {

/// A map with its tree, and robots anywhere in it.
struct Gathering {
  scenes::Vascular scene;
  AggregationParams params;
  AggregationMap ground;
  RobotStepper stepper;

  explicit Gathering(const scenes::Vascular& s)
      : scene(s), params(with_nodes(s.nodes)), ground(grown(s, params)), stepper(ground.map, 1) {}

  static AggregationParams with_nodes(int nodes) {
    AggregationParams p;
    p.tree.nodes = nodes;
    return p;
  }
  static AggregationMap grown(const scenes::Vascular& s, const AggregationParams& p) {
    Rng rng(1, Purpose::planner);
    return {s.map(), s.goal, p, rng};
  }
  Robots robots(int count, std::uint32_t trial) const {
    Rng rng(2, Purpose::scene, trial);
    std::vector<Vec2> places;
    const Box& b = scene.bounds;
    while (std::ssize(places) < count) {
      const double x = rng.uniform(b.lo.x, b.hi.x);
      const Vec2 p{x, rng.uniform(b.lo.y, b.hi.y)};
      if (ground.map.is_free(p, 4 * stepper.guard())) places.push_back(p);
    }
    return stepper.place(places);
  }
};

inline const Gathering& t_junction() {
  static const Gathering gathering(scenes::t_junction());
  return gathering;
}

}  // namespace microswarm
