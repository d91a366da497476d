// SPDX-License-Identifier: Apache-2.0
// Pictures of flat discs with exact edges, at known places.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "microswarm/core/maths/rng.hpp"
#include "microswarm/formats/images/image.hpp"
#include "microswarm/geometry/vec2.hpp"

namespace microswarm::test {

struct Discs {
  formats::Image picture;
  std::vector<Vec2> at_px;
};

inline formats::Image flat_picture(int width, int height, int grey) {
  return {width, height, 1,
          std::vector<std::uint8_t>(static_cast<std::size_t>(width) * height,
                                    static_cast<std::uint8_t>(grey))};
}

/// Share of a pixel that lies in a disc, from 8 × 8 points.
inline double cover(Vec2 pixel, Vec2 centre, double radius) {
  const double far = distance(pixel, centre);
  if (far < radius - 1) return 1;
  if (far > radius + 1) return 0;
  int inside = 0;
  for (int i = 0; i < 64; ++i)
    inside +=
        squared_norm(pixel + Vec2{(i % 8 - 3.5) / 8, (i / 8 - 3.5) / 8} - centre) < radius * radius;
  return inside / 64.0;
}

/// Adds a disc of `contrast` greys, with noise everywhere if `rng` is given.
inline void draw_discs(formats::Image& picture, const std::vector<Vec2>& at_px, double radius,
                       double contrast, double noise, Rng* rng) {
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) {
      auto& pixel = picture.pixels[picture.index(x, y)];
      double grey = pixel;
      for (const Vec2 at : at_px) grey += contrast * cover(Vec2{1.0 * x, 1.0 * y}, at, radius);
      if (rng) grey += noise * rng->normal();
      pixel = static_cast<std::uint8_t>(std::clamp(std::lround(grey), 0L, 255L));
    }
}
inline void draw_disc(formats::Image& picture, Vec2 at, double radius, double contrast) {
  draw_discs(picture, {at}, radius, contrast, 0, nullptr);
}

/// Two discs at random places between pixels, farther apart than twice their diameter.
inline Discs two_discs(double radius, double contrast, double noise, Rng& rng) {
  const int side = static_cast<int>(4 * radius) + 20;
  Discs discs{flat_picture(2 * side, side, contrast < 0 ? 170 : 90), {}};
  for (const double middle : {0.5 * side, 1.5 * side}) {
    const double x = middle + rng.uniform(-3, 3);
    discs.at_px.push_back({x, 0.5 * side + rng.uniform(-3, 3)});
  }
  draw_discs(discs.picture, discs.at_px, radius, contrast, noise, &rng);
  return discs;
}

}  // namespace microswarm::test
