// SPDX-License-Identifier: Apache-2.0
#include "microswarm/world/obstacles/motion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "microswarm/core/fields/overloaded.hpp"
#include "microswarm/core/maths/angles.hpp"
#include "microswarm/core/maths/maths.hpp"

namespace microswarm {
namespace {

/// Phase angle of a wave [rad], reduced before multiplying by 2π so that late times keep precision.
double wave_angle(double t, double period, double phase) {
  const double turns = t / period + phase;
  return 2 * pi * (turns - std::floor(turns));
}

Placement placed(const Still& m, double) { return {true, {m.position, m.heading}, {}}; }

Placement placed(const Straight& m, double t) {
  return {true, {m.start + t * m.velocity, heading_along(m.velocity)}, m.velocity};
}

Placement placed(const HarmonicLine& m, double t) {
  const double angle = wave_angle(t, m.period, m.phase);
  const auto [sine, cosine] = maths::sincos(angle);
  return {true,
          {m.centre + sine * m.amplitude, heading_along(m.amplitude)},
          (2 * pi / m.period * cosine) * m.amplitude};
}

Placement placed(const HarmonicArc& m, double t) {
  const double angle = wave_angle(t, m.period, m.phase);
  const auto [sine, cosine] = maths::sincos(angle);
  const double turned = m.middle + m.half_angle * sine;
  const Vec2 spoke = unit_vector(turned);
  const double turning = m.half_angle * 2 * pi / m.period * cosine;
  return {true,
          {m.pivot + m.radius * spoke, turned + pi / 2},
          (m.radius * turning) * perpendicular(spoke)};
}

double total_length(const std::vector<Vec2>& points) {
  double length = 0;
  for (std::size_t i = 1; i < points.size(); ++i) length += distance(points[i - 1], points[i]);
  return length;
}

/// Arc length along the waypoints after `travelled` µm, and the sign of the motion (0 at rest).
struct Along {
  double s;
  double sign;
};
Along along(const Waypoints& m, double travelled, double length, double closed_length) {
  switch (m.at_end) {
    case AtEnd::stay:
      return {std::min(travelled, length), travelled < length ? 1.0 : 0.0};
    case AtEnd::loop:
      return {std::fmod(travelled, closed_length), 1.0};
    case AtEnd::back:
      break;
  }
  const double s = std::fmod(travelled, 2 * length);
  return s < length ? Along{s, 1.0} : Along{2 * length - s, -1.0};
}

double heading_of_first_leg(const std::vector<Vec2>& points) {
  for (const Vec2 p : points) {
    if (!(p == points.front())) return heading_along(p - points.front());
  }
  return 0;
}

Placement placed(const Waypoints& m, double t) {
  if (m.points.empty()) return {false, {}, {}};
  const std::size_t n = m.points.size();
  const double length = total_length(m.points);
  const double closed = length + distance(m.points.back(), m.points.front());
  Placement out{true, {m.points.front(), heading_of_first_leg(m.points)}, {}};
  if (!(length > 0) || !(m.speed > 0) || t < 0) return out;
  auto [s, sign] = along(m, m.speed * t, length, closed);
  const std::size_t legs = m.at_end == AtEnd::loop ? n : n - 1;
  for (std::size_t i = 0; i < legs; ++i) {
    const Vec2 a = m.points[i];
    const Vec2 b = m.points[(i + 1) % n];
    const double leg = distance(a, b);
    if (leg == 0) continue;
    out.pose.position = a + std::min(1.0, s / leg) * (b - a);
    out.velocity = (sign * m.speed / leg) * (b - a);
    if (s < leg) return out;
    s -= leg;
  }
  return out;
}

Placement placed(const Track& m, double t) {
  if (!m.samples || m.samples->times.empty()) return {false, {}, {}};
  const auto& times = m.samples->times;
  const auto& points = m.samples->points;
  if (!(t >= times.front() && t <= times.back())) return {false, {}, {}};
  const auto after = std::upper_bound(times.begin(), times.end(), t);
  if (after == times.begin() || times.size() == 1) return {true, {points.front(), 0}, {}};
  const std::size_t j = std::min(static_cast<std::size_t>(after - times.begin()), times.size() - 1);
  const double span = times[j] - times[j - 1];
  if (!(span > 0)) return {true, {points[j], 0}, {}};
  const Vec2 step = points[j] - points[j - 1];
  return {true, {points[j - 1] + ((t - times[j - 1]) / span) * step, 0}, step / span};
}

double top(const Still&) { return 0; }
double top(const Straight& m) { return norm(m.velocity); }
double top(const HarmonicLine& m) { return norm(m.amplitude) * 2 * pi / m.period; }
double top(const HarmonicArc& m) { return m.radius * m.half_angle * 2 * pi / m.period; }
double top(const Waypoints& m) { return total_length(m.points) > 0 ? m.speed : 0; }
double top(const Track& m) {
  double speed = 0;
  if (!m.samples) return speed;
  for (std::size_t i = 1; i < m.samples->times.size(); ++i) {
    const double length = distance(m.samples->points[i - 1], m.samples->points[i]);
    const double span = m.samples->times[i] - m.samples->times[i - 1];
    if (length > 0) {
      speed = std::max(speed, span > 0 ? length / span : std::numeric_limits<double>::infinity());
    }
  }
  return speed;
}

}  // namespace

Placement placement(const Motion& motion, double t) {
  return std::visit([&](const auto& m) { return placed(m, t); }, motion);
}

double top_speed(const Motion& motion) {
  return std::visit([](const auto& m) { return top(m); }, motion);
}

double top_turning(const Motion& motion) {
  return std::visit(
      Overloaded{
          [](const HarmonicArc& arc) { return arc.half_angle * 2 * pi / arc.period; },
          [](const OneOf<Still, Straight, HarmonicLine, Waypoints, Track> auto&) { return 0.0; }},
      motion);
}

Track* find_track(Motion& motion) {
  return std::visit(
      Overloaded{[](Track& track) { return &track; },
                 [](OneOf<Still, Straight, HarmonicLine, HarmonicArc, Waypoints> auto&) -> Track* {
                   return nullptr;
                 }},
      motion);
}

const Track* find_track(const Motion& motion) { return find_track(const_cast<Motion&>(motion)); }

}  // namespace microswarm
