// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory_resource>
#include <span>
#include <utility>
#include <vector>

#include "microswarm/core/fields/overloaded.hpp"
#include "microswarm/geometry/area.hpp"
#include "microswarm/geometry/predicates.hpp"
#include "microswarm/geometry/union_area.hpp"
#include "microswarm/world/obstacles/body_set.hpp"

namespace microswarm {
namespace {

/// Body that intersects the circle, and its distance from the circle's centre.
struct Met {
  std::uint32_t body;
  double distance;
};
using MetBodies = std::pmr::vector<Met>;

/// Stack memory for a survey; larger surveys use the heap.
struct SurveyMemory {
  std::array<std::byte, 8192> bytes;
  std::pmr::monotonic_buffer_resource memory{bytes.data(), bytes.size()};
};

void note(std::uint32_t body, double distance, MetBodies& met) {
  for (Met& m : met) {
    if (m.body != body) continue;
    m.distance = std::min(m.distance, distance);
    return;
  }
  met.push_back({body, distance});
}

void find_met(const BodySet& set, Disc circle, MetBodies& met) {
  const DiscSet& discs = set.discs();
  const Box box = bounding_box(circle);
  discs.for_each_in(box, [&](std::size_t i) {
    const double d = distance(circle.centre, discs.disc(i));
    if (d <= circle.radius) met.push_back({discs.enclosing_pose(i), d});
  });
  const PolygonSet& polygons = set.polygons();
  if (polygons.empty()) return;
  const double squared_radius = circle.radius * circle.radius;
  polygons.for_each_edge_in(box, [&](std::uint32_t body, const Segment& edge) {
    const double d2 = squared_distance(circle.centre, edge);
    if (d2 <= squared_radius) note(body, std::sqrt(d2), met);
  });
  if (!polygons.holds(circle.centre)) return;
  for (std::uint32_t i = 0; i < set.bodies().size(); ++i) {
    if (is_in_polygon(circle.centre, set.bodies()[i])) note(i, 0, met);
  }
}

void count(std::span<const Body> bodies, const MetBodies& met, Survey& survey) {
  for (std::size_t i = 0; i < met.size(); ++i) {
    const std::uint32_t obstacle = bodies[met[i].body].obstacle;
    double least = met[i].distance;
    bool is_first = true;
    for (std::size_t j = 0; j < met.size(); ++j) {
      if (bodies[met[j].body].obstacle != obstacle) continue;
      is_first = is_first && j >= i;
      least = std::min(least, met[j].distance);
    }
    if (!is_first) continue;
    ++survey.obstacles;
    survey.distance_sum += least;
  }
}

/// Obstacles near the circle, as input of union_area. A set with disjoint polygons is one obstacle.
class Collection {
 public:
  Collection(Disc circle, std::pmr::memory_resource& memory)
      : circle_(circle), memory_(memory), edges_(&memory), obstacles_(&memory), ends_(&memory) {}

  void add(const BodySet& set, const MetBodies& met) {
    const bool as_one = set.polygons_apart();
    bool is_added = false;
    const auto add_disc = [&](const Disc& disc) {
      obstacles_.push_back({true, {disc.centre - circle_.centre, disc.radius}, {}, 0});
      ends_.push_back(edges_.size());
    };
    const auto add_one = [&](const Polygon& polygon) {
      if (!as_one) return add(polygon);
      if (!std::exchange(is_added, true)) add(set.polygons());
    };
    for (const Met& m : met) std::visit(Overloaded{add_disc, add_one}, set.bodies()[m.body].shape);
  }

  double area_of_union(const Stop& stop) {
    for (std::size_t i = 0; i < obstacles_.size(); ++i) {
      const std::size_t first = i == 0 ? 0 : ends_[i - 1];
      obstacles_[i].edges = {edges_.data() + first, ends_[i] - first};
    }
    return union_area(circle_.radius, obstacles_, memory_, stop);
  }

