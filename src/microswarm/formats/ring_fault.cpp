// SPDX-License-Identifier: Apache-2.0
#include "microswarm/formats/ring_fault.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "microswarm/geometry/distance.hpp"
#include "microswarm/geometry/edge_grid.hpp"
#include "microswarm/geometry/edge_meetings.hpp"
#include "microswarm/geometry/predicates.hpp"
#include "microswarm/world/obstacles/clip.hpp"

namespace microswarm::formats {
namespace {

/// Share of the extent by which computed points may be off.
constexpr double ring_rounding = 1e-9;

/// The edges of all rings of a polygon.
class RingEdges {
 public:
  explicit RingEdges(const Polygon& polygon) {
    add(polygon.outer);
    for (const auto& hole : polygon.holes) add(hole);
    const Box box = bounding_box(polygon);
    extent_ = std::max(box.width(), box.height());
    const std::vector<std::uint32_t> one_body(edges_.size(), 0);
    grid_.assign(edges_, one_body);
  }

  /// First proper crossing of two edges. `touch` receives the first contact without one.
  std::optional<RingFault> crossing(std::optional<RingFault>& touch) const {
    std::optional<RingFault> found;
    const bool complete = for_each_meeting(grid_, [&](std::size_t i, std::size_t j) {
      const Segment &s = edges_[i], &t = edges_[j];
      if (cross_properly(s, t) && !ends_on(s, t))
        found = fault(i, j, meeting_point(s, t));
      else if (!touch && !are_neighbours(i, j))
        touch = fault(i, j, contains(s, t.a) ? t.a : contains(s, t.b) ? t.b : s.a);
      return !found;
    });
    if (!complete) fail_too_many_meetings(edges_.size());
    return found;
  }

  /// Winding number beside p, to its right.
  int winding(Vec2 p) const { return grid_.winding(p); }

 private:
  void add(const std::vector<Vec2>& ring) {
    const std::size_t first = edges_.size();
    const std::size_t n = ring.size();
    for (std::size_t i = 0; i < n; ++i) {
      edges_.push_back({ring[i], ring[(i + 1) % n]});
      next_.push_back(first + (i + 1) % n);
      ring_of_.push_back(rings_);
    }
    ++rings_;
  }

  bool are_neighbours(std::size_t i, std::size_t j) const { return next_[i] == j || next_[j] == i; }

  static bool cross_properly(const Segment& s, const Segment& t) {
    return orientation(s.a, s.b, t.a) * orientation(s.a, s.b, t.b) < 0 &&
           orientation(t.a, t.b, s.a) * orientation(t.a, t.b, s.b) < 0;
  }

  /// Whether an end of one lies on the other except for rounding, as where rings were computed to
  /// touch.
  bool ends_on(const Segment& s, const Segment& t) const {
    return std::min({distance(s.a, t), distance(s.b, t), distance(t.a, s), distance(t.b, s)}) <=
           ring_rounding * extent_;
  }

  static Vec2 meeting_point(const Segment& s, const Segment& t) {
    const Vec2 along = s.b - s.a;
    const double area = cross(along, t.b - t.a);
    if (area == 0) return s.a;
    return s.a + cross(t.a - s.a, t.b - t.a) / area * along;
  }

  RingFault fault(std::size_t i, std::size_t j, Vec2 at) const {
    const std::size_t first = std::min(ring_of_[i], ring_of_[j]);
    const std::size_t second = std::max(ring_of_[i], ring_of_[j]);
    using Kind = RingFault::Kind;
    return {first == second ? Kind::crosses_itself : Kind::rings_cross, first, second, at};
  }

  std::vector<Segment> edges_;
  std::vector<std::size_t> next_;
  std::vector<std::size_t> ring_of_;
  std::size_t rings_ = 0;
  double extent_ = 0;
  EdgeGrid grid_;
};

/// First hole that is not surrounded by solid at its rightmost vertex.
std::optional<RingFault> stray_hole(const Polygon& polygon, const RingEdges& edges) {
  for (std::size_t i = 0; i < polygon.holes.size(); ++i) {
    const auto& hole = polygon.holes[i];
    const Vec2 rightmost = *std::max_element(hole.begin(), hole.end(), [](Vec2 a, Vec2 b) {
      return a.x != b.x ? a.x < b.x : a.y < b.y;
    });
    if (edges.winding(rightmost) != 1)
      return RingFault{RingFault::Kind::hole_outside, i + 1, 0, rightmost};
  }
  return std::nullopt;
}

/// Whether the solid by winding numbers has the area that the rings say.
bool area_is_clear(const Polygon& polygon) {
  double solid = 0;
  for (const Polygon& part : united(std::span(&polygon, 1))) solid += area(part);
  const Box box = bounding_box(polygon);
  double boundary = 0;
  for_each_edge(polygon, [&](Vec2 a, Vec2 b) { boundary += distance(a, b); });
  const double extent = std::max(box.width(), box.height());
  return std::abs(solid - area(polygon)) <=
         ring_rounding * (box.width() * box.height() + boundary * extent / 100);
}

}  // namespace

std::optional<RingFault> find_ring_fault(const Polygon& polygon) {
  if (polygon.outer.empty()) return std::nullopt;
  const RingEdges edges(polygon);
  std::optional<RingFault> touch;
  if (const auto crossing = edges.crossing(touch)) return crossing;
  if (!touch) return stray_hole(polygon, edges);
  if (area_is_clear(polygon)) return std::nullopt;
  const auto stray = stray_hole(polygon, edges);
  return stray ? stray : touch;
}

}  // namespace microswarm::formats
