// SPDX-License-Identifier: Apache-2.0
#include "microswarm/world/obstacles/contacts.hpp"

#include <algorithm>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <cstdint>
#include <numeric>

#include "microswarm/geometry/distance.hpp"
#include "microswarm/geometry/edge_grid.hpp"
#include "microswarm/geometry/edge_meetings.hpp"
#include "microswarm/geometry/predicates.hpp"

namespace microswarm {
namespace {

namespace index = boost::geometry::index;

/// Directions at a vertex that lead into the solid: counter-clockwise from `start` to `end`.
struct Sector {
  Vec2 start;
  Vec2 end;
};

/// Whether the direction v → d leads strictly into the sector at v.
bool leads_into(const Sector& s, Vec2 v, Vec2 d) {
  const int turn = orientation(v, s.start, s.end);
  const int after_start = orientation(v, s.start, d);
  if (turn == 0) return after_start > 0 && dot(s.start - v, s.end - v) < 0;
  const int before_end = orientation(v, d, s.end);
  if (turn > 0) return after_start > 0 && before_end > 0;
  return after_start > 0 || before_end > 0;
}

/// Of two sectors that overlap, one contains the start of the other. If both start in the same
/// direction, so do two edges, which overlap themselves.
bool overlap(const Sector& s, const Sector& t, Vec2 v) {
  return leads_into(s, v, t.start) || leads_into(t, v, s.start);
}

/// The edges of all polygons with their neighbours in the ring.
class Rings {
 public:
  explicit Rings(std::span<const Polygon> polygons) {
    for (std::size_t i = 0; i < polygons.size(); ++i) {
      add(polygons[i].outer, i);
      for (const auto& hole : polygons[i].holes) add(hole, i);
      boxes_.push_back(bounding_box(polygons[i]));
    }
    grid_.assign(edges_, polygon_of_);
    std::vector<Entry> entries;
    for (std::size_t i = 0; i < boxes_.size(); ++i)
      if (!polygons[i].outer.empty())
        entries.emplace_back(
            TreeBox({boxes_[i].lo.x, boxes_[i].lo.y}, {boxes_[i].hi.x, boxes_[i].hi.y}),
            static_cast<std::uint32_t>(i));
    tree_ = BoxTree(entries);
  }

  const EdgeGrid& grid() const { return grid_; }

  void find_contacts(std::vector<Contact>& out) const {
    const bool found = for_each_meeting(grid_, [&](std::size_t i, std::size_t j) {
      const std::size_t first = polygon_of_[i];
      const std::size_t second = polygon_of_[j];
      if (first != second) {
        out.push_back({first, second, edges_overlap(i, j)});
      } else if (next_[i] != j && next_[j] != i && ring_crosses(i, j)) {
        out.push_back({first, first, true});
      }
      return true;
    });
    if (!found) fail_too_many_meetings(edges_.size());
  }

  /// Polygons whose solid contains p, which is on none of their edges.
  void holding(Vec2 p, std::vector<std::uint32_t>& out) {
    out.clear();
    crossed_.clear();
    // No ring of a polygon around p is left of the boxes that hold p.
    Box ray{p, p};
    const auto around = tree_.qbegin(index::intersects(TreeBox({p.x, p.y}, {p.x, p.y})));
    if (around == tree_.qend()) return;
    for (auto found = around; found != tree_.qend(); ++found)
      ray.lo.x = std::min(ray.lo.x, boxes_[found->second].lo.x);
    grid_.for_each_in(ray, [&](std::size_t i) {
      const Segment& e = edges_[i];
      if (!boxes_[polygon_of_[i]].contains(p)) return;
      if ((e.a.y <= p.y) == (e.b.y <= p.y)) return;
      const bool is_left = orientation(e.a, e.b, p) == (e.b.y > e.a.y ? -1 : 1);
      if (is_left) crossed_.push_back({polygon_of_[i], e.b.y > e.a.y ? 1 : -1});
    });
    std::sort(crossed_.begin(), crossed_.end(),
              [](const Crossed& a, const Crossed& b) { return a.polygon < b.polygon; });
    for (std::size_t i = 0; i < crossed_.size();) {
      int winding = 0;
      const std::uint32_t polygon = crossed_[i].polygon;
      for (; i < crossed_.size() && crossed_[i].polygon == polygon; ++i)
        winding += crossed_[i].turn;
      if (winding != 0) out.push_back(polygon);
    }
  }

 private:
  using TreePoint = boost::geometry::model::point<double, 2, boost::geometry::cs::cartesian>;
  using TreeBox = boost::geometry::model::box<TreePoint>;
  using Entry = std::pair<TreeBox, std::uint32_t>;
  using BoxTree = index::rtree<Entry, index::rstar<16>>;

