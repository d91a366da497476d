// SPDX-License-Identifier: Apache-2.0
#include "microswarm/geometry/arc_area.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "microswarm/core/maths/angles.hpp"
#include "microswarm/core/maths/maths.hpp"
#include "microswarm/geometry/predicates.hpp"

namespace microswarm {
namespace {

constexpr std::size_t first_union = 16;  // of covered angles, then after twice as many
constexpr double within = 0.382;         // of an arc, where shapes of a lattice do not touch it

/// Covered part of an edge (shares of it) or of a circle [rad].
struct Interval {
  double from;
  double to;
};

/// Crossing points of two circles. Counter-clockwise from `first` to `last`, circle a is within b;
/// from `last` to `first`, b is within a.
struct CirclesCross {
  Vec2 first;
  Vec2 last;
};

CirclesCross cross_circles(const Disc& a, const Disc& b) {
  const Vec2 offset = b.centre - a.centre;
  const double distance2 = squared_norm(offset);
  const double share = 0.5 * (1 + (a.radius - b.radius) * (a.radius + b.radius) / distance2);
  const double half2 = a.radius * a.radius / distance2 - share * share;
  const Vec2 middle = a.centre + share * offset;
  const Vec2 half = std::sqrt(std::max(0.0, half2)) * perpendicular(offset);
  return {middle - half, middle + half};
}

/// Sums ∮ (x dy − y dx) along the boundary of the union, cut at the query circle: twice its area.
class ArcSum {
 public:
  ArcSum(double radius, std::span<const Segment> edges, int winding, std::span<const Disc> discs,
         std::pmr::memory_resource& memory, const Stop& stop)
      : query_{{}, radius},
        edges_(edges),
        winding_(winding),
        stop_(stop),
        discs_(&memory),
        covered_(&memory),
        crossings_(&memory) {
    discs_.reserve(discs.size());
    for (const Disc& disc : discs)
      if (norm(disc.centre) < radius + disc.radius) discs_.push_back(disc);
    std::ranges::stable_sort(discs_, {}, [](const Disc& disc) { return disc.centre.x; });
    for (const Disc& disc : discs_) reach_ = std::max(reach_, disc.radius);
  }

  double area() {
    const double all = pi * query_.radius * query_.radius;
    for (const Disc& disc : discs_)
      if (norm(disc.centre) + query_.radius <= disc.radius) return all;
    for (const Segment& edge : edges_) {
      if (stop_()) return 0;
      add_edge(edge);
    }
    std::ranges::stable_sort(crossings_, {}, &Crossing::circle);
    for (std::uint32_t i = 0; i < discs_.size(); ++i) {
      if (stop_()) return 0;
      add_circle(i);
    }
    add_query();
    return std::clamp(0.5 * twice_, 0.0, all);
  }

 private:
  static constexpr std::uint32_t query = ~std::uint32_t{0};
  /// Crossing of an edge and a circle, with the change of the polygons' winding number there,
  /// counter-clockwise.
  struct Crossing {
    std::uint32_t circle;
    Vec2 at;
    int step;
    double angle = 0;  ///< on the circle, from where it begins
  };
  enum class Met { apart, hidden, crossing };

  // Whether an end is in a disc decides about crossings, so that edges that share it agree.
  bool cut(const Segment& edge, const Disc& disc, std::uint32_t circle, Interval& inside) {
    const Vec2 along = edge.b - edge.a;
    const Vec2 a = edge.a - disc.centre;
    const double r2 = disc.radius * disc.radius;
    const double length2 = squared_norm(along);
    const double height = cross(a, along);
    const double chord2 = r2 * length2 - height * height;
    const double middle = -dot(a, along);
    const bool begins = squared_norm(a) < r2;
    const bool ends = squared_norm(edge.b - disc.centre) < r2;
    if (!begins && !ends && !(chord2 > 0 && middle > 0 && middle < length2)) return false;
    const double half = std::sqrt(std::max(0.0, chord2));
    inside = {0, 1};
    if (!begins) {
      inside.from = std::clamp((middle - half) / length2, 0.0, 1.0);
      crossings_.push_back({circle, edge.a + inside.from * along, -1});
    }
    if (!ends) {
      inside.to = std::clamp((middle + half) / length2, 0.0, 1.0);
      crossings_.push_back({circle, edge.a + inside.to * along, 1});
    }
    return true;
  }

