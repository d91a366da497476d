// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "microswarm/formats/images/mask.hpp"
#include "microswarm/formats/map_spec.hpp"
#include "microswarm/geometry/vec2.hpp"

namespace microswarm::formats {

/// Walls of a drawing as pixels.
struct SvgWalls {
  Mask walls{};
  double um_per_px = 1;              ///< side of a pixel [µm]
  Vec2 size{};                       ///< of the drawing [µm], which begins at the upper left pixel
  std::vector<std::string> notes{};  ///< "FILE: …", for people
};

/// Draws a file and takes its walls. Where lines thinner than a pixel would be lost, the pixels are
/// 2 to 16 times as fine, within the limits of an image, and a note says so; another names ink that
/// is still lost. Throws as `draw_svg` and `picture_walls`. `file` is the drawing's path, which
/// spec.file is not read for.
SvgWalls draw_svg_walls(const SvgMap& spec, const std::filesystem::path& file);

}  // namespace microswarm::formats
