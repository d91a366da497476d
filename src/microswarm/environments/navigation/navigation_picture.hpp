// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "microswarm/environments/navigation/navigation_episode.hpp"

namespace microswarm::environments {

/// Colour pictures of the episodes of a task: rows of pixels of 3 bytes, the upper row first.
class NavigationPicture {
 public:
  using Colour = std::array<std::uint8_t, 3>;

  /// Draws the walls. The longer side of the map has `side` pixels.
  NavigationPicture(const NavigationTask& task, std::size_t side);

  std::size_t width() const { return width_; }
  std::size_t height() const { return height_; }
  /// Draws the walls, the goal, the obstacles and the swarm into `out` of width × height × 3 bytes.
  void draw(const NavigationEpisode& episode, std::span<std::uint8_t> out) const;

 private:
  Vec2 middle(std::size_t column, std::size_t row) const;
  template <class Holds>
  void paint(std::span<std::uint8_t> out, const Disc& within, const Colour& colour,
             Holds&& holds) const;

  Box bounds_;
  double um_per_px_;
  double goal_tolerance_;
  std::size_t width_;
  std::size_t height_;
  std::vector<std::uint8_t> walls_;
};

}  // namespace microswarm::environments
