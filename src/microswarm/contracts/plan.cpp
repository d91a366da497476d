// SPDX-License-Identifier: Apache-2.0
#include "microswarm/contracts/plan.hpp"

#include <algorithm>
#include <optional>

#include "microswarm/core/maths/angles.hpp"

namespace microswarm {
namespace {

/// Calls visit(heading) for every edge of non-zero length.
template <class Visit>
void for_each_heading(std::span<const Vec2> path, Visit&& visit) {
  for (std::size_t i = 1; i < path.size(); ++i) {
    if (path[i] != path[i - 1]) visit(heading_along(path[i] - path[i - 1]));
  }
}

}  // namespace

double path_length(std::span<const Vec2> path) {
  double length = 0;
  for (std::size_t i = 1; i < path.size(); ++i) length += distance(path[i - 1], path[i]);
  return length;
}

double path_turning(std::span<const Vec2> path, double start_heading) {
  double turning = 0;
  double heading = start_heading;
  for_each_heading(path, [&](double next) {
    turning += turn_between(heading, next);
    heading = next;
  });
  return turning;
}

double path_turning(std::span<const Vec2> path) {
  std::optional<double> first;
  for_each_heading(path, [&](double heading) {
    if (!first) first = heading;
  });
  return first ? path_turning(path, *first) : 0;
}

std::vector<Vec2> path_to(std::span<const TreeNode> tree, std::uint32_t node) {
  std::vector<Vec2> path{tree[node].position};
  for (; node != 0; node = tree[node].parent) path.push_back(tree[tree[node].parent].position);
  std::reverse(path.begin(), path.end());
  return path;
}

}  // namespace microswarm
