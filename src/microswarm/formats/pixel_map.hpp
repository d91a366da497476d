// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "microswarm/world/map/map.hpp"

namespace microswarm::formats {

/// A map, and notes on it, a line each.
struct PixelMap {
  Map map{};
  std::vector<std::string> notes{};
};

/// Map of `width` × `height` pixels in memory, row by row from the top. If all are 0 or 1 they are
/// a mask, free where a pixel is 1, else a grey picture, free where a pixel is as bright as the
/// threshold of an `ImageMap`, 128. `um_per_px` [µm] is a pixel's side, 1e-6 to 1e6; the lower left
/// corner is at 0.
/// `simplify` [µm] is the tolerance of the outlines, 0 for exact ones. Throws InputError for sizes
/// of 0 or above 65,535, another number of pixels, values out of range, pixels that are all wall,
/// and walls of more than 5 million corners.
PixelMap map_of_pixels(std::span<const std::uint8_t> pixels, std::size_t width, std::size_t height,
                       double um_per_px, double simplify = 0);

}  // namespace microswarm::formats
