// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <memory>

#include "microswarm/navigation/steering/guide_kind.hpp"
#include "microswarm/planning/exact/route.hpp"

namespace microswarm::navigation {

/// Shows a navigator that looks no further than its surroundings where to head for: at the goal, or
/// where walls hide it along the route to it.
class GoalGuide {
 public:
  /// `reach` is the distance looked ahead along routes [µm].
  GoalGuide(Guide kind, Vec2 goal, double reach) : kind_(kind), goal_(goal), reach_(reach) {}

  /// Makes the routes to `goal`: one that keeps `clearance` [µm], and one that keeps `least` for
  /// positions from which the first has no path.
  void prepare(const std::shared_ptr<const Map>& map, Vec2 goal, double clearance, double least);
  /// Sets the stop that ends a search for the route.
  void stop_with(const Stop& stop) {
    for (Candidate& candidate : candidates_) candidate.route.stop_with(stop);
  }
  /// Target from `from`: the goal, or a visible point of the route.
  Vec2 target(const Map& map, Vec2 from);

 private:
  struct Candidate {
    planning::Route route;
    double clearance = 0;
  };
  Guide kind_;
  Vec2 goal_;
  double reach_;
  std::array<Candidate, 2> candidates_;
};

}  // namespace microswarm::navigation
