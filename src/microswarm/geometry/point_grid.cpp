// SPDX-License-Identifier: Apache-2.0
#include "microswarm/geometry/point_grid.hpp"

#include <cassert>

#include "microswarm/core/maths/infinity.hpp"

namespace microswarm {
namespace {

/// Cells of this depth are not split further.
constexpr int deepest_cell = 60;

double squared(double x) { return x * x; }

}  // namespace

PointGrid::PointGrid(const Box& box) : box_(box) { start(box_); }

void PointGrid::clear() {
  points_.clear();
  start(box_);
}

/// Creates an empty tree over the square around `box`.
void PointGrid::start(const Box& box) {
  nodes_.clear();
  buckets_.clear();
  root_ = nothing;
  const double side = std::max(box.width(), box.height());
  const bool is_usable = std::isfinite(side) && side > 0;
  half_ = is_usable ? side / 2 : 1;
  centre_ = is_usable ? box.centre() : Vec2{};
}

void PointGrid::add(Vec2 p) {
  assert(is_finite(p) && size() < (1u << 30));
  points_.push_back(p);
  if (std::max(std::abs(p.x - centre_.x), std::abs(p.y - centre_.y)) <= half_) {
    insert(static_cast<std::uint32_t>(size() - 1));
    return;
  }
  // A square large enough that this stays rare.
  const Box all = bounding_box(points_);
  start(all.grown(0.5 * std::max(all.width(), all.height())));
  for (std::uint32_t i = 0; i < size(); ++i) insert(i);
}

PointGrid::Child PointGrid::new_bucket() {
  buckets_.emplace_back();
  return static_cast<Child>(2 * (buckets_.size() - 1));
}

void PointGrid::append(Child child, std::uint32_t point) {
  if (buckets_[child / 2].count == bucket_size) {
    const Child more = new_bucket();
    std::swap(buckets_[more / 2], buckets_[child / 2]);
    buckets_[child / 2].overflow = more;
    buckets_[child / 2].box = buckets_[more / 2].box;
  }
  Bucket& bucket = buckets_[child / 2];
  bucket.box.include(points_[point]);
  bucket.x[bucket.count] = points_[point].x;
  bucket.y[bucket.count] = points_[point].y;
  bucket.points[bucket.count++] = point;
}

void PointGrid::insert(std::uint32_t point) {
  const Vec2 p = points_[point];
  Child parent = nothing;
  int quarter = 0;
  Child child = root_;
  Vec2 centre = centre_;
  double half = half_;
  auto link = [&](Child c) {
    child = c;
    (parent == nothing ? root_ : nodes_[parent / 2].quarters[quarter]) = c;
  };
  for (int depth = 0;; ++depth) {
    if (child == nothing) link(new_bucket());
    if (!is_node(child)) {
      if (buckets_[child / 2].count < bucket_size || depth >= deepest_cell)
        return append(child, point);
      link(split(child, centre));
    }
    parent = child;
    quarter = nodes_[child / 2].find_quarter(p);
    child = nodes_[child / 2].quarters[quarter];
    half *= 0.5;
    centre += Vec2{quarter % 2 == 0 ? -half : half, quarter / 2 == 0 ? -half : half};
  }
}

/// Distributes the points of a full bucket to the quarters around `centre` and reuses the bucket.
PointGrid::Child PointGrid::split(Child child, Vec2 centre) {
  Node node{centre};
  const Bucket old = buckets_[child / 2];
  buckets_[child / 2].count = 0;
  buckets_[child / 2].box = {};
  Child spare = child;
  for (const std::uint32_t point : old.points) {
    Child& quarter = node.quarters[node.find_quarter(points_[point])];
    if (quarter == nothing) {
      quarter = spare == nothing ? new_bucket() : spare;
      spare = nothing;
    }
    append(quarter, point);
  }
  nodes_.push_back(node);
  return static_cast<Child>(2 * (nodes_.size() - 1) + 1);
}

void PointGrid::scan(const Bucket& bucket, Vec2 p, Found& best) const {
  const Vec2 beside{std::max({bucket.box.lo.x - p.x, p.x - bucket.box.hi.x, 0.0}),
                    std::max({bucket.box.lo.y - p.y, p.y - bucket.box.hi.y, 0.0})};
  if (squared_norm(beside) > best.squared) return;
  std::array<double, bucket_size> squares;
  for (std::uint32_t i = 0; i < bucket_size; ++i) {
    squares[i] = squared(bucket.x[i] - p.x) + squared(bucket.y[i] - p.y);
  }
  for (std::uint32_t i = 0; i < bucket.count; ++i) {
    if (squares[i] > best.squared) continue;
    if (squares[i] < best.squared || bucket.points[i] < best.point) {
      best = {squares[i], bucket.points[i]};
    }
  }
  if (bucket.overflow != nothing) scan(buckets_[bucket.overflow / 2], p, best);
}

// `offset` is the distance of p from the cell in x and y. Rounding is monotone, so no point in the
// cell can be computed to be nearer.
void PointGrid::search(const Node& node, Vec2 p, Vec2 offset, Found& best) const {
  auto visit = [&](int quarter, Vec2 beside) {
    const Child child = node.quarters[quarter];
    if (child == nothing || squared_norm(beside) > best.squared) return;
    if (is_node(child)) {
      search(nodes_[child / 2], p, beside, best);
    } else {
      scan(buckets_[child / 2], p, best);
    }
  };
  const Vec2 to_p = p - node.centre;
  const int own = node.find_quarter(p);
  const Vec2 across{std::max(offset.x, std::abs(to_p.x)), std::max(offset.y, std::abs(to_p.y))};
  const bool level_first = std::abs(to_p.x) < std::abs(to_p.y);
  visit(own, offset);
  if (level_first) visit(own ^ 1, {across.x, offset.y});
  visit(own ^ 2, {offset.x, across.y});
  if (!level_first) visit(own ^ 1, {across.x, offset.y});
  visit(own ^ 3, across);
}

std::uint32_t PointGrid::nearest(Vec2 p) const {
  assert(!empty());
  Found best{infinity, ~0u};
  if (is_node(root_)) {
    search(nodes_[root_ / 2], p, {}, best);
  } else {
    scan(buckets_[root_ / 2], p, best);
  }
  return best.point;
}

void PointGrid::collect(Child child, Vec2 p, double radius, std::vector<std::uint32_t>& out) const {
  if (child == nothing) return;
  if (!is_node(child)) {
    const Bucket& bucket = buckets_[child / 2];
    for (std::uint32_t i = 0; i < bucket.count; ++i) {
      const double d = squared(bucket.x[i] - p.x) + squared(bucket.y[i] - p.y);
      if (d <= radius * radius) out.push_back(bucket.points[i]);
    }
    return collect(bucket.overflow, p, radius, out);
  }
  const Node& node = nodes_[child / 2];
  const Vec2 to_p = p - node.centre;
  const bool in[2][2] = {{to_p.x <= radius, to_p.x >= -radius},
                         {to_p.y <= radius, to_p.y >= -radius}};
  for (int q = 0; q < 4; ++q) {
    if (in[0][q & 1] && in[1][q >> 1]) collect(node.quarters[q], p, radius, out);
  }
}

void PointGrid::within(Vec2 p, double radius, std::vector<std::uint32_t>& out) const {
  const auto start = static_cast<std::ptrdiff_t>(out.size());
  collect(root_, p, radius, out);
  std::sort(out.begin() + start, out.end());
}

}  // namespace microswarm
