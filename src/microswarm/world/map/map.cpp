// SPDX-License-Identifier: Apache-2.0
#include "microswarm/world/map/map.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/maths/infinity.hpp"
#include "microswarm/core/text/text.hpp"
#include "microswarm/world/map/corners.hpp"
#include "microswarm/world/map/kept_work.hpp"
#include "microswarm/world/map/pieces.hpp"

namespace microswarm {
namespace {

/// Compiled without a branch, except for floats that were converted.
double lesser(double a, double b) { return a < b ? a : b; }

std::string place_text(Vec2 v) { return "(" + number_text(v.x) + ", " + number_text(v.y) + ")"; }

void check(const Box& bounds) {
  const bool finite = is_finite(bounds.lo) && is_finite(bounds.hi) &&
                      std::isfinite(bounds.width()) && std::isfinite(bounds.height());
  if (finite && bounds.width() > 0 && bounds.height() > 0) return;
  throw InputError("map: bounds " + place_text(bounds.lo) + " to " + place_text(bounds.hi) +
                   " µm are " + (finite ? "empty" : "not finite"));
}

void check(const std::vector<Polygon>& walls) {
  for (std::size_t i = 0; i < walls.size(); ++i) {
    for_each_edge(walls[i], [&](Vec2, Vec2 v) {
      if (is_finite(v)) return;
      throw InputError("map: polygon " + std::to_string(i + 1) + ": vertex " + place_text(v) +
                       " is not finite");
    });
  }
}

void check(const std::vector<Disc>& discs) {
  for (std::size_t i = 0; i < discs.size(); ++i) {
    const Disc& d = discs[i];
    if (is_finite(d.centre) && std::isfinite(d.radius) && d.radius >= 0) continue;
    throw InputError("map: disc " + std::to_string(i + 1) + ": centre " + place_text(d.centre) +
                     ", radius " + number_text(d.radius) + " µm: must be finite, radius >= 0");
  }
}

}  // namespace

struct Map::Derived {
  std::once_flag found;
  std::optional<Corners> corners;
  KeptWork kept;
};

Map::Map() : derived_(std::make_shared<Derived>()) {}

Map::Map(const Box& bounds, std::vector<Polygon> walls, const std::vector<Disc>& discs,
         double field_cell)
    : bounds_(bounds), derived_(std::make_shared<Derived>()) {
  check(bounds);
  check(walls);
  check(discs);
  for (Polygon& wall : walls) wall = normalised(std::move(wall));
  std::erase_if(walls, [](const Polygon& wall) { return wall.outer.empty(); });
  walls_ = BodySet(connected_pieces(std::move(walls), discs), true);
  for (const Body& body : walls_.bodies()) {
    pieces_ = std::max(pieces_, static_cast<int>(body.obstacle) + 1);
  }
  field_ = ClearanceField(bounds_, walls_, field_cell);
}

double Map::border_clearance(Vec2 p) const {
  const double least =
      std::min({p.x - bounds_.lo.x, bounds_.hi.x - p.x, p.y - bounds_.lo.y, bounds_.hi.y - p.y});
  return std::max(0.0, least);
}

double Map::clearance(Vec2 p) const { return clearance_beyond(p, field_.lower(p)); }

/// The same, given the field's lower bound; most points then need no point-in-wall test.
double Map::clearance_beyond(Vec2 p, double lower) const {
  if (lower + field_.spread() < 0) return 0;
  const double least = std::min(border_clearance(p), field_.wall_distance(p));
  return lower > 0 || !(least > 0) || !walls_.polygons().holds(p) ? least : 0;
}

double Map::wall_clearance(Vec2 p) const {
  if (!bounds_.contains(p)) return walls_.clearance(p, infinity);
  return field_.lower(p) > 0 || !walls_.polygons().holds(p) ? field_.wall_distance(p) : 0;
}

double Map::clearance(Segment s, double limit) const {
  const double nearest = std::min({limit, border_clearance(s.a), border_clearance(s.b)});
  return nearest > 0 ? walls_.clearance(s, nearest) : 0;
}

bool Map::is_free_exactly(Vec2 p, double r) const {
  const double least = std::min(border_clearance(p), field_.wall_distance(p));
  if (!(least >= r && least > 0)) return false;
  return field_.lower(p) > 0 || !walls_.polygons().holds(p);
}

void Map::are_free(std::span<const Vec2> positions, double r, std::span<std::uint8_t> free) const {
  assert(positions.size() == free.size());
  constexpr std::size_t most = 1024;
  std::array<std::uint32_t, most> undecided;
  for (std::size_t first = 0; first < positions.size(); first += most) {
    const std::size_t count = std::min(most, positions.size() - first);
    const auto some = positions.subspan(first, count);
    const std::size_t left = field_.decide(some, r, free.subspan(first, count), undecided);
    for (std::size_t k = 0; k < left; ++k)
      free[first + undecided[k]] = is_free_exactly(some[undecided[k]], r);
  }
}

/// Clearance at `p` for covering `length` µm around it: the lower bound if that suffices, else the
/// exact value.
double Map::useful_clearance(Vec2 p, double lower, double r, double length) const {
  if (lower - r >= std::min(length, field_.spread())) return lower;
  return lower + field_.spread() < r ? lower : clearance_beyond(p, lower);
}

/// Whether some cell on the way of a long segment has all of its points nearer to a wall than it
/// may be, which ends the search at once where it would halve for long.
bool Map::passes_a_wall(Segment s, double length, double least) const {
  constexpr int most = 8;
  const int parts = std::min(most, static_cast<int>(length / (4 * field_.spread())));
  for (int i = 1; i < parts; ++i)
    if (field_.lower(s.a + (i / static_cast<double>(parts)) * (s.b - s.a)) < least) return true;
  return false;
}

// All lookups come before the first branch, since which of them decides is hard to predict. Near
// walls the whole capsule is tested; halves decide only where its distance differs from r by no
// more than rounding might.
bool Map::is_free(Segment s, double r) const {
  const double lower_a = field_.lower(s.a);
  const double middle = field_.lower(s.a + 0.5 * (s.b - s.a));
  const double lower_b = field_.lower(s.b);
  const double least = r - field_.spread();
  if (lesser(lesser(lower_a - least, lower_b - least), middle - least) < 0) return false;
  const double length = distance(s.a, s.b) * (1 + 1e-12);
  const double lower_end = lesser(lower_a, lower_b);
  const bool middle_covers = middle - r >= 0.5 * length;
  const bool all_cover = lower_end >= r && lower_end - r + (middle - r) >= 0.5 * length;
  if (middle_covers || all_cover) return true;
  if (passes_a_wall(s, length, least)) return false;
  const double from_a = useful_clearance(s.a, lower_a, r, length);
  if (!(from_a >= r && from_a > 0)) return false;
  const double from_b = useful_clearance(s.b, lower_b, r, length);
  if (!(from_b >= r && from_b > 0)) return false;
  if (from_a - r + from_b - r >= length) return true;
  const double more = margin(r);
  if (walls_.is_free_from_outside(s, r + more)) return true;
  if (r > more && !walls_.is_free_from_outside(s, r - more)) return false;
  return piece_is_free(s, from_a, from_b, r, 4);
}

/// Exceeds any rounding error of a distance here.
double Map::margin(double r) const {
  const auto size = [](Vec2 p) { return std::abs(p.x) + std::abs(p.y); };
  return 1e-9 * (size(bounds_.lo) + size(bounds_.hi) + r);
}

// A piece is free if two balls of known clearance at its ends cover it. Otherwise it is halved, or,
// close to walls, tested as a whole capsule. Both ends are free.
bool Map::piece_is_free(Segment s, double from_a, double from_b, double r, int halvings) const {
  const double length = distance(s.a, s.b) * (1 + 1e-12);
  if (from_a - r + from_b - r >= length) return true;
  if (halvings == 0) return walls_.is_free_from_outside(s, r);
  const Vec2 middle = s.a + 0.5 * (s.b - s.a);
  const double clear = useful_clearance(middle, field_.lower(middle), r, 0.5 * length);
  return clear >= r && clear > 0 && piece_is_free({s.a, middle}, from_a, clear, r, halvings - 1) &&
         piece_is_free({middle, s.b}, clear, from_b, r, halvings - 1);
}

const Corners& Map::corners() const {
  std::call_once(derived_->found, [&] { derived_->corners.emplace(walls_, bounds_); });
  return *derived_->corners;
}

KeptWork& Map::kept() const { return derived_->kept; }

}  // namespace microswarm
