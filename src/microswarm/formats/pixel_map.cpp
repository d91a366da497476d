// SPDX-License-Identifier: Apache-2.0
#include "microswarm/formats/pixel_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/formats/images/mask.hpp"

namespace microswarm::formats {
namespace {

/// A map of this size takes some seconds and a few GB.
constexpr std::size_t max_corners = 5'000'000;

/// The value from which a pixel is bright.
int min_bright(std::span<const std::uint8_t> pixels, const PixelMapParams& params) {
  if (params.threshold) return *params.threshold;
  const bool is_mask = std::ranges::all_of(pixels, [](std::uint8_t v) { return v <= 1; });
  return is_mask ? 1 : ImageMap{}.threshold;
}

[[noreturn]] void fail_all_wall(std::span<const std::uint8_t> pixels, int least,
                                bool dark_is_free) {
  const auto [darkest, brightest] = std::ranges::minmax_element(pixels);
  if (dark_is_free)
    throw InputError(
        fmt::format("all of the image is wall: its smallest value is {}, free are pixels below {}",
                    *darkest, least));
  throw InputError(*brightest == 0
                       ? "all of the image is wall: no pixel is free"
                       : fmt::format("all of the image is wall: its largest value is {}, free "
                                     "are pixels of at least {}",
                                     *brightest, least));
}

}  // namespace

PixelMap map_of_pixels(std::span<const std::uint8_t> pixels, std::size_t width, std::size_t height,
                       double um_per_px, const PixelMapParams& params) {
  constexpr std::size_t most = 65'535;
  for (const std::size_t side : {width, height})
    if (side < 1 || side > most)
      throw InputError(
          fmt::format("an image of {} × {} pixels: a side must be 1 to {}", width, height, most));
  if (pixels.size() != width * height)
    throw InputError(
        fmt::format("{} pixels for an image of {} × {}", pixels.size(), width, height));
  if (!(um_per_px >= 1e-6 && um_per_px <= 1e6))
    throw InputError(fmt::format("um_per_px is {}, must be 1e-6 to 1e6", um_per_px));
  if (!(params.simplify >= 0 && params.simplify <= 1e6))
    throw InputError(fmt::format("simplify is {}, must be 0 to 1e6 µm", params.simplify));
  Mask blocked(static_cast<int>(width), static_cast<int>(height));
  const int least = min_bright(pixels, params);
  const bool dark_is_free = params.free == FreePixels::dark;
  std::ranges::transform(pixels, blocked.cells.begin(),
                         [&](std::uint8_t v) { return (v < least) != dark_is_free; });
  if (std::ranges::find(blocked.cells, 0) == blocked.cells.end())
    fail_all_wall(pixels, least, dark_is_free);
  std::vector<Polygon> walls = mask_walls(blocked, um_per_px);
  simplify(walls, params.simplify);
  std::size_t corners = 0;
  for (const Polygon& wall : walls) {
    corners += wall.outer.size();
    for (const auto& hole : wall.holes) corners += hole.size();
  }
  if (corners > max_corners)
    throw InputError(
        fmt::format("an image whose walls have {} corners, at most {} are taken: simplify them, or "
                    "remove its noise",
                    corners, max_corners));
  std::vector<std::string> notes;
  if (walls.empty()) notes.emplace_back("the image has no walls: all of its pixels are free");
  return {Map(cell_bounds(blocked, um_per_px), std::move(walls)), std::move(notes)};
}

}  // namespace microswarm::formats
