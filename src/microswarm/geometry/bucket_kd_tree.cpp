// SPDX-License-Identifier: Apache-2.0
#include "microswarm/geometry/bucket_kd_tree.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "microswarm/geometry/bucket_kd_tree.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h.
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace microswarm {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

class NearestSearch {
 public:
  NearestSearch(const BucketKdTree::View& tree, const float* point) : tree_(tree), point_(point) {}

  std::uint32_t run() {
    visit(0);
    return best_;
  }

 private:
  using Tag = hn::CappedTag<float, BucketKdTree::Row::size>;
  using V = hn::Vec<Tag>;

  // Visits the nearer child first.
  void visit(std::uint32_t index) {
    const BucketKdTree::Node node = tree_.nodes[index];
    if (node.axis == tree_.dimension) return look_through(node.child);
    float near = square_to_box(node.child);
    float far = square_to_box(node.child + 1);
    std::uint32_t first = 0;
    if (far < near) {
      std::swap(near, far);
      first = 1;
    }
    if (is_too_far(near)) return;
    visit(node.child + first);
    if (!is_too_far(far)) visit(node.child + 1 - first);
  }

  /// Leaves room for the rounding of both squares.
  bool is_too_far(float square) const { return square * (1 - 1e-5f) > min_square_; }

  void look_through(std::uint32_t index) {
    for (; index != BucketKdTree::none; index = tree_.buckets[index].next)
      scan(tree_.buckets[index], tree_.rows + index * tree_.dimension * rows_a_line);
  }

  float square_to_box(std::uint32_t node) const {
    const hn::CappedTag<float, BucketKdTree::BoxRow::size> d;
    const std::size_t width = tree_.box_rows * BucketKdTree::BoxRow::size;
    const float* low = tree_.boxes[2 * tree_.box_rows * node].x.data();
    auto sum = hn::Zero(d);
    for (std::size_t k = 0; k < width; k += hn::Lanes(d)) {
      const auto p = hn::Load(d, point_ + k);
      const auto below = hn::Sub(hn::Load(d, low + k), p);
      const auto above = hn::Sub(p, hn::Load(d, low + width + k));
      const auto out = hn::Max(hn::Max(below, above), hn::Zero(d));
      sum = hn::Add(sum, hn::Mul(out, out));
    }
    return hn::GetLane(hn::SumOfLanes(d, sum));
  }

  void scan(const BucketKdTree::Bucket& bucket, const BucketKdTree::Row* rows) {
    const Tag d;
    const std::size_t lanes = hn::Lanes(d);
    HWY_ALIGN float squares[BucketKdTree::bucket_size];
    V least = hn::Set(d, std::numeric_limits<float>::infinity());
    const V limit = hn::Set(d, min_square_);
    const std::size_t half = (tree_.dimension + 1) / 2;
    const float* x = rows->x.data();
    for (std::size_t i = 0; i < bucket.count; i += 2 * lanes) {
      V a = hn::Zero(d), b = hn::Zero(d);
      const auto add_axes = [&](std::size_t first, std::size_t end) HWY_ATTR {
        for (std::size_t axis = first; axis < end; ++axis) {
          const V p = hn::Set(d, point_[axis]);
          const float* line = x + axis * BucketKdTree::bucket_size + i;
          const V da = hn::Sub(hn::Load(d, line), p);
          const V db = hn::Sub(hn::Load(d, line + lanes), p);
          a = hn::Add(a, hn::Mul(da, da));
          b = hn::Add(b, hn::Mul(db, db));
        }
      };
      add_axes(0, half);
      // A half sum above the limit cannot become the minimum, so it is not completed.
      if (!hn::AllTrue(d, hn::Gt(hn::Min(a, b), limit))) add_axes(half, tree_.dimension);
      hn::Store(a, d, squares + i);
      hn::Store(b, d, squares + i + lanes);
      least = hn::Min(least, hn::Min(a, b));
    }
    const float min_here = hn::GetLane(hn::MinOfLanes(d, least));
    if (min_here > min_square_) return;
    const auto at = std::find(squares, squares + bucket.count, min_here) - squares;
    const std::uint32_t point = bucket.points[static_cast<std::size_t>(at)];
    if (min_here < min_square_ || point < best_) best_ = point;
    min_square_ = min_here;
  }

  static constexpr std::size_t rows_a_line = BucketKdTree::bucket_size / BucketKdTree::Row::size;

  const BucketKdTree::View& tree_;
  const float* point_;
  float min_square_ = std::numeric_limits<float>::infinity();
  std::uint32_t best_ = BucketKdTree::none;
};

std::uint32_t nearest_here(const BucketKdTree::View& tree, const float* point) {
  return NearestSearch(tree, point).run();
}

}  // namespace HWY_NAMESPACE
}  // namespace microswarm
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace microswarm {

HWY_EXPORT(nearest_here);

namespace {

/// Coordinate of unused lanes: beyond any point, with a finite square.
constexpr float far_away = 1e18f;
/// A deeper tree is rebuilt, unless that was done recently.
constexpr int deepest_tree = 48;

/// Grows by an eighth where std::vector would double: most of the memory is here.
template <class T>
void make_room(std::vector<T>& all, std::size_t more) {
  const std::size_t size = all.size() + more;
  if (size > all.capacity()) all.reserve(size + size / 8);
}

}  // namespace

BucketKdTree::BucketKdTree(std::size_t dimension)
    : dimension_(dimension), box_rows_((dimension + BoxRow::size - 1) / BoxRow::size) {
  assert(dimension >= 1 && dimension <= max_dimensions);
  new_nodes(1);
  nodes_[0].child = new_bucket();
}

std::uint32_t BucketKdTree::nearest(std::span<const float> point) const {
  assert(size_ > 0 && point.size() == dimension_);
  alignas(64) std::array<float, max_dimensions> padded{};
  std::copy(point.begin(), point.end(), padded.begin());
  return HWY_DYNAMIC_DISPATCH(nearest_here)(view(), padded.data());
}

std::size_t BucketKdTree::bytes() const {
  return nodes_.capacity() * sizeof(Node) + boxes_.capacity() * sizeof(BoxRow) +
         buckets_.capacity() * sizeof(Bucket) + rows_.capacity() * sizeof(Row);
}

/// Adds leaves without a bucket and without points; returns the first one's index.
std::uint32_t BucketKdTree::new_nodes(std::size_t count) {
  const auto first = static_cast<std::uint32_t>(nodes_.size());
  nodes_.resize(nodes_.size() + count, {0, static_cast<std::uint32_t>(dimension_), none});
  boxes_.resize(2 * box_rows_ * nodes_.size());
  for (std::uint32_t node = first; node < nodes_.size(); ++node) {
    std::fill_n(low(node), dimension_, far_away);
    std::fill_n(high(node), dimension_, -far_away);
  }
  return first;
}

void BucketKdTree::include(std::uint32_t node, const float* point) {
  float* least = low(node);
  float* most = high(node);
  for (std::size_t k = 0; k < dimension_; ++k) {
    least[k] = std::min(least[k], point[k]);
    most[k] = std::max(most[k], point[k]);
  }
}

std::uint32_t BucketKdTree::new_bucket() {
  make_room(buckets_, 1);
  make_room(rows_, dimension_ * rows_a_line);
  buckets_.emplace_back();
  rows_.resize(rows_.size() + dimension_ * rows_a_line);
  const auto bucket = static_cast<std::uint32_t>(buckets_.size() - 1);
  clear(bucket);
  return bucket;
}

void BucketKdTree::clear(std::uint32_t index) {
  Bucket& bucket = buckets_[index];
  bucket.count = 0;
  bucket.next = none;
  std::fill_n(line(index, 0), dimension_ * bucket_size, far_away);
}

void BucketKdTree::append(std::uint32_t index, const float* point, std::uint32_t number) {
  Bucket& bucket = buckets_[index];
  for (std::size_t axis = 0; axis < dimension_; ++axis)
    line(index, axis)[bucket.count] = point[axis];
  bucket.points[bucket.count++] = number;
}

void BucketKdTree::add(std::span<const float> point) {
  assert(point.size() == dimension_ && size_ < none);
  assert(std::ranges::all_of(point, [](float x) { return std::abs(x) < 1e17f; }));
  const auto number = static_cast<std::uint32_t>(size_++);
  std::uint32_t node = 0;
  include(node, point.data());
  for (int depth = 0;; ++depth) {
    while (nodes_[node].axis != dimension_) {
      const Node& n = nodes_[node];
      node = n.child + (point[n.axis] < n.split ? 0 : 1);
      include(node, point.data());
      ++depth;
    }
    const std::uint32_t bucket = nodes_[node].child;
    if (buckets_[bucket].count < bucket_size) return append(bucket, point.data(), number);
    if (depth >= deepest_tree && size_ - 1 > size_at_rebuild_ + size_at_rebuild_ / 8) {
      rebuild();
      include(0, point.data());
      node = 0;
      depth = 0;
      continue;
    }
    if (!split(node)) spill(bucket);
  }
}

/// Moves the points of a full bucket, all at the same position, to an overflow bucket.
void BucketKdTree::spill(std::uint32_t index) {
  const std::uint32_t more = new_bucket();
  std::copy_n(line(index, 0), dimension_ * bucket_size, line(more, 0));
  buckets_[more] = buckets_[index];
  buckets_[index].count = 0;
  buckets_[index].next = more;
}

/// Splits a full bucket; false if all its points are at the same position.
bool BucketKdTree::split(std::uint32_t node) {
  const std::uint32_t full = nodes_[node].child;
  const std::size_t axis = widest_axis(full);
  const std::uint32_t behind = buckets_[full].next;
  std::vector<float> values(line(full, axis), line(full, axis) + bucket_size);
  if (behind != none) values.push_back(line(behind, axis)[0]);
  std::ranges::sort(values);
  if (!(values.front() < values.back())) return false;
  float middle = values[values.size() / 2];
  if (middle == values[0]) middle = *std::ranges::upper_bound(values, middle);

  const Bucket old = buckets_[full];
  const std::vector<float> points(line(full, 0), line(full, 0) + dimension_ * bucket_size);
  const std::array<std::uint32_t, 2> halves{full, new_bucket()};
  clear(full);
  const std::uint32_t child = new_nodes(2);
  for (std::uint32_t half = 0; half < 2; ++half) nodes_[child + half].child = halves[half];
  nodes_[node] = {middle, static_cast<std::uint32_t>(axis), child};
  std::array<float, max_dimensions> point;
  for (std::size_t i = 0; i < bucket_size; ++i) {
    for (std::size_t k = 0; k < dimension_; ++k) point[k] = points[k * bucket_size + i];
    const std::uint32_t half = point[axis] < middle ? 0 : 1;
    append(halves[half], point.data(), old.points[i]);
    include(child + half, point.data());
  }
  if (behind != none) {
    for (std::size_t k = 0; k < dimension_; ++k) point[k] = line(behind, k)[0];
    const std::uint32_t half = point[axis] < middle ? 0 : 1;
    buckets_[halves[half]].next = behind;
    include(child + half, point.data());
  }
  return true;
}

/// Widest axis of a full bucket and its overflow.
std::size_t BucketKdTree::widest_axis(std::uint32_t bucket) const {
  const std::uint32_t behind = buckets_[bucket].next;
  std::size_t widest = 0;
  float most = 0;
  for (std::size_t k = 0; k < dimension_; ++k) {
    const float* x = line(bucket, k);
    auto [low, high] = std::ranges::minmax(std::span(x, bucket_size));
    if (behind != none) {
      low = std::min(low, line(behind, k)[0]);
      high = std::max(high, line(behind, k)[0]);
    }
    if (high - low <= most) continue;
    most = high - low;
    widest = k;
  }
  return widest;
}

void BucketKdTree::rebuild() {
  std::vector<float> all(dimension_ * size_);
  for (std::uint32_t b = 0; b < buckets_.size(); ++b)
    for (std::uint32_t i = 0; i < buckets_[b].count; ++i)
      for (std::size_t k = 0; k < dimension_; ++k)
        all[dimension_ * buckets_[b].points[i] + k] = line(b, k)[i];
  std::vector<std::uint32_t> points(size_ - 1);
  std::iota(points.begin(), points.end(), 0u);
  nodes_.clear();
  boxes_.clear();
  buckets_.clear();
  rows_.clear();
  new_nodes(1);
  build(0, points, all);
  size_at_rebuild_ = size_;
}

/// Builds a balanced tree of these points below `node`.
void BucketKdTree::build(std::uint32_t node, std::span<std::uint32_t> points,
                         const std::vector<float>& all) {
  const auto at = [&](std::uint32_t point, std::size_t k) { return all[dimension_ * point + k]; };
  std::size_t axis = 0;
  float widest = 0;
  for (std::size_t k = 0; k < dimension_; ++k) {
    const auto [least, most] =
        std::ranges::minmax(points, {}, [&](std::uint32_t point) { return at(point, k); });
    low(node)[k] = at(least, k);
    high(node)[k] = at(most, k);
    const float width = at(most, k) - at(least, k);
    if (width > widest) {
      widest = width;
      axis = k;
    }
  }
  if (points.size() <= bucket_size - bucket_size / 4 || widest == 0) {
    std::ranges::sort(points);
    nodes_[node] = {0, static_cast<std::uint32_t>(dimension_), new_bucket()};
    for (const std::uint32_t point : points) {
      if (buckets_[nodes_[node].child].count == bucket_size) spill(nodes_[node].child);
      append(nodes_[node].child, &all[dimension_ * point], point);
    }
    return;
  }
  const auto less = [&](std::uint32_t a, std::uint32_t b) { return at(a, axis) < at(b, axis); };
  const auto half = points.begin() + static_cast<std::ptrdiff_t>(points.size() / 2);
  std::ranges::nth_element(points, half, less);
  float middle = at(*half, axis);
  const auto is_left = [&](std::uint32_t point) { return at(point, axis) < middle; };
  auto left = std::partition(points.begin(), points.end(), is_left);
  if (left == points.begin()) {
    middle = std::nextafter(middle, far_away);
    left = std::partition(points.begin(), points.end(), is_left);
  }
  const std::uint32_t child = new_nodes(2);
  nodes_[node] = {middle, static_cast<std::uint32_t>(axis), child};
  build(child, {points.begin(), left}, all);
  build(child + 1, {left, points.end()}, all);
}

}  // namespace microswarm
#endif
