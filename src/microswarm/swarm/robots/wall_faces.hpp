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

/// Point or move in single precision [µm], relative to the centre of a map.
struct PointF {
  float x = 0;
  float y = 0;
};

/// One straight side of a wall; its normal points to the robots' side.
struct WallFace {
  PointF middle;
  PointF normal;
  float half_length = 0;  ///< [µm], including the overlap with its neighbours
};

/// Up to eight faces side by side for vector instructions. Unused lanes have negative lengths, so
/// nothing meets them.
struct alignas(32) FacePack {
  static constexpr std::size_t size = 8;
  std::array<float, size> middle_x{}, middle_y{}, normal_x{}, normal_y{}, half_length;

  FacePack() { half_length.fill(std::numeric_limits<float>::lowest()); }

  WallFace operator[](std::size_t i) const {
    return {{middle_x[i], middle_y[i]}, {normal_x[i], normal_y[i]}, half_length[i]};
  }
};

/// First face that a move meets. `time` is the fraction of the move up to the standoff from the
/// face, more than 1 if the move is free; `normal` is the face's normal.
struct FaceContact {
  float time = 2;
  PointF normal;

  bool met() const { return time <= 1; }
};

/// Grid of square cells; places outside belong to the nearest cell.
struct FaceCells {
  PointF low;
  float per_cell = 0;
  float last_column = 0;
  float last_row = 0;
  std::size_t columns = 1;

  std::size_t at(PointF p) const {
    const float i = (p.x - low.x) * per_cell;
    const float j = (p.y - low.y) * per_cell;
    const int column = static_cast<int>(i > 0 ? (i < last_column ? i : last_column) : 0);
    const int row = static_cast<int>(j > 0 ? (j < last_row ? j : last_row) : 0);
    return static_cast<std::size_t>(row) * columns + static_cast<std::size_t>(column);
  }
};

/// Walls and border of a map as faces in single precision, with lists of the faces near every cell
/// of a grid.
/// No point robot passes a face, although positions and products are rounded. A move that would
/// bring the robot nearer than `guard` to a face is a contact. The robot then stops `standoff` from
/// the face, measured normal to it, so grazing contacts do not bring it gradually closer. Both
/// distances far exceed all rounding.
/// There are no gaps between faces. A face extends one and a half guards beyond its ends: with one
/// guard, a robot heading straight at a 90° corner would meet both faces exactly at their ends, and
/// rounding could let it through. A corner sharper than 90° has an additional face across its tip.
/// Discs are replaced by circumscribed polygons of 64 vertices.
class WallFaces {
 public:
  /// `reach` [µm] is the maximum move for which `near` is valid.
  WallFaces(const Map& map, double reach);

  Vec2 origin() const { return origin_; }
  float reach() const { return reach_; }
  float guard() const { return guard_; }
  float standoff() const { return 2 * guard_; }
  std::span<const WallFace> all() const { return faces_; }
  /// Faces that a robot at `p` may meet on a move of at most `reach`, in the order of all().
  std::span<const FacePack> near(PointF p) const { return near_in(grid_.at(p)); }
  const FaceCells& cells() const { return grid_; }
  /// The same for robots in this cell.
  std::span<const FacePack> near_in(std::size_t cell) const {
    const Packs packs = cells_[cell];
    return {packs_.data() + packs.first, packs.count};
  }
  /// First contact on a move of at most `reach`.
  FaceContact first_contact(PointF p, PointF move) const;

 private:
  /// Included in half_length; time_to_contact adds one guard.
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
  Vec2 origin_;
  float reach_ = 0;
  float guard_ = 0;
  std::vector<WallFace> faces_;
  FaceCells grid_;
  std::vector<Packs> cells_;
  std::vector<FacePack> packs_;  ///< shared by cells with the same faces
};

/// Fraction of `move` up to the standoff of a robot at `p` from the face; 2 if the face is not met.
/// A robot that rounding has brought nearer than `guard` during many moves along the wall stays (0)
/// unless it leaves by at least an eighth of `guard`; otherwise further rounding could bring it
/// into the wall. The vectorised stepping does the same operations in the same order and gives the
/// same bits.
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
