// SPDX-License-Identifier: Apache-2.0
#include "microswarm/planning/exact/turning_circle.hpp"

#include <algorithm>
#include <cmath>

#include "microswarm/core/maths/angles.hpp"

namespace microswarm::planning {
namespace {

/// The angle in [0, 2π).
double positive(double angle) {
  while (angle < 0) angle += 2 * pi;
  while (angle >= 2 * pi) angle -= 2 * pi;
  return angle;
}

/// Angle [rad] by which the tangent of a circle from a point may miss the cone of its corner. Along
/// the corner's face the circle reaches further than the clearance, by less than the margin, and a
/// point with the clearance is nearer to the face: its tangent rises from there.
double cone_slack(const TurningCircle& circle, const TurningCircle& point, double length,
                  double margin) {
  constexpr double most = 0.01;
  if (point.radius > 0) return angle_slack;
  // The angle φ of length · φ + radius · φ² / 2 = margin.
  const double angle =
      2 * margin / (length + std::sqrt(length * length + 2 * circle.radius * margin));
  return angle_slack + std::min(most, angle);
}

/// Cuts a circle where its distance to a wall, a body or the border equals the clearance.
class ArcCutter {
 public:
  /// `keep` [µm] is the distance at which it cuts.
  ArcCutter(const TurningCircle& circle, double keep) : circle_(circle), keep_(keep) {}

  void cut_by(const BodySet& bodies, const Box& box) {
    bodies.polygons().for_each_edge_in(box, [&](std::uint32_t, const Segment& edge) {
      const double length = distance(edge.a, edge.b);
      if (length == 0) return;
      const Vec2 u = (edge.b - edge.a) / length;
      cut_by_line(edge.a, u, keep_);
      cut_by_line(edge.a, u, -keep_);
      if (edge.a != circle_.centre) cut_by_circle(edge.a, keep_);
    });
    bodies.discs().for_each_in(box, [&](std::size_t i) {
      const Disc disc = bodies.discs().disc(i);
      if (disc.centre != circle_.centre) cut_by_circle(disc.centre, disc.radius + keep_);
    });
  }
  void cut_by_border(const Box& border) {
    for (const double x : {border.lo.x + keep_, border.hi.x - keep_})
      cut_by_line({x, 0}, {0, 1}, 0);
    for (const double y : {border.lo.y + keep_, border.hi.y - keep_})
      cut_by_line({0, y}, {1, 0}, 0);
  }

  /// Adds the pieces whose middle is free, neighbours as one.
  template <class IsFree>
  void add_free(IsFree&& is_free, std::vector<Arc>& arcs) {
    std::ranges::sort(cuts_);
    const std::size_t first = arcs.size();
    for (std::size_t i = 0; i + 1 < cuts_.size(); ++i) {
      const double middle = circle_.from + 0.5 * (cuts_[i] + cuts_[i + 1]);
      if (!is_free(circle_.centre + circle_.radius * unit_vector(middle))) continue;
      const bool goes_on = arcs.size() > first && arcs.back().to == cuts_[i];
      if (goes_on)
        arcs.back().to = cuts_[i + 1];
      else
        arcs.push_back({cuts_[i], cuts_[i + 1]});
    }
    // The arc of a disc that spans angle 0 begins before it.
    const bool is_cut = circle_.is_disc && arcs.size() > first + 1 && arcs[first].from == 0 &&
                        arcs.back().to == circle_.width;
    if (!is_cut) return;
    arcs.back().to += arcs[first].to;
    arcs.erase(arcs.begin() + static_cast<std::ptrdiff_t>(first));
  }

 private:
  void cut_at(Vec2 p) {
    const double angle = positive(heading_along(p - circle_.centre) - circle_.from);
    if (angle < circle_.width) cuts_.push_back(angle);
  }
  /// The line is a + t u, shifted to the left.
  void cut_by_line(Vec2 a, Vec2 u, double shift) {
    const Vec2 c = circle_.centre;
    const Vec2 o = a + shift * perpendicular(u) - c;
    const double b = dot(o, u);
    const double root = b * b - squared_norm(o) + circle_.radius * circle_.radius;
    if (root < 0) return;
    for (const double t : {-b - std::sqrt(root), -b + std::sqrt(root)}) cut_at(c + o + t * u);
  }
  void cut_by_circle(Vec2 centre, double radius) {
    const Vec2 c = circle_.centre;
    const double r = circle_.radius;
    const Vec2 d = centre - c;
    const double apart = norm(d);
    if (apart == 0 || apart > r + radius || apart < std::abs(r - radius)) return;
    const double x = (apart * apart + r * r - radius * radius) / (2 * apart);
    const double y = std::sqrt(std::max(0.0, r * r - x * x));
    const Vec2 e = d / apart;
    cut_at(c + x * e + y * perpendicular(e));
    cut_at(c + x * e - y * perpendicular(e));
  }

