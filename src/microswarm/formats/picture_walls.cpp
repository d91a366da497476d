// SPDX-License-Identifier: Apache-2.0
#include "microswarm/formats/picture_walls.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "microswarm/core/errors/error.hpp"

namespace microswarm::formats {

Mask picture_walls(const Image& image, int level, FreePixels free, const std::string& name) {
  Mask walls = threshold(image, level, free == FreePixels::bright);
  if (std::ranges::find(walls.cells, 0) != walls.cells.end()) return walls;
  // The brightest grey, or the darkest one.
  const auto has_free = [&](int t) {
    const Mask set = threshold(image, t, free == FreePixels::dark);
    return std::ranges::find(set.cells, 1) != set.cells.end();
  };
  int below = 0, above = 256;  // the limit between thresholds that leave something free and others
  while (above - below > 1) {
    const int middle = (below + above) / 2;
    (has_free(middle) == (free == FreePixels::bright) ? below : above) = middle;
  }
  const int extreme = below;
  throw InputError(
      name,
      free == FreePixels::bright
          ? fmt::format(
                "all of the picture is wall: its brightest grey is {} of 255, below "
                "map.threshold {}: set map.threshold to {}, or map.free to dark where dark is "
                "free",
                extreme, level, std::max(1, (extreme + 1) / 2))
          : fmt::format("all of the picture is wall: its darkest grey is {} of 255, not below "
                        "map.threshold {}, and map.free is dark: set map.threshold higher",
                        extreme, level));
}

std::string no_walls_note(int level, FreePixels free, const std::string& name) {
  return fmt::format("{}: no walls: no grey is {} map.threshold {}", name,
                     free == FreePixels::bright ? "below" : "at least", level);
}

}  // namespace microswarm::formats
