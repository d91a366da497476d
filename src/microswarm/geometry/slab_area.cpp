// SPDX-License-Identifier: Apache-2.0
#include "microswarm/geometry/slab_area.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "microswarm/core/maths/maths.hpp"
#include "microswarm/geometry/predicates.hpp"

namespace microswarm {
namespace {

/// Events off by this fraction of the size are harmless; a missing one is not.
constexpr double event_tolerance = 1e-9;

/// Height of the edge at x; never beyond its ends, despite rounding.
double height_at(const Segment& e, double x) {
  const double y = e.a.y + (x - e.a.x) * ((e.b.y - e.a.y) / (e.b.x - e.a.x));
  return std::clamp(y, std::min(e.a.y, e.b.y), std::max(e.a.y, e.b.y));
}

/// Boundary as a function y(x) on [first, last): a straight line, or the lower (bend −1) or upper
/// (bend +1) half of a circle.
struct Curve {
  double first;
  double last;
  Segment edge;
  Disc disc;
  int bend;
  /// Change of the obstacle's winding number when crossed upwards.
  int step;
  std::uint32_t obstacle;

  double y(double x) const {
    if (bend == 0) return height_at(edge, x);
    const double dx = x - disc.centre.x;
    const double squared = (disc.radius - dx) * (disc.radius + dx);
    return disc.centre.y + bend * std::sqrt(std::max(0.0, squared));
  }
  double integral(double from, double to) const {
    if (bend == 0) return y(0.5 * (from + to)) * (to - from);
    auto half_disc = [r = disc.radius](double u) {
      u = std::clamp(u, -r, r);
      const double half_chord = std::sqrt((r - u) * (r + u));
      return 0.5 * (u * half_chord + r * r * maths::atan2(u, half_chord));
    };
    const Vec2 c = disc.centre;
    return c.y * (to - from) + bend * (half_disc(to - c.x) - half_disc(from - c.x));
  }
};

bool near_overlap(double a0, double a1, double b0, double b1, double slack) {
  return std::min(a0, a1) <= std::max(b0, b1) + slack &&
         std::min(b0, b1) <= std::max(a0, a1) + slack;
}

class Slabs {
 public:
  Slabs(double radius, std::span<const NearObstacle> obstacles, std::pmr::memory_resource& memory)
      : radius_(radius),
        obstacles_(obstacles),
        events_(&memory),
        curves_(&memory),
        waiting_(&memory),
        active_(&memory),
        order_(&memory),
        level_edges_(&memory),
        windings_(obstacles.size(), 0, &memory) {}

  double area() {
    find_curves();
    find_level_edges();
    find_events();
    double sum = 0;
    for (std::size_t i = 1; i < events_.size(); ++i) sum += slab(events_[i - 1], events_[i]);
    return sum;
  }

 private:
  static constexpr std::uint32_t query = ~std::uint32_t{0};
  struct Crossed {
    double y;
    std::uint32_t curve;
  };

  void add_halves(Disc disc, std::uint32_t obstacle) {
    const double first = disc.centre.x - disc.radius;
    const double last = disc.centre.x + disc.radius;
    curves_.push_back({first, last, {}, disc, -1, 1, obstacle});
    curves_.push_back({first, last, {}, disc, 1, -1, obstacle});
  }

  void find_curves() {
    add_halves({{}, radius_}, query);
    for (std::uint32_t i = 0; i < obstacles_.size(); ++i) {
      if (obstacles_[i].is_disc) add_halves(obstacles_[i].disc, i);
      for (const Segment& e : obstacles_[i].edges) {
        if (e.a.x == e.b.x) continue;
        curves_.push_back(
            {std::min(e.a.x, e.b.x), std::max(e.a.x, e.b.x), e, {}, 0, e.b.x > e.a.x ? 1 : -1, i});
      }
    }
    waiting_.resize(curves_.size());
    std::iota(waiting_.begin(), waiting_.end(), 0u);
    std::ranges::sort(waiting_, {}, [&](std::uint32_t i) { return curves_[i].first; });
  }

  void add_event(Vec2 p) {
    if (squared_norm(p) <= radius_ * radius_ * (1 + event_tolerance) && std::abs(p.x) < radius_) {
      events_.push_back(p.x);
    }
  }

  void cross(const Segment& s, Disc disc) {
    const Vec2 along = s.b - s.a;
    const Vec2 from = s.a - disc.centre;
    const double length2 = squared_norm(along);
    const double height = microswarm::cross(from, along);
    const double chord2 = disc.radius * disc.radius * length2 - height * height;
    if (!(chord2 >= 0) || length2 == 0) return;
    for (const double half : {-std::sqrt(chord2), std::sqrt(chord2)}) {
      const double t = (half - dot(from, along)) / length2;
      if (t >= -event_tolerance && t <= 1 + event_tolerance) add_event(s.a + t * along);
    }
  }

  void cross(const Segment& s, const Segment& t) {
    const double slack = event_tolerance * radius_;
    if (!near_overlap(s.a.x, s.b.x, t.a.x, t.b.x, slack) ||
        !near_overlap(s.a.y, s.b.y, t.a.y, t.b.y, slack)) {
      return;
    }
    const Vec2 d = s.b - s.a;
    const Vec2 e = t.b - t.a;
    const double det = microswarm::cross(d, e);
    if (det == 0) return;
    const double u = microswarm::cross(t.a - s.a, e) / det;
    const double v = microswarm::cross(t.a - s.a, d) / det;
    if (std::abs(u - 0.5) <= 0.5 + event_tolerance && std::abs(v - 0.5) <= 0.5 + event_tolerance) {
      add_event(s.a + u * d);
    }
  }

