// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "microswarm/core/maths/maths.hpp"

namespace microswarm {

/// Point or vector in the plane [µm], y up.
struct Vec2 {
  double x = 0;
  double y = 0;

  constexpr Vec2& operator+=(Vec2 b) { return *this = {x + b.x, y + b.y}; }
  constexpr Vec2& operator-=(Vec2 b) { return *this = {x - b.x, y - b.y}; }
  friend constexpr Vec2 operator+(Vec2 a, Vec2 b) { return {a.x + b.x, a.y + b.y}; }
  friend constexpr Vec2 operator-(Vec2 a, Vec2 b) { return {a.x - b.x, a.y - b.y}; }
  friend constexpr Vec2 operator-(Vec2 a) { return {-a.x, -a.y}; }
  friend constexpr Vec2 operator*(double s, Vec2 a) { return {s * a.x, s * a.y}; }
  friend constexpr Vec2 operator*(Vec2 a, double s) { return {s * a.x, s * a.y}; }
  friend constexpr Vec2 operator/(Vec2 a, double s) { return {a.x / s, a.y / s}; }
  friend constexpr bool operator==(Vec2, Vec2) = default;
};

/// Scalar product.
constexpr double dot(Vec2 a, Vec2 b) { return a.x * b.x + a.y * b.y; }
/// z component of the cross product; positive when b is to the left of a.
constexpr double cross(Vec2 a, Vec2 b) { return a.x * b.y - a.y * b.x; }
constexpr double squared_norm(Vec2 a) { return dot(a, a); }
inline double norm(Vec2 a) { return std::sqrt(squared_norm(a)); }
inline double distance(Vec2 a, Vec2 b) { return norm(b - a); }
/// `a` rotated left by 90°.
constexpr Vec2 perpendicular(Vec2 a) { return {-a.y, a.x}; }
/// Heading of the vector [rad], in [-π, π]; 0 for the zero vector.
inline double heading_along(Vec2 a) { return maths::atan2(a.y, a.x); }
inline Vec2 unit_vector(double heading) {
  const auto [sine, cosine] = maths::sincos(heading);
  return {cosine, sine};
}
inline Vec2 rotated(Vec2 a, double angle) {
  const Vec2 u = unit_vector(angle);
  return {u.x * a.x - u.y * a.y, u.y * a.x + u.x * a.y};
}
inline bool is_finite(Vec2 a) { return std::isfinite(a.x) && std::isfinite(a.y); }

/// Position [µm] and heading [rad].
struct Pose2 {
  Vec2 position{};
  double heading = 0;
  friend constexpr bool operator==(const Pose2&, const Pose2&) = default;
};

}  // namespace microswarm
