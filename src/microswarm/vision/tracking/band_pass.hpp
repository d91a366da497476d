// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "microswarm/formats/images/image.hpp"

namespace microswarm::vision {

/// Settings of BandPass.
struct BandPassParams {
  double noise_px = 1;        ///< standard deviation of the Gaussian that removes noise; 0: none
  int box_px = 11;            ///< side of the box whose mean is the background, odd
  double min_foreground = 1;  ///< difference from the background below which a pixel is background
  bool dark_rises = false;    ///< dark pixels are foreground instead of bright ones
};

/// Band-pass filter between noise and uneven background (Eqs 1 to 3 [crocker]): the picture
/// smoothed by a Gaussian, cut at four standard deviations, minus the box mean around each pixel.
/// The mean is rounded down to whole greys along the columns and again along the rows, like in
/// trackpy with bytes. This makes the background about one grey too low. The border is replicated.
/// Sums are in a fixed order, so the bits are the same on every machine.
///
/// [crocker] J. C. Crocker and D. G. Grier, Methods of digital video microscopy for colloidal
/// studies, J. Colloid Interface Sci. 179, 298 (1996).
class BandPass {
 public:
  explicit BandPass(const BandPassParams& params);

  /// Difference of each pixel of a one-channel picture from the background [grey]: row-major, 0 for
  /// background. Valid until the next call.
  const std::vector<float>& filter(const formats::Image& grey);

 private:
  void begin(const formats::Image& grey);
  void take_row(const formats::Image& grey, int row);
  void smooth_down(const formats::Image& grey, int row);
  void find_ground(const formats::Image& grey, int row);
  void write_row(int width, float* out) const;

  BandPassParams params_;
  std::vector<float> taps_;      ///< Gaussian weights from the middle outwards
  std::vector<float> rows_;      ///< of the picture, those that the Gaussian reaches, twice
  std::vector<float> smoothed_;  ///< a row after the vertical pass, with margins
  std::vector<std::int32_t> column_sums_;   ///< sums over the rows in the box
  std::vector<std::int32_t> column_means_;  ///< with margins
  std::vector<std::int32_t> ground_;        ///< background of each pixel of a row
  std::vector<float> result_;
};

}  // namespace microswarm::vision
