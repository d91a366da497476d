// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "microswarm/world/map/map.hpp"

namespace microswarm {

/// A point or a move in single precision [µm], relative to the middle of a map.
struct PointF {
  float x = 0;
  float y = 0;
};

/// One straight side of a wall: robots are on the side its normal points to.
struct WallFace {
  PointF middle;
  PointF normal;
  float half_length = 0;  ///< [µm], and what it overlaps its neighbours by
};

/// Up to eight faces side by side, for machines that look at so many at once; the rest have lengths
/// below 0, so that nothing meets them.
struct alignas(32) FacePack {
  static constexpr std::size_t size = 8;
  std::array<float, size> middle_x{}, middle_y{}, normal_x{}, normal_y{}, half_length;

  FacePack() { half_length.fill(std::numeric_limits<float>::lowest()); }

  WallFace operator[](std::size_t i) const {
    return {{middle_x[i], middle_y[i]}, {normal_x[i], normal_y[i]}, half_length[i]};
  }
};

/// First face that a move meets: the share of the move up to where the robot stands off from it,
/// more than 1 when the move is free, and the face's normal.
struct FaceContact {
  float time = 2;
  PointF normal;

  bool met() const { return time <= 1; }
};

/// The walls and the border of a map as faces in single precision, with lists of the faces near
/// every cell of a grid. No point robot passes a face, though positions and products are rounded:
/// a move that would bring the robot nearer than `guard` to a face is a contact, and the robot then
/// stops `standoff` from the face, measured square to it, so that grazing contacts do not let it
/// creep up. Both are far wider than all rounding. A face reaches one and a half guards beyond its
/// ends (with one, a robot that comes straight at a corner of 90° would meet both faces just at
/// their ends, and rounding could let it through), and a corner sharper than 90° has a face across
/// its tip; so no gap is left between faces.
/// Discs are taken as the polygons of 64 corners around them.
class WallFaces {
 public:
  /// `reach` [µm] is the longest move that `near` answers for.
  WallFaces(const Map& map, double reach);

  Vec2 origin() const { return origin_; }
  float reach() const { return reach_; }
  float guard() const { return guard_; }
  float standoff() const { return 2 * guard_; }
  std::span<const WallFace> all() const { return faces_; }
  /// The faces that a robot at `p` may meet on a move of `reach`, in the order of all().
  std::span<const FacePack> near(PointF p) const {
    const Packs packs = cells_[cell_at(p)];
    return {packs_.data() + packs.first, packs.count};
  }
  /// First contact on a move of at most `reach`.
  FaceContact first_contact(PointF p, PointF move) const;

 private:
  /// What half_length holds besides: time_to_contact adds one guard.
  float overlap() const { return 0.5f * guard_; }
  void add_ring(std::span<const Vec2> ring);
  void add_face(Vec2 a, Vec2 b);
  void add_border(const Box& bounds);
  void fill_cells(const Box& bounds);
  struct CellFace {
    std::uint32_t cell;
    std::uint32_t face;
  };
  void pack(const std::vector<CellFace>& entries, std::size_t cells);
  struct Packs {
    std::uint32_t first = 0;
    std::uint32_t count = 0;
  };
  Packs add_packs(const std::vector<std::uint32_t>& faces);
  std::size_t cell_at(PointF p) const {
    const float i = (p.x - low_.x) * per_cell_;
    const float j = (p.y - low_.y) * per_cell_;
    const int column = static_cast<int>(i > 0 ? (i < last_column_ ? i : last_column_) : 0);
    const int row = static_cast<int>(j > 0 ? (j < last_row_ ? j : last_row_) : 0);
    return static_cast<std::size_t>(row) * columns_ + static_cast<std::size_t>(column);
  }

  Vec2 origin_;
  float reach_ = 0;
  float guard_ = 0;
  std::vector<WallFace> faces_;
  PointF low_;
  float per_cell_ = 0;
  float last_column_ = 0;
  float last_row_ = 0;
  std::size_t columns_ = 1;
  std::vector<Packs> cells_;
  std::vector<FacePack> packs_;  ///< cells with the same faces share theirs
};

/// Share of the move `move` up to where a robot at `p` stands off from the face; 2 when the face is
/// not met. A robot that many moves along the wall have rounded to nearer than `guard` stays (0)
/// unless it leaves by an eighth of that: it would go on being rounded, into the wall. The batch
/// stepping does the same operations in the same order: the same bits.
inline float time_to_contact(const WallFace& face, PointF p, PointF move, float guard) {
  constexpr float never = 2;
  const float dx = p.x - face.middle.x;
  const float dy = p.y - face.middle.y;
  const float d = dx * face.normal.x + dy * face.normal.y;
  const float v = move.x * face.normal.x + move.y * face.normal.y;
  const float leaving = d < guard ? guard / 8 : 0.0f;
  if (!(v < leaving && d + v < guard + leaving && d >= -guard)) return never;
  const float towards = std::min(v, -std::numeric_limits<float>::min());
  const float hit = std::max(0.0f, (guard - d) / towards);
  const float along = (dy * face.normal.x - dx * face.normal.y) +
                      hit * (move.y * face.normal.x - move.x * face.normal.y);
  if (!(std::abs(along) <= face.half_length + guard)) return never;
  return d < guard ? 0.0f : std::max(0.0f, (2 * guard - d) / towards);
}

}  // namespace microswarm
