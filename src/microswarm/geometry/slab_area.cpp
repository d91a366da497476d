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
  Slabs(double radius, std::span<const NearObstacle> obstacles, std::pmr::memory_resource& memory,
        const Stop& stop)
      : radius_(radius),
        obstacles_(obstacles),
        stop_(stop),
        events_(&memory),
        pieces_(&memory),
        near_(&memory),
        polygons_(&memory),
        curves_(&memory),
        waiting_(&memory),
        order_(&memory),
        level_edges_(&memory),
        windings_(obstacles.size(), 0, &memory) {}

  double area() {
    find_curves();
    find_level_edges();
    find_events();
    double sum = 0;
    for (std::size_t i = 1; i < events_.size(); ++i) {
      if (stop_()) return 0;
      sum += slab(events_[i - 1], events_[i]);
    }
    return sum;
  }

 private:
  static constexpr std::uint32_t query = ~std::uint32_t{0};
  struct Crossed {
    double y;
    std::uint32_t curve;
  };

  /// A disc, or an edge of a polygon, between two x.
  struct Piece {
    double left;
    double right;
    std::uint32_t obstacle;
    const Segment* edge;  ///< null for a disc
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
      if (obstacles_[i].is_disc)
        add_halves(obstacles_[i].disc, i);
      else
        polygons_.push_back(i);
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

  void cross(const Piece& a, const Piece& b) {
    if (!a.edge && !b.edge) return cross(obstacles_[a.obstacle].disc, obstacles_[b.obstacle].disc);
    if (!a.edge) return cross(*b.edge, obstacles_[a.obstacle].disc);
    if (!b.edge) return cross(*a.edge, obstacles_[b.obstacle].disc);
    cross(*a.edge, *b.edge);
  }

  void add_piece(double left, double right, std::uint32_t obstacle, const Segment* edge) {
    const double slack = 2 * event_tolerance * (radius_ + right - left);
    pieces_.push_back({left - slack, right + slack, obstacle, edge});
  }

  void find_pieces() {
    for (std::uint32_t i = 0; i < obstacles_.size(); ++i) {
      const NearObstacle& o = obstacles_[i];
      if (o.is_disc)
        add_piece(o.disc.centre.x - o.disc.radius, o.disc.centre.x + o.disc.radius, i, nullptr);
      for (const Segment& e : o.edges)
        add_piece(std::min(e.a.x, e.b.x), std::max(e.a.x, e.b.x), i, &e);
    }
    std::ranges::stable_sort(pieces_, {}, &Piece::left);
  }

  /// Crosses what overlaps from left to right.
  void cross_pieces() {
    for (std::uint32_t i = 0; i < pieces_.size(); ++i) {
      if (stop_()) return;
      const Piece& piece = pieces_[i];
      std::erase_if(near_, [&](std::uint32_t k) { return pieces_[k].right < piece.left; });
      for (const std::uint32_t k : near_) {
        const Piece& other = pieces_[k];
        if (piece.obstacle > other.obstacle) cross(piece, other);
        if (piece.obstacle < other.obstacle) cross(other, piece);
      }
      near_.push_back(i);
    }
  }

  void find_events() {
    events_ = {-radius_, radius_};
    const Disc disc{{}, radius_};
    for (const NearObstacle& o : obstacles_) {
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
    }
    find_pieces();
    cross_pieces();
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

  /// Slabs come from left to right: curves wait, are in order and are gone. From one slab to the
  /// next the order hardly changes.
  void sort_curves(double x) {
    std::erase_if(order_, [&](const Crossed& c) { return x >= curves_[c.curve].last; });
    for (Crossed& c : order_) c.y = curves_[c.curve].y(x);
    for (; next_ < waiting_.size() && curves_[waiting_[next_]].first <= x; ++next_)
      if (const Curve& curve = curves_[waiting_[next_]]; x < curve.last)
        order_.push_back({curve.y(x), waiting_[next_]});
    const auto is_below = [](const Crossed& a, const Crossed& b) {
      return std::pair(a.y, a.curve) < std::pair(b.y, b.curve);
    };
    for (std::size_t i = 1; i < order_.size(); ++i) {
      const Crossed moved = order_[i];
      std::size_t k = i;
      for (; k > 0 && is_below(moved, order_[k - 1]); --k) order_[k] = order_[k - 1];
      order_[k] = moved;
    }
  }

  /// Sets the winding numbers below all curves of `order_`; those of discs are 0 again.
  void start_windings(double x) {
    for (const std::uint32_t i : polygons_) windings_[i] = obstacles_[i].winding;
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
    auto depth =
        std::ranges::count_if(polygons_, [&](std::uint32_t i) { return holds(windings_[i]); });
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
  const Stop& stop_;
  std::pmr::vector<double> events_;
  std::pmr::vector<Piece> pieces_;        ///< by where they begin
  std::pmr::vector<std::uint32_t> near_;  ///< of these, at the current x
  std::pmr::vector<std::uint32_t> polygons_;
  std::pmr::vector<Curve> curves_;
  std::pmr::vector<std::uint32_t> waiting_;  ///< curves by where they begin
  std::size_t next_ = 0;                     ///< of them
  std::pmr::vector<Crossed> order_;          ///< in the current slab, upwards
  std::pmr::vector<LevelEdge> level_edges_;
  std::pmr::vector<int> windings_;
};

}  // namespace

double slab_area(double radius, std::span<const NearObstacle> obstacles,
                 std::pmr::memory_resource& memory, const Stop& stop) {
  return Slabs(radius, obstacles, memory, stop).area();
}

}  // namespace microswarm
