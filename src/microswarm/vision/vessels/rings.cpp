// SPDX-License-Identifier: Apache-2.0
#include "microswarm/vision/vessels/rings.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>
#include <queue>
#include <tuple>
#include <utility>

#include "microswarm/core/maths/maths.hpp"
#include "microswarm/geometry/distance.hpp"
#include "microswarm/geometry/predicates.hpp"

namespace microswarm::vision {
namespace {

constexpr int ring_sigma = 2;               // vertices
constexpr int ring_reach = 3 * ring_sigma;  // vertices on either side
constexpr std::size_t min_smoothed = 2 * ring_reach + 4;
constexpr int max_untangling_rounds = 20;
constexpr double cells_per_bucket = 4;

/// All rings as one doubly linked list of vertices, with the edges in square buckets. An edge is
/// identified by its first vertex.
class Chains {
 public:
  Chains(const Rings& rings, double cell) : bucket_(cells_per_bucket * cell) {
    for (const auto& ring : rings) {
      const int first = static_cast<int>(points_.size());
      const int n = static_cast<int>(ring.size());
      for (int i = 0; i < n; ++i) {
        points_.push_back(ring[i]);
        next_.push_back(first + (i + 1) % n);
        previous_.push_back(first + (i + n - 1) % n);
        sizes_.push_back(n);
        heads_.push_back(first);
      }
    }
    bounds_ = bounding_box(points_);
    columns_ = points_.empty() ? 0 : column(bounds_.hi.x) + 1;
    const int rows = points_.empty() ? 0 : row(bounds_.hi.y) + 1;
    buckets_.resize(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows));
    for (int i = 0; i < size(); ++i) enter(i);
  }

  int size() const { return static_cast<int>(points_.size()); }
  Vec2 point(int i) const { return points_[i]; }
  int next(int i) const { return next_[i]; }
  int previous(int i) const { return previous_[i]; }
  int& ring_size(int i) { return sizes_[heads_[i]]; }
  bool is_in(int i) const { return next_[previous_[i]] == i; }
  Segment edge(int i) const { return {points_[i], points_[next_[i]]}; }

  void leave_out(int i) {
    next_[previous_[i]] = next_[i];
    previous_[next_[i]] = previous_[i];
    --ring_size(i);
    enter(previous_[i]);
  }

  /// Calls visit(edge) for the edges near the box, some repeatedly, until it returns false.
  template <class Visit>
  bool each_near(const Box& box, Visit&& visit) const {
    for (int r = row(box.lo.y); r <= row(box.hi.y); ++r)
      for (int c = column(box.lo.x); c <= column(box.hi.x); ++c)
        for (const int i : buckets_[r * columns_ + c])
          if (is_in(i) && !visit(i)) return false;
    return true;
  }

  /// Whether the new edge from vertex `a` to vertex `b` and the edge `i` share more than a common
  /// vertex.
  bool conflict(int a, int b, int i) const {
    const Segment s{points_[a], points_[b]};
    const int j = next_[i];
    if (i == a && j == b) return false;
    if (j == a || i == a) return folds(s.a, s.b, points_[j == a ? i : j]);
    if (i == b || j == b) return folds(s.b, s.a, points_[i == b ? j : i]);
    return intersects(s, edge(i));
  }

 private:
  static bool folds(Vec2 shared, Vec2 p, Vec2 q) {
    return orientation(p, shared, q) == 0 && dot(p - shared, q - shared) > 0;
  }
  int column(double x) const { return static_cast<int>((x - bounds_.lo.x) / bucket_); }
  int row(double y) const { return static_cast<int>((y - bounds_.lo.y) / bucket_); }
  void enter(int i) {
    const std::array<Vec2, 2> ends{points_[i], points_[next_[i]]};
    const Box box = bounding_box(ends);
    for (int r = row(box.lo.y); r <= row(box.hi.y); ++r)
      for (int c = column(box.lo.x); c <= column(box.hi.x); ++c)
        buckets_[r * columns_ + c].push_back(i);
  }

