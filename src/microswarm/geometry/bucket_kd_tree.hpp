// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace microswarm {

/// Growing point set of a given dimension in single precision, with exact nearest-neighbour
/// queries. It is a kd-tree with buckets of 128 points, which are scanned with the machine's widest
/// vectors. Every node stores the bounding box of its points, which prunes better than the
/// splitting planes where the points fill only part of their space. A full bucket is split at its
/// median; an unbalanced tree is rebuilt.
/// Squared distances are summed in the order of the coordinates, in single precision, and ties go
/// to the lower index. Answers therefore depend neither on the tree nor on the machine. Queries are
/// thread-safe.
class BucketKdTree {
 public:
  static constexpr std::size_t max_dimensions = 128;

  /// `dimension` in 1 … max_dimensions.
  explicit BucketKdTree(std::size_t dimension);

  /// Adds a point; its index is the number of points before it. Coordinates must be finite and
  /// below 1e17.
  void add(std::span<const float> point);
  std::size_t size() const { return size_; }
  std::size_t dimension() const { return dimension_; }
  /// Index of the nearest point; the set must not be empty.
  std::uint32_t nearest(std::span<const float> point) const;
  /// Memory used by the points and the tree [bytes].
  std::size_t bytes() const;

  static constexpr std::size_t bucket_size = 128;
  static constexpr std::uint32_t none = ~0u;

  /// Coordinates of 16 points in one dimension.
  struct alignas(64) Row {
    static constexpr std::size_t size = 16;
    std::array<float, size> x;
  };
  /// Inner node: points below `split` are in node `child`, the others in the node after it. Leaf:
  /// `axis` is the dimension of the space, `child` a bucket.
  struct Node {
    float split = 0;
    std::uint32_t axis = 0;
    std::uint32_t child = 0;
  };
  /// Floats of a bounding box: low corner first, then high corner, each padded with zeros to whole
  /// rows of eight.
  struct alignas(32) BoxRow {
    static constexpr std::size_t size = 8;
    std::array<float, size> x;
  };
  struct Bucket {
    std::array<std::uint32_t, bucket_size> points;  ///< ascending
    std::uint32_t count = 0;
    std::uint32_t next = none;  ///< bucket with more points at the same position
  };
  /// Read-only data of a query.
  struct View {
    std::size_t dimension;
    std::size_t box_rows;  ///< rows per corner
    const Node* nodes;
    const BoxRow* boxes;  ///< 2 box_rows per node
    const Bucket* buckets;
    const Row* rows;
  };

 private:
  static constexpr std::size_t rows_a_line = bucket_size / Row::size;

  View view() const {
    return {dimension_, box_rows_, nodes_.data(), boxes_.data(), buckets_.data(), rows_.data()};
  }
  float* low(std::uint32_t node) { return boxes_[2 * box_rows_ * node].x.data(); }
  float* high(std::uint32_t node) { return boxes_[(2 * node + 1) * box_rows_].x.data(); }
  const float* line(std::uint32_t bucket, std::size_t axis) const {
    return rows_[(bucket * dimension_ + axis) * rows_a_line].x.data();
  }
  float* line(std::uint32_t bucket, std::size_t axis) {
    return rows_[(bucket * dimension_ + axis) * rows_a_line].x.data();
  }
  std::uint32_t new_bucket();
  void clear(std::uint32_t bucket);
  void append(std::uint32_t bucket, const float* point, std::uint32_t index);
  bool split(std::uint32_t node);
  void spill(std::uint32_t bucket);
  std::uint32_t new_nodes(std::size_t count);
  void include(std::uint32_t node, const float* point);
  std::size_t widest_axis(std::uint32_t bucket) const;
  void rebuild();
  void build(std::uint32_t node, std::span<std::uint32_t> points, const std::vector<float>& all);

  std::size_t dimension_;
  std::size_t box_rows_;
  std::size_t size_ = 0;
  std::size_t size_at_rebuild_ = 0;
  std::vector<Node> nodes_;
  std::vector<BoxRow> boxes_;
  std::vector<Bucket> buckets_;
  std::vector<Row> rows_;
};

}  // namespace microswarm
