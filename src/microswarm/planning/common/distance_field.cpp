// SPDX-License-Identifier: Apache-2.0
#include "microswarm/planning/common/distance_field.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <queue>
#include <utility>

namespace microswarm {
namespace {

constexpr float unreached = std::numeric_limits<float>::infinity();

struct OpenNodeOfField {
  float distance;
  std::uint32_t node;
  friend bool operator<(const OpenNodeOfField& a, const OpenNodeOfField& b) {
    return std::pair(a.distance, a.node) > std::pair(b.distance, b.node);  // nearest first
  }
};

constexpr std::array<std::array<int, 2>, 8> neighbours{
    {{1, 0}, {0, 1}, {-1, 0}, {0, -1}, {1, 1}, {-1, 1}, {-1, -1}, {1, -1}}};

std::size_t count(double length, double cell) {
  return static_cast<std::size_t>(std::max(1.0, std::ceil(length / cell)));
}

/// Visits the nodes at most `r` from a node of the grid, row by row.
template <class Visit>
void visit_square(std::size_t node, std::size_t r, std::size_t columns, std::size_t rows,
                  Visit&& visit) {
  const std::size_t column = node % columns, row = node / columns;
  for (std::size_t j = row - std::min(row, r); j <= std::min(row + r, rows - 1); ++j)
    for (std::size_t i = column - std::min(column, r); i <= std::min(column + r, columns - 1); ++i)
      visit(j * columns + i);
}

}  // namespace

DistanceField::DistanceField(const Map& map, Vec2 goal, Vec2 low, double cell, double offset)
    : goal_(goal), low_(low), cell_(cell), offset_(offset) {
  const Box& box = map.bounds();
  detour_ = box.width() + box.height();
  columns_ = count(box.hi.x - low.x, cell);
  rows_ = count(box.hi.y - low.y, cell);
  distances_.assign(columns_ * rows_, unreached);
  next_.resize(distances_.size());
}

DistanceField DistanceField::to_goal(const Map& map, Vec2 goal, double clearance, double spacing,
                                     std::size_t max_nodes) {
  const Box& box = map.bounds();
  const double cell =
      std::max(spacing, std::sqrt(box.width() * box.height() / static_cast<double>(max_nodes)));
  // The goal is a node, so that the last step ends on it.
  const Vec2 before{std::floor((goal.x - box.lo.x) / cell), std::floor((goal.y - box.lo.y) / cell)};
  DistanceField field(map, goal, goal - cell * before, cell, 0);
  if (box.contains(goal)) field.spread(map, clearance, field.nearest(goal), 0);
  return field;
}

DistanceField DistanceField::over(const Map& map, Vec2 goal, int cells) {
  const Box& box = map.bounds();
  DistanceField field(map, goal, box.lo, std::max(box.width(), box.height()) / cells, 0.5);
  const std::size_t root = field.nearest(goal);
  field.spread(map, 0, root, distance(goal, field.position(root)));
  return field;
}

void DistanceField::spread(const Map& map, double clearance, std::size_t root,
                           double root_distance) {
  std::priority_queue<OpenNodeOfField> open;
  const auto first = static_cast<std::uint32_t>(root);
  distances_[root] = static_cast<float>(root_distance);
  next_[root] = first;
  open.push({distances_[root], first});
  while (!open.empty()) {
    const auto [reached, node] = open.top();
    open.pop();
    if (reached > distances_[node]) continue;
    const auto column = static_cast<long>(node % columns_);
    const auto row = static_cast<long>(node / columns_);
    for (std::size_t k = 0; k < neighbours.size(); ++k) {
      const long i = column + neighbours[k][0];
      const long j = row + neighbours[k][1];
      if (i < 0 || j < 0 || i >= static_cast<long>(columns_) || j >= static_cast<long>(rows_))
        continue;
      const std::size_t n = static_cast<std::size_t>(j) * columns_ + static_cast<std::size_t>(i);
      const double edge = k < 4 ? cell_ : cell_ * std::numbers::sqrt2;
      const auto longer = static_cast<float>(static_cast<double>(reached) + edge);
      if (longer >= distances_[n]) continue;
      if (!map.is_free(Segment{position(n), position(node)}, clearance)) continue;
      distances_[n] = longer;
      next_[n] = node;
      open.push({longer, static_cast<std::uint32_t>(n)});
    }
  }
}

Vec2 DistanceField::position(std::size_t node) const {
  const std::size_t row = node / columns_;
  return low_ + cell_ * Vec2{static_cast<double>(node - row * columns_) + offset_,
                             static_cast<double>(row) + offset_};
}

std::size_t DistanceField::nearest(Vec2 p) const {
  const auto clamped = [this](double v, std::size_t n) {
    const double index = std::floor(v / cell_ + (0.5 - offset_));
    return static_cast<std::size_t>(std::clamp(index, 0.0, static_cast<double>(n - 1)));
  };
  return clamped(p.y - low_.y, rows_) * columns_ + clamped(p.x - low_.x, columns_);
}

// Beside a wall the node next to it may be in the wall.
std::size_t DistanceField::nearest_reached(Vec2 p) const {
  const std::size_t node = nearest(p);
  if (distances_[node] != unreached) return node;
  std::size_t best = node;
  visit_square(node, 2, columns_, rows_, [&](std::size_t n) {
    if (distances_[n] < distances_[best]) best = n;
  });
  return best;
}

double DistanceField::from(Vec2 p) const {
  if (distances_.empty()) return std::numeric_limits<double>::infinity();
  return static_cast<double>(distances_[nearest_reached(p)]);
}

bool DistanceField::reaches(Vec2 p) const { return distances_[nearest(p)] < unreached; }

double DistanceField::estimate(Vec2 p) const {
  const float found = distances_[nearest(p)];
  return found < unreached ? static_cast<double>(found) : distance(p, goal_) + detour_;
}

double DistanceField::visible_estimate(const Map& map, Vec2 p) const {
  const std::size_t own = nearest(p);
  if (reaches(p) && map.is_free(Segment{p, position(own)}, 0)) return estimate(p);
  double shortest = std::numeric_limits<double>::infinity();
  visit_square(own, 1, columns_, rows_, [&](std::size_t n) {
    const double via = static_cast<double>(distances_[n]) + distance(p, position(n));
    if (via < shortest && map.is_free(Segment{p, position(n)}, 0)) shortest = via;
  });
  return std::isfinite(shortest) ? shortest : distance(p, goal_) + detour_;
}

Vec2 DistanceField::ahead(const Map& map, Vec2 p, double reach, double r) const {
  if (distances_.empty()) return p;
  std::size_t node = nearest_reached(p);
  if (distances_[node] == unreached) return p;
  Vec2 seen = p;
  bool lost = false;
  double along = 0;
  // The first points may be hidden, since the node is not at `p`; afterwards the first hidden one
  // ends it.
  while (along <= reach && !lost) {
    const Vec2 q = position(node);
    if (map.is_free(Segment{p, q}, r))
      seen = q;
    else
      lost = along > 2 * cell_ && !(seen == p);
    if (next_[node] == node) break;
    along += distance(q, position(next_[node]));
    node = next_[node];
  }
  return seen == p ? position(node) : seen;
}

}  // namespace microswarm
