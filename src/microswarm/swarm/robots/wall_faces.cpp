// SPDX-License-Identifier: Apache-2.0
#include "microswarm/swarm/robots/wall_faces.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "microswarm/core/maths/angles.hpp"
#include "microswarm/core/maths/maths.hpp"
#include "microswarm/geometry/distance.hpp"

namespace microswarm {
namespace {

constexpr double guard_of_extent = 1.5e-6;  // rounding moves a robot by less than 1/4 of this
constexpr double max_cells = 1 << 20;
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
    if (const auto* disc = std::get_if<Disc>(&body.shape)) {
      if (disc->radius > 0) add_ring(ring_around(*disc));
      continue;
    }
    const auto& polygon = std::get<Polygon>(body.shape);
    add_ring(polygon.outer);
    for (const auto& hole : polygon.holes) add_ring(hole);
  }
  add_border(bounds);
  fill_cells(bounds);
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

void WallFaces::fill_cells(const Box& bounds) {
  const double area = bounds.width() * bounds.height();
  const double cell = std::max(static_cast<double>(reach_), std::sqrt(area / max_cells));
  const std::size_t columns = static_cast<std::size_t>(bounds.width() / cell) + 1;
  const std::size_t rows = static_cast<std::size_t>(bounds.height() / cell) + 1;
  grid_ = {.low = rounded(bounds.lo - origin_),
           .per_cell = static_cast<float>(1 / cell),
           .last_column = static_cast<float>(columns - 1),
           .last_row = static_cast<float>(rows - 1),
           .columns = columns};
  const Vec2 low = bounds.lo - origin_;
  // Half a diagonal plus the move, plus rounding of the cell and of the contact.
  const double range = reach_ + cell * std::sqrt(0.5) + 8 * guard_;
  std::vector<CellFace> entries;
  for (std::uint32_t id = 0; id < faces_.size(); ++id) {
    const WallFace& f = faces_[id];
    const Vec2 middle{f.middle.x, f.middle.y};
    const Vec2 half = static_cast<double>(f.half_length) * Vec2{-f.normal.y, f.normal.x};
    const Segment s{middle - half, middle + half};
    Box box;
    box.include(s.a);
    box.include(s.b);
    const Box around = box.grown(range);
    const auto clamp = [](double v, std::size_t count) {
      return static_cast<std::size_t>(std::clamp(v, 0.0, static_cast<double>(count - 1)));
    };
    for (std::size_t j = clamp((around.lo.y - low.y) / cell, rows),
                     top = clamp((around.hi.y - low.y) / cell, rows);
         j <= top; ++j) {
      for (std::size_t i = clamp((around.lo.x - low.x) / cell, columns),
                       right = clamp((around.hi.x - low.x) / cell, columns);
           i <= right; ++i) {
        const Vec2 centre =
            low + cell * Vec2{static_cast<double>(i) + 0.5, static_cast<double>(j) + 0.5};
        if (distance(centre, s) <= range)
          entries.push_back({static_cast<std::uint32_t>(j * columns + i), id});
      }
    }
  }
  pack(entries, columns * rows);
}

void WallFaces::pack(const std::vector<CellFace>& entries, std::size_t cells) {
  std::vector<std::vector<std::uint32_t>> faces(cells);
  for (const CellFace& entry : entries) faces[entry.cell].push_back(entry.face);
  std::map<std::vector<std::uint32_t>, Packs> known{{{}, {}}};
  cells_.resize(cells);
  for (std::size_t i = 0; i < cells; ++i) {
    const auto [place, is_new] = known.try_emplace(std::move(faces[i]));
    if (is_new) place->second = add_packs(place->first);
    cells_[i] = place->second;
  }
}

WallFaces::Packs WallFaces::add_packs(const std::vector<std::uint32_t>& faces) {
  const Packs packs{
      static_cast<std::uint32_t>(packs_.size()),
      static_cast<std::uint32_t>((faces.size() + FacePack::size - 1) / FacePack::size)};
  packs_.resize(packs_.size() + packs.count);
  for (std::size_t k = 0; k < faces.size(); ++k) {
    FacePack& to = packs_[packs.first + k / FacePack::size];
    const std::size_t lane = k % FacePack::size;
    const WallFace& face = faces_[faces[k]];
    to.middle_x[lane] = face.middle.x;
    to.middle_y[lane] = face.middle.y;
    to.normal_x[lane] = face.normal.x;
    to.normal_y[lane] = face.normal.y;
    to.half_length[lane] = face.half_length;
  }
  return packs;
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
