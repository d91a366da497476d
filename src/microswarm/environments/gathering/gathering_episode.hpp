// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "microswarm/core/maths/rng.hpp"
#include "microswarm/environments/environment_step.hpp"
#include "microswarm/environments/gathering/gathering_maze.hpp"
#include "microswarm/environments/gathering/gathering_rules.hpp"
#include "microswarm/environments/gathering/particle_motion.hpp"

namespace microswarm::environments {

/// A maze with the rules and the goal that all its episodes share.
struct GatheringTask {
  GatheringMaze maze;
  GatheringRules rules{};
  std::optional<MazePlace> goal{};  ///< none: a random one each episode
  MazeCosts costs{};                ///< to the goal, if it is fixed

  /// Throws InputError if the goal is no free cell or fewer cells are free than particles are to be
  /// placed.
  GatheringTask(GatheringMaze maze, const GatheringRules& rules, std::optional<MazePlace> goal);
  int channels() const;
  /// Bytes of a picture: height × width × channels.
  std::size_t picture_size() const;
  /// Approximate upper bound of an episode's memory besides its picture [B].
  std::size_t episode_bytes() const;
  /// Index of a cell in a picture of one channel.
  std::size_t pixel(std::uint32_t cell) const { return pixels[cell]; }
  std::vector<std::uint32_t> pixels{};
};

/// State of a gathering, from which it continues identically: what was drawn from the random
/// numbers of its seed before the episode, and the episode's inputs.
struct GatheringState {
  std::uint64_t seed = 0;
  std::uint64_t draws = 0;
  std::vector<std::uint8_t> actions{};

  static constexpr std::uint64_t max_draws = 100'000'000'000;
};

/// Sequence of episodes of a gathering, with their picture. Equal seeds give equal episodes on
/// every machine.
class GatheringEpisode {
 public:
  /// `picture` has picture_size() bytes; it and the task must outlive this object.
  GatheringEpisode(const GatheringTask& task, std::uint64_t seed, std::span<std::uint8_t> picture);
  /// A gathering in the state of `other`, which draws into `picture`.
  GatheringEpisode(const GatheringEpisode& other, std::span<std::uint8_t> picture);

  /// Begins the first episode of a seed.
  void reset(std::uint64_t seed);
  /// Begins the next episode.
  void reset();
  /// Sends one of the eight inputs to all particles and draws the picture.
  EnvironmentStep step(std::size_t action);
  GatheringState state() const;
  /// Plays the episode of a state again; returns its last step. Throws InputError for an input
  /// above 7 or more draws than max_draws.
  EnvironmentStep restore(const GatheringState& state);

  const ParticleMotion& motion() const { return motion_; }
  std::uint32_t goal() const { return costs().goal; }
  const MazeCosts& costs() const { return own_costs_ ? *own_costs_ : task_.costs; }
  int steps() const { return steps_; }

 private:
  void draw_background();
  void draw_particles();
  void erase_particles();
  /// Sum of the particles' costs, and the greatest.
  struct Cost {
    double total = 0;
    std::uint32_t max = 0;
  };
  Cost cost() const;

  const GatheringTask& task_;
  std::uint64_t seed_;
  Rng rng_;
  std::uint64_t drawn_ = 0;         ///< numbers drawn from rng_
  std::uint64_t drawn_before_ = 0;  ///< before this episode
  std::vector<std::uint8_t> actions_;
  ParticleMotion motion_;
  std::span<std::uint8_t> picture_;
  std::vector<std::uint8_t> background_;  ///< of the channel of the particles
  std::optional<MazeCosts> own_costs_;
  double length_estimate_ = 1;
  double start_total_ = 0;  ///< reference of the totals
  double last_total_ = 0;
  double last_max_ = 0;
  int steps_ = 0;
};

}  // namespace microswarm::environments
