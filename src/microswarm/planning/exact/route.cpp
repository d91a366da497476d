// SPDX-License-Identifier: Apache-2.0
#include "microswarm/planning/exact/route.hpp"

#include <algorithm>

#include "microswarm/planning/common/free_goal.hpp"

namespace microswarm::planning {

/// First point of the path from `p` that keeps the clearance; nothing without a path.
std::optional<Vec2> Route::entry(Vec2 p) const {
  if (!tree_ || !is_finite(p)) return std::nullopt;
  return map_->is_free(p, clearance_) ? p : pushed_free(*map_, p, clearance_);
}

double Route::length_from(Vec2 p) {
  const auto begin = entry(p);
  return begin ? distance(p, *begin) + tree_->length_from(*begin) : infinity;
}

std::vector<Vec2> Route::path_from(Vec2 p) {
  const auto begin = entry(p);
  std::vector<Vec2> path = begin ? tree_->path_from(*begin) : std::vector<Vec2>{};
  if (!path.empty() && !(path.front() == p)) path.insert(path.begin(), p);
  return path;
}

Vec2 Route::ahead(Vec2 p, double reach) {
  const auto begin = entry(p);
  if (!begin) return p;
  const std::vector<Vec2> path = tree_->path_from(*begin);
  if (path.empty()) return p;
  const double sight = 0.9 * clearance_;
  Vec2 seen = path.front();
  double along = distance(p, seen);
  constexpr int pieces = 8;  // of the remaining reach
  for (std::size_t i = 1; i < path.size() && along < reach; ++i) {
    const Vec2 from = path[i - 1];
    const double length = distance(from, path[i]);
    const double part = std::min(length, reach - along);
    const Vec2 end = from + (length > 0 ? part / length : 0.0) * (path[i] - from);
    if (!map_->is_free(Segment{p, end}, sight)) {
      for (int k = pieces - 1; k > 0; --k) {
        const Vec2 nearer = from + (static_cast<double>(k) / pieces) * (end - from);
        if (map_->is_free(Segment{p, nearer}, sight)) return nearer;
      }
      return seen;
    }
    seen = end;
    along += part;
  }
  return seen;
}

}  // namespace microswarm::planning
