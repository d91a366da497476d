// SPDX-License-Identifier: Apache-2.0
#include "microswarm/world/snapshot.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>
#include <utility>

#include "microswarm/core/maths/infinity.hpp"
#include "microswarm/core/text/text.hpp"

namespace microswarm {
namespace {

/// Minimum number of digits that distinguish it from `r`.
std::string length_text(double d, double r) {
  for (const double per_unit : {1.0, 10.0, 1e3, 1e6}) {
    const double rounded = std::round(d * per_unit) / per_unit;
    const bool is_near = per_unit > 1 || d >= 9.5 || rounded == d;
    if (is_near && rounded > 0 && (d < r) == (rounded < r)) return number_text(rounded) + " µm";
  }
  return number_text(d) + " µm";
}

std::string body_name(const BodySet& set, std::size_t body, const char* kind) {
  return kind + std::string(" ") + std::to_string(set.bodies()[body].obstacle + 1);
}

/// "is 12 µm inside wall 3", if it is.
std::optional<std::string> inside_text(const BodySet& set, Vec2 p, const char* kind) {
  if (!set.holds(p)) return std::nullopt;
  const std::size_t body = set.nearest(p, infinity);
  if (body == set.bodies().size()) return std::nullopt;
  const double depth = depth_in(set.bodies()[body], p);
  if (!(depth > 0)) return "touches " + body_name(set, body, kind);
  return "is " + length_text(depth, infinity) + " inside " + body_name(set, body, kind);
}

template <class Solid>
bool pieces_free(const Solid& solid, std::span<const Vec2> polyline, double r) {
  for (std::size_t i = 1; i < polyline.size(); ++i)
    if (!solid.is_free(Segment{polyline[i - 1], polyline[i]}, r)) return false;
  return true;
}

/// The same for a polyline within `size` of each of its points: the distance at a point answers for
/// the pieces around it.
bool free_by_distances(const BodySet& bodies, std::span<const Vec2> polyline, double r,
                       double size) {
  constexpr double rounding = 1e-6;
  for (std::size_t i = 0; i + 1 < polyline.size();) {
    const Vec2 p = polyline[i];
    const double free = bodies.clearance(p, r + size + 1) - r - rounding;
    std::size_t last = i;
    while (last + 1 < polyline.size() && distance(p, polyline[last + 1]) <= free) ++last;
    if (last == i && !bodies.is_free(Segment{p, polyline[++last]}, r)) return false;
    i = last;
  }
  return true;
}

}  // namespace

Snapshot::Snapshot(std::shared_ptr<const Map> map, double time, std::vector<Body> moving)
    : map_(std::move(map)), time_(time), moving_(std::move(moving)) {
  assert(map_);
}

double Snapshot::clearance(Vec2 p) const {
  const double to_wall = map_->clearance(p);
  return moving_.empty() ? to_wall : moving_.clearance(p, to_wall);
}

double Snapshot::obstacle_clearance(Vec2 p) const {
  const double to_wall = map_->wall_clearance(p);
  return moving_.empty() ? to_wall : moving_.clearance(p, to_wall);
}

void Snapshot::are_free(std::span<const Vec2> positions, double r,
                        std::span<std::uint8_t> free) const {
  map_->are_free(positions, r, free);
  if (moving_.empty()) return;
  for (std::size_t i = 0; i < positions.size(); ++i)
    if (free[i] != 0) free[i] = moving_.is_free(positions[i], r);
}

bool Snapshot::is_free(std::span<const Vec2> polyline, double r) const {
  if (polyline.empty()) return true;
  if (polyline.size() == 1) return is_free(polyline[0], r);
  const Vec2 centre = bounding_box(polyline).centre();
  double squared = 0;
  for (const Vec2 p : polyline) squared = std::max(squared, squared_norm(p - centre));
  const double size = std::sqrt(squared) * (1 + 1e-12);
  return (map_->field().lower(centre) >= r + size || pieces_free(*map_, polyline, r)) &&
         (moving_.empty() || moving_.is_free(centre, r + size) ||
          free_by_distances(moving_, polyline, r, 2 * size));
}

Survey Snapshot::survey(Disc circle, const Stop& stop) const {
  const bool sees_walls = map_->field().lower(circle.centre) <= circle.radius;
  if (sees_walls && !moving_.empty())
    return microswarm::survey(circle, map_->walls(), moving_, stop);
  Survey survey;
  if (sees_walls) map_->walls().survey(circle, survey, stop);
  if (!moving_.empty()) moving_.survey(circle, survey, stop);
  return survey;
}

std::string Snapshot::blocked_reason(Vec2 p, double r) const {
  if (is_free(p, r)) return {};
  const Box& box = bounds();
  if (!box.contains(p)) {
    return "is outside the map (" + number_text(box.lo.x) + ".." + number_text(box.hi.x) + " × " +
           number_text(box.lo.y) + ".." + number_text(box.hi.y) + " µm)";
  }
  if (const auto inside = inside_text(map_->walls(), p, "wall")) return *inside;
  if (const auto inside = inside_text(moving_, p, "obstacle")) return *inside;
  const double to_border = map_->border_clearance(p);
  const double to_wall = map_->walls().clearance(p, to_border);
  const double to_obstacle = moving_.clearance(p, to_wall);
  const double least = to_obstacle;
  if (!(least > 0)) return "touches the border";
  std::string from = "the border";
  if (to_obstacle < to_wall) {
    from = body_name(moving_, moving_.nearest(p, to_wall), "obstacle");
  } else if (to_wall < to_border) {
    from = body_name(map_->walls(), map_->walls().nearest(p, to_border), "wall");
  }
  return "is " + length_text(least, r) + " from " + from + ", needs " + number_text(r) + " µm";
}

}  // namespace microswarm
