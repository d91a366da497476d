// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "microswarm/formats/map_spec.hpp"
#include "microswarm/world/map/map.hpp"

namespace microswarm::formats {

/// A map, and notes on it, a line each.
struct PixelMap {
  Map map{};
  std::vector<std::string> notes{};
};

/// Parameters of a map of pixels in memory; names, limits and defaults are those of a picture's
/// file.
struct PixelMapParams {
  std::optional<int> threshold{};
  FreePixels free = FreePixels::bright;
  double simplify = 0;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.threshold, plain("threshold", 0, 255,
                                "Grey value from which a pixel is bright; none: 128, mask 1."));
    visit(self.free, plain("free", "Free pixels: bright or dark."));
    visit(self.simplify, um("simplify", 0, 1e6, "Tolerance of the outlines; 0: exact."));
  }
};

/// The parameters as settings name them: map.threshold=90.
struct PixelMapKey {
  PixelMapParams map{};
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.map, plain("map", "How pixels are read."));
  }
};

/// Map of `width` × `height` pixels in memory, row by row from the top. A pixel is bright from the
/// threshold on; without one that is 1 if all are 0 or 1, a mask, else 128, that of an `ImageMap`.
/// `um_per_px` [µm] is a pixel's side, 1e-6 to 1e6; the lower left corner is at 0. Throws
/// InputError for sizes of 0 or above 65,535, another number of pixels, values out of range, pixels
/// that are all wall, and walls of more than 5 million corners.
PixelMap map_of_pixels(std::span<const std::uint8_t> pixels, std::size_t width, std::size_t height,
                       double um_per_px, const PixelMapParams& params = {});

}  // namespace microswarm::formats
