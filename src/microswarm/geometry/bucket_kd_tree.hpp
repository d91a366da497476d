// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace microswarm {

/// Growing set of points of some dimension, single precision, with exact nearest-neighbour queries:
/// a kd-tree with buckets of 64 points that are looked through with the widest vectors of the
/// machine. A full bucket is halved at its median; a tree that gets lopsided is built anew.
/// Distances are the sums of squares in the order of the coordinates, in single precision; ties go
/// to the lower index, so that answers depend neither on the tree nor on the machine. Queries are
/// safe to run in several threads.
class BucketKdTree {
 public:
  static constexpr std::size_t most_dimensions = 16;

  /// `dimension` is 1 to most_dimensions.
  explicit BucketKdTree(std::size_t dimension);

  /// Adds a point; coordinates are finite and below 1e17. Its index is the number of points before.
  void add(std::span<const float> point);
  std::size_t size() const { return size_; }
  std::size_t dimension() const { return dimension_; }
  /// Index of the nearest point; the set must not be empty.
  std::uint32_t nearest(std::span<const float> point) const;
  /// Bytes of memory in use for the points and the tree.
  std::size_t bytes() const;

  static constexpr std::size_t bucket_size = 64;
  static constexpr std::uint32_t none = ~0u;

  /// Coordinates of 16 points in one dimension.
  struct alignas(64) Row {
    static constexpr std::size_t size = 16;
    std::array<float, size> x;
  };
  /// Inner node: points below `split` are in `child`, the others in the node after it. Leaf: `axis`
  /// is the dimension of the space, `child` a bucket.
  struct Node {
    float split = 0;
    std::uint32_t axis = 0;
    std::uint32_t child = 0;
  };
  struct Bucket {
    std::array<std::uint32_t, bucket_size> points;  ///< ascending
    std::array<float, most_dimensions> low, high;   ///< of its points, in each dimension
    std::uint32_t count = 0;
    std::uint32_t next = none;  ///< more points, all in the same place
  };
  /// What a query reads.
  struct View {
    std::size_t dimension;
    const Node* nodes;
    const Bucket* buckets;
    const Row* rows;
  };

 private:
  static constexpr std::size_t rows_a_line = bucket_size / Row::size;

  View view() const { return {dimension_, nodes_.data(), buckets_.data(), rows_.data()}; }
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
  void include(Bucket& bucket, const Bucket& other) const;
  std::size_t widest_axis(std::uint32_t bucket) const;
  void rebuild();
  void build(std::uint32_t node, std::span<std::uint32_t> points, const std::vector<float>& all);

  std::size_t dimension_;
  std::size_t size_ = 0;
  std::size_t size_at_rebuild_ = 0;
  std::vector<Node> nodes_;
  std::vector<Bucket> buckets_;
  std::vector<Row> rows_;
};

}  // namespace microswarm
