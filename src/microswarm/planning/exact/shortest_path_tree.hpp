// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "microswarm/core/execution/stop.hpp"
#include "microswarm/planning/exact/tangent_query.hpp"

namespace microswarm::planning {

/// Shortest paths of a disc from any position to one goal, for one clearance: a tree over the
/// tangents of the map's corners, rooted at the goal. A query looks around its position and takes
/// the best line to a circle of the tree, which A* grows as far as the query needs. Not
/// thread-safe.
class ShortestPathTree {
 public:
  /// Order in which the tree grows.
  enum class Growth {
    towards_queries,  ///< for queries near each other
    evenly,           ///< around the root, for queries all over the map
  };

  /// `map` must outlive the tree. `clearance` [µm].
  ShortestPathTree(const Map& map, Vec2 goal, double clearance,
                   Growth growth = Growth::towards_queries);

  /// Sets the stop that ends growth. A query that was stopped may return a longer path or none;
  /// the next query continues to grow the tree.
  void stop_with(const Stop& stop) { stop_ = stop; }
  /// Whether the last query was stopped.
  bool was_stopped() const { return was_stopped_; }

  /// Size [B] above which a query that needs growth starts a new tree; 256 MB by default.
  void limit_bytes(std::size_t most) { max_bytes_ = most; }

  /// Length of the shortest path from `p` to the goal [µm]; infinity without one, and if `p` or
  /// the goal lacks the clearance.
  double length_from(Vec2 p);
  /// That path [µm], arcs replaced by tangent lines; empty without one.
  std::vector<Vec2> path_from(Vec2 p);

 private:
  /// First line of a path to the goal.
  struct Best {
    double length = infinity;
    std::uint32_t label = TangentQuery::none;  ///< of the circle it leads to; none: the goal
    TangentQuery::Leaving line;                ///< from that circle to the query
  };
  /// A line from a label's circle to the position of the query.
  struct Line {
    double length = 0;  ///< of the path over the line, or a lower bound [µm]
    std::uint32_t label = TangentQuery::none;
    bool is_known = false;
    TangentQuery::Leaving line;
  };
  Best best_from(Vec2 p);
  Best best_over_seen(Vec2 p);
  void look_on(double length);
  void begin();
  bool is_free(const TangentQuery::Leaving& leaving, Vec2 p) const;

  const Map* map_;
  Vec2 goal_;
  double clearance_;
  Growth growth_;
  std::size_t max_bytes_ = 256u << 20;
  bool has_root_;
  Stop stop_;
  bool was_stopped_ = false;
  std::unique_ptr<TangentGraph> graph_;  ///< from the first query whose path bends
  std::optional<TangentQuery> search_;   ///< from the root to everywhere
  Vec2 headed_for_;                      ///< position towards which the tree grows

  std::vector<std::uint32_t> seen_in_;  ///< by wheel: the query that saw it last
  std::uint32_t query_ = 0;

  // State of the current query.
  TrapezoidLook look_;
  std::vector<std::uint32_t> seen_;  ///< wheels
  std::vector<Line> lines_;          ///< from seen wheels, a heap
};

}  // namespace microswarm::planning
