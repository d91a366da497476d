// SPDX-License-Identifier: Apache-2.0
#include "microswarm/planning/space_time/grid_distances.hpp"

#include <algorithm>
#include <limits>
#include <numbers>

namespace microswarm::planning {
namespace {

constexpr double diagonal = std::numbers::sqrt2;
constexpr double knight = 2.2360679774997896964;
constexpr std::array<GridStep, 16> sixteen_steps{{{1, 0, 1},
                                                  {0, 1, 1},
                                                  {-1, 0, 1},
                                                  {0, -1, 1},
                                                  {1, 1, diagonal},
                                                  {-1, 1, diagonal},
                                                  {-1, -1, diagonal},
                                                  {1, -1, diagonal},
                                                  {2, 1, knight},
                                                  {1, 2, knight},
                                                  {-1, 2, knight},
                                                  {-2, 1, knight},
                                                  {-2, -1, knight},
                                                  {-1, -2, knight},
                                                  {1, -2, knight},
                                                  {2, -1, knight}}};

/// Whether neither of the two cells beside a knight's move stands.
bool passes(const SpaceTimeGrid& grid, int column, int row, const GridStep& step) {
  if (step.length <= diagonal) return true;
  const int i = step.column / 2;
  const int j = step.row / 2;
  return !grid.stands(grid.at(column + i, row + j)) &&
         !grid.stands(grid.at(column + step.column - i, row + step.row - j));
}

}  // namespace

std::span<const GridStep, 16> grid_steps() { return sixteen_steps; }

void GridDistances::open(SpaceTimeGrid::Cell cell, float length) {
  if (length >= lengths_[cell]) return;
  lengths_[cell] = length;
  open_.push_back({length, cell});
  std::push_heap(open_.begin(), open_.end());
}

void GridDistances::compute(const SpaceTimeGrid& grid, std::span<const Seed> seeds) {
  lengths_.assign(grid.size(), std::numeric_limits<float>::infinity());
  open_.clear();
  open_.reserve(4 * grid.size());
  for (const Seed& seed : seeds) open(seed.cell, static_cast<float>(seed.length));
  std::array<float, sixteen_steps.size()> step_lengths{};
  for (std::size_t k = 0; k < step_lengths.size(); ++k)
    step_lengths[k] = static_cast<float>(sixteen_steps[k].length * grid.cell());
  while (!open_.empty()) {
    const auto [reached, from] = open_.front();
    std::pop_heap(open_.begin(), open_.end());
    open_.pop_back();
    if (reached > lengths_[from]) continue;
    const int column = grid.column_of(from);
    const int row = grid.row_of(from);
    for (std::size_t k = 0; k < sixteen_steps.size(); ++k) {
      const GridStep& step = sixteen_steps[k];
      if (!grid.holds(column + step.column, row + step.row)) continue;
      const auto cell = grid.at(column + step.column, row + step.row);
      const float length = reached + step_lengths[k];
      if (length >= lengths_[cell] || grid.stands(cell) || !passes(grid, column, row, step))
        continue;
      open(cell, length);
    }
  }
}

}  // namespace microswarm::planning
