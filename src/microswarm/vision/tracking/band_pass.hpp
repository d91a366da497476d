// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "microswarm/formats/images/image.hpp"

namespace microswarm {

/// What counts as noise and what as ground.
struct BandPassParams {
  double noise_px = 1;        ///< spread of the Gaussian that takes the noise away; 0: none
  int box_px = 11;            ///< side of the box whose mean is the ground, odd
  double min_foreground = 1;  ///< greys above the ground below which a pixel counts as ground
  bool dark_rises = false;    ///< what is darker than the ground rises, not what is brighter
};

/// What stands between noise and uneven ground (Eqs 1 to 3 [crocker]): the picture smoothed by a
/// Gaussian, cut at four spreads, less the mean of the box around each pixel. The mean is rounded
/// down to whole greys down the columns and again along the rows, as trackpy does with bytes; the
/// ground is so about one grey low. Beyond its border the picture goes on as it ends. Sums in a
/// fixed order, the same bits on every machine.
///
/// [crocker] J. C. Crocker and D. G. Grier, Methods of digital video microscopy for colloidal
/// studies, J. Colloid Interface Sci. 179, 298 (1996).
class BandPass {
 public:
  explicit BandPass(const BandPassParams& params);

  /// How far each pixel of the picture, of one channel, rises above the ground [grey]: row by row,
  /// 0 for ground. Valid until the next call.
  const std::vector<float>& filter(const Image& grey);

 private:
  void begin(const Image& grey);
  void smooth_down(const Image& grey, int row);
  void find_ground(const Image& grey, int row);
  void write_row(int width, float* out) const;

  BandPassParams params_;
  std::vector<float> taps_;                 ///< the Gaussian from its middle outwards
  std::vector<float> smoothed_;             ///< a row after the pass downwards, with margins
  std::vector<std::int32_t> column_sums_;   ///< of the rows in the box
  std::vector<std::int32_t> column_means_;  ///< with margins
  std::vector<std::int32_t> ground_;        ///< under each pixel of a row
  std::vector<float> result_;
};

}  // namespace microswarm
