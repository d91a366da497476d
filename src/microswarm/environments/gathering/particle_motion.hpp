// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "microswarm/core/maths/rng.hpp"
#include "microswarm/environments/gathering/gathering_maze.hpp"
#include "microswarm/environments/gathering/gathering_rules.hpp"

namespace microswarm::environments {

/// Particles in a maze and their motion. Particles in one cell move equally unless they are
/// physical, so they form one group from then on.
class ParticleMotion {
 public:
  ParticleMotion(const GatheringMaze& maze, const GatheringRules& rules);

  /// Puts particles into these cells, at rest, with new weights.
  void place(std::vector<std::uint32_t> cells, Rng& rng);
  /// Applies an input, 0 to 7.
  void step(std::size_t action, Rng& rng);

  /// Cell of each group, and its number of particles.
  std::span<const std::uint32_t> cells() const { return cells_; }
  std::span<const std::uint32_t> counts() const { return counts_; }
  /// Weights of the particles; empty unless they are physical.
  std::span<const double> weights() const { return weights_; }

 private:
  /// A coordinate of each particle: exact place, and speed in cells a step.
  struct Axis {
    std::vector<double> at;
    std::vector<double> speed;
  };
  struct Scratch;
  void step_algorithmic(MazePlace move);
  void step_fuzzy(MazePlace move, std::uint64_t key);
  void step_physical(MazePlace move);
  void block_full_cells(Scratch& scratch);
  void accelerate(Axis& axis, int direction);
  void advance(Axis& axis, const Scratch& scratch);
  void merge_groups();

  const GatheringMaze& maze_;
  const GatheringRules& rules_;
  std::vector<std::uint32_t> cells_;
  std::vector<std::uint32_t> counts_;
  int steps_ = 0;
  Axis rows_;
  Axis columns_;
  std::vector<double> weights_;
  std::vector<double> accelerations_;
};

}  // namespace microswarm::environments
