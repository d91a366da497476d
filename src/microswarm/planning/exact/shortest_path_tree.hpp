// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "microswarm/core/execution/stop.hpp"
#include "microswarm/planning/exact/tangent_search.hpp"

namespace microswarm {

/// Shortest paths of a disc from everywhere to one goal, for one clearance: a tree over the
/// tangents of the map's corners with its root at the goal. A query looks around its place and
/// takes the best line to a circle of the tree, which is grown by A* as far as that needs. Not for
/// several threads at once.
class ShortestPathTree {
 public:
  /// Where the tree is grown first.
  enum class Growth {
    towards_queries,  ///< for places near each other
    evenly,           ///< around the root, for places all over the map
  };

  /// `map` must outlive it. `clearance` [µm].
  ShortestPathTree(const Map& map, Vec2 goal, double clearance,
                   Growth growth = Growth::towards_queries);

  /// What tells that growth is to end. The paths of a query that it ends may not be the shortest,
  /// or there may be none; the tree goes on from there with the next query.
  void stop_with(const Stop& stop) { stop_ = stop; }
  /// Whether it has ended the last query.
  bool was_stopped() const { return was_stopped_; }

  /// A tree larger than this begins anew with a query that needs it to grow [B]; 256 MB by default.
  void limit_bytes(std::size_t most) { most_bytes_ = most; }

  /// Length of the shortest path from `p` to the goal [µm]; infinity without one, and where `p` or
  /// the goal has not the clearance.
  double length_from(Vec2 p);
  /// That path, in which arcs are replaced by lines around them; empty without one.
  std::vector<Vec2> path_from(Vec2 p);

 private:
  /// How a path to the goal begins.
  struct Best {
    double length = infinity;
    std::uint32_t label = TangentSearch::none;  ///< of the circle it goes to; none: the goal
    TangentSearch::Leaving line;                ///< from there
  };
  /// A line from a label's circle to the place that is asked for.
  struct Line {
    double length = 0;  ///< of the path over it, or a lower bound [µm]
    std::uint32_t label = TangentSearch::none;
    bool is_known = false;
    TangentSearch::Leaving line;
  };
  Best best_from(Vec2 p);
  Best best_over_seen(Vec2 p);
  void look_on(double length);
  void begin();
  bool is_free(const TangentSearch::Leaving& leaving, Vec2 p) const;

  const Map* map_;
  Vec2 goal_;
  double clearance_;
  Growth growth_;
  std::size_t most_bytes_ = 256u << 20;
  bool has_root_;
  Stop stop_;
  bool was_stopped_ = false;
  std::optional<TangentSearch> search_;  ///< once a path that bends is asked for
  Vec2 headed_for_;                      ///< as the tree is grown

  std::vector<std::uint32_t> seen_in_;  ///< of each wheel: the query in which it was seen
  std::uint32_t query_ = 0;

  // Of the present query.
  Trapezoids::Look look_;
  std::vector<std::uint32_t> seen_;  ///< wheels
  std::vector<Line> lines_;          ///< from seen wheels, a heap
};

}  // namespace microswarm
