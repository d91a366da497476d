// SPDX-License-Identifier: Apache-2.0
#include "microswarm/world/obstacles/obstacle.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "microswarm/core/fields/overloaded.hpp"
#include "microswarm/core/maths/angles.hpp"
#include "microswarm/core/maths/maths.hpp"
#include "microswarm/core/text/text.hpp"
#include "microswarm/world/obstacles/channel.hpp"

namespace microswarm {
namespace {

/// Sinusoidal oscillation between two bounds.
double swing(double least, double greatest, double period, double phase, double t) {
  const double turns = t / period + phase;
  const double angle = 2 * pi * (turns - std::floor(turns));
  return least + 0.5 * (greatest - least) * (1 + maths::sin(angle));
}
double top_rate(double least, double greatest, double period) {
  return std::abs(greatest - least) * pi / period;
}

void place(std::vector<Vec2>& ring, const Pose2& pose) {
  const Vec2 u = unit_vector(pose.heading);
  for (Vec2& v : ring) {
    v = pose.position + Vec2{u.x * v.x - u.y * v.y, u.y * v.x + u.x * v.y};
  }
}

void place(Polygon& polygon, const Pose2& pose) {
  place(polygon.outer, pose);
  for (auto& hole : polygon.holes) place(hole, pose);
}

std::vector<Vec2> box_ring(const Box& b) {
  return {b.lo, {b.hi.x, b.lo.y}, b.hi, {b.lo.x, b.hi.y}};
}

/// Creates the bodies of one shape at a pose.
class Builder {
 public:
  Builder(const Pose2& at, std::uint32_t obstacle, double t, std::vector<Body>& out)
      : at_(at), obstacle_(obstacle), t_(t), out_(out) {}

  void operator()(const DiscShape& shape) {
    out_.push_back({Disc{at_.position, shape.radius}, obstacle_});
  }
  void operator()(const BreathingDisc& shape) {
    const double radius = swing(shape.min_radius, shape.max_radius, shape.period, shape.phase, t_);
    out_.push_back({Disc{at_.position, radius}, obstacle_});
  }
  void operator()(const BoxShape& shape) {
    const Vec2 half{0.5 * shape.width, 0.5 * shape.height};
    add({box_ring({-half, half}), {}});
  }
  void operator()(const PolygonShape& shape) { add(normalised({shape.vertices, {}})); }
  void operator()(const Valve& shape) {
    const double outer = 0.5 * shape.span;
    const double inner = 0.5 * swing(shape.min_gap, shape.max_gap, shape.period, shape.phase, t_);
    if (inner >= outer) return;
    const double half = 0.5 * shape.thickness;
    add({box_ring({{-half, inner}, {half, outer}}), {}});
    add({box_ring({{-half, -outer}, {half, -inner}}), {}});
  }
  void operator()(const DeformingChannel& shape) { add(channel_block(shape, t_)); }

 private:
  void add(Polygon polygon) {
    if (polygon.outer.size() < 3) return;
    place(polygon, at_);
    out_.push_back({std::move(polygon), obstacle_});
  }

  const Pose2& at_;
  std::uint32_t obstacle_;
  double t_;
  std::vector<Body>& out_;
};

struct Extent {
  double operator()(const DiscShape& s) const { return s.radius; }
  double operator()(const BreathingDisc& s) const { return s.max_radius; }
  double operator()(const BoxShape& s) const { return 0.5 * norm({s.width, s.height}); }
  double operator()(const PolygonShape& s) const {
    double extent = 0;
    for (const Vec2 v : s.vertices) extent = std::max(extent, norm(v));
    return extent;
  }
  double operator()(const Valve& s) const { return 0.5 * norm({s.span, s.thickness}); }
  double operator()(const DeformingChannel& s) const {
    return norm(s.block_centre) + 0.5 * norm({s.block_width, s.block_height});
  }
};

struct OwnSpeed {
  double operator()(const BreathingDisc& s) const {
    return top_rate(s.min_radius, s.max_radius, s.period);
  }
  double operator()(const Valve& s) const { return 0.5 * top_rate(s.min_gap, s.max_gap, s.period); }
  double operator()(const DeformingChannel& s) const { return s.amplitude * 2 * pi / s.period; }
  double operator()(const OneOf<DiscShape, BoxShape, PolygonShape> auto&) const { return 0; }
};

Issues validate_order(double least, double greatest, const std::string& what) {
  Issues issues;
  const std::string low = "min_" + what, high = "max_" + what;
  if (least > greatest)
    issues.add({low, high}, low + " is " + number_text(least) + ", more than " + high + ", " +
                                number_text(greatest));
  return issues;
}

struct Validator {
  Issues operator()(const BreathingDisc& s) const {
    return validate_order(s.min_radius, s.max_radius, "radius_um");
  }
  Issues operator()(const Valve& s) const {
    Issues issues = validate_order(s.min_gap, s.max_gap, "gap_um");
    if (s.min_gap >= s.span)
      issues.add({"min_gap_um", "span_um"}, "min_gap_um is " + number_text(s.min_gap) +
                                                ", leaves no leaf in span_um, " +
                                                number_text(s.span));
    return issues;
  }
  Issues operator()(const PolygonShape& s) const {
    Issues issues;
    const Polygon ring = normalised({s.vertices, {}});
    if (ring.outer.size() < 3)
      issues.add("vertices_um", "vertices_um needs three different points at least");
    else if (signed_area(ring.outer) == 0)
      issues.add("vertices_um", "vertices_um has no area between its points");
    return issues;
  }
  Issues operator()(const DeformingChannel& s) const { return validate(s); }
  Issues operator()(const Waypoints& m) const {
    Issues issues;
    if (m.points.empty()) issues.add("points_um", "points_um is empty");
    return issues;
  }
  Issues operator()(const Track& m) const {
    Issues issues;
    if (!m.samples || m.samples->times.empty()) {
      issues.add("id", m.file + ": no samples of id '" + m.id + "'");
      return issues;
    }
    const auto& times = m.samples->times;
    const auto bad = std::ranges::adjacent_find(times, std::greater_equal{});
    if (bad != times.end())
      issues.add("id", m.file + ": times of id '" + m.id + "' do not ascend at " +
                           number_text(bad[1]) + " s");
    return issues;
  }
  Issues operator()(
      const OneOf<DiscShape, BoxShape, Still, Straight, HarmonicLine, HarmonicArc> auto&) const {
    return {};
  }
};

}  // namespace

void append_bodies(const Obstacle& obstacle, std::uint32_t index, double t,
                   std::vector<Body>& out) {
  const Placement at = placement(obstacle.motion, t);
  if (!at.present) return;
  std::visit(Builder(at.pose, index, t, out), obstacle.shape);
}

double top_speed(const Obstacle& obstacle) {
  const double turning = top_turning(obstacle.motion);
  return top_speed(obstacle.motion) + std::visit(OwnSpeed{}, obstacle.shape) +
         (turning > 0 ? turning * std::visit(Extent{}, obstacle.shape) : 0);
}

Issues validate(const Obstacle& obstacle) {
  Issues issues;
  issues.add_within("shape", std::visit(Validator{}, obstacle.shape));
  issues.add_within("motion", std::visit(Validator{}, obstacle.motion));
  return issues;
}

}  // namespace microswarm
