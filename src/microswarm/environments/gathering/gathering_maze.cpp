// SPDX-License-Identifier: Apache-2.0
#include "microswarm/environments/gathering/gathering_maze.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/maths/maths.hpp"

namespace microswarm::environments {
namespace {

/// Free cells with a wall below or above and one to the right or left, of the four kinds: the
/// number of the rarest. A cell counts once, for the first kind in the benchmark's order.
std::uint32_t rarest_corners(const GatheringMaze& maze) {
  std::array<std::uint32_t, 4> counts{};
  for (const std::uint32_t cell : maze.cells()) {
    const MazePlace at = maze.place(cell);
    const auto is_wall = [&](int rows, int columns) {
      return !maze.is_free(MazePlace{at.row + rows, at.column + columns});
    };
    constexpr std::array<MazePlace, 4> kinds{{{1, 1}, {1, -1}, {-1, 1}, {-1, -1}}};
    for (std::size_t k = 0; k < kinds.size(); ++k)
      if (is_wall(kinds[k].row, 0) && is_wall(0, kinds[k].column)) {
        ++counts[k];
        break;
      }
  }
  return *std::ranges::min_element(counts);
}

/// First of the lowest cells or first of the rightmost, whichever is nearer to the lower right.
std::uint32_t extreme_cell(const GatheringMaze& maze) {
  const auto row = [&](std::uint32_t cell) { return maze.place(cell).row; };
  const auto column = [&](std::uint32_t cell) { return maze.place(cell).column; };
  const std::uint32_t lowest = *std::ranges::max_element(maze.cells(), {}, row);
  const std::uint32_t rightmost = *std::ranges::max_element(maze.cells(), {}, column);
  return row(lowest) + column(lowest) > row(rightmost) + column(rightmost) ? lowest : rightmost;
}

}  // namespace

GatheringMaze::GatheringMaze(std::span<const std::uint8_t> free, std::size_t width,
                             std::size_t height)
    : width_(static_cast<int>(width)), height_(static_cast<int>(height)) {
  if (width < 1 || height < 1 || width > max_side || height > max_side)
    throw InputError(fmt::format("a maze has {} × {} cells, must have 1 to {} each way", width,
                                 height, max_side));
  free_.assign(static_cast<std::size_t>(stride()) * (height + 2 * std::size_t{margin}), 0);
  for (std::size_t i = 0; i < width * height; ++i) {
    if (free[i] == 0) continue;
    cells_.push_back(number({static_cast<int>(i / width), static_cast<int>(i % width)}));
    free_[cells_.back()] = 1;
  }
  if (cells_.empty()) throw InputError("a maze has no free cell");
  corners_ = rarest_corners(*this);
  extent_ = costs_to(extreme_cell(*this)).max;
}

MazeCosts GatheringMaze::costs_to(std::uint32_t goal) const {
  MazeCosts costs{.goal = goal, .of = {}};
  costs.of.assign(size(), MazeCosts::unreached);
  costs.of[goal] = 0;
  std::vector<std::uint32_t> reached{goal};
  reached.reserve(cells_.size());
  double sum = 0;
  for (std::size_t i = 0; i < reached.size(); ++i) {
    const std::uint32_t cell = reached[i];
    costs.max = costs.of[cell];
    sum += costs.max;
    for (const MazePlace& move : moves) {
      const auto next =
          static_cast<std::uint32_t>(static_cast<int>(cell) + move.row * stride() + move.column);
      if (!is_free(next) || costs.of[next] != MazeCosts::unreached) continue;
      costs.of[next] = costs.of[cell] + 1;
      reached.push_back(next);
    }
  }
  if (reached.size() > 1) costs.mean = sum / static_cast<double>(reached.size() - 1);
  return costs;
}

double GatheringMaze::episode_length_estimate(const MazeCosts& costs) const {
  const double turns = std::max(costs.mean * corners_, std::numbers::e);
  return std::max(1.0, std::floor(0.75 * extent_ * maths::log(turns)));
}

}  // namespace microswarm::environments
