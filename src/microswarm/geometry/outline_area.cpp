// SPDX-License-Identifier: Apache-2.0
#include "microswarm/geometry/outline_area.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "microswarm/core/maths/angles.hpp"
#include "microswarm/core/maths/maths.hpp"
#include "microswarm/geometry/distance.hpp"
#include "microswarm/geometry/predicates.hpp"

namespace microswarm {
namespace {

/// Outlines nearer to the origin than this fraction of the query's radius are left to others.
constexpr double too_central = 1e-4;
/// Crossings nearer than this fraction of a disc's radius to where its outline begins, and discs of
/// this relative distance, likewise.
constexpr double too_near = 1e-7;

double angle_seen(Vec2 p, Vec2 q) { return maths::atan2(cross(p, q), dot(p, q)); }

/// Sums over the outline, counter-clockwise around the union. With t the parts of outlines in the
/// query disc, twice the area is Σ (cross products − r² · angles seen from the origin) over t, plus
/// 2 π r² if the origin is covered (see `area_of_edge`). An arc is its chord and a circular
/// segment.
class Outline {
 public:
  Outline(double radius, std::span<const Segment> edges, int winding, std::span<const Disc> discs,
          std::pmr::memory_resource& memory)
      : radius_(radius),
        edges_(edges),
        winding_(winding),
        discs_(&memory),
        covers_(&memory),
        crossings_(&memory),
        events_(&memory) {
    discs_.reserve(discs.size());
    for (const Disc& disc : discs)
      if (norm(disc.centre) < radius + disc.radius) discs_.push_back(disc);
  }

  std::optional<double> area() {
    bool is_covered = winding_ != 0;
    for (const Disc& disc : discs_) {
      const double d = norm(disc.centre);
      if (d + radius_ <= disc.radius) return pi * radius_ * radius_;
      if (std::abs(d - disc.radius) < too_central * radius_) return std::nullopt;
      is_covered = is_covered || d < disc.radius;
    }
    for (const Segment& edge : edges_)
      if (!add_edge(edge)) return std::nullopt;
    for (std::uint32_t i = 0; i < discs_.size(); ++i)
      if (!add_disc(i)) return std::nullopt;
    const double squared = radius_ * radius_;
    const double twice = sum_ + squared * ((is_covered ? 2 * pi : 0) - angles_);
    return std::clamp(0.5 * twice, 0.0, pi * squared);
  }

 private:
  /// Part of an edge, as shares of it, that a disc covers.
  struct Cover {
    double from;
    double to;
  };
  /// Crossing of an edge and a disc's outline, with the change of the polygons' winding number
  /// there, counter-clockwise.
  struct Crossing {
    std::uint32_t disc;
    Vec2 at;
    int step;
  };
  /// Change of the number of obstacles along a disc's outline.
  struct Event {
    double along;  ///< of the disc's centre, towards where the outline begins
    bool is_left;  ///< of the line from the centre to there
    Vec2 at;
    int step;
  };

  void add_chord(Vec2 p, Vec2 q) {
    sum_ += cross(p, q);
    angles_ += angle_seen(p, q);
  }

  bool add_edge(const Segment& edge) {
    const Vec2 along = edge.b - edge.a;
    const double length2 = squared_norm(along);
    const double height = cross(edge.a, along);
    const double chord2 = radius_ * radius_ * length2 - height * height;
    if (!(chord2 > 0)) return true;
    const double least = too_central * radius_;
    if (squared_distance(Vec2{}, edge) < least * least) return false;
    const double half = std::sqrt(chord2);
    const double middle = -dot(edge.a, along);
    double from = std::max((middle - half) / length2, 0.0);
    const double to = std::min((middle + half) / length2, 1.0);
    if (!(from < to)) return true;
    find_covers(edge);
    for (const Cover& cover : covers_) {
      if (cover.from >= to) break;
      if (cover.from > from) add_chord(edge.a + from * along, edge.a + cover.from * along);
      from = std::max(from, cover.to);
    }
    if (from < to) add_chord(edge.a + from * along, edge.a + to * along);
    return true;
  }

