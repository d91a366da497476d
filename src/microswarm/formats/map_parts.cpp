// SPDX-License-Identifier: Apache-2.0
#include "microswarm/formats/map_parts.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/maths/hash.hpp"
#include "microswarm/core/text/text.hpp"

namespace microswarm::formats {
namespace {

void check_coordinate(double value, const std::string& name, const char* what) {
  if (!(std::abs(value) <= max_coordinate))
    throw InputError(name, std::string(what) + " " + number_text(value) + " µm, at most " +
                               number_text(max_coordinate));
}

void check_point(Vec2 p, const std::string& name, const char* what) {
  check_coordinate(p.x, name, what);
  check_coordinate(p.y, name, what);
}

}  // namespace

Box enclosing_box(const MapParts& parts) {
  Box box;
  for (const Polygon& wall : parts.walls)
    for (const Vec2 p : wall.outer) box.include(p);
  for (const Disc& disc : parts.discs) {
    box.include(disc.centre - Vec2{disc.radius, disc.radius});
    box.include(disc.centre + Vec2{disc.radius, disc.radius});
  }
  return box;
}

std::optional<std::string> outside_note(const MapParts& parts, const std::string& name) {
  const Box& map = parts.bounds;
  std::size_t outside = 0;
  Vec2 first;
  const auto count = [&](const Box& box) {
    if (box.lo.x <= map.hi.x && box.hi.x >= map.lo.x && box.lo.y <= map.hi.y &&
        box.hi.y >= map.lo.y)
      return;
    if (outside++ == 0) first = box.centre();
  };
  for (const Polygon& wall : parts.walls) count(bounding_box(wall));
  for (const Disc& disc : parts.discs) count(bounding_box(disc));
  if (outside == 0) return std::nullopt;
  return fmt::format(
      "{}: {} of {} walls are left out, outside the bounds of {:.6g}..{:.6g} × {:.6g}..{:.6g} µm, "
      "the first at ({:.6g}, {:.6g}) µm",
      name, outside, parts.walls.size() + parts.discs.size(), map.lo.x, map.hi.x, map.lo.y,
      map.hi.y, first.x, first.y);
}

std::uint64_t fingerprint(const MapParts& parts) {
  Hash hash;
  const auto point = [&](Vec2 p) { hash.value(p.x), hash.value(p.y); };
  const auto ring = [&](const std::vector<Vec2>& points) {
    hash.value(static_cast<std::uint64_t>(points.size()));
    for (const Vec2 p : points) point(p);
  };
  point(parts.bounds.lo);
  point(parts.bounds.hi);
  hash.value(static_cast<std::uint64_t>(parts.walls.size()));
  for (const Polygon& wall : parts.walls) {
    ring(wall.outer);
    hash.value(static_cast<std::uint64_t>(wall.holes.size()));
    for (const auto& hole : wall.holes) ring(hole);
  }
  for (const Disc& disc : parts.discs) point(disc.centre), hash.value(disc.radius);
  return hash.digest();
}

void check(const MapParts& parts, const std::string& name) {
  const Box& b = parts.bounds;
  if (!(b.lo.x < b.hi.x && b.lo.y < b.hi.y))
    throw InputError(name, "the map's bounds are empty: " + number_text(b.lo.x) + ".." +
                               number_text(b.hi.x) + " × " + number_text(b.lo.y) + ".." +
                               number_text(b.hi.y) + " µm");
  check_point(b.lo, name, "bounds at");
  check_point(b.hi, name, "bounds at");
  for (const Polygon& wall : parts.walls) {
    for (const Vec2 p : wall.outer) check_point(p, name, "a wall at");
    for (const auto& hole : wall.holes)
      for (const Vec2 p : hole) check_point(p, name, "a wall at");
  }
  for (const Disc& disc : parts.discs) {
    check_point(disc.centre, name, "a disc at");
    check_coordinate(disc.radius, name, "a disc of radius");
  }
}

}  // namespace microswarm::formats
