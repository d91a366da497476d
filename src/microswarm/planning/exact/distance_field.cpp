// SPDX-License-Identifier: Apache-2.0
#include "microswarm/planning/exact/distance_field.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <queue>
#include <utility>

#include "microswarm/core/maths/heap_entry.hpp"
#include "microswarm/world/snapshot.hpp"

namespace microswarm::planning {
namespace {

constexpr float unknown = -1;
constexpr auto unreached = static_cast<float>(infinity);

constexpr std::array<std::array<int, 2>, 8> neighbours{
    {{1, 0}, {0, 1}, {-1, 0}, {0, -1}, {1, 1}, {-1, 1}, {-1, -1}, {1, -1}}};

std::size_t count(double length, double cell) {
  return static_cast<std::size_t>(std::max(1.0, std::ceil(length / cell)));
}

/// Visits the nodes at most `r` columns and rows from a node, row by row.
template <class Visit>
void visit_square(std::size_t node, std::size_t r, std::size_t columns, std::size_t rows,
                  Visit&& visit) {
  const std::size_t column = node % columns, row = node / columns;
  for (std::size_t j = row - std::min(row, r); j <= std::min(row + r, rows - 1); ++j)
    for (std::size_t i = column - std::min(column, r); i <= std::min(column + r, columns - 1); ++i)
      visit(j * columns + i);
}

}  // namespace

DistanceField::DistanceField(std::shared_ptr<const Map> map, Vec2 goal, double clearance, Vec2 low,
                             double cell, double offset, ShortestPathTree::Growth growth)
    : map_(std::move(map)),
      route_(map_, goal, clearance, growth),
      goal_(goal),
      low_(low),
      cell_(cell),
      offset_(offset) {
  const Box& box = map_->bounds();
  detour_ = box.width() + box.height();
  columns_ = count(box.hi.x - low.x, cell);
  rows_ = count(box.hi.y - low.y, cell);
  lengths_.assign(columns_ * rows_, unknown);
}

DistanceField DistanceField::to_goal(std::shared_ptr<const Map> map, Vec2 goal, double clearance,
                                     double spacing, std::size_t max_nodes) {
  const Box& box = map->bounds();
  const double cell =
      std::max(spacing, std::sqrt(box.width() * box.height() / static_cast<double>(max_nodes)));
  // The goal is a node, so that the last step ends on it.
  const Vec2 before{std::floor((goal.x - box.lo.x) / cell), std::floor((goal.y - box.lo.y) / cell)};
  return {std::move(map),
          goal,
          clearance,
          goal - cell * before,
          cell,
          0,
          ShortestPathTree::Growth::towards_queries};
}

DistanceField DistanceField::over(const Map& map, Vec2 goal, int cells) {
  const Box& box = map.bounds();
  DistanceField field(Snapshot::of(map).shared_map(), goal, 0, box.lo,
                      std::max(box.width(), box.height()) / cells, 0.5,
                      ShortestPathTree::Growth::evenly);
  if (map.corners().all().size() > max_exact_corners) field.spread();
  return field;
}

void DistanceField::spread() {
  std::ranges::fill(lengths_, unreached);
  std::priority_queue<HeapEntry<float>> open;
  const auto reach = [&](std::size_t node, double length) {
    lengths_[node] = static_cast<float>(length);
    open.push({lengths_[node], static_cast<std::uint32_t>(node)});
  };
  const std::size_t root = nearest(goal_);
  reach(root, distance(goal_, position(root)));
  while (!open.empty()) {
    const auto [length, node] = open.top();
    open.pop();
    if (length > lengths_[node]) continue;
    const auto column = static_cast<long>(node % columns_);
    const auto row = static_cast<long>(node / columns_);
    for (std::size_t k = 0; k < neighbours.size(); ++k) {
      const long i = column + neighbours[k][0];
      const long j = row + neighbours[k][1];
      if (i < 0 || j < 0 || i >= static_cast<long>(columns_) || j >= static_cast<long>(rows_))
        continue;
      const std::size_t next = static_cast<std::size_t>(j) * columns_ + static_cast<std::size_t>(i);
      const double longer = static_cast<double>(length) + cell_ * (k < 4 ? 1 : std::numbers::sqrt2);
      if (static_cast<float>(longer) < lengths_[next] &&
          map_->is_free(Segment{position(next), position(node)}, 0))
        reach(next, longer);
    }
  }
}

double DistanceField::at(std::size_t node) {
  float& length = lengths_[node];
  if (length != unknown) return static_cast<double>(length);
  const auto found = static_cast<float>(route_.length_from(position(node)));
  if (!route_.was_stopped()) length = found;
  return static_cast<double>(found);
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

double DistanceField::from(Vec2 p) {
  if (lengths_.empty()) return infinity;
  const std::size_t node = nearest(p);
  double least = at(node);
  if (least == infinity)  // the nearest node of a point beside a wall may be in the wall
    visit_square(node, 2, columns_, rows_, [&](std::size_t n) { least = std::min(least, at(n)); });
  return least;
}

double DistanceField::estimate(Vec2 p) {
  const double found = at(nearest(p));
  return found < infinity ? found : straight_and_detour(p);
}

double DistanceField::visible_estimate(Vec2 p) {
  const std::size_t own = nearest(p);
  if (reaches(p) && map_->is_free(Segment{p, position(own)}, 0)) return estimate(p);
  double shortest = infinity;
  visit_square(own, 1, columns_, rows_, [&](std::size_t n) {
    const double via = at(n) + distance(p, position(n));
    if (via < shortest && map_->is_free(Segment{p, position(n)}, 0)) shortest = via;
  });
  return shortest < infinity ? shortest : straight_and_detour(p);
}

}  // namespace microswarm::planning
