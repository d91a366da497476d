// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "microswarm/geometry/edge_grid.hpp"
#include "microswarm/geometry/shapes.hpp"

namespace microswarm {

/// Decomposition of the plane into trapezoids by vertical walls through the ends of segments, each
/// wall from an end up and down to the next segment. Of points with equal x the upper one counts
/// as farther right, which replaces every special case. Segments may touch; where they cross, some
/// cells are wrong. Immutable, shared by threads.
class Trapezoids {
 public:
  static constexpr std::uint32_t none = ~0u;

  /// Convex cell between two segments and the walls through two points. Neighbours are reached
  /// through the wall above or below its point.
  struct Cell {
    std::uint32_t bottom = none;  ///< segment; none: the cell is unbounded
    std::uint32_t top = none;
    std::uint32_t left = none;  ///< point
    std::uint32_t right = none;
    std::uint32_t left_below = none;  ///< cell
    std::uint32_t left_above = none;
    std::uint32_t right_below = none;
    std::uint32_t right_above = none;
  };

  Trapezoids() = default;
  explicit Trapezoids(std::vector<Segment> segments);

  std::span<const Cell> cells() const { return cells_; }
  /// The different ends of the segments, from left to right.
  std::span<const Vec2> points() const { return points_; }
  /// Each from left to right.
  std::span<const Segment> segments() const { return segments_; }
  /// Number of a point; none if it is no end of a segment.
  std::uint32_t point_at(Vec2 p) const;
  /// The cell that holds `p`, the one above if it is on a segment.
  std::uint32_t cell_at(Vec2 p) const;

  /// Range of cell numbers, `last` excluded.
  struct Range {
    std::uint32_t first, last;
  };
  /// The cells that begin at a point, and those that end at it.
  Range cells_right_of(std::uint32_t point) const {
    return {first_right_of_[point], first_right_of_[point + 1]};
  }
  std::span<const std::uint32_t> cells_left_of(std::uint32_t point) const {
    return std::span(ends_).subspan(first_left_of_[point],
                                    first_left_of_[point + 1] - first_left_of_[point]);
  }
  /// The cells that touch a quadrilateral of segments from outside, given the numbers of its
  /// corners, from left to right.
  std::vector<std::uint32_t> cells_around(std::span<const std::uint32_t, 4> quadrilateral) const;
  /// A box around a cell; infinite where the cell is.
  Box bounding_box(std::uint32_t cell) const;

 private:
  class Sweep;

  std::vector<Segment> segments_;  ///< from left to right
  std::vector<Vec2> points_;
  std::vector<Cell> cells_;
  std::vector<std::uint32_t> first_right_of_;  ///< of each point: cells that begin at it
  std::vector<std::uint32_t> first_left_of_;   ///< of each point: in ends_, cells that end at it
  std::vector<std::uint32_t> ends_;
  std::vector<std::uint32_t> first_above_;  ///< of each segment and of none: in above_
  std::vector<std::uint32_t> above_;        ///< cells above a segment, from left to right
  EdgeGrid grid_;
};

/// Order from left to right, of equal x from below.
inline bool is_left_of(Vec2 a, Vec2 b) { return a.x < b.x || (a.x == b.x && a.y < b.y); }

}  // namespace microswarm
