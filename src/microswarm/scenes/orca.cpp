// SPDX-License-Identifier: Apache-2.0
#include "microswarm/scenes/orca.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

namespace microswarm::scenes {
namespace {

constexpr double parallel = 1e-9;  // cross product of directions

/// Half plane of velocities to the left of a line.
struct HalfPlane {
  Vec2 point{};
  Vec2 direction{};  ///< of length 1

  /// Distance [µm/s] by which a velocity is outside, negative inside.
  double excess(Vec2 velocity) const { return cross(direction, point - velocity); }
};

/// The velocities of `a` with which it does its half to avoid `b`.
HalfPlane avoiding(const OrcaAgent& a, const OrcaAgent& b, double horizon, double step) {
  const Vec2 between = b.position - a.position, relative = a.velocity - b.velocity;
  const double radius = a.radius + b.radius, apart = dot(between, between);
  const bool collides = apart <= radius * radius;
  const double time = collides ? step : horizon;
  const Vec2 from_cap = relative - between / time;
  const double cap_distance = norm(from_cap), towards = dot(from_cap, between);
  HalfPlane plane;
  Vec2 change;
  if (collides || (towards < 0 && towards * towards > radius * radius * dot(from_cap, from_cap))) {
    const Vec2 outwards = cap_distance > 0 ? from_cap / cap_distance : Vec2{1, 0};
    plane.direction = {outwards.y, -outwards.x};
    change = (radius / time - cap_distance) * outwards;
  } else {
    const double leg = std::sqrt(apart - radius * radius);
    const double side = cross(between, from_cap) > 0 ? 1 : -1;
    plane.direction = side / apart * (leg * between + side * radius * perpendicular(between));
    change = dot(relative, plane.direction) * plane.direction - relative;
  }
  plane.point = a.velocity + 0.5 * change;
  return plane;
}

/// Velocity that is preferred: the one nearest to a given one, or the farthest in a direction.
struct OrcaAim {
  Vec2 wanted{};
  bool is_direction = false;
};

/// Best velocity on the line of the last plane that is within the others and the speed limit.
std::optional<Vec2> best_on_line(std::span<const HalfPlane> planes, double max_speed,
                                 const OrcaAim& aim) {
  const HalfPlane& line = planes.back();
  const double along = dot(line.point, line.direction);
  const double discriminant = along * along + max_speed * max_speed - dot(line.point, line.point);
  if (discriminant < 0) return std::nullopt;
  double first = -along - std::sqrt(discriminant), last = -along + std::sqrt(discriminant);
  for (const HalfPlane& other : planes.first(planes.size() - 1)) {
    const double denominator = cross(line.direction, other.direction);
    const double numerator = cross(other.direction, line.point - other.point);
    if (std::abs(denominator) <= parallel) {
      if (numerator < 0) return std::nullopt;
      continue;
    }
    const double t = numerator / denominator;
    (denominator > 0 ? last : first) = denominator > 0 ? std::min(last, t) : std::max(first, t);
    if (first > last) return std::nullopt;
  }
  const double t = aim.is_direction
                       ? (dot(aim.wanted, line.direction) > 0 ? last : first)
                       : std::clamp(dot(line.direction, aim.wanted - line.point), first, last);
  return line.point + t * line.direction;
}

/// Best velocity within the planes; `failed` receives the first plane that leaves none, or their
/// number.
Vec2 best_within(std::span<const HalfPlane> planes, double max_speed, const OrcaAim& aim,
                 std::size_t& failed) {
  Vec2 best = aim.wanted;
  if (aim.is_direction)
    best = max_speed * aim.wanted;
  else if (norm(best) > max_speed)
    best = max_speed / norm(best) * best;
  for (failed = 0; failed < planes.size(); ++failed) {
    if (planes[failed].excess(best) <= 0) continue;
    const auto moved = best_on_line(planes.first(failed + 1), max_speed, aim);
    if (!moved) return best;
    best = *moved;
  }
  return best;
}

/// Velocity that enters the forbidden sides of the planes from `failed` on least.
Vec2 min_excess(std::span<const HalfPlane> planes, std::size_t failed, double max_speed,
                Vec2 best) {
  double excess = 0;
  for (std::size_t i = failed; i < planes.size(); ++i) {
    const HalfPlane& plane = planes[i];
    if (plane.excess(best) <= excess) continue;
    std::vector<HalfPlane> bisectors;
    for (const HalfPlane& other : planes.first(i)) {
      const double across = cross(plane.direction, other.direction);
      HalfPlane bisector;
      if (std::abs(across) <= parallel) {
        if (dot(plane.direction, other.direction) > 0) continue;
        bisector.point = 0.5 * (plane.point + other.point);
      } else {
        bisector.point = plane.point + cross(other.direction, plane.point - other.point) / across *
                                           plane.direction;
      }
      const Vec2 direction = other.direction - plane.direction;
      bisector.direction = direction / norm(direction);
      bisectors.push_back(bisector);
    }
    std::size_t none = 0;
    const Vec2 moved =
        best_within(bisectors, max_speed, {perpendicular(plane.direction), true}, none);
    if (none == bisectors.size()) best = moved;
    excess = plane.excess(best);
  }
  return best;
}

}  // namespace

std::vector<Vec2> orca_velocities(std::span<const OrcaAgent> agents, double horizon, double step) {
  std::vector<Vec2> velocities;
  std::vector<HalfPlane> planes;
  for (const OrcaAgent& agent : agents) {
    planes.clear();
    for (const OrcaAgent& other : agents)
      if (&other != &agent) planes.push_back(avoiding(agent, other, horizon, step));
    std::size_t failed = 0;
    Vec2 best = best_within(planes, agent.max_speed, {agent.preferred}, failed);
    if (failed < planes.size()) best = min_excess(planes, failed, agent.max_speed, best);
    velocities.push_back(best);
  }
  return velocities;
}

}  // namespace microswarm::scenes
