// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/prediction/convex_outline.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "microswarm/core/execution/each_cpu.hpp"
#include "microswarm/core/fields/overloaded.hpp"
#include "microswarm/core/maths/infinity.hpp"
#include "microswarm/geometry/distance.hpp"
#include "microswarm/navigation/prediction/obstacle_tracker.hpp"

namespace microswarm::navigation {
namespace {

/// Number of points that are tested against the edges together.
constexpr std::size_t points_at_once = 64;

MICROSWARM_EACH_CPU void distances_from_disc(const double* x, const double* y, std::size_t count,
                                             double radius, double* distances) {
  for (std::size_t k = 0; k < count; ++k)
    distances[k] = std::sqrt(x[k] * x[k] + y[k] * y[k]) - radius;
}

/// Distances of at most points_at_once points from a hull's edges [µm].
MICROSWARM_EACH_CPU void distances_from_edges(const double* x, const double* y, std::size_t count,
                                              const ConvexOutline::Edge* edges,
                                              std::size_t edge_count, double* distances) {
  std::array<double, points_at_once> inside;
  std::array<double, points_at_once> outside;  // squared
  for (std::size_t k = 0; k < count; ++k) {
    inside[k] = -infinity;
    outside[k] = infinity;
  }
  for (std::size_t i = 0; i < edge_count; ++i) {
    const ConvexOutline::Edge e = edges[i];
    for (std::size_t k = 0; k < count; ++k) {
      const double off = e.normal.x * x[k] + e.normal.y * y[k] - e.offset;
      const double along = -e.normal.y * x[k] + e.normal.x * y[k];
      const double up_to_end = e.end < along ? e.end : along;
      const double beside = along - (along < e.begin ? e.begin : up_to_end);
      const double squared = off * off + beside * beside;
      const double nearer = squared < outside[k] ? squared : outside[k];
      outside[k] = off <= 0 ? outside[k] : nearer;
      inside[k] = inside[k] < off ? off : inside[k];
    }
  }
  for (std::size_t k = 0; k < count; ++k) {
    const double out = std::sqrt(outside[k]);
    distances[k] = inside[k] <= 0 ? inside[k] : out;
  }
}

}  // namespace

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

double ConvexOutline::distance_along(Vec2 a, Vec2 b, double near) const {
  const double bound = std::min(norm(a), norm(b)) - 0.5 * distance(a, b) - radius;
  if (edges.empty() || bound > near) return distance(Vec2{}, Segment{a, b}) - radius;
  constexpr int halvings = 12;
  double first = 0;
  double last = 1;
  const auto at = [&](double share) { return distance_at(a + share * (b - a)); };
  for (int k = 0; k < halvings; ++k) {
    const double left = first + (last - first) / 3;
    const double right = last - (last - first) / 3;
    (at(left) <= at(right) ? last : first) = at(left) <= at(right) ? right : left;
  }
  return std::min({at(0), at(1), at(0.5 * (first + last))});
}

void ConvexOutline::distances_at(std::span<const double> x, std::span<const double> y,
                                 std::span<double> distances) const {
  assert(x.size() == y.size() && x.size() == distances.size());
  if (edges.empty())
    return distances_from_disc(x.data(), y.data(), x.size(), radius, distances.data());
  for (std::size_t k = 0; k < x.size(); k += points_at_once)
    distances_from_edges(x.data() + k, y.data() + k, std::min(points_at_once, x.size() - k),
                         edges.data(), edges.size(), distances.data() + k);
}

void ConvexOutliner::take(const Body& body, ConvexOutline& out) {
  const Disc extent = enclosing_disc(body);
  out.centre = extent.centre;
  out.radius = extent.radius;
  out.edges.clear();
  hollow_share_ = 0;
  std::visit(Overloaded{[](const Disc&) {}, [&](const Polygon& p) { take(p, out); }}, body.shape);
}

void ConvexOutliner::take(const Polygon& polygon, ConvexOutline& out) {
  find_hull(polygon.outer);
  for (std::size_t i = 0; i < hull_.size(); ++i) {
    const Vec2 a = hull_[i] - out.centre;
    const Vec2 along = hull_[(i + 1) % hull_.size()] - hull_[i];
    const Vec2 normal = -perpendicular(along) / norm(along);
    const double begin = dot(perpendicular(normal), a);
    out.edges.push_back({normal, dot(normal, a), begin, begin + norm(along)});
  }
  const double whole = signed_area(hull_);
  if (whole > 0) hollow_share_ = 1 - area(polygon) / whole;
}

bool ConvexOutliner::misleads(const ConvexOutline& out, std::span<const Vec2> positions) const {
  if (hollow_share_ <= tuning_.ignored_hollow) return false;
  return hollow_share_ > tuning_.max_hollow ||
         std::any_of(positions.begin(), positions.end(),
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

}  // namespace microswarm::navigation
