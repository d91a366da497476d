// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "microswarm/navigation/hierarchical/hierarchical_params.hpp"
#include "microswarm/navigation/steering/aim.hpp"
#include "microswarm/planning/exact/distance_field.hpp"
#include "microswarm/planning/exact/route.hpp"

namespace microswarm::navigation {

/// Shows a HierarchicalNavigator the way to its aim: straight, or along the shortest path among
/// walls.
class AimGuide {
 public:
  /// Shortest paths to the aim among walls.
  struct WallRoute {
    double clearance = 0;  ///< [µm]
    planning::Route route;
  };

  /// Prepares the paths in `map`, if `params` has them as the guide.
  void prepare(const std::shared_ptr<const Map>& map, const Aim& aim,
               const HierarchicalParams& params);
  /// Sets the stop that ends a search.
  void stop_with(const Stop& stop);

  /// Whether it shows the way along paths.
  bool has_routes() const { return !routes_.empty(); }
  /// By falling clearance: with room for what the follower cuts off at corners, if possible.
  std::span<WallRoute> routes() { return routes_; }
  /// Point to head for from `from`: the aim, or a point of the path up to reach() ahead.
  Vec2 towards(Vec2 from);
  /// Look-ahead along the path [µm].
  double reach() const { return reach_; }
  /// Length of the path from `p` [µm]; without one, the straight distance and `detour`.
  double length_from(Vec2 p, double detour = 0);

 private:
  Vec2 aim_;
  double reach_ = 0;
  planning::DistanceField field_;
  std::vector<WallRoute> routes_;
  /// The latest answer of towards().
  struct Latest {
    Vec2 from;
    Vec2 towards;
  };
  std::optional<Latest> latest_;
};

}  // namespace microswarm::navigation
