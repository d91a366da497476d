// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "microswarm/geometry/shapes.hpp"

namespace microswarm {

/// Stack of wall edges, or of discs, in flat arrays that are searched with vectors of any width.
/// The result does not depend on the width. The field painter narrows it down block by block.
class WallCandidates {
 public:
  enum class Kind { edges, discs };
  /// A block, seen from its centre: its half diagonal and the distance [µm] to what is nearest. If
  /// that is farther than the whole diagonal, also the vector to its nearest point.
  struct Bound {
    double half, nearest;
    Vec2 towards{};
    bool is_far() const { return nearest - half > half; }
  };
  /// Arrays of an edge from (x, y) along (u, v), or of a disc around (x, y), whose u and v are 0;
  /// of the measure taken, which is the squared distance of an edge or the distance of a disc; and
  /// of the walls' numbers.
  struct View {
    double *x, *y, *u, *v, *per_length2, *radius, *measure;
    std::uint32_t* wall;
  };

  explicit WallCandidates(Kind kind) : kind_(kind) {}

  std::size_t size() const { return size_; }
  /// The walls' numbers, from `first` on.
  std::span<const std::uint32_t> walls(std::size_t first) const {
    return {wall_.data() + first, size_ - first};
  }
  /// An edge, or a disc around core.a.
  void push(const Segment& core, double radius, std::uint32_t wall);
  /// Drops all but the first `size`.
  void cut(std::size_t size) { size_ = size; }

  /// Distance [µm] from `p` to the nearest of those from `first` on, negative in a disc; infinity
  /// if there is none.
  double measure(Vec2 p, std::size_t first);
  /// Bound of a block with this half diagonal around that point.
  Bound bound(double half) const;
  /// Pushes copies of those measured last that can be nearest somewhere in the block.
  void push_rivals(const Bound& bound);

 private:
  void reserve(std::size_t n);
  View view(std::size_t first);
  Vec2 towards_nearest() const;

  Kind kind_;
  std::size_t size_ = 0;
  Vec2 measured_from_;
  std::size_t first_measured_ = 0;
  double min_measure_ = 0;  ///< measure
  double nearest_ = 0;      ///< its distance [µm]
  std::vector<double> x_, y_, u_, v_, per_length2_, radius_, measure_;
  std::vector<std::uint32_t> wall_;
};

}  // namespace microswarm