  /// Whether an end is in a disc decides about crossings, so that edges that share it agree.
  void find_covers(const Segment& edge) {
    covers_.clear();
    const Vec2 along = edge.b - edge.a;
    const double length2 = squared_norm(along);
    for (std::uint32_t i = 0; i < discs_.size(); ++i) {
      const Vec2 a = edge.a - discs_[i].centre;
      const Vec2 b = edge.b - discs_[i].centre;
      const double r2 = discs_[i].radius * discs_[i].radius;
      const double height = cross(a, along);
      const double chord2 = r2 * length2 - height * height;
      const double middle = -dot(a, along);
      const bool begins_inside = squared_norm(a) < r2;
      const bool ends_inside = squared_norm(b) < r2;
      if (!begins_inside && !ends_inside && !(chord2 > 0 && middle > 0 && middle < length2))
        continue;
      const double half = std::sqrt(std::max(0.0, chord2));
      Cover cover{0, 1};
      if (!begins_inside) {
        cover.from = std::clamp((middle - half) / length2, 0.0, 1.0);
        crossings_.push_back({i, edge.a + cover.from * along, -1});
      }
      if (!ends_inside) {
        cover.to = std::clamp((middle + half) / length2, 0.0, 1.0);
        crossings_.push_back({i, edge.a + cover.to * along, 1});
      }
      covers_.push_back(cover);
    }
    std::sort(covers_.begin(), covers_.end(),
              [](const Cover& a, const Cover& b) { return a.from < b.from; });
  }

  /// Whether an edge passes p within `reach`.
  bool is_near_edge(Vec2 p, double reach) const {
    return std::any_of(edges_.begin(), edges_.end(), [&](const Segment& e) {
      return std::min(e.a.x, e.b.x) <= p.x + reach && std::max(e.a.x, e.b.x) >= p.x - reach &&
             std::min(e.a.y, e.b.y) <= p.y + reach && std::max(e.a.y, e.b.y) >= p.y - reach &&
             squared_distance(p, e) <= reach * reach;
    });
  }

  int winding_at(Vec2 p) const {
    int winding = winding_;
    for (const Segment& e : edges_) winding += winding_along(e.a, e.b, {}, p);
    return winding;
  }

  /// The outline of a disc begins where it is nearest to the origin, in the query disc, and is
  /// followed both ways to its end or to where it leaves the query disc.
  bool add_disc(std::uint32_t number) {
    const Disc& disc = discs_[number];
    const double d = norm(disc.centre);
    const Vec2 towards = d > 0 ? (-1 / d) * disc.centre : Vec2{1, 0};
    const Vec2 begin = disc.radius * towards;
    events_.clear();
    int depth = 0;
    for (std::uint32_t i = 0; i < discs_.size(); ++i) {
      if (i == number) continue;
      const Vec2 offset = discs_[i].centre - disc.centre;
      const double distance2 = squared_norm(offset);
      const double other = discs_[i].radius;
      const double both = disc.radius + other;
      if (distance2 >= both * both) continue;
      const double less = other - disc.radius;
      if (distance2 <= less * less) {
        // It contains this disc, or is the same one, which counts once.
        if (less > 0 || (less == 0 && i < number)) return true;
        continue;
      }
      if (distance2 < too_near * too_near * disc.radius * disc.radius) return false;
      Vec2 first, last;
      if (!(i < number ? cross_discs(discs_[i], disc, last, first)
                       : cross_discs(disc, discs_[i], first, last))) {
        return false;
      }
      if (!add_event(first, 1, disc, towards) || !add_event(last, -1, disc, towards)) return false;
      const double beyond = squared_norm(begin - offset) - other * other;
      if (std::abs(beyond) < too_near * other * other) return false;
      depth += beyond < 0;
    }
    for (const Crossing& c : crossings_)
      if (c.disc == number && !add_event(c.at, c.step, disc, towards)) return false;
    if (is_near_edge(disc.centre + begin, too_near * disc.radius)) return false;
    depth += winding_at(disc.centre + begin);
    std::sort(events_.begin(), events_.end(),
              [](const Event& a, const Event& b) { return a.along > b.along; });
    for (const int side : {1, -1}) follow(disc, towards, side, depth);
    return true;
  }

