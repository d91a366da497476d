// SPDX-License-Identifier: Apache-2.0
#include "microswarm/world/connectivity/passage.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <queue>

#include "microswarm/core/fields/overloaded.hpp"
#include "microswarm/core/maths/angles.hpp"
#include "microswarm/core/maths/maths.hpp"
#include "microswarm/geometry/predicates.hpp"
#include "microswarm/world/connectivity/neck.hpp"
#include "microswarm/world/map/lattice.hpp"
#include "microswarm/world/obstacles/clip.hpp"

namespace microswarm {
namespace {

constexpr int corners_of_disc = 180;
constexpr double room_ratio = 1.25;
constexpr double room_share = 1e-3;
constexpr double widest_precision = 1e-3;
constexpr std::size_t max_passages = 100;

Polygon as_polygon(const Disc& d) {
  constexpr double sector = 2 * pi / corners_of_disc;
  const double radius = d.radius * std::sqrt(sector / maths::sin(sector));
  Polygon out;
  for (int k = 0; k < corners_of_disc; ++k) {
    out.outer.push_back(d.centre + radius * unit_vector(k * sector));
  }
  return out;
}

/// Connected components of the free space, largest first.
std::vector<Polygon> free_regions(const Map& map) {
  std::vector<Polygon> walls;
  for (const Body& body : map.walls().bodies())
    walls.push_back(std::visit(Overloaded{[](const Disc& disc) { return as_polygon(disc); },
                                          [](const Polygon& polygon) { return polygon; }},
                               body.shape));
  std::vector<Polygon> regions = difference(map.bounds(), walls);
  std::stable_sort(regions.begin(), regions.end(),
                   [](const Polygon& a, const Polygon& b) { return area(a) > area(b); });
  return regions;
}

/// Square that may contain the centre of the largest disc.
struct Square {
  double bound;
  double half;
  Vec2 centre;
  friend bool operator<(const Square& a, const Square& b) { return a.bound < b.bound; }
};

/// Branch and bound: clearance changes by at most 1 µm per µm.
Disc largest_disc(const Map& map) {
  Disc best{map.bounds().centre(), map.clearance(map.bounds().centre())};
  std::priority_queue<Square> open;
  auto ask = [&](Vec2 centre, double half) {
    const double clearance = map.clearance(centre);
    if (clearance > best.radius) best = {centre, clearance};
    const double bound = clearance + half * std::sqrt(2.0);
    if (bound > best.radius + widest_precision) open.push({bound, half, centre});
  };
  const NodeLattice start(map.bounds(), 0, 1000);
  for (std::uint32_t n = 0; n < start.size(); ++n) ask(start[n], 0.5 * start.spacing());
  for (int rounds = 0; rounds < 1000000 && !open.empty(); ++rounds) {
    const Square s = open.top();
    open.pop();
    if (s.bound <= best.radius + widest_precision) break;
    const double half = 0.5 * s.half;
    for (const Vec2 to :
         {Vec2{-half, -half}, Vec2{half, -half}, Vec2{-half, half}, Vec2{half, half}})
      ask(s.centre + to, half);
  }
  return best;
}

/// Components that merge as the required clearance falls.
class Rooms {
 public:
  explicit Rooms(const std::vector<double>& clearance)
      : parent_(clearance.size()), peak_(clearance), nodes_(clearance.size(), 1) {
    std::iota(parent_.begin(), parent_.end(), 0u);
  }
  std::uint32_t of(std::uint32_t node) {
    while (parent_[node] != node) node = parent_[node] = parent_[parent_[node]];
    return node;
  }
  double peak(std::uint32_t room) const { return peak_[room]; }
  std::uint32_t nodes(std::uint32_t room) const { return nodes_[room]; }
  void join(std::uint32_t a, std::uint32_t b) {
    if (nodes_[a] < nodes_[b]) std::swap(a, b);
    parent_[b] = a;
    nodes_[a] += nodes_[b];
    peak_[a] = std::max(peak_[a], peak_[b]);
  }

