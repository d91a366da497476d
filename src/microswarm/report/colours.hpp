// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

namespace microswarm::report {

/// Colour with components in [0, 1].
struct Colour {
  double red = 0;
  double green = 0;
  double blue = 0;
  double alpha = 1;
};

/// The colour 0xRRGGBB.
constexpr Colour colour_of(std::uint32_t rgb, double alpha = 1) {
  return {((rgb >> 16) & 255) / 255.0, ((rgb >> 8) & 255) / 255.0, (rgb & 255) / 255.0, alpha};
}

/// Colours of all pictures, one meaning each; the lab's page has the same in its light theme. Those
/// that meet differ also to the colour-blind and in a grey print (web/tests/unit/palette.test.mjs).
namespace colours {
inline constexpr Colour paper = colour_of(0xffffff);
inline constexpr Colour ink = colour_of(0x21262e);
inline constexpr Colour wall = colour_of(0xccd1d9);
inline constexpr Colour wall_edge = colour_of(0x737a87);
inline constexpr Colour obstacle = colour_of(0xd55e00, 0.85);
inline constexpr Colour prediction = colour_of(0xd55e00);
/// The path planned, and the path travelled.
inline constexpr Colour path = colour_of(0x00376e);
inline constexpr Colour trail = colour_of(0x56b4e9);
inline constexpr Colour tree = colour_of(0x838d9a);
inline constexpr Colour circle = colour_of(0xb83a86);
inline constexpr Colour swarm = colour_of(0x006e52);
inline constexpr Colour goal = colour_of(0x8a3fd1);
inline constexpr Colour team = colour_of(0xfad680);
/// Directions of the radar by their fate, the one that it chose, and its circles.
inline constexpr Colour radar_obstacle = colour_of(0xc2489a, 0.75);
inline constexpr Colour radar_wall = colour_of(0x2f353d, 0.7);
inline constexpr Colour radar_turn = colour_of(0xf0d800, 0.75);
inline constexpr Colour radar_chosen = colour_of(0x000000);
inline constexpr Colour radar_detection = colour_of(0x4d3310);
inline constexpr Colour radar_safety = colour_of(0xe69f00);
inline constexpr Colour radar_prediction = colour_of(0xdb5245);
inline constexpr Colour wait_zone = colour_of(0x808080);
/// Colours of individually tracked robots, in order.
inline constexpr std::array<Colour, 8> robots{
    {colour_of(0x0072b2), colour_of(0xd55e00), colour_of(0x009e73), colour_of(0xcc79a7),
     colour_of(0xe69f00), colour_of(0x56b4e9), colour_of(0x332288), colour_of(0x6b6b6b)}};
}  // namespace colours

}  // namespace microswarm::report