  const TurningCircle& circle_;
  double keep_;
  std::vector<double> cuts_{0, circle_.width};  ///< angles [rad]
};

}  // namespace

bool TurningCircle::is_taut(Vec2 normal, double slack) const {
  return is_disc || radius == 0 ||
         (cross(first, normal) >= -slack && cross(normal, last) >= -slack &&
          dot(first + last, normal) > 0);
}

double TurningCircle::angle_at(Vec2 normal) const {
  if (is_disc) return positive(heading_along(normal));
  double angle = maths::atan2(cross(first, normal), dot(first, normal));
  if (angle < 0.5 * width - pi) angle += 2 * pi;
  const double within = std::clamp(angle, 0.0, width);
  return std::abs(angle - within) <= 2 * angle_slack ? within : angle;
}

double TurningCircle::angle_around(double sense, double leaves, double arrives) const {
  const double angle = sense * (arrives - leaves);
  if (!is_disc) return angle < -angle_slack ? -1 : std::max(0.0, angle);
  const double ahead = positive(angle);
  return ahead > 2 * pi - angle_slack ? 0 : ahead;
}

// The path leaves a in direction u at the normal −s left(u), so that left(u) · d, with d from
// centre to centre, is s_b r_b − s_a r_a.
std::optional<TangentLine> tangent(const TurningCircle& a, double sense_a, const TurningCircle& b,
                                   double sense_b, double margin) {
  const Vec2 d = b.centre - a.centre;
  const double apart2 = squared_norm(d);
  const double offset = sense_b * b.radius - sense_a * a.radius;
  const double inner = apart2 - offset * offset;
  const double apart = std::sqrt(apart2);
  // Rounding may put a point on a circle inside it.
  if (apart == 0 || (inner < 0 && std::abs(offset) > apart + margin)) return std::nullopt;
  TangentLine line;
  line.length = std::sqrt(std::max(0.0, inner));
  const double sine = std::clamp(offset / apart, -1.0, 1.0);
  const double cosine = line.length / apart;
  const Vec2 e = d / apart;
  line.along = cosine * e - sine * perpendicular(e);
  const Vec2 left = perpendicular(line.along);
  if (!a.is_taut(-sense_a * left, cone_slack(a, b, line.length, margin)) ||
      !b.is_taut(-sense_b * left, cone_slack(b, a, line.length, margin)))
    return std::nullopt;
  return line;
}

void add_free_arcs(const TurningCircle& circle, const Map& map, const BodySet* moving,
                   double clearance, double margin, std::vector<Arc>& arcs) {
  const Box box = Box{circle.centre, circle.centre}.grown(circle.radius + clearance + margin);
  ArcCutter cutter(circle, clearance + 0.5 * margin);
  cutter.cut_by(map.walls(), box);
  if (moving) cutter.cut_by(*moving, box);
  cutter.cut_by_border(map.bounds());
  const auto is_free = [&](Vec2 p) {
    return map.is_free(p, clearance) && (!moving || moving->is_free(p, clearance));
  };
  cutter.add_free(is_free, arcs);
}

int arc_at(const TurningCircle& circle, double angle, std::span<const Arc> arcs) {
  if (!circle.is_disc) angle = std::clamp(angle, 0.0, circle.width);
  for (std::size_t i = 0; i < arcs.size(); ++i) {
    if (angle >= arcs[i].from - angle_slack && angle <= arcs[i].to + angle_slack)
      return static_cast<int>(i);
    if (circle.is_disc && angle + 2 * pi <= arcs[i].to + angle_slack) return static_cast<int>(i);
  }
  return -1;
}

}  // namespace microswarm::planning
