// SPDX-License-Identifier: Apache-2.0
#include "microswarm/planning/exact/shortest_paths.hpp"

#include <algorithm>
#include <numeric>
#include <span>

namespace microswarm {

ShortestPath ShortestPaths::find(Vec2 start, Vec2 goal, const BodySet& moving, const Stop& stop) {
  ShortestPath path;
  search_.begin(start, goal, moving);
  if (search_.is_free({start, goal})) {
    path.status = Status::solved;
    path.length = distance(start, goal);
    path.points = {start, goal};
    path.lines = 1;
    return path;
  }
  search_.open_from_start();
  for (;;) {
    if (path.expanded % 8 == 0)
      if (const auto told = stop.status()) {
        path.status = *told;
        break;
      }
    const auto number = search_.next();
    if (!number) break;
    const TangentSearch::Label& label = search_.labels()[*number];
    if (label.wheel == TangentSearch::none) {
      path.status = Status::solved;
      path.length = label.length;
      path.points = search_.path_to(*number);
      path.points.back() = goal;
      break;
    }
    ++path.expanded;
    search_.expand(*number);
  }
  if (path.status != Status::solved) path.points = near(goal);
  path.lines = search_.labels().size();
  return path;
}

/// A path to the point nearest to the goal that the search reached.
std::vector<Vec2> ShortestPaths::near(Vec2 goal) const {
  constexpr std::size_t tried = 16;  // nearest labels
  const auto labels = search_.labels();
  std::vector<std::uint32_t> near(labels.size());
  std::iota(near.begin(), near.end(), 0);
  const auto left = [&](std::uint32_t i) { return distance(labels[i].end(), goal); };
  const std::size_t count = std::min(tried, near.size());
  std::ranges::partial_sort(near, near.begin() + static_cast<std::ptrdiff_t>(count), {}, left);
  std::vector<Vec2> best{search_.start()};
  search_.add(walk(search_.start(), goal), best);
  for (const std::uint32_t i : std::span(near).first(count)) {
    const Vec2 end = walk(labels[i].end(), goal);
    if (distance(end, goal) >= distance(best.back(), goal)) continue;
    best = search_.path_to(i);
    search_.add(end, best);
  }
  return best;
}

/// End of the free part of the straight line to the goal.
Vec2 ShortestPaths::walk(Vec2 from, Vec2 goal) const {
  double free = 0, blocked = 1;
  for (int i = 0; i < 20; ++i) {
    const double middle = 0.5 * (free + blocked);
    const bool goes = search_.is_free({from, from + middle * (goal - from)});
    (goes ? free : blocked) = middle;
  }
  return from + free * (goal - from);
}

}  // namespace microswarm