  /// The part of a's outline in b, counter-clockwise from `first` to `last`.
  static bool cross_discs(const Disc& a, const Disc& b, Vec2& first, Vec2& last) {
    const Vec2 offset = b.centre - a.centre;
    const double distance2 = squared_norm(offset);
    if (distance2 < too_near * too_near * a.radius * a.radius) return false;
    const double share = 0.5 * (1 + (a.radius - b.radius) * (a.radius + b.radius) / distance2);
    const double half2 = a.radius * a.radius / distance2 - share * share;
    if (!(half2 > too_near * too_near)) return false;
    const Vec2 middle = a.centre + share * offset;
    const Vec2 half = std::sqrt(half2) * perpendicular(offset);
    first = middle - half;
    last = middle + half;
    return true;
  }

  bool add_event(Vec2 at, int step, const Disc& disc, Vec2 towards) {
    const double along = dot(at - disc.centre, towards);
    const double across = cross(towards, at - disc.centre);
    if (along > 0 && std::abs(across) < too_near * disc.radius) return false;
    events_.push_back({along, across >= 0, at, step});
    return true;
  }

  /// Follows half of the outline, counter-clockwise (side 1) or clockwise (−1).
  void follow(const Disc& disc, Vec2 towards, int side, int depth) {
    const double d = norm(disc.centre);
    const double r = disc.radius;
    double last = -r;
    if (d + r > radius_)
      last = std::clamp((d * d + (r - radius_) * (r + radius_)) / (2 * d), -r, r);
    const Vec2 across = std::sqrt((r - last) * (r + last)) * perpendicular(towards);
    Vec2 from = disc.centre + r * towards;
    const auto pass = [&](Vec2 to) {
      if (depth == 0) side > 0 ? add_arc(disc, from, to) : add_arc(disc, to, from);
    };
    for (const Event& event : events_) {
      if (event.along <= last) break;
      if (event.is_left != (side > 0)) continue;
      pass(event.at);
      depth += side * event.step;
      from = event.at;
    }
    pass(disc.centre + last * towards + side * across);
  }

  /// Adds the arc from p to q of at most half a turn.
  void add_arc(const Disc& disc, Vec2 p, Vec2 q) {
    const Vec2 a = p - disc.centre;
    const Vec2 b = q - disc.centre;
    const double angle = angle_seen(p, q);
    sum_ += disc.radius * disc.radius * std::abs(angle_seen(a, b)) - std::abs(cross(a, b)) +
            cross(p, q);
    angles_ += angle;
    // If the origin is between chord and arc, the arc passes it on the other side. From there the
    // chord of at most half a turn looks wider than a right angle.
    const bool is_around = squared_norm(disc.centre) < disc.radius * disc.radius;
    if (is_around && angle < -0.5 * pi) angles_ += 2 * pi;
  }

  double radius_;
  std::span<const Segment> edges_;
  int winding_;
  std::pmr::vector<Disc> discs_;
  std::pmr::vector<Cover> covers_;
  std::pmr::vector<Crossing> crossings_;
  std::pmr::vector<Event> events_;
  double sum_ = 0;
  double angles_ = 0;
};

}  // namespace

std::optional<double> outline_area(double radius, std::span<const Segment> edges, int winding,
                                   std::span<const Disc> discs, std::pmr::memory_resource& memory) {
  return Outline(radius, edges, winding, discs, memory).area();
}

}  // namespace microswarm