  double bucket_;
  Box bounds_;
  int columns_ = 0;
  std::vector<Vec2> points_;
  std::vector<int> next_, previous_, heads_, sizes_;
  std::vector<std::vector<int>> buckets_;
};

Box segment_box(Segment s) {
  const std::array<Vec2, 2> ends{s.a, s.b};
  return bounding_box(ends);
}

/// For each vertex of the rings in order: whether one of its two edges touches another edge.
std::vector<char> touching(const Rings& rings, double cell) {
  const Chains chains(rings, cell);
  std::vector<char> found(static_cast<std::size_t>(chains.size()), 0);
  for (int i = 0; i < chains.size(); ++i) {
    const int j = chains.next(i);
    const bool clear = chains.each_near(segment_box(chains.edge(i)),
                                        [&](int other) { return !chains.conflict(i, j, other); });
    if (!clear) found[i] = found[j] = 1;
  }
  return found;
}

std::array<double, 2 * ring_reach + 1> ring_weights() {
  std::array<double, 2 * ring_reach + 1> weights{};
  for (int k = -ring_reach; k <= ring_reach; ++k)
    weights[k + ring_reach] = maths::exp(-0.5 * k * k / (ring_sigma * ring_sigma));
  const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
  for (double& w : weights) w /= sum;
  return weights;
}

std::vector<Vec2> smoothed(const std::vector<Vec2>& ring, double limit) {
  const std::size_t n = ring.size();
  if (n < min_smoothed) return ring;
  const auto weights = ring_weights();
  std::vector<Vec2> result(n);
  for (std::size_t i = 0; i < n; ++i) {
    Vec2 mean;
    for (std::size_t k = 0; k < weights.size(); ++k)
      mean += weights[k] * ring[(i + n + k - ring_reach) % n];
    const Vec2 move = mean - ring[i];
    const double length = norm(move);
    result[i] = ring[i] + (length > limit ? limit / length : 1.0) * move;
  }
  return result;
}

/// Moves the vertices marked in `back` and their neighbours to their previous positions.
void undo(Rings& rings, const Rings& before, const std::vector<char>& back) {
  std::size_t first = 0;
  for (std::size_t r = 0; r < rings.size(); ++r) {
    const std::size_t n = rings[r].size();
    for (std::size_t i = 0; i < n; ++i)
      if (back[first + i] || back[first + (i + 1) % n] || back[first + (i + n - 1) % n])
        rings[r][i] = before[r][i];
    first += n;
  }
}

bool in_triangle(Vec2 p, Vec2 a, Vec2 b, Vec2 c) {
  const int u = orientation(a, b, p);
  const int v = orientation(b, c, p);
  const int w = orientation(c, a, p);
  return (u >= 0 && v >= 0 && w >= 0) || (u <= 0 && v <= 0 && w <= 0);
}

/// Greedy removal of vertices from chains; `successor_[i]` is the vertex after i before any
/// removal.
class Thinner {
 public:
  Thinner(Chains& chains, const Rings& rings, double tolerance)
      : chains_(chains), tolerance2_(tolerance * tolerance), version_(chains.size(), 0) {
    for (const auto& ring : rings) {
      const int first = static_cast<int>(successor_.size());
      const int n = static_cast<int>(ring.size());
      for (int i = 0; i < n; ++i) successor_.push_back(first + (i + 1) % n);
    }
    for (int i = 0; i < chains_.size(); ++i) offer(i);
  }

  void run(const Stop& stop) {
    for (int steps = 1; !queue_.empty(); ++steps) {
      if (steps % 1024 == 0 && stop()) return;
      const auto [cost, i, version] = queue_.top();
      queue_.pop();
      if (version != version_[i] || chains_.ring_size(i) <= 3 || !is_safe(i)) continue;
      const int a = chains_.previous(i);
      const int b = chains_.next(i);
      chains_.leave_out(i);
      ++version_[i];
      offer(a);
      offer(b);
    }
  }

 private:
  using Entry = std::tuple<double, int, int>;

  void offer(int i) {
    ++version_[i];
    const double cost = worst_distance2(i);
    if (cost <= tolerance2_) queue_.emplace(cost, i, version_[i]);
  }

  /// Maximum squared distance of the old vertices between i's neighbours from the edge that
  /// replaces them.
  double worst_distance2(int i) const {
    const int a = chains_.previous(i);
    const int b = chains_.next(i);
    const Segment s{chains_.point(a), chains_.point(b)};
    double worst = 0;
    for (int k = successor_[a]; k != b && worst <= tolerance2_; k = successor_[k])
      worst = std::max(worst, squared_distance(chains_.point(k), s));
    return worst;
  }

  bool is_safe(int i) const {
    const int a = chains_.previous(i);
    const int b = chains_.next(i);
    const Vec2 p = chains_.point(a);
    const Vec2 q = chains_.point(i);
    const Vec2 r = chains_.point(b);
    Box box = segment_box({p, r});
    box.include(q);
    return chains_.each_near(box, [&](int e) {
      if (e == a || e == i) return true;
      if (e != b && in_triangle(chains_.point(e), p, q, r)) return false;
      return !chains_.conflict(a, b, e);
    });
  }

  Chains& chains_;
  double tolerance2_;
  std::vector<int> successor_;
  std::vector<int> version_;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue_;
};

}  // namespace

bool touch(const Rings& rings, double cell) {
  const auto found = touching(rings, cell);
  return std::find(found.begin(), found.end(), 1) != found.end();
}

void smooth_rings(Rings& rings, double cell, double limit) {
  if (limit <= 0) return;
  const Rings before = rings;
  for (auto& ring : rings) ring = smoothed(ring, limit);
  for (int round = 0; round < max_untangling_rounds; ++round) {
    const auto found = touching(rings, cell);
    if (std::find(found.begin(), found.end(), 1) == found.end()) return;
    undo(rings, before, found);
  }
  rings = before;
}

void thin_rings(Rings& rings, double cell, double tolerance, const Stop& stop) {
  Chains chains(rings, cell);
  Thinner(chains, rings, tolerance).run(stop);
  int first = 0;
  for (auto& ring : rings) {
    const int n = static_cast<int>(ring.size());
    ring.clear();
    for (int i = first; i < first + n; ++i)
      if (chains.is_in(i)) ring.push_back(chains.point(i));
    first += n;
  }
}

}  // namespace microswarm::vision
