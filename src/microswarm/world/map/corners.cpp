// SPDX-License-Identifier: Apache-2.0
#include "microswarm/world/map/corners.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

#include "microswarm/core/fields/overloaded.hpp"
#include "microswarm/core/maths/angles.hpp"

namespace microswarm {
namespace {

/// The ends of the two diameters, from left to right.
std::array<Vec2, 4> diameters(const Disc& d) {
  return {Vec2{d.centre.x - d.radius, d.centre.y}, Vec2{d.centre.x, d.centre.y - d.radius},
          Vec2{d.centre.x, d.centre.y + d.radius}, Vec2{d.centre.x + d.radius, d.centre.y}};
}

/// Radius of the disc around the same centre that touches no wall and no other disc of such a
/// radius: its own if it stands apart, else a smaller one.
double apart_radius(const BodySet& walls, std::size_t disc) {
  constexpr double less = 0.9;
  const Disc d = walls.discs().disc(disc);
  if (walls.polygons().holds(d.centre)) return 0;
  double radius = d.radius;
  const double edge = walls.polygons().edge_distance(d.centre, 2 * d.radius + 1);
  if (edge <= d.radius) radius = less * edge;
  walls.discs().for_each_in(bounding_box(d), [&](std::size_t i) {
    const Disc o = walls.discs().disc(i);
    const double apart = distance(o.centre, d.centre);
    if (i != disc && apart <= o.radius + d.radius && o.radius > 0)
      radius = std::min(radius, less * apart * d.radius / (d.radius + o.radius));
  });
  return radius;
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
                  .from = heading_along(-perpendicular(in)),
                  .width = maths::atan2(cross(in, out), dot(in, out))};
    corner.first = unit_vector(corner.from);
    corner.last = unit_vector(corner.from + corner.width);
    corners.push_back(corner);
  }
}

}  // namespace

void add_corners(const Body& body, const Box& bounds, std::vector<Corner>& corners) {
  std::visit(Overloaded{[&](const Disc& disc) {
                          corners.push_back({.centre = disc.centre,
                                             .radius = disc.radius,
                                             .width = 2 * pi,
                                             .is_disc = true});
                        },
                        [&](const Polygon& polygon) {
                          add_ring(polygon.outer, bounds, corners);
                          for (const auto& hole : polygon.holes) add_ring(hole, bounds, corners);
                        }},
             body.shape);
}

Corners::Lists Corners::Lists::made(std::size_t lists, const Pairs& pairs) {
  Lists made;
  made.first.assign(lists + 1, 0);
  made.all.resize(pairs.size());
  for (const auto& [list, number] : pairs) ++made.first[list + 1];
  std::partial_sum(made.first.begin(), made.first.end(), made.first.begin());
  auto next = made.first;
  for (const auto& [list, number] : pairs) made.all[next[list]++] = number;
  return made;
}

Corners::Corners(const BodySet& walls, const Box& bounds) {
  std::vector<Segment> segments;
  std::vector<std::uint32_t> standing, overlapping;  // corners that are discs
  std::size_t discs = 0;
  const auto add_disc = [&](const Disc& disc) {
    const auto number = static_cast<std::uint32_t>(corners_.size() - 1);
    const double radius = apart_radius(walls, discs++);
    (radius == disc.radius && radius > 0 ? standing : overlapping).push_back(number);
    if (radius <= 0.1 * disc.radius) return;  // hides too little
    const auto [left, low, high, right] = diameters({disc.centre, radius});
    segments.insert(segments.end(), {{left, low}, {left, high}, {low, right}, {high, right}});
  };
  const auto add_polygon = [&](const Polygon& polygon) {
    for_each_edge(polygon, [&](Vec2 a, Vec2 b) { segments.push_back({a, b}); });
  };
  for (const Body& body : walls.bodies()) {
    add_corners(body, bounds, corners_);
    std::visit(Overloaded{add_disc, add_polygon}, body.shape);
  }
  cells_ = Trapezoids(std::move(segments));
  index_polygons();
  index_discs(standing, overlapping);
}

/// Which corners are at the points.
void Corners::index_polygons() {
  Pairs at;
  for (std::uint32_t i = 0; i < corners_.size(); ++i)
    if (!corners_[i].is_disc) at.emplace_back(cells_.point_at(corners_[i].centre), i);
  at_ = Lists::made(cells_.points().size(), at);
}

/// Calls visit(cell, disc) for the cells that each of these discs may be in.
template <class Visit>
void Corners::for_each_cell_at(std::span<const std::uint32_t> discs, Visit&& visit) const {
  if (discs.empty()) return;
  std::vector<Body> bodies;
  for (const std::uint32_t i : discs)
    bodies.push_back({Disc{corners_[i].centre, corners_[i].radius}, 0});
  DiscSet set;
  set.assign(bodies);
  constexpr double rounding = 1e-6;  // [µm]
  for (std::uint32_t cell = 0; cell < cells_.cells().size(); ++cell) {
    const Box box = cells_.bounding_box(cell).grown(rounding);
    set.for_each_in(box, [&](std::size_t k) {
      if (box.overlaps(bounding_box(set.disc(k)))) visit(cell, discs[k]);
    });
  }
}

/// Index of the discs. Separate discs bound cells as walls do; others are listed in the cells where
/// no wall hides them.
void Corners::index_discs(std::span<const std::uint32_t> standing,
                          std::span<const std::uint32_t> overlapping) {
  Pairs around;
  std::vector<std::uint32_t> disc_at(cells_.points().size(), none);
  for (const std::uint32_t i : standing) {
    std::array<std::uint32_t, 4> inscribed;
    const auto ends = diameters({corners_[i].centre, corners_[i].radius});
    for (std::size_t k = 0; k < 4; ++k) disc_at[inscribed[k] = cells_.point_at(ends[k])] = i;
    for (const std::uint32_t cell : cells_.cells_around(inscribed)) around.emplace_back(i, cell);
  }
  disc_of_.resize(cells_.segments().size(), none);
  for (std::size_t s = 0; s < disc_of_.size(); ++s)
    disc_of_[s] = disc_at[cells_.point_at(cells_.segments()[s].a)];
  Pairs in;
  for_each_cell_at(overlapping, [&](std::uint32_t cell, std::uint32_t disc) {
    in.emplace_back(cell, disc);
    around.emplace_back(disc, cell);
  });
  overlapping_ = Lists::made(cells_.cells().size(), in);
  around_ = Lists::made(corners_.size(), around);
}

}  // namespace microswarm
