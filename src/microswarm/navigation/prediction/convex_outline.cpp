// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/prediction/convex_outline.hpp"

#include <algorithm>
#include <cmath>

#include "microswarm/core/maths/infinity.hpp"
#include "microswarm/navigation/prediction/obstacle_tracker.hpp"

namespace microswarm {

double ConvexOutline::distance_at(Vec2 from_centre) const {
  if (edges.empty()) return norm(from_centre) - radius;
  double inside = -infinity;
  double outside = infinity;  // squared
  for (const Edge& e : edges) {
    const double off = dot(e.normal, from_centre) - e.offset;
    inside = std::max(inside, off);
    if (off <= 0) continue;
    const double along = dot(perpendicular(e.normal), from_centre);
    const double beside = along - std::clamp(along, e.begin, e.end);
    outside = std::min(outside, off * off + beside * beside);
  }
  return inside <= 0 ? inside : std::sqrt(outside);
}

void ConvexOutliner::take(const Body& body, ConvexOutline& out) {
  const Disc extent = extent_of(body);
  out.centre = extent.centre;
  out.radius = extent.radius;
  out.edges.clear();
  hollow_share_ = 0;
  const auto* polygon = std::get_if<Polygon>(&body.shape);
  if (!polygon) return;
  find_hull(polygon->outer);
  for (std::size_t i = 0; i < hull_.size(); ++i) {
    const Vec2 a = hull_[i] - out.centre;
    const Vec2 along = hull_[(i + 1) % hull_.size()] - hull_[i];
    const Vec2 normal = -perpendicular(along) / norm(along);
    const double begin = dot(perpendicular(normal), a);
    out.edges.push_back({normal, dot(normal, a), begin, begin + norm(along)});
  }
  const double whole = signed_area(hull_);
  if (whole > 0) hollow_share_ = 1 - area(*polygon) / whole;
}

bool ConvexOutliner::misleads(const ConvexOutline& out, std::span<const Vec2> places) const {
  if (hollow_share_ <= tuning_.ignored_hollow) return false;
  return hollow_share_ > tuning_.max_hollow ||
         std::any_of(places.begin(), places.end(),
                     [&](Vec2 p) { return out.distance_at(p - out.centre) < 0; });
}

// Monotone chain (Andrew).
void ConvexOutliner::find_hull(const std::vector<Vec2>& outline) {
  sorted_.assign(outline.begin(), outline.end());
  std::sort(sorted_.begin(), sorted_.end(),
            [](Vec2 a, Vec2 b) { return a.x != b.x ? a.x < b.x : a.y < b.y; });
  sorted_.erase(std::unique(sorted_.begin(), sorted_.end()), sorted_.end());
  hull_.clear();
  const auto add = [&](Vec2 p, std::size_t kept) {
    while (hull_.size() > kept &&
           cross(hull_.back() - hull_[hull_.size() - 2], p - hull_.back()) <= 0)
      hull_.pop_back();
    hull_.push_back(p);
  };
  for (const Vec2 p : sorted_) add(p, 1);
  const std::size_t lower = hull_.size();
  for (std::size_t i = sorted_.size() - 1; i-- > 0;) add(sorted_[i], lower);
  if (hull_.size() > 1) hull_.pop_back();
}

}  // namespace microswarm
