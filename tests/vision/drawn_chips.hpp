// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

#include "microswarm/core/maths/rng.hpp"
#include "microswarm/formats/images/image.hpp"
#include "microswarm/formats/images/mask.hpp"
#include "microswarm/geometry/vec2.hpp"

namespace microswarm::test {

/// A micrograph of channels as it is drawn: channels of one grey on a ground of another, uneven
/// light, soft edges and noise. Lengths in pixels, greys of 255.
struct ChipLooks {
  int width = 400;
  int height = 320;
  double contrast = 70;  ///< grey of the ground minus grey of the channels; below 0: bright ones
  double noise = 4;      ///< standard deviation
  double light = 20;     ///< the light differs from its mean by at most this
  bool quadratic = false;
  bool scales_contrast = false;  ///< the light multiplies what it falls on, instead of adding to it
  double edge = 1;               ///< standard deviation of the blur
  double min_width = 6;
  double max_width = 20;
  enum class Shape { straight, curved, branching } shape = Shape::branching;
};

/// One channel: a chain of points with a width.
struct ChipChannel {
  std::vector<Vec2> points;
  double width = 0;
};

struct Chip {
  formats::Image picture;
  formats::Mask truth;
  std::string name;  ///< its looks, for messages
};

inline double distance_to_channel(Vec2 p, const ChipChannel& channel) {
  double least = 1e30;
  for (std::size_t i = 0; i + 1 < channel.points.size(); ++i) {
    const Vec2 a = channel.points[i];
    const Vec2 d = channel.points[i + 1] - a;
    const double t = std::clamp(dot(p - a, d) / std::max(1e-9, dot(d, d)), 0.0, 1.0);
    least = std::min(least, norm(p - a - t * d));
  }
  return least - 0.5 * channel.width;
}

/// From one border of the picture to the opposite one, with a wave of the given height.
inline ChipChannel crossing_channel(const ChipLooks& looks, double wave, Rng& rng) {
  const bool across = rng.uniform() < 0.5;
  const double length = across ? looks.width : looks.height;
  const double side = across ? looks.height : looks.width;
  const double from = rng.uniform(0.3, 0.7) * side;
  const double to = rng.uniform(0.3, 0.7) * side;
  const double phase = rng.uniform(0, 2 * std::numbers::pi);
  const double turns = rng.uniform(0.7, 1.6);
  ChipChannel channel;
  for (int i = -2; i <= 42; ++i) {
    const double t = i / 40.0;
    const double along = t * length;
    const double beside =
        from + t * (to - from) + wave * std::sin(phase + 2 * std::numbers::pi * turns * t);
    channel.points.push_back(across ? Vec2{along, beside} : Vec2{beside, along});
  }
  return channel;
}

inline std::vector<ChipChannel> chip_channels(const ChipLooks& looks, Rng& rng) {
  const auto some_width = [&] { return rng.uniform(looks.min_width, looks.max_width); };
  const double side = std::min(looks.width, looks.height);
  const bool curved = looks.shape == ChipLooks::Shape::curved;
  std::vector<ChipChannel> channels{crossing_channel(looks, curved ? 0.12 * side : 0, rng)};
  channels[0].width = some_width();
  if (looks.shape != ChipLooks::Shape::branching) return channels;
  const int branches = 2 + static_cast<int>(rng.below(3));
  for (int i = 0; i < branches; ++i) {
    const std::vector<Vec2>& stem = channels[0].points;
    const Vec2 from = stem[stem.size() / 4 + rng.below(stem.size() / 2)];
    const double angle = rng.uniform(0, 2 * std::numbers::pi);
    const double length = rng.uniform(0.4, 1.2) * side;
    const double bend = rng.uniform(-0.15, 0.15) * length;
    const Vec2 along{std::cos(angle), std::sin(angle)};
    const Vec2 beside{-along.y, along.x};
    ChipChannel branch;
    for (int k = 0; k <= 20; ++k) {
      const double t = k / 20.0;
      branch.points.push_back(from + t * length * along +
                              bend * std::sin(std::numbers::pi * t) * beside);
    }
    branch.width = some_width();
    channels.push_back(branch);
  }
  return channels;
}

/// The light's share of its greatest difference from the mean, −1 to 1.
inline double chip_light(const ChipLooks& looks, double angle, double x, double y) {
  const double u = 2 * x / looks.width - 1;
  const double v = 2 * y / looks.height - 1;
  if (looks.quadratic) return 1 - 1.0 * (u * u + v * v);
  return (std::cos(angle) * u + std::sin(angle) * v) /
         (std::abs(std::cos(angle)) + std::abs(std::sin(angle)));
}

inline Chip draw_chip(const ChipLooks& looks, std::uint64_t seed) {
  Rng rng(seed, Purpose::test);
  const std::vector<ChipChannel> channels = chip_channels(looks, rng);
  const double angle = rng.uniform(0, 2 * std::numbers::pi);
  const double middle = 127.5;
  Chip chip{{looks.width, looks.height, 1, {}}, formats::Mask(looks.width, looks.height), {}};
  chip.picture.pixels.resize(chip.truth.cells.size());
  for (int row = 0; row < looks.height; ++row)
    for (int column = 0; column < looks.width; ++column) {
      double distance = 1e30;
      const Vec2 p{column + 0.5, row + 0.5};
      for (const ChipChannel& c : channels)
        distance = std::min(distance, distance_to_channel(p, c));
      const double inside =
          0.5 * std::erfc(distance / (std::max(looks.edge, 0.1) * std::sqrt(2.0)));
      const double light = looks.light * chip_light(looks, angle, p.x, p.y);
      const double even = middle + looks.contrast * (0.5 - inside);
      const double grey = looks.scales_contrast ? even * (1 + light / middle) : even + light;
      const std::size_t i = chip.picture.index(column, row);
      const double noisy = std::round(grey + looks.noise * rng.normal());
      chip.picture.pixels[i] = static_cast<std::uint8_t>(std::clamp(noisy, 0.0, 255.0));
      chip.truth.cells[i] = distance < 0;
    }
  const char* const shapes[] = {"straight", "curved", "branching"};
  const auto text = [](double v) { return std::to_string(static_cast<int>(std::lround(v))); };
  chip.name = std::string(shapes[static_cast<int>(looks.shape)]) + ", contrast " +
              text(looks.contrast) + ", noise " + text(looks.noise) + ", light " +
              text(looks.light) + (looks.quadratic ? " quadratic" : " linear") +
              (looks.scales_contrast ? " factor" : "") + ", width " + text(looks.min_width) +
              " to " + text(looks.max_width) + ", edge " + text(looks.edge) + ", " +
              text(looks.width) + "x" + text(looks.height) + ", seed " + std::to_string(seed);
  return chip;
}

/// Looks of a chip, drawn from the whole range: contrast 20 to 160 dark and bright, noise 0 to 25,
/// light up to ±40, channels of 6 to 60 px, straight, curved and branching.
inline ChipLooks chip_looks(std::uint64_t seed) {
  Rng rng(seed, Purpose::scene);
  ChipLooks looks;
  looks.width = 320 + static_cast<int>(rng.below(400));
  looks.height = 300 + static_cast<int>(rng.below(260));
  const double contrast = 20 * std::pow(8.0, rng.uniform());
  looks.contrast = rng.uniform() < 0.5 ? contrast : -contrast;
  looks.noise = rng.uniform(0, 25);
  looks.light = rng.uniform(-40, 40);
  looks.quadratic = rng.uniform() < 0.5;
  looks.scales_contrast = rng.uniform() < 0.3;
  looks.edge = rng.uniform(0, 1.5);
  looks.min_width = 6 * std::pow(10.0, rng.uniform());
  looks.max_width = looks.min_width * rng.uniform(1, 2);
  if (looks.max_width > 60) looks.max_width = 60;
  looks.shape = static_cast<ChipLooks::Shape>(rng.below(3));
  return looks;
}

}  // namespace microswarm::test
