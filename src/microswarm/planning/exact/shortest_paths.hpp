// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "microswarm/core/execution/status.hpp"
#include "microswarm/core/execution/stop.hpp"
#include "microswarm/planning/exact/tangent_search.hpp"

namespace microswarm {

/// A shortest path, or why there is none and a path that ends near the goal.
struct ShortestPath {
  Status status = Status::no_path;
  double length = 0;           ///< of straight lines and true arcs, once solved [µm]
  std::vector<Vec2> points;    ///< [µm]; arcs are replaced by lines around them, with clearance
  std::uint64_t expanded = 0;  ///< circles gone around, as often as they were
  std::uint64_t lines = 0;     ///< free ones that were taken
};

/// Exact shortest paths of a disc in a map, for one clearance, also among moving bodies at their
/// present places. Tangents are kept for further queries; what was kept changes no path. Not for
/// several threads at once.
class ShortestPaths {
 public:
  /// `map` must outlive it. `clearance` [µm].
  ShortestPaths(const Map& map, double clearance) : search_(map, clearance) {}

  /// The shortest path between two places that are free. It keeps the clearance to within a share
  /// of 1e-7 and exists if there is one with that much more clearance.
  ShortestPath find(Vec2 start, Vec2 goal, const BodySet& moving, const Stop& stop = {});
  ShortestPath find(Vec2 start, Vec2 goal, const Stop& stop = {}) {
    return find(start, goal, {}, stop);
  }
  /// Continues with a copy of the map.
  void use(const Map& map) { search_.use(map); }
  /// About what is kept at most [B].
  std::size_t bytes() const { return search_.bytes(); }

 private:
  std::vector<Vec2> near(Vec2 goal) const;
  Vec2 walk(Vec2 from, Vec2 goal) const;

  TangentSearch search_;
};

}  // namespace microswarm
