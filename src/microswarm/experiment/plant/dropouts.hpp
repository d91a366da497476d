// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "microswarm/core/maths/rng.hpp"

namespace microswarm::experiment {

/// Detections that are missed at random, each by itself or in bursts: the two-state model of
/// Gilbert, Bell System Technical Journal 39 (1960).
class Dropouts {
 public:
  /// `share` of the frames are missed. A burst lasts `mean_time` [s] in the mean; 0: one frame.
  Dropouts(double share, double mean_time) : share_(share), mean_time_(mean_time) {}

  /// Whether the thing of this index is missed in a frame that comes `dt` [s] after the one before.
  /// No burst begins in a first frame, with dt = 0.
  bool miss(std::size_t index, double dt, Rng& rng) {
    const double u = rng.uniform();
    if (mean_time_ <= 0 || share_ <= 0 || share_ >= 1) return u < share_;
    if (index >= is_missed_.size()) is_missed_.resize(index + 1, false);
    // A burst of a great share ends late, since the next begins in the next frame at the earliest.
    const double ends = std::min({1.0, dt / mean_time_, (1 - share_) / share_});
    const double begins = ends * share_ / (1 - share_);
    is_missed_[index] = is_missed_[index] ? u >= ends : u < begins;
    return is_missed_[index];
  }

 private:
  double share_;
  double mean_time_;
  std::vector<bool> is_missed_;
};

}  // namespace microswarm::experiment