  void cross(Disc a, Disc b) {
    const Vec2 d = b.centre - a.centre;
    const double distance2 = squared_norm(d);
    if (distance2 == 0) return;
    const double r2 = a.radius * a.radius;
    const double u = 0.5 * (1 + (r2 - b.radius * b.radius) / distance2);
    const double half2 = r2 / distance2 - u * u;
    if (!(half2 >= 0)) return;
    const Vec2 middle = a.centre + u * d;
    add_event(middle + std::sqrt(half2) * perpendicular(d));
    add_event(middle - std::sqrt(half2) * perpendicular(d));
  }

  void cross(const NearObstacle& a, const NearObstacle& b) {
    if (a.is_disc && b.is_disc) return cross(a.disc, b.disc);
    if (a.is_disc) return cross(b, a);
    for (const Segment& s : a.edges) {
      if (b.is_disc) cross(s, b.disc);
      for (const Segment& t : b.edges) cross(s, t);
    }
  }

  void find_events() {
    events_ = {-radius_, radius_};
    const Disc disc{{}, radius_};
    for (std::size_t i = 0; i < obstacles_.size(); ++i) {
      const NearObstacle& o = obstacles_[i];
      if (o.is_disc) {
        add_event(o.disc.centre - Vec2{o.disc.radius, 0});
        add_event(o.disc.centre + Vec2{o.disc.radius, 0});
        cross(disc, o.disc);
      }
      for (const Segment& e : o.edges) {
        add_event(e.a);
        add_event(e.b);
        cross(e, disc);
      }
      for (std::size_t j = 0; j < i; ++j) cross(o, obstacles_[j]);
    }
    std::sort(events_.begin(), events_.end());
    events_.erase(std::unique(events_.begin(), events_.end()), events_.end());
  }

  /// Edge that crosses the height of the centre.
  struct LevelEdge {
    Segment edge;
    std::uint32_t obstacle;
    bool centre_is_left;
  };

  void find_level_edges() {
    for (std::uint32_t i = 0; i < obstacles_.size(); ++i)
      for (const Segment& e : obstacles_[i].edges)
        if ((e.a.y <= 0) != (e.b.y <= 0))
          level_edges_.push_back({e, i, orientation_beside(e.a, e.b, {}) > 0});
  }

  /// Change of the winding number from the centre to just above (x, 0), from the same edge heights
  /// as `order_`.
  static int winding_change(const LevelEdge& level, double x) {
    const Segment& e = level.edge;
    const bool spans = (e.a.x <= x) != (e.b.x <= x);
    const bool is_left =
        spans ? (height_at(e, x) <= 0) == (e.b.x > e.a.x) : (x < e.a.x) == (e.b.y > e.a.y);
    return is_left - level.centre_is_left;
  }

  /// Slabs come from left to right: curves wait, are active and are gone.
  void sort_curves(double x) {
    for (; next_ < waiting_.size() && curves_[waiting_[next_]].first <= x; ++next_)
      active_.push_back(waiting_[next_]);
    std::erase_if(active_, [&](std::uint32_t i) { return x >= curves_[i].last; });
    order_.clear();
    for (const std::uint32_t i : active_) order_.push_back({curves_[i].y(x), i});
    std::sort(order_.begin(), order_.end(), [](const Crossed& a, const Crossed& b) {
      return std::pair(a.y, a.curve) < std::pair(b.y, b.curve);
    });
  }

  /// Sets the winding numbers below all curves of `order_`.
  void start_windings(double x) {
    for (std::size_t i = 0; i < obstacles_.size(); ++i)
      windings_[i] = obstacles_[i].is_disc ? 0 : obstacles_[i].winding;
    for (const LevelEdge& level : level_edges_)
      windings_[level.obstacle] += winding_change(level, x);
    for (const Crossed& c : order_) {
      const Curve& curve = curves_[c.curve];
      if (c.y <= 0 && curve.bend == 0) windings_[curve.obstacle] -= curve.step;
    }
  }

  double slab(double from, double to) {
    const double x = 0.5 * (from + to);
    sort_curves(x);
    start_windings(x);
    auto holds = [](int winding) { return winding != 0; };
    auto depth = std::count_if(windings_.begin(), windings_.end(), holds);
    bool in_query = false;
    double sum = 0;
    for (const Crossed& c : order_) {
      const Curve& curve = curves_[c.curve];
      const bool was_covered = in_query && depth > 0;
      if (curve.obstacle == query) {
        in_query = !in_query;
      } else {
        int& winding = windings_[curve.obstacle];
        depth -= holds(winding);
        winding += curve.step;
        depth += holds(winding);
      }
      const bool is_covered = in_query && depth > 0;
      if (is_covered != was_covered) sum += (is_covered ? -1 : 1) * curve.integral(from, to);
    }
    return sum;
  }

  double radius_;
  std::span<const NearObstacle> obstacles_;
  std::pmr::vector<double> events_;
  std::pmr::vector<Curve> curves_;
  std::pmr::vector<std::uint32_t> waiting_;  ///< curves by where they begin
  std::size_t next_ = 0;                     ///< of them
  std::pmr::vector<std::uint32_t> active_;   ///< in the present slab
  std::pmr::vector<Crossed> order_;
  std::pmr::vector<LevelEdge> level_edges_;
  std::pmr::vector<int> windings_;
};

}  // namespace

double slab_area(double radius, std::span<const NearObstacle> obstacles,
                 std::pmr::memory_resource& memory) {
  return Slabs(radius, obstacles, memory).area();
}

}  // namespace microswarm
