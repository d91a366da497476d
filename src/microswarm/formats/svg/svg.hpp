// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "microswarm/formats/images/image.hpp"

namespace microswarm::formats {

/// An SVG as drawn in front of white.
struct SvgPicture {
  Image image{};         ///< grey
  double um_per_px = 1;  ///< side of a pixel [µm]
  double width = 0;      ///< of the drawing [µm], which begins at the upper left pixel
  double height = 0;
  std::vector<std::string> notes{};
};

/// Draws an SVG with its units, transforms, styles and curves. `um_per_unit` is the µm for a unit
/// of its viewBox, or a px without one; without it, the drawing must have a width and height in mm,
/// cm, in, pt or pc. `um_per_px` [µm] is the side of a pixel; without it the longer side has 2000.
/// Throws InputError "NAME: WHY", also for more pixels than an image may have.
SvgPicture draw_svg(std::string_view text, std::string_view name, std::optional<double> um_per_unit,
                    std::optional<double> um_per_px);

}  // namespace microswarm::formats
