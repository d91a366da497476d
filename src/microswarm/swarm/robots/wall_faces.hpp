// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "microswarm/swarm/robots/face_grid.hpp"
#include "microswarm/world/map/map.hpp"

namespace microswarm {

/// First face that a move meets. `time` is the fraction of the move up to the standoff from the
/// face, more than 1 if the move is free; `normal` is the face's normal.
struct FaceContact {
  float time = 2;
  PointF normal{};

  bool met() const { return time <= 1; }
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
  std::span<const FacePack> near(PointF p) const {
    return grid_.near(grid_.cell_at(p), FaceGrid::any_direction);
  }
  const FaceGrid& grid() const { return grid_; }
  /// First contact on a move of at most `reach`.
  FaceContact first_contact(PointF p, PointF move) const;

 private:
  /// Included in half_length; time_to_contact adds one guard.
  float overlap() const { return 0.5f * guard_; }
  void add_ring(std::span<const Vec2> ring);
  void add_face(Vec2 a, Vec2 b);
  void add_border(const Box& bounds);

  Vec2 origin_;
  float reach_ = 0;
  float guard_ = 0;
  std::vector<WallFace> faces_;
  FaceGrid grid_;
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
