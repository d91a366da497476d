// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/geometry/uniform_in.hpp"
#include "microswarm/navigation/gathering/gather.hpp"
#include "microswarm/scenes/vascular.hpp"

namespace microswarm::navigation {

/// A map with a tree of its own seed, and robots anywhere in it.
struct Gathering {
  scenes::Vascular scene;
  AggregationParams params;
  AggregationMap ground;
  RobotStepper stepper;

  explicit Gathering(const scenes::Vascular& s) : Gathering(s, with_nodes(s.nodes), 1) {}
  Gathering(const scenes::Vascular& s, const AggregationParams& p, std::uint64_t tree)
      : scene(s), params(p), ground(grown(s, p, tree)), stepper(ground.map, 1) {}

  static AggregationParams with_nodes(int nodes) {
    AggregationParams p;
    p.tree.nodes = nodes;
    return p;
  }
  static AggregationMap grown(const scenes::Vascular& s, const AggregationParams& p,
                              std::uint64_t tree) {
    Rng rng(tree, Purpose::planner);
    return {s.map(), s.goal, p, rng};
  }
  Robots robots(int count, std::uint32_t trial) const {
    Rng rng(2, Purpose::scene, trial);
    std::vector<Vec2> positions;
    const Box& b = scene.bounds;
    while (std::ssize(positions) < count) {
      const Vec2 p = uniform_in(b, rng);
      if (ground.map.is_free(p, 4 * stepper.guard())) positions.push_back(p);
    }
    return stepper.place(positions);
  }
};

inline const Gathering& t_junction() {
  static const Gathering gathering(scenes::t_junction());
  return gathering;
}

}  // namespace microswarm::navigation
