// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "microswarm/core/errors/issue.hpp"
#include "microswarm/core/fields/fields.hpp"
#include "microswarm/formats/images/image.hpp"
#include "microswarm/formats/images/mask.hpp"
#include "microswarm/geometry/vec2.hpp"
#include "microswarm/vision/tracking/particles.hpp"

namespace microswarm::vision {

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
    visit(self.tone, plain("tone", "Dark or bright against the background."));
    visit(self.min_radius, px("min_radius", 1, 1e4, "Minimum radius; smaller is dirt."));
    visit(self.max_radius, px("max_radius", 1, 1e4, "Maximum radius."));
    visit(self.min_contrast,
          plain("min_contrast", 1, 255, "Minimum contrast to the background, of 255."));
    visit(self.gap, px("gap", 1, 1000, "Maximum gap between clumps of one blob."));
    visit(self.min_texture, plain("min_texture", 0, 255, "Minimum texture above the noise; 0: any.")
                                .formerly("min_grain"));
  }
};

/// Reports an issue if the radii exclude every blob.
Issues validate(const BlobParams& params);

/// A compact region that differs from the background. All in pixels: x right, y down, (0, 0) is the
/// centre of the first pixel.
struct Blob {
  Vec2 centre_px{};          ///< centroid of the area inside the outline
  double radius_px = 0;      ///< of the disc of equal area
  double semi_major_px = 0;  ///< of the ellipse with equal second moments
  double semi_minor_px = 0;
  double angle = 0;  ///< of the major axis [rad], from x towards y: clockwise as displayed
  std::vector<Vec2> outline_px{};  ///< contour of half the contrast of the centre
  double contrast = 0;             ///< median difference from the background [grey]
  double texture = 0;   ///< standard deviation of the greys inside, minus the noise [grey]
  bool is_cut = false;  ///< it extends beyond the picture or behind a wall
};

/// Finds regions that differ from the background, sorted by decreasing area. Uneven light is
/// removed first. Clumps closer than `gap` are merged. Outlines have subpixel resolution and run at
/// half of the contrast. Pixels set in `walls`, which has the picture's size, and their neighbours
/// are ignored. Colour pictures are converted to grey. The result is bit-reproducible. `refused`
/// receives the regions that are too smooth, too large, or too small but at least a quarter of
/// `min_radius`. Throws InputError if `walls` has another size.
std::vector<Blob> find_blobs(const formats::Image& picture, const BlobParams& params,
                             const formats::Mask* walls = nullptr,
                             std::vector<Blob>* refused = nullptr);

/// Contrast above which something differs from the background [grey]: `min_contrast`, or five times
/// the spread of the background. Walls and errors as in `find_blobs`.
double contrast_limit(const formats::Image& picture, const BlobParams& params,
                      const formats::Mask* walls = nullptr);

}  // namespace microswarm::vision
