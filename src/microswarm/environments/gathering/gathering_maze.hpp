// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace microswarm::environments {

/// A position as row and column from the upper left.
struct MazePlace {
  int row = 0;
  int column = 0;
};

/// Distances of all cells of a maze to one of them, in steps.
struct MazeCosts {
  std::uint32_t goal = 0;
  std::vector<std::uint32_t> of{};  ///< of each cell; `unreached` for walls and other pieces
  std::uint32_t max = 0;
  double mean = 0;  ///< over the cells from which the goal is reached, without itself

  static constexpr std::uint32_t unreached = std::numeric_limits<std::uint32_t>::max();
};

/// Free cells and walls. Cells are numbered with a margin of walls around them, so that no move
/// of a few cells leaves the numbers.
class GatheringMaze {
 public:
  static constexpr int margin = 8;
  static constexpr std::size_t max_side = 8192;
  /// The eight inputs as rows and columns: east, south-east, south, …, north-east.
  static constexpr std::array<MazePlace, 8> moves{
      {{0, 1}, {1, 1}, {1, 0}, {1, -1}, {0, -1}, {-1, -1}, {-1, 0}, {-1, 1}}};

  /// `free` has a value for each cell, row after row from the top, 0 for a wall. Throws InputError
  /// if no cell is free or a side is longer than max_side.
  GatheringMaze(std::span<const std::uint8_t> free, std::size_t width, std::size_t height);

  int width() const { return width_; }
  int height() const { return height_; }
  /// Numbers from one row to the next.
  int stride() const { return width_ + 2 * margin; }
  std::uint32_t number(MazePlace place) const {
    return static_cast<std::uint32_t>((place.row + margin) * stride() + place.column + margin);
  }
  MazePlace place(std::uint32_t number) const {
    const int cell = static_cast<int>(number);
    return {cell / stride() - margin, cell % stride() - margin};
  }
  bool is_free(std::uint32_t number) const { return free_[number] != 0; }
  bool is_free(MazePlace place) const {
    return place.row >= 0 && place.row < height_ && place.column >= 0 && place.column < width_ &&
           is_free(number(place));
  }
  /// Free cells, in order.
  std::span<const std::uint32_t> cells() const { return cells_; }
  /// Number of numbers.
  std::size_t size() const { return free_.size(); }

  MazeCosts costs_to(std::uint32_t goal) const;
  /// Steps that an episode is expected to take with this goal, as the benchmark estimates them from
  /// the maze's extent and corners; at least 1.
  double episode_length_estimate(const MazeCosts& costs) const;

 private:
  int width_;
  int height_;
  std::vector<std::uint8_t> free_;
  std::vector<std::uint32_t> cells_;
  double extent_ = 0;          ///< greatest distance from the lowest or rightmost cell
  std::uint32_t corners_ = 0;  ///< of the kind of convex corner that is rarest
};

}  // namespace microswarm::environments
