// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <span>

#include "microswarm/swarm/robots/contact_rule.hpp"
#include "microswarm/swarm/robots/wall_faces.hpp"

namespace microswarm {

/// Moves of robots: one for all, or one each.
class RobotMoves {
 public:
  explicit RobotMoves(const PointF& same) : moves_(&same), stride_(0) {}
  explicit RobotMoves(std::span<const PointF> each) : moves_(each.data()), stride_(1) {}
  /// Writes the moves of `count` robots from index `first` on.
  void copy(std::size_t first, std::size_t count, float* x, float* y) const {
    if (stride_ == 0) {
      std::fill_n(x, count, moves_->x);
      std::fill_n(y, count, moves_->y);
      return;
    }
    for (std::size_t i = 0; i < count; ++i) {
      const PointF move = moves_[first + i];
      x[i] = move.x;
      y[i] = move.y;
    }
  }

 private:
  const PointF* moves_;
  std::size_t stride_;
};

/// Moves all robots with the machine's widest vectors; the result has the same bits as ContactMoves
/// with WallFaces::first_contact on all machines. Maps with few faces process many robots per
/// vector, others the faces near each robot.
void step_lanes(const WallFaces& faces, const RobotMoves& moves, ContactRule rule,
                std::span<float> x, std::span<float> y);

}  // namespace microswarm