 private:
  std::vector<std::uint32_t> parent_;
  std::vector<double> peak_;
  std::vector<std::uint32_t> nodes_;
};

struct Edge {
  double clearance;
  std::uint32_t a;
  std::uint32_t b;
};

/// Clearance of the lattice's nodes in a region, 0 elsewhere.
std::vector<double> node_clearances(const Map& map, const Polygon& region,
                                    const NodeLattice& lattice) {
  std::vector<Segment> edges;
  for_each_edge(region, [&](Vec2 a, Vec2 b) { edges.push_back({a, b}); });
  const EdgeGrid grid(edges, std::vector<std::uint32_t>(edges.size(), 0));
  std::vector<double> out(lattice.size(), 0);
  for (std::uint32_t n = 0; n < lattice.size(); ++n) {
    const double clearance = map.clearance(lattice[n]);
    if (clearance > 0 && grid.in_solid(lattice[n])) out[n] = clearance;
  }
  return out;
}

std::vector<Passage> find_passages(const Map& map, const Polygon& region,
                                   const NodeLattice& lattice) {
  const std::vector<double> clearance = node_clearances(map, region, lattice);
  std::vector<Edge> edges;
  std::uint32_t region_nodes = 0;
  for (std::uint32_t a = 0; a < lattice.size(); ++a) {
    if (!(clearance[a] > 0)) continue;
    ++region_nodes;
    lattice.for_each_later_neighbour(a, [&](std::uint32_t b) {
      const double limit = std::min(clearance[a], clearance[b]);
      if (!(limit > 0)) return;
      const double c = map.clearance(Segment{lattice[a], lattice[b]}, limit);
      if (c > 0) edges.push_back({c, a, b});
    });
  }
  std::stable_sort(edges.begin(), edges.end(),
                   [](const Edge& a, const Edge& b) { return a.clearance > b.clearance; });

  Rooms rooms(clearance);
  std::vector<Passage> passages;
  for (const Edge& e : edges) {
    const std::uint32_t a = rooms.of(e.a);
    const std::uint32_t b = rooms.of(e.b);
    if (a == b) continue;
    const double min_peak = std::max(room_ratio * e.clearance, e.clearance + lattice.spacing());
    const bool are_rooms = std::min(rooms.peak(a), rooms.peak(b)) >= min_peak &&
                           std::min(rooms.nodes(a), rooms.nodes(b)) >= room_share * region_nodes;
    if (are_rooms) {
      passages.push_back(
          neck_near(map, 0.5 * (lattice[e.a] + lattice[e.b]), e.clearance, lattice.spacing()));
    }
    rooms.join(a, b);
  }
  std::stable_sort(passages.begin(), passages.end(),
                   [](const Passage& a, const Passage& b) { return a.width < b.width; });
  if (passages.size() > max_passages) passages.resize(max_passages);
  return passages;
}

}  // namespace

MapReport check_map(const Map& map, double cell) {
  const NodeLattice lattice(map.bounds(), cell, nodes_by_default);
  MapReport report;
  report.wall_pieces = map.pieces();
  report.resolution = lattice.spacing();
  const std::vector<Polygon> regions = free_regions(map);
  report.free_pieces = static_cast<int>(regions.size());
  for (const Polygon& region : regions) {
    report.region_areas.push_back(area(region));
    report.free_area += report.region_areas.back();
  }
  if (regions.empty()) return report;
  const Disc largest = largest_disc(map);
  report.widest = 2 * largest.radius;
  report.widest_place = largest.centre;
  report.passages = find_passages(map, regions.front(), lattice);
  report.narrowest_passage =
      report.passages.empty() ? report.widest : report.passages.front().width;
  return report;
}

bool connected(const Map& map, Vec2 a, Vec2 b) {
  for (const Polygon& region : free_regions(map)) {
    const bool holds_a = locate(region, a) != Side::outside;
    const bool holds_b = locate(region, b) != Side::outside;
    if (holds_a || holds_b) return holds_a && holds_b;
  }
  return false;
}

}  // namespace microswarm