  struct Crossed {
    std::uint32_t polygon;
    int turn;
  };

  void add(const std::vector<Vec2>& ring, std::size_t polygon) {
    const std::size_t first = edges_.size();
    const std::size_t n = ring.size();
    for (std::size_t i = 0; i < n; ++i) {
      edges_.push_back({ring[i], ring[(i + 1) % n]});
      next_.push_back(first + (i + 1) % n);
      before_.push_back(ring[(i + n - 1) % n]);
      polygon_of_.push_back(static_cast<std::uint32_t>(polygon));
    }
  }

  Sector sector_at(std::size_t edge, Vec2 v) const {
    const Segment& e = edges_[edge];
    if (v == e.a) return {e.b, before_[edge]};
    if (v == e.b) return {edges_[next_[edge]].b, e.a};
    return {e.b, e.a};
  }

  /// Whether the solids beside two edges that meet share more than points.
  bool edges_overlap(std::size_t i, std::size_t j) const {
    const Segment& s = edges_[i];
    const Segment& t = edges_[j];
    const bool collinear = orientation(s.a, s.b, t.a) == 0 && orientation(s.a, s.b, t.b) == 0;
    if (collinear) {
      int ends_within = 0;
      for (const Vec2 v : {s.a, s.b}) ends_within += contains(t, v) ? 1 : 0;
      for (const Vec2 v : {t.a, t.b}) ends_within += contains(s, v) ? 1 : 0;
      const bool one_point =
          ends_within == 2 && (s.a == t.a || s.a == t.b || s.b == t.a || s.b == t.b);
      if (!one_point) return true;
    }
    return crosses(i, j);
  }

  /// Whether the ring crosses itself; slits and touching corners are allowed.
  bool ring_crosses(std::size_t i, std::size_t j) const {
    const Segment& s = edges_[i];
    const Segment& t = edges_[j];
    return orientation(s.a, s.b, t.a) * orientation(s.a, s.b, t.b) < 0 &&
           orientation(t.a, t.b, s.a) * orientation(t.a, t.b, s.b) < 0;
  }

  bool crosses(std::size_t i, std::size_t j) const {
    const Segment& s = edges_[i];
    const Segment& t = edges_[j];
    bool at_vertex = false;
    for (const Vec2 v : {s.a, s.b, t.a, t.b}) {
      if (!contains(s, v) || !contains(t, v)) continue;
      at_vertex = true;
      if (overlap(sector_at(i, v), sector_at(j, v), v)) return true;
    }
    return !at_vertex;
  }

  std::vector<Segment> edges_;
  std::vector<std::uint32_t> polygon_of_;
  std::vector<std::size_t> next_;
  std::vector<Vec2> before_;
  EdgeGrid grid_;
  std::vector<Box> boxes_;  // of the polygons
  BoxTree tree_;            // of the same
  std::vector<Crossed> crossed_;
};

void find_disc_contacts(std::span<const Disc> discs, std::size_t offset,
                        std::vector<Contact>& out) {
  std::vector<std::size_t> order(discs.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  auto left = [&](std::size_t i) { return discs[i].centre.x - discs[i].radius; };
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return left(a) < left(b); });
  for (std::size_t k = 0; k < order.size(); ++k) {
    const Disc& d = discs[order[k]];
    for (std::size_t m = k + 1; m < order.size(); ++m) {
      const Disc& e = discs[order[m]];
      if (left(order[m]) > d.centre.x + d.radius) break;
      if (distance(d.centre, e.centre) <= d.radius + e.radius) {
        out.push_back({offset + order[k], offset + order[m], false});
      }
    }
  }
}

}  // namespace

std::vector<Contact> find_contacts(std::span<const Polygon> polygons, std::span<const Disc> discs) {
  std::vector<Contact> contacts;
  Rings rings(polygons);
  rings.find_contacts(contacts);
  std::vector<std::uint32_t> holders;
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    if (polygons[i].outer.empty()) continue;
    rings.holding(polygons[i].outer[0], holders);
    for (const std::uint32_t k : holders) {
      if (k != i) contacts.push_back({i, k, true});
    }
  }
  for (std::size_t i = 0; i < discs.size(); ++i) {
    const Disc& d = discs[i];
    const std::size_t self = polygons.size() + i;
    rings.grid().for_each_in(Box{d.centre, d.centre}.grown(d.radius), [&](std::size_t edge) {
      if (distance(d.centre, rings.grid().edge(edge)) <= d.radius) {
        contacts.push_back({rings.grid().enclosing_pose(edge), self, false});
      }
    });
    rings.holding(d.centre, holders);
    for (const std::uint32_t k : holders) contacts.push_back({k, self, false});
  }
  find_disc_contacts(discs, polygons.size(), contacts);
  return contacts;
}

}  // namespace microswarm
