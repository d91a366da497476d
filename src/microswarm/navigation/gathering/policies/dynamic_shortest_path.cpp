// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/gathering/policies/dynamic_shortest_path.hpp"

#include <algorithm>
#include <utility>

#include "microswarm/navigation/gathering/policies/farthest_pair.hpp"

namespace microswarm::navigation {
namespace {

constexpr double cell_steps = 2;  // width of a cell, in steps

}  // namespace

DynamicShortestPath::DynamicShortestPath(const AggregationMap& map, double step, double patience)
    : map_(&map),
      cells_(map.cells ? map.cells
                       : std::make_shared<const CellGraph>(map.map, cell_steps * step,
                                                           CellSteps::lengths)),
      step_(step),
      patience_(patience),
      step_to_(step) {}

std::uint32_t DynamicShortestPath::robot_cell(const Robots& robots, std::size_t i) const {
  return map_->cells ? cells_->at(robots.position(i))
                     : cells_->nearest(map_->map, robots.position(i));
}

bool DynamicShortestPath::chases(const Robots& robots, const RobotsOnMap& on_map) {
  if (together_ || gave_up_) return false;
  if (has_pair_ && (other_ >= robots.size() || follower_ >= robots.size() || met(robots)))
    has_pair_ = false;
  if (!has_pair_) choose(robots, on_map);
  if (++since_progress_ > patience_) gave_up_ = true;
  return has_pair_ && !gave_up_;
}

// At the same cell by the cell rule, else nearer than two steps.
bool DynamicShortestPath::met(const Robots& robots) const {
  if (map_->cells) return robot_cell(robots, follower_) == robot_cell(robots, other_);
  const Segment between{robots.position(follower_), robots.position(other_)};
  return distance(between.a, between.b) < 2 * step_ && map_->map.is_free(between, 0);
}

void DynamicShortestPath::choose(const Robots& robots, const RobotsOnMap& on_map) {
  std::vector<std::uint32_t> cells(robots.size());
  for (std::size_t i = 0; i < cells.size(); ++i) cells[i] = robot_cell(robots, i);
  const NodePair pair = farthest_pair(*cells_, cells);
  follower_ = pair.first;
  other_ = pair.second;
  if (on_map.lengths[follower_] < on_map.lengths[other_]) std::swap(follower_, other_);
  has_pair_ = pair.distance > 0 && !met(robots);
  together_ = !has_pair_;
  std::ranges::sort(cells);
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  note_progress(cells.size(), pair.distance);
}

void DynamicShortestPath::note_progress(std::size_t cells, std::uint32_t distance) {
  if (std::pair(cells, distance) >= std::pair(min_cells_, min_distance_)) return;
  min_cells_ = cells;
  min_distance_ = distance;
  since_progress_ = 0;
}

Vec2 DynamicShortestPath::move(const Robots& robots) {
  constexpr int max_cells_ahead = 16;
  const Vec2 p = robots.position(follower_);
  step_to_.observe(follower_, p);
  std::uint32_t cell = robot_cell(robots, follower_);
  const std::uint32_t goal = robot_cell(robots, other_);
  const std::vector<std::uint32_t> distances = cells_->distances(goal, cell);
  if (map_->cells) return (*cells_)[cells_->towards(distances, cell)] - p;
  const auto sees = [&](Vec2 q) { return map_->map.is_free(Segment{p, q}, 0); };
  if (sees(robots.position(other_))) return step_to_.to(robots.position(other_));
  for (int k = 0; k < max_cells_ahead && !step_to_.is_held(); ++k) {
    const std::uint32_t next = cells_->towards(distances, cell);
    if (next == cell || !sees((*cells_)[next])) break;
    cell = next;
  }
  return step_to_.to((*cells_)[cell]);
}

void DynamicShortestPath::remap(std::span<const std::uint32_t> new_positions) {
  if (!has_pair_) return;
  follower_ = new_positions[follower_];
  other_ = new_positions[other_];
  step_to_.rename(follower_);
}

}  // namespace microswarm::navigation
