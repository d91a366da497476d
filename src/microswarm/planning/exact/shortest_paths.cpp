// SPDX-License-Identifier: Apache-2.0
#include "microswarm/planning/exact/shortest_paths.hpp"

#include <algorithm>
#include <numeric>
#include <span>
#include <utility>

namespace microswarm::planning {
namespace {

/// End of the free part of the straight line to the goal.
Vec2 walk(const TangentQuery& query, Vec2 from, Vec2 goal) {
  double free = 0, blocked = 1;
  for (int i = 0; i < 20; ++i) {
    const double middle = 0.5 * (free + blocked);
    const bool goes = query.is_free({from, from + middle * (goal - from)});
    (goes ? free : blocked) = middle;
  }
  return from + free * (goal - from);
}

/// A path to the point nearest to the goal that the search reached.
std::vector<Vec2> path_near(const TangentQuery& query, Vec2 goal) {
  constexpr std::size_t tried = 16;  // nearest labels
  const auto labels = query.labels();
  std::vector<std::uint32_t> near(labels.size());
  std::iota(near.begin(), near.end(), 0);
  const auto left = [&](std::uint32_t i) { return distance(labels[i].end(), goal); };
  const std::size_t count = std::min(tried, near.size());
  std::ranges::partial_sort(near, near.begin() + static_cast<std::ptrdiff_t>(count), {}, left);
  std::vector<Vec2> best{query.start()};
  query.add(walk(query, query.start(), goal), best);
  for (const std::uint32_t i : std::span(near).first(count)) {
    const Vec2 end = walk(query, labels[i].end(), goal);
    if (distance(end, goal) >= distance(best.back(), goal)) continue;
    best = query.path_to(i);
    query.add(end, best);
  }
  return best;
}

}  // namespace

ShortestPath ShortestPaths::find(Vec2 start, Vec2 goal, const BodySet& moving, const Stop& stop) {
  ShortestPath path;
  const double clearance = graph_.clearance();
  const Segment straight{start, goal};
  if (graph_.map().is_free(straight, clearance) && moving.is_free(straight, clearance)) {
    path.status = Status::solved;
    path.length = distance(start, goal);
    path.points = {start, goal};
    path.lines = 1;
    return path;
  }
  TangentQuery query(graph_, start, goal, moving, std::move(memory_));
  for (;;) {
    if (path.expanded % 8 == 0)
      if (const auto told = stop.status()) {
        path.status = *told;
        break;
      }
    const auto number = query.next();
    if (!number) break;
    const TangentQuery::Label& label = query.labels()[*number];
    if (label.wheel == TangentQuery::none) {
      path.status = Status::solved;
      path.length = label.length;
      path.points = query.path_to(*number);
      path.points.back() = goal;
      break;
    }
    ++path.expanded;
    query.expand(*number);
  }
  if (path.status != Status::solved) path.points = path_near(query, goal);
  path.lines = query.labels().size();
  memory_ = query.release();
  return path;
}

}  // namespace microswarm::planning
