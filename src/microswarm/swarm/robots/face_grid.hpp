// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "microswarm/geometry/shapes.hpp"

namespace microswarm {

/// Point or move in single precision [µm], relative to the centre of a map.
struct PointF {
  float x = 0;
  float y = 0;
};

/// One straight side of a wall; its normal points to the robots' side.
struct WallFace {
  PointF middle{};
  PointF normal{};
  float half_length = 0;  ///< [µm], including the overlap with its neighbours
};

/// Up to eight faces side by side for vector instructions. Unused lanes have negative lengths, so
/// nothing meets them.
struct alignas(64) FacePack {
  static constexpr std::size_t size = 8;
  std::array<float, size> middle_x{}, middle_y{}, normal_x{}, normal_y{}, half_length;
  std::uint32_t following = 0;  ///< packs of the same list after this one

  FacePack() { half_length.fill(std::numeric_limits<float>::lowest()); }

  WallFace operator[](std::size_t i) const {
    return {{middle_x[i], middle_y[i]}, {normal_x[i], normal_y[i]}, half_length[i]};
  }
};

/// Grid of square cells, each with nine lists of the faces that robots in it may meet on a move of
/// at most `reach`: one list for each eighth of all directions, and one for any direction. Faces
/// are in their given order, so the first of several that are met at once is the same in each list.
class FaceGrid {
 public:
  static constexpr std::size_t any_direction = 8;
  static constexpr std::size_t lists_a_cell = 9;

  FaceGrid() = default;
  /// `bounds` are relative to the origin of the faces; `guard` [µm] as in WallFaces.
  FaceGrid(const Box& bounds, std::span<const WallFace> faces, float reach, float guard);

  /// Cell of a place; those outside belong to the nearest cell.
  std::size_t cell_at(PointF p) const {
    const float i = (p.x - low.x) * per_cell;
    const float j = (p.y - low.y) * per_cell;
    const int column = static_cast<int>(i > 0 ? (i < last_column ? i : last_column) : 0);
    const int row = static_cast<int>(j > 0 ? (j < last_row ? j : last_row) : 0);
    return static_cast<std::size_t>(row) * columns + static_cast<std::size_t>(column);
  }
  /// Eighth of the directions that a move belongs to. Moves shorter than `short_move` belong to
  /// any_direction: robots nearer than the guard do not even leave a wall by such moves.
  std::size_t move_direction(PointF move) const {
    const float x = std::abs(move.x), y = std::abs(move.y);
    if (x < short_move && y < short_move) return any_direction;
    return (move.x < 0 ? 1u : 0u) + (move.y < 0 ? 2u : 0u) + (y > x ? 4u : 0u);
  }
  std::span<const FacePack> near(std::size_t cell, std::size_t direction) const {
    const FacePack* first = packs_.data() + lists_[lists_a_cell * cell + direction];
    return {first, first == packs_.data() ? 0 : 1 + first->following};
  }
  /// First packs by cell and direction; pack 0 is that of empty lists.
  const std::uint32_t* lists() const { return lists_.data(); }
  const FacePack* packs() const { return packs_.data(); }

  // For cell_at and move_direction by vectors.
  PointF low;          ///< corner of the first cell [µm]
  float per_cell = 0;  ///< [1/µm]
  float last_column = 0;
  float last_row = 0;
  float short_move = 0;  ///< [µm]
  std::size_t columns = 1;

 private:
  friend class FaceGridBuilder;

  std::vector<std::uint32_t> lists_;
  std::vector<FacePack> packs_;  ///< shared by cells with the same faces
};

}  // namespace microswarm
