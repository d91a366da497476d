// SPDX-License-Identifier: Apache-2.0
#include "microswarm/swarm/robots/wall_faces.hpp"

#include <algorithm>
#include <cmath>

#include "microswarm/core/fields/overloaded.hpp"
#include "microswarm/core/maths/angles.hpp"
#include "microswarm/core/maths/maths.hpp"

namespace microswarm {
namespace {

constexpr double guard_of_extent = 1.5e-6;  // rounding moves a robot by less than 1/4 of this
constexpr int disc_corners = 64;

PointF rounded(Vec2 p) { return {static_cast<float>(p.x), static_cast<float>(p.y)}; }

Vec2 direction(Vec2 v) {
  const double length = norm(v);
  return {v.x / length, v.y / length};
}

std::vector<Vec2> ring_around(const Disc& disc) {
  const double radius = disc.radius / maths::cos(pi / disc_corners);
  std::vector<Vec2> ring;
  ring.reserve(disc_corners);
  for (int k = 0; k < disc_corners; ++k)
    ring.push_back(disc.centre + radius * unit_vector(2 * pi * k / disc_corners));
  return ring;
}

}  // namespace

WallFaces::WallFaces(const Map& map, double reach) : origin_(map.bounds().centre()) {
  const Box& bounds = map.bounds();
  guard_ = static_cast<float>(guard_of_extent * std::max(bounds.width(), bounds.height()));
  reach_ = std::max(static_cast<float>(reach), 8 * guard_);
  for (const Body& body : map.walls().bodies()) {
    std::visit(Overloaded{[&](const Disc& disc) {
                            if (disc.radius > 0) add_ring(ring_around(disc));
                          },
                          [&](const Polygon& polygon) {
                            add_ring(polygon.outer);
                            for (const auto& hole : polygon.holes) add_ring(hole);
                          }},
               body.shape);
  }
  add_border(bounds);
  grid_ = FaceGrid({bounds.lo - origin_, bounds.hi - origin_}, faces_, reach_, guard_);
}

// Rings have the solid on their left.
void WallFaces::add_ring(std::span<const Vec2> ring) {
  const std::size_t n = ring.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2 before = ring[(i + n - 1) % n];
    const Vec2 tip = ring[i];
    const Vec2 after = ring[(i + 1) % n];
    add_face(tip, after);
    const Vec2 in = direction(tip - before);
    const Vec2 out = direction(after - tip);
    if (dot(in, out) >= 0 || cross(in, out) < 0) continue;
    faces_.push_back({rounded(tip - origin_), rounded(direction(in - out)), overlap()});
  }
}

void WallFaces::add_face(Vec2 a, Vec2 b) {
  const Vec2 along = direction(b - a);
  faces_.push_back({rounded(0.5 * (a + b) - origin_), rounded({along.y, -along.x}),
                    static_cast<float>(0.5 * distance(a, b)) + overlap()});
}

void WallFaces::add_border(const Box& bounds) {
  const Vec2 lo = bounds.lo;
  const Vec2 hi = bounds.hi;
  add_face(lo, {lo.x, hi.y});
  add_face({lo.x, hi.y}, hi);
  add_face(hi, {hi.x, lo.y});
  add_face({hi.x, lo.y}, lo);
}

FaceContact WallFaces::first_contact(PointF p, PointF move) const {
  FaceContact first;
  for (const FacePack& pack : near(p)) {
    for (std::size_t i = 0; i < FacePack::size; ++i) {
      const WallFace face = pack[i];
      const float time = time_to_contact(face, p, move, guard_);
      if (time < first.time) first = FaceContact{time, face.normal};
    }
  }
  return first;
}

}  // namespace microswarm
