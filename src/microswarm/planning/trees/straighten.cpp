// SPDX-License-Identifier: Apache-2.0
#include "microswarm/planning/trees/straighten.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "microswarm/core/maths/angles.hpp"
#include "microswarm/core/maths/infinity.hpp"

namespace microswarm::planning {
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

  double cost(std::span<const Vec2> path) const { return cost_.of(path, start_heading_); }
  bool is_free(Vec2 a, Vec2 b) const { return world_.is_free(Segment{a, b}, clearance_); }

  /// Replaces the path by the cheapest chain of free edges through `points`: the path's vertices,
  /// and between any two as many others that every `per_edge`-th is a vertex.
  void take_cheapest_chain(std::vector<Vec2>& path, std::span<const Vec2> points,
                           std::size_t per_edge);

 private:
  /// Edge from point `from` to another as the last of the cheapest chain ending with it. The turn
  /// into an edge depends on the edge before it, so edges, not points, are the states.
  struct Edge {
    std::size_t from = 0;
    double heading = 0;
    double cost = infinity;
    std::size_t before = 0;  ///< start point of the previous edge
  };
  /// A point, with what is left to the end in a straight line.
  struct Point {
    Vec2 position;
    double length_left = 0;  ///< times its cost
    double heading_left = 0;
    std::size_t first_edge = 0;  ///< of those that end at it
    double min_cost = infinity;  ///< of them
  };
  static std::size_t first(std::size_t j) { return j > window ? j - window : 0; }
  std::span<const Edge> edges_to(std::size_t i) const {
    const std::size_t begin = points_[i].first_edge;
    const std::size_t end = i + 1 < points_.size() ? points_[i + 1].first_edge : edges_.size();
    return std::span(edges_).subspan(begin, end - begin);
  }
  const Edge& edge(std::size_t i, std::size_t j) const {
    return *std::ranges::find(edges_to(j), i, &Edge::from);
  }

  std::vector<Vec2> cheapest_chain(std::span<const Vec2> points, double known,
                                   std::size_t per_edge);
  void lay_out(std::span<const Vec2> points);
  Edge reach(std::size_t i, std::size_t j, double known) const;

  const Snapshot& world_;
  double clearance_;
  double start_heading_;
  PathCost cost_;
  std::uint64_t& checks_;
  std::vector<Point> points_;
  std::vector<Edge> edges_;  ///< that are free and promising, by the point at which they end
};

void Straightener::lay_out(std::span<const Vec2> points) {
  points_.clear();
  edges_.clear();
  for (const Vec2 p : points) {
    const Vec2 rest = points.back() - p;
    points_.push_back({.position = p});
    if (rest == Vec2{}) continue;
    points_.back().length_left = cost_.per_length * norm(rest);
    points_.back().heading_left = heading_along(rest);
  }
}

/// The edge, with infinite cost if no chain over it can cost as little as `known`.
Straightener::Edge Straightener::reach(std::size_t i, std::size_t j, double known) const {
  const Point &a = points_[i], &b = points_[j];
  const double length = cost_.per_length * distance(a.position, b.position);
  const double least = i == 0 ? length : a.min_cost + length;
  if (!(least + b.length_left <= known)) return {};
  Edge to{.from = i, .heading = heading_along(b.position - a.position)};
  if (i == 0) to.cost = length + cost_.per_turn * turn_between(start_heading_, to.heading);
  for (const Edge& from : edges_to(i)) {
    if (from.cost + length >= to.cost) continue;
    const double total =
        from.cost + length + cost_.per_turn * turn_between(from.heading, to.heading);
    if (total < to.cost) {
      to.cost = total;
      to.before = from.from;
    }
  }
  // To the end it is at least the straight line, and the turn from the edge's heading to it.
  const double left =
      b.position == points_.back().position
          ? 0
          : b.length_left + cost_.per_turn * turn_between(to.heading, b.heading_left);
  if (!(to.cost + left <= known)) to.cost = infinity;
  return to;
}

/// Parts of an edge of the path count as free, without a search, if `per_edge` is given; else
/// everything is checked. Empty if there is no chain that costs at most `known`.
std::vector<Vec2> Straightener::cheapest_chain(std::span<const Vec2> points, double known,
                                               std::size_t per_edge) {
  lay_out(points);
  const std::size_t last = points_.size() - 1;
  const auto is_part = [&](std::size_t i, std::size_t j) {
    return per_edge > 0 && i / per_edge == (j - 1) / per_edge;
  };
  for (std::size_t j = 1; j <= last; ++j) {
    points_[j].first_edge = edges_.size();
    for (std::size_t i = first(j); i < j; ++i) {
      if (points_[i].position == points_[j].position) continue;
      const Edge e = reach(i, j, known);
      if (e.cost == infinity) continue;
      ++checks_;
      if (!is_part(i, j) && !is_free(points_[i].position, points_[j].position)) continue;
      edges_.push_back(e);
      points_[j].min_cost = std::min(points_[j].min_cost, e.cost);
    }
  }
  const auto best = std::ranges::min_element(edges_to(last), {}, &Edge::cost);
  if (best == edges_to(last).end()) return {};
  std::vector<Vec2> chain{points_[last].position};
  std::size_t i = best->from;
  for (std::size_t j = last; j != 0;) {
    chain.push_back(points_[i].position);
    const std::size_t h = i == 0 ? 0 : edge(i, j).before;
    j = i;
    i = h;
  }
  std::reverse(chain.begin(), chain.end());
  return chain;
}

void Straightener::take_cheapest_chain(std::vector<Vec2>& path, std::span<const Vec2> points,
                                       std::size_t per_edge) {
  const double known = cost(path) * (1 + rounding);
  const std::uint64_t checks = checks_;
  std::vector<Vec2> chain = cheapest_chain(points, known, per_edge);
  // A part of an edge that touches the clearance may fail by rounding.
  for (std::size_t k = 1; k < chain.size(); ++k) {
    if (is_free(chain[k - 1], chain[k])) continue;
    checks_ = checks;
    chain = cheapest_chain(points, known, 0);
    break;
  }
  if (!chain.empty()) path = std::move(chain);
}

constexpr std::array shares{0.15, 0.4, 0.6, 0.85};  // of an edge
constexpr std::size_t divisions = shares.size() + 1;

/// The path's vertices with points between them, denser towards the vertices, where corners are
/// cut.
std::vector<Vec2> divided(std::span<const Vec2> path) {
  std::vector<Vec2> points{path.front()};
  for (std::size_t k = 1; k < path.size(); ++k) {
    const Vec2 edge = path[k] - path[k - 1];
    for (const double share : shares) points.push_back(path[k - 1] + share * edge);
    points.push_back(path[k]);
  }
  return points;
}

}  // namespace

void straighten(const Snapshot& world, double clearance, double start_heading, PathCost cost,
                int rounds, std::vector<Vec2>& path, std::uint64_t& checks) {
  Straightener straightener(world, clearance, start_heading, cost, checks);
  for (int round = 0; round <= rounds && path.size() > 1; ++round) {
    const bool first = round == 0;
    straightener.take_cheapest_chain(path, first ? std::vector(path) : divided(path),
                                     first ? 1 : divisions);
  }
}

}  // namespace microswarm::planning
