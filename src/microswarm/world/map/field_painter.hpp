// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "microswarm/world/map/clearance_field.hpp"

namespace microswarm {

/// Fills a clearance field. A block of cells keeps the list of edges and discs that can be nearest
/// to one of its points. Its quarters narrow the list down until only a few remain to be tested for
/// each cell.
/// Let f be nearest to the block's centre, at distance D, e at D + g, and h the half diagonal. The
/// difference of the distances to e and f changes with slope at most |u_e − u_f|, where u are the
/// unit vectors towards the nearest points q_e and q_f. The slope is therefore at most |q_e − q_f|
/// / (D − h) and at most 2. Within the block the nearest points move by at most h, since projection
/// onto a convex set does not increase distances. Hence e is never the nearest if g > h · min(2,
/// (|q_e − q_f| + 2h) / (D − h)).
class FieldPainter {
 public:
  FieldPainter(const Box& bounds, const BodySet& bodies, ClearanceField& field);
  void paint();
  /// Bound on the rounding error of a distance computed here [µm].
  double rounding() const { return rounding_; }

 private:
  /// Rectangle of cells; column and row ranges are half-open.
  struct Block {
    int left, right, bottom, top;
    int cells() const { return (right - left) * (top - bottom); }
  };
  /// Whether a block is in a polygon.
  enum class Solid { unknown, no, yes };
  /// Stack in flat arrays. Edges run from (x, y) along (u, v); discs have radius >= 0 and along =
  /// 0.
  struct Candidates {
    std::vector<double> x, y, u, v, per_length2, radius;
    std::vector<std::uint32_t> wall;
    std::size_t size = 0;

    bool is_disc(std::size_t i) const { return radius[i] >= 0; }
    void reserve(std::size_t n);
    void push(Segment core, double disc_radius, std::uint32_t index);
    void push_copy(std::size_t i);
  };
  struct Nearest {
    double distance;
    std::size_t candidate;
  };
  struct NearestOfEach {
    Nearest edge;
    Nearest disc;
  };

  Vec2 point(double column, double row) const;
  double half_diagonal(const Block& block) const;
  NearestOfEach measure(Vec2 p, std::size_t first, std::size_t last);
  Vec2 towards(Vec2 p, std::size_t candidate) const;
  bool can_be_nearest(Vec2 centre, double half, std::size_t candidate, double distance,
                      const Nearest& nearest) const;
  Solid narrow(const Block& block, std::size_t first, std::size_t last, Solid solid);
  void paint(const Block& block, std::size_t first, Solid solid);
  void paint_cells(const Block& block, std::size_t first, Solid solid);
  void paint_cell(int column, int row, std::size_t first, Solid solid);
  void store_list(std::size_t first);

  Box bounds_;
  const BodySet& bodies_;
  ClearanceField& field_;
  double rounding_ = 0;
  ClearanceField::Nearest list_;  ///< list of the cells being painted
  std::uint32_t last_list_ = 0;   ///< start of the last list stored
  Candidates candidates_;
  std::vector<double> distances_;
};

}  // namespace microswarm
