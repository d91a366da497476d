// SPDX-License-Identifier: Apache-2.0
// Drawn microscope frames: uneven light, walls, obstacles, swarms of clumps, noise.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "microswarm/core/maths/rng.hpp"
#include "microswarm/formats/images/image.hpp"
#include "microswarm/formats/images/mask.hpp"
#include "microswarm/geometry/vec2.hpp"

namespace microswarm::test {

/// Of the frames [px], unless a test asks for others.
inline constexpr int frame_width = 640;
inline constexpr int frame_height = 480;

/// A swarm as it is drawn; lengths in px, y down.
struct DrawnSwarm {
  Vec2 centre;
  double radius = 40;
  double elongation = 1;  ///< ratio of its axes; the area stays
  double angle = 0;       ///< of its major axis [rad]
  int clumps = 400;
  double clump_radius = 3;
  double opacity = 0.7;
};

/// A frame in the making: the share of light that each pixel lets through.
class DrawnFrame {
 public:
  DrawnFrame(int w, int h) : width(w), height(h), light_(static_cast<std::size_t>(w) * h, 1.0) {}

  /// Everything within `reach` of p for which the signed distance outside(q) is below 0, with an
  /// edge one pixel wide, lets `share` of the light through.
  template <class Outside>
  void draw(Vec2 p, double reach, double share, Outside&& outside) {
    const auto low = [](double v) { return std::max(0, static_cast<int>(std::floor(v))); };
    const int right = std::min(width - 1, static_cast<int>(std::ceil(p.x + reach)));
    const int bottom = std::min(height - 1, static_cast<int>(std::ceil(p.y + reach)));
    for (int y = low(p.y - reach); y <= bottom; ++y)
      for (int x = low(p.x - reach); x <= right; ++x) {
        const double cover = std::clamp(0.5 - outside(Vec2{1.0 * x, 1.0 * y}), 0.0, 1.0);
        light_[static_cast<std::size_t>(y) * width + x] *= 1 - cover * (1 - share);
      }
  }
  void disc(Vec2 p, double radius, double share) {
    draw(p, radius + 1, share, [&](Vec2 q) { return distance(p, q) - radius; });
  }
  /// A convex polygon, clockwise as seen.
  void polygon(const std::vector<Vec2>& ring, double share) {
    Vec2 middle;
    for (const Vec2 q : ring) middle += q / static_cast<double>(ring.size());
    double reach = 1;
    for (const Vec2 q : ring) reach = std::max(reach, distance(q, middle) + 1);
    draw(middle, reach, share, [&](Vec2 q) {
      double farthest = -1e9;
      for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) {
        const Vec2 edge = ring[i] - ring[j];
        farthest = std::max(farthest, -cross(edge, q - ring[j]) / norm(edge));
      }
      return farthest;
    });
  }
  void box(Vec2 lo, Vec2 hi, double share) { polygon({lo, {hi.x, lo.y}, hi, {lo.x, hi.y}}, share); }
  /// Clumps spread evenly over an ellipse, on a sunflower's spiral shaken by half its pitch, so
  /// that the truth of the centre is that of the ellipse and not of a draw.
  void swarm(const DrawnSwarm& s, Rng& rng) {
    const double along = std::sqrt(s.elongation);
    const double pitch = s.radius * std::sqrt(std::numbers::pi / s.clumps);
    for (int k = 0; k < s.clumps; ++k) {
      const double turn = 2.399963229728653 * k;
      Vec2 p = s.radius * std::sqrt((k + 0.5) / s.clumps) * unit_vector(turn);
      const double dx = 0.25 * pitch * rng.normal();
      p += Vec2{dx, 0.25 * pitch * rng.normal()};
      disc(s.centre + rotated({p.x * along, p.y / along}, s.angle),
           s.clump_radius * rng.uniform(0.7, 1.3), 1 - s.opacity * rng.uniform(0.7, 1.0));
    }
  }
  /// The picture: light that is uneven by ± `slope` from edge to edge along `heading`, and falls
  /// off towards the corners by `vignette`, with noise [grey].
  formats::Image expose(double grey, double slope, double heading, double vignette, double noise,
                        Rng& rng) const {
    formats::Image image{width, height, 1, {}};
    image.pixels.reserve(light_.size());
    const Vec2 middle{0.5 * (width - 1), 0.5 * (height - 1)};
    const Vec2 along = unit_vector(heading);
    const double half = std::abs(along.x) * middle.x + std::abs(along.y) * middle.y;
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        const Vec2 off = Vec2{1.0 * x, 1.0 * y} - middle;
        const double lamp = (1 + slope * dot(off, along) / half) *
                            (1 - vignette * squared_norm(off) / squared_norm(middle));
        const double seen =
            grey * lamp * light_[static_cast<std::size_t>(y) * width + x] + noise * rng.normal();
        image.pixels.push_back(static_cast<std::uint8_t>(std::clamp(std::lround(seen), 0L, 255L)));
      }
    return image;
  }

  int width;
  int height;

 private:
  std::vector<double> light_;
};

}  // namespace microswarm::test
