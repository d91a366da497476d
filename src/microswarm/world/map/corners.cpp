// SPDX-License-Identifier: Apache-2.0
#include "microswarm/world/map/corners.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

#include "microswarm/core/maths/angles.hpp"

namespace microswarm {
namespace {

/// The ends of the two diameters, from left to right.
std::array<Vec2, 4> diameters(const Disc& d) {
  return {Vec2{d.centre.x - d.radius, d.centre.y}, Vec2{d.centre.x, d.centre.y - d.radius},
          Vec2{d.centre.x, d.centre.y + d.radius}, Vec2{d.centre.x + d.radius, d.centre.y}};
}

/// Whether no other wall touches the disc.
bool is_apart(const BodySet& walls, std::size_t disc) {
  const Disc d = walls.discs().disc(disc);
  if (walls.polygons().edge_distance(d.centre, 2 * d.radius + 1) <= d.radius) return false;
  if (walls.polygons().holds(d.centre)) return false;
  bool apart = true;
  walls.discs().for_each_in(bounding_box(d), [&](std::size_t i) {
    const Disc o = walls.discs().disc(i);
    if (i != disc && distance(o.centre, d.centre) <= o.radius + d.radius) apart = false;
  });
  return apart && d.radius > 0;
}

void add_ring(std::span<const Vec2> ring, const Box& bounds, std::vector<Corner>& corners) {
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec2 before = ring[i == 0 ? ring.size() - 1 : i - 1];
    const Vec2 at = ring[i];
    const Vec2 after = ring[i + 1 == ring.size() ? 0 : i + 1];
    if (!bounds.contains(at) || orientation(before, at, after) <= 0) continue;
    const Vec2 in = at - before, out = after - at;
    // The solid is on the left, so normals point to the right.
    Corner corner{.centre = at,
                  .from = heading_of(-perpendicular(in)),
                  .width = maths::atan2(cross(in, out), dot(in, out))};
    corner.first = unit_vector(corner.from);
    corner.last = unit_vector(corner.from + corner.width);
    corners.push_back(corner);
  }
}

}  // namespace

void add_corners(const Body& body, const Box& bounds, std::vector<Corner>& corners) {
  if (const auto* disc = std::get_if<Disc>(&body.shape)) {
    corners.push_back(
        {.centre = disc->centre, .radius = disc->radius, .width = 2 * pi, .is_disc = true});
    return;
  }
  const auto& polygon = std::get<Polygon>(body.shape);
  add_ring(polygon.outer, bounds, corners);
  for (const auto& hole : polygon.holes) add_ring(hole, bounds, corners);
}

Corners::Corners(const BodySet& walls, const Box& bounds) {
  std::vector<Segment> segments;
  std::vector<std::uint32_t> standing;  // corners of the discs that stand apart
  std::size_t discs = 0;
  for (const Body& body : walls.bodies()) {
    add_corners(body, bounds, corners_);
    if (const auto* polygon = std::get_if<Polygon>(&body.shape)) {
      for_each_edge(*polygon, [&](Vec2 a, Vec2 b) { segments.push_back({a, b}); });
      continue;
    }
    const auto number = static_cast<std::uint32_t>(corners_.size() - 1);
    if (!is_apart(walls, discs++)) {
      loose_.push_back(number);
      continue;
    }
    standing.push_back(number);
    const auto [left, low, high, right] = diameters(std::get<Disc>(body.shape));
    segments.insert(segments.end(), {{left, low}, {left, high}, {low, right}, {high, right}});
  }
  inscribed_.assign(corners_.size(), {none, none, none, none});
  index(std::move(segments), standing);
}

void Corners::index(std::vector<Segment> segments, std::span<const std::uint32_t> standing) {
  cells_ = Trapezoids(std::move(segments));
  const std::size_t points = cells_.points().size();
  first_at_.assign(points + 1, 0);
  std::vector<std::uint32_t> point_of(corners_.size(), none);
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    if (corners_[i].is_disc) continue;
    point_of[i] = cells_.point_at(corners_[i].centre);
    ++first_at_[point_of[i] + 1];
  }
  std::partial_sum(first_at_.begin(), first_at_.end(), first_at_.begin());
  at_.resize(first_at_.back());
  auto next = first_at_;
  for (std::uint32_t i = 0; i < corners_.size(); ++i)
    if (point_of[i] != none) at_[next[point_of[i]]++] = i;
  std::vector<std::uint32_t> disc_at(points, none);
  for (const std::uint32_t i : standing) {
    Inscribed& inscribed = inscribed_[i];
    const auto ends = diameters({corners_[i].centre, corners_[i].radius});
    for (std::size_t k = 0; k < 4; ++k) disc_at[inscribed[k] = cells_.point_at(ends[k])] = i;
  }
  disc_of_.resize(cells_.segments().size(), none);
  for (std::size_t s = 0; s < disc_of_.size(); ++s)
    disc_of_[s] = disc_at[cells_.point_at(cells_.segments()[s].a)];
}

}  // namespace microswarm
