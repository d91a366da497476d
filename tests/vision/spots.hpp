// SPDX-License-Identifier: Apache-2.0
// Pictures of round spots at known places.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "microswarm/core/maths/rng.hpp"
#include "microswarm/formats/images/image.hpp"
#include "microswarm/geometry/vec2.hpp"

namespace microswarm::test {

/// Grey ground of 120 with a slope, Gaussian spots that differ by `height` greys in their middle,
/// and noise.
inline formats::Image draw_spots(int width, int height_px, const std::vector<Vec2>& at_px,
                                 double spread, double height, double noise, Rng& rng) {
  std::vector<double> grey(static_cast<std::size_t>(width) * height_px);
  for (int y = 0; y < height_px; ++y)
    for (int x = 0; x < width; ++x)
      grey[static_cast<std::size_t>(y) * width + x] =
          120 + 30.0 * x / width - 10.0 * y / height_px + noise * rng.normal();
  const int reach = static_cast<int>(5 * spread) + 1;
  for (const Vec2 p : at_px)
    for (int y = std::max(0, static_cast<int>(p.y) - reach);
         y < std::min(height_px, static_cast<int>(p.y) + reach + 1); ++y)
      for (int x = std::max(0, static_cast<int>(p.x) - reach);
           x < std::min(width, static_cast<int>(p.x) + reach + 1); ++x)
        grey[static_cast<std::size_t>(y) * width + x] +=
            height * std::exp(-0.5 * squared_norm(Vec2(x, y) - p) / (spread * spread));
  formats::Image image{width, height_px, 1, {}};
  for (const double g : grey)
    image.pixels.push_back(static_cast<std::uint8_t>(std::clamp(std::lround(g), 0L, 255L)));
  return image;
}

/// Places on a grid `pitch` apart, each off its node by up to half a pixel either way.
inline std::vector<Vec2> scattered(int width, int height_px, int pitch, Rng& rng) {
  std::vector<Vec2> positions;
  for (int y = pitch; y + pitch <= height_px; y += pitch)
    for (int x = pitch; x + pitch <= width; x += pitch) {
      const double dx = rng.uniform(-0.5, 0.5);
      positions.push_back({x + dx, y + rng.uniform(-0.5, 0.5)});
    }
  return positions;
}

}  // namespace microswarm::test
