// SPDX-License-Identifier: Apache-2.0
// Small scenarios and pictures for the tests of the command line.
#pragma once

#include <functional>
#include <string>

namespace microswarm::test {

/// Two rooms of 1000 × 800 µm and a wall between them with a gap of `gap` µm, in the third body.
/// Line 1 to 14; flies through within a second of computing.
inline std::string two_rooms(int gap = 300) {
  const std::string lower = std::to_string(400 - gap / 2);
  const std::string upper = std::to_string(400 + gap / 2);
  return "name: two rooms\n"
         "map:\n"
         "  type: rectangles\n"
         "  lo_um: [0, 0]\n"
         "  hi_um: [2000, 800]\n"
         "  rectangles_um: [[100, 20, 50, 30], [1800, 700, 60, 60], [1000, 0, 60, " +
         lower + "], [1000, " + upper + ", 60, " + lower +
         "]]\n"
         "swarm:\n"
         "  type: ribbon\n"
         "  radius_um: 40\n"
         "  max_speed_um_per_s: 120\n"
         "start: {x_um: 200, y_um: 400, heading_deg: 0}\n"
         "goal_um: [1600, 400]\n"
         "goal_tolerance_um: 50\n"
         "time_limit_s: 100\n"
         "seed: 1\n";
}

/// The same, seen with noise: trials differ.
inline std::string noisy_rooms() { return two_rooms() + "sensing: {position_noise_um: 0.5}\n"; }

/// The first line that holds `what`, replaced; the text as it is when none does.
inline std::string with(std::string text, const std::string& what, const std::string& line) {
  std::size_t at = text.find(what);
  if (at == std::string::npos) return text;
  at = text.rfind('\n', at) + 1;
  return text.replace(at, text.find('\n', at) - at, line);
}

/// A grey picture (binary PGM) whose pixel (x, y), y down, is what `grey` says.
inline std::string pgm(int width, int height, const std::function<int(int, int)>& grey) {
  std::string bytes = "P5\n" + std::to_string(width) + " " + std::to_string(height) + "\n255\n";
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) bytes += static_cast<char>(grey(x, y));
  return bytes;
}

}  // namespace microswarm::test
