// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <utility>
#include <vector>

#include "microswarm/core/maths/heap_entry.hpp"
#include "microswarm/planning/space_time/space_time_grid.hpp"

namespace microswarm::planning {

/// Difference of columns and rows, and its length [cells].
struct GridStep {
  int column = 0;
  int row = 0;
  double length = 0;
};

/// Steps to the eight neighbours and to the eight cells a knight's move away.
std::span<const GridStep, 16> grid_steps();

/// Lengths [µm] of paths to a goal among the cells that stand, from every cell. The paths take
/// grid_steps and are up to 2.8 % longer than straight ones. Allocates only on larger grids than
/// before.
class GridDistances {
 public:
  /// Cell from which the length to the goal is known [µm].
  struct Seed {
    SpaceTimeGrid::Cell cell = 0;
    double length = 0;
  };

  void compute(const SpaceTimeGrid& grid, std::span<const Seed> seeds);
  /// By cell; infinite without a path.
  std::span<const float> lengths() const { return lengths_; }
  float operator[](SpaceTimeGrid::Cell c) const { return lengths_[c]; }

 private:
  using Open = HeapEntry<float, SpaceTimeGrid::Cell>;
  void open(SpaceTimeGrid::Cell cell, float length);

  std::vector<float> lengths_;
  std::vector<Open> open_;  ///< a heap
};

}  // namespace microswarm::planning
