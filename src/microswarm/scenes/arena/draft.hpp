// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "microswarm/core/maths/rng.hpp"
#include "microswarm/experiment/scenario/scenario.hpp"
#include "microswarm/scenes/arena/arena.hpp"

namespace microswarm::scenes {

/// The arena's rectangle [µm], and its swarm.
inline constexpr Vec2 arena_size{2000, 1200};
inline constexpr double arena_middle = 600;
inline constexpr double arena_radius = 40;  // [µm]
inline constexpr double arena_speed = 80;   // [µm/s]

/// A scene that is being drawn: at first the empty rectangle, with the start on the left and the
/// goal on the right.
struct ArenaDraft {
  explicit ArenaDraft(Rng& numbers) : rng(numbers) {}

  /// Adds a wall between two corners [µm].
  void wall(Vec2 lo, Vec2 hi);
  /// Adds walls above and below a passage from `left` to `right` that is `width` wide [µm].
  void lane(double left, double right, double width, double centre = arena_middle);
  void still_disc(Vec2 at, double radius);
  /// Adds a disc with a velocity [µm/s].
  void disc(Vec2 at, double radius, Vec2 velocity);
  void add(const Shape& shape, const Motion& motion) {
    Obstacle& obstacle = obstacles.emplace_back();
    obstacle.shape = shape;
    obstacle.motion = motion;
  }
  double uniform(double lo, double hi) { return rng.uniform(lo, hi); }
  /// Moves the start up or down by up to `range` [µm].
  void shift_start(double range) { start.position.y += uniform(-range, range); }

  Rng& rng;
  std::vector<std::vector<Vec2>> walls{};
  std::vector<Obstacle> obstacles{};
  SwarmParams swarm{VortexParams{
      .radius = arena_radius, .moving_radius = arena_radius, .max_speed = arena_speed}};
  experiment::SensingParams sensing{};
  Pose2 start{{150, arena_middle}, 0};
  Vec2 goal{1850, arena_middle};
};

/// A kind and how it is drawn.
struct ArenaDrawing {
  ArenaKind kind{};
  void (*draw)(ArenaDraft&) = nullptr;
};

/// The kinds of a group of files; `arena_kinds` has them all.
std::span<const ArenaDrawing> still_drawings();
std::span<const ArenaDrawing> corridor_drawings();
std::span<const ArenaDrawing> door_drawings();
std::span<const ArenaDrawing> mover_drawings();
std::span<const ArenaDrawing> crowd_drawings();

}  // namespace microswarm::scenes