  void add_edge(const Segment& edge) {
    Interval seen;
    if (!cut(edge, query_, query, seen)) return;
    covered_.clear();
    const auto [left, right] = std::minmax(edge.a.x, edge.b.x);
    const auto first = std::ranges::lower_bound(discs_, left - reach_, {},
                                                [](const Disc& disc) { return disc.centre.x; });
    for (auto disc = first; disc != discs_.end() && disc->centre.x <= right + reach_; ++disc) {
      Interval inside;
      if (cut(edge, *disc, static_cast<std::uint32_t>(disc - discs_.begin()), inside))
        covered_.push_back(inside);
    }
    const Vec2 along = edge.b - edge.a;
    unite();
    for_each_gap(seen.from, seen.to, [&](double from, double to) {
      twice_ += cross(edge.a + from * along, edge.a + to * along);
    });
  }

  void unite() {
    std::ranges::sort(covered_, {}, &Interval::from);
    std::size_t last = 0;
    for (std::size_t i = 1; i < covered_.size(); ++i) {
      if (covered_[i].from <= covered_[last].to)
        covered_[last].to = std::max(covered_[last].to, covered_[i].to);
      else
        covered_[++last] = covered_[i];
    }
    if (!covered_.empty()) covered_.resize(last + 1);
  }
  bool is_all_covered() const {
    return covered_.size() == 1 && covered_[0].from <= -pi && covered_[0].to >= pi;
  }

  /// Visits what of [from, to] no interval covers, after `unite`.
  template <class Visit>
  void for_each_gap(double from, double to, Visit&& visit) const {
    for (const Interval& c : covered_) {
      if (c.from >= to) break;
      if (c.from > from) visit(from, c.from);
      from = std::max(from, c.to);
    }
    if (from < to) visit(from, to);
  }

  /// Covers the angles of a circle counter-clockwise from p to q, which are `less` or more than
  /// half of it.
  void cover(const Disc& disc, double begin, Vec2 p, Vec2 q, bool less) {
    const double from = wrap(heading_along(p - disc.centre) - begin);
    double length = wrap(heading_along(q - disc.centre) - begin) - from;
    if (length < 0) length += 2 * pi;
    if (less && length > 1.5 * pi) return;  // p and q nearly coincide
    if (!less && length < 0.5 * pi) length = 2 * pi;
    if (length >= 2 * pi) return cover_all();
    const double to = from + length;
    covered_.push_back({from, std::min(to, pi)});
    if (to > pi) covered_.push_back({-pi, to - 2 * pi});
  }
  void cover_all() { covered_.assign(1, {-pi, pi}); }

  /// Covers the part of circle i in disc k.
  Met cover_by(std::uint32_t i, std::uint32_t k, double begin) {
    const Disc& disc = discs_[i];
    const Disc& other = discs_[k];
    const double distance2 = squared_norm(other.centre - disc.centre);
    const double both = disc.radius + other.radius;
    const double more = other.radius - disc.radius;
    if (distance2 >= both * both) return Met::apart;
    if (distance2 <= more * more)  // equal discs count once
      return more > 0 || (more == 0 && k < i) ? Met::hidden : Met::apart;
    const bool less = distance2 > more * both;
    const CirclesCross at = i < k ? cross_circles(disc, other) : cross_circles(other, disc);
    if (i < k)
      cover(disc, begin, at.first, at.last, less);
    else
      cover(disc, begin, at.last, at.first, less);
    return Met::crossing;
  }

  /// Covers what other discs cover, the nearest of them first; false if that is all.
  bool cover_by_discs(std::uint32_t i, double begin) {
    const double reach = discs_[i].radius + reach_;
    const double x = discs_[i].centre.x;
    std::size_t left = i;
    std::size_t right = i + 1;
    std::size_t next_union = covered_.size() + first_union;
    for (;;) {
      const double to_left = left > 0 ? x - discs_[left - 1].centre.x : reach;
      const double to_right = right < discs_.size() ? discs_[right].centre.x - x : reach;
      if (std::min(to_left, to_right) >= reach) break;
      const std::size_t k = to_left < to_right ? --left : right++;
      const Met met = cover_by(i, static_cast<std::uint32_t>(k), begin);
      if (met == Met::hidden) return false;
      if (met == Met::apart || covered_.size() < next_union) continue;
      unite();
      if (is_all_covered()) return false;
      next_union = std::max(2 * covered_.size(), first_union);
    }
    unite();
    return !is_all_covered();
  }

