// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "microswarm/core/fields.hpp"
#include "microswarm/core/issue.hpp"
#include "microswarm/formats/images/image.hpp"
#include "microswarm/formats/images/mask.hpp"
#include "microswarm/geometry/vec2.hpp"
#include "microswarm/vision/tracking/particles.hpp"

namespace microswarm {

/// Settings of `find_blobs`.
struct BlobParams {
  ParticleTone tone = ParticleTone::dark;
  double min_radius = 8;
  double max_radius = 200;
  double min_contrast = 8;
  double gap = 6;
  double min_texture = 0;

  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.tone, {"tone", Unit::none, {}, "Dark or bright against the background."});
    visit(self.min_radius, {"min_radius", Unit::px, {1, 1e4}, "Minimum radius; smaller is dirt."});
    visit(self.max_radius, {"max_radius", Unit::px, {1, 1e4}, "Maximum radius."});
    visit(self.min_contrast,
          {"min_contrast", Unit::none, {1, 255}, "Minimum contrast to the background, of 255."});
    visit(self.gap, {"gap", Unit::px, {1, 1000}, "Maximum gap between clumps of one blob."});
    visit(self.min_texture, {"min_texture",
                             Unit::none,
                             {0, 255},
                             "Minimum texture above the noise; 0: any.",
                             false,
                             "min_grain"});
  }
};

/// An issue when the radii leave nothing to be found.
Issues validate(const BlobParams& params);

/// Something compact in a picture. All in pixels: x right, y down, (0, 0) is the middle of the
/// first pixel.
struct Blob {
  Vec2 centre_px;            ///< of the area within the outline
  double radius_px = 0;      ///< of the disc of the same area
  double semi_major_px = 0;  ///< of the ellipse with the same second moments
  double semi_minor_px = 0;
  double angle = 0;              ///< of its major axis [rad], from x towards y: clockwise as seen
  std::vector<Vec2> outline_px;  ///< where it is half as far from the ground as its middle
  double contrast = 0;           ///< median difference to the ground [grey]
  double texture = 0;            ///< spread of the greys within beyond that of the noise [grey]
  bool is_cut = false;           ///< it goes on beyond the picture or behind a wall
};

/// What stands out of the ground in a picture, those of the most area first: uneven light is taken
/// away, clumps nearer to each other than `gap` become one, and an outline runs, between pixels,
/// where half of the contrast is reached. Pixels set in `walls`, of the picture's size, and the
/// next ones to them are not looked at. Colours are turned grey. The same picture gives the same
/// bits. Throws InputError when `walls` has another size.
std::vector<Blob> find_blobs(const Image& picture, const BlobParams& params,
                             const Mask* walls = nullptr);

}  // namespace microswarm
