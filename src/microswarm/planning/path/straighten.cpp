// SPDX-License-Identifier: Apache-2.0
#include "microswarm/planning/path/straighten.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "microswarm/core/maths/angles.hpp"
#include "microswarm/core/maths/infinity.hpp"

namespace microswarm {
namespace {

/// Maximum number of points skipped by an edge of a chain, so that long paths take linear time.
constexpr std::size_t window = 48;
/// Relative cost differences up to this are attributed to rounding.
constexpr double rounding = 1e-9;

class Straightener {
 public:
  Straightener(const Snapshot& world, double clearance, double start_heading, PathCost cost,
               std::uint64_t& checks)
      : world_(world),
        clearance_(clearance),
        start_heading_(start_heading),
        cost_(cost),
        checks_(checks) {}

  double cost(std::span<const Vec2> path) const {
    return cost_.per_length * path_length(path) +
           cost_.per_turn * path_turning(path, start_heading_);
  }
  bool is_free(Vec2 a, Vec2 b) {
    ++checks_;
    return world_.is_free(Segment{a, b}, clearance_);
  }

  /// Replaces the path by the cheapest chain of free edges through `points`, which include the
  /// path's vertices.
  void take_cheapest_chain(std::vector<Vec2>& path, std::vector<Vec2> points);

 private:
  /// Edge from point i to point j as the last of the cheapest chain ending with it. The turn into
  /// an edge depends on the edge before it, so edges, not points, are the states.
  struct Edge {
    double heading = 0;
    double cost = infinity;
    std::size_t before = 0;  ///< start point of the previous edge
  };
  static std::size_t first(std::size_t j) { return j > window ? j - window : 0; }
  Edge& edge(std::size_t i, std::size_t j) { return edges_[j * window + i % window]; }

  void reach(std::size_t i, std::size_t j);
  double min_cost_to_end(const Edge& e, Vec2 p) const;

  const Snapshot& world_;
  double clearance_;
  double start_heading_;
  PathCost cost_;
  std::uint64_t& checks_;
  std::vector<Vec2> points_;
  std::vector<Edge> edges_;
};

/// Lower bound of the cost from `p` to the end: the straight line, and the turn from the edge's
/// heading to it.
double Straightener::min_cost_to_end(const Edge& e, Vec2 p) const {
  const Vec2 way = points_.back() - p;
  if (way == Vec2{}) return 0;
  return cost_.per_length * norm(way) + cost_.per_turn * turn_between(e.heading, heading_of(way));
}

void Straightener::reach(std::size_t i, std::size_t j) {
  Edge& to = edge(i, j);
  const double length = cost_.per_length * distance(points_[i], points_[j]);
  to = {heading_of(points_[j] - points_[i]), infinity, 0};
  if (i == 0) {
    to.cost = length + cost_.per_turn * turn_between(start_heading_, to.heading);
    return;
  }
  for (std::size_t h = first(i); h < i; ++h) {
    const Edge& from = edge(h, i);
    if (from.cost + length >= to.cost) continue;
    const double total =
        from.cost + length + cost_.per_turn * turn_between(from.heading, to.heading);
    if (total < to.cost) {
      to.cost = total;
      to.before = h;
    }
  }
}

void Straightener::take_cheapest_chain(std::vector<Vec2>& path, std::vector<Vec2> points) {
  const double known = cost(path) * (1 + rounding);
  points_ = std::move(points);
  edges_.assign(points_.size() * window, {});
  const std::size_t last = points_.size() - 1;
  for (std::size_t j = 1; j <= last; ++j) {
    for (std::size_t i = first(j); i < j; ++i) {
      if (points_[i] == points_[j]) continue;
      reach(i, j);
      Edge& e = edge(i, j);
      const bool promising = e.cost < infinity && e.cost + min_cost_to_end(e, points_[j]) <= known;
      if (!promising || !is_free(points_[i], points_[j])) e.cost = infinity;
    }
  }
  std::size_t i = first(last);
  for (std::size_t k = i; k < last; ++k) {
    if (edge(k, last).cost < edge(i, last).cost) i = k;
  }
  if (edge(i, last).cost == infinity) return;
  std::vector<Vec2> chain{points_[last]};
  for (std::size_t j = last; j != 0;) {
    chain.push_back(points_[i]);
    const std::size_t h = edge(i, j).before;
    j = i;
    i = h;
  }
  std::reverse(chain.begin(), chain.end());
  path = std::move(chain);
}

/// The path's vertices with points between them, denser towards the vertices, where corners are
/// cut.
std::vector<Vec2> divided(std::span<const Vec2> path) {
  std::vector<Vec2> points{path.front()};
  for (std::size_t k = 1; k < path.size(); ++k) {
    const Vec2 way = path[k] - path[k - 1];
    for (const double share : {0.15, 0.4, 0.6, 0.85}) points.push_back(path[k - 1] + share * way);
    points.push_back(path[k]);
  }
  return points;
}

}  // namespace

void straighten(const Snapshot& world, double clearance, double start_heading, PathCost cost,
                int rounds, std::vector<Vec2>& path, std::uint64_t& checks) {
  Straightener straightener(world, clearance, start_heading, cost, checks);
  for (int round = 0; round <= rounds && path.size() > 1; ++round) {
    straightener.take_cheapest_chain(path, round == 0 ? path : divided(path));
  }
}

}  // namespace microswarm