  int winding_at(Vec2 p) const {
    int winding = winding_;
    for (const Segment& e : edges_) winding += winding_along(e.a, e.b, {}, p);
    return winding;
  }

  /// Covers what the polygons cover of [from, to] of a circle, beginning in its longest piece
  /// without a crossing, where rounding cannot decide.
  void cover_by_polygons(const Disc& disc, std::uint32_t circle, double begin, double from,
                         double to) {
    if (edges_.empty()) {
      if (winding_ != 0) cover_all();
      return;
    }
    const auto first = std::ranges::lower_bound(crossings_, circle, {}, &Crossing::circle);
    const auto last = std::ranges::upper_bound(crossings_, circle, {}, &Crossing::circle);
    const std::span<Crossing> met(first, last);
    for (Crossing& c : met)
      c.angle = std::clamp(wrap(heading_along(c.at - disc.centre) - begin), from, to);
    std::ranges::stable_sort(met, {}, &Crossing::angle);
    const auto arc_start = [&](std::size_t i) { return i == 0 ? from : met[i - 1].angle; };
    const auto arc_end = [&](std::size_t i) { return i == met.size() ? to : met[i].angle; };
    std::size_t longest = 0;
    for (std::size_t i = 1; i <= met.size(); ++i)
      if (arc_end(i) - arc_start(i) > arc_end(longest) - arc_start(longest)) longest = i;
    const double inner = arc_start(longest) + within * (arc_end(longest) - arc_start(longest));
    const int known = winding_at(disc.centre + disc.radius * unit_vector(wrap(begin + inner)));
    const auto note = [&](std::size_t i, int winding) {
      if (winding != 0) covered_.push_back({arc_start(i), arc_end(i)});
    };
    note(longest, known);
    int winding = known;
    for (std::size_t i = longest; i < met.size(); ++i) note(i + 1, winding += met[i].step);
    winding = known;
    for (std::size_t i = longest; i > 0; --i) note(i - 1, winding -= met[i - 1].step);
  }

  /// Angles of a circle are counted from where it is nearest to the query's centre.
  void add_circle(std::uint32_t i) {
    const Disc& disc = discs_[i];
    const double d = norm(disc.centre);
    const double begin = d > 0 ? heading_along(-disc.centre) : 0;
    covered_.clear();
    double from = -pi;
    double to = pi;
    if (d + disc.radius > query_.radius) {
      const CirclesCross at = cross_circles(query_, disc);
      from = -std::abs(wrap(heading_along(at.last - disc.centre) - begin));
      to = std::abs(wrap(heading_along(at.first - disc.centre) - begin));
      covered_ = {{-pi, from}, {to, pi}};
    }
    if (!cover_by_discs(i, begin)) return;
    cover_by_polygons(disc, i, begin, from, to);
    unite();
    for_each_gap(from, to, [&](double a, double b) {
      const Vec2 chord = unit_vector(wrap(begin + b)) - unit_vector(wrap(begin + a));
      twice_ += disc.radius * (disc.radius * (b - a) + cross(disc.centre, chord));
    });
  }

  void add_query() {
    covered_.clear();
    for (const Disc& disc : discs_) {
      const double d = norm(disc.centre);
      if (d + disc.radius <= query_.radius) continue;
      const CirclesCross at = cross_circles(query_, disc);
      const bool less = d * d > (disc.radius - query_.radius) * (disc.radius + query_.radius);
      cover(query_, 0, at.first, at.last, less);
    }
    cover_by_polygons(query_, query, 0, -pi, pi);
    unite();
    double covered = 0;
    for (const Interval& c : covered_) covered += c.to - c.from;
    twice_ += query_.radius * query_.radius * covered;
  }

  Disc query_;
  std::span<const Segment> edges_;
  int winding_;
  const Stop& stop_;
  std::pmr::vector<Disc> discs_;  ///< from left to right
  double reach_ = 0;              ///< the greatest of their radii
  std::pmr::vector<Interval> covered_;
  std::pmr::vector<Crossing> crossings_;
  double twice_ = 0;
};

}  // namespace

double arc_area(double radius, std::span<const Segment> edges, int winding,
                std::span<const Disc> discs, std::pmr::memory_resource& memory, const Stop& stop) {
  return ArcSum(radius, edges, winding, discs, memory, stop).area();
}

}  // namespace microswarm
