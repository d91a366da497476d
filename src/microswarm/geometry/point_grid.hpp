// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "microswarm/geometry/shapes.hpp"

namespace microswarm {

/// Growing set of points in the plane with exact nearest-neighbour and radius queries. It is a
/// bucket quadtree: cells are split where points are dense, so empty regions and clusters cost
/// little, independent of the order of insertion. A point's index is its position in the order of
/// insertion. Ties go to the lower index, so answers do not depend on the grid. Queries are
/// thread-safe.
class PointGrid {
 public:
  /// Points are expected, but not required, to lie in `box`.
  explicit PointGrid(const Box& box);

  void add(Vec2 p);
  /// Removes the points, keeps the box and the memory.
  void clear();
  std::size_t size() const { return points_.size(); }
  bool empty() const { return points_.empty(); }
  Vec2 operator[](std::size_t i) const { return points_[i]; }

  /// Index of the nearest point; the set must not be empty.
  std::uint32_t nearest(Vec2 p) const;
  /// Appends the indices of all points within `radius` (inclusive) to `out`, ascending.
  void within(Vec2 p, double radius, std::vector<std::uint32_t>& out) const;

 private:
  /// A cell: nothing, a bucket or an inner node.
  using Child = std::int32_t;
  static constexpr Child nothing = -1;
  static constexpr std::uint32_t bucket_size = 32;

  /// Four quarters around the centre: bit 0 means right of it, bit 1 above.
  struct Node {
    Vec2 centre;
    std::array<Child, 4> quarters{nothing, nothing, nothing, nothing};

    int find_quarter(Vec2 p) const { return (p.x >= centre.x) + 2 * (p.y >= centre.y); }
  };
  struct Bucket {
    Box box;
    std::array<double, bucket_size> x;
    std::array<double, bucket_size> y;
    std::array<std::uint32_t, bucket_size> points;
    std::uint32_t count = 0;
    /// Bucket with more points at the same position, which no split can separate.
    Child overflow = nothing;
  };
  struct Found {
    double squared;
    std::uint32_t point;
  };

  void start(const Box& box);
  void insert(std::uint32_t point);
  Child split(Child bucket, Vec2 centre);
  Child new_bucket();
  void append(Child bucket, std::uint32_t point);
  void search(const Node& node, Vec2 p, Vec2 offset, Found& best) const;
  void scan(const Bucket& bucket, Vec2 p, Found& best) const;
  void collect(Child child, Vec2 p, double radius, std::vector<std::uint32_t>& out) const;

  static bool is_node(Child c) { return (c & 1) != 0; }

  Box box_;
  Vec2 centre_;
  double half_ = 1;
  Child root_ = nothing;
  std::vector<Vec2> points_;
  std::vector<Node> nodes_;
  std::vector<Bucket> buckets_;
};

}  // namespace microswarm
