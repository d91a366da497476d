// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "microswarm/core/execution/status.hpp"
#include "microswarm/core/execution/stop.hpp"
#include "microswarm/planning/exact/tangent_query.hpp"

namespace microswarm::planning {

/// A shortest path, or the reason for its absence and a path that ends near the goal.
struct ShortestPath {
  Status status = Status::no_path;
  double length = 0;  ///< of straight lines and true arcs [µm]; 0 unless solved
  std::vector<Vec2>
      points{};  ///< [µm]; arcs are replaced by tangent lines, which keep the clearance
  std::uint64_t expanded = 0;  ///< labels expanded
  std::uint64_t lines = 0;     ///< free lines that became labels
};

/// Exact shortest paths of a disc in a map, for one clearance, also among moving bodies at their
/// current positions. Tangents are kept for later queries, which changes no result. Not
/// thread-safe.
class ShortestPaths {
 public:
  /// `map` must outlive this object. `clearance` [µm].
  ShortestPaths(const Map& map, double clearance) : graph_(map, clearance) {}

  /// Shortest path between two free positions [µm]. It keeps the clearance to a relative 1e-7 and
  /// is found if there is one with that much more clearance.
  ShortestPath find(Vec2 start, Vec2 goal, const BodySet& moving, const Stop& stop = {});
  ShortestPath find(Vec2 start, Vec2 goal, const Stop& stop = {}) {
    return find(start, goal, {}, stop);
  }
  /// Continues with an equal copy of the map.
  void use(const Map& map) { graph_.use(map); }
  /// Approximate size of the kept tangents and of the last query's memory [B].
  std::size_t bytes() const { return graph_.bytes() + memory_.bytes(); }

 private:
  TangentGraph graph_;
  TangentQuery::Memory memory_;  ///< of the last query
};

}  // namespace microswarm::planning
