// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <queue>

#include "microswarm/world/connectivity/passage.hpp"
#include "microswarm/world/map/lattice.hpp"

namespace microswarm {
namespace {

constexpr std::uint32_t none = ~0u;

/// Open nodes: widest path first, among equals the shortest.
struct Open {
  double clearance;
  double length;
  std::uint32_t node;
  friend bool operator<(const Open& a, const Open& b) {
    if (a.clearance != b.clearance) return a.clearance < b.clearance;
    if (a.length != b.length) return a.length > b.length;
    return a.node > b.node;
  }
};

/// Dijkstra from a to b over the lattice; a and b are joined to the nodes around them.
class Search {
 public:
  Search(const Map& map, Vec2 a, Vec2 b, double enough, const NodeLattice& lattice)
      : map_(map),
        lattice_(lattice),
        a_(a),
        b_(b),
        enough_(enough),
        clearance_(lattice.size() + 2, 0),
        length_(lattice.size() + 2, 0),
        before_(lattice.size() + 2, none) {
    lattice.for_each_around(b, [&](std::uint32_t n) { last_nodes_.push_back(n); });
  }

  bool run() {
    clearance_[start()] = enough_;
    carry_on(start());
    while (!open_.empty()) {
      const Open best = open_.top();
      open_.pop();
      if (best.clearance < clearance_[best.node] || best.length > length_[best.node]) continue;
      if (best.node == goal()) return true;
      carry_on(best.node);
    }
    return false;
  }

  std::vector<Vec2> path() const {
    std::vector<Vec2> out;
    for (std::uint32_t n = goal(); n != none; n = before_[n]) out.push_back(at(n));
    std::reverse(out.begin(), out.end());
    return out;
  }

 private:
  std::uint32_t start() const { return lattice_.size(); }
  std::uint32_t goal() const { return lattice_.size() + 1; }
  Vec2 at(std::uint32_t n) const { return n == start() ? a_ : n == goal() ? b_ : lattice_[n]; }

  void carry_on(std::uint32_t from) {
    if (from == start()) {
      reach(from, goal());
      lattice_.for_each_around(a_, [&](std::uint32_t n) { reach(from, n); });
      return;
    }
    lattice_.for_each_neighbour(from, [&](std::uint32_t n) { reach(from, n); });
    if (std::find(last_nodes_.begin(), last_nodes_.end(), from) != last_nodes_.end()) {
      reach(from, goal());
    }
  }

  void reach(std::uint32_t from, std::uint32_t to) {
    if (clearance_[to] >= clearance_[from] && to != goal()) return;
    const Segment s{at(from), at(to)};
    const double clearance = map_.clearance(s, clearance_[from]);
    if (!(clearance > clearance_[to])) return;
    clearance_[to] = clearance;
    length_[to] = length_[from] + distance(s.a, s.b);
    before_[to] = from;
    open_.push({clearance, length_[to], to});
  }

  const Map& map_;
  const NodeLattice& lattice_;
  Vec2 a_;
  Vec2 b_;
  double enough_;
  std::vector<double> clearance_;
  std::vector<double> length_;
  std::vector<std::uint32_t> before_;
  std::vector<std::uint32_t> last_nodes_;
  std::priority_queue<Open> open_;
};

/// Point of minimum clearance on a segment, to a thousandth of its length.
Vec2 tightest_on(const Map& map, Segment s) {
  constexpr double far = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 10; ++i) {
    const Vec2 middle = 0.5 * (s.a + s.b);
    const double first = map.clearance(Segment{s.a, middle}, far);
    const double second = map.clearance(Segment{middle, s.b}, far);
    (first <= second ? s.b : s.a) = middle;
  }
  return 0.5 * (s.a + s.b);
}

}  // namespace

WidestPath widest_path(const Map& map, Vec2 a, Vec2 b, double enough, double cell) {
  const NodeLattice lattice(map.bounds(), cell, nodes_by_default);
  WidestPath out;
  out.resolution = lattice.spacing();
  Search search(map, a, b, enough, lattice);
  if (!search.run()) return out;
  out.found = true;
  out.path = search.path();
  out.clearance = map.clearance(Segment{a, a}, enough);
  out.tightest = a;
  for (std::size_t i = 1; i < out.path.size(); ++i) {
    const Segment s{out.path[i - 1], out.path[i]};
    const double clearance = map.clearance(s, out.clearance);
    if (clearance >= out.clearance) continue;
    out.clearance = clearance;
    out.tightest = tightest_on(map, s);
  }
  out.clearance *= 1 - 1e-12;  // rounding must not make it more than is_free grants
  return out;
}

}  // namespace microswarm
