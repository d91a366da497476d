// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "microswarm/world/map/clearance_field.hpp"
#include "microswarm/world/map/wall_candidates.hpp"

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
  /// Start of a block's candidates on the stacks.
  struct Start {
    std::size_t edges, discs;
  };
  /// Distances [µm] from a block's centre to the nearest edge and disc; infinity if there is none.
  struct Look {
    double edge, disc;
    Solid solid;
  };

  Vec2 point(double column, double row) const;
  Vec2 block_centre(const Block& block) const;
  double half_diagonal(const Block& block) const;
  Start top() const { return {edges_.size(), discs_.size()}; }
  std::size_t count_from(Start start) const;
  void cut(Start start);

  Look look(const Block& block, Start start, Solid solid);
  Look narrow(const Block& block, Start start, Solid solid);
  void paint(const Block& block, Start start, Solid solid);
  void paint_cells(const Block& block, Start start, Solid solid);
  void paint_cell(int column, int row, const Look& look);
  void store_list(Start start);

  Box bounds_;
  const BodySet& bodies_;
  ClearanceField& field_;
  double rounding_ = 0;
  ClearanceField::Nearest list_;  ///< list of the cells being painted
  std::uint32_t last_list_ = 0;   ///< start of the last list stored
  WallCandidates edges_{WallCandidates::Kind::edges};
  WallCandidates discs_{WallCandidates::Kind::discs};
  std::vector<std::uint32_t> walls_;  ///< of a list
};

}  // namespace microswarm
