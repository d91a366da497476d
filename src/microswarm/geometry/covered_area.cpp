// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cstddef>
#include <utility>

#include "microswarm/geometry/area.hpp"
#include "microswarm/geometry/distance.hpp"
#include "microswarm/geometry/predicates.hpp"
#include "microswarm/geometry/union_area.hpp"

namespace microswarm {
namespace {

/// Obstacles closer to each other than this fraction of the query's radius count as overlapping.
constexpr double overlap_tolerance = 1e-9;

struct Scratch {
  std::array<std::byte, 16384> bytes;
  std::pmr::monotonic_buffer_resource memory{bytes.data(), bytes.size()};
};

using Edges = std::pmr::vector<Segment>;
using Obstacles = std::pmr::vector<NearObstacle>;

enum class Cover { none, part, all };

/// Collects the polygon's edges near the disc, relative to its centre, and how it covers the disc.
Cover find_near(Disc disc, const Polygon& polygon, Edges& edges, int& winding) {
  const double r = disc.radius;
  bool meets = false;
  winding = 0;
  for_each_edge(polygon, [&](Vec2 v, Vec2 w) {
    const Vec2 a = v - disc.centre;
    const Vec2 b = w - disc.centre;
    winding += winding_of_edge(a, b, {});
    if (std::min(a.x, b.x) > r || std::max(a.x, b.x) < -r || std::min(a.y, b.y) > r ||
        std::max(a.y, b.y) < -r) {
      return;
    }
    edges.push_back({a, b});
    meets = meets || squared_distance(Vec2{}, Segment{a, b}) < r * r;
  });
  return meets ? Cover::part : winding != 0 ? Cover::all : Cover::none;
}

Cover arc_cover(double r, Disc disc) {
  const double d = norm(disc.centre);
  return d >= r + disc.radius ? Cover::none : d + r <= disc.radius ? Cover::all : Cover::part;
}

bool holds(const NearObstacle& polygon, Vec2 p) {
  int winding = polygon.winding;
  for (const Segment& e : polygon.edges) winding += winding_along(e.a, e.b, {}, p);
  return winding != 0;
}

bool may_overlap(const NearObstacle& polygon, Disc disc) {
  const double reach = disc.radius * (1 + overlap_tolerance);
  for (const Segment& e : polygon.edges) {
    if (squared_distance(disc.centre, e) < reach * reach) return true;
  }
  const double d = norm(disc.centre);
  return holds(polygon, d <= disc.radius ? Vec2{} : (1 - disc.radius / d) * disc.centre);
}

/// Whether an edge of `a` meets the query disc inside `b`. (No two edges cross.)
bool reaches_into(const NearObstacle& a, const NearObstacle& b, double r) {
  for (const Segment& e : a.edges) {
    const Vec2 p = nearest_point({}, e);
    if (squared_norm(p) < r * r && holds(b, p)) return true;
  }
  return false;
}

bool may_overlap(const NearObstacle& a, const NearObstacle& b, double r) {
  if (a.is_disc && b.is_disc) {
    const double reach = a.disc.radius + b.disc.radius;
    return squared_norm(a.disc.centre - b.disc.centre) < reach * reach;
  }
  if (a.is_disc) return may_overlap(b, a.disc);
  if (b.is_disc) return may_overlap(a, b.disc);
  const double slack = overlap_tolerance * r;
  for (const Segment& s : a.edges) {
    const Box box = Box{{std::min(s.a.x, s.b.x), std::min(s.a.y, s.b.y)},
                        {std::max(s.a.x, s.b.x), std::max(s.a.y, s.b.y)}}
                        .grown(slack);
    for (const Segment& t : b.edges) {
      if (std::min(t.a.x, t.b.x) > box.hi.x || std::max(t.a.x, t.b.x) < box.lo.x ||
          std::min(t.a.y, t.b.y) > box.hi.y || std::max(t.a.y, t.b.y) < box.lo.y) {
        continue;
      }
      if (squared_distance(s, t) <= slack * slack) return true;
    }
  }
  return reaches_into(a, b, r) || reaches_into(b, a, r);
}

double covered_part(const NearObstacle& obstacle, double r) {
  const Disc disc{{}, r};
  if (obstacle.is_disc) return intersection_area(disc, obstacle.disc);
  double sum = obstacle.winding * area(disc);
  for (const Segment& e : obstacle.edges) sum += area_of_edge(disc, e);
  return sum;
}

/// Moves everything that overlaps obstacles[first], directly or through others, next to it; returns
/// the end of this group.
std::size_t gather_group(Obstacles& obstacles, std::size_t first, double r, const Stop& stop) {
  std::size_t end = first + 1;
  for (std::size_t i = first; i < end; ++i) {
    for (std::size_t j = end; j < obstacles.size(); ++j) {
      if (!obstacles[j].is_disc && stop()) return obstacles.size();
      if (may_overlap(obstacles[i], obstacles[j], r)) std::swap(obstacles[end++], obstacles[j]);
    }
  }
  return end;
}

}  // namespace

double covered_area(Disc disc, std::span<const Polygon* const> polygons,
                    std::span<const Disc> discs, const Stop& stop) {
  const double r = disc.radius;
  Scratch scratch;
  Edges edges(&scratch.memory);
  Obstacles obstacles(&scratch.memory);
  std::pmr::vector<std::size_t> ends(&scratch.memory);
  for (const Polygon* polygon : polygons) {
    const std::size_t first = edges.size();
    NearObstacle obstacle;
    const Cover cover = find_near(disc, *polygon, edges, obstacle.winding);
    if (cover == Cover::all) return area(disc);
    if (cover == Cover::none) {
      edges.resize(first);
      continue;
    }
    obstacles.push_back(obstacle);
    ends.push_back(edges.size());
  }
  for (std::size_t i = 0; i < obstacles.size(); ++i) {
    const std::size_t first = i == 0 ? 0 : ends[i - 1];
    obstacles[i].edges = {edges.data() + first, ends[i] - first};
  }
  for (const Disc& other : discs) {
    const Disc about{other.centre - disc.centre, other.radius};
    const Cover cover = arc_cover(r, about);
    if (cover == Cover::all) return area(disc);
    if (cover == Cover::part) obstacles.push_back({true, about, {}, 0});
  }
  double sum = 0;
  for (std::size_t first = 0; first < obstacles.size();) {
    const std::size_t end = gather_group(obstacles, first, r, stop);
    if (stop()) return 0;
    sum += end == first + 1 ? covered_part(obstacles[first], r)
                            : union_area(r, std::span(obstacles).subspan(first, end - first),
                                         scratch.memory, stop);
    first = end;
  }
  return std::clamp(sum, 0.0, area(disc));
}

}  // namespace microswarm