 private:
  void add(const Polygon& polygon) {
    int winding = 0;
    for_each_edge(polygon, [&](Vec2 a, Vec2 b) {
      winding += winding_of_edge(a, b, circle_.centre);
      add_edge({a, b});
    });
    add_polygon(winding);
  }
  void add(const PolygonSet& polygons) {
    polygons.for_each_edge_in(bounding_box(circle_),
                              [&](std::uint32_t, const Segment& edge) { add_edge(edge); });
    add_polygon(polygons.winding(circle_.centre));
  }
  void add_edge(const Segment& edge) {
    const Segment e{edge.a - circle_.centre, edge.b - circle_.centre};
    const double r = circle_.radius;
    if (std::min(e.a.x, e.b.x) > r || std::max(e.a.x, e.b.x) < -r || std::min(e.a.y, e.b.y) > r ||
        std::max(e.a.y, e.b.y) < -r) {
      return;
    }
    edges_.push_back(e);
  }
  void add_polygon(int winding) {
    obstacles_.push_back({false, {}, {}, winding});
    ends_.push_back(edges_.size());
  }

  Disc circle_;
  std::pmr::memory_resource& memory_;
  std::pmr::vector<Segment> edges_;
  std::pmr::vector<NearObstacle> obstacles_;
  std::pmr::vector<std::size_t> ends_;
};

double area_covered(Disc circle, const BodySet& set, const MetBodies& met,
                    std::pmr::memory_resource& memory, const Stop& stop) {
  const EdgeGrid& grid = set.polygons().grid();
  if (!set.polygons_apart() || grid.empty()) {
    std::pmr::vector<const Polygon*> polygons(&memory);
    std::pmr::vector<Disc> discs(&memory);
    for (const Met& m : met)
      std::visit(Overloaded{[&](const Disc& disc) { discs.push_back(disc); },
                            [&](const Polygon& polygon) { polygons.push_back(&polygon); }},
                 set.bodies()[m.body].shape);
    return covered_area(circle, polygons, discs, stop);
  }
  const bool meets_disc = std::any_of(met.begin(), met.end(),
                                      [&](const Met& m) { return is_disc(set.bodies()[m.body]); });
  if (!meets_disc) return covered_area(circle, grid);
  Collection all(circle, memory);
  all.add(set, met);
  return all.area_of_union(stop);
}

/// A point of the body.
Vec2 point_in(const Body& body) {
  return std::visit(Overloaded{[](const Disc& disc) { return disc.centre; },
                               [](const Polygon& polygon) { return polygon.outer[0]; }},
                    body.shape);
}

/// Whether a moving body in the circle may overlap a wall in it. Exact for discs.
bool may_overlap(const BodySet& walls, const MetBodies& met_walls, const Body& moving) {
  const auto disc_overlaps = [&](const Disc& disc) {
    return walls.clearance(disc.centre, disc.radius) < disc.radius;
  };
  const auto polygon_overlaps = [&](const Polygon& polygon) {
    bool free = true;
    for_each_edge(polygon, [&](Vec2 a, Vec2 b) { free = free && walls.is_free(Segment{a, b}, 0); });
    return !free || std::any_of(met_walls.begin(), met_walls.end(), [&](const Met& m) {
      return locate(polygon, point_in(walls.bodies()[m.body])) != Side::outside;
    });
  };
  return std::visit(Overloaded{disc_overlaps, polygon_overlaps}, moving.shape);
}

}  // namespace

void BodySet::survey(Disc circle, Survey& survey, const Stop& stop) const {
  SurveyMemory scratch;
  MetBodies met(&scratch.memory);
  find_met(*this, circle, met);
  if (met.empty()) return;
  count(bodies_, met, survey);
  survey.covered_area += area_covered(circle, *this, met, scratch.memory, stop);
}

Survey survey(Disc circle, const BodySet& walls, const BodySet& moving, const Stop& stop) {
  SurveyMemory scratch;
  MetBodies met_walls(&scratch.memory);
  MetBodies met_moving(&scratch.memory);
  find_met(walls, circle, met_walls);
  find_met(moving, circle, met_moving);
  Survey out;
  count(walls.bodies(), met_walls, out);
  count(moving.bodies(), met_moving, out);
  const bool overlapping =
      !met_walls.empty() && std::any_of(met_moving.begin(), met_moving.end(), [&](const Met& m) {
        return may_overlap(walls, met_walls, moving.bodies()[m.body]);
      });
  if (overlapping) {
    Collection all(circle, scratch.memory);
    all.add(walls, met_walls);
    all.add(moving, met_moving);
    out.covered_area = all.area_of_union(stop);
    return out;
  }
  for (const auto& [set, met] : {std::pair{&walls, &met_walls}, {&moving, &met_moving}}) {
    if (!met->empty()) out.covered_area += area_covered(circle, *set, *met, scratch.memory, stop);
  }
  return out;
}

}  // namespace microswarm
