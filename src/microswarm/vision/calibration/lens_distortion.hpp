// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>

#include "microswarm/vision/camera/camera_scale.hpp"

namespace microswarm::vision {

/// Radial distortion of a lens: a point at distance r from the picture's centre would be at
/// r (1 + k1 r²) without it, where r is 1 in the corners.
struct LensDistortion {
  double k1 = 0;            ///< above 0: barrel, below 0: pincushion
  double shift_px = 0;      ///< by which it moves the corners
  double deviation_px = 0;  ///< standard deviation of that, by the points' scatter
  double error_px = 0;      ///< of a scale that does not know of it, in the worst corner
  double rms = 0;           ///< residual of the points that is left with it [µm]

  /// Whether it stands out of the points' scatter.
  bool is_found() const { return shift_px > 3 * deviation_px; }
};

/// Fits k1 with a scale to points of a grid in a picture of this size, by least squares. Nothing
/// when there are less than six points, or their places do not determine it.
std::optional<LensDistortion> fit_distortion(std::span<const ScalePoint> points, bool y_up,
                                             int width, int height);

}  // namespace microswarm::vision
