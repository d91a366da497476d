// SPDX-License-Identifier: Apache-2.0
#include "microswarm/geometry/touching_edges.hpp"

#include <algorithm>
#include <set>

#include "microswarm/geometry/predicates.hpp"

namespace microswarm {
namespace {

bool is_before(Vec2 a, Vec2 b) { return a.x != b.x ? a.x < b.x : a.y < b.y; }

/// An end of an edge.
struct End {
  Vec2 at;
  std::uint32_t edge;
};

/// A line that moves over the plane from left to right, tilted so little that it meets the points
/// of an upright edge from below. Edges that it meets are in their order along it, which changes at
/// ends only as long as no two edges cross.
class EdgeSweep {
 public:
  EdgeSweep(std::span<const Segment> edges, std::size_t max_pairs)
      : edges_(edges.begin(), edges.end()), max_pairs_(max_pairs), met_(Below{&edges_}) {
    ends_.reserve(2 * edges_.size());
    for (std::uint32_t i = 0; i < edges_.size(); ++i) {
      if (is_before(edges_[i].b, edges_[i].a)) std::swap(edges_[i].a, edges_[i].b);
      ends_.push_back({edges_[i].a, i});
      if (edges_[i].a != edges_[i].b) ends_.push_back({edges_[i].b, i});
    }
    std::ranges::sort(ends_, [](const End& s, const End& t) {
      return s.at != t.at ? is_before(s.at, t.at) : s.edge < t.edge;
    });
  }

  /// False if two edges cross, or too many meet.
  bool run() {
    for (std::size_t first = 0; first < ends_.size();) {
      std::size_t last = first;
      while (last < ends_.size() && ends_[last].at == ends_[first].at) ++last;
      if (!pass(std::span(ends_).subspan(first, last - first))) return false;
      first = last;
    }
    return true;
  }

  std::vector<EdgePair> take_pairs() {
    std::ranges::sort(pairs_);
    return std::move(pairs_);
  }

 private:
  /// Order along the line of edges that do not cross, and of points among them.
  struct Below {
    using is_transparent = void;
    const std::vector<Segment>* edges;

    bool operator()(std::uint32_t i, std::uint32_t j) const {
      const Segment &s = (*edges)[i], &t = (*edges)[j];
      const bool later = is_before(t.a, s.a);
      const int side = later ? -side_of(t, s) : side_of(s, t);
      return side != 0 ? side > 0 : i < j;
    }
    bool operator()(std::uint32_t i, Vec2 p) const {
      return orientation((*edges)[i].a, (*edges)[i].b, p) > 0;
    }
    bool operator()(Vec2 p, std::uint32_t i) const {
      return orientation((*edges)[i].a, (*edges)[i].b, p) < 0;
    }
    /// Side of `s` on which `t`, which begins on the line later, lies: 1 above it.
    static int side_of(const Segment& s, const Segment& t) {
      const int begin = orientation(s.a, s.b, t.a);
      return begin != 0 ? begin : orientation(s.a, s.b, t.b);
    }
  };
  using Line = std::set<std::uint32_t, Below>;

  bool cross(std::uint32_t i, std::uint32_t j) const {
    const Segment &s = edges_[i], &t = edges_[j];
    return orientation(s.a, s.b, t.a) * orientation(s.a, s.b, t.b) < 0 &&
           orientation(t.a, t.b, s.a) * orientation(t.a, t.b, s.b) < 0;
  }

  bool are_collinear(std::uint32_t i, std::uint32_t j) const {
    const Segment &s = edges_[i], &t = edges_[j];
    return orientation(s.a, s.b, t.a) == 0 && orientation(s.a, s.b, t.b) == 0;
  }

  bool add_pair(std::uint32_t i, std::uint32_t j) {
    pairs_.emplace_back(std::min(i, j), std::max(i, j));
    return pairs_.size() <= max_pairs_;
  }

  /// Moves the line over a point at which edges end.
  bool pass(std::span<const End> ends) {
    const Vec2 p = ends.front().at;
    const auto [low, high] = met_.equal_range(p);
    through_.assign(low, high);
    if (!add_old_pairs(p)) return false;
    for (const std::uint32_t i : through_)
      if (edges_[i].b == p) met_.erase(i);
    if (!begin_edges(ends)) return false;
    return !any_cross(p);
  }

  /// Pairs of edges that come to the point. Those that lie on each other met before.
  bool add_old_pairs(Vec2 p) {
    const auto ends = [&](std::uint32_t i) { return edges_[i].b == p; };
    const auto passing = std::ranges::find_if_not(through_, ends);
    for (std::size_t k = 0; k < through_.size(); ++k) {
      const std::uint32_t i = through_[k];
      if (!ends(i) && !are_collinear(i, *passing)) return false;
      if (!ends(i)) continue;
      for (std::size_t m = 0; m < through_.size(); ++m) {
        const std::uint32_t j = through_[m];
        if (m == k || (m < k && ends(j)) || are_collinear(i, j)) continue;
        if (!add_pair(i, j)) return false;
      }
    }
    return true;
  }

  /// Pairs of edges that begin at the point with all that meet it.
  bool begin_edges(std::span<const End> ends) {
    for (const End& end : ends) {
      const Segment& e = edges_[end.edge];
      if (e.a != end.at) continue;
      for (const std::uint32_t other : through_)
        if (!add_pair(end.edge, other)) return false;
      through_.push_back(end.edge);
      if (e.a != e.b) met_.insert(end.edge);
    }
    return true;
  }

  /// Whether edges cross that are now beside each other.
  bool any_cross(Vec2 p) const {
    auto at = met_.lower_bound(p);
    if (at != met_.begin()) --at;
    for (; at != met_.end(); ++at) {
      const auto next = std::next(at);
      if (next == met_.end()) return false;
      if (cross(*at, *next)) return true;
      if (Below{&edges_}(p, *next)) return false;
    }
    return false;
  }

  std::vector<Segment> edges_;  ///< from left to right
  std::size_t max_pairs_;
  Line met_;
  std::vector<End> ends_;
  std::vector<std::uint32_t> through_;  ///< edges that meet the point
  std::vector<EdgePair> pairs_;
};

}  // namespace

std::optional<std::vector<EdgePair>> find_touching_edges(std::span<const Segment> edges,
                                                         std::size_t max_pairs) {
  EdgeSweep sweep(edges, max_pairs);
  if (!sweep.run()) return std::nullopt;
  return sweep.take_pairs();
}

}  // namespace microswarm
